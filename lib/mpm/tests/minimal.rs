//! The minimal twin of the explicit scheme gives the same drop to the last bit.

mod scenes;

use mpm::{Explicit, Minimal, ShapeFunction, VelocityUpdate};
use physics::{Boundary, LiquidState, Scene, Scheme, Viscosity};
use scenes::{FREE, fill, press, scene, settings};

/// A drop that spins, stretches and flies through several tiles; a thin one whose points lie off the
/// nodes, torn apart; and two that meet.
fn drops() -> [Scene; 3] {
    let spin = |x: [f64; 3]| {
        let (x, y) = (x[0] - 10.0, x[1] - 9.0);
        [60.0 - 2.0 * y + x, 50.0 + 2.0 * x, 40.0 + 0.5 * y]
    };
    let mut spinning = scene([30, 28, 24], [Boundary::Open; 3]);
    fill(&mut spinning, [5.0, 5.0, 5.0], [13.0, 13.0, 10.0], spin);
    let mut thin = scene([28; 3], [Boundary::Open; 3]);
    thin.liquid.viscosity = Viscosity::Newtonian(physics::Newtonian(0.01));
    fill(&mut thin, [10.1, 10.3, 10.7], [15.1, 15.3, 15.7], |x| {
        [x[1], -x[2], 5.0 * (12.0 - x[0])]
    });
    let mut meeting = scene([28; 3], [Boundary::Open; 3]);
    fill(&mut meeting, [7.0; 3], [12.0; 3], |_| [40.0; 3]);
    fill(&mut meeting, [13.0; 3], [18.0, 18.0, 17.0], |_| {
        [-13.0, 0.0, -1.0]
    });
    [spinning, thin, meeting]
}

fn bits(state: &LiquidState) -> Vec<u32> {
    let vectors = state.position.iter().chain(&state.velocity).flatten();
    let all = vectors.chain(&state.volume).chain(&state.pressure);
    all.map(|x| x.to_bits()).collect()
}

#[test]
fn the_minimal_twin_is_the_scheme_to_the_last_bit() {
    for (i, drop) in drops().iter().enumerate() {
        for threads in [1, 2, 3] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
            pool.build().unwrap().install(|| {
                let settings = settings(ShapeFunction::Gimp, VelocityUpdate::Flip, 0.5);
                let mut full = Explicit::new(drop, &settings).unwrap();
                let mut twin = Minimal::new(drop, 0.5).unwrap();
                let start = bits(&full.liquid());
                for step in 0..400 {
                    let dt = full.advance(FREE).unwrap().dt_s;
                    assert_eq!(dt, twin.step(f64::INFINITY).unwrap(), "step {step}");
                    if step % 50 == 0 {
                        let same = bits(&full.liquid()) == bits(&twin.liquid());
                        assert!(same, "drop {i}, {threads} threads, step {step}");
                    }
                }
                assert_ne!(start, bits(&full.liquid()));
            });
        }
    }
}

#[test]
fn the_minimal_twin_refuses_what_it_leaves_out() {
    assert!(Minimal::new(&press(), 0.5).is_err());
    let mut drop = scene([16; 3], [Boundary::Open; 3]);
    fill(&mut drop, [6.0; 3], [8.0; 3], |_| [-100.0, 0.0, 0.0]);
    let mut twin = Minimal::new(&drop, 0.5).unwrap();
    let said = (0..10_000).find_map(|_| twin.step(f64::INFINITY).err());
    assert!(said.unwrap().0.contains("side of the domain"));
}
