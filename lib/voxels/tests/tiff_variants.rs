//! Every TIFF variant of the design's table, made here, gives the stored labels exactly.

mod common;

use std::io::Cursor;

use common::*;
use tiff::encoder::{Compression, DeflateLevel, Predictor, TiffEncoder, colortype};
use tiff::tags::Tag;
use voxels::{Phases, Stack};

fn check(what: &str, bytes: &[u8], labels: [&str; 3]) {
    let (_folder, path) = stored("a.tif", bytes);
    assert_test_volume(what, &path, labels);
}

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
            let halves = ["0", "0.5", "1"];
            case(
                "f32",
                &sampled(32, 3, |l| order!((f32::from(l) * 0.5))),
                halves,
            );
            case(
                "f64",
                &sampled(64, 3, |l| order!((f64::from(l) * 0.5))),
                halves,
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

/// Packs every chunk as runs of literals.
fn packbits(mut page: Page) -> Page {
    let literals = |run: &[u8]| [&[run.len() as u8 - 1], run].concat();
    for chunk in &mut page.chunks {
        *chunk = chunk.chunks(128).flat_map(literals).collect();
    }
    page.short(259, 32773)
}

/// Wraps every chunk into a zstd frame of one raw block (RFC 8878, 3.1.1).
fn zstd(mut page: Page) -> Page {
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

/// The test volume under a single directory with this description.
fn single_directory(description: &str) -> Page {
    let [nx, ny, _] = DIMS;
    Page::new(nx, ny, 8, pages(|l| [l]).concat())
        .tag(270, Value::Ascii(description.into()))
        .tag(278, Value::Long(vec![ny as u32]))
        .tag(279, Value::Long(vec![(nx * ny) as u32]))
        .tag(282, Value::Rational(20, 29))
        .tag(283, Value::Rational(20, 29))
        .short(254, 0)
        .short(296, 1)
}

#[test]
fn planes_behind_a_single_directory() {
    let nz = DIMS[2];
    let hyperstack = format!(
        "ImageJ=1.11a\nimages={nz}\nslices={nz}\nhyperstack=true\nmode=grayscale\nspacing=1.45\nunit=um\n"
    );
    let frames = format!("ImageJ=1.53t\nimages={nz}\nframes={nz}\nunit=\\u00B5m\n");
    let shaped = format!("{{\"shape\": [{nz}, {}, {}]}}", DIMS[1], DIMS[0]);
    for description in [hyperstack, frames, shaped] {
        let bytes = tiff(CLASSIC, &[single_directory(&description)]);
        check(&description, &bytes, ["0", "1", "2"]);
    }
}

#[test]
fn what_descriptions_say_that_the_file_does_not_hold_is_refused() {
    for (description, said) in [
        ("ImageJ=1.53t\nimages=5\nslices=5\n", "page 5"),
        ("ImageJ=1.53t\nimages=4000000000\n", "page 5"),
        (
            "ImageJ=1.53t\nimages=4\nchannels=2\nslices=2\n",
            "2 channels",
        ),
        ("{\"shape\": [5, 13, 21]}", "page 5"),
        ("{\"shape\": [4, 13, 20]}", "no number of planes"),
        ("{\"shape\": [4, 13, 21}", "JSON"),
        ("<?xml?><OME", "XML"),
    ] {
        let bytes = tiff(CLASSIC, &[single_directory(description)]);
        let sentence = refusal("a.tif", &bytes);
        assert!(sentence.contains(said), "{description}: {sentence}");
    }
    let mut pages = plain_pages();
    pages[0] = pages[0]
        .clone()
        .tag(270, Value::Ascii("ImageJ=1.53t\nimages=9\n".into()));
    let sentence = refusal("a.tif", &tiff(CLASSIC, &pages));
    assert!(
        sentence.contains("declares 9 planes but it holds 4"),
        "{sentence}"
    );
}

fn stated_edge(first: Page) -> Option<Result<f64, String>> {
    let mut pages = plain_pages();
    pages[0] = first;
    let (_folder, path) = stored("a.tif", &tiff(CLASSIC, &pages));
    let stack = Stack::open(&[path]).unwrap();
    stack.voxel_size().map(voxels::VoxelSize::cube_edge)
}

#[test]
fn voxel_sizes_from_imagej_ome_and_resolution_tags() {
    let page = |description: &str, resolution: (u32, u32), unit: u16| {
        plain_pages()[0]
            .clone()
            .tag(270, Value::Ascii(description.into()))
            .tag(282, Value::Rational(resolution.0, resolution.1))
            .tag(283, Value::Rational(resolution.0, resolution.1))
            .short(296, unit)
    };
    let ome = |z: &str| {
        format!(
            "<?xml version=\"1.0\"?><OME xmlns=\"http://www.openmicroscopy.org/Schemas/OME/2016-06\"><Image><Pixels DimensionOrder=\"XYCZT\" SizeX=\"21\" SizeY=\"13\" SizeC=\"1\" SizeZ=\"4\" SizeT=\"1\" PhysicalSizeX=\"1.45\" PhysicalSizeY=\"1450\" PhysicalSizeYUnit=\"nm\" PhysicalSizeZ=\"{z}\"/></Image></OME>"
        )
    };
    let imagej = |spacing: &str| {
        format!("ImageJ=1.53t\nimages=4\nslices=4\nunit=micron\nspacing={spacing}\n")
    };
    let close = |found: Option<Result<f64, String>>| {
        let edge = found.unwrap().unwrap();
        assert!((edge - 1.45e-6).abs() < 1e-15, "{edge}");
    };
    close(stated_edge(page(&imagej("1.45"), (20, 29), 1)));
    close(stated_edge(page(&ome("1.45"), (1, 1), 1)));
    close(stated_edge(page("", (200_000, 29), 3))); // pixels per centimetre
    close(stated_edge(page("", (508_000, 29), 2))); // pixels per inch
    let slanted = stated_edge(page(&imagej("3"), (20, 29), 1)).unwrap();
    assert!(slanted.unwrap_err().contains("cubes"));
    let slanted = stated_edge(page(&ome("1.5"), (20, 29), 1)).unwrap();
    assert!(slanted.unwrap_err().contains("cubes"));
    assert_eq!(stated_edge(page("", (1, 1), 1)), None);
    assert_eq!(stated_edge(page("", (72, 1), 2)), None);
    assert_eq!(stated_edge(page("", (1, 0), 3)), None);
    assert_eq!(
        stated_edge(page("ImageJ=1.53t\nimages=4\n", (1, 2), 1)),
        None
    );
}

#[test]
fn guesses_and_crops() {
    let (_folder, path) = stored("a.tif", &tiff(CLASSIC, &plain_pages()));
    let guessed = segmented(std::slice::from_ref(&path), &Phases::Guess).unwrap();
    assert_eq!(guessed.guessed, Some([0.0, 1.0, 2.0]));
    let stack = Stack::open(&[path]).unwrap();
    let crop = "3:20,2:9,1:3".parse().unwrap();
    let part = voxels::segment(&stack, &Phases::Guess, &crop, || {}).unwrap();
    assert_eq!(part.wood.dims(), [17, 7, 2]);
    for (z, y, x) in [(0, 0, 0), (1, 6, 16), (1, 3, 5)] {
        assert_eq!(part.wood.get(x, y, z), label(x + 3, y + 2, z + 1) == 1);
    }
    let outside = "3:22,2:9,1:3".parse().unwrap();
    let error = voxels::segment(&stack, &Phases::Guess, &outside, || {}).unwrap_err();
    assert!(
        error.is_usage() && error.to_string().contains("along x"),
        "{error}"
    );
}

#[test]
fn an_unknown_label_is_named_with_its_place() {
    let mut pages = plain_pages();
    pages[2].chunks[0][5 * DIMS[0] + 7] = 9;
    let sentence = refusal("a.tif", &tiff(CLASSIC, &pages));
    for part in ["page 3 of 4", "column 7, row 5", "holds 9"] {
        assert!(sentence.contains(part), "{sentence}");
    }
}
