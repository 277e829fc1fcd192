//! The plan's limits, and what is refused or stopped, in sentences.

mod scenes;

use mpm::{Explicit, Limit, Plan, Settings, ShapeFunction, VelocityUpdate};
use physics::{Amount, Boundary, Motion, Newtonian, Scene, Scheme, Viscosity};
use scenes::{CELL, DENSITY, FREE, VISCOSITY, fill, pour, pva_pf, scene, settings, solid};

fn pool() -> Scene {
    let mut s = scene([8, 10, 8], [Boundary::Symmetry; 3]);
    s.boundary[1] = Boundary::Open;
    s.gravity = [0.0, -1e8, 0.0];
    s.bodies = vec![solid("floor", [0.0; 3], [8.0, 2.0, 8.0], Motion::Fixed)];
    pour(&mut s, [0.0, 2.0, 0.0], [8.0, 6.0, 8.0]);
    s
}

#[test]
fn the_plan_gives_the_limits_of_the_papers_materials() {
    let mut s = pool();
    let flip = settings(ShapeFunction::Gimp, VelocityUpdate::Flip, 0.5);
    let plan = Plan::new(&s, &Amount::of(&s.points), &flip);
    println!("{plan:?}");
    // cell/c = 2.9 um / 913 m/s and rho cell^2/(8 eta), by hand.
    assert!((plan.acoustic_s / 3.1768e-9 - 1.0).abs() < 1e-3);
    assert!((plan.viscous_s / 9.7038e-10 - 1.0).abs() < 1e-3);
    assert_eq!(plan.limit, Limit::Viscous);
    assert_eq!(plan.dt_s, 0.5 * plan.viscous_s);
    // PVA-PF: its 210 Pa s would ask for 6 ps, its smallest viscosity of 1 Pa s for 1.26 ns.
    s.liquid.viscosity = pva_pf();
    let plan = Plan::new(&s, &Amount::of(&s.points), &flip);
    assert!((plan.viscous_s / 1.2615e-9 - 1.0).abs() < 1e-3);
    assert!((plan.viscosity_cap / 2.0 - 1.0).abs() < 1e-6);
    // At rest all of it is thicker than that.
    let run = Explicit::new(&s, &flip).unwrap();
    assert!((run.diagnostics().capped_fraction - 1.0).abs() < 1e-12);
}

#[test]
fn steps_beyond_the_stable_limit_are_stopped_with_step_and_point() {
    // Nearly inviscid: the acoustic limit binds.
    let mut s = pool();
    s.liquid.viscosity = Viscosity::Newtonian(Newtonian(1e-3));
    let stable = settings(ShapeFunction::Linear, VelocityUpdate::Flip, 0.3);
    let unstable = Settings { cfl: 1.5, ..stable };
    let end = |settings: &Settings| {
        let mut run = Explicit::new(&s, settings).unwrap();
        (0..600).find_map(|_| run.advance(FREE).err())
    };
    assert_eq!(end(&stable), None);
    let said = end(&unstable).expect("cfl 1.5 is unstable").0;
    println!("{said}");
    assert!(said.contains("step ") && said.contains("liquid point "));
}

#[test]
fn a_point_alone_is_named_and_stable_at_the_step_advised() {
    let drop = |viscosity: f64| {
        let mut s = scene([24, 24, 1], [Boundary::Periodic; 3]);
        s.boundary[2] = Boundary::Symmetry;
        s.liquid.viscosity = Viscosity::Newtonian(Newtonian(viscosity));
        fill(&mut s, [4.13, 4.1, 0.0], [4.63, 4.6, 1.0], |_| {
            [0.91, -0.37, 0.0]
        });
        s
    };
    let gimp = ShapeFunction::Gimp;
    let end = |viscosity: f64, cfl: f64| {
        let settings = settings(gimp, VelocityUpdate::Flip, cfl);
        let mut run = Explicit::new(&drop(viscosity), &settings).unwrap();
        (0..15_000).find_map(|_| run.advance(FREE).err())
    };
    for (viscosity, unstable, stable) in [(scenes::VISCOSITY, 0.5, 0.4), (1e-3, 0.5, 0.25)] {
        let said = end(viscosity, unstable).expect("a failure").0;
        println!("{viscosity} Pa s: {said}");
        assert!(said.contains("a single point"));
        assert!(said.contains("needs 0.4 times the viscous and 0.25 times the acoustic limit"));
        assert_eq!(end(viscosity, stable), None);
    }
}

