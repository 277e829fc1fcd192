//! Fitted planes of bonds: fits, levelling, and planes that are refused or doubted.

mod specimens;

use bondline::Specimen;
use metrics::{Datum, Penetration, Reference, Side, State, penetration};
use specimens::{Stack, VOXEL, close, placed};
use units::Axis;

const SLOPE: [f64; 2] = [0.125, -0.09375];
/// Thickness of a gap of 8 voxels at these slopes: 8 / sqrt(1 + 0.125^2 + 0.09375^2) voxels.
const THICKNESS: f64 = 7.904096270008;

fn total(state: &State, reference: Reference) -> Penetration {
    penetration(state, &Datum::find(reference, state).unwrap())[2]
}

fn tilt_of(state: &State) -> [f64; 3] {
    let fit = Datum::find(Reference::Fit, state).unwrap();
    fit.tilt().unwrap().deg
}

/// A gap of 8 voxels that rises 12 voxels over 96 along x and falls 6 over 64 along z at these slopes, in wood
/// with lumens; adhesive fills the gap only.
fn tilted() -> Stack {
    let middle = |x: usize, z: usize| {
        60.0 + SLOPE[0] * (x as f64 + 0.5 - 48.0) + SLOPE[1] * (z as f64 + 0.5 - 32.0)
    };
    Stack::new([96, 120, 64], move |x, y, z| {
        let height = y as f64 + 0.5 - middle(x, z);
        let lumen = (x % 16) < 6 && (y % 14) < 9;
        match height.abs() {
            h if h < 4.0 => 'a',
            _ if lumen => ' ',
            _ => 'w',
        }
    })
}

#[test]
fn a_tilted_bond_line_is_found_by_the_fit() {
    let stack = tilted();
    let state = stack.state(Axis::Y);
    let found = total(&state, Reference::Fit);
    let tilt = tilt_of(&state);
    // A rise along x is a turn about z, a fall along z one about x.
    for (tilt, exact) in tilt.into_iter().zip([-SLOPE[1], 0.0, SLOPE[0]]) {
        assert!((tilt - exact.atan().to_degrees()).abs() < 0.1, "{tilt}");
    }
    // The same volume over the larger area of the plane.
    let exact = THICKNESS / 12_f64.sqrt() * VOXEL;
    let level = total(&state, Reference::Mid).wp_m;
    let [fit_um, exact_um, level_um] = [found.wp_m, exact, level].map(|wp| 1e6 * wp);
    println!("WP um: fit {fit_um:.4}, exact {exact_um:.4}, level {level_um:.4}");
    assert!(close(found.wp_m, exact, 0.02));
    assert!(close(found.plane_m, 60.0 * VOXEL, 0.005));
    assert!(close(found.ep_m, THICKNESS * VOXEL, 0.005));
    assert!(close(found.slab_wp_m, exact, 0.005));
    // A level reference takes the tilt for penetration.
    assert!(level > 1.5 * exact);
}

/// Earlywood: walls two voxels thick around lumens of ten, so that wood meets wood across the bond in a tenth of the area.
#[test]
fn a_tilt_is_found_between_thin_walls() {
    for slope in [0.0, 0.0875, -0.0875] {
        let middle = move |x: usize| 50.0 + slope * (x as f64 + 0.5 - 36.0);
        let stack = Stack::new([72, 100, 24], move |x, y, z| {
            let height = y as f64 + 0.5 - middle(x);
            // Wood cells stand on the bond and are offset on the two sides.
            let across = if height > 0.0 { x + 5 } else { x };
            let along = (height.abs() + 7.0) as usize;
            let lumen = across % 12 >= 2 && along % 24 >= 2 && z % 12 >= 1;
            match height.abs() {
                h if h < 3.0 => 'a',
                _ if lumen => ' ',
                _ => 'w',
            }
        });
        let tilt = tilt_of(&stack.state(Axis::Y))[2];
        let exact = f64::atan(slope).to_degrees();
        println!("tilt between thin walls: {tilt:.2} of {exact:.2} degrees");
        assert!((tilt - exact).abs() < 0.3, "{tilt} {exact}");
    }
}

