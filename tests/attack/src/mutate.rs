//! Seeded changes of bytes.

use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

const NAN: f64 = f64::NAN;
const INF: f64 = f64::INFINITY;
/// Numbers at which arithmetic goes wrong, as they stand in binary files.
const NUMBERS: [f64; 16] = [
    0.0, -0.0, -1.0, 1.0, 0.5, 1e-300, 1e-30, 1e-15, 1e-9, 1e-6, 1e9, 1e14, 1e30, 1e300, NAN, INF,
];
const COUNTS: [u64; 12] = [
    0,
    1,
    2,
    63,
    255,
    65_536,
    1 << 20,
    1 << 31,
    1 << 32,
    1 << 40,
    1 << 63,
    u64::MAX,
];
/// The same for text.
const WORDS: [&str; 16] = [
    "0", "-1", "1e-300", "1e300", "nan", "inf", "99999999", "1e9", "1e-9", "\"", "[", "= 1\n",
    "um", "MPa", "true", "../",
];

/// Changes inputs, always in the same way for the same seed.
pub struct Mutator(ChaCha8Rng);

impl Mutator {
    /// The mutator of a seed.
    pub fn new(seed: u64) -> Self {
        Self(ChaCha8Rng::seed_from_u64(seed))
    }

    /// One of `seeds` with one to four changes.
    pub fn changed(&mut self, seeds: &[Vec<u8>]) -> Vec<u8> {
        let mut bytes = seeds[self.below(seeds.len())].clone();
        let text = bytes.is_ascii();
        for _ in 0..=self.below(4) {
            if text && self.below(4) > 0 {
                self.change_word(&mut bytes);
            } else {
                self.change_bytes(&mut bytes);
            }
        }
        bytes
    }

    fn below(&mut self, end: usize) -> usize {
        self.0.random_range(0..end.max(1))
    }

    fn change_bytes(&mut self, bytes: &mut Vec<u8>) {
        let at = self.place(bytes.len());
        match self.below(7) {
            0 => overwrite(bytes, at, &[self.0.next_u32() as u8]),
            1 => {
                let bit = 1 << self.below(8);
                bytes.iter_mut().skip(at).take(1).for_each(|b| *b ^= bit);
            }
            2 => {
                // Arrays begin at multiples of 64 bytes.
                let at = at / 4 * 4;
                let number = NUMBERS[self.below(NUMBERS.len())];
                match self.below(2) {
                    0 => overwrite(bytes, at, &number.to_le_bytes()),
                    _ => overwrite(bytes, at, &(number as f32).to_le_bytes()),
                }
            }
            3 => {
                let count = COUNTS[self.below(COUNTS.len())];
                let size = [4, 8][self.below(2)];
                overwrite(bytes, at, &count.to_le_bytes()[..size]);
            }
            4 => overwrite(bytes, at, &NUMBERS[self.below(NUMBERS.len())].to_le_bytes()),
            5 => bytes.truncate(at),
            _ => {
                let end = (at + 1 + self.below(64)).min(bytes.len());
                let piece = bytes[at.min(end)..end].to_vec();
                let to = self.below(bytes.len());
                overwrite(bytes, to, &piece);
            }
        }
    }

    /// Mostly in the first kilobyte, where the headers are.
    fn place(&mut self, length: usize) -> usize {
        match self.below(4) {
            0 => self.below(length),
            _ => self.below(length.min(1024)),
        }
    }

    /// Replaces, doubles or removes a word: what stands between spaces, quotes and signs.
    fn change_word(&mut self, bytes: &mut Vec<u8>) {
        let word = |b: &u8| b.is_ascii_alphanumeric() || b"._-+".contains(b);
        let at = self.below(bytes.len());
        let start = bytes.iter().skip(at).position(word).map_or(at, |i| at + i);
        let length = bytes.iter().skip(start).take_while(|b| word(b)).count();
        let new = match self.below(6) {
            0 => Vec::new(),
            1 => bytes[start..start + length].repeat(2),
            _ => WORDS[self.below(WORDS.len())].as_bytes().to_vec(),
        };
        bytes.splice(start..start + length, new);
    }
}

fn overwrite(bytes: &mut [u8], at: usize, with: &[u8]) {
    for (byte, new) in bytes.iter_mut().skip(at).zip(with) {
        *byte = *new;
    }
}
