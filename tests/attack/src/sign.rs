//! Particle files carry checksums, which would stop every change at the door. What is changed
//! is signed again: lengths, checksums and end marker are made right, and nothing else.

use bincode::config::{Configuration, Fixint, Limit, LittleEndian};
use xxhash_rust::xxh3::xxh3_64;

const MAGIC: &[u8; 8] = b"\x89MPTS\r\n\x1a";
const CODEC: Configuration<LittleEndian, Fixint, Limit<{ 1 << 24 }>> =
    bincode::config::legacy().with_limit();
const PREAMBLE: usize = 32;
const END: usize = 16;

/// The bytes with sound checksums, as far as the header can be followed (FORMAT.md).
pub(crate) fn signed(bytes: &[u8]) -> Vec<u8> {
    let mut file = bytes.to_vec();
    if file.len() < PREAMBLE + END {
        return file;
    }
    file[..8].copy_from_slice(MAGIC);
    file[8..12].copy_from_slice(&1_u32.to_le_bytes());
    let length = file.len() as u64;
    file[16..24].copy_from_slice(&length.to_le_bytes());
    let header = u32::from_le_bytes([file[12], file[13], file[14], file[15]]) as usize;
    let Some(end) = PREAMBLE
        .checked_add(header)
        .filter(|&e| e <= file.len() - END)
    else {
        return file;
    };
    let _ = sign_arrays(&mut file, end);
    let hash = {
        let mut hasher = xxhash_rust::xxh3::Xxh3Default::new();
        hasher.update(&file[..24]);
        hasher.update(&file[PREAMBLE..end]);
        hasher.digest().to_le_bytes()
    };
    file[24..32].copy_from_slice(&hash);
    let marker = file.len() - END;
    file[marker..marker + 8].copy_from_slice(b"MPTS-END");
    file[marker + 8..].copy_from_slice(&hash);
    file
}

/// A header as FORMAT.md has it: texts are bytes, of whatever encoding.
type Header = (
    Fixed,
    Vec<Block>,
    u64,
    Vec<[Text; 2]>,
    Vec<Tool>,
    Vec<Section>,
);
type Text = Vec<u8>;
/// Kind, voxel, normal, corners of the box, time, step.
type Fixed = (u32, f64, u8, [f64; 6], f64, u64);
/// Name, material, numbers of voxels, low corner, voxel, voxels that are set.
type Block = (Text, u32, [u64; 3], [f64; 3], f64, u64);
/// Name, version, command, inputs with their hashes.
type Tool = (Text, Text, Vec<Text>, Vec<(Text, u64)>);
/// Name, element, components, rows, offset, checksum.
type Section = (Text, u32, u32, u64, u64, u64);

/// Makes the checksum of each array right, unless the header cannot be followed to its end.
fn sign_arrays(file: &mut [u8], header_end: usize) -> Option<()> {
    let header = &file[PREAMBLE..header_end];
    let (mut header, _): (Header, _) = bincode::decode_from_slice(header, CODEC).ok()?;
    for (_, element, components, rows, offset, checksum) in &mut header.5 {
        let size = match element {
            1 | 3 => 4,
            5 | 6 => 1,
            _ => 8,
        };
        let length = rows.checked_mul((*components).into())?.checked_mul(size)?;
        let array = usize::try_from(*offset).ok()?..offset.checked_add(length)?.try_into().ok()?;
        if let Some(array) = file.get(array) {
            *checksum = xxh3_64(array);
        }
    }
    bincode::encode_into_slice(&header, &mut file[PREAMBLE..header_end], CODEC).ok()?;
    Some(())
}
