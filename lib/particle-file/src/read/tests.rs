//! Headers that lie, with right checksums: only validation stands between their numbers and the arrays.

use xxhash_rust::xxh3::Xxh3Default;

use super::*;
use crate::{Draft, Kind};

fn signed(mut bytes: Vec<u8>) -> Result<ParticleFile, Error> {
    let length: [u8; 4] = bytes[12..16].try_into().unwrap();
    let end = bytes
        .len()
        .min(PREAMBLE + u32::from_le_bytes(length) as usize);
    let mut hasher = Xxh3Default::new();
    hasher.update(&bytes[..24]);
    hasher.update(&bytes[PREAMBLE..end]);
    let checksum = hasher.digest();
    bytes[24..PREAMBLE].copy_from_slice(&checksum.to_le_bytes());
    let end = bytes.len() - END_LEN;
    bytes[end..].copy_from_slice(&layout::end_marker(checksum));
    ParticleFile::from_bytes(&bytes)
}

fn written(draft: impl FnOnce(Draft) -> Draft) -> Vec<u8> {
    let header = Header::new(Kind::State, 1e-6, 1, [0.0; 3], [1e-4; 3]);
    let mut bytes = Vec::new();
    draft(Draft::new(header)).write_to(&mut bytes).unwrap();
    bytes
}

#[test]
fn what_cannot_be_is_named() {
    // Preamble, then kind, voxel, normal, box, time, step and an empty list of blocks: FORMAT.md.
    const PARTICLES: usize = 32 + 4 + 8 + 1 + 48 + 8 + 8 + 8;
    // Then particles, empty attributes and provenance, the number of arrays and a name of one letter.
    const ELEMENT: usize = PARTICLES + 8 + 8 + 8 + 8 + 9;
    let bare = written(|draft| draft);
    let numbers = written(|draft| draft.column("a", 1, &[7_u64]));
    assert_eq!(numbers[ELEMENT..ELEMENT + 4], 4_u32.to_le_bytes(), "u64");
    for (file, at, number, reason) in [
        (&bare, PARTICLES, 5, "row for each of 5 material points"),
        (&numbers, ELEMENT, 0, "column 'a'"),
        (&bare, 12, (1 << 24) + 1, "at most 16777216"),
    ] {
        let mut forged = file.clone();
        forged[at..at + 4].copy_from_slice(&u32::to_le_bytes(number));
        let said = signed(forged).unwrap_err().to_string();
        assert!(said.contains(reason), "{said}");
    }
}