fn boxed(letter: fn([usize; 3]) -> char) -> Stack {
    Stack::new([12, 60, 12], move |x, y, z| letter([x, y, z]))
}

/// The reason why a stack is not levelled.
fn not_levelled(stack: &Stack) -> String {
    let specimen = Specimen::new(placed(&stack.wood), placed(&stack.adhesive)).unwrap();
    metrics::level(&specimen, Axis::Y).err().unwrap()
}

/// The doubt about a plane that is fitted but not levelled.
fn doubted(stack: &Stack) -> String {
    let state = stack.state(Axis::Y);
    let datum = Datum::find(Reference::Fit, &state).unwrap();
    assert!(penetration(&state, &datum)[2].wp_m > 0.0);
    let doubt = datum.fit_doubt().unwrap();
    assert_eq!(doubt, not_levelled(stack));
    assert!(doubt.contains(&datum.tilt().unwrap().to_string()));
    doubt
}

/// Surfaces that show in a part of the area, or that bend, do not determine a tilt.
#[test]
fn a_plane_that_is_not_known_is_refused() {
    // Wood above four columns of one quarter alone.
    let narrow = boxed(|[x, y, z]| match y {
        28..32 => 'a',
        32.. if x > 3 || z > 0 => ' ',
        _ => 'w',
    });
    let error = Datum::find(Reference::Fit, &narrow.state(Axis::Y)).unwrap_err();
    assert!(error.is_usage());
    let refused = not_levelled(&narrow);
    assert!(refused.contains("only 4 columns"), "{refused}");
    assert!(error.to_string().contains(&refused), "{error}");
    // A step of the gap's height in one quarter.
    let bent = doubted(&boxed(|[x, y, z]| {
        match y + 6 * usize::from(x < 6 && z < 6) {
            30..36 => 'a',
            _ => 'w',
        }
    }));
    assert!(bent.contains("more than half of the 8.7 um"), "{bent}");
    // No wood above one quarter.
    let bare = doubted(&boxed(|[x, y, z]| match y {
        28..32 => 'a',
        32.. if x < 6 && z < 6 => ' ',
        _ => 'w',
    }));
    assert!(bare.contains("a quarter of the bond area"), "{bare}");
    // Walls of one voxel; without this doubt, fits to rough ones twelve voxels apart were up to 5 degrees off.
    let thin = doubted(&boxed(|[x, y, _]| match y {
        28..32 => 'a',
        _ if x % 6 == 0 => 'w',
        _ => ' ',
    }));
    assert!(thin.contains("2.4 % of the bond area"), "{thin}");
}

/// A step between the narrowest columns, along which a plane would cut into the wood beside them. The level plane is kept; its
/// distance from the fits is no error of it.
#[test]
fn a_level_plane_that_is_kept_is_no_fit() {
    let stack = boxed(|[x, y, _]| match (x, y) {
        (4 | 5, 30 | 31) | (6 | 7, 28 | 29) => 'w',
        (_, 28..32) => 'a',
        _ => 'w',
    });
    let said = doubted(&stack);
    assert!(said.contains("the level plane is kept"), "{said}");
    let datum = Datum::find(Reference::Fit, &stack.state(Axis::Y)).unwrap();
    let tilt = datum.tilt().unwrap();
    assert_eq!(tilt.deg, [0.0; 3]);
    assert!(tilt.error_deg.iter().all(|e| *e < 5.0), "{tilt}");
}

