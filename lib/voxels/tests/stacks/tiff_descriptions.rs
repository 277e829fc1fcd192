//! Planes and voxel sizes that descriptions and tags state.

use crate::check::*;
use crate::tiff_file::*;

/// The test volume under a single directory with this description.
pub fn single_directory(description: &str) -> Page {
    let [nx, ny, _] = DIMS.map(|n| n as u32);
    let page = Page::of(8, volume())
        .described(description)
        .resolution(20, 29);
    page.longs(278, &[ny])
        .longs(279, &[nx * ny])
        .short(254, 0)
        .short(296, 1)
}

#[test]
fn planes_behind_a_single_directory() {
    for description in [
        "ImageJ=1.11a\nimages=4\nslices=4\nhyperstack=true\nmode=grayscale\nspacing=1.45\nunit=um\n",
        "ImageJ=1.53t\nimages=4\nframes=4\nunit=\\u00B5m\n",
        "{\"shape\": [4, 13, 21]}",
        "{\"axes\": \"ZYX\", \"shape\": [4, 13, 21]}",
        "shape=(4, 13, 21)",
    ] {
        assert_file("a.tif", &tiff(&[single_directory(description)]), PLAIN);
    }
}

#[test]
fn planes_that_nothing_tells_of_are_refused() {
    let plain = single_directory("");
    let bits = plain.clone().short(258, 1).longs(279, &[39]);
    assert_refused("a.tif", &tiff(&[bits]), &["planes of 39 bytes"]);
    // As slices of a folder, too.
    let slices = folder("tif", |_| tiff(std::slice::from_ref(&plain)));
    assert_has(&refusal(slices.path()), &["more planes"]);
    // What is less than a plane is padding.
    let mut padded = plain;
    padded.chunks[0].truncate(2 * 273 - 1);
    let (_folder, path) = stored("a.tif", &tiff(&[padded]));
    assert_eq!(open(&path).dims(), [21, 13, 1]);
}

#[test]
fn planes_that_are_not_as_many_as_pages_are_refused() {
    let bytes = tiff_with(|page| page.described("ImageJ=1.53t\nimages=9\n"));
    assert_refused("a.tif", &bytes, &["declares 9 planes but it holds 4"]);
}

/// A description as ImageJ or OME writes it, with these lines or attributes.
fn description(program: &str, more: &str) -> String {
    match program {
        "imagej" => format!("ImageJ=1.53t\nimages=4\n{}\n", more.replace(' ', "\n")),
        "ome" => format!(
            "<?xml version=\"1.0\"?><OME xmlns=\"http://www.openmicroscopy.org/Schemas/OME/2016-06\"><Image><Pixels DimensionOrder=\"XYCZT\" SizeX=\"21\" SizeY=\"13\" SizeC=\"1\" SizeZ=\"4\" SizeT=\"1\" {more}/></Image></OME>"
        ),
        _ => String::new(),
    }
}

#[test]
fn voxel_sizes_from_imagej_ome_and_resolution_tags() {
    let rows = include_str!("tiff_sizes.txt").lines();
    for row in rows.filter(|row| !row.is_empty() && !row.starts_with('#')) {
        let cells: Vec<&str> = row.split('|').map(str::trim).collect();
        let [program, more, resolution, unit, said] = cells[..] else {
            panic!("not a row of the table: {row}");
        };
        let (n, d) = resolution.split_once('/').unwrap();
        let bytes = tiff_with(|page| {
            let page = page.described(&description(program, more));
            page.resolution(n.parse().unwrap(), d.parse().unwrap())
                .short(296, unit.parse().unwrap())
        });
        let (_folder, path) = stored("a.tif", &bytes);
        match (stated_edge(&path), said.parse::<f64>()) {
            (Some(Ok(found)), Ok(um)) => {
                assert!((1e6 * found / um - 1.0).abs() < 1e-6, "{row}: {found}");
                let stack = open(&path);
                let spacing = stack.voxel_size().unwrap().states_spacing();
                assert_eq!(
                    spacing,
                    more.contains("spacing=") || more.contains("SizeZ=")
                );
            }
            (Some(Err(refused)), Err(_)) => assert_has(&refused, &[said, "cubes", "--voxel"]),
            (found, _) => assert_eq!((found, said), (None, "none"), "{row}"),
        }
    }
}
