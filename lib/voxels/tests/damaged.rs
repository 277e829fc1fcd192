//! Damaged files end in an error that names file and page, never in a panic, and nothing
//! large is allocated for what the file cannot hold.

mod common;

use std::os::unix::fs::FileExt;
use std::path::Path;

use common::*;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use voxels::Stack;

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

/// A small file of each kind that is read differently.
fn samples() -> Vec<(&'static str, Vec<u8>)> {
    let big = Flavour {
        big_endian: true,
        big_tiff: true,
    };
    let plain = plain_pages();
    let described = |text: &str| {
        let mut pages = plain.clone();
        pages[0] = pages[0].clone().tag(270, Value::Ascii(text.into()));
        pages[0] = pages[0].clone().tag(282, Value::Rational(20, 29));
        tiff(CLASSIC, &pages)
    };
    let bits: Vec<Page> = (0..2)
        .map(|_| Page::new(21, 13, 1, vec![0xa5; 39]))
        .collect();
    let mut lzw = std::io::Cursor::new(Vec::new());
    let mut encoder = tiff::encoder::TiffEncoder::new(&mut lzw)
        .unwrap()
        .with_compression(tiff::encoder::Compression::Lzw)
        .with_predictor(tiff::encoder::Predictor::Horizontal);
    for z in 0..2 {
        encoder
            .write_image::<tiff::encoder::colortype::Gray8>(21, 13, &page(z, |l| l))
            .unwrap();
    }
    vec![
        ("plain", tiff(CLASSIC, &plain)),
        ("BigTIFF", tiff(big, &plain)),
        (
            "ImageJ",
            described("ImageJ=1.11a\nimages=4\nslices=4\nspacing=1.45\nunit=um\n"),
        ),
        ("shaped", described("{\"shape\": [4, 13, 21]}")),
        ("bits", tiff(CLASSIC, &bits)),
        ("LZW", lzw.into_inner()),
    ]
}

#[test]
fn the_samples_are_sound() {
    let (_folder, path) = stored("a.tif", b"");
    for (name, bytes) in samples() {
        read_all(&path, &bytes).unwrap_or_else(|e| panic!("{name}: {e}"));
    }
}

#[test]
fn a_file_cut_anywhere_is_refused() {
    let (_folder, path) = stored("a.tif", b"");
    for (name, bytes) in samples() {
        let mut refused = 0;
        for length in 0..bytes.len() {
            refused += usize::from(read_all(&path, &bytes[..length]).is_err());
        }
        println!("{name}: {refused} of {} cuts refused", bytes.len());
        assert_eq!(refused, bytes.len(), "{name}");
    }
}

#[test]
fn mutated_files_never_panic() {
    let (_folder, path) = stored("a.tif", b"");
    let mut random = ChaCha8Rng::seed_from_u64(20);
    let mut refused = 0;
    let rounds = 3000;
    for (_, bytes) in samples() {
        for _ in 0..rounds {
            let mut bytes = bytes.clone();
            for _ in 0..random.random_range(1..=4) {
                let at = random.random_range(0..bytes.len());
                bytes[at] = match random.random_range(0..3) {
                    0 => random.random(),
                    1 => 0xff,
                    _ => bytes[at] ^ 1 << random.random_range(0..8),
                };
            }
            refused += usize::from(read_all(&path, &bytes).is_err());
        }
    }
    println!("{refused} of {} mutated files refused", 6 * rounds);
    assert!(refused > rounds, "mutations must reach the structure");
}

#[test]
fn declared_sizes_beyond_the_file_are_refused_before_allocation() {
    let huge = |tag: u16, n: u32| {
        let mut pages = plain_pages();
        pages[1] = pages[1].clone().tag(tag, Value::Long(vec![n]));
        refusal("a.tif", &tiff(CLASSIC, &pages))
    };
    for tag in [256, 257] {
        for n in [u32::MAX, 1 << 20, 0] {
            let sentence = huge(tag, n);
            assert!(
                sentence.contains("'") && sentence.contains("page 2"),
                "{sentence}"
            );
        }
    }
    for compression in [5, 8, 32773, 50000] {
        let page = plain_pages()[0].clone();
        let page = page
            .short(259, compression)
            .tag(256, Value::Long(vec![1 << 31]))
            .tag(257, Value::Long(vec![1 << 31]));
        let sentence = refusal("a.tif", &tiff(CLASSIC, &[page]));
        assert!(sentence.contains("corrupt"), "{compression}: {sentence}");
    }
}

#[test]
fn pages_that_make_no_stack_are_refused() {
    let refused = |change: &dyn Fn(&mut Vec<Page>), said: &[&str]| {
        let mut pages = plain_pages();
        change(&mut pages);
        let sentence = refusal("a.tif", &tiff(CLASSIC, &pages));
        for part in said {
            assert!(sentence.contains(part), "{sentence}");
        }
    };
    let small = || Page::new(3, 2, 8, vec![0; 6]);
    refused(
        &|p| p[2] = small(),
        &["page 3", "3 x 2", "page 1 is 21 x 13"],
    );
    refused(&|p| p.insert(0, small()), &["page 2", "21 x 13"]);
    refused(
        &|p| p.insert(0, small().short(254, 1)),
        &["page 1", "thumbnail"],
    );
    refused(
        &|p| p[1] = p[1].clone().short(266, 2),
        &["page 2", "FillOrder"],
    );
    refused(
        &|p| p[1] = p[1].clone().short(277, 4),
        &["page 2", "4 samples"],
    );
    refused(
        &|p| p[1] = p[1].clone().short(258, 12),
        &["page 2", "12 bits"],
    );
    refused(&|p| p[1] = p[1].clone().short(259, 7), &["page 2", "JPEG"]);
    refused(
        &|p| p[1] = p[1].clone().short(259, 5).short(317, 3),
        &["page 2", "predictor 3"],
    );
    refused(
        &|p| p[1] = p[1].clone().short(32997, 2),
        &["page 2", "ImageDepth"],
    );
    refused(
        &|p| p[1].chunks[0].truncate(9),
        &["page 2", "9 bytes are stored"],
    );
}

#[test]
fn foreign_files_are_refused() {
    for bytes in [
        &b""[..],
        b"II",
        b"II*\0",
        b"MM\0*\0\0\0\0",
        b"\x89PNG\r\n\x1a\n",
        b"II+\0\x08\0\0\0",
    ] {
        let sentence = refusal("a.tif", bytes);
        assert!(sentence.starts_with('\''), "{sentence}");
    }
    // A chain of directories that bites its tail.
    let mut bytes = tiff(CLASSIC, &plain_pages()[..1]);
    let first: [u8; 4] = bytes[4..8].try_into().unwrap();
    let link = bytes.len() - 4;
    bytes[link..].copy_from_slice(&first);
    assert!(refusal("a.tif", &bytes).contains("loop"));
}
