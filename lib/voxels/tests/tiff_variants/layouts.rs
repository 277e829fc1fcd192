//! Strips, tiles and compressions.

use std::io::Cursor;

use tiff::encoder::{Compression, DeflateLevel, Predictor, TiffEncoder, colortype};
use tiff::tags::Tag;
use voxels::Stack;

use crate::check;
use crate::common::*;

/// Packs every chunk as runs of literals.
pub fn packbits(mut page: Page) -> Page {
    let literals = |run: &[u8]| [&[run.len() as u8 - 1], run].concat();
    for chunk in &mut page.chunks {
        *chunk = chunk.chunks(128).flat_map(literals).collect();
    }
    page.short(259, 32773)
}

/// Wraps every chunk into a zstd frame of one raw block (RFC 8878, 3.1.1).
pub fn zstd(mut page: Page) -> Page {
    for chunk in &mut page.chunks {
        let n = chunk.len() as u32;
        let mut frame = vec![0x28, 0xb5, 0x2f, 0xfd, 0b1010_0000];
        frame.extend(n.to_le_bytes());
        frame.extend(&(n << 3 | 1).to_le_bytes()[..3]);
        frame.append(chunk);
        *chunk = frame;
    }
    page.short(259, 50000)
}

/// Compresses every chunk by LZW with the encoder of the tiff crate.
fn lzw(mut page: Page) -> Page {
    for chunk in &mut page.chunks {
        let mut out = Cursor::new(Vec::new());
        let mut encoder = TiffEncoder::new(&mut out)
            .unwrap()
            .with_compression(Compression::Lzw);
        let width = chunk.len() as u32;
        encoder
            .write_image::<colortype::Gray8>(width, 1, chunk)
            .unwrap();
        out.set_position(0);
        let mut decoder = tiff::decoder::Decoder::new(&mut out).unwrap();
        let at = decoder.get_tag_u64(Tag::StripOffsets).unwrap() as usize;
        let n = decoder.get_tag_u64(Tag::StripByteCounts).unwrap() as usize;
        *chunk = out.get_ref()[at..at + n].to_vec();
    }
    page.short(259, 5)
}

/// Cuts a page into strips of `rows` rows of `row_bytes` bytes.
fn strips(mut page: Page, rows: usize, row_bytes: usize) -> Page {
    page.chunks = page.chunks[0]
        .chunks(rows * row_bytes)
        .map(<[u8]>::to_vec)
        .collect();
    page.tag(278, Value::Long(vec![rows as u32]))
}

/// Cuts an 8-bit page into 16 x 16 tiles; what lies outside the page is 99.
fn tiles(mut page: Page) -> Page {
    let [nx, ny, _] = DIMS;
    let data = page.chunks[0].clone();
    page.chunks.clear();
    for ty in (0..ny).step_by(16) {
        for tx in (0..nx).step_by(16) {
            let pixel = |i: usize| {
                let (x, y) = (tx + i % 16, ty + i / 16);
                if x < nx && y < ny {
                    data[y * nx + x]
                } else {
                    99
                }
            };
            page.chunks.push((0..256).map(pixel).collect());
        }
    }
    page.tiled = true;
    page.short(322, 16).short(323, 16)
}

#[test]
fn strips_and_tiles_plain_and_packed() {
    let pages = plain_pages();
    let cut = |f: &dyn Fn(Page) -> Page| -> Vec<u8> {
        tiff(CLASSIC, &pages.iter().cloned().map(f).collect::<Vec<_>>())
    };
    let labels = ["0", "1", "2"];
    check("strips", &cut(&|p| strips(p, 4, DIMS[0])), labels);
    check("strips of a row", &cut(&|p| strips(p, 1, DIMS[0])), labels);
    check(
        "scattered strips",
        &cut(&|p| {
            let mut page = strips(p, 4, DIMS[0]);
            // Four spare bytes behind each strip, as aligned writers leave them.
            page.chunks.iter_mut().for_each(|c| c.extend([9; 4]));
            page
        }),
        labels,
    );
    check(
        "packed strips",
        &cut(&|p| packbits(strips(p, 4, DIMS[0]))),
        labels,
    );
    check(
        "zstd strips",
        &cut(&|p| zstd(strips(p, 5, DIMS[0]))),
        labels,
    );
    check("tiles", &cut(&tiles), labels);
    check("packed tiles", &cut(&|p| packbits(tiles(p))), labels);
    check("zstd tiles", &cut(&|p| zstd(tiles(p))), labels);
    check("LZW strips", &cut(&|p| lzw(strips(p, 5, DIMS[0]))), labels);
    check("LZW tiles", &cut(&|p| lzw(tiles(p))), labels);
}

/// Rows that end between two LZW codes: the tiff crate 0.11 gives up on them ("no lzw end
/// code found", image-tiff issue 395) when it reads a tile row by row.
#[test]
fn lzw_tiles_of_one_label() {
    let page = Page::new(40, 40, 8, vec![1; 1600]);
    let mut page = page.short(322, 16).short(323, 32);
    page.chunks = vec![vec![1; 512]; 6];
    page.tiled = true;
    let (_folder, path) = stored("a.tif", &tiff(CLASSIC, &[lzw(page)]));
    let mut read = Vec::new();
    Stack::open(&[path])
        .unwrap()
        .read_page(0, &mut read)
        .unwrap();
    assert_eq!(read, [1; 1600]);
}

#[test]
fn compressions_with_and_without_predictor() {
    let methods = [
        ("LZW", Compression::Lzw),
        ("Deflate", Compression::Deflate(DeflateLevel::Balanced)),
        ("PackBits", Compression::Packbits),
        ("none", Compression::Uncompressed),
    ];
    for (name, method) in methods {
        for predictor in [Predictor::None, Predictor::Horizontal] {
            let mut out = Cursor::new(Vec::new());
            let mut encoder = TiffEncoder::new(&mut out).unwrap().with_compression(method);
            if !matches!(method, Compression::Packbits | Compression::Uncompressed) {
                encoder = encoder.with_predictor(predictor);
            }
            for z in 0..DIMS[2] {
                let data = page(z, |l| u16::from(l) * 300);
                let (width, height) = (DIMS[0] as u32, DIMS[1] as u32);
                encoder
                    .write_image::<colortype::Gray16>(width, height, &data)
                    .unwrap();
            }
            let what = format!("{name}, {predictor:?}");
            check(&what, out.get_ref(), ["0", "300", "600"]);
        }
    }
}
