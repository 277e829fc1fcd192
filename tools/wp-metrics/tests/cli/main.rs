//! The command line of wp-metrics.

mod several;
mod wood;
#[path = "../../../workbench.rs"]
mod workbench;

use std::fs;
use std::path::Path;

use particle_file::{BitGrid, Block, Draft, Header, Kind, Material};
use workbench::{Bench, number, rows};

const VOXEL: f64 = 1.45e-6;
const DIMS: [usize; 3] = [40, 60, 16];
const HEADER: &str = "file,side,reference,plane_m,wp_um,slab_wp_um,ep_um,max_depth_um,p99_depth_um,volume_um3,voxels";
/// The last columns of every table.
const ENTERED: &str = ",entered_share,mean_depth_um";

fn letter(x: usize, y: usize) -> char {
    let groove = x.is_multiple_of(4);
    match y {
        24..30 => 'a',
        10..24 if groove => 'a',
        _ if groove => ' ',
        _ => 'w',
    }
}

fn bench() -> Bench {
    let bench = Bench::new(env!("CARGO_BIN_EXE_wp-metrics"));
    specimen(&bench, "specimen.mpts", DIMS);
    bench
}

/// The low corner of the specimen, under a name.
fn specimen(bench: &Bench, name: &str, dims: [usize; 3]) {
    let grid = |wanted| BitGrid::from_fn(dims, |x, y, _| letter(x, y) == wanted);
    let max = dims.map(|n| n as f64 * VOXEL);
    let header = Header::new(Kind::Specimen, VOXEL, 1, [0.0; 3], max);
    bench.write_specimen(name, header, &grid('w'), &grid('a'));
}

/// A state of a run on the specimen at a time (s): its adherends parted by `gap` voxels, and its adhesive as
/// material points that moved with them.
fn state(bench: &Bench, name: &str, gap: usize, time_s: f64) {
    let [nx, ny, nz] = DIMS;
    let bottom = BitGrid::from_fn([nx, 27, nz], |x, y, _| letter(x, y) == 'w');
    let top = BitGrid::from_fn([nx, ny - 27, nz], |x, y, _| letter(x, y + 27) == 'w');
    let mut position = Vec::new();
    BitGrid::from_fn(DIMS, |x, y, _| letter(x, y) == 'a')
        .view()
        .for_each(|[x, y, z]| {
            let y = if y < 27 { y } else { y + gap };
            position.push([x, y, z].map(|i| ((i as f64 + 0.5) * VOXEL) as f32));
        });
    let volume = vec![VOXEL.powi(3) as f32; position.len()];
    let max = [nx, ny + gap, nz].map(|n| n as f64 * VOXEL);
    let block = |name, layer: usize, bits| {
        let origin = [0.0, layer as f64 * VOXEL, 0.0];
        Block::new(name, Material::Rigid, origin, VOXEL, bits)
    };
    let mut header = Header::new(Kind::State, VOXEL, 1, [0.0; 3], max);
    header.time_s = time_s;
    header.set_attribute("gap_m", gap as f64 * VOXEL);
    // Through open sides, of a state as late as that.
    header.set_attribute("left_through_open_sides", time_s / 1e3);
    let draft = Draft::new(header)
        .block(block("wood-bottom", 0, &bottom), &bottom)
        .block(block("wood-top", 27 + gap, &top), &top)
        .column("position", 3, position.as_flattened())
        .column("volume", 1, &volume);
    bench.write_particles(name, &draft);
}

#[test]
fn a_specimen_from_a_file_a_pipe_and_standard_input() {
    let bench = bench();
    let table = bench.run("specimen.mpts").output();
    assert_eq!(table.lines().next(), Some(&*format!("{HEADER}{ENTERED}")));
    let found = rows(&table);
    // Full layers at +-1/2 to +-5/2 voxels and a quarter of those to -33/2.
    let squares = |layers: std::ops::Range<u32>| -> f64 {
        layers.map(|i| (f64::from(i) + 0.5).powi(2)).sum()
    };
    let (bottom, top) = (squares(0..3) + 0.25 * squares(3..17), squares(0..3));
    let sides = [
        ("bottom", bottom, 6.5),
        ("top", top, 3.0),
        ("total", bottom + top, 9.5),
    ];
    for (row, (side, squares, layers)) in found.iter().zip(sides) {
        assert_eq!(row[1..3], [side, "mid"]);
        assert!((number(&row[3]) - 27.0 * VOXEL).abs() < 1e-12);
        let wp = 1.45 * f64::sqrt(squares / layers);
        assert!((number(&row[4]) - wp).abs() < 1e-4, "{row:?} {wp}");
    }
    assert_eq!(found[2][10], (9.5 * 640.0).to_string());
    for line in ["$TOOL - < specimen.mpts", "cat specimen.mpts | $TOOL -"] {
        assert_eq!(rows(&bench.shell(line).output())[2][1..], found[2][1..]);
    }
}

