//! Small sound inputs of every kind, from which mutations start.

use std::fs;
use std::io::Cursor;
use std::path::Path;

use bondline::{Opening, PlacedVoxels, Specimen};
use particle_file::{BitGrid, Block, Draft, Header, Kind, Material};
use tiff::encoder::{Compression, DeflateLevel, TiffEncoder, colortype};
use units::Axis;
use voxels::TiffWriter;

use crate::runs::{SCHEMES, case_text};

/// Voxel edge, m.
const VOXEL: f64 = 1.45e-6;
/// Voxels of the specimen.
const DIMS: [usize; 3] = [8, 24, 8];

/// Wood with grooves on both sides of a layer of adhesive.
fn letter(x: usize, y: usize, z: usize) -> u8 {
    match y {
        10..14 => b'a',
        4..10 if x < 4 => b' ',
        14..20 if z < 4 => b' ',
        _ => b'w',
    }
}

fn parts() -> [BitGrid; 2] {
    [b'w', b'a'].map(|wanted| BitGrid::from_fn(DIMS, |x, y, z| letter(x, y, z) == wanted))
}

fn written(draft: &Draft) -> Vec<u8> {
    let mut bytes = Vec::new();
    let written = draft.write_to(&mut bytes);
    assert!(written.is_ok(), "{written:?}");
    bytes
}

fn header(kind: Kind, min: [f64; 3], max: [f64; 3]) -> Header {
    let mut header = Header::new(kind, VOXEL, 1, min, max);
    header.set_attribute("crop", "0:8,0:24,0:8");
    header
}

/// Every kind of particle file but checkpoints.
pub(crate) fn particle_files() -> Vec<Vec<u8>> {
    let [wood, adhesive] = parts();
    let max = DIMS.map(|n| n as f64 * VOXEL);
    let block = |name, material, bits| Block::new(name, material, [0.0; 3], VOXEL, bits);
    let specimen = Draft::new(header(Kind::Specimen, [0.0; 3], max))
        .block(block("wood", Material::Rigid, &wood), &wood)
        .block(block("adhesive", Material::Adhesive, &adhesive), &adhesive);
    let places: Vec<f32> = (0..64 * 3).map(|i| 1e-6 * (i % 11) as f32).collect();
    let numbers = vec![1e-18_f32; 64];
    let mut state = header(Kind::State, [0.0; 3], max);
    state.set_attribute("shear_rate_convention", "paper");
    let state = Draft::new(state)
        .block(block("wood-bottom", Material::Rigid, &wood), &wood)
        .block(block("wood-top", Material::Rigid, &wood), &wood)
        .column("position", 3, &places)
        .column("velocity", 3, &places)
        .column("volume", 1, &numbers)
        .column("pressure", 1, &numbers)
        .column("shear_rate", 1, &numbers);
    vec![written(&specimen), bond(), written(&state)]
}

/// The bond line of the specimen before pressing.
pub(crate) fn bond() -> Vec<u8> {
    let parts = parts();
    let [wood, adhesive] = parts
        .each_ref()
        .map(|bits| PlacedVoxels::at_origin(bits.view(), VOXEL));
    let opening = Opening {
        normal: Axis::Y,
        voxels_per_cell: 2,
        gap_m: None,
        tolerance: 0.1,
    };
    let specimen = Specimen::new(wood, adhesive);
    let built = specimen.and_then(|specimen| bondline::build(&specimen, None, &opening));
    let bond = built.unwrap_or_else(|e| panic!("the bond of the seeds: {e}"));
    let mut header = header(Kind::Bond, bond.box_min_m, bond.box_max_m);
    header.set_attribute("gap_m", bond.gap_m);
    written(&bond.draft(header))
}

/// Cases of bonds and of scenes with bodies.
pub(crate) fn cases() -> Vec<Vec<u8>> {
    let own = Path::new(env!("CARGO_MANIFEST_DIR"));
    let files = [
        "../../pipelines/cases/pf-implicit.toml",
        "../../pipelines/cases/pva-pf-xpic.toml",
        "seeds/free-drop.toml",
        "seeds/clamp.toml",
        "seeds/duct.toml",
    ];
    let read = |name: &str| fs::read(own.join(name)).unwrap_or_else(|e| panic!("{name}: {e}"));
    let plain = SCHEMES.map(|scheme| case_text(scheme).into_bytes());
    plain.into_iter().chain(files.map(read)).collect()
}

