//! Files of the test volume in formats other than TIFF.

use std::io::{Cursor, Write};

use flate2::Compression;
use png::{BitDepth, ColorType};

use crate::check::{DIMS, volume};

/// The number types that formats name in their own ways.
pub const NUMBERS: [&str; 10] = [
    "u8", "i8", "u16", "i16", "u32", "i32", "u64", "i64", "f32", "f64",
];

/// Labels as numbers of a type, `factor` times each.
pub fn numbers(kind: &str, big_endian: bool, factor: i32, labels: &[u8]) -> Vec<u8> {
    let number = |label: &u8| {
        let value = factor * i32::from(*label);
        let mut bytes = match kind {
            "f32" => (value as f32).to_le_bytes().to_vec(),
            "f64" => f64::from(value).to_le_bytes().to_vec(),
            whole => {
                let bits: usize = whole[1..].parse().unwrap();
                i64::from(value).to_le_bytes()[..bits / 8].to_vec()
            }
        };
        if big_endian {
            bytes.reverse();
        }
        bytes
    };
    labels.iter().flat_map(number).collect()
}

/// A factor whose products tell the bytes and the sign of a number type apart.
pub fn factor(kind: &str) -> i32 {
    match kind {
        "u8" => 100,
        "u16" => 300,
        kind if kind.starts_with('u') => 1 << 20,
        "i8" => -7,
        _ => -300,
    }
}

/// Values of `bits` bits in rows that end at whole bytes.
pub fn packed(values: &[u8], bits: usize, width: usize) -> Vec<u8> {
    let byte = |part: &[u8]| {
        let values = part.iter().enumerate();
        values.fold(0, |byte, (i, v)| byte | v << (8 - bits * (i + 1)))
    };
    let rows = values.chunks(width);
    rows.flat_map(|row| row.chunks(8 / bits).map(byte))
        .collect()
}

/// A PNG of bytes as the colour type and depth store them.
pub fn png(color: ColorType, depth: BitDepth, stored: &[u8]) -> Vec<u8> {
    let grey: Vec<[u8; 3]> = (0..4).map(|grey| [9 * grey; 3]).collect();
    let palette = (color == ColorType::Indexed).then_some(grey);
    png_with(color, depth, stored, palette.as_deref(), &[])
}

pub fn png_with(
    color: ColorType,
    depth: BitDepth,
    stored: &[u8],
    palette: Option<&[[u8; 3]]>,
    opacity: &[u8],
) -> Vec<u8> {
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, DIMS[0] as u32, DIMS[1] as u32);
    encoder.set_color(color);
    encoder.set_depth(depth);
    if let Some(palette) = palette {
        encoder.set_palette(palette.concat());
    }
    if !opacity.is_empty() {
        encoder.set_trns(opacity.to_vec());
    }
    let mut writer = encoder.write_header().unwrap();
    writer.write_image_data(stored).unwrap();
    writer.finish().unwrap();
    file
}

/// A BMP, rows from the bottom, of rows of bytes as `bits` bits a pixel store them.
pub fn bmp(bits: usize, stored: &[u8], palette: &[[u8; 3]]) -> Vec<u8> {
    let [nx, ny, _] = DIMS.map(|n| n as u32);
    let mut file = b"BM".to_vec();
    let colours = palette.len() as u32;
    let begin = 54 + 4 * colours;
    let planes_and_bits = 1 | (bits as u32) << 16;
    for number in [
        0,
        0,
        begin,
        40,
        nx,
        ny,
        planes_and_bits,
        0,
        0,
        2835,
        2835,
        colours,
        0,
    ] {
        file.extend(number.to_le_bytes());
    }
    palette
        .iter()
        .for_each(|[r, g, b]| file.extend([*b, *g, *r, 0]));
    for row in stored.chunks((DIMS[0] * bits).div_ceil(8)).rev() {
        file.extend(row);
        file.resize(file.len() + row.len().next_multiple_of(4) - row.len(), 0);
    }
    file
}

pub fn jpeg(values: &[u8], quality: u8) -> Vec<u8> {
    let mut file = Vec::new();
    let encoder = jpeg_encoder::Encoder::new(&mut file, quality);
    let [nx, ny, _] = DIMS.map(|n| n as u16);
    let grey = jpeg_encoder::ColorType::Luma;
    encoder.encode(values, nx, ny, grey).unwrap();
    file
}

/// The same grey values as red, green and blue.
pub fn rgb_jpeg(values: &[u8]) -> Vec<u8> {
    let mut file = Vec::new();
    let [nx, ny, _] = DIMS.map(|n| n as u16);
    let pixels: Vec<u8> = values.iter().flat_map(|&value| [value; 3]).collect();
    let encoder = jpeg_encoder::Encoder::new(&mut file, 100);
    (encoder.encode(&pixels, nx, ny, jpeg_encoder::ColorType::Rgb)).unwrap();
    file
}

pub fn zlib(bytes: &[u8]) -> Vec<u8> {
    let mut packed = flate2::write::ZlibEncoder::new(Vec::new(), Compression::default());
    packed.write_all(bytes).unwrap();
    packed.finish().unwrap()
}

