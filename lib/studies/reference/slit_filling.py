"""A piston presses liquid into a slit: Stokes flow behind a tracked front.

`run` writes one refinement, `report` compares several and writes the reference, `static` is the
limit of a flat front. See README.md.
"""

import argparse
import os
from pathlib import Path

os.environ.setdefault("OMP_NUM_THREADS", "1")

import numpy as np
from scipy.interpolate import CubicSpline

from stokes import SLOPE, Mesh, start, stokes

TAIT_C = 0.0894  # of paper Eq. 1
HEAD = "filled_H,force,force_mirror,force_deep,force_mirror_deep,middle_pressure,tip_H,contact_H,volume_H"
# Force per ln(1/SEAL): both corners of the piston are Taylor's scraper at a right angle, where
# the pressure is 2 C viscosity V/r with C = (pi/2)/(pi^2/4 - 1).
CORNER = 4 * (np.pi / 2) / (np.pi**2 / 4 - 1) / 192


def spread(front, size):
    """The front's vertices anew: a cubic spline through them, closer towards the contact line."""
    s = np.concatenate([[0], np.cumsum(np.hypot(*np.diff(front, axis=0).T))])
    back = [0.0]
    while back[-1] < s[-1]:
        back.append(back[-1] + min(size["front"], size["contact"] + 0.15 * back[-1]))
    back = np.array(back) * s[-1] / back[-1]
    spline = CubicSpline(s, front, bc_type=((1, np.array([1.0, 0.0])), "not-a-knot"))
    new = spline((s[-1] - back)[::-1])
    new[0, 0], new[-1] = 0.0, front[-1]
    new[:, 0] = np.minimum(new[:, 0], 0.5)
    return new


def roll(front, contact, touch):
    """Liquid that reached the wall stays there: the contact line moves up to it."""
    hit = np.flatnonzero((front[:-1, 0] >= 0.5 - touch) & (front[:-1, 1] > contact[1]))
    if len(hit) == 0:
        return np.concatenate([front[:-1], contact[None]])
    a, b = front[hit[0] - 1], front[hit[0]]
    part = np.clip((0.5 - touch - a[0]) / (b[0] - a[0]), 0.0, 1.0)
    new = np.array([0.5, a[1] + part * (b[1] - a[1])])
    keep = front[: hit[0]]
    return np.concatenate([keep[np.hypot(*(keep - new).T) > 1e-4], new[None]])


def area(front):
    """Half the liquid in the slit."""
    return float((0.5 * (front[1:, 1] + front[:-1, 1]) * np.diff(front[:, 0])).sum())


def middle(mesh, p, depth):
    """Mean pressure over the middle half of the reservoir, a quarter width off the piston."""
    line = np.stack([np.linspace(0.0125, 0.9875, 40), np.full(40, 0.25 - depth)], 1)
    return mesh.pressure_at(p, line).mean() / SLOPE


def others(mesh, front, size, depth, back, source):
    """Forces on other pistons with this front: between mirrors; half a width deeper, both."""
    deep = Mesh(depth + 0.5, front, size)
    none = np.zeros(len(deep.corners))
    forces = [stokes(deep, sides, 0.0, none)[2] for sides in ["stick", "mirror"]]
    return [stokes(mesh, "mirror", 0.0, back, source)[2], *forces]


def run(options):
    """Rows of HEAD while a piston fills the slit."""
    k, step = options.refine, options.step or 0.04 / options.refine
    size = dict(entrance=0.02, contact=options.contact, seal=1 / 96, far=0.12, front=0.05)
    size = {name: s / k for name, s in size.items()}
    front = np.stack([np.linspace(0, 0.5, round(14 * k) + 1), np.zeros(round(14 * k) + 1)], 1)
    front = spread(front, size)
    filled, lost, old, rows, done = 0.0, 0.0, None, [], -1
    while filled < options.end + 0.5 * step:
        depth, ahead = 2.0 - filled / 4, min(step, (0.1 + filled) * 0.25)
        mesh = Mesh(depth, front, size)
        dt, back = ahead, np.zeros(len(mesh.corners))
        if old:
            mesh0, u0, p0, filled0 = old
            dt, x = filled - filled0, mesh.x[mesh.corners]
            back = mesh0.pressure_at(p0, x - dt * mesh0.velocity_at(u0, x))
        # Tait: -dp/d ln J is nearly K + p/C.
        gives = 1.0 / (options.modulus + np.maximum(back, 0.0) / TAIT_C) / dt
        u, p, force, rate = stokes(mesh, "stick", gives, back)
        lost += rate * dt
        now, more = int(4 * filled + 1e-6), [np.nan] * 3
        if now > done:
            done, more = now, others(mesh, front, size, depth, back, gives * (p - back))
        rows.append([filled, force, *more, middle(mesh, p, depth), front[0, 1], front[-1, 1], 2 * area(front)])
        if more[0] == more[0]:
            print(k, len(mesh.t), " ".join(f"{v:.4f}" for v in rows[-1]), flush=True)
        # Adams-Bashforth with the velocity that the same liquid had a step ago; the first one
        # has the blow of the start.
        v = u[mesh.front]
        goal = (filled + ahead) / 2 - lost - (rate * ahead if old else 0.0)
        if len(rows) > 2:
            v = v + 0.5 * ahead / dt * (v - mesh0.velocity_at(u0, front - dt * v))
        new = front + np.array([0.0, ahead]) if options.flat else front + ahead * v
        front = new if options.flat else roll(new, front[-1], options.touch)
        front[0, 0] = 0.0
        front = spread(front, size)
        # Gaps that the front closes over, the spline and the step must not add liquid.
        front[:-1, 1] += (goal - area(front)) / (0.5 * (front[-1, 0] + front[-2, 0]))
        old, filled = (mesh, u, p, filled), filled + ahead
    np.savetxt(options.out, rows, fmt="%.5f", delimiter=",", header=HEAD, comments="")


