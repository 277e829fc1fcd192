//! A pressed bond of voxels with lumens: the result does not depend on its orientation, on threads, or on a restart.

use implicit::Implicit;
use physics::{
    Boundary, LiquidState, Motion, Press, PressRun, Scene, Scheme, StepLimit, StepReport, Stop,
    VoxelBlock, WallLaw, Wetting,
};

use crate::plain;
use crate::runs::{self, advance, at_rest, clamp, plainly, solved, stage, with};
use crate::water::losing;

/// Steps in which an adhesive that dries is pressed: before lumens of one voxel a cell are full and the clamp waits for its
/// water to go.
const DRYING: usize = 4;
/// Edge of a voxel, m.
const VOXEL: f64 = 1.45e-6;
/// Voxels along x and z, of each body along y, and of the slab.
const N: usize = 16;
const DEEP: usize = 16;
const SLAB: usize = 4;

/// Whether a voxel of a body is wood, `layer` counted from the bond: lumens along z cut open at the bond and below it,
/// one along x, and a pit.
fn wood(x: usize, layer: usize, z: usize) -> bool {
    let in_disc = |cx: f64, cy: f64, r: f64| {
        let (dx, dy) = (x as f64 + 0.5 - cx, layer as f64 + 0.5 - cy);
        dx * dx + dy * dy < r * r
    };
    let across = {
        let (dz, dy) = (z as f64 + 0.5 - 11.0, layer as f64 + 0.5 - 2.0);
        dz * dz + dy * dy < 5.0
    };
    let pit = (5..7).contains(&x) && layer < 10 && (3..5).contains(&z);
    !(in_disc(4.0, 8.0, 3.6) || in_disc(11.5, 1.0, 3.3) || across || pit)
}

/// How the bond lies: its voxel (x, z) is the wood of `place(x, z)`.
fn scene(k: usize, boundary: Boundary, place: impl Fn(usize, usize) -> [usize; 2]) -> Scene {
    let cell = VOXEL * k as f64;
    let height = 2 * DEEP + SLAB;
    let mut scene = plain::scene(cell, [N / k, height / k, N / k]);
    let v = |n: usize| n as f64 * VOXEL;
    let block = |y: usize, up: bool| {
        VoxelBlock::from_fn([0.0, v(y), 0.0], [VOXEL; 3], [N, DEEP, N], |x, j, z| {
            let layer = if up { j } else { DEEP - 1 - j };
            let [x, z] = place(x, z);
            // The upper body is the lower one turned by half a turn.
            if up {
                wood(N - 1 - x, layer, N - 1 - z)
            } else {
                wood(x, layer, z)
            }
        })
    };
    let blocks = [vec![block(0, false)], vec![block(DEEP + SLAB, true)]];
    runs::press(
        &mut scene,
        ["wood-bottom", "wood-top"],
        blocks,
        Motion::Clamped,
    );
    scene.points = plain::fill([0.0, v(DEEP), 0.0], [VOXEL; 3], [N, SLAB, N]);
    scene.boundary = [boundary, Boundary::Symmetry, boundary];
    scene.wall = WallLaw::PartialSlip {
        influence_length_m: 0.01 * cell,
    };
    scene.clamp = clamp(1.0, 2.5e6);
    scene.stop = Stop::Closed { travel_m: v(SLAB) };
    scene
}

/// Part of the travel that is left where a bond counts as closed: menisci hold the last of its liquid.
const CLOSED: f64 = 1e-3;
/// The same with an adhesive that loses water to the wood.
fn drying(k: usize, boundary: Boundary, place: impl Fn(usize, usize) -> [usize; 2]) -> Scene {
    let mut scene = scene(k, boundary, place);
    let water = losing(&scene, 0.02, |law| {
        (law.capacity, law.diffusivity) = (Some(0.5e-6), 1e-6);
        law.factor[1].1 = 10.0;
    });
    scene.liquid.water = Some(water);
    scene
}

