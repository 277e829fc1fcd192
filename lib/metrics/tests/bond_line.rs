//! Wetted area and state of the bond line of grooved wood.

mod specimens;

use metrics::{BondLine, Datum, Filling, Reference, Sealed, State};
use specimens::{Run, Stack, VOXEL, close};
use units::Axis;

/// Grooves half as wide as their distance, wood up to 30 and from 36; adhesive in `filled` layers.
fn grooved(filled: std::ops::Range<usize>) -> Stack {
    Stack::new([32, 66, 16], move |x, y, _| {
        let wood = x % 8 >= 4 && !(30..36).contains(&y);
        match y {
            _ if wood => 'w',
            y if filled.contains(&y) => 'a',
            _ => ' ',
        }
    })
}

fn line_of(state: &State, begun_m3: f64) -> BondLine {
    let middle = Datum::find(Reference::Mid, state).unwrap();
    metrics::bond_line(state, begun_m3, &Sealed::of(state, &middle)).unwrap()
}

/// The adhesive of `stack` as material points, its upper adherend `gap` (m) away.
fn run_of(stack: &Stack, gap: f64) -> Run {
    let mut run = Run::new(stack, 33, gap);
    let [nx, ny, nz] = stack.adhesive.dims();
    for (z, y, x) in
        (0..nz).flat_map(|z| (0..ny).flat_map(move |y| (0..nx).map(move |x| (z, y, x))))
    {
        if stack.adhesive.get(x, y, z) {
            let mut place = [x, y, z].map(|i| i as f64 + 0.5);
            place[1] += if y >= 33 { gap / VOXEL } else { 0.0 };
            run.add(place);
        }
    }
    run
}

/// Faces of 16 columns of wood in 16 rows on the bond surface, and of 7 walls of grooves that are `deep`.
fn faces(deep: usize) -> f64 {
    (16 * 16 + 7 * deep * 16) as f64 * VOXEL.powi(2)
}

fn wets(line: &BondLine, bottom: usize, top: usize) {
    let (bottom, top) = (faces(bottom), faces(top));
    for (found, wanted) in line.wetted_m2.into_iter().zip([bottom, top, bottom + top]) {
        assert!(close(found, wanted, 1e-9), "{found} {wanted}");
    }
}

#[test]
fn wood_is_wetted_on_its_surface_and_in_its_grooves() {
    let stack = grooved(24..41);
    let line = line_of(&stack.state(Axis::Y), 0.0);
    wets(&line, 6, 5);
    assert!(close(line.surfaces_m, 6.0 * VOXEL, 1e-9), "{line:?}");
    assert!(close(line.filled, 1.0, 1e-9), "{line:?}");
    assert_eq!(line.filling, Filling::Filled);
    for gap in [0.0, 2.0 * VOXEL] {
        let run = run_of(&stack, gap);
        let line = line_of(&run.state(), 0.0);
        wets(&line, 6, 5);
        assert!(close(line.surfaces_m, 6.0 * VOXEL + gap, 1e-9));
    }
}

#[test]
fn a_bond_line_is_starved_or_squeezed_out_by_what_is_left() {
    // Of the ten layers that count, those below the middle.
    for (filled, share, filling) in [
        (20..34, 0.6, Filling::Filled),
        (20..32, 0.4, Filling::Starved),
        (10..20, 0.0, Filling::Starved),
    ] {
        let run = run_of(&grooved(filled), 0.0);
        let line = line_of(&run.state(), 0.0);
        assert!((line.filled - share).abs() < 1e-5, "{}", line.filled);
        assert_eq!(line.filling, filling);
    }
    let run = run_of(&grooved(24..41), 0.0);
    let begun: f64 = run.volume.iter().map(|&v| f64::from(v)).sum();
    let state = run.state();
    let kept = line_of(&state, begun / 0.96);
    let lost = line_of(&state, begun / 0.94);
    assert_eq!(
        (kept.filling, lost.filling),
        (Filling::Filled, Filling::SqueezedOut)
    );
}
