//! Bond files that are sound as files but describe no bond: a sentence, never a panic, and no
//! memory beyond what the file is worth.

use std::fs::{self, File};
use std::path::Path;

use particle_file::{Block, Draft, Header};

use crate::workbench::{Workbench, said};

/// Writes `bond.mpts` again as `forged.mpts` with header and blocks changed.
fn forge(bench: &Workbench, change: Change) {
    let file = bench.particles("bond.mpts");
    let names = ["wood-bottom", "wood-top", "adhesive"];
    let parts = names.map(|name| file.block_named(name).unwrap());
    let mut header = file.header().clone();
    let mut blocks = parts.map(|(block, _)| block.clone());
    change(&mut header, &mut blocks);
    let mut draft = Draft::new(header);
    for (block, (_, bits)) in blocks.into_iter().zip(parts) {
        draft = draft.block(block, bits);
    }
    let mut out = File::create(bench.path("forged.mpts")).unwrap();
    // What the library itself refuses to write is forged byte by byte elsewhere (tests/attack).
    draft.write_to(&mut out).unwrap_or_default();
}

type Change = fn(&mut Header, &mut [Block]);

const FORGERIES: [(&str, Change); 16] = [
    ("gap of a kilometre", |h, _| h.set_attribute("gap_m", 1e3)),
    ("negative gap", |h, _| h.set_attribute("gap_m", -1e-6)),
    ("gap that is no number", |h, _| {
        h.set_attribute("gap_m", "wide")
    }),
    ("no gap", |h, _| h.set_attribute("gap_m", 0.0)),
    ("box of a kilometre", |h, _| h.box_max_m = [1e3; 3]),
    ("box far from its blocks", |h, _| {
        (h.box_min_m, h.box_max_m) = ([1.0; 3], [1.0 + 23.2e-6; 3]);
    }),
    ("flat box", |h, _| h.box_max_m = h.box_min_m),
    ("adhesive outside the box", |_, b| {
        b[2].origin_m = [0.0, 1.0, 0.0]
    }),
    ("wood far away", |_, b| b[1].origin_m = [1e300; 3]),
    ("tiny adhesive voxels", |_, b| b[2].voxel_m = 1e-30),
    ("huge wood voxels", |_, b| b[0].voxel_m = 1e30),
    ("adhesive in the wood", |_, b| b[2].origin_m = b[0].origin_m),
    ("wood a box away", |_, b| b[1].origin_m[1] += 0.1),
    ("a wide box", |h, _| h.box_max_m[0] += 0.1),
    ("a wide and deep box", |h, _| {
        (h.box_max_m[0], h.box_max_m[2]) = (0.05, 0.05);
    }),
    ("voxels of a picometre", |h, b| {
        h.voxel_m = 1e-12;
        b.iter_mut().for_each(|block| block.voxel_m = 1e-12);
    }),
];

#[test]
fn forged_bonds_end_in_a_sentence() {
    let bench = Workbench::with_bond();
    for (what, change) in FORGERIES {
        forge(&bench, change);
        for scheme in ["explicit", "implicit"] {
            // Little address space: a request for more is a mistake here. Time likewise.
            let output = bench.shell(&format!(
                "ulimit -v 4000000; timeout 20 mpm-run -q case.toml --particles forged.mpts -o run \
                 --overwrite --threads 2 --set clamp.stop='20 ns' --set integrator.scheme={scheme}"
            ));
            let (code, told) = (output.status.code(), said(&output));
            println!(
                "{what}, {scheme}: {code:?} {}",
                told.lines().last().unwrap_or("")
            );
            let ended = code == Some(0) || told.contains("mpm-run: ");
            let known = matches!(code, Some(0..=3)) && !told.contains("panicked");
            assert!(ended && known, "{what}, {scheme}: {code:?} {told}");
        }
    }
}

/// Files that made tools panic, abort or write without end (their makers: tests/attack).
#[test]
fn files_found_by_attack_end_in_a_sentence() {
    let bench = Workbench::with_bond();
    let finds = Path::new(env!("CARGO_MANIFEST_DIR")).join("attack/finds/particle-file");
    let finds: Vec<_> = fs::read_dir(&finds).unwrap().collect();
    assert!(finds.len() >= 4);
    for find in finds {
        fs::copy(find.unwrap().path(), bench.path("find.mpts")).unwrap();
        for line in [
            "wp-metrics find.mpts --reference plane=1um --map map.csv",
            "wp-metrics find.mpts --profile profile.csv",
            "particles export find.mpts -o labels.vti",
            "particles export find.mpts -o labels.tif",
            "bond-figures slice find.mpts -o slice.svg",
            "build-bondline find.mpts -o built.mpts",
            "mpm-run case.toml --particles find.mpts -o run --set integrator.scheme=implicit",
        ] {
            // 60 MB of output at most, and 4 GB of memory.
            bench.ends(
                3,
                &format!("ulimit -f 60000 -v 4000000; timeout 20 {line}"),
                "",
            );
        }
    }
    assert!(!bench.path("run").exists());
}
