//! A grid of bits as its words: FORMAT.md, "Bits of a block".

use std::sync::Mutex;

use particle_file::{BitGrid, BitsRef};

/// 70 x 2 x 3: rows of two words, the second with 6 voxels.
const DIMS: [usize; 3] = [70, 2, 3];

fn pattern(x: usize, y: usize, z: usize) -> bool {
    (x * 7 + y * 3 + z * 5) % 11 < 4
}

/// The words of row (y, z), voxel by voxel.
fn words_of_row(y: usize, z: usize) -> [u64; 2] {
    let mut words = [0; 2];
    for x in (0..DIMS[0]).filter(|&x| pattern(x, y, z)) {
        words[x / 64] += 1 << (x % 64);
    }
    words
}

#[test]
fn a_predicate_is_asked_once_for_each_voxel_and_for_no_other() {
    for nx in [1, 64, 65, 70, 128] {
        let asked = Mutex::new(vec![0; nx * 6]);
        BitGrid::from_fn([nx, 2, 3], |x, y, z| {
            asked.lock().unwrap()[(z * 2 + y) * nx + x] += 1;
            false
        });
        let asked = asked.into_inner().unwrap();
        assert!(asked.iter().all(|&n| n == 1), "{nx}: {asked:?}");
    }
}

#[test]
fn rows_are_words_one_behind_the_other() {
    let mut grid = BitGrid::from_fn(DIMS, pattern);
    assert_eq!((grid.dims(), grid.view().dims()), (DIMS, DIMS));
    let rows = (0..3).flat_map(|z| (0..2).map(move |y| (y, z)));
    let mut all = Vec::new();
    for (y, z) in rows {
        assert_eq!(grid.row(y, z), words_of_row(y, z), "row {y} {z}");
        assert_eq!(grid.view().row(y, z), words_of_row(y, z), "row {y} {z}");
        all.extend(words_of_row(y, z));
    }
    assert_eq!(grid.words(), all);
    assert_eq!(grid.view().words(), all);
    assert_eq!(BitGrid::from_words(DIMS, all.clone()).unwrap(), grid);
    assert_eq!(BitsRef::new(DIMS, &all).unwrap(), grid.view());

    grid.row_mut(1, 2).copy_from_slice(&[5, 1]);
    let set: Vec<usize> = grid.view().set_in_row(1, 2).collect();
    assert_eq!(set, [0, 2, 64]);
    assert_eq!(grid.row(0, 2), words_of_row(0, 2), "its neighbour");
}

#[test]
fn setting_a_voxel_touches_no_other() {
    let mut grid = BitGrid::new(DIMS);
    for x in [0, 63, 64, 69] {
        grid.set(x, 1, 1, true);
        grid.set(x, 1, 1, true);
        assert!(grid.get(x, 1, 1));
    }
    assert_eq!(grid.count(), 4);
    grid.set(63, 1, 1, false);
    grid.set(63, 1, 1, false);
    assert_eq!(grid.row(1, 1), [1, 1 | 1 << 5]);
}

#[test]
fn voxels_and_rows_outside_are_refused() {
    let outside = |f: &dyn Fn(&mut BitGrid)| {
        let mut grid = BitGrid::new(DIMS);
        std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| f(&mut grid))).is_err()
    };
    // x = 70 would be a bit behind the end of its row, y = 2 the row of the next layer.
    assert!(outside(&|grid| grid.set(70, 0, 0, true)));
    assert!(outside(&|grid| _ = grid.get(70, 0, 0)));
    assert!(outside(&|grid| _ = grid.row(2, 0).len()));
    assert!(outside(&|grid| _ = grid.row(0, 3).len()));
}
