//! FORMAT.md holds: the bytes, and that nothing but a whole and sound file is accepted.

mod example;

use particle_file::{BitGrid, Block, Draft, Header, Kind, Material, ParticleFile};

/// The bytes of the dump in FORMAT.md.
fn golden() -> Vec<u8> {
    let text = include_str!("../FORMAT.md");
    let dump = text
        .split("```hex\n")
        .nth(1)
        .unwrap()
        .split("```")
        .next()
        .unwrap();
    dump.lines()
        .flat_map(|line| line.split_once(": ").unwrap().1.split(' '))
        .map(|byte| u8::from_str_radix(byte, 16).unwrap())
        .collect()
}

#[test]
fn written_bytes_are_those_of_the_specification() {
    assert_eq!(example::bytes(), golden());
}

#[test]
fn the_specified_file_reads_back() {
    let file = ParticleFile::from_bytes(&golden()).unwrap();
    let wood = example::wood();
    let block = Block::new("wood-bottom", Material::Rigid, [0.0; 3], 1e-6, &wood);
    let expected = Header {
        blocks: vec![block],
        particles: 2,
        ..example::header()
    };
    assert_eq!(file.header(), &expected);
    assert_eq!(file.block(0).unwrap().1, wood.view());
    assert_eq!(file.column::<f32>("volume").unwrap(), &example::VOLUME);
    assert_eq!(
        file.vectors("position").unwrap().as_flattened(),
        &example::POSITION
    );
    let text = include_str!("../FORMAT.md");
    let sum = format!("{:016x}", file.sum().unwrap());
    assert!(
        text.contains(&format!("`{sum}`")),
        "sum {sum} is not in FORMAT.md"
    );
    file.check().unwrap();
}

#[test]
fn every_truncation_and_every_extension_is_refused() {
    let whole = example::bytes();
    for len in 0..whole.len() {
        assert!(
            ParticleFile::from_bytes(&whole[..len]).is_err(),
            "{len} bytes are accepted"
        );
    }
    let mut longer = whole;
    longer.push(0);
    assert!(ParticleFile::from_bytes(&longer).is_err());
}

#[test]
fn every_flipped_bit_is_found() {
    let whole = example::bytes();
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
    let mut damaged = example::bytes();
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
    let mut bytes = Vec::new();
    Draft::new(header)
        .column("a", 1, &a)
        .column("b", 2, &b)
        .column("c", 1, &c)
        .column("d", 1, &[1_u8, 255])
        .blob("notes", b"five!")
        .write_to(&mut bytes)
        .unwrap();
    let file = ParticleFile::from_bytes(&bytes).unwrap();
    assert_eq!(file.column::<f64>("a").unwrap(), a);
    assert_eq!(file.column::<u32>("b").unwrap(), b);
    assert_eq!(file.column::<u64>("c").unwrap(), c);
    assert_eq!(file.column::<u8>("d").unwrap(), [1, 255]);
    assert_eq!(file.blob("notes").unwrap(), b"five!");
    assert_eq!(
        file.columns().map(|s| s.name.as_str()).collect::<String>(),
        "abcd"
    );
    assert!(file.column::<f32>("a").is_err() && file.column::<u8>("notes").is_err());
    assert!(file.vectors("b").is_err() && file.block(0).is_err());
    for section in file.sections() {
        assert_eq!(section.offset % 64, 0);
    }
}

#[test]
fn a_number_that_is_not_finite_is_found_by_row() {
    let header = || Header::new(Kind::State, 1e-6, 0, [0.0; 3], [1e-3; 3]);
    let mut position = vec![0.5_f32; 3 * 40_000];
    position[3 * 30_001 + 1] = f32::NAN;
    position[3 * 35_000] = f32::INFINITY;
    let mut bytes = Vec::new();
    let draft = Draft::new(header()).column("position", 3, &position);
    draft.write_to(&mut bytes).unwrap();
    let error = ParticleFile::from_bytes(&bytes)
        .unwrap()
        .check()
        .unwrap_err();
    let said = error.to_string();
    assert!(said.contains("row 30001 of column 'position'"), "{said}");
}

