//! The command line of wp-metrics.

mod several;
mod stacks;
mod wood;

use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use particle_file::{BitGrid, Block, Draft, Header, Kind, Material};
use tempfile::TempDir;

const VOXEL: f64 = 1.45e-6;
const DIMS: [usize; 3] = [40, 60, 16];
const HEADER: &str = "file,side,reference,plane_m,wp_um,slab_wp_um,ep_um,max_depth_um,p99_depth_um,volume_um3,voxels";

fn letter(x: usize, y: usize) -> char {
    let groove = x.is_multiple_of(4);
    match y {
        24..30 => 'a',
        10..24 if groove => 'a',
        _ if groove => ' ',
        _ => 'w',
    }
}

fn specimen(folder: &Path) -> PathBuf {
    specimen_of(folder, "specimen.mpts", DIMS)
}

/// The low corner of it, under a name.
fn specimen_of(folder: &Path, name: &str, dims: [usize; 3]) -> PathBuf {
    let grid = |wanted| BitGrid::from_fn(dims, |x, y, _| letter(x, y) == wanted);
    let (wood, adhesive) = (grid('w'), grid('a'));
    let max = dims.map(|n| n as f64 * VOXEL);
    let path = folder.join(name);
    let block = |name, material, bits| Block::new(name, material, [0.0; 3], VOXEL, bits);
    Draft::new(Header::new(Kind::Specimen, VOXEL, 1, [0.0; 3], max))
        .block(block("wood", Material::Rigid, &wood), &wood)
        .block(block("adhesive", Material::Adhesive, &adhesive), &adhesive)
        .write_to(&mut File::create(&path).unwrap())
        .unwrap();
    path
}

/// A state of a run on the specimen: its adherends parted by `gap` voxels, and its adhesive as
/// material points that moved with them; `spoil` may break it.
fn state(folder: &Path, gap: usize, spoil: impl Fn(&mut Vec<[f32; 3]>)) -> PathBuf {
    state_at(folder, gap, 0.0, spoil)
}

/// The same at a time, s.
fn state_at(folder: &Path, gap: usize, time_s: f64, spoil: impl Fn(&mut Vec<[f32; 3]>)) -> PathBuf {
    let [nx, ny, nz] = DIMS;
    let bottom = BitGrid::from_fn([nx, 27, nz], |x, y, _| letter(x, y) == 'w');
    let top = BitGrid::from_fn([nx, ny - 27, nz], |x, y, _| letter(x, y + 27) == 'w');
    let mut position = Vec::new();
    for y in 0..ny {
        for z in 0..nz {
            for x in (0..nx).filter(|&x| letter(x, y) == 'a') {
                let y = if y < 27 { y } else { y + gap };
                position.push([x, y, z].map(|i| ((i as f64 + 0.5) * VOXEL) as f32));
            }
        }
    }
    let volume = vec![VOXEL.powi(3) as f32; position.len()];
    spoil(&mut position);
    let max = [nx, ny + gap, nz].map(|n| n as f64 * VOXEL);
    let block = |name, layer: usize, bits| {
        let origin = [0.0, layer as f64 * VOXEL, 0.0];
        Block::new(name, Material::Rigid, origin, VOXEL, bits)
    };
    let path = folder.join("state.mpts");
    let mut header = Header::new(Kind::State, VOXEL, 1, [0.0; 3], max);
    header.time_s = time_s;
    header.set_attribute("gap_m", gap as f64 * VOXEL);
    Draft::new(header)
        .block(block("wood-bottom", 0, &bottom), &bottom)
        .block(block("wood-top", 27 + gap, &top), &top)
        .column("position", 3, position.as_flattened())
        .column("volume", 1, &volume)
        .write_to(&mut File::create(&path).unwrap())
        .unwrap();
    path
}

