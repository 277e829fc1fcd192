//! Planes, voxel sizes and labels, stated or guessed.

use voxels::{Phases, Stack};

use crate::check;
use crate::common::*;

/// The test volume under a single directory with this description.
fn single_directory(description: &str) -> Page {
    let [nx, ny, _] = DIMS;
    Page::new(nx, ny, 8, pages(|l| [l]).concat())
        .tag(270, Value::Ascii(description.into()))
        .tag(278, Value::Long(vec![ny as u32]))
        .tag(279, Value::Long(vec![(nx * ny) as u32]))
        .tag(282, Value::Rational(20, 29))
        .tag(283, Value::Rational(20, 29))
        .short(254, 0)
        .short(296, 1)
}

#[test]
fn planes_behind_a_single_directory() {
    let nz = DIMS[2];
    let hyperstack = format!(
        "ImageJ=1.11a\nimages={nz}\nslices={nz}\nhyperstack=true\nmode=grayscale\nspacing=1.45\nunit=um\n"
    );
    let frames = format!("ImageJ=1.53t\nimages={nz}\nframes={nz}\nunit=\\u00B5m\n");
    let shaped = format!("{{\"shape\": [{nz}, {}, {}]}}", DIMS[1], DIMS[0]);
    let [axes, old] = [["{\"axes\": \"ZYX\", \"shape\": [", "]}"], ["shape=(", ")"]]
        .map(|[a, b]| format!("{a}{nz}, {}, {}{b}", DIMS[1], DIMS[0]));
    for description in [hyperstack, frames, shaped, axes, old] {
        let bytes = tiff(CLASSIC, &[single_directory(&description)]);
        check(&description, &bytes, ["0", "1", "2"]);
    }
}

/// Channels and frames beside slices are no slices.
#[test]
fn shapes_of_more_than_one_series_are_refused() {
    let [nx, ny, nz] = DIMS;
    for description in [
        format!("{{\"shape\": [{nz}, 2, {ny}, {nx}], \"axes\": \"ZCYX\"}}"),
        format!("shape=(2, {nz}, {ny}, {nx})"),
    ] {
        let bytes = tiff(CLASSIC, &[single_directory(&description)]);
        let said = refusal("a.tif", &bytes);
        assert!(said.contains("2 axes beside those of a plane"), "{said}");
    }
}

/// Only tags of their own tell of the planes in MetaMorph's and other programs' files.
#[test]
fn planes_that_nothing_tells_of_are_refused() {
    let [nx, ny, _] = DIMS;
    let plane = |bits: usize| ((nx * bits).div_ceil(8) * ny) as u32;
    let of = |page: Page, bits, file: &dyn Fn(Page) -> Vec<u8>| {
        let page = page.tag(279, Value::Long(vec![plane(bits)]));
        refusal("a.tif", &file(page.short(258, bits as u16)))
    };
    let alone = |page: Page| tiff(CLASSIC, &[page]);
    for description in [
        "",
        "ImageJ=1.53t\nimages=1\n",
        "{\"shape\": [13, 21]}",
        "{\"note\": 1}",
    ] {
        let said = of(single_directory(description), 8, &alone);
        assert!(said.contains("room for more planes of 273 bytes"), "{said}");
    }
    let said = of(single_directory("ImageJ=1.53t\nimages=3\n"), 8, &alone);
    assert!(said.contains("the 273 others"), "{said}");
    let said = of(single_directory(""), 1, &alone);
    assert!(said.contains("planes of 39 bytes"), "{said}");
    // As slices of a folder, too.
    let folder = tempfile::tempdir().unwrap();
    for z in 0..2 {
        let page = single_directory("").tag(279, Value::Long(vec![plane(8)]));
        std::fs::write(folder.path().join(format!("s{z}.tif")), alone(page)).unwrap();
    }
    let said = Stack::open(&[folder.path().to_owned()])
        .unwrap_err()
        .to_string();
    assert!(said.contains("more planes"), "{said}");
    // What is less than a plane is padding.
    let [mut page, ..] = [plain_pages().remove(0)];
    page.chunks[0].extend(vec![0; nx * ny - 1]);
    let page = page.tag(279, Value::Long(vec![plane(8)]));
    let (_folder, path) = stored("a.tif", &alone(page));
    assert_eq!(Stack::open(&[path]).unwrap().dims(), [nx, ny, 1]);
}

