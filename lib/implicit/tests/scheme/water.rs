//! Loss of water to the walls of a slit and of a film: water is conserved.

use implicit::Implicit;
use physics::{Motion, Scene, Scheme, VoxelBlock, Water, WaterLaw};

use crate::plain;
use crate::runs::{H, advance, block, clamp, forged, plainly, press, until};

/// Cells across the slit.
const CELLS: usize = 6;

/// A column three widths long above a lumen of two whose walls take water; a clamp presses on it.
fn scene(law: impl Fn(&mut WaterLaw)) -> Scene {
    let cell = H / CELLS as f64;
    let (low, high) = (2.0 * cell, 2.0 * cell + H);
    let (mouth, piston) = (2.0 * H, 5.0 * H);
    let top = piston + 3.0 * cell;
    let mut scene = plain::scene(cell, [CELLS + 4, 5 * CELLS + 3, 1]);
    let bars = |from: f64, to: f64| {
        [[0.0, low], [high, high + 2.0 * cell]]
            .map(|[a, b]| VoxelBlock::solid_box([a, from, 0.0], [b, to, cell]))
            .to_vec()
    };
    let plunger = VoxelBlock::solid_box([low, piston, 0.0], [high, top + 3.0 * H, cell]);
    scene.bodies = vec![
        plain::body("lumen", bars(0.0, mouth), Motion::Fixed),
        plain::body("press", bars(mouth, top), Motion::Fixed),
        plain::body("piston", vec![plunger], Motion::Clamped),
    ];
    let half = 0.5 * cell;
    let points = [2 * CELLS, 6 * CELLS, 2];
    scene.points = plain::fill([low, mouth, 0.0], [half; 3], points);
    scene.clamp = clamp(0.02, 1e5 * H / scene.grid.max_m()[0]);
    (scene.bottom, scene.top) = (Some(1), Some(2));
    let water = losing(&scene, 1e-3, |water| {
        water.walls = vec!["lumen".into()];
        law(water);
    });
    scene.liquid.water = Some(water);
    scene
}

/// Water of a liquid of 45 % of solids of which all walls take, with what a test has otherwise.
pub fn losing(scene: &Scene, uptake: f64, other: impl Fn(&mut WaterLaw)) -> Water {
    let mut law = WaterLaw {
        uptake,
        solids: 0.45,
        capacity: None,
        limit: Some(0.6),
        diffusivity: 1e-7,
        factor: vec![(0.45, 1.0), (0.7, 1e4)],
        walls: Vec::new(),
    };
    other(&mut law);
    Water::new(law, scene.liquid.density).unwrap()
}

fn begun(law: impl Fn(&mut WaterLaw)) -> Implicit {
    plainly(&scene(law))
}

fn step(scheme: &mut Implicit) -> f64 {
    advance(scheme, 10e-3).dt_s
}

#[test]
fn a_slit_that_dries_keeps_its_water() {
    let mut scheme = begun(|_| ());
    let start = scheme.diagnostics().volume;
    let (mut solids, mut time, mut steps) = (0.45, 0.0, 0);
    while time < 30e-3 {
        time += step(&mut scheme);
        steps += 1;
        let found = scheme.diagnostics();
        let water = found.water.unwrap();
        assert!(water.missing.abs() < 1e-12, "{}", water.missing);
        assert!(water.solids > solids - 1e-12, "{} {solids}", water.solids);
        solids = water.solids;
        // The water that the liquid loses is in the walls.
        let apart = (water.given_off_m3 - water.in_walls_m3).abs() / start;
        assert!(apart < 1e-12, "{apart}");
        let change = (found.volume + water.given_off_m3) / start - 1.0;
        assert!(change.abs() < 1e-3, "{change}");
    }
    println!("solids content {solids:.3} after {steps} steps");
    assert!(solids > 0.48 && steps < 200, "{solids} {steps}");
    let wettest = scheme.liquid().solids.into_iter().fold(0.0, f32::max);
    assert!(wettest < 0.6 + 1e-4, "beyond the limit: {wettest}");
}

