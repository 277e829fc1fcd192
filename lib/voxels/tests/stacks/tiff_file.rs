//! Builds TIFF files, independently of the `tiff` crate.

use std::collections::BTreeMap;

use crate::check::{DIMS, pages};

/// A page: its tags but for the chunk offsets and lengths, and its chunks.
#[derive(Clone)]
pub struct Page {
    tags: BTreeMap<u16, Value>,
    pub chunks: Vec<Vec<u8>>,
    pub tiled: bool,
}

#[derive(Clone)]
struct Value {
    kind: u64,
    count: usize,
    /// Bytes of a number.
    width: usize,
    numbers: Vec<u64>,
}

impl Page {
    /// An uncompressed page of one strip.
    pub fn new(width: usize, height: usize, bits: u16, data: Vec<u8>) -> Self {
        let page = Self {
            tags: BTreeMap::new(),
            chunks: vec![data],
            tiled: false,
        };
        let page = page
            .longs(256, &[width as u32])
            .longs(257, &[height as u32]);
        page.short(258, bits).short(262, 1)
    }

    /// One as large as those of the test volume.
    pub fn of(bits: u16, data: Vec<u8>) -> Self {
        Self::new(DIMS[0], DIMS[1], bits, data)
    }

    fn tag(mut self, tag: u16, kind: u64, width: usize, numbers: Vec<u64>) -> Self {
        let count = if kind == 5 { 1 } else { numbers.len() };
        let value = Value {
            kind,
            count,
            width,
            numbers,
        };
        self.tags.insert(tag, value);
        self
    }

    pub fn shorts(self, tag: u16, values: &[u16]) -> Self {
        self.tag(tag, 3, 2, values.iter().map(|n| u64::from(*n)).collect())
    }

    pub fn short(self, tag: u16, value: u16) -> Self {
        self.shorts(tag, &[value])
    }

    pub fn longs(self, tag: u16, values: &[u32]) -> Self {
        self.tag(tag, 4, 4, values.iter().map(|n| u64::from(*n)).collect())
    }

    /// The image description.
    pub fn described(self, text: &str) -> Self {
        let bytes = text.bytes().chain([0]).map(u64::from);
        self.tag(270, 2, 1, bytes.collect())
    }

    /// Pixels per unit along x and y: `n/d`.
    pub fn resolution(self, n: u32, d: u32) -> Self {
        let fraction = || vec![n.into(), d.into()];
        self.tag(282, 5, 4, fraction()).tag(283, 5, 4, fraction())
    }

    /// Cuts the page into strips of `rows` rows of bytes.
    pub fn strips(mut self, rows: usize) -> Self {
        let strips = self.chunks[0].chunks(rows * DIMS[0]);
        self.chunks = strips.map(<[u8]>::to_vec).collect();
        self.longs(278, &[rows as u32])
    }
}

/// The test volume as pages of 8 bits.
pub fn plain_pages() -> Vec<Page> {
    let pages = pages().into_iter();
    pages.map(|data| Page::of(8, data)).collect()
}

/// A little-endian classic TIFF.
pub fn tiff(pages: &[Page]) -> Vec<u8> {
    tiff_as(false, false, pages)
}

/// The pages of the test volume, each changed.
pub fn tiff_with(change: impl Fn(Page) -> Page) -> Vec<u8> {
    tiff(&plain_pages().into_iter().map(change).collect::<Vec<_>>())
}

/// All chunks of all pages first, then the directories.
pub fn tiff_as(big_endian: bool, big_tiff: bool, pages: &[Page]) -> Vec<u8> {
    let number = |value: u64, width: usize| match big_endian {
        true => value.to_be_bytes()[8 - width..].to_vec(),
        false => value.to_le_bytes()[..width].to_vec(),
    };
    let wide = if big_tiff { 8 } else { 4 };
    let mut file = if big_endian { b"MM" } else { b"II" }.to_vec();
    let head: &[u64] = if big_tiff { &[43, 8, 0] } else { &[42] };
    head.iter().for_each(|n| file.extend(number(*n, 2)));
    let mut link = file.len();
    file.extend(number(0, wide));
    let mut placed = Vec::new();
    for page in pages {
        let mut offsets = Vec::new();
        for chunk in &page.chunks {
            offsets.push(file.len() as u32);
            file.extend(chunk);
        }
        let lengths: Vec<u32> = page.chunks.iter().map(|c| c.len() as u32).collect();
        let (a, b) = if page.tiled { (324, 325) } else { (273, 279) };
        let mut tags = page.clone().longs(a, &offsets).longs(b, &lengths).tags;
        // A test may have set a false one.
        tags.extend(page.tags.clone());
        placed.push(tags);
    }
    for tags in placed {
        let mut entries = Vec::new();
        for (tag, value) in &tags {
            let numbers = value.numbers.iter();
            let mut bytes: Vec<u8> = numbers.flat_map(|n| number(*n, value.width)).collect();
            if bytes.len() > wide {
                let at = file.len() as u64;
                file.extend(bytes);
                bytes = number(at, wide);
            }
            bytes.resize(wide, 0);
            let head = [number((*tag).into(), 2), number(value.kind, 2)];
            entries.extend([head.concat(), number(value.count as u64, wide), bytes].concat());
        }
        let at = number(file.len() as u64, wide);
        file[link..link + wide].copy_from_slice(&at);
        file.extend(number(tags.len() as u64, if big_tiff { 8 } else { 2 }));
        file.extend(entries);
        link = file.len();
        file.extend(number(0, wide));
    }
    file
}
