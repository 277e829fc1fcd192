//! A checksum of what a file holds, whatever made it.

use rayon::prelude::*;
use xxhash_rust::xxh3::{xxh3_64, xxh3_64_with_seed};

use crate::bits::{BitsRef, WORD};
use crate::error::Error;
use crate::header::Block;
use crate::read::ParticleFile;
use crate::section::{Element, Section};

impl ParticleFile {
    /// Checksum of the material points, independent of their order, of the order of blocks
    /// and columns and of the number of threads: the wrapping sum of one XXH3-64 per liquid
    /// point (its values in all columns) and per word of a block that is not empty (its
    /// place and bits). FORMAT.md has the rule. Time, attributes and provenance do not
    /// enter.
    pub fn sum(&self) -> Result<u64, Error> {
        let mut sum = self.sum_of_points()?;
        for index in 0..self.header().blocks.len() {
            let (block, bits) = self.block(index)?;
            sum = sum.wrapping_add(sum_of_block(block, bits));
        }
        Ok(sum)
    }

    fn sum_of_points(&self) -> Result<u64, Error> {
        let points = self.header().particles as usize;
        let mut columns: Vec<(&Section, &[u8])> = Vec::new();
        for (index, section) in self.sections().iter().enumerate() {
            let is_bulk = !matches!(section.element, Element::Bits | Element::Blob);
            if is_bulk && section.rows == self.header().particles {
                columns.push((section, self.values_of(index)?));
            }
        }
        columns.sort_by(|(a, _), (b, _)| a.name.cmp(&b.name));
        let mut schema = Vec::new();
        for (section, _) in &columns {
            schema.extend_from_slice(section.name.as_bytes());
            schema.push(0);
            schema.extend_from_slice(&(section.element as u32).to_le_bytes());
            schema.extend_from_slice(&section.components.to_le_bytes());
        }
        let seed = xxh3_64(&schema);
        let rows: Vec<(&[u8], usize)> = columns
            .iter()
            .map(|(s, bytes)| (*bytes, s.components as usize * s.element.size() as usize))
            .collect();
        Ok((0..points)
            .into_par_iter()
            .with_min_len(4096)
            .map_init(Vec::new, |record, point| {
                record.clear();
                for (bytes, width) in &rows {
                    record.extend_from_slice(&bytes[point * width..(point + 1) * width]);
                }
                xxh3_64_with_seed(record, seed)
            })
            .reduce(|| 0, u64::wrapping_add))
    }
}

fn sum_of_block(block: &Block, bits: BitsRef) -> u64 {
    let mut place = Vec::new();
    place.extend_from_slice(&(block.material as u32).to_le_bytes());
    for x in block.origin_m.iter().chain([&block.voxel_m]) {
        place.extend_from_slice(&x.to_le_bytes());
    }
    let seed = xxh3_64(&place);
    let [nx, ny, _] = bits.dims();
    let words_per_row = nx.div_ceil(WORD).max(1);
    let of_row = |(row, words): (usize, &[u64])| {
        let place = [(row % ny) as u64, (row / ny) as u64];
        (0_u64..)
            .zip(words)
            .filter(|&(_, &word)| word != 0)
            .map(|(w, &word)| {
                let record = [w, place[0], place[1], word];
                xxh3_64_with_seed(bytemuck::bytes_of(&record), seed)
            })
            .fold(0, u64::wrapping_add)
    };
    bits.words()
        .par_chunks(words_per_row)
        .with_min_len(256)
        .enumerate()
        .map(of_row)
        .reduce(|| 0, u64::wrapping_add)
}
