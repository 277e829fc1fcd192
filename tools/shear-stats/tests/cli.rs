//! The command line of shear-stats.

#[path = "../../workbench.rs"]
mod workbench;

use particle_file::{Draft, Header, Kind};
use workbench::{Bench, number, rows};

const HEADER: &str = "time_s,q05,q10,q25,q50,q75,q90,q95,max,mean,volume_um3";

/// A folder with `0000.mpts` and `0001.mpts`, two microseconds and a factor of ten later.
fn bench() -> Bench {
    let bench = Bench::new(env!("CARGO_BIN_EXE_shear-stats"));
    for (name, time_s, scale) in [("0000.mpts", 0.0, 1.0), ("0001.mpts", 2e-6, 10.0)] {
        let mut header = Header::new(Kind::State, 1e-6, 1, [0.0; 3], [1e-5; 3]);
        header.time_s = time_s;
        header.set_attribute("shear_rate_convention", "paper");
        let rates: Vec<f32> = (1..=100_u8).map(|i| scale * f32::from(i)).collect();
        let volumes = [2e-18_f32; 100];
        let draft = Draft::new(header).column("volume", 1, &volumes);
        bench.write_particles(name, &draft.column("shear_rate", 1, &rates));
    }
    bench
}

#[test]
fn a_row_for_each_snapshot() {
    let table = bench().run("0000.mpts 0001.mpts").output();
    assert_eq!(table.lines().next(), Some(HEADER));
    let rows = rows(&table);
    assert_eq!(rows.len(), 2);
    let expected = [5.0, 10.0, 25.0, 50.0, 75.0, 90.0, 95.0, 100.0, 50.5];
    for (row, (time, scale)) in rows.iter().zip([(0.0, 1.0), (2e-6, 10.0)]) {
        assert_eq!(number(&row[0]), time);
        for (found, expected) in row[1..10].iter().zip(expected) {
            let off = number(found) / (scale * expected) - 1.0;
            assert!(off.abs() < 1e-6, "{row:?}");
        }
        assert!((number(&row[10]) - 200.0).abs() < 1e-3);
    }
}

#[test]
fn rates_are_converted_and_the_file_has_a_record() {
    let bench = bench();
    bench
        .run("0000.mpts --convention rheometer -o shear.csv")
        .done();
    let max = number(&rows(&bench.text("shear.csv"))[0][8]);
    assert!((max - 100.0 / 2_f64.sqrt()).abs() < 1e-4, "{max}");
    let record = bench.text("shear.csv.provenance.json");
    assert!(record.contains("0000.mpts"), "{record}");
}

/// States of two runs may lie at the same times, and the last snapshot is the final state.
#[test]
fn states_are_of_one_run_and_count_once() {
    let bench = bench();
    let told = bench.run("0001.mpts 0000.mpts 0001.mpts").output();
    assert_eq!(told, bench.run("0000.mpts 0001.mpts").output());
    let mut header = Header::new(Kind::State, 1e-6, 1, [0.0; 3], [1e-5; 3]);
    header.set_attribute(particle_file::IDENTITY, "another");
    let draft = Draft::new(header).column("volume", 1, &[2e-18_f32]);
    bench.write_particles("other.mpts", &draft.column("shear_rate", 1, &[1.0_f32]));
    bench
        .run("0001.mpts other.mpts")
        .refused(2, "'other.mpts' is of another run than '0001.mpts'");
}

#[test]
fn a_tube_alone_and_beside_a_table() {
    let bench = bench();
    let alone = bench.run("--tube 1m/s,50um").output();
    assert!(alone.contains("1.6000e5 1/s (rheometer), 2.2627e5 1/s (paper)"));
    let beside = bench.run("0000.mpts --tube 1m/s,50um").done();
    assert!(beside.said.contains("1.6000e5"));
    assert!(beside.output().starts_with(HEADER));
}
