"""Equivalent length of a piston in a slit or a round tube that liquid sticks to, behind developed flow.

Stokes flow by finite differences of the stream function (thirteen points), Python alone: `python3 plug.py`, a minute. Lengths
over the width. The piston moves at the mean speed; beside it the wall's velocity falls from that of the piston to zero over the
length d: a piston whose corner is sharp has no limit (Taylor's scraper, pressure 2 C eta U/r with C = (pi/2)/(pi^2/4 - 1)), and
the equivalent length grows by (C/3) ln(1/d) in a slit and by (C/4) ln(1/d) in a tube.
"""


class Lumen:
    """Half a slit or tube of `m` cells over half its width, `length` long, with the wall's slip over `d`."""

    def __init__(self, round_, m, d, length=1.5):
        self.round, self.m, self.d, self.length = round_, m, d, length
        self.h = 0.5 / m
        self.n = round(length / self.h)
        self.number = {
            (i, j): (i - 1) * (m - 1) + j - 1 for i in range(1, self.n) for j in range(1, m)
        }

    def given(self, i, j):
        """Stream function at the piston, at the wall and in developed flow."""
        y = j * self.h
        if i <= 0 or j == self.m:
            return 0.5 * y * y if self.round else y
        return y * y - 2 * y**4 if self.round else 1.5 * y - 2 * y**3

    def stream(self, i, j):
        """Stream function at a node: coefficients of the unknowns, and a constant."""
        if (i, j) in self.number:
            return {self.number[i, j]: 1.0}, 0.0
        if i < 0:  # no velocity along the piston
            return self.stream(-i, j)
        if j < 0:
            sign = 1.0 if self.round else -1.0
            terms, constant = self.stream(i, -j)
            return {k: sign * c for k, c in terms.items()}, sign * constant
        if j > self.m:  # velocity of the wall
            terms, constant = self.stream(i, 2 * self.m - j)
            slip = max(0.0, 1 - i * self.h / self.d) * (0.5 if self.round else 1.0)
            return terms, constant + 2 * (j - self.m) * self.h * slip
        return {}, 0.0 if j == 0 else self.given(i, j)

    def operator(self, values, i, j):
        """psi_xx + psi_yy (- psi_y/y in a tube), times h^2, of node functions."""
        skew = 1 / (2 * j) if self.round else 0.0
        sides = [(i - 1, j, 1.0), (i + 1, j, 1.0), (i, j + 1, 1 - skew), (i, j - 1, 1 + skew), (i, j, -4.0)]
        terms, constant = {}, 0.0
        for a, b, weight in sides:
            more, known = values(a, b)
            constant += weight * known
            for k, c in more.items():
                terms[k] = terms.get(k, 0.0) + weight * c
        return terms, constant

    def vorticity(self, i, j):
        return ({}, 0.0) if j == 0 else self.operator(self.stream, i, j)

    def solve(self):
        """The stream function, by elimination in a band."""
        size, band = len(self.number), 2 * self.m
        rows, right = [], []
        for (i, j), k in self.number.items():
            terms, constant = self.operator(self.vorticity, i, j)
            row = [0.0] * (2 * band + 1)
            for q, c in terms.items():
                row[q - k + band] += c
            rows.append(row)
            right.append(-constant)
        for k in range(size):
            pivot = rows[k][band:]
            for q in range(k + 1, min(size, k + band + 1)):
                at = k - q + band
                factor = rows[q][at] / pivot[0]
                if factor:
                    rows[q][at : at + band + 1] = [
                        x - factor * y for x, y in zip(rows[q][at : at + band + 1], pivot)
                    ]
                    right[q] -= factor * right[k]
        for k in reversed(range(size)):
            ahead = range(1, min(band, size - 1 - k) + 1)
            known = sum(rows[k][band + q] * right[k + q] for q in ahead)
            right[k] = (right[k] - known) / rows[k][band]
        return right

    def equivalent_length(self):
        """Friction of the wall over that of developed flow, less the length."""
        stream = self.solve()
        friction = []
        for i in range(self.n + 1):
            terms, constant = self.vorticity(i, self.m)
            friction.append(constant + sum(c * stream[k] for k, c in terms.items()))
        whole = sum(0.5 * (a + b) for a, b in zip(friction, friction[1:])) * self.h
        return whole / friction[-1] - self.length


for round_, name in [(False, "slit"), (True, "tube")]:
    for parts in [3, 6, 12]:
        coarse, fine = [(24, 36), (24, 36), (36, 48)][[3, 6, 12].index(parts)]
        a, b = (Lumen(round_, m, 1 / parts).equivalent_length() for m in (coarse, fine))
        limit = b + (b - a) * coarse**2 / (fine**2 - coarse**2)
        print(f"{name} d = 1/{parts}: {a:.4f} {b:.4f} limit {limit:.3f}", flush=True)
