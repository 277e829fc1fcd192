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

/// The pieces of a section of rows of `width` in which one value hangs together, by edges of pixels or by `corners` too: the
/// value and the places of each.
pub fn pieces<T: Copy + PartialEq>(
    section: &[T],
    width: usize,
    corners: bool,
) -> Vec<(T, Vec<usize>)> {
    let mut seen = vec![false; section.len()];
    let mut found = Vec::new();
    for start in 0..section.len() {
        if std::mem::replace(&mut seen[start], true) {
            continue;
        }
        let mut piece = vec![start];
        let mut next = 0;
        while let Some(&i) = piece.get(next) {
            next += 1;
            let (x, y) = (i % width, i / width);
            for v in y.saturating_sub(1)..(y + 2).min(section.len() / width) {
                let beside = x.saturating_sub(1)..(x + 2).min(width);
                let beside = beside.filter(|u| corners || *u == x || v == y);
                let alike = beside.map(|u| v * width + u);
                let alike = alike.filter(|at| section[*at] == section[start]);
                piece.extend(alike.filter(|at| !std::mem::replace(&mut seen[*at], true)));
            }
        }
        found.push((section[start], piece));
    }
    found
}