#[test]
fn what_is_no_particle_file_is_not_written() {
    let header = || Header::new(Kind::State, 1e-6, 1, [0.0; 3], [1e-3; 3]);
    let refused = |draft: Draft| {
        let mut out = Vec::new();
        let error = draft.write_to(&mut out).unwrap_err();
        assert!(out.is_empty());
        error.to_string()
    };
    let grid = BitGrid::new([4, 4, 4]);
    let block = |voxel| Block::new("wood", Material::Rigid, [0.0; 3], voxel, &grid);
    let three = [1.0_f32; 3];
    for (draft, reason) in [
        (
            Draft::new(Header {
                voxel_m: 0.0,
                ..header()
            }),
            "voxel edge",
        ),
        (
            Draft::new(Header {
                normal: 3,
                ..header()
            }),
            "normal",
        ),
        (
            Draft::new(Header {
                time_s: f64::NAN,
                ..header()
            }),
            "time",
        ),
        (
            Draft::new(Header {
                box_min_m: [2.0; 3],
                ..header()
            }),
            "corners",
        ),
        // What follows was written and read before, and panicked or hung whoever used it.
        (
            Draft::new(Header {
                voxel_m: 1e-15,
                ..header()
            }),
            "not from 5e-13 to 2e9 m",
        ),
        (
            Draft::new(Header {
                box_max_m: [1e-3, 1e-3, 1e3],
                ..header()
            }),
            "1000 x 1000 x 1000000000 voxels, more than 200000",
        ),
        (
            Draft::new(Header {
                box_min_m: [1e5; 3],
                box_max_m: [1e5; 3],
                ..header()
            }),
            "further than 1e9 voxels from zero",
        ),
        (
            Draft::new(header()).block(block(2e-6), &grid),
            "voxel edge is not the file's",
        ),
        (
            Draft::new(header()).block(
                Block {
                    origin_m: [0.0, 0.0, f64::NAN],
                    ..block(1e-6)
                },
                &grid,
            ),
            "low corner is not finite",
        ),
        (
            Draft::new(header()).column(&"x".repeat(256), 1, &three),
            "more than 255 bytes",
        ),
        (
            Draft::new(header()).block(block(-1.0), &grid),
            "block 'wood'",
        ),
        (
            Draft::new(header())
                .block(block(1e-6), &grid)
                .block(block(1e-6), &grid),
            "twice",
        ),
        (
            Draft::new(header()).column("position", 2, &three),
            "whole row",
        ),
        (
            Draft::new(header())
                .column("volume", 1, &three)
                .column("u", 1, &three[..2]),
            "2 rows",
        ),
        (
            Draft::new(header())
                .column("volume", 1, &three[..1])
                .pieces("u", 2, |take| take(&three)),
            "whole row",
        ),
    ] {
        let said = refused(draft);
        assert!(said.contains(reason), "'{said}' should say '{reason}'");
    }
}

#[test]
fn a_column_in_pieces_is_the_column() {
    let (volume, velocity) = ([1.0_f32; 4], [[0.5_f32, -1.0, 2.0]; 4]);
    let flat = velocity.as_flattened();
    let written = |draft: Draft| {
        let mut bytes = Vec::new();
        draft.write_to(&mut bytes).unwrap();
        bytes
    };
    let header = Header::new(Kind::State, 1e-6, 1, [0.0; 3], [1e-6; 3]);
    let begun = || Draft::new(header.clone()).column("volume", 1, &volume);
    let whole = written(begun().column("velocity", 3, flat));
    // Pieces need not end with rows, and may be empty.
    let pieces = written(begun().pieces("velocity", 3, |take| {
        for part in [0..5, 5..5, 5..12] {
            take(&flat[part]);
        }
    }));
    assert!(pieces == whole);
    // One that is not as long as the others is refused, as a column is.
    let none = begun().pieces::<f32>("velocity", 3, |_| {});
    assert!(none.write_to(&mut Vec::new()).is_err());
}

#[test]
fn realistic_wood_takes_less_than_two_bytes_per_voxel() {
    // Walls of 3 voxels every 18, as hybrid poplar fibres at 1.45 um: 31 % wood.
    let wood = BitGrid::from_fn([393, 96, 40], |x, y, _| x % 18 < 3 || y % 18 < 3);
    let header = Header::new(
        Kind::Specimen,
        1.45e-6,
        1,
        [0.0; 3],
        [5.7e-4, 1.4e-4, 5.8e-5],
    );
    let block = Block::new("wood", Material::Rigid, [0.0; 3], 1.45e-6, &wood);
    let mut bytes = Vec::new();
    Draft::new(header)
        .block(block, &wood)
        .write_to(&mut bytes)
        .unwrap();
    let per_voxel = bytes.len() as f64 / wood.count() as f64;
    println!("{per_voxel:.3} bytes per wood voxel");
    assert!(
        (0.4..0.55).contains(&per_voxel),
        "{per_voxel} bytes per wood voxel"
    );
}

/// Readers take no header above 16 MiB, so none is written: the file would be lost.
#[test]
fn a_header_that_no_reader_takes_is_not_written() {
    let written = |bytes: usize| {
        let mut header = example::header();
        header.set_attribute("notes", "x".repeat(bytes));
        let mut file = Vec::new();
        Draft::new(header).write_to(&mut file).map(|()| file)
    };
    let large = written((1 << 24) - 4096).unwrap();
    ParticleFile::from_bytes(&large).unwrap().check().unwrap();
    let said = written(1 << 24).unwrap_err().to_string();
    assert!(said.contains("its header has"), "{said}");
}