pub fn gzip(bytes: &[u8]) -> Vec<u8> {
    let mut packed = flate2::write::GzEncoder::new(Vec::new(), Compression::default());
    packed.write_all(bytes).unwrap();
    packed.finish().unwrap()
}

/// A MetaImage header with lines of its own.
pub fn mhd(kind: &str, more: &str, file: &str) -> Vec<u8> {
    let [nx, ny, nz] = DIMS;
    format!(
        "ObjectType = Image\nNDims = 3\nDimSize = {nx} {ny} {nz}\nElementType = MET_{kind}\n{more}ElementDataFile = {file}\n"
    )
    .into()
}

/// A MetaImage with `data` behind its header.
pub fn mha(kind: &str, more: &str, data: &[u8]) -> Vec<u8> {
    [&mhd(kind, more, "LOCAL"), data].concat()
}

/// A NRRD header with lines of its own, which end it, and `data` behind it.
pub fn nrrd(kind: &str, encoding: &str, more: &str, data: &[u8]) -> Vec<u8> {
    let [nx, ny, nz] = DIMS;
    let head = format!(
        "NRRD0004\n# a comment\ntype: {kind}\ndimension: 3\nsizes: {nx} {ny} {nz}\nencoding: {encoding}\n{more}"
    );
    [head.as_bytes(), data].concat()
}

/// A NIfTI-1 or -2 of `kind`.
pub fn nifti(second: bool, kind: i16, data: &[u8]) -> Vec<u8> {
    let length: usize = if second { 540 } else { 348 };
    let mut head = vec![0; length + 4];
    let mut put = |at: usize, bytes: &[u8]| head[at..at + bytes.len()].copy_from_slice(bytes);
    put(0, &(length as u32).to_le_bytes());
    for (i, n) in [3, DIMS[0], DIMS[1], DIMS[2], 1, 1, 1, 1]
        .into_iter()
        .enumerate()
    {
        match second {
            true => put(16 + 8 * i, &(n as i64).to_le_bytes()),
            false => put(40 + 2 * i, &(n as i16).to_le_bytes()),
        }
    }
    for i in 1..4 {
        match second {
            true => put(104 + 8 * i, &1.45_f64.to_le_bytes()),
            false => put(76 + 4 * i, &1.45_f32.to_le_bytes()),
        }
    }
    if second {
        put(4, b"n+2\0\r\n\x1a\n");
        put(12, &kind.to_le_bytes());
        put(168, &544_i64.to_le_bytes());
        put(500, &3_i32.to_le_bytes());
    } else {
        put(344, b"n+1\0");
        put(70, &kind.to_le_bytes());
        put(108, &352_f32.to_le_bytes());
        put(123, &[3]);
    }
    [&head, data].concat()
}

/// The shape of the test volume as NumPy writes it.
pub fn shape() -> String {
    let [nx, ny, nz] = DIMS;
    format!("{nz}, {ny}, {nx}")
}

/// A `.npy` file as `numpy.save` writes it.
pub fn npy(version: u8, descr: &str, fortran: bool, shape: &str, data: &[u8]) -> Vec<u8> {
    let order = if fortran { "True" } else { "False" };
    let header = format!("{{'descr': '{descr}', 'fortran_order': {order}, 'shape': ({shape}), }}");
    npy_with(version, &header, data)
}

pub fn npy_with(version: u8, header: &str, data: &[u8]) -> Vec<u8> {
    let header = format!("{header:<116}\n");
    let length = (header.len() as u32).to_le_bytes();
    let length = &length[..if version == 1 { 2 } else { 4 }];
    [
        &b"\x93NUMPY"[..],
        &[version, 0],
        length,
        header.as_bytes(),
        data,
    ]
    .concat()
}

/// An archive of `.npy` arrays of bytes by name and shape.
pub fn npz(arrays: &[(&str, &str, &[u8])]) -> Vec<u8> {
    let mut archive = zip::ZipWriter::new(Cursor::new(Vec::new()));
    for (name, shape, data) in arrays {
        let options = zip::write::SimpleFileOptions::default();
        archive.start_file(format!("{name}.npy"), options).unwrap();
        archive
            .write_all(&npy(1, "|u1", false, shape, data))
            .unwrap();
    }
    archive.finish().unwrap().into_inner()
}

/// The test volume in every format of whole volumes but TIFF.
pub fn volumes() -> Vec<(&'static str, Vec<u8>)> {
    let all = volume();
    vec![
        ("npy", npy(1, "|u1", false, &shape(), &all)),
        ("npz", npz(&[("labels", &shape(), &all)])),
        ("mha", mha("UCHAR", "", &all)),
        (
            "mha zlib",
            mha("UCHAR", "CompressedData = True\n", &zlib(&all)),
        ),
        ("nrrd", nrrd("uchar", "raw", "\n", &all)),
        ("nrrd gzip", nrrd("uchar", "gzip", "\n", &gzip(&all))),
        ("nifti", nifti(false, 2, &all)),
        ("nifti 2", nifti(true, 2, &all)),
        ("nifti gzip", gzip(&nifti(false, 2, &all))),
    ]
}
