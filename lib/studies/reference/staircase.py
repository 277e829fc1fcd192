"""Developed flow through the staircase walls of lumens of voxels, by central differences on a quarter of the cross-section.

    staircase.py > staircase.csv

Pressure gradient over viscosity and mean velocity times the square of the diameter. The weights take errors of the powers 4/3 (the
velocity beside a re-entrant edge is r^(2/3)) and 2 of the square's edge out of the mean velocities: four squares a voxel's edge
alone are 2.5 % too fast with 6 voxels across a tube and 1.3 % with 12."""

from functools import reduce
from math import hypot, pi
from operator import add

FINE = {2: 1.40724, 3: -6.71364, 4: 6.30640}  # squares on the edge of a voxel, and their weight


def widths(count, round_):
    """Open voxels of each row of the quarter, from the axis outwards."""
    open_ = lambda j, k: not round_ or hypot(k + 0.5, j + 0.5) < count
    return [sum(open_(j, k) for k in range(count)) for j in range(count)]


def resistance(rows, fine):
    """With so many squares on the edge of a voxel, by successive over-relaxation."""
    m = len(rows) * fine
    wide = [rows[j // fine] * fine for j in range(m)]
    relaxation = 2.0 / (1.0 + 0.5 * pi / m)
    u = [[0.0] * m for _ in range(m)]
    change, total = 1.0, 0.0
    while change > 1e-9 * total:
        change = total = 0.0
        for j in range(m):
            for i in range(wide[j]):
                # A mirror at the axes, a wall half a square beyond the last open one.
                weight, flow = 0.0, 1.0
                for a, b in ((max(i - 1, 0), j), (i + 1, j), (i, max(j - 1, 0)), (i, j + 1)):
                    inside = b < m and a < wide[b]
                    weight += 1.0 if inside else 2.0
                    flow += u[b][a] if inside else 0.0
                step = relaxation * (flow / weight - u[j][i])
                total += abs(u[j][i])
                u[j][i] += step
                change += abs(step)
    mean = reduce(add, (x for row in u for x in row)) / sum(wide)
    return (2.0 * m) ** 2 / mean


print("section,cells,resistance")
for section, per_cell, cells in (("square", 2, (3, 6, 7, 12)), ("tube", 2, (3, 4, 6, 7, 12)), ("tube1", 1, (6, 12))):
    for n in cells:
        rows = widths(n * per_cell // 2, section != "square")
        flows = [weight / resistance(rows, fine) for fine, weight in FINE.items()]
        print(f"{section},{n},{1.0 / reduce(add, flows)!r}")
