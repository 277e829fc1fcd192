//! Folders of TIFF, BMP, PNG and JPEG slices are the stack that they were made from.

use std::fs;

use png::{BitDepth, ColorType};
use voxels::{Phases, Stack};

use crate::build::*;
use crate::check::*;
use crate::tiff_file::*;

/// Page `z` with a byte of each label.
fn values(z: usize) -> Vec<u8> {
    page(z, |l| l)
}

fn grey_png(z: usize) -> Vec<u8> {
    png(ColorType::Grayscale, BitDepth::Eight, &values(z))
}

fn grey_bmp(z: usize, bits: usize) -> Vec<u8> {
    // A palette of no order.
    let colour = |i: usize| [5, (13 * i % 251) as u8, (200 - 7 * i % 200) as u8];
    let palette: Vec<[u8; 3]> = (0..1 << bits).map(colour).collect();
    bmp(bits, &packed(&values(z), bits, DIMS[0]), &palette)
}

/// Colours of 24 or 32 bits.
fn rgb_bmp(z: usize, bits: usize) -> Vec<u8> {
    let pixel = |l: u8| [l, 7, l, 255][..bits / 8].to_vec();
    bmp(bits, &page(z, pixel).concat(), &[])
}

#[test]
fn slices_are_taken_in_natural_order() {
    let folder = tempfile::tempdir().unwrap();
    // 8, 9, 10, 11: unpadded numbers with a space, endings in both cases.
    let names = ["s 11.TIFF", "s 10.tiff", "s 9.TIF", "s 8.tif"];
    let paths = names.map(|name| folder.path().join(name));
    for (path, page) in paths.iter().rev().zip(plain_pages()) {
        fs::write(path, tiff(&[page])).unwrap();
    }
    fs::write(folder.path().join("notes.txt"), "not a slice").unwrap();
    assert_volume("folder", folder.path(), PLAIN);
    let stack = Stack::open(&paths).unwrap();
    assert_eq!(stack.dims(), DIMS);
    (0..DIMS[2]).for_each(|z| assert_eq!(read_page(&stack, z), values(z)));
}

#[test]
fn slices_that_do_not_belong_together_are_refused() {
    let slices = folder("tif", |z| tiff(&[plain_pages().remove(z)]));
    let odd = tiff(&[Page::new(3, 2, 8, vec![0; 6])]);
    for (seventh, said) in [
        (tiff(&plain_pages()), "slice 7.tif': it holds 4 pages"),
        (odd, "slice 8.tif', page 2: it is 21 x 13"),
    ] {
        fs::write(slices.path().join("slice 7.tif"), seventh).unwrap();
        assert_has(&refusal(slices.path()), &[said]);
    }
    assert_has(&refusal(&slices.path().join("none.tif")), &["none.tif"]);
    let mixed = folder("png", |z| if z == 3 { rgb_bmp(z, 24) } else { grey_png(z) });
    assert_has(&refusal(mixed.path()), &["must be alike"]);
    for (content, said) in [
        (&b""[..], "slice 8.png': it is empty"),
        (b"text", "no slice of a stack"),
        (&grey_png(0)[..30], "slice 8.png'"),
    ] {
        fs::write(mixed.path().join("slice 8.png"), content).unwrap();
        assert_has(&refusal(mixed.path()), &[said]);
    }
    // Cut in the palette or the pixels: what ends a PNG is not needed.
    for color in [ColorType::Indexed, ColorType::Grayscale] {
        let whole = png(color, BitDepth::Eight, &values(0));
        for cut in [40, 60, whole.len() - 20] {
            assert_refused("a.png", &whole[..cut], &["a.png'", "cut or damaged ("]);
        }
    }
}

#[test]
fn slices_that_contradict_one_another_state_no_voxel_size() {
    for (sizes, stated) in [
        ([Some(2), Some(2)], true),
        ([Some(2), None], true),
        ([Some(2), Some(3)], false),
    ] {
        let slices = folder("tif", |z| {
            let page = plain_pages().remove(0).short(296, 3);
            let size = sizes.get(z).copied().flatten();
            tiff(&[match size {
                Some(n) => page.resolution(10_000, n),
                None => page,
            }])
        });
        match stated {
            true => assert_edge(slices.path(), 2e-6),
            false => assert!(stated_edge(slices.path()).is_none()),
        }
    }
}

