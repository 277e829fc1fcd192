//! Stored values that do not show the same on every page are no labels; their colours are. Nor are pages in different
//! orientations a stack.

mod common;

use std::path::Path;

use common::*;
use voxels::{Histogram, Phases, Stack};

/// The colours of void, wood and adhesive.
const COLOURS: [[u8; 3]; 3] = [[0, 0, 0], [139, 90, 43], [255, 165, 0]];
const NAMES: [&str; 3] = ["0:0:0", "139:90:43", "255:165:0"];
/// Where each of the three stands in the palette of a page.
const PLACES: [[u8; 3]; 4] = [[0, 1, 2], [1, 0, 2], [2, 1, 0], [1, 2, 0]];

/// The palette of page `z`, with the third colour once more at its end.
fn palette(z: usize, colours: [[u8; 3]; 3]) -> Vec<[u8; 3]> {
    let mut palette = vec![colours[2]; 4];
    for (place, colour) in PLACES[z].iter().zip(colours) {
        palette[usize::from(*place)] = colour;
    }
    palette
}

/// The stored values of page `z`.
fn indices(z: usize) -> Vec<u8> {
    page(z, |label| PLACES[z][usize::from(label)])
}

fn png(
    values: &[u8],
    depth: png::BitDepth,
    palette: Option<&[[u8; 3]]>,
    opacity: &[u8],
) -> Vec<u8> {
    let [nx, ny, _] = DIMS;
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, nx as u32, ny as u32);
    encoder.set_depth(depth);
    if let Some(palette) = palette {
        encoder.set_color(png::ColorType::Indexed);
        encoder.set_palette(palette.concat());
    }
    if !opacity.is_empty() {
        encoder.set_trns(opacity.to_vec());
    }
    let mut writer = encoder.write_header().unwrap();
    writer
        .write_image_data(&packed(values, depth as usize))
        .unwrap();
    writer.finish().unwrap();
    file
}

/// Values of `bits` bits in rows that end at whole bytes.
fn packed(values: &[u8], bits: usize) -> Vec<u8> {
    let byte = |part: &[u8]| {
        let bits = part
            .iter()
            .enumerate()
            .map(|(i, v)| v << (8 - bits * (i + 1)));
        bits.fold(0, |byte, value| byte | value)
    };
    let rows = values.chunks(DIMS[0]);
    rows.flat_map(|row| row.chunks(8 / bits).map(byte))
        .collect()
}

fn bmp(values: &[u8], bits: usize, palette: &[[u8; 3]]) -> Vec<u8> {
    let [nx, ny, _] = DIMS;
    let begin = 54 + 4 * palette.len() as u32;
    let mut file = b"BM".to_vec();
    for number in [
        0,
        0,
        begin,
        40,
        nx as u32,
        ny as u32,
        1 | (bits as u32) << 16,
    ] {
        file.extend(number.to_le_bytes());
    }
    for number in [0, 0, 2835, 2835, palette.len() as u32, 0_u32] {
        file.extend(number.to_le_bytes());
    }
    palette
        .iter()
        .for_each(|[r, g, b]| file.extend([*b, *g, *r, 0]));
    for row in packed(values, bits).chunks((nx * bits).div_ceil(8)).rev() {
        file.extend(row);
        file.resize(file.len() + row.len().next_multiple_of(4) - row.len(), 0);
    }
    file
}

/// A page of a TIFF with a palette, whose colours have 16 bits or, as some programs write, 8.
fn tiff_page(values: Vec<u8>, palette: &[[u8; 3]], scale: u16) -> Page {
    let map = (0..3).flat_map(|c| {
        let colours = (0..256).map(move |i| palette.get(i).map_or(0, |colour| colour[c]));
        colours.map(|level| u16::from(level) * scale)
    });
    let map: Vec<u16> = map.collect();
    Page::new(DIMS[0], DIMS[1], 8, values)
        .short(262, 3)
        .tag(320, Value::Short(map))
}

fn folder(ending: &str, file: impl Fn(usize) -> Vec<u8>) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    for z in 0..DIMS[2] {
        std::fs::write(folder.path().join(format!("s{z}.{ending}")), file(z)).unwrap();
    }
    folder
}

/// Numbers as labels are refused with the names of two pages, colours give the voxels.
fn assert_by_colour(what: &str, path: &Path, names: [&str; 3]) {
    let numbers = Phases::Labels("void=0,wood=1,adhesive=2".parse().unwrap());
    let grey = Phases::Grey("wood=1..1,adhesive=2..".parse().unwrap());
    for phases in [&numbers, &grey, &Phases::Guess] {
        let said = segmented(&[path.to_owned()], phases)
            .unwrap_err()
            .to_string();
        assert!(
            said.contains("page 1 of 4") && said.contains("page 2 of 4"),
            "{what}: {said}"
        );
    }
    let stack = Stack::open(&[path.to_owned()]).unwrap();
    let whole = voxels::Crop::whole(stack.dims());
    assert!(Histogram::of(&stack, &whole).is_err(), "{what}");
    assert_test_volume(what, path, names);
}

