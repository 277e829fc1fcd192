//! Damaged files end in an error that names file and page, never in a panic, and nothing
//! large is allocated for what the file cannot hold.

use std::os::unix::fs::FileExt;
use std::path::Path;

use png::{BitDepth, ColorType};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use tiff::encoder::{Predictor, TiffEncoder, colortype};
use voxels::Stack;

use crate::build::*;
use crate::check::*;
use crate::tiff_file::*;

/// Opens a file and reads every page; pages may fail, but only within what a file of this
/// length can expand to (zstd: 32,768 bytes from one).
fn read_all(path: &Path, bytes: &[u8]) -> Result<(), String> {
    // Overwritten in place: replacing a file thousands of times waits for the disk.
    let file = std::fs::File::options().write(true).open(path).unwrap();
    file.write_all_at(bytes, 0).unwrap();
    file.set_len(bytes.len() as u64).unwrap();
    let stack = Stack::open(&[path.to_owned()]).map_err(|e| e.to_string())?;
    let format = stack.format();
    let mut page = Vec::new();
    let mut read = Ok(());
    for z in 0..stack.dims()[2] {
        read = read.and(stack.read_page(z, &mut page).map_err(|e| e.to_string()));
        // Pixels below 8 bits unpack to up to 8 bytes per stored byte.
        assert!(page.capacity() <= 8 * 32_768 * bytes.len(), "{format}");
    }
    read
}

/// A small TIFF of each kind that is read differently.
fn tiffs() -> Vec<(&'static str, Vec<u8>)> {
    let plain = plain_pages();
    let described = |text: &str| {
        let mut pages = plain.clone();
        pages[0] = plain[0].clone().described(text).resolution(20, 29);
        tiff(&pages)
    };
    let bits = Page::of(1, vec![0xa5; 39]);
    let mut lzw = std::io::Cursor::new(Vec::new());
    let encoder = TiffEncoder::new(&mut lzw).unwrap();
    let encoder = encoder.with_compression(tiff::encoder::Compression::Lzw);
    let mut encoder = encoder.with_predictor(Predictor::Horizontal);
    for page in &pages()[..2] {
        (encoder.write_image::<colortype::Gray8>(21, 13, page)).unwrap();
    }
    let imagej = "ImageJ=1.11a\nimages=4\nslices=4\nspacing=1.45\nunit=um\n";
    vec![
        ("plain", tiff(&plain)),
        ("BigTIFF", tiff_as(true, true, &plain)),
        ("ImageJ", described(imagej)),
        ("shaped", described("{\"shape\": [4, 13, 21]}")),
        ("bits", tiff(&[bits.clone(), bits])),
        ("LZW", lzw.into_inner()),
        ("deep", tiff(&[Page::of(8, volume()).longs(32997, &[4])])),
    ]
}

fn slices() -> Vec<(&'static str, Vec<u8>)> {
    let greys = pages().remove(0);
    let wide = numbers("u16", true, 300, &greys);
    let palette = [[0; 3], [1; 3], [2; 3]];
    vec![
        ("BMP", bmp(8, &greys, &palette)),
        ("BMP 24", bmp(24, &page(1, |l| [l; 3]).concat(), &[])),
        (
            "PNG",
            png(
                ColorType::Indexed,
                BitDepth::Two,
                &packed(&greys, 2, DIMS[0]),
            ),
        ),
        (
            "PNG 16",
            png(ColorType::Grayscale, BitDepth::Sixteen, &wide),
        ),
        ("JPEG", jpeg(&page(0, |l| 80 * l), 80)),
    ]
}

#[test]
fn a_file_cut_anywhere_is_refused() {
    let (_folder, path) = stored("a", b"");
    // What ends a PNG or JPEG is not needed.
    let sound = [tiffs(), volumes(), slices()[..2].to_vec()].concat();
    for (name, bytes) in sound {
        read_all(&path, &bytes).unwrap_or_else(|e| panic!("{name}: {e}"));
        let cuts = 0..bytes.len();
        let refused = cuts.filter(|&n| read_all(&path, &bytes[..n]).is_err());
        let refused = refused.count();
        println!("{name}: {refused} of {} cuts refused", bytes.len());
        assert_eq!(refused, bytes.len(), "{name}");
    }
}

