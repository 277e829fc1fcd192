//! Byte orders, sample types, bits and colours.

use crate::build::*;
use crate::check::*;
use crate::tiff_file::*;
use crate::tiff_layouts::{packbits, zstd};

#[test]
fn byte_orders_flavours_and_sample_types() {
    for (big_endian, big_tiff) in [(false, false), (false, true), (true, false), (true, true)] {
        for kind in NUMBERS {
            let bits: u16 = kind[1..].parse().unwrap();
            let format = match &kind[..1] {
                "u" => 1,
                "i" => 2,
                _ => 3,
            };
            let times = factor(kind);
            let page = |labels: Vec<u8>| {
                let data = numbers(kind, big_endian, times, &labels);
                Page::of(bits, data).short(339, format)
            };
            let pages: Vec<Page> = pages().into_iter().map(page).collect();
            let labels = labels(|l| i32::from(l) * times);
            let what = format!("{kind}, big endian {big_endian}, BigTIFF {big_tiff}");
            assert_file(&what, &tiff_as(big_endian, big_tiff, &pages), &labels);
        }
    }
}

#[test]
fn photometric_interpretation_never_touches_the_labels() {
    for photometric in [0, 1, 3] {
        let shown = |page: Page| page.short(262, photometric).shorts(320, &[0; 768]);
        assert_file("plain", &tiff_with(shown), PLAIN);
        // The same through the decoder of the tiff crate: PackBits of literal runs.
        assert_file("packed", &tiff_with(|page| packbits(shown(page))), PLAIN);
    }
}

#[test]
fn one_two_and_four_bits_with_padded_rows() {
    for bits in [1_u16, 2, 4] {
        let value = |l: u8| l.min((1 << bits) - 1);
        let stored_page = |z| packed(&page(z, value), bits.into(), DIMS[0]);
        let pages = (0..DIMS[2]).map(|z| Page::of(bits, stored_page(z)).short(262, 0));
        let plain: Vec<Page> = pages.collect();
        let packed: Vec<Page> = plain.iter().cloned().map(packbits).collect();
        for bytes in [tiff(&plain), tiff(&packed)] {
            let (_folder, path) = stored("a.tif", &bytes);
            let stack = open(&path);
            for z in 0..DIMS[2] {
                let right = page(z, value);
                assert_eq!(read_page(&stack, z), right, "{bits} bits, page {z}");
            }
        }
    }
}

#[test]
fn colours_interleaved_and_planar() {
    let colour = |l: u8| [[0, 0, 0], [234, 156, 0], [0, 78, 255]][usize::from(l)];
    let labels = "void=0:0:0,wood=234:156:0,adhesive=0:78:255";
    let page = |z| {
        let page = Page::of(8, page(z, colour).concat());
        page.shorts(258, &[8; 3]).short(262, 2).short(277, 3)
    };
    let planar = |z| {
        let mut planar = page(z).short(284, 2);
        planar.chunks = (0..3)
            .map(|c| crate::check::page(z, |l| colour(l)[c]))
            .collect();
        planar
    };
    let pages = |page: &dyn Fn(usize) -> Page| tiff(&[0, 1, 2, 3].map(page));
    assert_file("interleaved", &pages(&page), labels);
    assert_file(
        "interleaved, packed",
        &pages(&|z| packbits(page(z))),
        labels,
    );
    assert_file("planar", &pages(&planar), labels);
    assert_file("planar, zstd", &pages(&|z| zstd(planar(z))), labels);
}
