"""A slit of width 1 (2-D) that is filled at constant inflow, on into a chamber of width 2 and some depth: a tracked front.

Stokes flow, no inertia, no surface tension, front free of stress. Its points move with the liquid (midpoint rule) and are spread anew along a
cubic spline each step; the mesh is made anew each half step (quadratic triangles with a bubble, linear pressure within each). Points
within 0.001 of a wall stick: the contact line is rolled over, and waits at the edge where the slit ends. Half is solved, y = 0 is a mirror.
Volume is kept by a shift along the normals. A run ends where the surface meets a wall elsewhere (air would be closed in).

    pip install numpy scipy pypardiso gmsh
    python3 tracked.py slit 0.05 0.02 1.5      # straight slit, flat at first: size of elements, time step, end
    python3 tracked.py 1 0.1 0.04 3.2          # slit 2.5 long, filled to 1.2 before its end, into a chamber 1 deep

Columns: volume less the slit's (over the width); pressure at the inlet over the developed gradient less the slit's length; x and y of the surface's first
point (tip, or contact line on the end wall) and of the last (contact line, edge); greatest y. For `slit` the slit's length is that of the first filling."""
import sys
import gmsh
import numpy as np
from scipy.interpolate import CubicSpline
import stokes
from surface import developed

SHAPES = stokes.triangle()

def on_segment(p, a, b):
    d = b - a
    t = np.clip(((p - a) @ d) / (d @ d), 0, 1)
    q = a + t[:, None] * d
    return np.linalg.norm(p - q, axis=1), q

class Scene:
    """Walls as a polyline from the inlet's edge on; the axis is y = 0."""
    def __init__(self, inlet, walls, h, fine, touch):
        self.inlet, self.h, self.fine, self.touch = inlet, h, fine, touch
        self.walls = np.array(walls, float)

    def nearest(self, p):
        found = [on_segment(p, a, b) for a, b in zip(self.walls[:-1], self.walls[1:])]
        k = np.argmin([f[0] for f in found], axis=0)
        return np.array([found[i][0][j] for j, i in enumerate(k)]), np.array([found[i][1][j] for j, i in enumerate(k)]), k

    def outline(self, s):
        """Closed outline of the liquid: inlet on the axis, the axis, surface, wall back; and each point's size."""
        _, _, kb = self.nearest(s[-1:])
        back = [self.walls[i] for i in range(kb[0], -1, -1) if np.linalg.norm(self.walls[i] - s[-1]) > 1e-9]
        head = [np.array([self.inlet, 0.0])]
        if s[0, 1] > 1e-12:
            head.append(np.array([self.walls[-1][0], 0.0]))
        return head, back

    def mesh(self, s):
        head, back = self.outline(s)
        points = np.array(head + list(s) + back)
        size = np.full(len(points), self.h)
        step = np.linalg.norm(np.diff(s, axis=0), axis=1)
        k = len(head)
        local = np.minimum(np.r_[step[0], step], np.r_[step, step[-1]])
        size[k:k + len(s)] = local
        for i in range(k + len(s), len(points)):
            corner = abs(points[i] - [0, 0.5]).max() < 1e-9
            size[i] = 2 * self.fine if corner else self.h
        gmsh.clear()
        g = gmsh.model.geo
        tags = [g.addPoint(p[0], p[1], 0, c) for p, c in zip(points, size)]
        lines = [g.addLine(a, b) for a, b in zip(tags, tags[1:] + tags[:1])]
        for i in range(k, k + len(s) - 1):
            g.mesh.setTransfiniteCurve(lines[i], 2)
        g.addPlaneSurface([g.addCurveLoop(lines)])
        g.synchronize()
        gmsh.model.mesh.generate(2)
        tag, xyz, _ = gmsh.model.mesh.getNodes()
        x = xyz.reshape(-1, 3)[:, :2]
        number = np.zeros(int(tag.max()) + 1, int)
        number[tag.astype(int)] = np.arange(len(tag))
        kinds, _, nodes = gmsh.model.mesh.getElements(2)
        tri = number[nodes[0].astype(int)].reshape(-1, 3)
        area = np.cross(np.c_[x[tri[:, 1]] - x[tri[:, 0]], np.zeros(len(tri))], np.c_[x[tri[:, 2]] - x[tri[:, 0]], np.zeros(len(tri))])[:, 2]
        tri[area < 0] = tri[area < 0][:, [0, 2, 1]]
        return x, tri

    def solve(self, s):
        """Velocity at the surface's points, pressure at the inlet over the developed gradient, volume."""
        x, tri = self.mesh(s)
        edges = np.sort(np.concatenate([tri[:, [1, 2]], tri[:, [2, 0]], tri[:, [0, 1]]]), axis=1)
        unique, which, count = np.unique(edges, axis=0, return_inverse=True, return_counts=True)
        nv = len(x)
        mids = x[unique].mean(1)
        xx = np.concatenate([x, mids, x[tri].mean(1)])
        cells = np.concatenate([tri, nv + which.reshape(3, -1).T, (nv + len(mids) + np.arange(len(tri)))[:, None]], axis=1)
        rim = np.zeros(len(xx), bool)
        rim[nv:nv + len(mids)] = count == 1
        rim[unique[count == 1].ravel()] = True
        at = np.flatnonzero(rim)
        fixed = np.zeros(xx.shape, bool)
        values = np.zeros(xx.shape)
        inlet = at[abs(xx[at, 0] - self.inlet) < 1e-9]
        axis = at[abs(xx[at, 1]) < 1e-9]
        fixed[axis, 1] = True
        fixed[inlet] = True
        values[inlet, 0], gradient = developed(xx[inlet])
        wall = at[self.nearest(xx[at])[0] < 1e-9]
        fixed[wall] = True
        values[wall] = 0
        u, held, volume, div = stokes.flow(xx, cells, fixed, values, SHAPES)
        pressure = (held[inlet, 0] * u[inlet, 0]).sum() / 0.5 / gradient
        near = [np.argmin(((x - p) ** 2).sum(1)) for p in s]
        return u[near], pressure, volume / 0.5

    def stick(self, s):
        """Points that reached a wall stick to it; the contact line is the innermost of a run from an end."""
        distance, q, _ = self.nearest(s)
        outside = ~self.inside(s)
        hit = (distance < self.touch) | outside
        # past the narrow wall's end a point belongs to that wall, not to the step beyond: the contact line waits at the edge
        edge = hit & (s[:, 0] < self.touch) & (s[:, 1] < 0.5 + 5 * self.touch) & (s[:, 1] > 0.5 - self.touch)
        q = np.where(edge[:, None], np.c_[np.minimum(s[:, 0], 0), np.full(len(s), 0.5)], q)
        s = np.where(hit[:, None], q, s)
        last = len(s) - 1
        while last > 1 and hit[last - 1]:
            last -= 1
        first = 0
        if hit[0] or s[0, 1] > 1e-12:
            while hit[first + 1]:
                first += 1
        s = s[first:last + 1].copy()
        if len(self.walls) > 2 and -2 * self.fine < s[-1, 0] < 0 and s[-2, 0] > 0:
            s[-1] = [0, 0.5]
        self.split = hit[first + 1:last].any()
        return s

    def inside(self, s):
        wide = self.walls[-1][0] if self.walls[-1][1] == 0 else np.inf
        top = np.where(s[:, 0] <= 0, 0.5, self.walls[:, 1].max()) if len(self.walls) > 2 else 0.5
        return (s[:, 1] <= top) & (s[:, 0] <= wide)

    def spread(self, s):
        """The surface's points anew along a spline, close together beside its contact lines."""
        t = np.r_[0, np.cumsum(np.linalg.norm(np.diff(s, axis=0), axis=1))]
        curve = CubicSpline(t, s)
        grow = 0.2
        size = lambda a: np.minimum(self.h, self.fine + grow * np.minimum(t[-1] - a, a if s[0, 1] > 1e-12 else np.inf))
        grid = np.linspace(0, t[-1], 4000)
        density = np.r_[0, np.cumsum(np.diff(grid) / size(0.5 * (grid[1:] + grid[:-1])))]
        new = curve(np.interp(np.linspace(0, density[-1], max(4, round(density[-1])) + 1), density, grid))
        new[0], new[-1] = s[0], s[-1]
        if s[0, 1] <= 1e-12:
            new[0, 1] = 0
        return new

