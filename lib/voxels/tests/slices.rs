//! Folders of BMP, PNG and JPEG slices are the stack that they were made from.

mod common;

use std::fs;

use common::*;
use voxels::{Phases, Stack};

const PLAIN: [&str; 3] = ["0", "1", "2"];

/// A folder of slices, `bytes` of each page.
fn folder(ending: &str, bytes: impl Fn(usize) -> Vec<u8>) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    for z in 0..DIMS[2] {
        // Not in the order of their names as text.
        let path = folder.path().join(format!("slice {}.{ending}", z + 8));
        fs::write(path, bytes(z)).unwrap();
    }
    folder
}

/// A BMP of 1, 4, 8 (with a palette of no order), 24 or 32 bits, rows from the bottom.
fn bmp(z: usize, bits: u16) -> Vec<u8> {
    let [nx, ny, _] = DIMS;
    let colours = if bits >= 24 { 0 } else { 1_u32 << bits };
    let row = (nx * usize::from(bits)).div_ceil(32) * 4;
    let start = 54 + 4 * colours;
    let mut file = b"BM".to_vec();
    for number in [
        start + (row * ny) as u32,
        0,
        start,
        40,
        nx as u32,
        ny as u32,
    ] {
        file.extend(number.to_le_bytes());
    }
    file.extend(1_u16.to_le_bytes());
    file.extend(bits.to_le_bytes());
    for number in [0, (row * ny) as u32, 2835, 2835, colours, 0] {
        file.extend(number.to_le_bytes());
    }
    for i in 0..colours {
        file.extend([(200 - 7 * i % 200) as u8, (13 * i % 251) as u8, 5, 0]);
    }
    for y in (0..ny).rev() {
        let mut stored = vec![0; row];
        for x in 0..nx {
            let value = label(x, y, z);
            match bits {
                24 => stored[3 * x..3 * x + 3].fill(value),
                32 => stored[4 * x..4 * x + 4].copy_from_slice(&[value, 7, value, 255]),
                _ => {
                    let at = x * usize::from(bits);
                    stored[at / 8] |= value << (8 - usize::from(bits) - at % 8);
                }
            }
        }
        file.extend(stored);
    }
    file
}

fn png(z: usize, color: png::ColorType, depth: png::BitDepth) -> Vec<u8> {
    let [nx, ny, _] = DIMS;
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, nx as u32, ny as u32);
    encoder.set_color(color);
    encoder.set_depth(depth);
    if color == png::ColorType::Indexed {
        encoder.set_palette(vec![9, 9, 9, 200, 1, 1, 7, 7, 7, 0, 0, 0]);
    }
    let values = page(z, |label| label);
    let data: Vec<u8> = match (color, depth) {
        (_, png::BitDepth::Two) => (values.chunks(nx))
            .flat_map(|row| row.chunks(4))
            .map(|four| {
                let bits = four.iter().enumerate();
                bits.fold(0, |byte, (i, v)| byte | v << (6 - 2 * i))
            })
            .collect(),
        (_, png::BitDepth::Sixteen) => (values.iter())
            .flat_map(|v| (u16::from(*v) * 300).to_be_bytes())
            .collect(),
        (png::ColorType::Rgb, _) => values.iter().flat_map(|v| [*v, 0, 5]).collect(),
        _ => values,
    };
    let mut writer = encoder.write_header().unwrap();
    writer.write_image_data(&data).unwrap();
    writer.finish().unwrap();
    file
}

#[test]
fn folders_of_bmp_and_png_slices() {
    for bits in [2, 4, 8] {
        let slices = folder("bmp", |z| bmp(z, bits));
        assert_test_volume(&format!("BMP {bits}"), slices.path(), PLAIN);
    }
    let slices = folder("BMP", |z| bmp(z, 24));
    assert_test_volume("BMP 24", slices.path(), ["0:0:0", "1:1:1", "2:2:2"]);
    let slices = folder("bmp", |z| bmp(z, 32));
    assert_test_volume("BMP 32", slices.path(), ["0:7:0", "1:7:1", "2:7:2"]);
    // The same with the bits of each colour behind the header, as many programs write it.
    let masked = |masks: [u32; 3]| {
        let mut file = bmp(0, 32);
        (file[10], file[30]) = (66, 3);
        file.splice(54..54, masks.into_iter().flat_map(u32::to_le_bytes));
        file
    };
    let usual = [0xff_0000, 0xff00, 0xff];
    let (_folder, path) = stored("a.bmp", &masked(usual));
    let mut page = Vec::new();
    Stack::open(&[path])
        .unwrap()
        .read_page(0, &mut page)
        .unwrap();
    assert_eq!(page[..3], [label(0, 0, 0), 7, label(0, 0, 0)]);
    assert!(refusal("a.bmp", &masked([0xff, 0xff00, 0xff_0000])).contains("compression 3"));
    let mut clear = bmp(0, 32);
    clear[57] = 0;
    assert!(refusal("a.bmp", &clear).contains("transparen"));
    use png::{BitDepth, ColorType};
    for (color, depth, labels) in [
        (ColorType::Grayscale, BitDepth::Eight, PLAIN),
        (ColorType::Grayscale, BitDepth::Two, PLAIN),
        (ColorType::Indexed, BitDepth::Two, PLAIN),
        (ColorType::Indexed, BitDepth::Eight, PLAIN),
        (ColorType::Grayscale, BitDepth::Sixteen, ["0", "300", "600"]),
        (ColorType::Rgb, BitDepth::Eight, ["0:0:5", "1:0:5", "2:0:5"]),
    ] {
        let slices = folder("png", |z| png(z, color, depth));
        assert_test_volume(&format!("PNG {color:?} {depth:?}"), slices.path(), labels);
    }
}