#[test]
fn map_profile_and_comparison() {
    let bench = bench();
    let line = "specimen.mpts --map map.csv --profile depth.csv -o wp.csv --compare specimen.mpts";
    bench.run(line).done();
    let table = |name: &str, header: &str| {
        let text = bench.text(name);
        assert_eq!(text.lines().next(), Some(header));
        let record = bench.text(&format!("{name}.provenance.json"));
        assert!(record.contains("specimen.mpts"));
        rows(&text)
    };
    let compared = table("wp.csv", &format!("{HEADER},dice,map_correlation{ENTERED}"));
    assert!(compared.len() == 3 && compared.iter().all(|row| number(&row[11]) == 1.0));
    let columns = table("map.csv", "x_um,z_um,wp_um,volume_um3");
    assert_eq!(columns.len(), 40 * 16);
    assert_eq!(columns[41][..2], ["2.175000", "2.175000"]);
    assert!((number(&columns[1][3]) - 6.0 * 1.45_f64.powi(3)).abs() < 1e-3);
    let header = "depth_um,adhesive_fraction,filled_void_fraction,filled_open_fraction";
    let layers = table("depth.csv", header);
    assert_eq!(layers.len(), 60);
    let filled = ["-9.425000", "0.250000", "1.000000", "1.000000"];
    assert_eq!(layers[20], filled);
}

#[test]
fn a_series_is_told_in_order_of_time_from_a_runs_folder() {
    let bench = bench();
    fs::create_dir_all(bench.path("run/snapshots")).unwrap();
    state(&bench, "run/snapshots/0000.mpts", 6, 1e-3);
    state(&bench, "run/snapshots/0001.mpts", 0, 60.0);
    state(&bench, "run/final.mpts", 0, 60.0);
    let table = bench.run("--series run --profile depth.csv").output();
    let added = ",time_s,gap_um,p95_depth_um,wetted_area_um2,bond_line_filled,bond_line,surfaces_um,half_filled_depth_um";
    assert_eq!(
        table.lines().next().unwrap(),
        format!("{HEADER}{added}{ENTERED}")
    );
    // The last snapshot is the final state, told once.
    let found = rows(&table);
    let times: Vec<&str> = found.iter().map(|row| row[11].as_str()).collect();
    let [early, late] = [["1.000000000e-3"; 3], ["6.000000000e1"; 3]];
    assert_eq!(times, [early, late].concat());
    assert!(number(&found[5][14]) > 0.0, "{found:?}");
    assert_eq!([&found[0][16], &found[5][16]], ["filled", "squeezed-out"]);
    // The gap is the way left until the bond is closed; the specimen's surfaces then stand 6 voxels apart.
    for (row, gap) in [(0, 6.0), (3, 0.0)] {
        for (column, voxels) in [(12, gap), (17, gap + 6.0)] {
            let off = number(&found[row][column]) - voxels * 1e6 * VOXEL;
            assert!(off.abs() < 1e-5, "{found:?}");
        }
    }
    assert!(bench.text("depth.csv").starts_with("time_s,depth_um,"));
    fs::create_dir(bench.path("empty")).unwrap();
    bench
        .run("--series empty")
        .refused(3, "is not a run folder of mpm-run");
    // It was said to hold no slices.
    bench.write(&format!("empty/{}", particle_file::RUN_MARK), "");
    bench
        .run("empty")
        .refused(3, "a run that has written no final.mpts yet");
    let compared = bench.run("run/final.mpts --compare run/snapshots/0000.mpts");
    compared.refused(2, "the file to compare with is not a specimen");
}

