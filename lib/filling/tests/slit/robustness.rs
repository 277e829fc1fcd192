//! Stiff and extreme liquids and time steps; and results that do not depend on threads or stops.

use filling::{Implicit, Plan, Settings};
use physics::{
    Amount, Array, Boundary, Dimensions, Law, Motion, Newtonian, Scene, Scheme, StepLimit, Stop,
    Table, Tait, Viscosity, VoxelBlock,
};

use crate::{SPEED, at, march, plain, run, scene};

/// Force at L = 2 H over that of lubrication theory for PF at CFL 0.5, changed by `change`.
fn force(cfl: f64, change: impl Fn(&mut Scene)) -> f64 {
    let settings = Settings {
        cfl,
        ..Settings::default()
    };
    let filled = run(3, [0.25, 0.0], settings, change);
    assert_eq!(filled.in_walls, 0);
    at(&filled.force, 2.0)
}

#[test]
fn stiff_and_extreme_cases_stay_stable() {
    let usual = force(0.5, |_| ());
    for cfl in [0.05, 1.0, 1.5] {
        let f = force(cfl, |_| ());
        println!("CFL {cfl}: force {:+.3} of that at 0.5", f / usual - 1.0);
        assert!((f / usual - 1.0).abs() < 0.15, "CFL {cfl}: {f}");
    }
    // Forces scale with the viscosity as long as inertia (1e-3 Pa s) and compression (1e3 Pa s,
    // 1e7 Pa) do not count; where they do the run must still end, with no particle in a wall.
    // Without its limit on what particles carry, inertia would feed on itself: -60 times PF's.
    for (eta, bulk, tolerance) in [
        (1e-3, 1e9, 2.0),
        (10.0, 1e10, 0.1),
        (1e3, 1e10, f64::INFINITY),
        (1.3, 1e7, f64::INFINITY),
        (1.3, 1e10, 0.1),
    ] {
        let f = force(0.5, |scene| {
            scene.liquid.viscosity = Viscosity::Newtonian(Newtonian(eta));
            scene.liquid.tait = Tait { bulk_modulus: bulk };
        }) * crate::ETA
            / eta;
        println!(
            "viscosity {eta} Pa s, K {bulk:e} Pa: force {:+.3} of PF's",
            f / usual - 1.0
        );
        assert!(f.is_finite());
        assert!(
            (f / usual - 1.0).abs() < tolerance,
            "viscosity {eta}, K {bulk}: {f}"
        );
    }
}

/// At 1e4 1/s and more the table of PVA-PF is at its last value, so the flow is Newtonian.
#[test]
fn a_viscosity_table_from_rest() {
    let table = |scene: &mut Scene| {
        let at = |log: f64, eta: f64| (10_f64.powf(log), eta);
        let points = [at(0.0, 210.0), at(0.8, 87.0), at(1.6, 1.7), at(2.7, 1.0)];
        scene.liquid.viscosity = Viscosity::Table(Table::new(&points).unwrap());
    };
    let newtonian = |scene: &mut Scene| {
        scene.liquid.viscosity = Viscosity::Newtonian(Newtonian(1.0));
    };
    let ratio = force(0.5, table) / force(0.5, newtonian);
    println!("table over its last viscosity: {ratio:.4}");
    assert!((ratio - 1.0).abs() < 0.05, "{ratio}");
}

/// Liquid six cells high and four wide between a floor and a lid.
fn layer() -> Scene {
    let mut layer = scene(6, [0.0; 2]);
    let h = layer.grid.cell_m;
    layer.grid.cells = [4, 10, 1];
    let wall = |low: f64, high: f64| {
        VoxelBlock::solid_box([-9.0 * h, low * h, 0.0], [99.0 * h, high * h, h])
    };
    layer.bodies[0].blocks = vec![wall(-9.0, 2.0)];
    layer.bodies[1].blocks = vec![wall(8.0, 99.0)];
    layer.bodies[1].motion = Motion::Fixed;
    layer.points = plain::fill([0.0, 2.0 * h, 0.0], [0.5 * h, 0.5 * h, h], [8, 12, 1]);
    layer
}