#[test]
fn what_descriptions_say_that_the_file_does_not_hold_is_refused() {
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
        ("<?xml?><OME", "XML"),
    ] {
        let bytes = tiff(CLASSIC, &[single_directory(description)]);
        let sentence = refusal("a.tif", &bytes);
        assert!(sentence.contains(said), "{description}: {sentence}");
    }
    let mut pages = plain_pages();
    pages[0] = pages[0]
        .clone()
        .tag(270, Value::Ascii("ImageJ=1.53t\nimages=9\n".into()));
    let sentence = refusal("a.tif", &tiff(CLASSIC, &pages));
    assert!(
        sentence.contains("declares 9 planes but it holds 4"),
        "{sentence}"
    );
}

fn stated_edge(first: Page) -> Option<Result<f64, String>> {
    let mut pages = plain_pages();
    pages[0] = first;
    let (_folder, path) = stored("a.tif", &tiff(CLASSIC, &pages));
    let stack = Stack::open(&[path]).unwrap();
    stack.voxel_size().map(voxels::VoxelSize::cube_edge)
}

#[test]
fn voxel_sizes_from_imagej_ome_and_resolution_tags() {
    let page = |description: &str, resolution: (u32, u32), unit: u16| {
        plain_pages()[0]
            .clone()
            .tag(270, Value::Ascii(description.into()))
            .tag(282, Value::Rational(resolution.0, resolution.1))
            .tag(283, Value::Rational(resolution.0, resolution.1))
            .short(296, unit)
    };
    let ome = |z: &str| {
        format!(
            "<?xml version=\"1.0\"?><OME xmlns=\"http://www.openmicroscopy.org/Schemas/OME/2016-06\"><Image><Pixels DimensionOrder=\"XYCZT\" SizeX=\"21\" SizeY=\"13\" SizeC=\"1\" SizeZ=\"4\" SizeT=\"1\" PhysicalSizeX=\"1.45\" PhysicalSizeY=\"1450\" PhysicalSizeYUnit=\"nm\" PhysicalSizeZ=\"{z}\"/></Image></OME>"
        )
    };
    let imagej = |spacing: &str| {
        format!("ImageJ=1.53t\nimages=4\nslices=4\nunit=micron\nspacing={spacing}\n")
    };
    let close = |found: Option<Result<f64, String>>| {
        let edge = found.unwrap().unwrap();
        assert!((edge - 1.45e-6).abs() < 1e-15, "{edge}");
    };
    close(stated_edge(page(&imagej("1.45"), (20, 29), 1)));
    close(stated_edge(page(&ome("1.45"), (1, 1), 1)));
    close(stated_edge(page("", (200_000, 29), 3))); // pixels per centimetre
    close(stated_edge(page("", (508_000, 29), 2))); // pixels per inch
    let slanted = stated_edge(page(&imagej("3"), (20, 29), 1)).unwrap();
    assert!(slanted.unwrap_err().contains("cubes"));
    let slanted = stated_edge(page(&ome("1.5"), (20, 29), 1)).unwrap();
    assert!(slanted.unwrap_err().contains("cubes"));
    assert_eq!(stated_edge(page("", (1, 1), 1)), None);
    assert_eq!(stated_edge(page("", (72, 1), 2)), None);
    assert_eq!(stated_edge(page("", (1, 0), 3)), None);
    // 72.009 dpi; pixels per um called pixels per inch, which VoxelEdge::resolve does not believe.
    assert_eq!(stated_edge(page("", (72_009, 1000), 2)), None);
    let edge = stated_edge(page("", (20, 29), 2)).unwrap().unwrap();
    assert!((edge - 0.03683).abs() < 1e-9, "{edge}");
}

