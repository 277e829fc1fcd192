//! Agreement against closed forms: in every column of state and experiment, adhesive fills a known number of layers on each
//! side of the bond plane.

mod specimens;

use metrics::{Agreement, State, compare};
use specimens::{Run, Stack, VOXEL, close};
use units::Axis;

const DIMS: [usize; 3] = [12, 40, 10];
const PLANE: usize = 20;
/// Layers of adhesive between the bond surfaces and the plane, in every column.
const FILM: usize = 2;

/// Layers of adhesive below and above the plane in column (x, z).
type Depths = fn(usize, usize) -> [usize; 2];

/// Every second column along x is a groove in which the adhesive goes deeper.
fn theirs(x: usize, z: usize) -> [usize; 2] {
    match x % 2 {
        0 => [FILM + 1 + (x + 2 * z) % 7, FILM + (3 * x + z) % 5],
        _ => [FILM; 2],
    }
}

fn ours(x: usize, z: usize) -> [usize; 2] {
    match x % 2 {
        0 => [FILM + (x + z) % 6, FILM + 1 + (x + 3 * z) % 4],
        _ => [FILM; 2],
    }
}

/// The material at a voxel, with adhesive to `depths`. Wood begins beyond the film, in grooves ten layers later.
fn letter(depths: Depths, x: usize, y: usize, z: usize) -> char {
    let below = y < PLANE;
    let layer = if below { PLANE - 1 - y } else { y - PLANE };
    let groove = if x.is_multiple_of(2) { 10 } else { 0 };
    match layer {
        _ if layer < depths(x, z)[usize::from(!below)] => 'a',
        _ if layer < FILM + groove => ' ',
        _ => 'w',
    }
}

fn stack(depths: Depths) -> Stack {
    Stack::new(DIMS, move |x, y, z| letter(depths, x, y, z))
}

/// A run in which the voxels of `depths` are points; the top side `gap` voxels away.
fn run(depths: Depths, [nx, nz]: [usize; 2], gap: f64) -> Run {
    let narrow = Stack::new([nx, DIMS[1], nz], move |x, y, z| letter(depths, x, y, z));
    Run::of(&narrow, PLANE, gap * VOXEL)
}

/// Layers on a side of the table: bottom, top or both.
fn sides(depths: [usize; 2]) -> [Vec<usize>; 3] {
    let [b, t] = depths;
    [vec![b], vec![t], vec![b, t]]
}

/// WP in voxels of columns of `t` layers from the plane, the film of a gap of `gap` voxels
/// between them left empty: the mean square of the centres' distances.
fn wp(layers: &[usize], gap: f64) -> Option<f64> {
    let of = |&t: &usize| (0..t).map(move |i| (i as f64 + 0.5 + 0.5 * gap).powi(2));
    let squares: Vec<f64> = layers.iter().flat_map(of).collect();
    let mean = squares.iter().sum::<f64>() / squares.len() as f64;
    (!squares.is_empty()).then(|| mean.sqrt())
}

fn pearson(pairs: &[(f64, f64)]) -> f64 {
    let n = pairs.len() as f64;
    let sum = |f: fn(&(f64, f64)) -> f64| pairs.iter().map(f).sum::<f64>();
    let (a, b) = (sum(|p| p.0), sum(|p| p.1));
    let covariance = n * sum(|p| p.0 * p.1) - a * b;
    let variances = (n * sum(|p| p.0 * p.0) - a * a) * (n * sum(|p| p.1 * p.1) - b * b);
    covariance / variances.sqrt()
}

/// Dice and correlation of each side, by counting columns.
fn expected(a: Depths, b: Depths, [nx, nz]: [usize; 2], gap: f64) -> [[f64; 2]; 3] {
    let columns = || (0..nz).flat_map(move |z| (0..nx).map(move |x| (x, z)));
    [0, 1, 2].map(|side| {
        let (mut common, mut sizes) = (0, 0);
        let mut pairs = Vec::new();
        for (x, z) in columns() {
            let (a, b) = (&sides(a(x, z))[side], &sides(b(x, z))[side]);
            common += a.iter().zip(b).map(|(a, b)| a.min(b)).sum::<usize>();
            sizes += a.iter().chain(b).sum::<usize>();
            pairs.extend(wp(a, gap).zip(wp(b, 0.0)));
        }
        [2.0 * common as f64 / sizes as f64, pearson(&pairs)]
    })
}

#[track_caller]
fn assert_agrees(found: &[Agreement; 3], expected: [[f64; 2]; 3], dice_off: f64) {
    for (found, [dice, correlation]) in found.iter().zip(expected) {
        assert!(close(found.dice, dice, dice_off), "{found:?}, dice {dice}");
        // Single-precision places.
        let off = (found.map_correlation - correlation).abs();
        assert!(off < 1e-5, "{found:?}, correlation {correlation}");
    }
}

const WHOLE: [usize; 2] = [DIMS[0], DIMS[2]];

fn against_theirs(state: &State) -> [Agreement; 3] {
    compare(state, &stack(theirs).state(Axis::Y)).unwrap()
}

