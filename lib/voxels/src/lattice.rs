//! Voxels of a lattice, x fastest.

use particle_file::BitsRef;

pub(crate) type Voxel = [usize; 3];

/// All voxels of a lattice.
pub(crate) fn voxels([nx, ny, nz]: Voxel) -> impl Iterator<Item = Voxel> {
    (0..nz).flat_map(move |z| (0..ny).flat_map(move |y| (0..nx).map(move |x| [x, y, z])))
}

/// The voxels that are set.
pub(crate) fn set_voxels(bits: BitsRef<'_>) -> impl Iterator<Item = Voxel> {
    let [_, ny, nz] = bits.dims();
    let rows = (0..nz).flat_map(move |z| (0..ny).map(move |y| (y, z)));
    rows.flat_map(move |(y, z)| bits.set_in_row(y, z).map(move |x| [x, y, z]))
}

/// A voxel and its neighbours by faces, edges and corners, as far as the lattice reaches.
pub(crate) fn around(voxel: Voxel, dims: Voxel) -> impl Iterator<Item = Voxel> {
    let [xs, ys, zs] =
        std::array::from_fn(|a| voxel[a].saturating_sub(1)..(voxel[a] + 2).min(dims[a]));
    zs.flat_map(move |z| {
        let xs = xs.clone();
        ys.clone()
            .flat_map(move |y| xs.clone().map(move |x| [x, y, z]))
    })
}