/// ImageJ names a unit for each axis, some languages a comma, and pixels are no length.
#[test]
fn sizes_in_the_unit_of_each_axis_and_sizes_that_are_none() {
    let stated = |text: &str, unit: u16| {
        let page = (plain_pages()[0].clone())
            .tag(270, Value::Ascii(text.into()))
            .tag(282, Value::Rational(20, 29))
            .tag(283, Value::Rational(20, 29))
            .short(296, unit);
        stated_edge(page)
    };
    let imagej = |rest: &str| stated(&format!("ImageJ=1.53t\nimages=4\n{rest}\n"), 1);
    for same in [
        "unit=um\nzunit=mm\nspacing=0.00145",
        "unit=um\nyunit=micron\nzunit=nm\nspacing=1450",
        "unit=\\u00B5m\nspacing=1,45",
        "unit=\\u03BCm\nspacing=-1.45",
        "unit=micron\nspacing=1.4500001",
    ] {
        let edge = imagej(same).unwrap().unwrap();
        assert!((edge / 1.45e-6 - 1.0).abs() < 1e-6, "{same}: {edge}");
    }
    for (other, said) in [
        ("unit=um\nyunit=mm", "1.45 x 1450"),
        ("unit=um\nzunit=mm\nspacing=1.45", "1.45 x 1.45 x 1450"),
        ("unit=um\nzunit=nm\nspacing=1.45", "0.00145"),
    ] {
        let refused = imagej(other).unwrap().unwrap_err();
        assert!(refused.contains(said), "{other}: {refused}");
        assert!(refused.contains("--voxel"), "{other}: {refused}");
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
    let ome = |sizes: &str| {
        stated(
            &format!(
                "<OME><Image><Pixels SizeX=\"21\" SizeY=\"13\" SizeC=\"1\" SizeZ=\"4\" SizeT=\"1\" {sizes}/></Image></OME>"
            ),
            1,
        )
    };
    let in_pixels = "PhysicalSizeX=\"1\" PhysicalSizeXUnit=\"pixel\" PhysicalSizeY=\"1\"";
    assert_eq!(ome(in_pixels), None);
    let flat = "PhysicalSizeX=\"1.45\" PhysicalSizeY=\"1,45\"";
    assert!((ome(flat).unwrap().unwrap() - 1.45e-6).abs() < 1e-12);
    let layers = format!("{flat} PhysicalSizeZ=\"1\" PhysicalSizeZUnit=\"reference frame\"");
    assert_eq!(ome(&layers), None);
}

#[test]
fn guesses_and_crops() {
    let (_folder, path) = stored("a.tif", &tiff(CLASSIC, &plain_pages()));
    let guessed = segmented(std::slice::from_ref(&path), &Phases::Guess).unwrap();
    assert_eq!(guessed.guessed, Some(&[0.0, 1.0, 2.0][..]));
    let stack = Stack::open(&[path]).unwrap();
    let crop = "3:20,2:9,1:3".parse().unwrap();
    let part = voxels::segment(&stack, &Phases::Guess, &crop, || {}).unwrap();
    assert_eq!(part.wood.dims(), [17, 7, 2]);
    for (z, y, x) in [(0, 0, 0), (1, 6, 16), (1, 3, 5)] {
        assert_eq!(part.wood.get(x, y, z), label(x + 3, y + 2, z + 1) == 1);
    }
    let outside = "3:22,2:9,1:3".parse().unwrap();
    let error = voxels::segment(&stack, &Phases::Guess, &outside, || {}).unwrap_err();
    assert!(
        error.is_usage() && error.to_string().contains("along x"),
        "{error}"
    );
}

#[test]
fn a_mask_says_what_was_found_and_what_to_give() {
    let said = |values: [u8; 3]| {
        let pages: Vec<Page> = (pages(|l| [values[usize::from(l)]]).into_iter())
            .map(|data| Page::new(DIMS[0], DIMS[1], 8, data))
            .collect();
        let (_folder, path) = stored("a.tif", &tiff(CLASSIC, &pages));
        segmented(&[path], &Phases::Guess).unwrap_err().to_string()
    };
    let mask = said([0, 255, 255]);
    for part in [
        "it holds 0 and 255 alone",
        "ImageJ",
        "--labels void=0,wood=255",
    ] {
        assert!(mask.contains(part), "{mask}");
    }
    let pair = said([0, 2, 2]);
    assert!(
        pair.contains("0 and 2 alone; ") && pair.contains("void=0,wood=2"),
        "{pair}"
    );
    assert!(
        said([1, 1, 1]).contains("it holds 1 alone"),
        "{}",
        said([1, 1, 1])
    );
}

#[test]
fn an_unknown_label_is_named_with_its_place() {
    let mut pages = plain_pages();
    pages[2].chunks[0][5 * DIMS[0] + 7] = 9;
    let sentence = refusal("a.tif", &tiff(CLASSIC, &pages));
    for part in ["page 3 of 4", "column 7, row 5", "holds 9"] {
        assert!(sentence.contains(part), "{sentence}");
    }
}
