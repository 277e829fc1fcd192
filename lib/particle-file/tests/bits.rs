//! Grids of bits: FORMAT.md, "Bits of a block".

use std::sync::atomic::{AtomicUsize, Ordering};

use particle_file::{BitGrid, BitsRef};

fn pattern(x: usize, y: usize, z: usize) -> bool {
    (x * 7 + y * 3 + z * 5) % 11 < 4
}

/// By rows, by voxels and by layers, against the words of rows put together voxel by voxel.
#[test]
fn all_accessors_of_a_bit_grid_agree() {
    for nx in [1, 63, 64, 65, 130] {
        let dims = [nx, 3, 4];
        let asked = AtomicUsize::new(0);
        let grid = BitGrid::from_fn(dims, |x, y, z| {
            assert!(x < nx, "asked for a voxel behind the end of its row");
            asked.fetch_add(1, Ordering::Relaxed);
            pattern(x, y, z)
        });
        assert_eq!(asked.into_inner(), nx * 3 * 4, "once for each voxel");
        let mut by_set = BitGrid::new(dims);
        let mut layers = [vec![0; nx], vec![0; 3], vec![0; 4]];
        let (mut all, mut indices) = (Vec::new(), Vec::new());
        for (y, z) in (0..4).flat_map(|z| (0..3).map(move |y| (y, z))) {
            let expected: Vec<usize> = (0..nx).filter(|&x| pattern(x, y, z)).collect();
            let mut words = vec![0; nx.div_ceil(64)];
            expected.iter().for_each(|x| words[x / 64] += 1 << (x % 64));
            assert_eq!((grid.row(y, z), grid.view().row(y, z)), (&*words, &*words));
            assert!(grid.view().set_in_row(y, z).eq(expected.iter().copied()));
            for x in 0..nx {
                by_set.set(x, y, z, true);
                by_set.set(x, y, z, pattern(x, y, z));
                assert_eq!(grid.get(x, y, z), pattern(x, y, z));
            }
            for x in expected {
                layers[0][x] += 1;
                layers[1][y] += 1;
                layers[2][z] += 1;
                indices.push([x, y, z]);
            }
            all.extend(words);
        }
        assert_eq!((&by_set, grid.dims()), (&grid, dims));
        assert_eq!(grid.count(), indices.len() as u64);
        let mut found = Vec::new();
        grid.view().for_each(|index| found.push(index));
        assert_eq!(found, indices);
        for (axis, layers) in layers.iter().enumerate() {
            let counts = grid.view().counts_along(axis);
            assert_eq!(&counts, layers, "nx {nx} axis {axis}");
        }
        assert_eq!((grid.words(), grid.view().words()), (&*all, &*all));
        assert_eq!(BitsRef::from_words(dims, &all), Some(grid.view()));
        assert_eq!(BitGrid::from_words(dims, all), Some(grid));
    }
}

#[test]
fn voxels_and_rows_outside_are_refused_and_neighbours_spared() {
    let mut grid = BitGrid::new([70, 2, 3]);
    for (x, value) in [(0, true), (63, true), (64, true), (69, true), (63, false)] {
        grid.set(x, 1, 1, value);
    }
    assert_eq!((grid.row(1, 1), grid.count()), (&[1, 1 | 1 << 5][..], 3));
    grid.row_mut(1, 2).copy_from_slice(&[5, 1]);
    assert_eq!((grid.row(0, 2), grid.row(1, 2)), (&[0, 0][..], &[5, 1][..]));
    let outside = |f: fn(&mut BitGrid)| {
        let mut grid = BitGrid::new([70, 2, 3]);
        std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| f(&mut grid))).is_err()
    };
    // x = 70 would be a bit behind the end of its row, y = 2 the row of the next layer.
    assert!(outside(|grid| grid.set(70, 0, 0, true)));
    assert!(outside(|grid| _ = grid.get(70, 0, 0)));
    assert!(outside(|grid| _ = grid.row(2, 0).len()));
    assert!(outside(|grid| _ = grid.row(0, 3).len()));
}

#[test]
fn bits_behind_a_row_are_cleared_or_refused() {
    let filled = BitGrid::from_rows([70, 2, 2], |_, _, row| row.fill(u64::MAX));
    assert_eq!(filled.count(), 280);
    let mut words = filled.words().to_vec();
    assert!(BitGrid::from_words([70, 2, 3], words.clone()).is_none());
    words[3] |= 1 << 6; // x = 70 of the second row
    assert!(BitGrid::from_words([70, 2, 2], words).is_none());
    for dims in [[0, 2, 2], [5, 0, 2], [5, 2, 0]] {
        assert_eq!(BitGrid::from_fn(dims, |_, _, _| true).count(), 0);
        assert!(BitGrid::from_words(dims, Vec::new()).is_some());
    }
    assert!(BitsRef::from_words([usize::MAX; 3], &[]).is_none());
}
