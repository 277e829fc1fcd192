//! Strips, tiles, compressions, several planes in a directory.

use std::io::Cursor;

use tiff::encoder::{Compression, DeflateLevel, Predictor, TiffEncoder, colortype};
use tiff::tags::Tag;

use crate::build::factor;
use crate::check::*;
use crate::tiff_file::*;

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
        let encoder = TiffEncoder::new(&mut out).unwrap();
        let mut encoder = encoder.with_compression(Compression::Lzw);
        let width = chunk.len() as u32;
        (encoder.write_image::<colortype::Gray8>(width, 1, chunk)).unwrap();
        out.set_position(0);
        let mut decoder = tiff::decoder::Decoder::new(&mut out).unwrap();
        let mut tag = |tag| decoder.get_tag_u64(tag).unwrap() as usize;
        let (at, n) = (tag(Tag::StripOffsets), tag(Tag::StripByteCounts));
        *chunk = out.get_ref()[at..at + n].to_vec();
    }
    page.short(259, 5)
}

/// Cuts an 8-bit page into 16 x 16 tiles; what lies outside the page is 99.
fn tiles(mut page: Page) -> Page {
    let [nx, ny, _] = DIMS;
    let data = page.chunks.remove(0);
    // One row of them is high enough.
    for x0 in (0..nx).step_by(16) {
        let pixel = |i: usize| match (x0 + i % 16, i / 16) {
            (x, y) if x < nx && y < ny => data[y * nx + x],
            _ => 99,
        };
        page.chunks.push((0..256).map(pixel).collect());
    }
    page.tiled = true;
    page.short(322, 16).short(323, 16)
}

/// Four spare bytes behind each strip, as aligned writers leave them.
fn scattered(mut page: Page) -> Page {
    page.chunks.iter_mut().for_each(|c| c.extend([9; 4]));
    page
}

#[test]
fn strips_and_tiles_plain_and_packed() {
    let plain = |page: Page| page;
    for cut in [
        |page: Page| page.strips(4),
        |page: Page| page.strips(1),
        |page: Page| page.strips(5),
        tiles,
    ] {
        for pack in [plain, packbits, zstd, lzw] {
            assert_file("a.tif", &tiff_with(|page| pack(cut(page))), PLAIN);
        }
    }
    let bytes = tiff_with(|page| scattered(page.strips(4)));
    assert_file("a.tif", &bytes, PLAIN);
}

/// Rows that end between two LZW codes: the tiff crate 0.11 gives up on them ("no lzw end
/// code found", image-tiff issue 395) when it reads a tile row by row.
#[test]
fn lzw_tiles_of_one_label() {
    let page = Page::new(40, 40, 8, Vec::new());
    let mut page = page.short(322, 16).short(323, 32);
    (page.chunks, page.tiled) = (vec![vec![1; 512]; 6], true);
    let (_folder, path) = stored("a.tif", &tiff(&[lzw(page)]));
    assert_eq!(read_page(&open(&path), 0), [1; 1600]);
}

#[test]
fn compressions_with_and_without_predictor() {
    let deflate = Compression::Deflate(DeflateLevel::Balanced);
    for (method, predictor) in [
        (Compression::Lzw, Predictor::None),
        (Compression::Lzw, Predictor::Horizontal),
        (deflate, Predictor::None),
        (deflate, Predictor::Horizontal),
        (Compression::Packbits, Predictor::None),
        (Compression::Uncompressed, Predictor::None),
    ] {
        let mut out = Cursor::new(Vec::new());
        let encoder = TiffEncoder::new(&mut out).unwrap();
        let mut encoder = encoder.with_compression(method).with_predictor(predictor);
        for z in 0..DIMS[2] {
            let data = page(z, |l| u16::from(l) * factor("u16") as u16);
            (encoder.write_image::<colortype::Gray16>(21, 13, &data)).unwrap();
        }
        assert_file("a.tif", out.get_ref(), "void=0,wood=300,adhesive=600");
    }
}

/// A directory of several planes by SGI's tag, in one strip or in one for each plane.
#[test]
fn planes_by_the_tag_image_depth() {
    let [nx, ny, nz] = DIMS;
    let deep = |data: &[u8]| Page::of(8, data.to_vec()).longs(32997, &[nz as u32]);
    let whole = deep(&volume());
    assert_file("a.tif", &tiff(std::slice::from_ref(&whole)), PLAIN);
    let mut parted = whole.clone();
    parted.chunks = pages();
    assert_file("a.tif", &tiff(&[parted]), PLAIN);
    for (page, said) in [
        (deep(&volume()[..nx * ny * 2]), "bytes are stored"),
        // Deflated in one piece it was said to be truncated.
        (deep(&[0x78; 60]).short(259, 8), "compressed in one piece"),
        (whole.longs(32997, &[u32::MAX]), "ImageDepth"),
    ] {
        assert_refused("a.tif", &tiff(&[page]), &[said]);
    }
}

/// Writers leave out tiles that are all 0; strips without bytes are a file cut short.
#[test]
fn tiles_without_bytes_are_empty() {
    let value = |x: usize, y: usize| u8::from(x < 16 && y >= 16) * (1 + (x % 2) as u8);
    let page = |chunks: [Vec<u8>; 4]| {
        let mut page = Page::new(20, 20, 8, Vec::new());
        (page.tiled, page.chunks) = (true, chunks.to_vec());
        page.short(322, 16).short(323, 16)
    };
    let tile: Vec<u8> = (0..256).map(|i| value(i % 16, 16 + i / 16)).collect();
    let one = page([vec![], vec![], tile, vec![]]);
    let full = page([vec![3; 256], vec![4; 256], vec![5; 256], vec![6; 256]]);
    let right: Vec<u8> = (0..400).map(|i| value(i % 20, i / 20)).collect();
    for (pages, right) in [
        (vec![one.clone()], &right),
        (vec![page([const { Vec::new() }; 4])], &vec![0; 400]),
        // What another page left behind is not shown.
        (vec![full, one], &right),
    ] {
        let (_folder, path) = stored("a.tif", &tiff(&pages));
        let stack = open(&path);
        let mut page = vec![7; 400];
        (0..pages.len()).for_each(|z| stack.read_page(z, &mut page).unwrap());
        assert_eq!(page, *right);
    }
    let mut strips = Page::new(20, 20, 8, Vec::new()).longs(278, &[10]);
    strips.chunks = vec![vec![], vec![1; 200]];
    assert_refused("a.tif", &tiff(&[strips]), &["corrupt"]);
}
