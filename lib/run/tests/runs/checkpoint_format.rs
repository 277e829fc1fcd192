//! The layout of checkpoints against the version of their format.

use particle_file::ParticleFile;

use crate::bench::{Bench, RESUME};

/// Format and layout of the checkpoint of a run stopped after four steps: attributes, and arrays with type and, if their
/// length does not depend on the liquid, number of rows.
fn layout(bench: &Bench, changes: &[&str]) -> (String, String) {
    let stopped = bench.run("run", RESUME, 4, changes);
    assert_eq!(stopped.unwrap().unwrap().end, run::End::Interrupted);
    let file = ParticleFile::open(bench.path("run/checkpoint.mpts")).unwrap();
    let attributes = file.header().attributes.iter();
    let mut names: Vec<String> = attributes.map(|(name, _)| name.clone()).collect();
    for column in file.columns() {
        let rows = match column.rows {
            rows if rows < 20 => format!(" {rows}"),
            _ => String::new(),
        };
        names.push(format!("{} {:?}{rows}", column.name, column.element));
    }
    let format = file.header().attribute("checkpoint_format").unwrap();
    (format.to_owned(), names.join(", "))
}

/// Liquid with air, cure and loss of water, so that the checkpoint has all arrays of the implicit scheme.
const IMPLICIT: &str = r#"scheme = "implicit"
cfl = 0.05
[air]
pressure = "100 kPa"
[adhesive.cure]
gel_time = "1 ms"
exponent = 2
[adhesive.water]
solids = 0.45
uptake = "0.2 m/s"
diffusivity = "1e-5 m2/s"
viscosity_by_solids = [[0.45, 1.0], [0.6, 30.0]]"#;

const RUN: &str = "identity, checkpoint_format, snapshots, row_missing, history_bytes, history_hash, lost, iterations, \
run.clock F64 4, run.last_step F64 5, run.courant F64 2";

/// If this fails, the arrays of a checkpoint have changed: raise the number of the scheme, or `RUN_FORMAT`, in
/// `run/src/checkpoint`, and write the new layout here. Else a build could misread the checkpoint of another.
#[test]
fn a_format_has_one_layout() {
    let settings = [
        "integrator.velocity_update=apic",
        "integrator.density_projection=0.04 cell",
    ];
    let (format, names) = layout(&Bench::explicit(), &settings);
    assert_eq!(format, "explicit 1, run 1");
    let arrays = "id U32, node U32, place F32, motion F32, stress F32, clock F64 6, counts U32 8, displacement F64 6, \
affine F32, projection F64 3";
    assert_eq!(names, format!("{RUN}, {arrays}"));

    let (format, names) = layout(&Bench::new(IMPLICIT, "1.45 us", "0.1 us"), &[]);
    assert_eq!(format, "implicit 3, run 1");
    let arrays = "scalars F64, rows U32 3, region U32 6, volumes F64, velocities F64, pressures F64, displacement F64 6, \
air F64, air_counts F64 3, water F64, water_in_walls F64, water_account F64 5";
    assert_eq!(names, format!("{RUN}, {arrays}"));
}