def area(scene, s):
    head, back = scene.outline(s)
    p = np.array(head + list(s) + back)
    q = np.roll(p, -1, axis=0)
    return (p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0]).sum()  # twice the half: per width H

def run(scene, start, end, dt, every):
    gmsh.initialize()
    gmsh.option.setNumber("General.Verbosity", 1)
    y = np.linspace(0, 0.5, 40)
    s = scene.spread(np.c_[np.full(40, start), y])
    t = 0.0
    volume0 = area(scene, s)
    for k in range(round(end / dt) + 1):
        u, p, v = scene.solve(s)
        if k % every == 0:
            print(",".join(f"{x:.5f}" for x in [v + scene.inlet, p + scene.inlet, *s[0], *s[-1], s[:, 1].max()]), flush=True)
        half = s + 0.5 * dt * u
        # just before a point reaches a wall its half step may lie beyond it: that step is of first order
        um = scene.solve(half)[0] if scene.inside(half).all() else u
        s = scene.stick(s + dt * um)
        if scene.split or len(s) < 5:
            print("the surface meets a wall away from its contact lines", file=sys.stderr)
            break
        t += dt
        # what sticking and the spline change is given back along the normals
        s = scene.spread(s)
        for _ in range(2):
            lack = (volume0 + t - area(scene, s)) * 0.5
            tangent = np.gradient(s, axis=0)
            normal = np.c_[tangent[:, 1], -tangent[:, 0]]
            normal /= np.linalg.norm(normal, axis=1)[:, None]
            ds = np.linalg.norm(np.diff(s, axis=0), axis=1)
            weight = np.ones(len(s)); weight[-1] = 0
            weight[0] = 1 if s[0, 1] <= 1e-12 else 0
            normal[0] = [1, 0] if s[0, 1] <= 1e-12 else normal[0]
            s = s + (weight * lack / (0.5 * (weight[1:] + weight[:-1]) * ds).sum())[:, None] * normal
    gmsh.finalize()


def chamber(h, depth, inlet=-2.5):
    walls = [[inlet, 0.5], [0, 0.5], [0, 1], [depth, 1], [depth, 0]]
    return Scene(inlet, walls, h, h / 8, 0.001)

def straight(h, inlet=-1.3):
    return Scene(inlet, [[inlet, 0.5], [9, 0.5]], h, h / 8, 0.001)

if __name__ == "__main__":
    what, h, dt, end = sys.argv[1], *map(float, sys.argv[2:5])
    every = max(1, round(0.08 / dt))
    if what == "slit":
        run(straight(h), 0.0, end, dt, every)
    else:
        run(chamber(h, float(what)), -1.2, end, dt, every)