/// Tait's law (paper Eq. 1) where the liquid gets stiffer as it is compressed: 7 % by a lid.
#[test]
fn strong_compression_follows_tait() {
    let mut chamber = layer();
    let (h, tait) = (chamber.grid.cell_m, chamber.liquid.tait);
    chamber.bodies[1].motion = Motion::Constant([0.0, -1.0, 0.0]);
    chamber.bottom = Some(0);
    let settings = Settings {
        cfl: 0.02,
        tolerance: 1e-5,
        ..Settings::default()
    };
    let mut scheme = Implicit::new(chamber, settings).unwrap();
    let mut pressure = 0.0;
    march::until(&mut scheme, 0.07 * 6.0 * h, |report, _| {
        pressure = report.pressure_bottom;
    });
    let error = pressure / tait.pressure(-0.07) - 1.0;
    println!(
        "pressure at J = 0.93: {:.1} MPa, {error:+.4} of Tait's",
        pressure / 1e6
    );
    assert!(error.abs() < 0.03, "{error}");
}

/// Mean velocity along a periodic channel of six cells after three steps under a body force.
fn channel_velocity(viscosity: Viscosity) -> f64 {
    let mut channel = layer();
    channel.boundary[0] = Boundary::Periodic;
    channel.gravity = [2e7, 0.0, 0.0];
    channel.liquid.viscosity = viscosity;
    let mut scheme = Implicit::new(channel, Settings::default()).unwrap();
    for _ in 0..3 {
        let limit = StepLimit {
            time_s: 1e-6,
            travel_m: f64::INFINITY,
        };
        scheme.advance(limit).unwrap();
    }
    let velocity = scheme.liquid().velocity;
    velocity.iter().map(|v| f64::from(v[0])).sum::<f64>() / velocity.len() as f64
}

/// Cells at the front and images beyond periodic sides have a viscosity too.
#[test]
fn a_constant_table_is_newtonian() {
    let table = || Viscosity::Table(Table::new(&[(1e2, 7.0), (1e5, 6.99999)]).unwrap());
    let newtonian = || Viscosity::Newtonian(Newtonian(7.0));
    let filling = force(0.5, |scene| scene.liquid.viscosity = table())
        / force(0.5, |scene| scene.liquid.viscosity = newtonian());
    let channel = channel_velocity(table()) / channel_velocity(newtonian());
    println!("constant table over Newtonian: filling {filling:.5}, channel {channel:.5}");
    assert!((filling - 1.0).abs() < 2e-3 && (channel - 1.0).abs() < 2e-3);
}

/// A law whose stress grows with the rate, from the piston's 3e4 1/s to the slit's 7e5 1/s.
fn thinning() -> Viscosity {
    Viscosity::Table(Table::new(&[(1e4, 5.0), (1e6, 1.0)]).unwrap())
}

/// One that thickens a thousandfold between the rates met: passes swing about it.
fn thickening() -> Viscosity {
    Viscosity::Table(Table::new(&[(1e5, 1.0), (1e6, 1e3)]).unwrap())
}

/// The slit's scene with a liquid of this viscosity, after `steps` steps.
fn stepped(viscosity: &Viscosity, steps: usize) -> Implicit {
    let mut scheme = fresh(viscosity);
    (0..steps).for_each(|_| step(&mut scheme));
    scheme
}

fn fresh(viscosity: &Viscosity) -> Implicit {
    let mut scene = scene(6, [0.25, 0.0]);
    scene.liquid.viscosity = viscosity.clone();
    Implicit::new(scene, Settings::default()).unwrap()
}

fn step(scheme: &mut Implicit) {
    let limit = StepLimit {
        time_s: 1.0 / SPEED,
        travel_m: f64::INFINITY,
    };
    scheme.advance(limit).unwrap();
}

/// Positions after `steps` steps, saved and restored into a new scheme after `stop` of them.
fn positions(viscosity: &Viscosity, threads: usize, steps: usize, stop: usize) -> Vec<[u32; 3]> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
    pool.build().unwrap().install(|| {
        let mut scheme = fresh(viscosity);
        for taken in 0..steps {
            if taken == stop {
                let saved = scheme.save();
                scheme = fresh(viscosity);
                scheme.restore(&saved).unwrap();
            }
            step(&mut scheme);
        }
        let liquid = scheme.liquid();
        liquid
            .position
            .iter()
            .map(|x| x.map(f32::to_bits))
            .collect()
    })
}