#[test]
fn dice_and_correlation_are_those_of_the_counted_columns() {
    let wanted = expected(ours, theirs, WHOLE, 0.0);
    // The sides differ, so that a mix-up would be noticed.
    assert!(wanted[0][0] < 0.9 && (wanted[0][0] - wanted[1][0]).abs() > 0.01);
    assert_agrees(
        &against_theirs(&run(ours, WHOLE, 0.0).state()),
        wanted,
        1e-12,
    );
    assert_agrees(&against_theirs(&stack(ours).state(Axis::Y)), wanted, 1e-12);
    // Some columns of the state are empty below.
    let with_holes: Depths = |x, z| [if x == 4 { 0 } else { ours(x, z)[0] }, ours(x, z)[1]];
    let wanted = expected(with_holes, theirs, WHOLE, 0.0);
    assert_agrees(
        &against_theirs(&run(with_holes, WHOLE, 0.0).state()),
        wanted,
        1e-12,
    );
    let itself = against_theirs(&stack(theirs).state(Axis::Y));
    assert_agrees(&itself, [[1.0; 2]; 3], 0.0);
}

#[test]
fn a_parted_trimmed_bond_is_compared_in_the_frames_of_its_adherends() {
    // Single-precision positions between voxels move parts of a voxel to the next one.
    for (gap, off) in [(4.0, 1e-12), (3.37, 1e-4)] {
        let wanted = expected(ours, theirs, [9, 7], gap);
        assert_agrees(
            &against_theirs(&run(ours, [9, 7], gap).state()),
            wanted,
            off,
        );
    }
    let mut parted = run(ours, [9, 7], 4.0);
    let bare = against_theirs(&parted.state());
    // A film in the gap has no voxels in the experiment and does not count to the overlap.
    for y in PLANE..PLANE + 4 {
        parted.add([3.5, y as f64 + 0.5, 2.5]);
    }
    for (filmed, bare) in against_theirs(&parted.state()).iter().zip(&bare) {
        assert_eq!(filmed.dice, bare.dice);
        assert!(filmed.map_correlation != bare.map_correlation);
    }
}

#[test]
fn a_constant_map_correlates_with_nothing() {
    let flat: Depths = |_, _| [FILM; 2];
    let [level, experiment] = [flat, theirs].map(stack);
    for (a, b) in [(&level, &experiment), (&experiment, &level)] {
        let found = compare(&a.state(Axis::Y), &b.state(Axis::Y)).unwrap();
        let unknown = |a: &Agreement| a.map_correlation.is_nan() && (0.0..1.0).contains(&a.dice);
        assert!(found.iter().all(unknown), "{found:?}");
    }
    // Rounding of places is not variation; a hundredth of a voxel is.
    for (unevenness, constant) in [(1e-5, true), (1e-2, false)] {
        let mut uneven = run(flat, WHOLE, 0.0);
        for (i, place) in uneven.position.iter_mut().enumerate() {
            place[1] -= (unevenness * VOXEL * theirs(i % 12, i / 480)[0] as f64) as f32;
        }
        let found = against_theirs(&uneven.state());
        assert_eq!(found[0].map_correlation.is_nan(), constant, "{found:?}");
    }
}

#[test]
fn a_side_without_adhesive_has_no_overlap_or_correlation() {
    // No adhesive above the plane; the surfaces are still found in the experiment's wood.
    let mut bare = run(|x, z| [ours(x, z)[0], 0], WHOLE, 0.0);
    assert_eq!(against_theirs(&bare.state())[1].dice, 0.0);
    bare.position.clear();
    bare.volume.clear();
    for found in against_theirs(&bare.state()) {
        assert!(found.dice == 0.0 && found.map_correlation.is_nan());
    }
}

#[test]
fn other_voxels_places_and_widths_are_refused() {
    let (experiment, bond) = (stack(theirs), run(ours, WHOLE, 0.0));
    let measured = experiment.state(Axis::Y);
    let said = |change: fn(&mut State)| {
        let mut state = bond.state();
        change(&mut state);
        compare(&state, &measured).map_err(|e| e.to_string())
    };
    for near in [
        (|_| {}) as fn(&mut State),
        |s| s.voxel_m *= 1.0 + 1e-8,
        |s| s.box_min_m[0] += 1e-4 * VOXEL,
    ] {
        said(near).unwrap();
    }
    for other in [
        (|s| s.voxel_m *= 1.0 + 1e-4) as fn(&mut State),
        |s| s.box_min_m[0] += 0.4 * VOXEL,
        |s| s.box_min_m[2] -= 0.4 * VOXEL,
        |s| s.box_max_m[2] += VOXEL,
    ] {
        said(other).unwrap_err();
    }
    let fault = said(|s| s.normal = Axis::X).unwrap_err();
    let measure = "40 layers along y of [12, 10] voxels of 1.4500 um";
    assert!(fault.contains(measure), "{fault}");
    let cropped = Stack::new([12, 30, 10], |x, y, z| letter(theirs, x, y, z));
    let fault = compare(&cropped.state(Axis::Y), &measured).unwrap_err();
    let usage = fault.is_usage();
    assert!(usage && fault.to_string().contains("30 layers"), "{fault}");
    let fault = compare(&measured, &bond.state()).unwrap_err().to_string();
    assert!(fault.contains("not a specimen"), "{fault}");
}