#[test]
fn palettes_in_another_order_on_each_page() {
    use png::BitDepth::{Eight, Four, Two};
    for depth in [Two, Four, Eight] {
        let slices = folder("png", |z| {
            png(&indices(z), depth, Some(&palette(z, COLOURS)), &[])
        });
        assert_by_colour("PNG", slices.path(), NAMES);
        let slices = folder("bmp", |z| {
            bmp(&indices(z), depth as usize, &palette(z, COLOURS))
        });
        assert_by_colour("BMP", slices.path(), NAMES);
    }
    for scale in [1, 256, 257] {
        let page = |z| tiff_page(indices(z), &palette(z, COLOURS), scale);
        let slices = folder("tif", |z| tiff(CLASSIC, &[page(z)]));
        assert_by_colour("TIFF slices", slices.path(), NAMES);
        let pages: Vec<_> = (0..DIMS[2]).map(page).collect();
        let (_folder, path) = stored("a.tif", &tiff(CLASSIC, &pages));
        assert_by_colour("TIFF pages", &path, NAMES);
    }
}

#[test]
fn greys_are_colours_too() {
    let greys = [0, 1, 2].map(|grey| [grey; 3]);
    let names = ["0:0:0", "1:1:1", "2:2:2"];
    // An optimiser left one slice as it was.
    let slices = folder("png", |z| match z {
        2 => png(&page(z, |l| l), png::BitDepth::Eight, None, &[]),
        _ => png(
            &indices(z),
            png::BitDepth::Eight,
            Some(&palette(z, greys)),
            &[],
        ),
    });
    assert_by_colour("PNG", slices.path(), names);
    let wood_alone = |label: u8| u8::from(label == 1);
    let white = |z: usize, bits: u16, inverted: bool| {
        let values = page(z, |label| wood_alone(label) ^ u8::from(inverted));
        let [nx, ny, _] = DIMS;
        let page = Page::new(nx, ny, bits, packed(&values, bits.into()));
        tiff(CLASSIC, &[page.short(262, u16::from(!inverted))])
    };
    let labels = |text: &str| Phases::Labels(text.parse().unwrap());
    let slices = folder("tif", |z| white(z, 1, z % 2 == 1));
    let paths = [slices.path().to_owned()];
    assert!(segmented(&paths, &labels("void=0,wood=1")).is_err());
    let shown = segmented(&paths, &labels("void=0:0:0,wood=255:255:255")).unwrap();
    let wood = (0..DIMS[2])
        .flat_map(|z| page(z, wood_alone))
        .map(u64::from);
    assert_eq!(shown.wood.count(), wood.sum::<u64>());
    // 1 is white in one bit and black in eight.
    let slices = folder("tif", |z| white(z, [1, 8][z % 2], false));
    assert!(segmented(&[slices.path().to_owned()], &labels("void=0,wood=1")).is_err());
}

#[test]
fn numbers_are_labels_where_they_show_the_same() {
    let colours = COLOURS.to_vec();
    let plain = |z| page(z, |label| label);
    // Unused ends of a palette are left out; the order of bits differs.
    let slices = folder("png", |z| match z {
        1 => png(
            &plain(z),
            png::BitDepth::Two,
            Some(&palette(0, COLOURS)),
            &[],
        ),
        _ => png(&plain(z), png::BitDepth::Eight, Some(&colours), &[]),
    });
    assert_test_volume("PNG", slices.path(), ["0", "1", "2"]);
    let greys: Vec<_> = (0..4).map(|grey| [grey; 3]).collect();
    let slices = folder("png", |z| match z {
        1 => png(&plain(z), png::BitDepth::Two, Some(&greys), &[]),
        _ => png(&plain(z), png::BitDepth::Eight, None, &[]),
    });
    assert_test_volume("greys", slices.path(), ["0", "1", "2"]);
}

/// Some programs turn a picture by a tag alone.
#[test]
fn slices_in_different_orientations_are_refused() {
    let file = |z: usize, orientation: u16| {
        let page = plain_pages().remove(z).short(274, orientation);
        tiff(CLASSIC, &[page])
    };
    let slices = folder("tif", |z| file(z, [1, 1, 4, 4][z]));
    let said = Stack::open(&[slices.path().to_owned()])
        .unwrap_err()
        .to_string();
    assert!(
        said.contains("s2.tif") && said.contains("of orientation 4"),
        "{said}"
    );
    let slices = folder("tif", |z| file(z, 4));
    assert_test_volume("turned alike", slices.path(), ["0", "1", "2"]);
}

#[test]
fn pages_without_colours_to_go_by_are_refused() {
    let slices = folder("tif", |z| {
        let values = page(z, u16::from)
            .iter()
            .flat_map(|v| v.to_le_bytes())
            .collect();
        tiff(
            CLASSIC,
            &[Page::new(DIMS[0], DIMS[1], 16, values).short(262, (z % 2) as u16)],
        )
    });
    let said = Stack::open(&[slices.path().to_owned()])
        .unwrap_err()
        .to_string();
    assert!(said.contains("s0.tif") && said.contains("s1.tif"), "{said}");
    // The colours of a transparent palette do not tell void from wood.
    let slices = folder("png", |z| {
        let colours = palette(z, [[0; 3], [0; 3], [9; 3]]);
        let opacity = [PLACES[z][0]].map(|void| {
            (0..4)
                .map(|i| if i == void { 0 } else { 255 })
                .collect::<Vec<u8>>()
        });
        png(
            &indices(z),
            png::BitDepth::Eight,
            Some(&colours),
            &opacity.concat(),
        )
    });
    let labels = Phases::Labels("void=0:0:0,wood=9:9:9".parse().unwrap());
    let said = segmented(&[slices.path().to_owned()], &labels)
        .unwrap_err()
        .to_string();
    assert!(said.contains("transparent"), "{said}");
}