/// Values of the stacks, one a voxel: 0, 1 or 2.
fn labels() -> Vec<u8> {
    let [nx, ny, nz] = DIMS;
    let label = |i: usize| match letter(i % nx, i / nx % ny, i / nx / ny) {
        b'w' => 1,
        b'a' => 2,
        _ => 0,
    };
    (0..nx * ny * nz).map(label).collect()
}

/// TIFF stacks: ours, and those of every compression and sample that another encoder writes.
pub(crate) fn tiffs() -> Vec<Vec<u8>> {
    let mut own = Vec::new();
    let written = TiffWriter::new(&mut own, DIMS, VOXEL, "").and_then(|mut writer| {
        (labels().chunks(DIMS[0] * DIMS[1])).try_for_each(|page| writer.write_page(page))
    });
    assert!(written.is_ok(), "{written:?}");
    let mut seeds = vec![own];
    for compression in [
        Compression::Uncompressed,
        Compression::Lzw,
        Compression::Deflate(DeflateLevel::Fast),
        Compression::Packbits,
    ] {
        for wide in [false, true] {
            seeds.push(encoded(compression, wide));
        }
    }
    seeds
}

/// A TIFF by the encoder of the `tiff` crate; `wide` is BigTIFF of 16 bits.
fn encoded(compression: Compression, wide: bool) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    let [nx, ny, _] = DIMS.map(|n| n as u32);
    let labels = labels();
    let mut pages = labels.chunks((nx * ny) as usize);
    let written = if wide {
        TiffEncoder::new_big(&mut bytes).and_then(|encoder| {
            let mut encoder = encoder.with_compression(compression);
            pages.try_for_each(|page| {
                let page: Vec<u16> = page.iter().map(|&l| u16::from(l)).collect();
                encoder.write_image::<colortype::Gray16>(nx, ny, &page)
            })
        })
    } else {
        TiffEncoder::new(&mut bytes).and_then(|encoder| {
            let mut encoder = encoder.with_compression(compression);
            pages.try_for_each(|page| encoder.write_image::<colortype::Gray8>(nx, ny, page))
        })
    };
    assert!(written.is_ok(), "{written:?}");
    bytes.into_inner()
}

/// NumPy arrays of several types, in both orders.
pub(crate) fn arrays() -> Vec<Vec<u8>> {
    let [nx, ny, nz] = DIMS;
    let array = |descr: &str, fortran: &str, value: fn(u8) -> Vec<u8>| {
        let header = format!(
            "{{'descr': '{descr}', 'fortran_order': {fortran}, 'shape': ({nz}, {ny}, {nx}), }}"
        );
        let padded = format!("{header:<117}\n");
        let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
        bytes.extend((padded.len() as u16).to_le_bytes());
        bytes.extend(padded.as_bytes());
        bytes.extend(labels().into_iter().flat_map(value));
        bytes
    };
    vec![
        array("|u1", "False", |l| vec![l]),
        array("<i2", "True", |l| i16::from(l).to_le_bytes().to_vec()),
        array(">f8", "False", |l| f64::from(l).to_be_bytes().to_vec()),
    ]
}

/// MetaImages with their data behind the header and beside it.
pub(crate) fn meta_images() -> Vec<Vec<u8>> {
    let [nx, ny, nz] = DIMS;
    let header = |kind: &str, dims: &str, more: &str, file: &str| {
        format!(
            "ObjectType = Image\nNDims = 3\nDimSize = {dims}\nElementType = {kind}\n{more}ElementDataFile = {file}\n"
        )
        .into_bytes()
    };
    let whole = format!("{nx} {ny} {nz}");
    let spaced =
        "ElementByteOrderMSB = True\nElementSpacing = 1.45 1.45 1.45\nDistanceUnits = um\n";
    let mut behind = header("MET_UCHAR", &whole, "", "LOCAL");
    behind.extend(labels());
    vec![
        behind,
        header("MET_USHORT", "5 6 20", spaced, "a.raw"),
        header("MET_CHAR", "10 10 12", "CompressedData = False\n", "a.raw"),
    ]
}
