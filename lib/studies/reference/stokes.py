"""Plane Stokes flow in half of a reservoir and its slit: mesh and Taylor-Hood elements.

Units: slit width H = 1, mean speed in the slit U = 1, viscosity 1, so the pressure of developed
flow falls by 12 per width. x = 0 is the mid plane; the slit is 0 < x < 1/2, y > 0, up to its
front; the reservoir 0 < x < 2, -depth < y < 0; the piston is its lower side.
"""

import gmsh
import numpy as np
from scipy.sparse import bmat, coo_matrix
from scipy.sparse.linalg import splu
from scipy.spatial import cKDTree

AXIS, PISTON, SIDE, WALL, FRONT = range(5)
SLOPE = 12.0  # of the pressure in developed flow
PISTON_SPEED = 0.25  # the reservoir is four slits wide
SEAL = 1 / 24  # length over which a side that the liquid sticks to gives way to the piston
GRADING = 0.15  # growth of the elements' size with the distance


def start():
    """Gmsh, quiet, with sizes by the field alone."""
    gmsh.initialize()
    for option in ["General.Terminal", "Mesh.MeshSizeFromPoints", "Mesh.MeshSizeExtendFromBoundary"]:
        gmsh.option.setNumber(option, 0)


def outline(depth, front):
    """Curves of the domain by what bounds it; the front's vertices are mesh vertices."""
    geo = gmsh.model.geo
    nodes = [geo.addPoint(*p, 0.0) for p in front]
    inside = front[-1, 1] > 1e-9
    ring = [(AXIS, geo.addPoint(0.0, -depth, 0.0)), (PISTON, geo.addPoint(2.0, -depth, 0.0))]
    ring += [(SIDE, geo.addPoint(2.0, 0.0, 0.0))]
    ring += [(WALL, geo.addPoint(0.5, 0.0, 0.0))] if inside else []
    ring += [(WALL, nodes[-1])] + [(FRONT, n) for n in nodes[-2::-1]]
    curves, lines, previous = {tag: [] for tag in range(5)}, [], nodes[0]
    for tag, point in ring:
        lines.append(geo.addLine(previous, point))
        curves[tag].append(lines[-1])
        previous = point
    for line in curves[FRONT]:
        geo.mesh.setTransfiniteCurve(line, 2)
    geo.addPlaneSurface([geo.addCurveLoop(lines)])
    geo.synchronize()
    return curves


def grade(depth, front, size):
    """Element sizes: small at the slit's corner, the contact line and the piston's corner."""
    places = [((0.5, 0.0), "entrance"), (front[-1], "contact"), ((2.0, -depth), "seal")]
    parts = [f"{size[s]}+{GRADING}*sqrt((x-({p[0]}))^2+(y-({p[1]}))^2)" for p, s in places]
    parts.append(f"{size['far']}+{GRADING}*Max(0,-y)")
    parts.append(f"{size['front']}+{GRADING}*Fabs(y-({front[:, 1].mean()}))")
    least = parts[0]
    for part in parts[1:]:
        least = f"Min({least},{part})"
    field = gmsh.model.mesh.field.add("MathEval")
    gmsh.model.mesh.field.setString(field, "F", least)
    gmsh.model.mesh.field.setAsBackgroundMesh(field)


class Mesh:
    """Triangles of six nodes: corners first, then the middles of the sides."""

    def __init__(self, depth, front, size):
        gmsh.model.add("slit")
        curves = outline(depth, front)
        grade(depth, front, size)
        mesh = gmsh.model.mesh
        mesh.generate(2)
        mesh.setOrder(2)
        tags, places, _ = mesh.getNodes()
        elements = mesh.getElements(2)[2][0]
        used = np.unique(elements)
        number = np.full(int(tags.max()) + 1, -1)
        number[used] = np.arange(len(used))
        self.x = np.zeros((len(used), 2))
        kept = number[tags] >= 0
        self.x[number[tags[kept]]] = places.reshape(-1, 3)[kept, :2]
        self.t = number[elements.reshape(-1, 6)]
        of_line = lambda line: number[mesh.getElements(1, line)[2][0]]
        self.on = {tag: np.unique(np.concatenate([of_line(c) for c in group])) for tag, group in curves.items()}
        gmsh.model.remove()
        self.front = cKDTree(self.x).query(front)[1]
        # Pressures stand at the corners.
        self.corners = np.unique(self.t[:, :3])
        self.p_of = np.full(len(self.x), -1)
        self.p_of[self.corners] = np.arange(len(self.corners))

    def locate(self, x):
        """Triangle and barycentric coordinates of the nearest places in the mesh."""
        near = cKDTree(self.x[self.t[:, :3]].mean(1)).query(x, k=16)[1]
        a, b, c = (self.x[self.t[near, i]] for i in range(3))
        cross = lambda u, v: u[..., 0] * v[..., 1] - u[..., 1] * v[..., 0]
        r, whole = x[:, None] - a, cross(b - a, c - a)
        l1, l2 = cross(r, c - a) / whole, cross(b - a, r) / whole
        bary = np.stack([1 - l1 - l2, l1, l2], -1)
        row, best = np.arange(len(x)), bary.min(-1).argmax(1)
        bary = np.clip(bary[row, best], 0.0, 1.0)
        return near[row, best], bary / bary.sum(1, keepdims=True)

    def velocity_at(self, u, x):
        """Velocity at places; at the nearest of the mesh outside it."""
        e, bary = self.locate(x)
        l0, l1, l2 = bary.T
        shape = [l0 * (2 * l0 - 1), l1 * (2 * l1 - 1), l2 * (2 * l2 - 1), 4 * l0 * l1, 4 * l1 * l2, 4 * l2 * l0]
        return np.einsum("ei,eia->ea", np.stack(shape, 1), u[self.t[e]])

    def pressure_at(self, p, x):
        """Pressure at places; at the nearest of the mesh outside it."""
        e, bary = self.locate(x)
        return (p[self.p_of[self.t[e, :3]]] * bary).sum(1)


