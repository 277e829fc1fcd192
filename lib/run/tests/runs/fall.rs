//! The files of a run, for a drop in free fall: speed, energy and place are known.

use particle_file::ParticleFile;
use run::{End, PossibleEnd, Summary};

use crate::bench::{Bench, PLAIN, has};

/// Acceleration along -y, m/s2.
const G: f64 = 1e6;
/// End of the run, s.
const TIME: f64 = 1e-6;
/// A drop of 8 x 8 x 4 um of 1200 kg/m3.
const VOLUME: f64 = 256e-18;

pub const CASE: &str = r#"
[grid]
cell = "2 um"
domain = { min = ["0 um", "0 um", "0 um"], max = ["20 um", "20 um", "4 um"] }
[adhesive]
density = "1.2 g/cm3"
bulk_modulus = "0.1 GPa"
viscosity = "100 cP"
[[body]]
material = "adhesive"
box = { min = ["6 um", "10 um", "0 um"], max = ["14 um", "18 um", "4 um"] }
[gravity]
acceleration = ["0 m/s2", "-1e6 m/s2", "0 m/s2"]
[stop]
time = "1 us"
[integrator]
scheme = "SCHEME"
cfl = 0.02
[output]
snapshots = 4
history_every = "0.1 us"
"#;

fn fall(bench: &Bench) -> Summary {
    let mut fractions = Vec::new();
    let mut progress = |ends: &[PossibleEnd], said: String| {
        let &[("of the time, {} left", fraction)] = ends else {
            panic!("{ends:?}");
        };
        let time: f64 = said.split(' ').next().unwrap().parse().unwrap();
        // The time is given to a thousandth of the run's 1 us.
        assert!((fraction - time).abs() < 6e-4, "{fraction}: {said}");
        fractions.push(fraction);
    };
    let ended = bench.run_told("run", PLAIN, &|| false, &mut progress, &[]);
    let summary = ended.unwrap().expect("a run that had not ended");
    let told = fractions.len() as u64;
    assert_eq!(told, summary.steps, "told after every step");
    assert!(fractions.is_sorted() && (fractions[fractions.len() - 1] - 1.0).abs() < 1e-9);
    summary
}

#[track_caller]
fn is_near(found: f64, expected: f64, relative: f64) {
    let off = (found / expected - 1.0).abs();
    assert!(off < relative, "{found} for {expected}");
}

/// `error` is relative to the last speed; the implicit scheme makes it in its first step.
fn a_drop_falls(scheme: &str, error: f64) {
    let bench = Bench::with(&CASE.replace("SCHEME", scheme));
    let summary = fall(&bench);
    assert_eq!((summary.end, summary.gap_m), (End::Time, None));
    is_near(summary.time_s, TIME, 1e-9);
    // Eight points in each of 4 x 4 x 2 cells.
    assert_eq!(summary.liquid_points, 256);
    assert_eq!(summary.travel_m, 0.0);
    let energy = 0.5 * 1200.0 * VOLUME * (G * TIME).powi(2);
    is_near(summary.kinetic_energy_j, energy, 2.0 * error);
    assert!(summary.invariants.volume_change.abs() < 1e-3);
    assert_eq!(summary.invariants.points_in_wood, 0);
    has(&summary.sentence(), &["reached its time"]);
    let times = bench.numbers("time_s");
    let steps = bench.numbers("step");
    assert!(times.is_sorted_by(|a, b| a < b) && steps.is_sorted_by(|a, b| a < b));
    assert_eq!(steps[0], 1.0, "a row after the first step");
    assert_eq!(*steps.last().unwrap(), summary.steps as f64);
    is_near(*times.last().unwrap(), TIME, 1e-9);
    // A row after each tenth of the time, and one at the end.
    let longest = bench.numbers("dt_s").into_iter().fold(0.0, f64::max);
    let gaps = times.windows(2).map(|pair| pair[1] - pair[0]);
    let widest = gaps.fold(0.0, f64::max);
    assert!(widest < 0.1 * TIME + 2.0 * longest, "{times:?}");
    assert!((9..=12).contains(&times.len()), "{times:?}");
    for (time, speed) in times.iter().zip(bench.numbers("max_speed_m_s")) {
        let off = (speed - G * time).abs();
        assert!(off < error * G * TIME, "{speed} at {time}");
    }
    for volume in bench.numbers("adhesive_volume_m3") {
        is_near(volume, VOLUME, 1e-3);
    }
    let gaps = bench.column("gap_m");
    assert!(gaps.iter().all(String::is_empty), "no clamp");
    assert!(bench.numbers("lost_particles").iter().all(|&n| n == 0.0));

    let run = bench.path("run");
    assert!(!run.join("checkpoint.mpts").exists(), "nothing to continue");
    // Snapshots are due at the start and after each quarter of the time.
    for i in 0..4 {
        let snapshot = ParticleFile::open(run.join(format!("snapshots/{i:04}.mpts"))).unwrap();
        let (time, due) = (snapshot.header().time_s, 0.25 * f64::from(i) * TIME);
        assert!(time >= due && time < due + 2.0 * longest, "{i}: {time}");
        assert_falls(&snapshot, error, longest);
    }
    assert!(!run.join("snapshots/0005.mpts").exists());
    let end = ParticleFile::open(run.join("final.mpts")).unwrap();
    assert_eq!(end.header().step, summary.steps);
    assert_eq!(end.header().attribute("cell_m"), Some("0.000002"));
    assert_falls(&end, error, longest);
    end.check().unwrap();
}

/// The centre of the drop has fallen by g t^2 / 2 from y = 14 um. Steps of up to `longest` move at their last speed, which
/// adds half of the change of speed in a step.
fn assert_falls(state: &ParticleFile, error: f64, longest: f64) {
    let (places, time) = (state.vectors("position").unwrap(), state.header().time_s);
    let volumes = state.column::<f32>("volume").unwrap();
    let whole: f64 = volumes.iter().map(|&v| f64::from(v)).sum();
    let mean_of = |vectors: &[[f32; 3]], a: usize| {
        let weighed = vectors.iter().zip(volumes.iter());
        let sum: f64 = weighed.map(|(x, &v)| f64::from(x[a]) * f64::from(v)).sum();
        sum / whole
    };
    let mean = |a: usize| mean_of(places, a);
    let fallen = 0.5 * G * time * time;
    let off = (mean(1) - (14e-6 - fallen)).abs();
    let (rounded, most) = (error * G * TIME * TIME, 0.5 * G * time * longest);
    assert!(off < rounded + most, "{off} at {time}");
    assert!((mean(0) - 10e-6).abs() < 1e-9 && (mean(2) - 2e-6).abs() < 1e-9);
    let speeds = state.vectors("velocity").unwrap();
    let off = (mean_of(speeds, 1) + G * time).abs();
    assert!(off < error * G * TIME, "{off} at {time}");
}

#[test]
fn a_drop_falls_by_the_explicit_scheme() {
    a_drop_falls("explicit", 5e-3);
}

#[test]
fn a_drop_falls_by_the_implicit_scheme() {
    // A step cut short after its solution keeps the speed of the longer step: 3 %.
    a_drop_falls("implicit", 0.03);
}
