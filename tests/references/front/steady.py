"""The steady free front of a viscous liquid in a slit, round tube (2-D) or square duct (3-D), in the frame of the front.

Stokes flow behind a front x = f(y, z) that is free of stress; no inertia, no surface tension. The liquid sticks to the walls, which
it reaches by rolling: at the contact line the surface touches the wall at 180 degrees. In the front's frame
    f_t = u - U - v f_y - w f_z
is carried to rest from a flat front. Half a slit or a quarter of a duct is solved; the inlet is `back` behind the flat front.
Units: width H = 1, mean speed U = 1, viscosity 1. L_eq = p/G: pressure at the inlet over the developed gradient G (12; 32; 28.454).

    pip install numpy scipy pypardiso
    python3 steady.py 2 8,16,32 --power 2.5        # slit: elements over half a width, each starts from the one before
    python3 steady.py 2 8,16,32 --round            # tube
    python3 steady.py 3 6,8,12                     # duct
    python3 steady.py 3 8 --transient 2            # from a flat front, by time

Columns: case, n, flat (L_eq less mean length of the flat front), extra (of the real one), shape (their difference), then how far the surface lies
behind the tip at 0, 1/48, 1/24, 1/12, 1/6 off the middle of a wall and, in a duct, off both walls of a corner; the last change of f a unit of time."""
import argparse
import itertools

import numpy as np
from scipy.interpolate import PchipInterpolator, RegularGridInterpolator

from surface import Surface, channel_flow, graded

OFF = np.array((0.0, 1 / 48, 1 / 24, 1 / 12, 1 / 6))


class Front(Surface):
    def __init__(self, d, n, power=2.0, back=2.2, round=False):
        super().__init__(d, n, power)
        layers = 2 * ((4 * n) // 3)
        self.back, self.round = back, round
        self.behind = graded(1 - np.arange(layers + 1) / layers, 1.9)
        self.shape = (layers + 1,) + (2 * n + 1,) * (d - 1)
        self.flat = np.zeros((n + 1,) * (d - 1))

    def solve(self, f):
        """Velocity on the front and L_eq less mean length."""
        f = self.refine(f).ravel()
        x = f - (f + self.back) * self.behind[:, None]
        lattice = np.broadcast_to(self.places, x.shape + (self.d - 1,))
        nodes = np.concatenate([x[..., None], lattice], axis=2).reshape(-1, self.d)
        u, equivalent, length = channel_flow(self.shape, nodes, nodes[:, 1:], self.y, self.round)
        return u, equivalent - length

    def advance(self, f, u, dt):
        uq = self.at_points(u.reshape(-1, self.d))
        return self.carry(f, (uq[..., 0] - 1, uq[..., 1:]), dt)

    def depths(self, f):
        """How far the surface at OFF from the middle of a wall and from both walls of a corner lies behind the tip."""
        y, tip = self.y[::2], f.ravel()[0]
        lines = [f] if self.d == 2 else [f[0], np.diag(f)]
        return np.concatenate([tip - PchipInterpolator(y, line)(0.5 - OFF) for line in lines])

    def taken_from(self, other, f):
        y = self.y[::2]
        places = np.array(list(itertools.product(y, repeat=self.d - 1)))
        return RegularGridInterpolator((other.y[::2],) * (self.d - 1), f)(places).reshape((len(y),) * (self.d - 1))


def row(front, flat, extra, f, last):
    values = [flat, extra, extra - flat, *front.depths(f)]
    case = "tube" if front.round else "slit" if front.d == 2 else "duct"
    print(",".join([case, str(front.n)] + [f"{v:.5f}" for v in values] + [f"{last:.1e}"]), flush=True)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("d", type=int)
    parser.add_argument("n")
    parser.add_argument("--power", type=float, default=2.0)
    parser.add_argument("--back", type=float, default=2.2)
    parser.add_argument("--transient", type=float, default=0.0)
    parser.add_argument("--round", action="store_true")
    args = parser.parse_args()
    f = before = None
    for n in map(int, args.n.split(",")):
        front = Front(args.d, n, args.power, args.back, args.round)
        _, flat = front.solve(front.flat)
        f = front.flat if f is None else front.taken_from(before, f)
        steps, dt = (round(args.transient / 0.05) + 1, 0.05) if args.transient else (18 if before is None else 10, 0.3)
        for k in range(steps):
            u, extra = front.solve(f)
            new = front.advance(f, u, dt)
            last = np.ptp(new - f) / dt
            if args.transient and k % 5 == 0:
                print(f"{k * dt:.2f},", end="")
                row(front, flat, extra, f, last)
            if not args.transient and last < 3e-4:
                break
            if k + 1 < steps:
                f = new
        if not args.transient:
            row(front, flat, extra, f, last)
        before = front


if __name__ == "__main__":
    main()
