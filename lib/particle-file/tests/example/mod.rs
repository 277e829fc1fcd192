//! The small file that FORMAT.md shows byte by byte.

use particle_file::{BitGrid, Block, Draft, Header, Kind, Material, Provenance};

pub fn header() -> Header {
    let mut header = Header::new(Kind::State, 1e-6, 1, [0.0; 3], [3e-6, 2e-6, 1e-6]);
    (header.time_s, header.step) = (1.5e-6, 7);
    header.set_attribute("gap_m", "1e-6");
    header.provenance.push(Provenance {
        tool: "mpm-run".into(),
        version: "0.1.0".into(),
        command: vec!["mpm-run".into(), "a.toml".into()],
        inputs: vec![("a.toml".into(), 0x0123_4567_89ab_cdef)],
    });
    header
}

/// Voxels (0, 0, 0), (2, 0, 0) and (1, 1, 0) of 3 x 2 x 1.
pub fn wood() -> BitGrid {
    BitGrid::from_fn([3, 2, 1], |x, y, _| (x + y) % 2 == 0)
}

pub const POSITION: [f32; 6] = [0.5e-6, 1.25e-6, 0.25e-6, 2.5e-6, 1.75e-6, 0.75e-6];
pub const VOLUME: [f32; 2] = [1e-19, 1.25e-19];

pub fn bytes() -> Vec<u8> {
    let wood = wood();
    let block = Block::new("wood-bottom", Material::Rigid, [0.0; 3], 1e-6, &wood);
    let mut bytes = Vec::new();
    Draft::new(header())
        .block(block, &wood)
        .column("position", 3, &POSITION)
        .column("volume", 1, &VOLUME)
        .write_to(&mut bytes)
        .expect("the example is a particle file");
    bytes
}
