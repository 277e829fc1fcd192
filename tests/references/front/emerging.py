"""Liquid emerges from a slit (2-D) or square duct (3-D) of width 1 into a wide space: by time, at constant inflow.

Stokes flow; no inertia, no surface tension; the surface is free of stress and stays at the exit's edges, where at time 0 it is flat. The liquid never comes
near other walls if those are 0.65 or more off the axis: it goes on as a jet. The surface is x = h on rays (1 + FAN h)(y, z) through the lattice of the
exit. Velocities of two steps are carried on to the middle of the next. Units: width 1, mean inflow 1, viscosity 1.

    python3 emerging.py 3 8 0.02 1.2        # dimension, elements over half a width, time step, end

Columns: emerged volume over the cross-section; pressure at the exit's plane as if developed up to it (L_eq less the length of the duct); tip;
half width of the jet in the middle plane and, in a duct, on the diagonal (along y)."""
import sys

import numpy as np

from surface import Surface, channel_flow, graded

FAN = 2.0  # the rays meet 1/FAN behind the exit's middle


class Emerging(Surface):
    def __init__(self, d, n, back=1.5):
        super().__init__(d, n, 1.5)
        layers = 2 * ((4 * n) // 3)
        self.back = back
        self.behind = graded(1 - np.arange(layers + 1) / layers, 1.9)
        self.pinned = np.zeros((n + 1,) * (d - 1), bool)
        for a in range(d - 1):
            np.moveaxis(self.pinned, a, 0)[-1] = True

    def solve(self, f):
        """Velocity on the surface, L_eq less the duct's length, emerged volume."""
        x = np.repeat(-self.back * self.behind, len(self.places)).reshape(-1, len(self.places))
        if f.any():
            out = self.refine(f).ravel() * np.arange(1, 2 * self.n + 1)[:, None] / (2 * self.n)
            x = np.concatenate([x, out])
        lattice = np.broadcast_to(self.places, x.shape + (self.d - 1,))
        spread = 1 + FAN * np.maximum(x, 0)
        nodes = np.concatenate([x[..., None], lattice * spread[..., None]], axis=2).reshape(-1, self.d)
        shape = (len(x),) + (2 * self.n + 1,) * (self.d - 1)
        u, equivalent, length = channel_flow(shape, nodes, lattice.reshape(-1, self.d - 1), self.y)
        return u, equivalent - self.back, length - self.back

    def rates(self, f, u):
        uq = self.at_points(u.reshape(-1, self.d))
        spread = 1 + FAN * self.heights(f)[..., None]
        return uq[..., 0], (uq[..., 1:] - FAN * self.at_points(self.places) * uq[..., :1]) / spread

    def widths(self, f):
        y = self.y[::2]
        lines = [f] if self.d == 2 else [f[:, 0], np.diag(f)]
        return [(y * (1 + FAN * line)).max() for line in lines]


def main(d, n, dt, end):
    jet = Emerging(d, n)
    f, last = np.zeros(jet.pinned.shape), None
    for k in range(round(end / dt) + 1):
        u, extra, out = jet.solve(f)
        if k % max(1, round(0.1 / dt)) == 0:
            print(",".join(f"{v:.5f}" for v in [out, extra, f.ravel()[0], *jet.widths(f)]), flush=True)
        now = jet.rates(f, u)
        middle = now if last is None else tuple(1.5 * a - 0.5 * b for a, b in zip(now, last))
        last = now
        f = jet.carry(f, middle, dt, 0.55, (1 + FAN * jet.heights(f)) ** (d - 1), jet.pinned)


if __name__ == "__main__":
    main(int(sys.argv[1]), int(sys.argv[2]), float(sys.argv[3]), float(sys.argv[4]))
