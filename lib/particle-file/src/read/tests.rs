//! Headers that lie.

use super::*;
use crate::{BitGrid, Draft, Kind, Material};

/// Everything a tool might do with a file it was given.
fn use_all(file: &ParticleFile) {
    let _ = (file.check(), file.sum());
    let _ = file.for_each_adhesive(|_, _| ());
    for (index, block) in file.header().blocks.iter().enumerate() {
        if let Ok((_, bits)) = file.block(index) {
            assert_eq!(bits.count(), block.count);
            bits.counts_along(0);
        }
    }
}

/// A forged header carries a right checksum, so that only validation stands between its
/// numbers and the arrays.
#[test]
fn forged_headers_are_refused_or_harmless() {
    let bits = BitGrid::from_fn([70, 2, 2], |x, y, z| (x + y + z) % 2 == 0);
    let header = Header::new(Kind::Bond, 1e-6, 1, [0.0; 3], [1e-4; 3]);
    let block = Block::new("adhesive", Material::Adhesive, [0.0; 3], 1e-6, &bits);
    let mut sound = Vec::new();
    Draft::new(header)
        .block(block, &bits)
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
            if let Ok(mut preamble) = Preamble::from_file(&forged) {
                let end = forged.len().min(PREAMBLE + preamble.header_len);
                preamble.checksum = preamble.checksum_with(&forged[PREAMBLE..end]);
                forged[..PREAMBLE].copy_from_slice(&preamble.to_bytes());
                let end = forged.len() - END_LEN;
                forged[end..].copy_from_slice(&layout::end_marker(preamble.checksum));
            }
            match ParticleFile::from_bytes(&forged) {
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