#[test]
fn same_bits_for_any_threads_and_after_a_restart() {
    let law = Law::CarreauYasuda {
        plateaus: [5.0, 0.1],
        time: 1e-5,
        index: 0.4,
        transition: 2.0,
    };
    let newtonian = Viscosity::Newtonian(Newtonian(crate::ETA));
    for viscosity in [newtonian, thinning(), Viscosity::Law(law)] {
        let of = |threads, stop| positions(&viscosity, threads, 6, stop);
        let usual = of(1, 99);
        assert_eq!(usual, of(3, 99), "three threads");
        assert_eq!(usual, of(2, 3), "two threads and a restart");
    }
}

/// A table's viscosity starts from the face velocities of the step before, which a checkpoint holds.
#[test]
fn a_checkpoint_holds_face_velocities_where_the_viscosity_needs_them() {
    let newtonian = stepped(&Viscosity::Newtonian(Newtonian(1.0)), 1).save();
    assert!(newtonian.f32s("face_velocity").is_err());
    let saved = stepped(&thinning(), 1).save();
    let forged = |name: &str, change: &dyn Fn(&mut Array)| {
        let mut forged = saved.clone();
        let array = forged.0.iter_mut().find(|(n, _)| n == name);
        change(&mut array.unwrap().1);
        fresh(&thinning()).restore(&forged).unwrap_err()
    };
    let f64s = |i: usize, by: f64| {
        move |array: &mut Array| match array {
            Array::F64(values) => values[i] += by,
            _ => unreachable!(),
        }
    };
    for (i, by) in [
        (0, -9.0),
        (1, 0.5),
        (2, 1.0),
        (3, -1.0),
        (4, 1e9),
        (5, f64::NAN),
    ] {
        let said = forged("window", &f64s(i, by));
        assert!(said.contains("window"), "{i} {by}: {said}");
    }
    let said = forged("face_velocity", &|array| {
        if let Array::F32(values) = array {
            values[0] = f32::INFINITY;
        }
    });
    assert!(said.contains("is infinite"), "{said}");
}

/// A run says where its viscosity is not that of its flow.
#[test]
fn a_viscosity_that_does_not_settle_is_told() {
    assert_eq!(stepped(&thinning(), 3).objection(), None);
    let said = stepped(&thickening(), 3).objection().unwrap();
    assert!(said.contains("20 passes"), "{said}");
}

#[test]
fn a_checkpoint_holds_no_point_more_than_a_cell_beside_the_domain() {
    let new = || Implicit::new(scene(6, [0.0; 2]), Settings::default()).unwrap();
    let restored = |x: f64| {
        let mut saved = new().save();
        for (name, array) in &mut saved.0 {
            if let Array::F64(positions) = array
                && name == "position"
            {
                positions[0] = x;
            }
        }
        new().restore(&saved)
    };
    assert_eq!(restored(-0.9), Ok(()));
    assert!(restored(-1.1).unwrap_err().contains("point 0"));
}

#[test]
fn a_scene_has_at_most_250_bodies() {
    let of = |bodies: usize| {
        let mut scene = scene(6, [0.0; 2]);
        let nothing = plain::body("nothing", vec![], Motion::Fixed);
        scene.bodies.resize(bodies, nothing);
        Implicit::new(scene, Settings::default()).err()
    };
    assert_eq!(of(250), None);
    assert!(of(251).unwrap().contains("at most 250"));
}

/// 0.75 million liquid cells, 8 points each.
#[test]
fn the_forecast_is_that_of_the_measured_run() {
    let mut scene = scene(6, [0.0; 2]);
    scene.dimensions = Dimensions::Three;
    scene.grid.cells = [250, 100, 250];
    scene.stop = Stop::Time(1e-4);
    let h = scene.grid.cell_m;
    let amount = Amount {
        points: 6_000_000,
        volume_m3: 750e3 * h.powi(3),
        low_m: [0.0; 3],
        high_m: [250.0 * h, 12.0 * h, 250.0 * h],
        speed: 0.0,
    };
    let plan = Plan::new(&scene, &amount, &Settings::default());
    let (unknowns, gap) = (3.225e6, 36.0 * 62_500.0);
    println!("{plan:?}");
    // The liquid four times as fast as the piston, a cell a step.
    assert_eq!(plan.steps, (1e-4 * 4.0 * SPEED / h).ceil());
    assert!((plan.memory_bytes / (400.0 * unknowns + 200.0 * gap + 660e6) - 1.0).abs() < 1e-9);
    // 13 iterations of 0.42 s, 5.5 s to assemble, 4.2 s for the points.
    assert!((plan.cpu_s / plan.steps / (13.0 * 0.419 + 5.48 + 4.2) - 1.0).abs() < 0.01);
}
