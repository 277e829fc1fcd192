//! Builds small TIFF files byte by byte, independently of the reader and of the `tiff` crate.
#![allow(dead_code)] // each test binary uses its part

use std::path::PathBuf;

use voxels::{Crop, Error, Phases, Segmented, Stack, segment};

/// Columns, rows and pages of the test volume: odd, and rows that do not fill bytes.
pub const DIMS: [usize; 3] = [21, 13, 4];

/// The label (0, 1 or 2) of a voxel of the test volume.
pub fn label(x: usize, y: usize, z: usize) -> u8 {
    ((x * x + 3 * y + 5 * z + x * y * z) % 7 % 3) as u8
}

/// Values of a page of the test volume, rows of `DIMS[0]`.
pub fn page<T>(z: usize, value: impl Fn(u8) -> T) -> Vec<T> {
    let [nx, ny, _] = DIMS;
    (0..nx * ny)
        .map(|i| value(label(i % nx, i / nx, z)))
        .collect()
}

/// All pages as bytes, `bytes` of each label.
pub fn pages<const N: usize>(bytes: impl Fn(u8) -> [u8; N]) -> Vec<Vec<u8>> {
    (0..DIMS[2]).map(|z| page(z, &bytes).concat()).collect()
}

/// A value of a tag.
#[derive(Clone)]
pub enum Value {
    Short(Vec<u16>),
    Long(Vec<u32>),
    Ascii(String),
    Rational(u32, u32),
}

/// A page: its tags but for the chunk offsets and lengths, and its chunks.
#[derive(Clone)]
pub struct Page {
    pub tags: Vec<(u16, Value)>,
    pub chunks: Vec<Vec<u8>>,
    pub tiled: bool,
}

impl Page {
    /// An uncompressed page of one strip.
    pub fn new(width: usize, height: usize, bits: u16, data: Vec<u8>) -> Self {
        Self {
            tags: vec![
                (256, Value::Long(vec![width as u32])),
                (257, Value::Long(vec![height as u32])),
                (258, Value::Short(vec![bits])),
                (262, Value::Short(vec![1])),
            ],
            chunks: vec![data],
            tiled: false,
        }
    }

    /// Sets a tag.
    pub fn tag(mut self, tag: u16, value: Value) -> Self {
        self.tags.retain(|(t, _)| *t != tag);
        self.tags.push((tag, value));
        self
    }

    /// Sets a tag of one short.
    pub fn short(self, tag: u16, value: u16) -> Self {
        self.tag(tag, Value::Short(vec![value]))
    }
}

/// Byte order and flavour of a file.
#[derive(Clone, Copy)]
pub struct Flavour {
    pub big_endian: bool,
    pub big_tiff: bool,
}

/// Little-endian classic TIFF.
pub const CLASSIC: Flavour = Flavour {
    big_endian: false,
    big_tiff: false,
};

struct Writer {
    bytes: Vec<u8>,
    flavour: Flavour,
}

impl Writer {
    fn put(&mut self, value: u64, width: usize) {
        if self.flavour.big_endian {
            self.bytes.extend(&value.to_be_bytes()[8 - width..]);
        } else {
            self.bytes.extend(&value.to_le_bytes()[..width]);
        }
    }

    fn offset_width(&self) -> usize {
        if self.flavour.big_tiff { 8 } else { 4 }
    }

    fn patch_offset(&mut self, at: usize, value: u64) {
        let end = self.bytes.split_off(at);
        self.put(value, self.offset_width());
        self.bytes.extend(&end[self.offset_width()..]);
    }
}

/// A whole file: all chunks of all pages first, then the directories.
pub fn tiff(flavour: Flavour, pages: &[Page]) -> Vec<u8> {
    let mut w = Writer {
        bytes: Vec::new(),
        flavour,
    };
    w.bytes
        .extend(if flavour.big_endian { b"MM" } else { b"II" });
    w.put(if flavour.big_tiff { 43 } else { 42 }, 2);
    if flavour.big_tiff {
        w.put(8, 2);
        w.put(0, 2);
    }
    let mut link = w.bytes.len();
    w.put(0, w.offset_width());
    let mut placed = Vec::new();
    for page in pages {
        let offsets: Vec<u32> = page
            .chunks
            .iter()
            .map(|chunk| {
                let at = w.bytes.len() as u32;
                w.bytes.extend(chunk);
                at
            })
            .collect();
        placed.push(offsets);
    }
    for (page, offsets) in pages.iter().zip(placed) {
        let lengths = page.chunks.iter().map(|c| c.len() as u32).collect();
        let (a, b) = if page.tiled { (324, 325) } else { (273, 279) };
        let mut tags = page.tags.clone();
        for (tag, value) in [(a, Value::Long(offsets)), (b, Value::Long(lengths))] {
            // A test may have set a false one.
            if tags.iter().all(|(t, _)| *t != tag) {
                tags.push((tag, value));
            }
        }
        link = directory(&mut w, link, tags);
    }
    w.bytes
}