/// A levelled specimen has no tilt, and the thickness and depths of the fit, for any bond normal.
#[test]
fn a_tilted_specimen_is_turned_level() {
    let exact = tilted();
    for normal in Axis::ALL {
        // y of the specimen along the normal, the order of the axes kept.
        let turn = (4 - normal.index()) % 3;
        let old = [96, 120, 64];
        let dims = std::array::from_fn(|i| old[(i + turn) % 3]);
        let stack = Stack::new(dims, |x, y, z| {
            let index: [usize; 3] = std::array::from_fn(|i| [x, y, z][(i + 3 - turn) % 3]);
            match index {
                [x, y, z] if exact.wood.get(x, y, z) => 'w',
                [x, y, z] if exact.adhesive.get(x, y, z) => 'a',
                _ => ' ',
            }
        });
        let specimen = Specimen::new(placed(&stack.wood), placed(&stack.adhesive)).unwrap();
        let level = metrics::level(&specimen, normal).unwrap();
        let turned = Stack {
            wood: level.wood,
            adhesive: level.adhesive,
        };
        let state = turned.state(normal);
        let tilt = tilt_of(&state);
        assert!(tilt.iter().all(|t| t.abs() < 0.2), "{normal}: {tilt:?}");
        let found = total(&state, Reference::Mid);
        assert!(close(found.ep_m, THICKNESS * VOXEL, 0.01), "{normal}");
        // Rounding of voxel centres makes the faces of the slab rough.
        assert!(close(found.wp_m, THICKNESS / 12_f64.sqrt() * VOXEL, 0.03));
        let again = Specimen::new(placed(&turned.wood), placed(&turned.adhesive)).unwrap();
        let dims = metrics::level(&again, normal).unwrap().wood.dims();
        assert!(dims.iter().zip(turned.wood.dims()).all(|(a, b)| a + 1 >= b));
    }
}

/// A gap of six voxels that begins at layer `low` in half of the columns, one layer higher in the others.
fn stepped(low: usize, layers: usize) -> Stack {
    Stack::new([24, layers, 24], move |x, y, z| {
        let bottom = low + (x + z) % 2;
        match y {
            y if (bottom..bottom + 6).contains(&y) => 'a',
            _ if x % 4 == 3 => ' ',
            _ => 'w',
        }
    })
}

/// Gaps of equal width count alike, whatever the rounding of their widths.
#[test]
fn a_fitted_plane_is_the_same_for_a_gap_at_any_height() {
    for low in 15..40 {
        let stack = stepped(low, 60);
        let datum = Datum::find(Reference::Fit, &stack.state(Axis::Y)).unwrap();
        let layer = datum.plane_m(Side::Total) / VOXEL;
        assert!((layer - (low as f64 + 3.5)).abs() < 1e-6, "{low}: {layer}");
    }
}

/// Adherends of columns of wood on both sides of layers 20 to 29 along x.
fn across_x() -> Stack {
    Stack::new([50, 24, 24], |x, y, z| match (x, (y + z) % 3) {
        (20..30, _) => 'a',
        (18..32, 0) => 'a',
        (_, 0) => ' ',
        _ => 'w',
    })
}

#[test]
fn a_bond_across_another_axis_is_refused_but_for_a_plane_by_hand() {
    let stack = across_x();
    for normal in [Axis::Y, Axis::Z] {
        let state = stack.state(normal);
        for reference in [Reference::Mid, Reference::Adherend, Reference::Fit] {
            let error = Datum::find(reference, &state).unwrap_err();
            let said = error.to_string();
            assert!(error.is_usage() && said.contains("--normal x"), "{said}");
        }
        assert!(Datum::find(Reference::Plane(12.0 * VOXEL), &state).is_ok());
    }
    assert!(Datum::find(Reference::Mid, &stack.state(Axis::X)).is_ok());
}

#[test]
fn a_plane_through_wood_is_doubted() {
    let stack = across_x();
    let doubt = |reference, normal| {
        let state = stack.state(normal);
        Datum::find(reference, &state)
            .unwrap()
            .severed_doubt(&state)
    };
    assert_eq!(doubt(Reference::Mid, Axis::X), None);
    let plane = |layers: f64| Reference::Plane(layers * VOXEL);
    assert!(doubt(plane(10.0), Axis::X).unwrap().contains("66.7 %"));
    // Wood of three quarters of the length, on a third of it.
    assert!(doubt(plane(12.0), Axis::Y).unwrap().contains("26.7 %"));
    assert_eq!(doubt(plane(0.0), Axis::X), None);
}
