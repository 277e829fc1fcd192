//! Values of the header: what follows from them, and which no file may have.

use particle_file::{BitGrid, Block, Draft, Header, Kind, Material, ParticleFile, Provenance};

fn header() -> Header {
    Header::new(Kind::State, 1e-6, 1, [0.0; 3], [3e-6; 3])
}

fn written(draft: &Draft) -> Result<Vec<u8>, String> {
    let mut bytes = Vec::new();
    let written = draft.write_to(&mut bytes).map_err(|e| e.to_string());
    assert!(written.is_ok() || bytes.is_empty());
    written.map(|()| bytes)
}

#[track_caller]
fn refused(draft: &Draft, reason: &str) {
    let said = written(draft).unwrap_err();
    assert!(said.contains(reason), "'{said}' should say '{reason}'");
}

#[test]
fn a_process_records_its_command() {
    let record = Provenance::of_process("tool", "1.2", vec![("a.tif".into(), 7)]);
    assert_eq!((&*record.tool, &*record.version), ("tool", "1.2"));
    assert_eq!(record.inputs, [("a.tif".to_owned(), 7)]);
    assert!(record.command.into_iter().eq(std::env::args()));
}

#[test]
fn an_attribute_is_set_once() {
    let mut header = header();
    header.set_attribute("gap_m", 1.5);
    header.set_attribute("crop", "all");
    header.set_attribute("gap_m", 2.5);
    let [gap, crop, other] = ["gap_m", "crop", "other"].map(|name| header.attribute(name));
    assert_eq!([gap, crop, other], [Some("2.5"), Some("all"), None]);
    assert_eq!(header.attributes.len(), 2);
}

/// The last ones were written and read before, and panicked or hung whoever used them.
#[test]
fn invalid_header_values_are_refused() {
    type Change = fn(&mut Header);
    let changes: [(Change, &str); 14] = [
        (|h| h.normal = 3, "normal"),
        (|h| h.time_s = f64::INFINITY, "time"),
        (|h| h.time_s = f64::NAN, "time"),
        (|h| h.time_s = -1e-9, "time"),
        (|h| h.voxel_m = 0.0, "voxel edge"),
        (|h| h.voxel_m = f64::INFINITY, "voxel edge"),
        (|h| h.voxel_m = f64::NAN, "voxel edge"),
        (
            |h| (h.box_min_m[2], h.box_max_m[2]) = (-1.5e308, 1.5e308),
            "corners",
        ),
        (|h| h.box_max_m[0] = f64::INFINITY, "corners"),
        (|h| h.box_min_m[1] = f64::NAN, "corners"),
        (|h| h.box_max_m[1] = -1e-6, "corners"),
        (|h| h.voxel_m = 1e-15, "not from 5e-13 to 2e9 m"),
        (
            |h| h.box_max_m[2] = 1e3,
            "3 x 3 x 1000000000 voxels, more than 200000",
        ),
        (
            |h| (h.box_min_m, h.box_max_m) = ([1e5; 3], [1e5; 3]),
            "further than 1e9 voxels from zero",
        ),
    ];
    for (change, reason) in changes {
        let mut header = header();
        change(&mut header);
        refused(&Draft::new(header), reason);
    }
    let mut flat = header();
    flat.box_max_m = flat.box_min_m;
    // A checkpoint has no box.
    assert!(written(&Draft::new(flat)).is_ok());
}

