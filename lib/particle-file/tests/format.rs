//! FORMAT.md holds: the bytes, and that nothing but a whole and sound file is accepted.

use particle_file::{BitGrid, Block, Draft, Header, Kind, Material, ParticleFile, Provenance};

const FORMAT: &str = include_str!("../FORMAT.md");

fn golden() -> Vec<u8> {
    let (_, dump) = FORMAT.split_once("```hex\n").unwrap();
    let (dump, _) = dump.split_once("```").unwrap();
    dump.lines()
        .flat_map(|line| line.split_once(": ").unwrap().1.split(' '))
        .map(|byte| u8::from_str_radix(byte, 16).unwrap())
        .collect()
}

/// The header of the small file that FORMAT.md shows byte by byte.
fn header() -> Header {
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

fn wood() -> BitGrid {
    BitGrid::from_fn([3, 2, 1], |x, y, _| (x + y) % 2 == 0)
}

const POSITION: [f32; 6] = [0.5e-6, 1.25e-6, 0.25e-6, 2.5e-6, 1.75e-6, 0.75e-6];
const VOLUME: [f32; 2] = [1e-19, 1.25e-19];

fn example() -> Vec<u8> {
    let wood = wood();
    let block = Block::new("wood-bottom", Material::Rigid, [0.0; 3], 1e-6, &wood);
    let draft = Draft::new(header()).block(block, &wood);
    written(
        &draft
            .column("position", 3, &POSITION)
            .column("volume", 1, &VOLUME),
    )
}

fn written(draft: &Draft) -> Vec<u8> {
    let mut bytes = Vec::new();
    draft.write_to(&mut bytes).unwrap();
    bytes
}

/// A wood voxel costs half a byte in walls of 3 voxels every 18, as hybrid poplar fibres at 1.45 um: 31 % wood.
#[test]
fn written_bytes_are_those_of_the_specification() {
    assert_eq!(example(), golden());
    let wood = BitGrid::from_fn([393, 96, 40], |x, y, _| x % 18 < 3 || y % 18 < 3);
    let block = Block::new("wood", Material::Rigid, [0.0; 3], 1e-6, &wood);
    let bytes = written(&Draft::new(header()).block(block, &wood)).len();
    let each = bytes as f64 / wood.count() as f64;
    assert!((0.4..0.55).contains(&each), "{each} bytes per wood voxel");
}

#[test]
fn the_specified_file_reads_back() {
    let file = ParticleFile::from_bytes(&golden()).unwrap();
    let wood = wood();
    let block = Block::new("wood-bottom", Material::Rigid, [0.0; 3], 1e-6, &wood);
    let expected = Header {
        blocks: vec![block],
        particles: 2,
        ..header()
    };
    assert_eq!(file.header(), &expected);
    assert_eq!(file.block(0).unwrap().1, wood.view());
    assert_eq!(file.column::<f32>("volume").unwrap(), &VOLUME);
    assert_eq!(file.vectors("position").unwrap().as_flattened(), &POSITION);
    let sum = format!("`{:016x}`", file.sum().unwrap());
    assert!(FORMAT.contains(&sum), "sum {sum} is not in FORMAT.md");
    file.check().unwrap();
}

#[test]
fn every_truncation_and_every_extension_is_refused() {
    let whole = example();
    let longer = [whole.clone(), vec![0]].concat();
    for bytes in (0..whole.len()).map(|len| &whole[..len]).chain([&*longer]) {
        let opened = ParticleFile::from_bytes(bytes);
        assert!(opened.is_err(), "{} bytes are accepted", bytes.len());
    }
}

#[test]
fn every_flipped_bit_is_found() {
    let whole = example();
    let first_array = 0x200;
    let end_marker = whole.len() - 16;
    for bit in 0..whole.len() * 8 {
        let mut flipped = whole.clone();
        flipped[bit / 8] ^= 1 << (bit % 8);
        let opened = ParticleFile::from_bytes(&flipped);
        if bit / 8 < first_array || bit / 8 >= end_marker {
            assert!(opened.is_err(), "bit {bit} of header or end marker");
        } else {
            assert!(opened.unwrap().check().is_err(), "bit {bit} of the arrays");
        }
    }
}

#[test]
fn a_damaged_array_is_refused_on_use_and_spoils_no_other() {
    let mut damaged = example();
    damaged[0x240] ^= 1;
    let file = ParticleFile::from_bytes(&damaged).unwrap();
    assert!(file.column::<f32>("volume").is_ok());
    let error = file.vectors("position").unwrap_err().to_string();
    assert!(error.contains("damaged array 'position'"), "{error}");
}

#[test]
fn columns_come_back_in_every_type_and_only_in_their_own() {
    let (a, b, c) = ([1.5_f64, -0.0], [7_u32; 4], [u64::MAX, 0]);
    let header = Header::new(Kind::State, 1e-6, 0, [0.0; 3], [1e-3; 3]);
    let draft = Draft::new(header)
        .column("a", 1, &a)
        .column("b", 2, &b)
        .column("c", 1, &c)
        .column("d", 1, &[1_u8, 255])
        .blob("notes", b"five!");
    let file = ParticleFile::from_bytes(&written(&draft)).unwrap();
    assert_eq!(file.column::<f64>("a").unwrap(), a);
    assert_eq!(file.column::<u32>("b").unwrap(), b);
    assert_eq!(file.column::<u64>("c").unwrap(), c);
    assert_eq!(file.column::<u8>("d").unwrap(), [1, 255]);
    assert_eq!(file.blob("notes").unwrap(), b"five!");
    let names: String = file.columns().map(|s| s.name.as_str()).collect();
    assert_eq!(names, "abcd");
    assert!(file.column::<f32>("a").is_err() && file.column::<u8>("notes").is_err());
    assert!(file.vectors("b").is_err() && file.block(0).is_err());
    let (single, double) = ([0.5_f32; 6], [0.5_f64; 6]);
    let draft = Draft::new(Header::new(Kind::State, 1e-6, 0, [0.0; 3], [1e-3; 3]))
        .column("position", 3, &single)
        .column("doubles", 3, &double)
        .column("singles", 1, &single[..2])
        .column("pairs", 2, &single[..4]);
    let vectors = ParticleFile::from_bytes(&written(&draft)).unwrap();
    assert_eq!(vectors.vectors("position").unwrap(), [[0.5; 3]; 2]);
    for other in ["doubles", "singles", "pairs", "none"] {
        assert!(vectors.vectors(other).is_err(), "{other}");
    }
    for section in file.sections() {
        assert_eq!(section.offset % 64, 0);
    }
}

#[test]
fn a_number_that_is_not_finite_is_found_by_row() {
    let header = Header::new(Kind::State, 1e-6, 0, [0.0; 3], [1e-3; 3]);
    let mut position = vec![0.5_f32; 3 * 40_000];
    position[3 * 30_001 + 1] = f32::NAN;
    position[3 * 35_000] = f32::INFINITY;
    let volume = vec![1.0_f32; 40_000];
    let draft = Draft::new(header).column("position", 3, &position);
    let file = written(&draft.column("volume", 1, &volume));
    let file = ParticleFile::from_bytes(&file).unwrap();
    let said = file.check().unwrap_err().to_string();
    assert!(said.contains("row 30001 of column 'position'"), "{said}");
    let said = file.liquid().unwrap_err().to_string();
    assert!(said.contains("a material point 30001 at"), "{said}");
}

#[test]
fn a_column_in_pieces_is_the_column() {
    let (volume, velocity) = ([1.0_f32; 4], [[0.5_f32, -1.0, 2.0]; 4]);
    let flat = velocity.as_flattened();
    let header = Header::new(Kind::State, 1e-6, 1, [0.0; 3], [1e-6; 3]);
    let begun = || Draft::new(header.clone()).column("volume", 1, &volume);
    let whole = written(&begun().column("velocity", 3, flat));
    // Pieces need not end with rows, and may be empty.
    let pieces = written(&begun().pieces("velocity", 3, |take| {
        for part in [0..5, 5..5, 5..12] {
            take(&flat[part]);
        }
    }));
    assert!(pieces == whole);
    // One that is not as long as the others is refused, as a column is.
    let none = begun().pieces::<f32>("velocity", 3, |_| {});
    assert!(none.write_to(&mut Vec::new()).is_err());
}

/// Readers take no header above 16 MiB, so none is written: the file would be lost.
#[test]
fn a_header_that_no_reader_takes_is_not_written() {
    let written = |bytes: usize| {
        let mut header = header();
        header.set_attribute("notes", "x".repeat(bytes));
        let mut file = Vec::new();
        Draft::new(header).write_to(&mut file).map(|()| file)
    };
    let large = written((1 << 24) - 4096).unwrap();
    ParticleFile::from_bytes(&large).unwrap().check().unwrap();
    let said = written(1 << 24).unwrap_err().to_string();
    assert!(said.contains("its header has"), "{said}");
}
