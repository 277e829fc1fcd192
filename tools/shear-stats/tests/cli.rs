//! The command line of shear-stats.

use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use particle_file::{Draft, Header, Kind};
use tempfile::TempDir;

const HEADER: &str = "time_s,q05,q10,q25,q50,q75,q90,q95,max,mean,volume_um3";

fn snapshot(folder: &Path, name: &str, time_s: f64, scale: f32) -> PathBuf {
    let mut header = Header::new(Kind::State, 1e-6, 1, [0.0; 3], [1e-5; 3]);
    header.time_s = time_s;
    header.set_attribute("shear_rate_convention", "paper");
    let rates: Vec<f32> = (1..=100_u8).map(|i| scale * f32::from(i)).collect();
    let volumes = vec![2e-18_f32; 100];
    let path = folder.join(name);
    Draft::new(header)
        .column("volume", 1, &volumes)
        .column("shear_rate", 1, &rates)
        .write_to(&mut File::create(&path).unwrap())
        .unwrap();
    path
}

fn tool(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_shear-stats"))
        .args(arguments)
        .output()
        .unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

#[test]
fn a_row_for_each_snapshot() {
    let folder = TempDir::new().unwrap();
    let a = snapshot(folder.path(), "0000.mpts", 0.0, 1.0);
    let b = snapshot(folder.path(), "0001.mpts", 2e-6, 10.0);
    let run = tool(&[a.to_str().unwrap(), b.to_str().unwrap()]);
    assert!(run.status.success(), "{}", text(&run.stderr));
    let table = text(&run.stdout);
    let rows: Vec<Vec<f64>> = (table.lines().skip(1))
        .map(|line| line.split(',').map(|v| v.parse().unwrap()).collect())
        .collect();
    assert_eq!(table.lines().next(), Some(HEADER));
    let expected = [5.0, 10.0, 25.0, 50.0, 75.0, 90.0, 95.0, 100.0, 50.5];
    for (row, (time, scale)) in rows.iter().zip([(0.0, 1.0), (2e-6, 10.0)]) {
        assert_eq!(row[0], time);
        for (found, expected) in row[1..10].iter().zip(expected) {
            assert!((found / (scale * expected) - 1.0).abs() < 1e-6, "{row:?}");
        }
        assert!((row[10] - 200.0).abs() < 1e-3);
    }
    assert_eq!(rows.len(), 2);
}

#[test]
fn rates_are_converted_and_the_file_has_a_record() {
    let folder = TempDir::new().unwrap();
    let a = snapshot(folder.path(), "0000.mpts", 0.0, 1.0);
    let csv = folder.path().join("shear.csv");
    let options = ["--convention", "rheometer", "-o", csv.to_str().unwrap()];
    let run = tool(&[&[a.to_str().unwrap()], &options[..]].concat());
    assert!(run.status.success(), "{}", text(&run.stderr));
    let table = fs::read_to_string(&csv).unwrap();
    let max = table.lines().nth(1).unwrap().split(',').nth(8).unwrap();
    let max: f64 = max.parse().unwrap();
    assert!((max - 100.0 / 2_f64.sqrt()).abs() < 1e-4, "{max}");
    let record = fs::read_to_string(folder.path().join("shear.csv.provenance.json")).unwrap();
    assert!(record.contains("0000.mpts"), "{record}");
}

#[test]
fn a_tube_alone_and_beside_a_table() {
    let alone = tool(&["--tube", "1 m/s,50 um"]);
    assert!(alone.status.success());
    assert!(text(&alone.stdout).contains("1.6000e5 1/s (rheometer), 2.2627e5 1/s (paper)"));
    let folder = TempDir::new().unwrap();
    let a = snapshot(folder.path(), "0000.mpts", 0.0, 1.0);
    let beside = tool(&[a.to_str().unwrap(), "--tube", "1m/s,50um"]);
    assert!(text(&beside.stdout).starts_with(HEADER));
    assert!(text(&beside.stderr).contains("1.6000e5"));
}
