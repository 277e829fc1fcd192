"""Particle files of bondline as NumPy arrays.

    state = bondline.read("final.mpts")
    state.points["position"]    # (n, 3), m
    state.labels                # (nz, ny, nx): VOID, WOOD, ADHESIVE
    state.units["pressure"]     # "Pa"

The bytes are described in lib/particle-file/FORMAT.md; mpts.py reads them.
"""
from dataclasses import dataclass

import numpy as np

from . import mpts

VOID, WOOD, ADHESIVE = 0, 128, 255
KINDS = ["specimen", "bond", "state", "checkpoint"]
UNITS = {
    "position": "m",
    "velocity": "m/s",
    "volume": "m3",
    "pressure": "Pa",
    "shear_rate": "1/s",
}


@dataclass(frozen=True)
class Block:
    """Voxels that move as a whole: `bits[z, y, x]` tells where its material is."""

    bits: np.ndarray
    origin: tuple  # low corner (x, y, z), m
    voxel: float  # edge, m
    label: int  # WOOD or ADHESIVE


@dataclass(frozen=True)
class State:
    """What a particle file holds. Lengths are in m, vectors are (x, y, z)."""

    kind: str  # one of KINDS
    voxel: float  # edge, m
    normal: str  # axis across the bond: "x", "y" or "z"
    box: tuple  # low and high corner, m
    time: float  # s
    step: int
    attributes: dict  # texts by name; numbers in SI
    blocks: dict  # Block by name
    points: dict  # arrays by name, a row for each point of liquid or voxel of adhesive
    units: dict  # of `points`, by name
    arrays: dict  # all arrays of the file, as it has them

    @property
    def labels(self):
        """Wood and voxels of adhesive as labels (nz, ny, nx) of the box around the blocks.

        The liquid of a state is in `points` and in no voxel: `particles export -f tiff` puts it
        there by its volume. A block between two places lies at the nearer one.
        """
        blocks = self.blocks.values()
        low = np.min([b.origin for b in blocks], axis=0)
        high = np.max([np.array(b.origin) + np.array(b.bits.shape[::-1]) * b.voxel for b in blocks], axis=0)
        dims = np.rint((high - low) / self.voxel).astype(int)
        labels = np.full(dims[::-1], VOID, np.uint8)
        for block in blocks:
            shift = np.rint((np.array(block.origin) - low) / self.voxel).astype(int)
            start = np.minimum(shift, dims - block.bits.shape[::-1])[::-1]
            place = tuple(slice(s, s + n) for s, n in zip(start, block.bits.shape))
            labels[place][block.bits] = block.label
        return labels


def read(path):
    """The `State` in the file at `path`; arrays are mapped, not copied."""
    header, arrays = mpts.read(path)
    blocks = {
        name: Block(arrays[name], origin, voxel, (WOOD, ADHESIVE)[material])
        for name, material, _, origin, voxel, _ in header["blocks"]
    }
    columns = {n: a for n, a in arrays.items() if n not in blocks and a.dtype != np.uint8}
    if header["kind"] in (0, 1):
        columns = _centres(blocks["adhesive"])
    return State(
        kind=KINDS[header["kind"]],
        voxel=header["voxel_m"],
        normal="xyz"[header["normal"]],
        box=(header["box_min_m"], header["box_max_m"]),
        time=header["time_s"],
        step=header["step"],
        attributes=header["attributes"],
        blocks=blocks,
        points={n: a[:, 0] if a.shape[1] == 1 else a for n, a in columns.items()},
        units={n: UNITS[n] for n in columns if n in UNITS},
        arrays=arrays,
    )


def _centres(block):
    """Adhesive before it flows: a point at the centre of each of its voxels."""
    indices = np.column_stack(np.nonzero(block.bits)[::-1])
    volume = np.full((len(indices), 1), block.voxel**3)
    return {"position": np.array(block.origin) + (indices + 0.5) * block.voxel, "volume": volume}
