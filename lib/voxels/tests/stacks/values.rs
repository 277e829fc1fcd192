//! Which stored values are labels or grey values, guessed or named.

use voxels::Phases;

use crate::build::*;
use crate::check::*;
use crate::tiff_file::*;

/// Stored floats that are no labels, or no numbers, are named with their place.
#[test]
fn floats_that_are_no_labels_are_refused_by_their_voxel() {
    let [nx, ny, _] = DIMS;
    let place = ["page 2: ", "column 5, row 3 holds"];
    let check = |value: f32, phases: &Phases, cure| {
        let mut values = numbers("f32", false, 1, &volume());
        let at = 4 * (nx * ny + 3 * nx + 5);
        values[at..at + 4].copy_from_slice(&value.to_le_bytes());
        let (_folder, path) = stored("a.mha", &mha("FLOAT", "", &values));
        assert_says(segmented(&path, phases), &[place[0], place[1], cure]);
    };
    for value in [0.1, f32::NAN, f32::INFINITY, 1.000_000_1] {
        check(value, &by_labels(PLAIN), "labels are whole numbers");
        check(value, &Phases::Guess, "labels are whole numbers");
    }
    for value in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        check(value, &by_grey("wood=0.5..1.5,adhesive=1.6.."), "--crop");
    }
}

#[test]
fn an_unknown_label_is_named_with_its_place() {
    let mut pages = plain_pages();
    pages[2].chunks[0][5 * DIMS[0] + 7] = 9;
    let place = ["page 3 of 4", "column 7, row 5", "holds 9"];
    assert_refused("a.tif", &tiff(&pages), &place);
}

#[test]
fn grey_values_become_phases_by_range() {
    let (_folder, path) = stored("a.tif", &tiff(&plain_pages()));
    let found = segmented(&path, &by_grey("wood=1..1.5,adhesive=1.6..")).unwrap();
    let counts = [found.wood.count(), found.adhesive.count()];
    assert_eq!(counts, [count(1), count(2)]);
}

#[test]
fn cuts_lie_in_the_middle_of_what_is_kept() {
    let (_folder, path) = stored("a.tif", &tiff(&plain_pages()));
    let [x, y, z] = open(&path)
        .middle_cuts(&"2:9,3:13,1:4".parse().unwrap())
        .unwrap();
    let value = |x, y, z| f64::from(label(x, y, z));
    let layer = |[n, m]: [usize; 2], of: &dyn Fn(usize, usize) -> f64| -> Vec<f64> {
        (0..n * m).map(|i| of(i % n, i / n)).collect()
    };
    assert_eq!(x, layer([10, 3], &|j, k| value(5, j + 3, k + 1)));
    assert_eq!(y, layer([7, 3], &|i, k| value(i + 2, 8, k + 1)));
    assert_eq!(z, layer([7, 10], &|i, j| value(i + 2, j + 3, 2)));
}

#[test]
fn guesses_and_crops() {
    let (_folder, path) = stored("a.tif", &tiff(&plain_pages()));
    let guessed = segmented(&path, &Phases::Guess).unwrap();
    assert_eq!(guessed.guessed, Some(&[0.0, 1.0, 2.0][..]));
    let stack = open(&path);
    let cropped =
        |crop: &str| voxels::segment(&stack, &Phases::Guess, &crop.parse().unwrap(), || {});
    let part = cropped("3:20,2:9,1:3").unwrap();
    assert_eq!(part.wood.dims(), [17, 7, 2]);
    for (z, y, x) in [(0, 0, 0), (1, 6, 16), (1, 3, 5)] {
        assert_eq!(part.wood.get(x, y, z), label(x + 3, y + 2, z + 1) == 1);
    }
    let outside = cropped("3:22,2:9,1:3").unwrap_err();
    assert!(outside.is_usage());
    assert_has(&outside.to_string(), &["along x"]);
}

#[test]
fn a_mask_says_what_was_found_and_what_to_give() {
    for (values, said) in [
        (
            [0, 255, 255],
            &[
                "it holds 0 and 255 alone",
                "ImageJ",
                "--labels void=0,wood=255",
            ][..],
        ),
        ([0, 2, 2], &["0 and 2 alone; ", "void=0,wood=2"]),
        ([1, 1, 1], &["it holds 1 alone"]),
    ] {
        let page = |z| Page::of(8, page(z, |l| values[usize::from(l)]));
        let pages: Vec<Page> = (0..DIMS[2]).map(page).collect();
        let (_folder, path) = stored("a.tif", &tiff(&pages));
        assert_says(segmented(&path, &Phases::Guess), said);
    }
}

#[test]
fn a_stack_of_one_bit_may_be_wood_alone() {
    let bits = |z| packed(&page(z, |label| u8::from(label == 1)), 1, DIMS[0]);
    let pages: Vec<Page> = (0..DIMS[2]).map(|z| Page::of(1, bits(z))).collect();
    let (_folder, path) = stored("a.tif", &tiff(&pages));
    let found = segmented(&path, &Phases::Guess).unwrap();
    let counts = [found.wood.count(), found.adhesive.count()];
    assert_eq!(counts, [count(1), 0]);
    assert_eq!(found.guessed, Some(&[0.0, 1.0][..]));
    let named = segmented(&path, &by_labels("void=0,wood=1")).unwrap();
    assert_eq!(named.wood, found.wood);
}