/// The same specimen, turned, with as many layers beside as it has.
#[test]
fn a_state_keeps_its_axis_and_is_compared_with_its_specimen_alone() {
    let bench = bench();
    state(&bench, "final.mpts", 0, 1e-3);
    bench.run("final.mpts --normal y").done();
    bench.run("final.mpts --normal x").refused(
        2,
        "is a state of a run across y, not across x: leave out --normal",
    );
    let same = rows(&bench.run("final.mpts --compare specimen.mpts").output());
    assert_eq!(number(&same[2][11]), 1.0);
    // A specimen lies across any axis, whatever its header says.
    let header = |axis| {
        Header::new(
            Kind::Specimen,
            VOXEL,
            axis,
            [0.0; 3],
            DIMS.map(|n| n as f64 * VOXEL),
        )
    };
    let grid = |letters: fn(usize, usize) -> char, wanted| {
        BitGrid::from_fn(DIMS, move |x, y, _| letters(x, y) == wanted)
    };
    bench.write_specimen("x.mpts", header(0), &grid(letter, 'w'), &grid(letter, 'a'));
    assert_eq!(
        rows(&bench.run("final.mpts --compare x.mpts").output()),
        same
    );
    let other = |x: usize, y: usize| letter(x + 2, y);
    bench.write_specimen(
        "other.mpts",
        header(1),
        &grid(other, 'w'),
        &grid(other, 'a'),
    );
    bench
        .run("final.mpts --compare other.mpts")
        .refused(2, "its wood is not that of the experiment");
    specimen(&bench, "wide.mpts", [40, 60, 20]);
    bench.run("specimen.mpts --compare wide.mpts").refused(
        2,
        "[40, 16] voxels of 1.4500 um but the experiment 60 layers along y of [40, 20]",
    );
}

#[test]
fn raw_volumes_and_proposed_grey_values() {
    let bench = bench();
    let grey = |letter| match letter {
        ' ' => 10_000_u16,
        'w' => 18_000,
        _ => 26_000,
    };
    let [nx, ny, nz] = DIMS;
    let voxels = (0..nx * ny * nz).map(|i| grey(letter(i % nx, i / nx % ny)));
    bench.write(
        "a.raw",
        voxels.flat_map(u16::to_le_bytes).collect::<Vec<u8>>(),
    );
    let expected = rows(&bench.run("specimen.mpts").output());
    let raw = "a.raw --dims 40x60x16 --type u16 --voxel 1.45um";
    for values in [
        "--grey auto",
        "--grey wood=18000..18000,adhesive=26000..",
        "--labels void=10000,wood=18000,adhesive=26000",
    ] {
        let run = bench.run(&format!("{raw} {values}")).done();
        let told = run.said.contains("grey values: wood=");
        assert_eq!(told, values == "--grey auto", "{}", run.said);
        let found = rows(&run.output());
        let [found, expected] = [&found, &expected].map(|rows| rows.iter().map(|row| &row[1..]));
        assert!(found.eq(expected), "{values}");
    }
    // A particle file beside them is told by itself.
    let both = bench
        .run(&format!("specimen.mpts {raw} --grey auto"))
        .output();
    assert_eq!(rows(&both).len(), 6);
    bench.run("a.raw --dims 40x60x15 --type u16").refused(2, "");
}

/// `bondline-acer-240.json` beside the stack, computed by its authors with NumPy. `make test` runs this
/// test where the shared data are present.
#[test]
#[ignore = "needs the shared volumes, which are not in the repository"]
fn shared_data_gives_the_reference_numbers() {
    let stack =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data/bondline-acer-240.tif");
    let run = bench().run(&format!("{} --voxel 1.45um", stack.display()));
    for (row, [wp, ep, deepest, voxels]) in rows(&run.output()).iter().zip([
        [17.5810, 20.6259, 215.325, 819_346.0],
        [16.7128, 20.0407, 225.475, 796_100.0],
        [17.1586, 40.6666, 225.475, 1_615_446.0],
    ]) {
        assert!((number(&row[3]) - 226.2e-6).abs() < 1e-12, "{row:?}");
        assert!((number(&row[4]) - wp).abs() < 5e-5, "{row:?}");
        assert!((number(&row[5]) - 40.666_609 / 12_f64.sqrt()).abs() < 1e-5);
        assert!((number(&row[6]) - ep).abs() < 5e-5, "{row:?}");
        assert!((number(&row[7]) - deepest).abs() < 1e-6, "{row:?}");
        assert_eq!(number(&row[10]), voxels);
    }
}
