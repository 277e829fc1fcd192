"""Stokes flow by finite elements: quadratic velocity, linear pressure within each element (Q2/P1, hexahedra or quads).

    -div(2 D(u) - p) = 0, div u = 0, D the symmetric gradient, viscosity 1.

Velocities are given at some unknowns; everywhere else the boundary is free of stress.
The pressure is eliminated by augmentation (iterated penalty), so one symmetric positive matrix is factorised.
"""
import itertools

import numpy as np
import scipy.sparse as sp
from pypardiso import PyPardisoSolver

PENALTY = 3e4


def tables(d):
    """Shape functions (point, node), their gradients (point, node, axis) and weights of quadratic elements in d dimensions."""
    g, w = np.polynomial.legendre.leggauss(3)
    n1 = np.array([g * (g - 1) / 2, 1 - g * g, g * (g + 1) / 2]).T
    d1 = np.array([g - 0.5, -2 * g, g + 0.5]).T
    points = list(itertools.product(range(3), repeat=d))
    product = lambda parts: np.prod(np.array(parts), axis=0)
    n = np.array([[product([n1[q[a], i[a]] for a in range(d)]) for i in points] for q in points])
    dn = np.array([[[product([(d1 if a == b else n1)[q[a], i[a]] for a in range(d)]) for b in range(d)] for i in points] for q in points])
    return n, dn, np.array([product(w[list(q)]) for q in points])


def cells_of(shape):
    """Node numbers of the elements of a block of nodes of that shape (odd numbers of nodes)."""
    ids = np.arange(np.prod(shape)).reshape(shape)
    d = len(shape)
    parts = [ids[tuple(slice(o, s - 2 + o, 2) for o, s in zip(off, shape))].ravel() for off in itertools.product(range(3), repeat=d)]
    return np.array(parts).T


def factor(matrix):
    """A solver for a symmetric positive matrix given by its upper triangle."""
    solver = PyPardisoSolver(mtype=2)
    solver.factorize(matrix)
    return solver


def flow(x, cells, fixed, values, round=False):
    """Velocity (node, axis), the forces that hold the fixed unknowns (node, axis), volume, and div u at its worst.

    x: nodes; cells: nodes of each element; fixed: mask (node, axis); values: velocities there; round: around the first axis, whose distance
    is the second one, and what is summed is that of a radian."""
    nodes, d = x.shape
    n, dn, w = tables(d)
    nv = n.shape[1]
    xe = x[cells]
    jac = np.einsum("eia,qib->eqab", xe, dn)
    det = np.linalg.det(jac)
    if det.min() <= 0:
        raise ValueError(f"an element is turned inside out: {det.min()}")
    grad = np.einsum("qib,eqba->eqia", dn, np.linalg.inv(jac))
    at = np.einsum("qi,eia->eqa", n, xe)
    wd = w * det * (at[..., 1] if round else 1)
    weighted = grad * wd[..., None, None]
    # pressure functions: 1 and the coordinates off the element's middle
    volume = wd.sum(1)
    off = at - (np.einsum("eq,eqa->ea", wd, at) / volume[:, None])[:, None]
    off /= (np.ptp(xe, axis=1))[:, None]
    m = np.concatenate([np.ones(off.shape[:2] + (1,)), off], axis=2)
    mass = np.linalg.inv(np.einsum("eq,eqk,eql->ekl", wd, m, m))
    b = np.einsum("eqk,eqia->ekia", m, weighted)
    if round:
        hoop = n / at[..., 1:] * wd[..., None]
        b[..., 1] += np.einsum("eqk,eqi->eki", m, hoop)
    b = b.reshape(len(cells), d + 1, nv * d)
    lap = np.einsum("eqia,eqja->eij", weighted, grad, optimize=True)
    local = np.einsum("eqjb,eqia->eibja", weighted, grad, optimize=True)
    # row (i, b), column (j, a): d_b(phi_j) d_a(phi_i)
    for a in range(d):
        local[:, :, a, :, a] += lap
    if round:
        local[:, :, 1, :, 1] += 2 * np.einsum("eqi,qj,eq->eij", hoop, n, 1 / at[..., 1])
    local = local.reshape(len(cells), nv * d, nv * d)
    mb = mass @ b
    dofs = (cells[:, :, None] * d + np.arange(d)).reshape(len(cells), -1)
    u = np.where(fixed, values, 0.0).ravel()
    free = ~fixed.ravel()
    number = np.cumsum(free) - 1
    full = local + PENALTY * np.einsum("eki,ekj->eij", b, mb, optimize=True)
    load = np.zeros(nodes * d)
    np.add.at(load, dofs, -np.einsum("eij,ej->ei", full, u[dofs]))
    rows, cols = np.broadcast_arrays(number[dofs][:, :, None], number[dofs][:, None, :])
    keep = free[dofs][:, :, None] & free[dofs][:, None, :] & (rows <= cols)
    matrix = sp.csr_matrix((full[keep], (rows[keep], cols[keep])), shape=(free.sum(),) * 2)
    del full, rows, cols, keep
    solver = factor(matrix)
    p = np.zeros((len(cells), d + 1))
    for _ in range(8):
        # the load of the pressure so far: + B^T p
        force = load.copy()
        np.add.at(force, dofs, np.einsum("eki,ek->ei", b, p))
        u[free] = solver.solve(matrix, force[free])
        change = PENALTY * np.einsum("eki,ei->ek", mb, u[dofs])
        p -= change
        divergence = abs(change[:, 0]).max() / PENALTY
        if divergence < 1e-10:
            break
    solver.free_memory()
    held = np.zeros(nodes * d)
    np.add.at(held, dofs, np.einsum("eij,ej->ei", local, u[dofs]) - np.einsum("eki,ek->ei", b, p))
    return u.reshape(nodes, d), held.reshape(nodes, d), volume.sum(), divergence
