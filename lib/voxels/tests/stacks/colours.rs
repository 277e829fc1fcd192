//! Stored values that do not show the same on every page are no labels; their colours are. Nor are pages in different
//! orientations a stack.

use std::path::Path;

use png::{BitDepth, ColorType};
use voxels::{Crop, Histogram, Phases};

use crate::build::*;
use crate::check::*;
use crate::tiff_file::*;

/// The colours of void, wood and adhesive.
const COLOURS: [[u8; 3]; 3] = [[0, 0, 0], [139, 90, 43], [255, 165, 0]];
const NAMES: &str = "void=0:0:0,wood=139:90:43,adhesive=255:165:0";
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

/// A PNG with a palette or, where it has none, of greys.
fn png(values: &[u8], depth: BitDepth, palette: &[[u8; 3]], opacity: &[u8]) -> Vec<u8> {
    let stored = packed(values, depth as usize, DIMS[0]);
    match palette {
        [] => png_with(ColorType::Grayscale, depth, &stored, None, opacity),
        _ => png_with(ColorType::Indexed, depth, &stored, Some(palette), opacity),
    }
}

/// A page of a TIFF with a palette, whose colours have 16 bits or, as some programs write, 8.
fn tiff_page(values: Vec<u8>, palette: &[[u8; 3]], scale: u16) -> Page {
    let map = (0..3).flat_map(|c| {
        let colours = (0..256).map(move |i| palette.get(i).map_or(0, |colour| colour[c]));
        colours.map(|level| u16::from(level) * scale)
    });
    let map: Vec<u16> = map.collect();
    Page::of(8, values).short(262, 3).shorts(320, &map)
}

/// Numbers as labels are refused with the names of two pages, colours give the voxels.
fn assert_by_colour(what: &str, path: &Path, names: &str) {
    let numbers = [
        by_labels(PLAIN),
        by_grey("wood=1..1,adhesive=2.."),
        Phases::Guess,
    ];
    for phases in &numbers {
        assert_says(segmented(path, phases), &["page 1 of 4", "page 2 of 4"]);
    }
    let stack = open(path);
    let whole = Crop::whole(stack.dims());
    assert!(Histogram::of(&stack, &whole).is_err(), "{what}");
    assert_volume(what, path, names);
}

#[test]
fn palettes_in_another_order_on_each_page() {
    for depth in [BitDepth::Two, BitDepth::Four, BitDepth::Eight] {
        let slices = folder("png", |z| {
            png(&indices(z), depth, &palette(z, COLOURS), &[])
        });
        assert_by_colour("PNG", slices.path(), NAMES);
        let bits = depth as usize;
        let stored = |z| packed(&indices(z), bits, DIMS[0]);
        let slices = folder("bmp", |z| bmp(bits, &stored(z), &palette(z, COLOURS)));
        assert_by_colour("BMP", slices.path(), NAMES);
    }
    for scale in [1, 256, 257] {
        let page = |z| tiff_page(indices(z), &palette(z, COLOURS), scale);
        let slices = folder("tif", |z| tiff(&[page(z)]));
        assert_by_colour("TIFF slices", slices.path(), NAMES);
        let pages: Vec<_> = (0..DIMS[2]).map(page).collect();
        let (_folder, path) = stored("a.tif", &tiff(&pages));
        assert_by_colour("TIFF pages", &path, NAMES);
    }
}

#[test]
fn greys_are_colours_too() {
    let greys = [0, 1, 2].map(|grey| [grey; 3]);
    // An optimiser left one slice as it was.
    let slices = folder("png", |z| match z {
        2 => png(&page(z, |l| l), BitDepth::Eight, &[], &[]),
        _ => png(&indices(z), BitDepth::Eight, &palette(z, greys), &[]),
    });
    assert_by_colour("PNG", slices.path(), &labels(|l| format!("{l}:{l}:{l}")));
    let wood_alone = |label: u8| u8::from(label == 1);
    let white = |z: usize, bits: u16, inverted: bool| {
        let values = page(z, |label| wood_alone(label) ^ u8::from(inverted));
        let page = Page::of(bits, packed(&values, bits.into(), DIMS[0]));
        tiff(&[page.short(262, u16::from(!inverted))])
    };
    let slices = folder("tif", |z| white(z, 1, z % 2 == 1));
    let numbers = by_labels("void=0,wood=1");
    assert!(segmented(slices.path(), &numbers).is_err());
    let colours = by_labels("void=0:0:0,wood=255:255:255");
    let shown = segmented(slices.path(), &colours).unwrap();
    assert_eq!(shown.wood.count(), count(1));
    // 1 is white in one bit and black in eight.
    let slices = folder("tif", |z| white(z, [1, 8][z % 2], false));
    assert!(segmented(slices.path(), &numbers).is_err());
}

#[test]
fn numbers_are_labels_where_they_show_the_same() {
    let greys: Vec<_> = (0..4).map(|grey| [grey; 3]).collect();
    let palette = palette(0, COLOURS);
    // Unused ends of a palette are left out; the order of bits differs.
    for (short, long) in [(&palette[..], &COLOURS[..]), (&greys, &[])] {
        let slices = folder("png", |z| match z {
            1 => png(&page(z, |l| l), BitDepth::Two, short, &[]),
            _ => png(&page(z, |l| l), BitDepth::Eight, long, &[]),
        });
        assert_volume("PNG", slices.path(), PLAIN);
    }
}

/// Some programs turn a picture by a tag alone.
#[test]
fn slices_in_different_orientations_are_refused() {
    let file = |z: usize, turned: u16| tiff(&[plain_pages().remove(z).short(274, turned)]);
    let slices = folder("tif", |z| file(z, [1, 1, 4, 4][z]));
    let said = refusal(slices.path());
    assert_has(&said, &["slice 10.tif", "of orientation 4"]);
    let slices = folder("tif", |z| file(z, 4));
    assert_volume("turned alike", slices.path(), PLAIN);
}

#[test]
fn pages_without_colours_to_go_by_are_refused() {
    let slices = folder("tif", |z| {
        let values = numbers("u16", false, 1, &page(z, |l| l));
        tiff(&[Page::of(16, values).short(262, (z % 2) as u16)])
    });
    let said = refusal(slices.path());
    assert_has(&said, &["slice 8.tif", "slice 9.tif"]);
    // The colours of a transparent palette do not tell void from wood.
    let slices = folder("png", |z| {
        let colours = palette(z, [[0; 3], [0; 3], [9; 3]]);
        let opacity = (0..4).map(|i| if i == PLACES[z][0] { 0 } else { 255 });
        let opacity: Vec<u8> = opacity.collect();
        png(&indices(z), BitDepth::Eight, &colours, &opacity)
    });
    let labels = by_labels("void=0:0:0,wood=9:9:9");
    assert_says(segmented(slices.path(), &labels), &["transparent"]);
}