#[test]
fn folders_of_bmp_and_png_slices() {
    for bits in [2, 4, 8] {
        let slices = folder("bmp", |z| grey_bmp(z, bits));
        assert_volume("BMP", slices.path(), PLAIN);
    }
    for bits in [24, 32] {
        let slices = folder("BMP", |z| rgb_bmp(z, bits));
        assert_volume("BMP", slices.path(), &labels(|l| format!("{l}:7:{l}")));
    }
    // The same with the bits of each colour behind the header, as many programs write it.
    let masked = |masks: [u32; 3]| {
        let mut file = rgb_bmp(0, 32);
        (file[10], file[30]) = (66, 3);
        file.splice(54..54, masks.into_iter().flat_map(u32::to_le_bytes));
        file
    };
    let usual = [0xff_0000, 0xff00, 0xff];
    let (_folder, path) = stored("a.bmp", &masked(usual));
    let first = label(0, 0, 0);
    assert_eq!(read_page(&open(&path), 0)[..3], [first, 7, first]);
    let other = masked([0xff, 0xff00, 0xff_0000]);
    assert_refused("a.bmp", &other, &["compression 3"]);
    let mut clear = rgb_bmp(0, 32);
    clear[57] = 0;
    assert_refused("a.bmp", &clear, &["transparen"]);
    let clear = vec![0; 4 * DIMS[0] * DIMS[1]];
    let clear = png(ColorType::Rgba, BitDepth::Eight, &clear);
    assert_refused("a.png", &clear, &["transparency"]);
    for color in [ColorType::Grayscale, ColorType::Indexed] {
        for (bits, depth) in [(2, BitDepth::Two), (8, BitDepth::Eight)] {
            let slices = folder("png", |z| {
                png(color, depth, &packed(&values(z), bits, DIMS[0]))
            });
            assert_volume("PNG", slices.path(), PLAIN);
        }
    }
    let wide = |z| numbers("u16", true, 300, &values(z));
    let slices = folder("png", |z| {
        png(ColorType::Grayscale, BitDepth::Sixteen, &wide(z))
    });
    assert_volume("PNG", slices.path(), "void=0,wood=300,adhesive=600");
    let rgb = |z| page(z, |l| [l, 0, 5]).concat();
    let slices = folder("png", |z| png(ColorType::Rgb, BitDepth::Eight, &rgb(z)));
    assert_volume("PNG", slices.path(), &labels(|l| format!("{l}:0:5")));
}

#[test]
fn jpeg_slices_give_grey_values() {
    let values = |z| page(z, |l| 40 + 80 * l);
    let grey = by_grey("wood=80..159,adhesive=160..");
    let rgb = folder("jpeg", |z| rgb_jpeg(&values(z)));
    let slices = folder("jpeg", |z| jpeg(&values(z), 100));
    for slices in [&rgb, &slices] {
        let found = segmented(slices.path(), &grey).unwrap();
        let counts = [found.wood.count(), found.adhesive.count()];
        assert_eq!(counts, [count(1), count(2)]);
    }
    for phases in [Phases::Guess, by_labels("void=40,wood=120,adhesive=200")] {
        assert_says(segmented(slices.path(), &phases), &["--grey"]);
    }
    // The decoder makes up what a cut file lacks.
    let whole = jpeg(&page(0, |l| 80 * l), 90);
    let (_folder, path) = stored("a.jpg", &whole[..3]);
    let said = refusal(&path);
    assert!(
        !said.contains('\n') && said.contains("cut or damaged ("),
        "{said}"
    );
    for cut in [2, 20, 60] {
        let (_folder, path) = stored("a.jpg", &whole[..whole.len() - cut]);
        let read = open(&path).read_page(0, &mut Vec::new());
        assert_says(read, &["truncated"]);
    }
}