#[test]
fn bad_settings_and_points_are_refused() {
    let s = pool();
    let refused = |scene: &Scene, shape, update, cfl| {
        let said = Explicit::new(scene, &settings(shape, update, cfl)).err();
        println!("{said:?}");
        said.expect("a refusal")
    };
    let gimp = ShapeFunction::Gimp;
    assert!(refused(&s, gimp, VelocityUpdate::Flip, 0.0).contains("cfl"));
    assert!(refused(&s, gimp, VelocityUpdate::Xpic(0), 0.5).contains("order"));
    assert!(refused(&s, gimp, VelocityUpdate::Xpic(21), 0.5).contains("1 to 20"));
    let most = settings(gimp, VelocityUpdate::Xpic(20), 0.5);
    assert!(Explicit::new(&s, &most).is_ok());
    let linear = ShapeFunction::Linear;
    assert!(refused(&s, linear, VelocityUpdate::Apic, 0.5).contains("apic"));
    let mut sunk = s.clone();
    sunk.points.position[7][1] = 1.5 * CELL;
    let said = refused(&sunk, gimp, VelocityUpdate::Flip, 0.5);
    assert!(said.contains("point 7") && said.contains("floor"));
    sunk.points.position[7][1] = 11.0 * CELL;
    assert!(refused(&sunk, gimp, VelocityUpdate::Flip, 0.5).contains("outside the grid"));
}

/// A drop of 16 points flies out of an open side; three among them that lie on sides stay, in their order.
#[test]
fn points_that_leave_an_open_side_are_counted() {
    let mut s = scene(
        [8, 8, 1],
        [Boundary::Open, Boundary::Open, Boundary::Symmetry],
    );
    fill(&mut s, [4.0, 3.0, 0.0], [6.0, 5.0, 1.0], |_| {
        [150.0, 0.0, 0.0]
    });
    let stay = [(2, [8.0, 7.0]), (9, [0.0, 7.0]), (14, [8.0, 1.0])];
    for (id, [x, y]) in stay {
        s.points
            .position
            .insert(id, [x * CELL, y * CELL, 0.5 * CELL]);
        s.points.velocity.insert(id, [0.0; 3]);
        s.points.volume.insert(id, 0.25 * CELL.powi(3));
    }
    let settings = settings(ShapeFunction::Gimp, VelocityUpdate::Flip, 0.5);
    let mut scheme = Explicit::new(&s, &settings).unwrap();
    let start = scheme.diagnostics();
    let volume = 4.0 * CELL.powi(3);
    let energy = 0.5 * DENSITY * volume * 150.0_f64.powi(2);
    assert!((start.kinetic_energy / energy - 1.0).abs() < 1e-6);
    assert!((start.volume / (1.1875 * volume) - 1.0).abs() < 1e-6);
    assert!((start.max_speed - 150.0).abs() < 1e-4);
    let mut lost = 0;
    for _ in 0..240 {
        lost = scheme.advance(FREE).unwrap().lost;
        assert_eq!(scheme.liquid().position.len() as u64 + lost, 19);
    }
    assert_eq!(lost, 16);
    let left = scheme.liquid().position;
    for (found, (_, [x, y])) in left.iter().zip(stay) {
        let off = (f64::from(found[0]) / CELL - x).hypot(f64::from(found[1]) / CELL - y);
        assert!(off < 1e-3, "{found:?} is {off} cells off {x}, {y}");
    }
}

/// eta (du/dy)^2 V, but for the points next to the surface, whose gradient is half seen.
#[test]
fn a_shear_flow_dissipates_what_its_viscosity_takes() {
    let rate = 1e5;
    let mut s = scene(
        [24, 24, 1],
        [Boundary::Open, Boundary::Open, Boundary::Symmetry],
    );
    fill(&mut s, [4.0, 4.0, 0.0], [20.0, 20.0, 1.0], |x| {
        [rate * (x[1] - 12.0) * CELL, 0.0, 0.0]
    });
    let settings = settings(ShapeFunction::Gimp, VelocityUpdate::Flip, 0.5);
    let mut scheme = Explicit::new(&s, &settings).unwrap();
    scheme.advance(FREE).unwrap();
    let power = scheme.diagnostics().viscous_power;
    let whole = VISCOSITY * rate * rate * 256.0 * CELL.powi(3);
    assert!((power / whole - 1.0).abs() < 0.1, "{}", power / whole);
}
