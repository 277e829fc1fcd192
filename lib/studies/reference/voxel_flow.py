"""Permeability of voxels by lbmpy, a public lattice Boltzmann code: TRT, D3Q19, walls half way between nodes.

    voxel_flow.py VOXELS FRACTION SPLIT...
    voxel_flow.py acer STACK SPLIT...

Splits each voxel into so many along each axis and prints the permeability of each split, of spheres over that of
smooth ones (Zick & Homsy 1982), along the grain of wood in squares of a voxel's edge, and what they converge to."""

import sys

import numpy as np
import pystencils as ps
from lbmpy import ForceModel, LBMConfig, LBMOptimisation, LBStencil, Method, Stencil
from lbmpy.boundaries import NoSlip
from lbmpy.lbstep import LatticeBoltzmannStep

DRAG = {0.064: 2.810, 0.125: 4.292, 0.216: 7.442, 0.343: 15.4, 0.45: 28.1}
NU = 1.2  # the steady flow of TRT does not depend on it
EDGE = 1.0888  # power of the error: twice the exponent of Stokes flow across an edge of 270 degrees, 0.5444


def permeability(solid, split, every, tolerance=1e-5):
    """Mean velocity along the first axis times viscosity over body force, in squares of a voxel's edge."""
    for axis in range(3):
        solid = np.repeat(solid, split, axis=axis)
    force = 1e-5 / split**2
    flow = LBMConfig(
        stencil=LBStencil(Stencil.D3Q19), method=Method.TRT, relaxation_rate=1 / (3 * NU + 0.5), compressible=False,
        zero_centered=True, force_model=ForceModel.GUO, force=(force, 0.0, 0.0),
    )
    kernel = ps.CreateKernelConfig(target=ps.Target.CurrentCPU, default_dtype=np.float32)
    kernel.cpu.vectorize.enable = kernel.cpu.vectorize.assume_inner_stride_one = True
    data = ps.create_data_handling(solid.shape, periodicity=True, default_target=ps.Target.CPU)
    step = LatticeBoltzmannStep(data_handling=data, lbm_config=flow, lbm_optimisation=LBMOptimisation(), config=kernel)
    # Layers beyond the box are asked for too and are the other side's.
    inside = lambda *x: solid[tuple(np.floor(c).astype(int) % n for c, n in zip(x, solid.shape))]
    step.boundary_handling.set_boundary(NoSlip(), mask_callback=inside)
    step.boundary_handling.prepare()
    found = []
    while True:
        step.run(every * split**2)
        # lbmpy's getter adds half of the force to a momentum that has all of it already.
        u = np.nan_to_num(np.ma.filled(np.asarray(step.velocity[:, :, :, 0], np.float64), 0.0)) - force
        found.append(np.where(solid, 0.0, u).sum() / solid.size * NU / force / split**2)
        if len(found) > 2:
            last, before = found[-1] - found[-2], found[-2] - found[-3]
            ratio = last / before if before else 0.0
            rest = last * ratio / (1 - ratio) if 0 < ratio < 1 else 0.0
            if max(abs(rest), abs(last)) < tolerance * found[-1]:
                return found[-1] + rest


# Of the change from one voxel to a split in two, what is still to come; from 16 voxels, split up to 4.
REST = {0.064: 0.867, 0.125: 0.878, 0.216: 0.849, 0.343: 0.815, 0.45: 0.796}


def limit(found, rest):
    """What values by split converge to: powers EDGE and 2 taken out of the three finest, or `rest` of the
    change from 1 to 2."""
    if len(found) > 2:
        finest = sorted(found)[-3:]
        table = [[1.0, split**-EDGE, split**-2.0] for split in finest]
        return np.linalg.solve(table, [found[split] for split in finest])[0]
    return found[2] - rest * (found[1] - found[2])


def sphere(voxels, fraction):
    """A sphere in the middle of a cube, and its radius in voxels."""
    x = np.arange(voxels) + 0.5 - voxels / 2
    radius = (0.75 * fraction / np.pi) ** (1 / 3) * voxels
    return x[:, None, None] ** 2 + x[:, None] ** 2 + x**2 < radius**2, radius


def acer(stack):
    """The wood that lib/studies/src/verification/grain.rs takes, the grain along the first axis."""
    from tifffile import imread

    return imread(stack)[:48, 24:72, 40:88] == 128


def main(what, of, *splits):
    if what == "acer":
        solid, unit, rest, found = acer(of), 1.0, np.nan, {}
    else:
        voxels, fraction = int(what), float(of)
        solid, radius = sphere(voxels, fraction)
        unit, rest, found = voxels**3 / (6 * np.pi * radius * DRAG[fraction]), REST[fraction], {}
    for split in map(int, splits):
        found[split] = permeability(solid, split, 20) / unit
        print(split, found[split], flush=True)
    if 1 in found and 2 in found:
        print("limit", limit(found, rest))


main(*sys.argv[1:])