#[test]
fn jpeg_slices_give_grey_values() {
    let slices = folder("jpeg", |z| {
        let [nx, ny, _] = DIMS;
        let mut file = Vec::new();
        let values = page(z, |label| 40 + 80 * label);
        image::codecs::jpeg::JpegEncoder::new_with_quality(&mut file, 100)
            .encode(&values, nx as u32, ny as u32, image::ExtendedColorType::L8)
            .unwrap();
        file
    });
    let grey = Phases::Grey("wood=80..159,adhesive=160..".parse().unwrap());
    let found = segmented(&[slices.path().to_owned()], &grey).unwrap();
    let expected = |phase| {
        pages(|l| [l])
            .concat()
            .iter()
            .filter(|l| **l == phase)
            .count() as u64
    };
    let counts = [found.wood.count(), found.adhesive.count()];
    assert_eq!(counts, [expected(1), expected(2)]);
    let labels = Phases::Labels("void=40,wood=120,adhesive=200".parse().unwrap());
    for phases in [Phases::Guess, labels] {
        let said = segmented(&[slices.path().to_owned()], &phases).unwrap_err();
        assert!(said.to_string().contains("--grey"), "{said}");
    }
}

#[test]
fn slices_of_other_sizes_or_kinds_are_no_stack() {
    let odd = folder("png", |z| {
        if z == 2 {
            png(z, png::ColorType::Indexed, png::BitDepth::Eight)[..60].to_vec()
        } else {
            png(z, png::ColorType::Grayscale, png::BitDepth::Eight)
        }
    });
    assert!(Stack::open(&[odd.path().to_owned()]).is_err());
    let mixed = folder("png", |z| match z {
        3 => bmp(z, 24),
        _ => png(z, png::ColorType::Grayscale, png::BitDepth::Eight),
    });
    let said = |folder: &tempfile::TempDir| {
        let opened = Stack::open(&[folder.path().to_owned()]);
        opened.unwrap_err().to_string()
    };
    assert!(said(&mixed).contains("must be alike"), "{}", said(&mixed));
    for (content, refused) in [
        (&b""[..], "slice 8.png': it is empty"),
        (b"text", "no slice of a stack"),
    ] {
        fs::write(mixed.path().join("slice 8.png"), content).unwrap();
        assert!(said(&mixed).contains(refused), "{}", said(&mixed));
    }
    let [nx, ny, _] = DIMS;
    let mut clear = Vec::new();
    let mut encoder = png::Encoder::new(&mut clear, nx as u32, ny as u32);
    encoder.set_color(png::ColorType::Rgba);
    let mut writer = encoder.write_header().unwrap();
    writer.write_image_data(&vec![0; 4 * nx * ny]).unwrap();
    writer.finish().unwrap();
    assert!(refusal("a.png", &clear).contains("transparency"));
    for cut in [20, 40, 60, 200] {
        let whole = png(0, png::ColorType::Grayscale, png::BitDepth::Eight);
        refusal("a.png", &whole[..cut.min(whole.len() - 20)]);
        refusal("a.bmp", &bmp(0, 8)[..cut]);
    }
}

/// Flipped bytes and cut ends are read or refused, never worse.
#[test]
fn damaged_slices_do_not_panic() {
    let [nx, ny, _] = DIMS;
    let mut jpeg = Vec::new();
    image::codecs::jpeg::JpegEncoder::new_with_quality(&mut jpeg, 80)
        .encode(
            &page(0, |l| 80 * l),
            nx as u32,
            ny as u32,
            image::ExtendedColorType::L8,
        )
        .unwrap();
    let sound = [
        bmp(0, 8),
        bmp(1, 24),
        png(0, png::ColorType::Indexed, png::BitDepth::Two),
        png(0, png::ColorType::Grayscale, png::BitDepth::Sixteen),
        jpeg,
    ];
    assert!(damaged(&sound, "a.img") > 300);
}