/// Presses a bond for so many steps or to its end: reports of the steps, and the liquid.
fn press(scheme: &mut Implicit, steps: usize) -> (Vec<StepReport>, LiquidState) {
    let travel = VOXEL * SLAB as f64;
    let mut reports = Vec::new();
    let mut left = travel + scheme.displacements()[1][1];
    while left > CLOSED * travel && reports.len() < steps {
        let limit = StepLimit {
            time_s: 1e-3,
            travel_m: left,
        };
        let report = scheme.advance(limit).unwrap();
        left = travel - report.travel_m;
        reports.push(report);
    }
    (reports, scheme.liquid())
}

/// Root of the mean square of the liquid's distance from the bond, um.
fn penetration(liquid: &LiquidState) -> f64 {
    let mid = VOXEL * DEEP as f64;
    let mean = |f: &dyn Fn(f64) -> f64| -> f64 {
        let sum = liquid.position.iter().zip(&liquid.volume);
        sum.map(|(x, &v)| f(f64::from(x[1])) * f64::from(v)).sum()
    };
    1e6 * (mean(&|y| (y - mid).powi(2)) / mean(&|_| 1.0)).sqrt()
}

/// Also with menisci as strong as a tenth of the clamp's pressure, and with an adhesive that loses water to the wood.
#[test]
fn a_bond_is_pressed_the_same_however_it_lies() {
    let drinking = |k, boundary, place: Place| {
        let mut scene = scene(k, boundary, place);
        scene.liquid.wetting = Some(Wetting {
            tension: 0.5,
            contact_angle: 40_f64.to_radians(),
        });
        scene
    };
    let scene = |k, boundary, place: Place| scene(k, boundary, place);
    let drying = |k, boundary, place: Place| drying(k, boundary, place);
    for k in [1, 2] {
        however_it_lies(&format!("k {k}"), k, &scene, usize::MAX, 1e-5);
        however_it_lies(&format!("k {k}, menisci"), k, &drinking, 10, 1e-8);
        however_it_lies(&format!("k {k}, drying"), k, &drying, DRYING, 1e-5);
    }
}

/// Which voxel (x, z) of the wood lies at a voxel of the bond.
type Place<'a> = &'a dyn Fn(usize, usize) -> [usize; 2];

fn however_it_lies(
    what: &str,
    k: usize,
    scene: &dyn Fn(usize, Boundary, Place) -> Scene,
    steps: usize,
    tolerance: f64,
) {
    let found = |boundary, place: Place| {
        let mut scheme = solved(&scene(k, boundary, place), tolerance);
        let (reports, liquid) = press(&mut scheme, steps);
        let solids = scheme.diagnostics().water.map_or(1.0, |water| water.solids);
        (reports, penetration(&liquid), solids)
    };
    let (mirror, turn) = (Boundary::Symmetry, Boundary::Periodic);
    let plain = found(mirror, &|x, z| [x, z]);
    let periodic = found(turn, &|x, z| [x, z]);
    println!(
        "{what}: {} steps, WP {:.4} um, periodic {:.4} um, solids content {:.4}",
        plain.0.len(),
        plain.1,
        periodic.1,
        plain.2
    );
    let places: [(&str, Boundary, Place); 5] = [
        ("x mirrored", mirror, &|x, z| [N - 1 - x, z]),
        ("z mirrored", mirror, &|x, z| [x, N - 1 - z]),
        ("x and z exchanged", mirror, &|x, z| [z, x]),
        ("shifted by 6 voxels over x", turn, &|x, z| [(x + 6) % N, z]),
        ("shifted by 10 voxels over z", turn, &|x, z| {
            [x, (z + 10) % N]
        }),
    ];
    for (name, boundary, place) in places {
        let as_it_lies = if boundary == mirror {
            &plain
        } else {
            &periodic
        };
        let other = found(boundary, place);
        let last = |reports: &[StepReport]| reports[reports.len() - 1].pressure_top;
        let depth = other.1 / as_it_lies.1 - 1.0;
        let pressure = last(&other.0) / last(&as_it_lies.0) - 1.0;
        let solids = other.2 / as_it_lies.2 - 1.0;
        println!("{what}, {name}: WP {depth:+.1e}, pressure {pressure:+.1e}, solids {solids:+.1e}");
        let most = |of: f64| of.abs() < 1e-3;
        assert!(most(depth) && most(pressure) && most(solids), "{name}");
    }
}