def assemble(mesh):
    """Viscous matrix 2 D(u):D(w), divergence and mass matrix of the pressures."""
    x, t = mesh.x, mesh.t
    n, m = len(x), len(mesh.corners)
    a, b, c = (x[t[:, i]] for i in range(3))
    det = (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0])
    assert (det > 0).all(), "a triangle is inside out"
    gradient = np.stack([np.stack([q[:, 1] - r[:, 1], r[:, 0] - q[:, 0]], 1) for q, r in [(b, c), (c, a), (a, b)]], 1)
    gradient /= det[:, None, None]
    # Three points are exact for the degree two of every integrand.
    points, weight = np.full((3, 3), 1 / 6) + np.eye(3) / 2, det / 6
    stiff, div = np.zeros((len(t), 2, 2, 6, 6)), np.zeros((len(t), 2, 3, 6))
    for l in points:
        d = np.zeros((len(t), 6, 2))
        for i in range(3):
            j = (i + 1) % 3
            d[:, i] = (4 * l[i] - 1) * gradient[:, i]
            d[:, 3 + i] = 4 * (l[i] * gradient[:, j] + l[j] * gradient[:, i])
        both = weight[:, None, None, None, None] * np.einsum("eia,ejb->eabij", d, d)
        for i in range(2):
            div[:, i] += weight[:, None, None] * l[None, :, None] * d[:, None, :, i]
            for j in range(2):
                stiff[:, i, j] += both[:, j, i] + (both[:, 0, 0] + both[:, 1, 1] if i == j else 0)
    corner = mesh.p_of[t[:, :3]]

    def matrix(v, rows, columns, shape):
        r, c = np.broadcast_arrays(rows[:, :, None], columns[:, None, :])
        return coo_matrix((v.ravel(), (r.ravel(), c.ravel())), shape)

    viscous = bmat([[matrix(stiff[:, i, j], t, t, (n, n)) for j in range(2)] for i in range(2)]).tocsr()
    divergence = bmat([[matrix(div[:, i], corner, t, (m, n)) for i in range(2)]]).tocsr()
    mass = matrix(weight[:, None, None] * (points.T @ points), corner, corner, (m, m)).tocsr()
    return viscous, divergence, mass


def walls(mesh, sides):
    """Given velocities, x then y, and which are given; the sides stick or are mirrors."""
    n = len(mesh.x)
    value, fixed = np.zeros(2 * n), np.zeros(2 * n, bool)

    def fix(tag, axis, speed):
        value[mesh.on[tag] + axis * n], fixed[mesh.on[tag] + axis * n] = speed, True

    fix(AXIS, 0, 0.0)
    fix(SIDE, 0, 0.0)
    if sides == "stick":
        height = mesh.x[mesh.on[SIDE], 1] - mesh.x[mesh.on[PISTON], 1].min()
        fix(SIDE, 1, PISTON_SPEED * np.clip(1 - height / SEAL, 0, 1))
    for axis in range(2):
        fix(WALL, axis, 0.0)
        fix(PISTON, axis, PISTON_SPEED * axis)
    return value, fixed


def stokes(mesh, sides, gives, back, source=None):
    """Velocity (nodes, 2), pressure (corners), force on the piston over that of one filled width
    (by virtual work) and the rate at which volume goes.

    gives: 1/(K dt) at the corners; back: pressure that the same liquid had dt ago; source:
    rate of volume per area, instead of these."""
    n, m = len(mesh.x), len(mesh.corners)
    viscous, divergence, mass = assemble(mesh)
    value, fixed = walls(mesh, sides)
    squeeze = mass.multiply(np.broadcast_to(0.0 if source is not None else gives, m)[None, :])
    source = -gives * back if source is None else source
    free = np.flatnonzero(~fixed)
    inner = divergence[:, free]
    whole = bmat([[viscous[free][:, free], -inner.T], [-inner, -squeeze]]).tocsc()
    right = np.concatenate([-(viscous @ value)[free], divergence @ value + mass @ source])
    factors = splu(whole, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=1e-3, options={"SymmetricMode": True})
    solved = factors.solve(right)
    value[free], p = solved[: len(free)], solved[len(free) :]
    reaction = viscous @ value - divergence.T @ p
    rate = (mass @ source + squeeze @ p).sum()
    return value.reshape(2, n).T, p, reaction[n + mesh.on[PISTON]].sum() / (2.0 * SLOPE), rate
