//! From stored pixels to bit planes, one row at a time.

use crate::label::Label;
use crate::phases::{Phase, Phases};
use crate::sample::PageFormat;

// A code is what one pixel contributes: its phase and, for a guess, which label it had.
const WOOD: u8 = 0x01;
const ADHESIVE: u8 = 0x02;
/// A pixel whose value has no phase.
pub(crate) const UNKNOWN: u8 = 0x80;
/// The label sets that are recognised without `--labels`, each with its bits of "seen".
/// Label 0 and the phases agree between the sets, so one pass can code both and decide at
/// the end which one it was.
const GUESSES: [(&[f64], [u8; 3]); 2] = [
    (&[0.0, 1.0, 2.0], [0x04, 0x08, 0x10]),
    (&[0.0, 128.0, 255.0], [0x04, 0x20, 0x40]),
];

pub(crate) struct Coder<'a> {
    phases: &'a Phases,
    format: PageFormat,
    /// Codes of all values of an 8- or 16-bit sample, by its bit pattern.
    table: Vec<u8>,
}

impl<'a> Coder<'a> {
    pub(crate) fn new(phases: &'a Phases, format: PageFormat) -> Self {
        let table = Vec::new();
        let mut coder = Self {
            phases,
            format,
            table,
        };
        coder.table = match format.pixel_bytes() {
            1 => (0..=u8::MAX).map(|n| coder.code(&[n])).collect(),
            2 => (0..=u16::MAX)
                .map(|n| coder.code(&n.to_ne_bytes()))
                .collect(),
            _ => Vec::new(),
        };
        coder
    }

    fn label(&self, pixel: &[u8]) -> Label {
        Label::of_pixel(pixel, self.format.sample, self.format.channels)
    }

    fn code(&self, pixel: &[u8]) -> u8 {
        let label = self.label(pixel);
        match (self.phases, label) {
            (Phases::Labels(labels), _) => labels.phase(label).map_or(UNKNOWN, phase_code),
            (Phases::Grey(grey), Label::Value(v)) => grey.phase(v).map_or(UNKNOWN, phase_code),
            (Phases::Guess, Label::Value(v)) => guess_code(v),
            (Phases::Grey(_) | Phases::Guess, Label::Rgb(_)) => UNKNOWN,
        }
    }

    /// Sets the bits of one row and returns the union of its codes.
    pub(crate) fn row(&self, pixels: &[u8], wood: &mut [u64], adhesive: &mut [u64]) -> u8 {
        match self.format.pixel_bytes() {
            1 => {
                let codes = pixels.iter().map(|&n| self.table[usize::from(n)]);
                pack(codes, wood, adhesive)
            }
            2 => {
                let values = pixels.as_chunks().0.iter().map(|n| u16::from_ne_bytes(*n));
                let codes = values.map(|n| self.table[usize::from(n)]);
                pack(codes, wood, adhesive)
            }
            bytes => {
                // Labels come in runs: only a change of value is looked up.
                let mut last: (&[u8], u8) = (&[], UNKNOWN);
                let codes = pixels.chunks_exact(bytes).map(|pixel| {
                    if pixel != last.0 {
                        last = (pixel, self.code(pixel));
                    }
                    last.1
                });
                pack(codes, wood, adhesive)
            }
        }
    }

    pub(crate) fn first_unknown(&self, pixels: &[u8]) -> Option<(usize, Label)> {
        let mut pixels = pixels.chunks_exact(self.format.pixel_bytes());
        let x = pixels
            .clone()
            .position(|pixel| self.code(pixel) == UNKNOWN)?;
        Some((x, self.label(pixels.nth(x)?)))
    }
}

/// Whether a stack with this union of codes held exactly the labels of one guess, or those of its
/// void and wood; gives them.
pub(crate) fn guessed(union: u8) -> Option<&'static [f64]> {
    let all = union & !(WOOD | ADHESIVE);
    GUESSES.into_iter().find_map(|(labels, seen)| match all {
        _ if all == seen[0] | seen[1] | seen[2] => Some(labels),
        _ if all == seen[0] | seen[1] => Some(&labels[..2]),
        _ => None,
    })
}

/// The labels of either set that a stack with this union of codes held.
pub(crate) fn found(union: u8) -> Vec<f64> {
    let sets = GUESSES
        .iter()
        .flat_map(|(labels, seen)| labels.iter().zip(seen));
    let held = sets.filter(|(_, seen)| union & **seen != 0);
    let mut held: Vec<f64> = held.map(|(label, _)| *label).collect();
    held.sort_by(f64::total_cmp);
    held.dedup();
    held
}

fn phase_code(phase: Phase) -> u8 {
    [0, WOOD, ADHESIVE][phase as usize]
}

fn guess_code(value: f64) -> u8 {
    let code = |(labels, seen): (&[f64], [u8; 3])| {
        let i = labels.iter().position(|l| *l == value)?;
        Some(phase_code(Phase::ALL[i]) | seen[i])
    };
    GUESSES.into_iter().find_map(code).unwrap_or(UNKNOWN)
}

/// Gathers bit 0 of each code into `wood`, bit 1 into `adhesive`, 64 pixels a word, and
/// returns the union of the codes.
fn pack(mut codes: impl Iterator<Item = u8>, wood: &mut [u64], adhesive: &mut [u64]) -> u8 {
    let mut union = 0;
    for (wood, adhesive) in wood.iter_mut().zip(adhesive) {
        (*wood, *adhesive) = (0, 0);
        for (i, code) in codes.by_ref().take(64).enumerate() {
            union |= code;
            *wood |= u64::from(code & WOOD) << i;
            *adhesive |= u64::from(code >> 1 & 1) << i;
        }
    }
    union
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn packing_puts_every_pixel_at_its_bit() {
        let codes: Vec<u8> = (0..150_u32).map(|i| (i * i % 7 % 3) as u8).collect();
        let (mut wood, mut adhesive) = ([!0; 3], [!0; 3]);
        pack(codes.iter().copied(), &mut wood, &mut adhesive);
        for i in 0..192 {
            let bits = [wood, adhesive].map(|words| words[i / 64] >> (i % 64) & 1 == 1);
            let code = codes.get(i).copied().unwrap_or(0);
            assert_eq!(bits, [code == WOOD, code == ADHESIVE], "{i}");
        }
    }

    #[test]
    fn a_guess_needs_all_labels_of_one_set_or_its_void_and_wood() {
        let union = |values: &[f64]| values.iter().fold(0, |u, v| u | guess_code(*v));
        for known in [
            &[0.0, 1.0, 2.0][..],
            &[0.0, 128.0, 255.0],
            &[0.0, 1.0],
            &[0.0, 128.0],
        ] {
            assert_eq!(guessed(union(known)), Some(known));
        }
        assert_eq!(found(union(&[255.0, 0.0, 2.0])), [0.0, 2.0, 255.0]);
        // What 255 beside 0 alone is, wood or adhesive, nobody can tell.
        for unknown in [
            &[0.0][..],
            &[1.0],
            &[0.0, 255.0],
            &[0.0, 2.0],
            &[1.0, 2.0],
            &[0.0, 1.0, 128.0],
            &[0.0, 1.0, 2.0, 128.0],
            &[0.0, 1.0, 2.0, 3.0],
        ] {
            assert_eq!(guessed(union(unknown)), None, "{unknown:?}");
        }
    }
}
