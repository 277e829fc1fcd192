//! Values of the header: what follows from them, and which no file may have.

use particle_file::{BitGrid, Block, Draft, Header, Kind, Material, ParticleFile, Provenance};

fn header() -> Header {
    Header::new(Kind::State, 1e-6, 1, [0.0; 3], [3e-6; 3])
}

fn written(draft: &Draft) -> Result<Vec<u8>, String> {
    let mut bytes = Vec::new();
    draft.write_to(&mut bytes).map_err(|e| e.to_string())?;
    Ok(bytes)
}

#[test]
fn a_block_knows_its_corner_and_its_volume() {
    let bits = BitGrid::from_fn([4, 3, 2], |x, y, _| x == y);
    let block = Block::new("wood", Material::Rigid, [1.0, -2.0, 0.5], 0.5, &bits);
    assert_eq!(block.dims, [4, 3, 2]);
    assert_eq!(block.max_m(), [3.0, -0.5, 1.5]);
    assert_eq!((block.count, block.volume_m3()), (6, 0.75));
}

#[test]
fn a_process_records_its_command() {
    let record = Provenance::of_process("tool", "1.2", vec![("a.tif".into(), 7)]);
    assert_eq!(
        (record.tool.as_str(), record.version.as_str()),
        ("tool", "1.2")
    );
    assert_eq!(record.inputs, [("a.tif".to_owned(), 7)]);
    assert_eq!(record.command.len(), std::env::args().count());
    assert_eq!(record.command[0], std::env::args().next().unwrap());
}

#[test]
fn an_attribute_is_set_once() {
    let mut header = header();
    header.set_attribute("gap_m", 1.5);
    header.set_attribute("crop", "all");
    header.set_attribute("gap_m", 2.5);
    assert_eq!(header.attribute("gap_m"), Some("2.5"));
    assert_eq!(
        (header.attribute("crop"), header.attributes.len()),
        (Some("all"), 2)
    );
    assert_eq!(header.attribute("other"), None);
}

#[test]
fn numbers_that_are_none_are_in_no_header() {
    let refused = |change: fn(&mut Header), sentence: &str| {
        let mut header = header();
        change(&mut header);
        let said = written(&Draft::new(header)).unwrap_err();
        assert!(said.contains(sentence), "{said}");
    };
    for change in [
        (|h| h.time_s = f64::INFINITY) as fn(&mut Header),
        |h| h.time_s = f64::NAN,
        |h| h.time_s = -1e-9,
    ] {
        refused(change, "time");
    }
    for change in [
        (|h| h.voxel_m = f64::INFINITY) as fn(&mut Header),
        |h| h.voxel_m = f64::NAN,
        |h| h.voxel_m = -1e-6,
    ] {
        refused(change, "voxel edge");
    }
    for change in [
        (|h| (h.box_min_m[2], h.box_max_m[2]) = (-1.5e308, 1.5e308)) as fn(&mut Header),
        |h| h.box_max_m[0] = f64::INFINITY,
        |h| h.box_min_m[1] = f64::NAN,
        |h| h.box_max_m[1] = -1e-6,
    ] {
        refused(change, "corners");
    }
    let mut flat = header();
    flat.box_max_m = flat.box_min_m;
    assert!(
        written(&Draft::new(flat)).is_ok(),
        "a checkpoint has no box"
    );
}

#[test]
fn blocks_have_an_extent_and_a_place() {
    let refused = |dims, origin, voxel, sentence: &str| {
        let bits = BitGrid::new(dims);
        let block = Block::new("wood", Material::Rigid, origin, voxel, &bits);
        let said = written(&Draft::new(header()).block(block, &bits)).unwrap_err();
        assert!(said.contains(sentence), "{said}");
    };
    refused([2, 0, 2], [0.0; 3], 1e-6, "number of voxels is zero");
    refused([2, 2, 2], [0.0; 3], f64::NAN, "voxel edge");
    refused([2, 2, 2], [0.0, f64::NAN, 0.0], 1e-6, "low corner");
}

/// Only what describes a state must be finite: a scheme may keep what it likes.
#[test]
fn a_checkpoint_may_hold_any_number() {
    for (kind, sound) in [(Kind::Checkpoint, true), (Kind::State, false)] {
        for single in [false, true] {
            let (f32s, f64s) = ([1.0, f32::NAN], [f64::INFINITY, 1.0]);
            let draft = Draft::new(Header { kind, ..header() });
            let draft = if single {
                draft.column("a", 1, &f32s)
            } else {
                draft.column("a", 1, &f64s)
            };
            let file = ParticleFile::from_bytes(&written(&draft).unwrap()).unwrap();
            assert_eq!(file.check().is_ok(), sound, "{kind}, single {single}");
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
fn a_file_is_worth_so_much_and_no_more() {
    let bytes = written(&Draft::new(header())).unwrap();
    let file = ParticleFile::from_bytes(&bytes).unwrap();
    let most = 33_554_432 + 64 * bytes.len() as u64;
    file.is_worth(0, "a map").unwrap();
    file.is_worth(most, "a map").unwrap();
    let said = file.is_worth(most + 1, "a map").unwrap_err().to_string();
    let claim = "claims a box of 3 x 3 x 3 voxels: a map would take";
    assert!(said.contains(claim), "{said}");
}

#[test]
fn a_block_is_written_with_the_extent_and_count_of_its_bits() {
    let bits = BitGrid::from_fn([3, 2, 2], |x, _, _| x == 1);
    let mut block = Block::new("wood", Material::Rigid, [0.0; 3], 1e-6, &bits);
    (block.dims, block.count) = ([9; 3], 9);
    let bytes = written(&Draft::new(header()).block(block, &bits)).unwrap();
    let file = ParticleFile::from_bytes(&bytes).unwrap();
    let (block, found) = file.block_named("wood").unwrap();
    assert_eq!((block.dims, block.count), ([3, 2, 2], 4));
    assert_eq!(found, bits.view());
}
