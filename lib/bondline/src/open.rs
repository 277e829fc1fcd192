//! The voids of wood that are open to a layer of it.

use particle_file::{BitGrid, BitsRef};
use units::Axis;

/// The voids that paths through faces between voxels connect to those of `layer` across `normal`.
///
/// Liquid gets from one adherend to the other through the bond plane only, so each can be looked at
/// alone, from its layer there: the last of the lower, the first of the upper.
///
/// # Panics
/// When there is no such layer.
pub fn open_voids(wood: BitsRef, normal: Axis, layer: usize) -> BitGrid {
    let dims = wood.dims();
    let n = normal.index();
    assert!(layer < dims[n], "a layer outside the wood");
    let mut found = BitGrid::new(dims);
    let mut front: Vec<[usize; 3]> = Vec::new();
    let mut visit = |at: [usize; 3], front: &mut Vec<[usize; 3]>| {
        let [x, y, z] = at;
        if !found.get(x, y, z) && !wood.get(x, y, z) {
            found.set(x, y, z, true);
            front.push(at);
        }
    };
    let mut seeds = dims.map(|d| 0..d);
    seeds[n] = layer..layer + 1;
    let [xs, ys, zs] = seeds;
    for z in zs {
        for y in ys.clone() {
            for x in xs.clone() {
                visit([x, y, z], &mut front);
            }
        }
    }
    while let Some(at) = front.pop() {
        for a in 0..3 {
            let mut beside = at;
            if at[a] > 0 {
                beside[a] = at[a] - 1;
                visit(beside, &mut front);
            }
            if at[a] + 1 < dims[a] {
                beside[a] = at[a] + 1;
                visit(beside, &mut front);
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sealed_lumen_is_not_open_and_an_edge_is_no_way() {
        // A channel along y at x = 5, a bend from it, a sealed lumen, and one that it meets at an edge only.
        let void = |x: usize, y: usize, z: usize| {
            z == 1 && (x == 5 && y >= 1 || y == 2 && x == 6 || x == 2 && y == 2 || x == 4 && y == 0)
        };
        let wood = BitGrid::from_fn([8, 5, 3], |x, y, z| !void(x, y, z));
        let open = open_voids(wood.view(), Axis::Y, 4);
        let counts = open.view().counts_along(1);
        assert_eq!(counts, [0, 1, 2, 1, 1]);
        assert!(open.get(6, 2, 1) && !open.get(2, 2, 1) && !open.get(4, 0, 1));
        let none = open_voids(wood.view(), Axis::X, 0);
        assert_eq!(none.count(), 0);
    }
}