/// Appends a directory, links it at byte `link` and gives the byte of its own link.
fn directory(w: &mut Writer, link: usize, mut tags: Vec<(u16, Value)>) -> usize {
    tags.sort_by_key(|(tag, _)| *tag);
    let width = w.offset_width();
    let mut fields = Vec::new();
    for (tag, value) in tags {
        let mut field = Writer {
            bytes: Vec::new(),
            flavour: w.flavour,
        };
        let (kind, count) = match value {
            Value::Short(v) => {
                v.iter().for_each(|n| field.put(u64::from(*n), 2));
                (3, v.len())
            }
            Value::Long(v) => {
                v.iter().for_each(|n| field.put(u64::from(*n), 4));
                (4, v.len())
            }
            Value::Ascii(text) => {
                field.bytes.extend(text.as_bytes());
                field.bytes.push(0);
                (2, text.len() + 1)
            }
            Value::Rational(a, b) => {
                field.put(a.into(), 4);
                field.put(b.into(), 4);
                (5, 1)
            }
        };
        let mut bytes = field.bytes;
        if bytes.len() > width {
            let at = w.bytes.len() as u64;
            w.bytes.extend(&bytes);
            let mut pointer = Writer {
                bytes: Vec::new(),
                flavour: w.flavour,
            };
            pointer.put(at, width);
            bytes = pointer.bytes;
        }
        bytes.resize(width, 0);
        fields.push((tag, kind, count, bytes));
    }
    w.patch_offset(link, w.bytes.len() as u64);
    w.put(fields.len() as u64, if w.flavour.big_tiff { 8 } else { 2 });
    for (tag, kind, count, bytes) in fields {
        w.put(tag.into(), 2);
        w.put(kind, 2);
        w.put(count as u64, width);
        w.bytes.extend(bytes);
    }
    let link = w.bytes.len();
    w.put(0, width);
    link
}

/// The test volume as plain 8-bit pages.
pub fn plain_pages() -> Vec<Page> {
    let [nx, ny, _] = DIMS;
    let data = pages(|label| [label]).into_iter();
    data.map(|data| Page::new(nx, ny, 8, data)).collect()
}

/// Writes `bytes` as `name` into a folder that lives as long as the returned guard.
pub fn stored(name: &str, bytes: &[u8]) -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    std::fs::write(&path, bytes).unwrap();
    (folder, path)
}

/// Opens and segments a whole stack.
pub fn segmented(paths: &[PathBuf], phases: &Phases) -> Result<Segmented, Error> {
    let stack = Stack::open(paths)?;
    segment(&stack, phases, &Crop::whole(stack.dims()), || {})
}

/// Panics unless the file at `path` is the test volume with `labels` for 0, 1, 2.
pub fn assert_test_volume(what: &str, path: &std::path::Path, labels: [&str; 3]) {
    let [void, wood, adhesive] = labels;
    let map = format!("void={void},wood={wood},adhesive={adhesive}");
    let found = segmented(&[path.to_owned()], &Phases::Labels(map.parse().unwrap()))
        .unwrap_or_else(|e| panic!("{what}: {e}"));
    assert_eq!(found.wood.dims(), DIMS, "{what}");
    for z in 0..DIMS[2] {
        for y in 0..DIMS[1] {
            for x in 0..DIMS[0] {
                let expected = label(x, y, z);
                let got = (found.wood.get(x, y, z), found.adhesive.get(x, y, z));
                assert_eq!(got, (expected == 1, expected == 2), "{what}: {x} {y} {z}");
            }
        }
    }
}

/// The sentence a file is refused with.
pub fn refusal(name: &str, bytes: &[u8]) -> String {
    let (_folder, path) = stored(name, bytes);
    let labels = Phases::Labels("void=0,wood=1,adhesive=2".parse().unwrap());
    match segmented(&[path], &labels) {
        Ok(_) => panic!("accepted, but should be refused"),
        Err(error) => error.to_string(),
    }
}

/// Opens and segments many damaged copies of `files`, the same ones each time; how many were read.
pub fn damaged(files: &[Vec<u8>], name: &str) -> usize {
    let mut state = 2026_u64;
    let mut random = |below: usize| {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        state as usize % below.max(1)
    };
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    let grey = Phases::Grey("wood=0.5..1.5,adhesive=1.6..".parse().unwrap());
    let mut read = 0;
    for round in 0..400 * files.len() {
        let mut file = files[round % files.len()].clone();
        for _ in 0..=random(4) {
            // Headers matter most.
            let end = if random(2) == 0 {
                file.len()
            } else {
                file.len().min(160)
            };
            let at = random(end);
            file[at] = [random(256) as u8, 0, 255, file[at] ^ 1][random(4)];
        }
        if random(8) == 0 {
            file.truncate(random(file.len()));
        }
        std::fs::write(&path, &file).unwrap();
        let paths = [path.clone()];
        read += usize::from(segmented(&paths, &grey).is_ok());
    }
    read
}

/// Bytes by zlib.
pub fn zlib(bytes: &[u8]) -> Vec<u8> {
    let mut packed = flate2::write::ZlibEncoder::new(Vec::new(), flate2::Compression::default());
    std::io::Write::write_all(&mut packed, bytes).unwrap();
    packed.finish().unwrap()
}
