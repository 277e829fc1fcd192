//! Grey values counted, proposed and taken.

use std::fs;

use crate::{bench, counts, open, told};

#[test]
fn grey_values_are_counted_proposed_and_taken() {
    let bench = bench();
    // Bands of three peaks of seven values each.
    let grey = |i: usize| 10_000 + 8_000 * [1_u16, 2, 0, 1][i / 31 % 20 / 5] + (i % 7) as u16;
    let words: Vec<u8> = (0..31 * 20 * 6)
        .flat_map(|i| grey(i).to_le_bytes())
        .collect();
    bench.write("a.raw", &words);
    let raw = "a.raw --dims 31x20x6 --type u16 --voxel 2um";
    told(
        &bench,
        &format!("{raw} --histogram h.csv"),
        0,
        &["--grey wood="],
    );
    let table = fs::read_to_string(bench.path("h.csv")).unwrap();
    let (header, rows) = table.split_once('\n').unwrap();
    assert_eq!(header, "grey,voxels");
    assert!(rows.starts_with("10000,"), "{rows}");
    let count = |row: &str| row.split_once(',').unwrap().1.parse::<u64>().unwrap();
    assert_eq!(rows.lines().map(count).sum::<u64>(), 31 * 20 * 6);
    told(
        &bench,
        &format!("{raw} --histogram h.csv --crop 0:5,0:13,1:3"),
        0,
        &[],
    );
    let table = fs::read_to_string(bench.path("h.csv")).unwrap();
    assert_eq!(table.lines().skip(1).map(count).sum::<u64>(), 5 * 13 * 2);

    told(&bench, &format!("{raw} --grey auto -o a.mpts"), 0, &[]);
    let found = counts(&open(&bench, "a.mpts"));
    assert_eq!(found, [31 * 10 * 6, 31 * 5 * 6]);

    let bytes = "a.raw --dims 62x20x6 --type u8 --voxel 2um --labels void=0,wood=1 -o w.mpts";
    told(&bench, bytes, 2, &["no phase has that label"]);
}