#[test]
fn mutated_files_never_panic() {
    let (_folder, path) = stored("a", b"");
    let mut random = ChaCha8Rng::seed_from_u64(20);
    let rounds = 1000;
    for (kind, files) in [
        ("TIFF", tiffs()),
        ("volumes", volumes()),
        ("slices", slices()),
    ] {
        let mut refused = 0;
        for (_, bytes) in &files {
            for _ in 0..rounds {
                let mut bytes = bytes.clone();
                for _ in 0..random.random_range(1..=4) {
                    // Headers matter most.
                    let end = [bytes.len(), bytes.len().min(160)][random.random_range(0..2)];
                    let at = random.random_range(0..end);
                    bytes[at] = match random.random_range(0..3) {
                        0 => random.random(),
                        1 => 0xff,
                        _ => bytes[at] ^ 1 << random.random_range(0..8),
                    };
                }
                refused += usize::from(read_all(&path, &bytes).is_err());
            }
        }
        let all = rounds * files.len();
        println!("{kind}: {refused} of {all} mutated files refused");
        assert!(
            refused > all / 6 && refused < all - all / 20,
            "mutations must reach the structure"
        );
    }
}

#[test]
fn declared_sizes_beyond_the_file_are_refused_before_allocation() {
    for tag in [256, 257] {
        for n in [u32::MAX, 1 << 20, 0] {
            let mut pages = plain_pages();
            pages[1] = pages[1].clone().longs(tag, &[n]);
            assert_refused("a.tif", &tiff(&pages), &["'", "page 2"]);
        }
    }
    for compression in [5, 8, 32773, 50000] {
        let page = plain_pages().remove(0).short(259, compression);
        let page = page.longs(256, &[1 << 31]).longs(257, &[1 << 31]);
        assert_refused("a.tif", &tiff(&[page]), &["corrupt"]);
    }
}

#[test]
fn pages_that_make_no_stack_are_refused() {
    let small = || Page::new(3, 2, 8, vec![0; 6]);
    let second = || plain_pages().remove(1);
    let mut cut = second();
    cut.chunks[0].truncate(9);
    for (at, page, said) in [
        (2, small(), ["page 3: it is 3 x 2", "page 1 is 21 x 13"]),
        (0, small(), ["page 2", "21 x 13"]),
        (0, small().short(254, 1), ["page 1", "thumbnail"]),
        (1, second().short(266, 2), ["page 2", "FillOrder"]),
        (1, second().short(277, 4), ["page 2", "4 samples"]),
        (1, second().short(258, 12), ["page 2", "12 bits"]),
        (1, second().short(259, 7), ["page 2", "JPEG"]),
        (
            1,
            second().short(259, 5).short(317, 3),
            ["page 2", "predictor 3"],
        ),
        (1, second().short(32997, 2), ["page 2", "ImageDepth"]),
        (1, cut, ["page 2", "9 bytes are stored"]),
    ] {
        let mut pages = plain_pages();
        pages[at] = page;
        assert_refused("a.tif", &tiff(&pages), &said);
    }
}

/// Beginnings of files without more, and a chain of directories that bites its tail.
#[test]
fn directories_that_are_not_there_or_go_round_are_refused() {
    for bytes in [
        &b""[..],
        b"II",
        b"II*\0",
        b"MM\0*\0\0\0\0",
        b"II+\0\x08\0\0\0",
        b"\x89PNG\r\n\x1a\n",
    ] {
        let (_folder, path) = stored("a.tif", bytes);
        let said = refusal(&path);
        assert!(said.starts_with('\''), "{said}");
    }
    let mut bytes = tiff(&plain_pages()[..1]);
    let link = bytes.len() - 4;
    bytes.copy_within(4..8, link);
    assert_refused("a.tif", &bytes, &["loop"]);
}
