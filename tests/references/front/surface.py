"""A free surface as heights on a lattice of the cross-section, carried by the liquid.

    h_t + c . grad h = g,  streamline-upwind Galerkin, bilinear h, implicit in h with the liquid's velocity of now.

All lengths in the width H of the slit or duct, velocities in the mean inflow U, viscosity 1."""
import itertools

import numpy as np
import scipy.sparse as sp
import scipy.sparse.linalg as sla

import stokes


def developed(points, round=False):
    """Velocity of mean 1 in a slit, round tube (2-D) or square duct (3-D) of width 1 about the axis, and its pressure gradient."""
    y = points[:, 1]
    if round:
        return 2 * (1 - 4 * y * y), 32.0
    if points.shape[1] == 2:
        return 1.5 * (1 - 4 * y * y), 12.0
    z = points[:, 2]
    u, flux = np.zeros(len(y)), 0.0
    for k in range(1, 400, 2):
        b = k * np.pi
        sides = (np.exp(b * (z - 0.5)) + np.exp(-b * (z + 0.5))) / (1 + np.exp(-b))
        u += 4 / b**3 * (-1) ** ((k - 1) // 2) * np.cos(b * y) * (1 - sides)
        flux += 8 / b**4 * (1 - 2 / b * np.tanh(b / 2))
    return u / flux, 1 / flux


def graded(t, power):
    """Places of quadratic nodes between 0 and 1, close together at 0, middles in the middle."""
    s = t**power
    s[1::2] = 0.5 * (s[:-2:2] + s[2::2])
    return s


class Surface:
    """n elements over half a width in each of the d - 1 directions across, close together at the walls."""

    def __init__(self, d, n, power):
        self.d, self.n = d, n
        self.y = 0.5 * (1 - graded(1 - np.arange(2 * n + 1) / (2 * n), power))
        self.places = np.array(list(itertools.product(self.y, repeat=d - 1)))
        across = d - 1
        self.quadratic, _, self.weights = stokes.tables(across)
        g, _ = np.polynomial.legendre.leggauss(3)
        value = np.array([(1 - g) / 2, (1 + g) / 2]).T
        slope = np.array([-0.5 + 0 * g, 0.5 + 0 * g]).T
        points = list(itertools.product(range(3), repeat=across))
        corners = list(itertools.product(range(2), repeat=across))
        self.linear = np.array([[np.prod([value[q[a], i[a]] for a in range(across)]) for i in corners] for q in points])
        slopes = [[[np.prod([(slope if a == b else value)[q[a], i[a]] for a in range(across)]) for b in range(across)] for i in corners] for q in points]
        self.size = np.array(list(itertools.product(np.diff(self.y[::2]), repeat=across)))
        self.grad = 2 * np.array(slopes)[None] / self.size[:, None, None, :]
        ids = np.arange((n + 1) ** across).reshape((n + 1,) * across)
        self.corners = np.array([ids[tuple(slice(o, n + o) for o in off)].ravel() for off in corners]).T
        self.nodes = stokes.cells_of((2 * n + 1,) * across)

    def refine(self, f):
        """Heights at corners, and between them."""
        for axis in range(self.d - 1):
            f = np.moveaxis(f, axis, 0)
            g = np.empty((2 * f.shape[0] - 1,) + f.shape[1:])
            g[::2] = f
            g[1::2] = 0.5 * (f[1:] + f[:-1])
            f = np.moveaxis(g, 0, axis)
        return f

    def at_points(self, nodal):
        """Values at quadratic nodes (node, ...) at the quadrature points (element, point, ...)."""
        return np.einsum("qi,ei...->eq...", self.quadratic, nodal[self.nodes])

    def heights(self, f):
        return np.einsum("qi,ei->eq", self.linear, f.ravel()[self.corners])

    def carry(self, f, rates, dt, theta=1.0, weight=1.0, pinned=None):
        """Heights after dt by rates (g, c); weight: area of the surface's lattice; pinned: mask of heights that stay 0."""
        g, c = rates
        fe = f.ravel()[self.corners]
        along = np.einsum("eqa,eqia->eqi", c, self.grad)
        wd = self.weights * np.prod(self.size / 2, axis=1)[:, None] * weight
        tau = 1 / np.sqrt((2 / dt) ** 2 + ((2 * c / self.size[:, None, :]) ** 2).sum(-1))
        test = self.linear[None] + along * tau[..., None]
        local = np.einsum("eq,eqi,eqj->eij", wd, test, self.linear[None] / dt + theta * along)
        now = g + self.heights(f) / dt - (1 - theta) * np.einsum("eqi,ei->eq", along, fe)
        rows, cols = np.broadcast_arrays(self.corners[:, :, None], self.corners[:, None, :])
        matrix = sp.csr_matrix((local.ravel(), (rows.ravel(), cols.ravel())), shape=(f.size,) * 2)
        right = np.zeros(f.size)
        np.add.at(right, self.corners, np.einsum("eq,eqi,eq->ei", wd, test, now))
        free = np.ones(f.size, bool) if pinned is None else ~pinned.ravel()
        new = np.zeros(f.size)
        new[free] = sla.spsolve(matrix[free][:, free].tocsc(), right[free])
        return new.reshape(f.shape)


def channel_flow(shape, x, lattice, places, round=False):
    """Flow of a block of nodes: developed inflow at its first layer, mirrors at 0, walls at 0.5 of the lattice, free elsewhere.

    Returns velocity on the last layer, pressure at the inlet over the developed gradient, volume over the cross-section."""
    d = x.shape[1]
    fixed, values = np.zeros(x.shape, bool), np.zeros(x.shape)
    for a in range(1, d):
        fixed[lattice[:, a - 1] == 0, a] = True
        fixed[lattice[:, a - 1] == places[-1]] = True
    inlet = np.arange(len(x)) < np.prod(shape[1:])
    fixed[inlet] = True
    values[inlet, 0], gradient = developed(x[inlet], round)
    u, held, volume, _ = stokes.flow(x, stokes.cells_of(shape), fixed, values, round=round)
    area = 1 / 8 if round else 0.5 ** (d - 1)
    # the power put in, by the forces that hold the inflow: converges as energy does
    power = (held[inlet, 0] * u[inlet, 0]).sum()
    return u.reshape(tuple(shape) + (d,))[-1], power / area / gradient, volume / area
