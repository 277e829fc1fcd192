//! A page is what its file says, whatever the buffer held before.

mod common;

use std::io::Write;

use common::*;
use flate2::{Compression, Crc, write::ZlibEncoder};
use voxels::Stack;

const WIDTH: usize = 13;
const HEIGHT: usize = 11;

fn value(x: usize, y: usize, bits: usize) -> u16 {
    ((x * x + 3 * y + x * y) % 65_521 * 40_503 % (1 << bits)) as u16
}

/// A grey PNG in the seven passes of Adam7, which no encoder at hand writes.
fn interlaced(bits: usize) -> Vec<u8> {
    const PASSES: [[usize; 4]; 7] = [
        [0, 0, 8, 8],
        [4, 0, 8, 8],
        [0, 4, 4, 8],
        [2, 0, 4, 4],
        [0, 2, 2, 4],
        [1, 0, 2, 2],
        [0, 1, 1, 2],
    ];
    let mut stored = Vec::new();
    for [x0, y0, dx, dy] in PASSES {
        for y in (y0..HEIGHT).step_by(dy) {
            let row: Vec<u16> = (x0..WIDTH).step_by(dx).map(|x| value(x, y, bits)).collect();
            stored.push(0); // no filter
            match bits {
                16 => stored.extend(row.iter().flat_map(|v| v.to_be_bytes())),
                _ => stored.extend(row.chunks(8 / bits).map(|part| {
                    let part = part.iter().enumerate();
                    part.fold(0, |byte, (i, v)| byte | (*v as u8) << (8 - bits * (i + 1)))
                })),
            }
        }
    }
    let mut packed = ZlibEncoder::new(Vec::new(), Compression::default());
    packed.write_all(&stored).unwrap();
    let sizes = [WIDTH, HEIGHT].map(|n| (n as u32).to_be_bytes()).concat();
    let header = [sizes, vec![bits as u8, 0, 0, 0, 1]].concat();
    let mut file = b"\x89PNG\r\n\x1a\n".to_vec();
    for (kind, data) in [
        (b"IHDR", header),
        (b"IDAT", packed.finish().unwrap()),
        (b"IEND", Vec::new()),
    ] {
        let mut crc = Crc::new();
        crc.update(kind);
        crc.update(&data);
        file.extend((data.len() as u32).to_be_bytes());
        file.extend(kind);
        file.extend(&data);
        file.extend(crc.sum().to_be_bytes());
    }
    file
}

#[test]
fn interlaced_png_of_every_depth() {
    for bits in [1, 2, 4, 8, 16] {
        let (_folder, path) = stored("a.png", &interlaced(bits));
        let stack = Stack::open(&[path]).unwrap();
        let mut page = vec![0xff; 3 * WIDTH * HEIGHT];
        stack.read_page(0, &mut page).unwrap();
        let at = |i: usize| value(i % WIDTH, i / WIDTH, bits);
        let right: Vec<u8> = (0..WIDTH * HEIGHT)
            .flat_map(|i| match bits {
                16 => at(i).to_ne_bytes().to_vec(),
                _ => vec![at(i) as u8],
            })
            .collect();
        assert_eq!(page, right, "{bits} bits");
    }
}

#[test]
fn every_kind_of_page_fills_a_used_buffer() {
    let [nx, ny, _] = DIMS;
    let narrow = (0..ny).flat_map(|y| vec![0b1010_0000 | y as u8; nx.div_ceil(2)]);
    let mut files = vec![
        ("a.tif", tiff(CLASSIC, &plain_pages())),
        (
            "b.tif",
            tiff(CLASSIC, &[Page::new(nx, ny, 4, narrow.collect())]),
        ),
    ];
    let packed = |data: &[u8]| -> Vec<u8> {
        (data.chunks(100))
            .flat_map(|part| [&[part.len() as u8 - 1], part].concat())
            .collect()
    };
    let mut page = plain_pages().remove(0).short(259, 32_773);
    page.chunks = vec![packed(&page.chunks[0])];
    files.push(("c.tif", tiff(CLASSIC, &[page])));
    let mut jpeg = Vec::new();
    image::codecs::jpeg::JpegEncoder::new_with_quality(&mut jpeg, 90)
        .encode(
            &page_of_greys(),
            nx as u32,
            ny as u32,
            image::ExtendedColorType::L8,
        )
        .unwrap();
    files.push(("d.jpg", jpeg));
    for (name, file) in files {
        let (_folder, path) = stored(name, &file);
        let stack = Stack::open(&[path]).unwrap();
        let [mut fresh, mut used] = [Vec::new(), vec![0xff; 9 * nx * ny]];
        stack.read_page(0, &mut fresh).unwrap();
        stack.read_page(0, &mut used).unwrap();
        assert_eq!(fresh, used, "{name}");
    }
}

fn page_of_greys() -> Vec<u8> {
    page(0, |label| 80 * label)
}

/// The decoder makes up what a cut file lacks.
#[test]
fn jpeg_slices_that_were_cut_are_refused() {
    let [nx, ny, _] = DIMS;
    let mut jpeg = Vec::new();
    image::codecs::jpeg::JpegEncoder::new_with_quality(&mut jpeg, 90)
        .encode(
            &page_of_greys(),
            nx as u32,
            ny as u32,
            image::ExtendedColorType::L8,
        )
        .unwrap();
    for cut in [2, 20, 60] {
        let (_folder, path) = stored("a.jpg", &jpeg[..jpeg.len() - cut]);
        let stack = Stack::open(&[path]).unwrap();
        let said = stack.read_page(0, &mut Vec::new()).unwrap_err().to_string();
        assert!(said.contains("truncated"), "{said}");
    }
}