def static(options):
    """Pressure and force in front of 3.5 filled widths: front flat, piston two widths off."""
    for k in [1, 2, 4]:
        front = np.stack([np.linspace(0, 0.5, 10 * k + 1), np.full(10 * k + 1, 3.5)], 1)
        size = dict(entrance=0.02, contact=0.02, seal=1 / 96, far=0.1, front=0.05)
        mesh = Mesh(2.0, front, {name: s / k for name, s in size.items()})
        none = np.zeros(len(mesh.corners))
        for sides in ["stick", "mirror"]:
            _, p, force, _ = stokes(mesh, sides, 0.0, none)
            print(k, len(mesh.t), sides, f"middle pressure {middle(mesh, p, 2.0):.5f} force {force:.5f}")


class Curve:
    """A run's columns, smooth: its contact line moves by jumps, two steps apart."""

    def __init__(self, path):
        self.data = np.genfromtxt(path, delimiter=",", names=True)
        self.filled = self.data["filled_H"]

    def __call__(self, name, length, half=0.25):
        """Value at a filled length by a parabola through what lies within `half` of it."""
        y, half = self.data[name], max(min(half, length), 0.06)
        near = np.isfinite(y) & (np.abs(self.filled - length) < half)
        return np.polyfit(self.filled[near] - length, y[near], 2)[2]

    def step_up(self, name, length):
        """What a force that is known here and there has more than `force`."""
        y = self.data[name] - self.data["force"]
        known = np.isfinite(y)
        return np.interp(length, self.filled[known], y[known])


def report(options):
    """Tables of the runs, and the reference from the finest."""
    lengths = [0.5, 1.0, 2.0, 3.0, 4.0]
    print(f"corner: {CORNER:.5f} ln(1/seal)\nforce at L = {lengths}; tip and contact line over L = 4")
    for path in sorted(Path(options.runs).glob("*.csv")):
        curve = Curve(path)
        top = curve.filled[-1] - 0.3
        forces = [curve("force", l) for l in lengths if l < top]
        ends = [curve(name, min(4.0, top)) - min(4.0, top) for name in ["tip_H", "contact_H", "volume_H"]]
        print(f"{path.stem:12}", " ".join(f"{f:.4f}" for f in forces), "|", " ".join(f"{e:+.4f}" for e in ends))
        if top > 4.6:
            x = np.linspace(0.0, 5.0, 2001)
            order = np.argsort(curve.filled)
            time = lambda name: np.trapezoid(
                np.interp(x, curve.filled[order], curve.data["force"][order])
                + (curve.step_up(name, x) if name != "force" else 0.0), x)
            print(" " * 12, "time to five widths:", ", ".join(f"{n} {time(n):.3f}" for n in HEAD.split(",")[1:5]))
    finest, rigid = Curve(options.finest), Curve(options.rigid)
    rows = []
    for length in 0.025 + 0.05 * np.arange(87):
        force = finest("force", length)
        rows.append([length, force, force + finest.step_up("force_mirror", length), rigid("force", length),
                     *(finest(n, length) for n in ["middle_pressure", "tip_H", "contact_H"])])
    names = "filled_H,force,force_mirror,force_incompressible,middle_pressure,tip_H,contact_H"
    np.savetxt(options.out, rows, fmt="%.4f", delimiter=",", header=names, comments="")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    jobs = parser.add_subparsers(required=True)
    one = jobs.add_parser("run", help="one piston")
    one.set_defaults(job=run)
    one.add_argument("--refine", type=float, default=1.0, help="divides elements and step")
    one.add_argument("--step", type=float, help="of the filled length")
    one.add_argument("--end", type=float, default=5.0, help="filled length")
    one.add_argument("--modulus", type=float, default=1e12, help="K H/(viscosity U)")
    one.add_argument("--flat", action="store_true", help="the front stays flat")
    one.add_argument("--touch", type=float, default=0.001, help="distance at which liquid touches a wall")
    one.add_argument("--contact", type=float, default=0.015, help="elements at the contact line")
    one.add_argument("out")
    jobs.add_parser("static", help="a filled slit with a flat front").set_defaults(job=static)
    many = jobs.add_parser("report", help="compare runs, write the reference")
    many.set_defaults(job=report)
    many.add_argument("runs", help="folder of runs")
    many.add_argument("finest", help="run with the scene's modulus")
    many.add_argument("rigid", help="run without compression")
    many.add_argument("out")
    options = parser.parse_args()
    options.job(options)


if __name__ == "__main__":
    start()
    main()
