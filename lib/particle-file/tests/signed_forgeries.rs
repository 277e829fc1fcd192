//! Headers with sound checksums that say what cannot be.

use particle_file::{Draft, Header, Kind, ParticleFile};
use xxhash_rust::xxh3::Xxh3Default;

/// Preamble, then kind, voxel, normal, box, time, step and an empty list of blocks: FORMAT.md.
const PARTICLES: usize = 32 + 4 + 8 + 1 + 48 + 8 + 8 + 8;
/// Then particles, empty attributes and provenance, the number of arrays and a name of one
/// letter.
const ELEMENT: usize = PARTICLES + 8 + 8 + 8 + 8 + 9;

fn state<'a>(draft: impl FnOnce(Draft<'a>) -> Draft<'a>) -> Vec<u8> {
    let header = Header::new(Kind::State, 1e-6, 1, [0.0; 3], [3e-6; 3]);
    let mut bytes = Vec::new();
    draft(Draft::new(header)).write_to(&mut bytes).unwrap();
    bytes
}

/// Writes a number and makes the checksum of the header right again.
fn forged(mut bytes: Vec<u8>, at: usize, number: &[u8]) -> String {
    bytes[at..at + number.len()].copy_from_slice(number);
    let header = u32::from_le_bytes(bytes[12..16].try_into().unwrap()) as usize;
    let end = (32 + header).min(bytes.len());
    let mut hasher = Xxh3Default::new();
    hasher.update(&bytes[..24]);
    hasher.update(&bytes[32..end]);
    let hash = hasher.digest().to_le_bytes();
    bytes[24..32].copy_from_slice(&hash);
    let marker = bytes.len() - 8;
    bytes[marker..].copy_from_slice(&hash);
    ParticleFile::from_bytes(&bytes).unwrap_err().to_string()
}

#[test]
fn points_without_a_column() {
    let said = forged(state(|draft| draft), PARTICLES, &5_u64.to_le_bytes());
    assert!(said.contains("row for each of 5 material points"), "{said}");
}

#[test]
fn bits_of_no_block() {
    let number = [7_u64];
    let bytes = state(|draft| draft.column("a", 1, &number));
    assert_eq!(bytes[ELEMENT..ELEMENT + 4], 4_u32.to_le_bytes(), "u64");
    let said = forged(bytes, ELEMENT, &0_u32.to_le_bytes());
    assert!(said.contains("column 'a'"), "{said}");
}

#[test]
fn a_header_longer_than_any() {
    let longer = (1_u32 << 24) + 1;
    let said = forged(state(|draft| draft), 12, &longer.to_le_bytes());
    assert!(said.contains("at most 16777216"), "{said}");
}

#[test]
fn vectors_are_three_single_numbers_a_row() {
    let (single, double) = ([0.5_f32; 6], [0.5_f64; 6]);
    let bytes = state(|draft| {
        draft
            .column("position", 3, &single)
            .column("doubles", 3, &double)
            .column("singles", 1, &single[..2])
            .column("pairs", 2, &single[..4])
    });
    let file = ParticleFile::from_bytes(&bytes).unwrap();
    assert_eq!(file.vectors("position").unwrap(), [[0.5; 3]; 2]);
    for other in ["doubles", "singles", "pairs", "none"] {
        assert!(file.vectors(other).is_err(), "{other}");
    }
}
