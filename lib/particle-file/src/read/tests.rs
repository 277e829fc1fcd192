//! Headers that lie, with right checksums: only validation stands between their numbers and the arrays.

use xxhash_rust::xxh3::Xxh3Default;

use super::*;
use crate::{BitGrid, Draft, Kind, Material};

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

fn use_all(file: &ParticleFile) {
    let _ = (file.check(), file.sum());
    let _ = file.liquid().is_ok();
    for (index, block) in file.header().blocks.iter().enumerate() {
        if let Ok((_, bits)) = file.block(index) {
            assert_eq!(bits.count(), block.count);
            bits.counts_along(0);
        }
    }
}

#[test]
fn forged_headers_are_refused_or_harmless() {
    let bits = BitGrid::from_fn([70, 2, 2], |x, y, z| (x + y + z) % 2 == 0);
    let mut sound = Vec::new();
    Draft::new(Header::new(Kind::Bond, 1e-6, 1, [0.0; 3], [1e-4; 3]))
        .block(
            Block::new("adhesive", Material::Adhesive, [0.0; 3], 1e-6, &bits),
            &bits,
        )
        .column("position", 3, &[1.0_f32; 6])
        .column("volume", 1, &[1.0_f32; 2])
        .blob("notes", b"abc")
        .write_to(&mut sound)
        .unwrap();
    let header_len = Preamble::from_file(&sound).unwrap().header_len;
    let (mut refused, mut accepted) = (0, 0);
    for at in 12..PREAMBLE + header_len {
        for value in [0x00, 0x01, 0x02, 0x07, 0x40, 0x7f, 0x80, 0xff] {
            let mut forged = sound.clone();
            forged[at] = value;
            match signed(forged) {
                Err(_) => refused += 1,
                Ok(file) => {
                    accepted += 1;
                    use_all(&file);
                }
            }
        }
    }
    println!("{refused} refused, {accepted} harmless");
    assert!(refused > accepted, "{refused} refused, {accepted} accepted");
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
