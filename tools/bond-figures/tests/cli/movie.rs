//! Movies of runs.

use std::fs::{self, File};
use std::io::BufReader;

use particle_file::{BitGrid, Block, Draft, Header, Kind, Material};

use crate::workbench::Bench;

const VOXEL: f64 = 1.45e-6;

/// A state of a run whose upper adherend stands `gap` voxels above the lower one.
fn state(bench: &Bench, name: &str, time_s: f64, gap: f64) {
    let wood = BitGrid::from_fn([12, 10, 8], |x, y, _| (x / 3 + y / 3) % 2 == 0);
    let block = |name, y: f64| {
        let origin = [0.0, y * VOXEL, 0.0];
        Block::new(name, Material::Rigid, origin, VOXEL, &wood)
    };
    let edges = [12.0, 30.0, 8.0].map(|n| n * VOXEL);
    let mut header = Header::new(Kind::State, VOXEL, 1, [0.0; 3], edges);
    header.time_s = time_s;
    let (position, volume) = (
        [6.5, 10.5, 4.5].map(|x| (x * VOXEL) as f32),
        [VOXEL.powi(3) as f32],
    );
    let draft = Draft::new(header)
        .block(block("wood-bottom", 0.0), &wood)
        .block(block("wood-top", 10.0 + gap), &wood)
        .column("position", 3, &position)
        .column("volume", 1, &volume);
    bench.write_particles(name, &draft);
}

#[test]
fn a_movie_has_a_frame_a_state_and_its_camera_stands_still() {
    let bench = crate::bench();
    fs::create_dir(bench.path("run/snapshots")).unwrap();
    for (i, gap) in [8.0, 4.0, 0.0].into_iter().enumerate() {
        let name = format!("run/snapshots/{i:04}.mpts");
        state(&bench, &name, 1e-6 * i as f64, gap);
    }
    // The last snapshot is the final state.
    state(&bench, "run/final.mpts", 2e-6, 0.0);
    let line = "movie PF=run --rate 4 --dpi 60 -o press.png";
    bench.run(line).done();
    assert!(bench.path("press.png.provenance.json").is_file());

    let file = BufReader::new(File::open(bench.path("press.png")).unwrap());
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
