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

/// A bond with voids, of means 60, 130 and 200: void, wood, adhesive; 40 x 60 x 40 voxels.
fn mean(i: usize) -> f64 {
    match i / 40 % 60 {
        26..34 => 200.0,
        8..14 | 46..52 => 60.0,
        _ => 130.0,
    }
}

/// A bell curve of deviation 1: the sum of twelve even numbers from 0 to 1, less its mean.
fn bell(i: usize) -> f64 {
    let even = |k: u64| {
        let mut n = (12 * i as u64 + k).wrapping_mul(0x9E37_79B9_7F4A_7C15);
        n = (n ^ n >> 30).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        n = (n ^ n >> 27).wrapping_mul(0x94D0_49BB_1331_11EB);
        (n ^ n >> 31) as f64 / u64::MAX as f64
    };
    (0..12).map(even).sum::<f64>() - 6.0
}

/// Numbers behind a word.
fn numbers<const N: usize>(said: &str, word: &str) -> [f64; N] {
    let (_, rest) = said
        .split_once(word)
        .unwrap_or_else(|| panic!("{word}: {said}"));
    let rest = rest.replace("..", " ");
    let mut found = (rest.split(|c: char| !c.is_ascii_digit() && c != '.'))
        .filter_map(|part| part.trim_matches('.').parse().ok());
    std::array::from_fn(|_| found.next().unwrap())
}

/// The effect of thresholds moved by the noise is counted in the same noise; the median filter takes it out.
#[test]
fn phases_that_overlap_are_told_with_what_that_does() {
    let bench = bench();
    let raw = "--dims 40x60x40 --type u8 --voxel 2um --grey auto -o o.mpts";
    for (noise, overlaps) in [(0.0, None), (10.0, Some(false)), (20.0, Some(true))] {
        // Hot pixels are no noise.
        let hot = |i| {
            if noise > 0.0 && i % 2000 == 0 {
                255.0
            } else {
                mean(i) + noise * bell(i)
            }
        };
        let value = |i| f64::round(hot(i)).clamp(0.0, 255.0);
        let values: Vec<u8> = (0..40 * 60 * 40).map(|i| value(i) as u8).collect();
        bench.write("a.raw", &values);
        let said = told(&bench, &format!("a.raw {raw}"), 0, &[]);
        assert_eq!(said.contains("in doubt"), overlaps.is_some(), "{said}");
        assert_eq!(
            said.contains("phases overlap"),
            overlaps == Some(true),
            "{said}"
        );
        if overlaps != Some(true) {
            continue;
        }
        let [found] = numbers(&said, "a standard deviation of");
        assert!((found / noise - 1.0).abs() < 0.1, "{said}");
        let [low, _, high] = numbers(&said, "wood=");
        let share = |part: &dyn Fn(f64) -> bool| {
            let voxels = values.iter().filter(|v| part(f64::from(**v)));
            voxels.count() as f64 / values.len() as f64
        };
        let doubtful = |v: f64| [low, high].iter().any(|t| t - found <= v && v < t + found);
        let [percent] = numbers(&said, "phases overlap: ");
        assert!((percent / 100.0 - share(&doubtful)).abs() < 1e-3, "{said}");
        // EP is the share of adhesive of a height of 120 um: 16 um of it without noise.
        let [least, most] = numbers(&said, "EP (um) is");
        let expected = [found, -found].map(|by| 120.0 * share(&|v| v >= high + by));
        assert!(
            (least - expected[0]).abs() < 0.01 && (most - expected[1]).abs() < 0.01,
            "{said}"
        );
        assert!(least < 16.0 && 16.0 < most);
        let said = told(&bench, &format!("a.raw {raw} --denoise"), 0, &[]);
        assert!(!said.contains("phases overlap"), "{said}");
        let file = open(&bench, "o.mpts");
        let [_, adhesive] = counts(&file);
        assert!(adhesive.abs_diff(8 * 1600) < 128, "{adhesive}");
        assert!(file.header().attribute("denoise").is_some());
    }
    told(
        &bench,
        "a.raw --voxel 1um --denoise -o o.mpts",
        2,
        &["--grey"],
    );
}

/// A median is one of the values: outliers go, an edge stays where it is, at the sides of the crop too.
#[test]
fn the_median_filter_takes_outliers_and_leaves_edges() {
    let bench = bench();
    let edge = |i: usize| [10.0_f32, 22.0, 34.0][i % 40 / 14];
    let mut values: Vec<f32> = (0..40 * 30 * 12).map(edge).collect();
    for outlier in [0, 17, 5_000, 7_777, 14_399] {
        values[outlier] = 34.0 - values[outlier];
    }
    let raw = "--dims 40x30x12 --voxel 2um --grey wood=15..30,adhesive=31.. --denoise -o o.mpts";
    let run = |kind: &str, bytes: Vec<u8>, crop: &str, status, said: &[&str]| {
        bench.write("a.raw", bytes);
        told(
            &bench,
            &format!("a.raw {raw} --type {kind} --crop {crop}"),
            status,
            said,
        );
    };
    for (crop, layers) in [
        ("0:40,0:30,0:12", [14, 12]),
        ("3:38,1:30,2:9", [14, 10]),
        ("12:30,4:5,6:7", [14, 2]),
    ] {
        let sides: Vec<usize> = (crop.split(',').skip(1))
            .map(|range| range.split_once(':').unwrap())
            .map(|(from, to)| to.parse::<usize>().unwrap() - from.parse::<usize>().unwrap())
            .collect();
        let area = (sides[0] * sides[1]) as u64;
        for kind in ["f32", "u8", "u16be"] {
            let bytes = values.iter().flat_map(|v| match kind {
                "f32" => v.to_le_bytes().to_vec(),
                "u8" => vec![*v as u8],
                _ => (*v as u16).to_be_bytes().to_vec(),
            });
            run(kind, bytes.collect(), crop, 0, &[]);
            assert_eq!(
                counts(&open(&bench, "o.mpts")),
                layers.map(|n| n * area),
                "{kind} {crop}"
            );
        }
    }
    values[3 * 1200 + 5 * 40 + 7] = f32::NAN;
    let bytes = values.iter().flat_map(|v| v.to_le_bytes()).collect();
    run(
        "f32",
        bytes,
        "1:40,2:30,1:9",
        2,
        &["page 4", "column 7, row 5 holds NaN"],
    );
}
