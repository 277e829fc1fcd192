//! Adhesive and wood are conserved from the stack to the end of a run.

use particle_file::{Kind, ParticleFile};

use crate::workbench::{METHODS, VOXEL, Workbench, grooved};

const VOXEL_M3: f64 = 1.45e-6 * 1.45e-6 * 1.45e-6;

/// Voxels of a block, by name.
fn voxels(file: &ParticleFile, block: &str) -> u64 {
    file.block_named(block).unwrap().1.count()
}

fn volume(file: &ParticleFile) -> f64 {
    let column = file.column::<f32>("volume").unwrap();
    column.iter().map(|&v| f64::from(v)).sum()
}

/// Voxels of one label in the hand-made specimen.
fn counted(label: u8) -> u64 {
    let rows = (0..16).flat_map(|z| (0..32).map(move |y| (y, z)));
    rows.flat_map(|(y, z)| (0..16).map(move |x| grooved(x, y, z)))
        .filter(|&found| found == label)
        .count() as u64
}

#[test]
fn voxels_and_volume_pass_through_the_pipe() {
    let bench = Workbench::with_bond();
    bench.done(&format!(
        "xct2particles - -q --voxel {VOXEL} -o - < specimen.npy | tee a.mpts |
         build-bondline - -q -o - | tee b.mpts |
         mpm-run case.toml -q --particles - -o run"
    ));
    let [specimen, bond, last] =
        ["a.mpts", "b.mpts", "run/final.mpts"].map(|file| bench.particles(file));
    let kinds = [&specimen, &bond, &last].map(|file| file.header().kind);
    assert_eq!(kinds, [Kind::Specimen, Kind::Bond, Kind::State]);

    let (wood, adhesive) = (counted(128), counted(255));
    assert_eq!((wood, adhesive), (5952, 1024));
    assert_eq!(voxels(&specimen, "wood"), wood);
    assert_eq!(voxels(&specimen, "adhesive"), adhesive);
    assert_eq!(voxels(&bond, "adhesive"), adhesive);
    for file in [&bond, &last] {
        let sides = voxels(file, "wood-bottom") + voxels(file, "wood-top");
        assert_eq!(sides, wood);
    }
    // K = 1 GPa at some MPa: compression is a few tenths of a per cent, the paper's own K.
    let kept = volume(&last) / (adhesive as f64 * VOXEL_M3);
    println!("adhesive volume kept: {kept:.6}");
    assert!((kept - 1.0).abs() < 0.01, "{kept}");
    // What mpm-run reports is what a reader of its files finds, by every method.
    for method in METHODS {
        bench.press("run", method, "--overwrite");
        let history = bench.table("run/history.csv");
        let reported = history.last("adhesive_volume_m3");
        let found = volume(&bench.particles("run/final.mpts"));
        assert!(
            (found / reported - 1.0).abs() < 1e-6,
            "{method:?}: {reported}"
        );
        assert_eq!(history.last("lost_particles"), 0.0, "{method:?}");
    }
    // The pipe and the files of `with_bond` are one and the same bond.
    assert_eq!(bench.sum("b.mpts"), bench.sum("bond.mpts"));
}

/// `-` at both ends of every tool that has both.
#[test]
fn every_tool_reads_and_writes_standard_streams() {
    let bench = Workbench::with_bond();
    bench.press("run", &[], "");
    for line in [
        "wp-metrics - -q -o - < run/final.mpts | grep -q total",
        "cat run/final.mpts | wp-metrics - --map - -o table.csv | head -1 | grep -q wp_um",
        "shear-stats - -o - < run/final.mpts | grep -q q50",
        "cat run/final.mpts | particles sum - | grep -q .",
        "particles info - < bond.mpts | grep -q slab_cells",
        "particles check - < bond.mpts",
        "cat run/final.mpts | particles export - -f csv -o - | wc -l | grep -qx 1025",
        "particles export run/final.mpts -f npz -o - | wc -c | grep -q .....",
        "cat run/final.mpts | bond-figures slice - -o - | grep -q '</svg>'",
        "synth-xct -q --adhesive pf --size 24x48x24 -o - | wp-metrics - -q | grep -q total",
        // A file has the rights that the user's mask leaves.
        "umask 077; wp-metrics run/final.mpts -o own.csv; stat -c %a own.csv | grep -qx 600",
        "umask 022; wp-metrics run/final.mpts -o all.csv; stat -c %a all.csv | grep -qx 644",
    ] {
        bench.done(line);
    }
}

/// The reader of a pipe that goes away ends a tool quietly.
#[test]
fn a_closed_pipe_is_no_error() {
    let bench = Workbench::with_bond();
    bench.press("run", &["clamp.stop=0.05 us"], "");
    // The reader is gone before the tools start to write.
    let lines = [
        "synth-xct -q --adhesive pf --size 64x128x64 -o -",
        "xct2particles -q specimen.npy --voxel 1.45um -o -",
        "build-bondline -q specimen.mpts -o -",
        "mpm-run -q case.toml --particles bond.mpts --explain",
        "wp-metrics -q run/final.mpts",
        "wp-metrics -q run/final.mpts -o table.csv --profile -",
        "shear-stats -q run/final.mpts",
        "particles sum run/final.mpts",
        "particles info run/final.mpts",
        "particles export -f csv run/final.mpts -o -",
        "particles export -f npz run/final.mpts -o -",
        "particles export -f tiff run/final.mpts -o -",
        "bond-figures slice run/final.mpts -o -",
        "particles --help",
    ];
    for line in lines {
        let told = bench.ends(
            0,
            &format!("set +o pipefail; {{ sleep 0.1; {line}; echo $? >&2; }} | :"),
            "",
        );
        assert_eq!(told.trim(), "0", "{line}");
    }
}