#[test]
fn both_bodies_bear_the_same_and_no_liquid_is_made_or_lost() {
    for k in [1, 2] {
        let scene = scene(k, Boundary::Symmetry, |x, z| [x, z]);
        let (reports, liquid) = press(&mut solved(&scene, 1e-5), usize::MAX);
        // In the first, from rest, inertia counts.
        let apart = (reports[1..4].iter())
            .map(|report| (report.pressure_bottom / report.pressure_top - 1.0).abs())
            .fold(0.0, f64::max);
        let error = at_rest(&scene, &liquid) / scene.liquid_volume() - 1.0;
        println!("k {k}: other side {apart:.1e}, volume {error:+.1e}");
        // Points are in single precision.
        assert!(apart < 2e-3 && error.abs() < 1e-6);
    }
}

#[test]
fn a_run_that_was_stopped_goes_on_to_the_same_end_on_any_number_of_threads() {
    for k in [1, 2] {
        let scene = drying(k, Boundary::Symmetry, |x, z| [x, z]);
        let mut whole = solved(&scene, 1e-5);
        let on = |threads: usize, work: &mut (dyn FnMut() + Send)| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
            pool.unwrap().install(work);
        };
        on(1, &mut || drop(press(&mut whole, 2)));
        let mut resumed = solved(&scene, 1e-5);
        resumed.restore(&whole.save()).unwrap();
        let parts = |l: LiquidState| (l.position, l.volume, l.pressure, l.velocity, l.shear_rate);
        assert!(parts(resumed.liquid()) == parts(whole.liquid()));
        on(1, &mut || drop(press(&mut whole, usize::MAX)));
        on(2, &mut || drop(press(&mut resumed, usize::MAX)));
        assert!(whole.save() == resumed.save());
    }
}

/// Air that the bond closes off in its lumens: the press ends, and a stop on the way changes nothing.
#[test]
fn a_bond_with_air_and_menisci_ends_and_goes_on_where_it_stopped() {
    for k in [1, 2] {
        let mut scene = scene(k, Boundary::Symmetry, |x, z| [x, z]);
        scene.liquid.wetting = Some(Wetting {
            tension: 0.05,
            contact_angle: 0.7,
        });
        let begun = || with(&scene, |settings| settings.air_pressure = Some(1e5));
        let mut whole = begun();
        press(&mut whole, 2);
        let mut resumed = begun();
        resumed.restore(&whole.save()).unwrap();
        let (reports, liquid) = press(&mut whole, 60);
        press(&mut resumed, 60);
        println!(
            "k {k}: {} more steps, WP {:.3} um, {:?}",
            reports.len(),
            penetration(&liquid),
            whole.counts()
        );
        assert!(reports.len() < 60 && whole.save() == resumed.save());
    }
}

/// A clamp at the end of its travel stands for the rest of its programme.
#[test]
fn a_closed_clamp_stands_until_its_programme_ends() {
    let mut scene = scene(2, Boundary::Periodic, |x, z| [x, z]);
    scene.programme = vec![
        stage(Press::Approach, 1e-3, None, 1.0),
        stage(Press::Hold, 1e-3, Some(1e9), 2e-3),
    ];
    let mut scheme = plainly(&scene);
    let mut held = 0;
    while !scheme.programme().is_some_and(PressRun::is_over) {
        let closed = scheme.programme().is_some_and(PressRun::is_closed);
        let report = advance(&mut scheme, f64::INFINITY);
        held += u32::from(closed);
        assert!(!closed || report.closing_speed == 0.0);
        assert!(report.pressure_top.is_finite() && held < 100);
    }
    assert!(held > 0);
    let way = SLAB as f64 * VOXEL;
    assert!((scheme.displacements()[1][1] / way + 1.0).abs() < 1e-9);
}
