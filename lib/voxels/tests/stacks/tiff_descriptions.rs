//! Planes and voxel sizes that descriptions and tags state.

use crate::check::*;
use crate::tiff_file::*;

/// The test volume under a single directory with this description.
fn single_directory(description: &str) -> Page {
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

/// Only tags of their own tell of the planes in MetaMorph's and other programs' files.
#[test]
fn planes_that_nothing_tells_of_are_refused() {
    let plain = single_directory("");
    for (page, said) in [
        (plain.clone(), "room for more planes of 273 bytes"),
        (
            single_directory("ImageJ=1.53t\nimages=1\n"),
            "more planes of 273",
        ),
        (
            single_directory("{\"shape\": [13, 21]}"),
            "more planes of 273",
        ),
        (single_directory("{\"note\": 1}"), "more planes of 273"),
        (
            single_directory("ImageJ=1.53t\nimages=3\n"),
            "the 273 others",
        ),
        (
            plain.clone().short(258, 1).longs(279, &[39]),
            "planes of 39 bytes",
        ),
    ] {
        assert_refused("a.tif", &tiff(&[page]), &[said]);
    }
    // As slices of a folder, too.
    let slices = folder("tif", |_| tiff(std::slice::from_ref(&plain)));
    assert_has(&refusal(slices.path()), &["more planes"]);
    // What is less than a plane is padding.
    let mut padded = plain;
    padded.chunks[0].truncate(2 * 273 - 1);
    let (_folder, path) = stored("a.tif", &tiff(&[padded]));
    assert_eq!(open(&path).dims(), [21, 13, 1]);
}

/// Channels and frames beside slices are no slices.
#[test]
fn what_descriptions_say_that_the_file_does_not_hold_is_refused() {
    let many = "2 axes beside those of a plane";
    for (description, said) in [
        ("ImageJ=1.53t\nimages=5\nslices=5\n", "page 5"),
        ("ImageJ=1.53t\nimages=4000000000\n", "page 5"),
        (
            "ImageJ=1.53t\nimages=4\nchannels=2\nslices=2\n",
            "2 channels",
        ),
        ("{\"shape\": [5, 13, 21]}", "page 5"),
        ("{\"shape\": [4, 13, 20]}", "no number of planes"),
        ("{\"shape\": [4, 13, 21}", "JSON"),
        ("{\"shape\": [4, 2, 13, 21], \"axes\": \"ZCYX\"}", many),
        ("shape=(2, 4, 13, 21)", many),
        ("<?xml?><OME", "XML"),
    ] {
        let bytes = tiff(&[single_directory(description)]);
        assert_refused("a.tif", &bytes, &[said]);
    }
    let bytes = tiff_with(|page| page.described("ImageJ=1.53t\nimages=9\n"));
    assert_refused("a.tif", &bytes, &["declares 9 planes but it holds 4"]);
}

/// The edge that the test volume states with this description, resolution and unit of it.
fn stated(description: &str, (n, d): (u32, u32), unit: u16) -> Option<Result<f64, String>> {
    let bytes = tiff_with(|page| {
        page.described(description)
            .resolution(n, d)
            .short(296, unit)
    });
    let (_folder, path) = stored("a.tif", &bytes);
    stated_edge(&path)
}

fn ome(sizes: &str) -> String {
    format!(
        "<?xml version=\"1.0\"?><OME xmlns=\"http://www.openmicroscopy.org/Schemas/OME/2016-06\"><Image><Pixels DimensionOrder=\"XYCZT\" SizeX=\"21\" SizeY=\"13\" SizeC=\"1\" SizeZ=\"4\" SizeT=\"1\" {sizes}/></Image></OME>"
    )
}

fn assert_stated(found: Option<Result<f64, String>>, edge: f64) {
    let found = found.unwrap().unwrap();
    assert!((found / edge - 1.0).abs() < 1e-6, "{found}");
}

#[test]
fn voxel_sizes_from_imagej_ome_and_resolution_tags() {
    let cubes = |z: &str| {
        ome(&format!(
            "PhysicalSizeX=\"1.45\" PhysicalSizeY=\"1450\" PhysicalSizeYUnit=\"nm\" PhysicalSizeZ=\"{z}\""
        ))
    };
    let imagej = |spacing: &str| {
        format!("ImageJ=1.53t\nimages=4\nslices=4\nunit=micron\nspacing={spacing}\n")
    };
    assert_stated(stated(&imagej("1.45"), (20, 29), 1), 1.45e-6);
    assert_stated(stated(&cubes("1.45"), (1, 1), 1), 1.45e-6);
    assert_stated(stated("", (200_000, 29), 3), 1.45e-6); // pixels per centimetre
    assert_stated(stated("", (508_000, 29), 2), 1.45e-6); // pixels per inch
    for slanted in [imagej("3"), cubes("1.5")] {
        let said = stated(&slanted, (20, 29), 1).unwrap().unwrap_err();
        assert_has(&said, &["cubes"]);
    }
    // No unit, 72 dpi and 72.009 dpi, no number.
    for (n, d, unit) in [(1, 1, 1), (72, 1, 2), (72_009, 1000, 2), (1, 0, 3)] {
        assert_eq!(stated("", (n, d), unit), None);
    }
    // Pixels per um called pixels per inch, which VoxelEdge::resolve does not believe.
    assert_stated(stated("", (20, 29), 2), 0.03683);
    let (_folder, path) = stored(
        "a.tif",
        &tiff_with(|page| page.resolution(1000, 1).short(296, 3)),
    );
    assert!(!open(&path).voxel_size().unwrap().states_spacing());
}

/// ImageJ names a unit for each axis, some languages a comma, and pixels are no length.
#[test]
fn sizes_in_the_unit_of_each_axis_and_sizes_that_are_none() {
    let stated = |text: &str, unit: u16| stated(text, (20, 29), unit);
    let imagej = |rest: &str| stated(&format!("ImageJ=1.53t\nimages=4\n{rest}\n"), 1);
    for same in [
        "unit=um\nzunit=mm\nspacing=0.00145",
        "unit=um\nyunit=micron\nzunit=nm\nspacing=1450",
        "unit=\\u00B5m\nspacing=1,45",
        "unit=\\u03BCm\nspacing=-1.45",
        "unit=micron\nspacing=1.4500001",
    ] {
        assert_stated(imagej(same), 1.45e-6);
    }
    for (other, said) in [
        ("unit=um\nyunit=mm", "1.45 x 1450"),
        ("unit=um\nzunit=mm\nspacing=1.45", "1.45 x 1.45 x 1450"),
        ("unit=um\nzunit=nm\nspacing=1.45", "0.00145"),
    ] {
        let refused = imagej(other).unwrap().unwrap_err();
        assert_has(&refused, &[said, "--voxel"]);
    }
    for none in [
        "unit=pixel",
        "unit=um\nspacing=one",
        "unit=um\nzunit=slice\nspacing=1.45",
        "unit=um\nyunit=pixel",
    ] {
        // Resolution tags do not mend it.
        for unit in [1, 2, 3] {
            let text = format!("ImageJ=1.53t\nimages=4\n{none}\n");
            assert_eq!(stated(&text, unit), None, "{none}");
        }
    }
    assert_eq!(imagej(""), None);
    let flat = "PhysicalSizeX=\"1.45\" PhysicalSizeY=\"1,45\"";
    assert_stated(stated(&ome(flat), 1), 1.45e-6);
    let layers = format!("{flat} PhysicalSizeZ=\"1\" PhysicalSizeZUnit=\"reference frame\"");
    let in_pixels = "PhysicalSizeX=\"1\" PhysicalSizeXUnit=\"pixel\" PhysicalSizeY=\"1\"";
    for none in [&layers, in_pixels] {
        assert_eq!(stated(&ome(none), 1), None);
    }
}