#[test]
fn blocks_have_an_extent_and_a_place_and_arrays_whole_rows_and_names() {
    let block = |dims, origin, voxel_m, reason: &str| {
        let bits = BitGrid::new(dims);
        let block = Block::new("wood", Material::Rigid, origin, voxel_m, &bits);
        refused(&Draft::new(header()).block(block, &bits), reason);
    };
    block(
        [2, 0, 2],
        [0.0; 3],
        1e-6,
        "number of voxels is zero in block 'wood'",
    );
    block([2; 3], [0.0; 3], f64::NAN, "voxel edge");
    block([2; 3], [0.0; 3], 2e-6, "voxel edge is not the file's");
    block(
        [2; 3],
        [0.0, f64::NAN, 0.0],
        1e-6,
        "low corner is not finite",
    );
    let (three, bits) = ([1.0_f32; 3], BitGrid::new([2; 3]));
    let wood = || Block::new("wood", Material::Rigid, [0.0; 3], 1e-6, &bits);
    let draft = || Draft::new(header());
    refused(&draft().block(wood(), &bits).block(wood(), &bits), "twice");
    refused(
        &draft().column(&"x".repeat(256), 1, &three),
        "more than 255 bytes",
    );
    refused(&draft().column("position", 2, &three), "whole row");
    let volumes = |count| draft().column("volume", 1, &three[..count]);
    refused(&volumes(3).column("u", 1, &three[..2]), "2 rows");
    refused(&volumes(1).pieces("u", 2, |take| take(&three)), "whole row");
}

/// Only what describes a state must be finite: a scheme may keep what it likes.
#[test]
fn a_checkpoint_may_hold_any_number() {
    let (f32s, f64s) = ([1.0, f32::NAN], [f64::INFINITY, 1.0]);
    for (kind, sound) in [(Kind::Checkpoint, true), (Kind::State, false)] {
        let draft = || Draft::new(Header { kind, ..header() });
        for draft in [draft().column("a", 1, &f32s), draft().column("a", 1, &f64s)] {
            let file = ParticleFile::from_bytes(&written(&draft).unwrap()).unwrap();
            assert_eq!(file.check().is_ok(), sound, "{kind}");
        }
    }
}

#[test]
fn the_span_is_that_of_the_box_and_of_all_blocks() {
    let mut header = Header::new(Kind::State, 1e-6, 1, [2e-6; 3], [7e-6, 5e-6, 3e-6]);
    assert_eq!(header.span(), [5, 3, 1]);
    let bits = BitGrid::new([4, 4, 4]);
    let block = |origin| Block::new("wood", Material::Rigid, origin, 1e-6, &bits);
    header.blocks = vec![block([-1e-6, 2e-6, 2e-6]), block([2e-6, 6e-6, 2e-6])];
    assert_eq!(header.bounds_m()[0], [-1e-6, 2e-6, 2e-6]);
    assert_eq!(header.span(), [8, 8, 4]);
}

/// 32 MiB, and 64 bytes for each byte of the file.
#[test]
fn memory_for_a_file_is_limited_by_its_length() {
    let bytes = written(&Draft::new(header())).unwrap();
    let file = ParticleFile::from_bytes(&bytes).unwrap();
    let most = 33_554_432 + 64 * bytes.len() as u64;
    file.is_worth(most, "a map").unwrap();
    let said = file.is_worth(most + 1, "a map").unwrap_err().to_string();
    let claim = "claims a box of 3 x 3 x 3 voxels: a map would take";
    assert!(said.contains(claim), "{said}");
}

#[test]
fn a_block_is_written_with_the_extent_and_count_of_its_bits() {
    let bits = BitGrid::from_fn([3, 2, 2], |x, _, _| x == 1);
    let mut block = Block::new("wood", Material::Rigid, [1.0, -2.0, 0.5], 0.5, &bits);
    assert_eq!(block.max_m(), [2.5, -1.0, 1.5]);
    assert_eq!(block.volume_m3(), 0.5);
    (block.dims, block.count) = ([9; 3], 9);
    let header = Header::new(Kind::State, 0.5, 1, [0.0; 3], [3.0; 3]);
    let bytes = written(&Draft::new(header).block(block, &bits)).unwrap();
    let file = ParticleFile::from_bytes(&bytes).unwrap();
    let (block, found) = file.block_named("wood").unwrap();
    assert_eq!((block.dims, block.count), ([3, 2, 2], 4));
    assert_eq!(found, bits.view());
}
