//! Messages, refusals and output of the tool.

mod export;
#[path = "../../../workbench.rs"]
mod workbench;

use particle_file::{BitGrid, Block, Draft, Header, Kind, Material, Provenance};
use workbench::Bench;

const VOXEL: f64 = 1.5e-6;
const DIMS: [usize; 3] = [70, 4, 3];

fn is_wood(x: usize, y: usize, z: usize) -> bool {
    (x + 2 * y + 3 * z).is_multiple_of(5)
}

/// A folder with states `0000.mpts` and so on at these steps of a microsecond: the upper adherend comes down by a
/// quarter voxel per step from two voxels above the lower one; three liquid points of a voxel's volume each lie between
/// them, in voxels (1, 4, 0), (2, 4, 0) and (69, 5, 2).
fn bench(steps: &[u64]) -> Bench {
    let bench = Bench::new(env!("CARGO_BIN_EXE_particles"));
    let wood = BitGrid::from_fn(DIMS, is_wood);
    let block = |name, low| Block::new(name, Material::Rigid, [0.0, low, 0.0], VOXEL, &wood);
    let place = [[1.5, 4.5, 0.5], [2.25, 4.75, 0.25], [69.5, 5.5, 2.5]];
    let position: Vec<f32> = place.iter().flatten().map(|x| (x * VOXEL) as f32).collect();
    for &step in steps {
        let mut header = Header::new(Kind::State, VOXEL, 1, [0.0; 3], [1.05e-4, 1.5e-5, 4.5e-6]);
        (header.step, header.time_s) = (step, step as f64 * 1e-6);
        header.provenance.push(Provenance {
            tool: "mpm-run".into(),
            command: ["mpm-run", "my case.toml", "--overwrite"]
                .map(String::from)
                .into(),
            ..Provenance::default()
        });
        let top = (6.0 - 0.25 * step as f64) * VOXEL;
        let draft = Draft::new(header)
            .block(block("wood-bottom", 0.0), &wood)
            .block(block("wood-top", top), &wood)
            .column("position", 3, &position)
            .column("volume", 1, &[3.3e-18_f32, 3.4e-18, 3.5e-18])
            .column("pressure", 1, &[0.0_f32, -1.5, 2.5e6]);
        bench.write_particles(&format!("{step:04}.mpts"), &draft);
    }
    bench
}

#[test]
fn info_says_what_a_file_holds_and_a_man_page_needs_none() {
    let bench = bench(&[2]);
    let text = bench.run("info 0002.mpts").output();
    for expected in [
        "kind        state of a run",
        "voxel       1.5 um",
        "normal      y",
        "time        2e-6 s, step 2",
        "wood-top: rigid, 168 of 70 x 4 x 3 voxels (20.00 %) of 1.5 um from 0, 8.25, 0 um",
        "liquid      3 points",
        "position: 3 rows of 3 f32",
        ": mpm-run 'my case.toml' --overwrite",
    ] {
        assert!(text.contains(expected), "'{expected}' is not in\n{text}");
    }
    for line in ["--generate man", "info --generate=man"] {
        assert!(bench.run(line).output().contains(".TH particles 1"));
    }
}

#[test]
fn the_sum_is_the_same_from_a_file_a_redirection_and_a_pipe() {
    let bench = bench(&[0, 1]);
    let sum = |text: String| text.split(' ').next().unwrap().to_owned();
    let named = sum(bench.run("sum 0000.mpts").output());
    assert_eq!(named.len(), 16);
    for line in ["$TOOL sum - < 0000.mpts", "cat 0000.mpts | $TOOL sum -"] {
        assert_eq!(sum(bench.shell(line).output()), named);
    }
    assert_ne!(sum(bench.run("sum 0001.mpts").output()), named);
}

#[test]
fn check_finds_every_damaged_file_and_exits_with_3() {
    let bench = bench(&[0]);
    let whole = bench.read("0000.mpts");
    assert_eq!(bench.run("check 0000.mpts").output(), "0000.mpts: ok\n");
    let mut flipped = whole.clone();
    flipped[whole.len() - 16 - 64] ^= 1; // the last value
    bench.write("short.mpts", &whole[..whole.len() - 1]);
    bench.write("flipped.mpts", flipped);
    for (name, reason) in [
        ("short.mpts", "truncated"),
        ("flipped.mpts", "damaged array 'pressure'"),
        (".", "folder"),
    ] {
        let said = bench.run(&format!("check {name}")).refused(3, reason).said;
        assert_eq!(said.lines().count(), 1, "{said}");
    }
    let all = bench.run("check short.mpts 0000.mpts flipped.mpts");
    let all = all
        .refused(3, "2 files are damaged")
        .refused(3, "short.mpts");
    assert_eq!(all.stdout, b"0000.mpts: ok\n");
}