/// The walls of `press`, which no liquid leaves, take more when they are named too.
#[test]
fn only_the_walls_named_take_water() {
    let taken = |names: &'static [&str]| {
        let mut scheme = begun(|law| law.walls = names.iter().map(|n| (*n).into()).collect());
        step(&mut scheme);
        scheme.diagnostics().water.unwrap().in_walls_m3
    };
    let (lumen, all) = (taken(&["lumen"]), taken(&[]));
    assert_eq!(all, taken(&["lumen", "press", "piston"]));
    assert!(all > 2.0 * lumen, "{all} {lumen}");
}

#[test]
fn a_checkpoint_holds_the_water_of_the_start() {
    let mut scheme = begun(|_| ());
    (0..4).for_each(|_| _ = step(&mut scheme));
    let refused = |name: &str, factor: f64| {
        let forged = forged(&scheme, name, |values| {
            values.iter_mut().for_each(|value| *value *= factor);
        });
        begun(|_| ()).restore(&forged).unwrap_err()
    };
    for (name, factor) in [
        ("water", 1.01),
        ("water", f64::NAN),
        ("water_in_walls", -1.0),
        ("water_account", 1.01),
    ] {
        let said = refused(name, factor);
        assert!(said.contains("water"), "{name} {factor}: {said}");
    }
}

/// Walls on all sides take water that reaches them at once: the whole column dries alike.
#[test]
fn an_adhesive_that_is_dry_has_set() {
    let mut scene = scene(|law| {
        law.walls.clear();
        (law.diffusivity, law.limit) = (1e-3, None);
        law.factor = vec![(0.45, 1.0), (0.55, 2e6)];
    });
    // A liquid as viscous as this one is at the end would be compressed beyond its law.
    scene.liquid.tait.bulk_modulus = 1e11;
    let mut scheme = plainly(&scene);
    let (mut steps, mut factor) = (0, 1.0);
    while !scheme.has_set() {
        step(&mut scheme);
        let solids = scheme.diagnostics().water.unwrap().solids;
        factor = 2e6_f64.powf((solids - 0.45) / 0.1);
        steps += 1;
        assert!(steps < 200, "{solids}");
    }
    println!("set after {steps} steps at {factor:.2e} times the viscosity");
    assert!((factor / 1e6 - 1.0).abs() < 0.3, "{factor}");
}

/// A film between two plates and mirrors, from which nothing else can go: under any load its gap closes at
/// twice the uptake, to what is left at the limit, or to where the walls are full.
#[test]
fn a_film_between_mirrors_closes_as_its_water_goes() {
    const UPTAKE: f64 = 1e-4;
    let full = Some(0.5e-6);
    for (offset, capacity) in [(0.0, None), (0.5, None), (0.5, full)] {
        let cell = 2.9e-6;
        let (low, gap) = ((1.0 + offset) * cell, 4.0 * cell);
        let mut scene = plain::scene(cell, [8, 8, 1]);
        let first = 1.0 + offset;
        let plates = [[0.0, first], [first + 4.0, 12.0]];
        let plates = plates.map(|[from, to]| vec![block(cell, [0.0, from], [8.0, to])]);
        press(&mut scene, ["below", "above"], plates, Motion::Clamped);
        scene.points = plain::fill([0.0, low, 0.0], [0.5 * cell; 3], [16, 8, 2]);
        scene.clamp = clamp(1e-3, 1e5);
        let water = losing(&scene, UPTAKE, |law| {
            (law.capacity, law.diffusivity) = (capacity, 1e-6);
            law.factor = vec![(0.45, 1.0), (0.7, 100.0)];
        });
        let last = gap * (1.0 - (1.0 + water.least()) / (1.0 + water.start()));
        let last = capacity.map_or(last, |capacity| last.min(2.0 * capacity));
        scene.liquid.water = Some(water);
        let (mut worst, mut travel) = (0.0_f64, 0.0);
        until(&mut plainly(&scene), 40e-3, |report, time| {
            travel = report.travel_m;
            let exact = (2.0 * UPTAKE * time).min(last);
            worst = worst.max((travel - exact).abs() / last);
        });
        println!(
            "offset {offset}: off by {worst:.1e} at most, {:+.1e} at the end",
            travel / last - 1.0
        );
        assert!(worst < 0.05, "{offset}: {worst}");
        assert!(
            (travel / last - 1.0).abs() < 2e-3,
            "{offset}: {travel} {last}"
        );
    }
}
