//! Specimens without a bond, or with one across another axis, are refused or warned of.

mod specimens;

use metrics::{Datum, Reference};
use specimens::{Stack, VOXEL};
use units::Axis;

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
        Datum::find(reference, &state).unwrap().doubt(&state)
    };
    assert_eq!(doubt(Reference::Mid, Axis::X), None);
    let plane = |layers: f64| Reference::Plane(layers * VOXEL);
    assert!(doubt(plane(10.0), Axis::X).unwrap().contains("66.7 %"));
    // Wood of three quarters of the length, on a third of it.
    assert!(doubt(plane(12.0), Axis::Y).unwrap().contains("26.7 %"));
    assert_eq!(doubt(plane(0.0), Axis::X), None);
}
