//! Movies of runs.

use std::fs::{self, File};
use std::io::BufReader;
use std::path::Path;
use std::process::{Command, Output};

use particle_file::{BitGrid, Block, Draft, Header, Kind, Material};

const VOXEL: f64 = 1.45e-6;

/// A state of a run whose upper adherend stands `gap` voxels above the lower one.
fn state(path: &Path, time_s: f64, gap: f64) {
    let wood = BitGrid::from_fn([12, 10, 8], |x, y, _| (x / 3 + y / 3) % 2 == 0);
    let block = |name, y: f64| {
        let origin = [0.0, y * VOXEL, 0.0];
        Block::new(name, Material::Rigid, origin, VOXEL, &wood)
    };
    let edges = [12.0, 30.0, 8.0].map(|n| n * VOXEL);
    let mut header = Header::new(Kind::State, VOXEL, 1, [0.0; 3], edges);
    header.time_s = time_s;
    Draft::new(header)
        .block(block("wood-bottom", 0.0), &wood)
        .block(block("wood-top", 10.0 + gap), &wood)
        .column("position", 3, &[6.5, 10.5, 4.5].map(|x| (x * VOXEL) as f32))
        .column("volume", 1, &[VOXEL.powi(3) as f32])
        .write_to(&mut File::create(path).unwrap())
        .unwrap();
}

fn movie(folder: &Path, arguments: &str) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_bond-figures"));
    command.arg("movie").args(arguments.split(' '));
    command.current_dir(folder).output().unwrap()
}

#[test]
fn a_movie_has_a_frame_a_state_and_its_camera_stands_still() {
    let folder = tempfile::tempdir().unwrap();
    let run = folder.path().join("run");
    fs::create_dir_all(run.join("snapshots")).unwrap();
    for (i, gap) in [8.0, 4.0, 0.0].into_iter().enumerate() {
        let path = run.join(format!("snapshots/{i:04}.mpts"));
        state(&path, 1e-6 * i as f64, gap);
    }
    // The last snapshot is the final state.
    state(&run.join("final.mpts"), 2e-6, 0.0);
    let output = movie(folder.path(), "PF=run --rate 4 --dpi 60 -o press.png");
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{said}");
    assert!(folder.path().join("press.png.provenance.json").is_file());

    let file = BufReader::new(File::open(folder.path().join("press.png")).unwrap());
    let mut reader = png::Decoder::new(file).read_info().unwrap();
    let control = reader.info().animation_control().unwrap();
    assert_eq!((control.num_frames, control.num_plays), (3, 0));
    let (mut frames, mut delays) = (Vec::new(), Vec::new());
    for _ in 0..3 {
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut pixels).unwrap();
        let shown = reader.info().frame_control().unwrap();
        delays.push(f64::from(shown.delay_num) / f64::from(shown.delay_den));
        frames.push(pixels);
    }
    assert_eq!(delays, [0.25, 0.25, 2.0]);
    // The axes and the lower adherend, the lower third, stay as they are; above all changes.
    let [width, height] = [reader.info().width, reader.info().height].map(|n| n as usize);
    let part = |frame: usize, rows: std::ops::Range<usize>| {
        frames[frame][3 * width * rows.start..3 * width * rows.end].to_vec()
    };
    for frame in [1, 2] {
        let low = 2 * height / 3..height;
        assert!(part(frame, low.clone()) == part(0, low), "frame {frame}");
        assert!(part(frame, 0..height / 2) != part(0, 0..height / 2));
    }
}

#[test]
fn a_folder_without_states_and_other_formats_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    for (arguments, status, says) in [
        ("x=. -o a.png", 3, "holds no state of a run"),
        ("x=. -o a.gif", 2, "must end in .png"),
        ("x=. --rate 0 -o a.png", 2, "0.1 to 60"),
    ] {
        let output = movie(folder.path(), arguments);
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(status), "{said}");
        assert!(said.contains(says), "{said}");
    }
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
}
