//! Byte orders, sample types, bits and colours.

use voxels::Stack;

use crate::check;
use crate::common::*;
use crate::layouts::{packbits, zstd};

/// Pages of `bits` with sample format `format` from the bytes of each label.
fn sampled<const N: usize>(bits: u16, format: u16, bytes: impl Fn(u8) -> [u8; N]) -> Vec<Page> {
    pages(bytes)
        .into_iter()
        .map(|data| Page::new(DIMS[0], DIMS[1], bits, data).short(339, format))
        .collect()
}

#[test]
fn byte_orders_flavours_and_sample_types() {
    for big_endian in [false, true] {
        for big_tiff in [false, true] {
            let flavour = Flavour {
                big_endian,
                big_tiff,
            };
            macro_rules! order {
                ($value:expr) => {
                    match big_endian {
                        true => $value.to_be_bytes(),
                        false => $value.to_le_bytes(),
                    }
                };
            }
            let case = |what: &str, pages: &[Page], labels| {
                let what = format!("{what}, big endian {big_endian}, BigTIFF {big_tiff}");
                check(&what, &tiff(flavour, pages), labels);
            };
            let wide = ["0", "300", "600"];
            let signed = ["0", "-100", "-200"];
            case("u8", &sampled(8, 1, |l| [l * 100]), ["0", "100", "200"]);
            case(
                "i8",
                &sampled(8, 2, |l| (l as i8 * -50).to_le_bytes()),
                ["0", "-50", "-100"],
            );
            case(
                "u16",
                &sampled(16, 1, |l| order!((u16::from(l) * 300))),
                wide,
            );
            case(
                "i16",
                &sampled(16, 2, |l| order!((i16::from(l) * -100))),
                signed,
            );
            case(
                "u32",
                &sampled(32, 1, |l| order!((u32::from(l) * 300))),
                wide,
            );
            case(
                "i32",
                &sampled(32, 2, |l| order!((i32::from(l) * -100))),
                signed,
            );
            case(
                "u64",
                &sampled(64, 1, |l| order!((u64::from(l) * 300))),
                wide,
            );
            case(
                "i64",
                &sampled(64, 2, |l| order!((i64::from(l) * -100))),
                signed,
            );
            let floats = ["0", "-300", "-600"];
            case(
                "f32",
                &sampled(32, 3, |l| order!((f32::from(l) * -300.0))),
                floats,
            );
            case(
                "f64",
                &sampled(64, 3, |l| order!((f64::from(l) * -300.0))),
                floats,
            );
        }
    }
}

#[test]
fn photometric_interpretation_never_touches_the_labels() {
    let map = vec![0; 768];
    for photometric in [0, 1, 3] {
        let pages: Vec<Page> = plain_pages()
            .into_iter()
            .map(|p| {
                p.short(262, photometric)
                    .tag(320, Value::Short(map.clone()))
            })
            .collect();
        check("plain", &tiff(CLASSIC, &pages), ["0", "1", "2"]);
        // The same through the decoder of the tiff crate: PackBits of literal runs.
        let pages: Vec<Page> = pages.into_iter().map(packbits).collect();
        check("packed", &tiff(CLASSIC, &pages), ["0", "1", "2"]);
    }
}

#[test]
fn one_two_and_four_bits_with_padded_rows() {
    for bits in [1_usize, 2, 4] {
        let largest = (1 << bits) - 1;
        let value = |l: u8| l.min(largest);
        let packed = |z: usize| -> Vec<u8> {
            page(z, value)
                .chunks(DIMS[0])
                .flat_map(|row| {
                    row.chunks(8 / bits).map(|pixels| {
                        let place = |(i, v): (usize, &u8)| v << (8 - bits * (i + 1));
                        pixels.iter().enumerate().map(place).fold(0, |a, b| a | b)
                    })
                })
                .collect()
        };
        let pages: Vec<Page> = (0..DIMS[2])
            .map(|z| Page::new(DIMS[0], DIMS[1], bits as u16, packed(z)).short(262, 0))
            .collect();
        for (what, bytes) in [
            ("plain", tiff(CLASSIC, &pages)),
            (
                "packed",
                tiff(
                    CLASSIC,
                    &pages.into_iter().map(packbits).collect::<Vec<_>>(),
                ),
            ),
        ] {
            let (_folder, path) = stored("a.tif", &bytes);
            let stack = Stack::open(&[path]).unwrap();
            let mut read = Vec::new();
            for z in 0..DIMS[2] {
                stack.read_page(z, &mut read).unwrap();
                assert_eq!(read, page(z, value), "{what}, {bits} bits, page {z}");
            }
        }
    }
}

#[test]
fn colours_interleaved_and_planar() {
    let colour = |l: u8| [[0, 0, 0], [234, 156, 0], [0, 78, 255]][usize::from(l)];
    let labels = ["0:0:0", "234:156:0", "0:78:255"];
    let rgb = |data: Vec<u8>| {
        Page::new(DIMS[0], DIMS[1], 8, data)
            .tag(258, Value::Short(vec![8; 3]))
            .short(262, 2)
            .short(277, 3)
    };
    let chunky: Vec<Page> = pages(colour).into_iter().map(rgb).collect();
    check("chunky", &tiff(CLASSIC, &chunky), labels);
    let packed: Vec<Page> = chunky.into_iter().map(packbits).collect();
    check("chunky, packed", &tiff(CLASSIC, &packed), labels);
    let planar: Vec<Page> = (0..DIMS[2])
        .map(|z| {
            let mut page_of_planes = rgb(Vec::new()).short(284, 2);
            page_of_planes.chunks = (0..3).map(|c| page(z, |l| colour(l)[c])).collect();
            page_of_planes
        })
        .collect();
    check("planar", &tiff(CLASSIC, &planar), labels);
    let packed: Vec<Page> = planar.into_iter().map(zstd).collect();
    check("planar, zstd", &tiff(CLASSIC, &packed), labels);
}