fn tool(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_wp-metrics"))
        .args(arguments)
        .output()
        .unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// The rows of a table, fields apart.
fn rows(csv: &str) -> Vec<Vec<String>> {
    let split = |line: &str| line.split(',').map(str::to_owned).collect();
    csv.lines().skip(1).map(split).collect()
}

fn number(field: &str) -> f64 {
    field.parse().unwrap()
}

#[test]
fn a_specimen_from_a_file_a_pipe_and_standard_input() {
    let folder = TempDir::new().unwrap();
    let path = specimen(folder.path());
    let run = tool(&[path.to_str().unwrap()]);
    assert!(run.status.success(), "{}", text(&run.stderr));
    let table = text(&run.stdout);
    assert_eq!(table.lines().next(), Some(HEADER));
    let found = rows(&table);
    let sides: Vec<&str> = found.iter().map(|r| r[1].as_str()).collect();
    assert_eq!(sides, ["bottom", "top", "total"]);
    // Full layers at +-1/2 to +-5/2 voxels and a quarter of those to -33/2.
    let squares = |layers: std::ops::Range<u32>| -> f64 {
        layers.map(|i| (f64::from(i) + 0.5).powi(2)).sum()
    };
    let wp = |squares: f64, layers: f64| format!("{:.4}", 1.45 * (squares / layers).sqrt());
    let bottom = squares(0..3) + 0.25 * squares(3..17);
    let expected = [
        wp(bottom, 6.5),
        wp(squares(0..3), 3.0),
        wp(bottom + squares(0..3), 9.5),
    ];
    for (row, expected) in found.iter().zip(&expected) {
        assert_eq!(row[2], "mid");
        assert!((number(&row[3]) - 27.0 * VOXEL).abs() < 1e-12);
        assert!(
            (number(&row[4]) - number(expected)).abs() < 1e-4,
            "{row:?} {expected}"
        );
    }
    assert_eq!(found[2][10], (9.5 * 640.0).to_string());

    let mapped = Command::new(env!("CARGO_BIN_EXE_wp-metrics"))
        .arg("-")
        .stdin(Stdio::from(File::open(&path).unwrap()))
        .output()
        .unwrap();
    let mut cat = Command::new("cat")
        .arg(&path)
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let piped = Command::new(env!("CARGO_BIN_EXE_wp-metrics"))
        .arg("-")
        .stdin(cat.stdout.take().unwrap())
        .output()
        .unwrap();
    cat.wait().unwrap();
    for other in [mapped, piped] {
        assert_eq!(rows(&text(&other.stdout))[2][1..], found[2][1..]);
    }
}

#[test]
fn map_profile_and_comparison() {
    let folder = TempDir::new().unwrap();
    let path = specimen(folder.path());
    let path = path.to_str().unwrap();
    let [map, profile, table] =
        ["map.csv", "depth.csv", "wp.csv"].map(|n| folder.path().join(n).display().to_string());
    let options = [
        "--map",
        &map,
        "--profile",
        &profile,
        "-o",
        &table,
        "--compare",
        path,
    ];
    let run = tool(&[&[path], &options[..]].concat());
    assert!(run.status.success(), "{}", text(&run.stderr));

    let csv = fs::read_to_string(&table).unwrap();
    assert_eq!(
        csv.lines().next(),
        Some(format!("{HEADER},dice,map_correlation").as_str())
    );
    assert!(rows(&csv).iter().all(|row| number(&row[11]) == 1.0));
    let csv = fs::read_to_string(&map).unwrap();
    assert_eq!(csv.lines().next(), Some("x_um,z_um,wp_um,volume_um3"));
    let columns = rows(&csv);
    assert_eq!(columns.len(), 40 * 16);
    assert_eq!(
        columns[41][..2],
        ["2.175000".to_owned(), "2.175000".to_owned()]
    );
    assert!((number(&columns[1][3]) - 6.0 * 1.45_f64.powi(3)).abs() < 1e-3);
    let csv = fs::read_to_string(&profile).unwrap();
    assert_eq!(
        csv.lines().next(),
        Some("depth_um,adhesive_fraction,filled_void_fraction,filled_open_fraction")
    );
    let layers = rows(&csv);
    assert_eq!(layers.len(), 60);
    assert_eq!(
        layers[20],
        ["-9.425000", "0.250000", "1.000000", "1.000000"]
    );
    for file in [&map, &profile, &table] {
        let record = fs::read_to_string(format!("{file}.provenance.json")).unwrap();
        assert!(record.contains("specimen.mpts"));
    }
}

#[test]
fn a_closed_state_is_the_experiment_and_a_parted_one_has_its_own_middle() {
    let folder = TempDir::new().unwrap();
    let experiment = specimen(folder.path());
    let experiment = experiment.to_str().unwrap();
    let exact = rows(&text(&tool(&[experiment]).stdout));
    for gap in [0, 4] {
        let state = state(folder.path(), gap, |_| ());
        let run = tool(&[state.to_str().unwrap(), "--compare", experiment]);
        assert!(run.status.success(), "{}", text(&run.stderr));
        let found = rows(&text(&run.stdout));
        for (row, exact) in found.iter().zip(&exact) {
            let middle = (27.0 + 0.5 * gap as f64) * VOXEL;
            assert!((number(&row[3]) - middle).abs() < 1e-12);
            let closed = (number(&row[4]) - number(&exact[4])).abs() < 1e-4;
            assert_eq!(closed, gap == 0, "{row:?} {exact:?}");
            assert_eq!(row[10], exact[10]);
            assert!(
                number(&row[11]) > 0.999,
                "each side in its own frame: {row:?}"
            );
            // Nothing entered the top adherend: its map is constant.
            match row[1].as_str() {
                "top" => assert_eq!(row[12], "NaN"),
                _ => assert!(number(&row[12]) > 0.99, "{row:?}"),
            }
        }
    }
    let nowhere = state(folder.path(), 0, |position| position[7][2] = f32::NAN);
    let run = tool(&[nowhere.to_str().unwrap()]);
    assert_eq!(run.status.code(), Some(3));
    assert!(
        text(&run.stderr).contains("material point 7"),
        "{}",
        text(&run.stderr)
    );
}

#[test]
fn a_series_is_told_in_order_of_time_from_a_runs_folder() {
    let folder = TempDir::new().unwrap();
    let run = folder.path().join("run");
    fs::create_dir_all(run.join("snapshots")).unwrap();
    for (name, gap, time) in [
        ("snapshots/0000.mpts", 6, 1e-3),
        ("snapshots/0001.mpts", 0, 60.0),
        ("final.mpts", 0, 60.0),
    ] {
        let made = state_at(folder.path(), gap, time, |_| {});
        fs::rename(made, run.join(name)).unwrap();
    }
    let profile = folder.path().join("depth.csv");
    let arguments = [
        "--series",
        run.to_str().unwrap(),
        "--profile",
        profile.to_str().unwrap(),
    ];
    let output = tool(&arguments);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let table = text(&output.stdout);
    let header = table.lines().next().unwrap();
    let added = ",time_s,gap_um,p95_depth_um,wetted_area_um2,bond_line_filled,bond_line,surfaces_um,half_filled_depth_um";
    assert_eq!(header, format!("{HEADER}{added}"));
    // The last snapshot is the final state, told once.
    let found = rows(&table);
    let times: Vec<&str> = found.iter().map(|row| row[11].as_str()).collect();
    assert_eq!(
        times,
        [["1.000000000e-3"; 3], ["6.000000000e1"; 3]].concat()
    );
    assert!(
        number(&found[5][14]) > 0.0 && found[5][16] == "filled",
        "{found:?}"
    );
    // The gap is the way left until the bond is closed; the specimen's surfaces then stand 6 voxels apart.
    for (row, gap) in [(0, 6.0), (3, 0.0)] {
        let um = 1e6 * VOXEL;
        assert!(
            (number(&found[row][12]) - gap * um).abs() < 1e-5,
            "{found:?}"
        );
        assert!(
            (number(&found[row][17]) - (gap + 6.0) * um).abs() < 1e-5,
            "{found:?}"
        );
    }
    let profile = fs::read_to_string(profile).unwrap();
    assert!(profile.starts_with("time_s,depth_um,"), "{profile}");

    let empty = TempDir::new().unwrap();
    let output = tool(&["--series", empty.path().to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(3));
    assert!(text(&output.stderr).contains("holds no state of a run"));
}
