//! Depth profiles, wetted area and state of the bond line against closed forms.

mod specimens;

use metrics::{BondLine, Datum, DepthLayer, Filling, Reference, Sealed, State, depth_profile};
use specimens::{Run, Stack, VOXEL, close, slab};
use units::Axis;

/// Wood below 30 and from 36 on with grooves over half of its width; adhesive in the layers `filled`.
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

fn profile(state: &State, reference: Reference) -> Vec<DepthLayer> {
    let datum = Datum::find(reference, state).unwrap();
    depth_profile(state, &datum, &Sealed::of(state, &datum)).unwrap()
}

fn line_of(state: &State, left: f64) -> BondLine {
    let middle = Datum::find(Reference::Mid, state).unwrap();
    metrics::bond_line(state, left, &Sealed::of(state, &middle)).unwrap()
}

/// Wetted faces with grooves filled to `deep` layers.
fn wets(line: &BondLine, bottom: usize, top: usize) {
    // 16 columns of wood in 16 rows on the bond surface, and 7 walls of grooves `deep` layers deep.
    let faces = |deep: usize| (16 * 16 + 7 * deep * 16) as f64 * VOXEL.powi(2);
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
        let run = Run::of(&stack, 33, gap);
        let line = line_of(&run.state(), 0.0);
        wets(&line, 6, 5);
        assert!(close(line.surfaces_m, 6.0 * VOXEL + gap, 1e-9));
    }
}

#[test]
fn a_bond_line_is_starved_or_squeezed_out_by_what_left() {
    // Of the ten layers that count, those below the middle.
    for (filled, share, filling) in [
        (20..34, 0.6, Filling::Filled),
        (20..32, 0.4, Filling::Starved),
        (10..20, 0.0, Filling::Starved),
    ] {
        let run = Run::of(&grooved(filled), 33, 0.0);
        let line = line_of(&run.state(), 0.0);
        assert!((line.filled - share).abs() < 1e-5, "{}", line.filled);
        assert_eq!(line.filling, filling);
    }
    let run = Run::of(&grooved(24..41), 33, 0.0);
    for (left, filling) in [(0.04, Filling::Filled), (0.06, Filling::SqueezedOut)] {
        assert_eq!(line_of(&run.state(), left).filling, filling);
    }
}

#[test]
fn a_depth_profile_is_the_share_of_layer_and_void() {
    // Lumens are half of the wood's columns and filled to 6 layers below and 3 above.
    let stack = Stack::new([8, 50, 4], |x, y, _| match (x % 2, y) {
        (_, 22..28) => 'a',
        (0, 16..31) => 'a',
        (0, _) => ' ',
        _ => 'w',
    });
    let state = stack.state(Axis::Y);
    let layers = profile(&state, Reference::Mid);
    assert_eq!(layers.len(), 50);
    for (y, layer) in layers.iter().enumerate() {
        let depth = (y as f64 + 0.5 - 25.0) * VOXEL;
        assert!((layer.depth_m - depth).abs() < 1e-12);
        let (share, filled) = match y {
            22..28 => (1.0, 1.0),
            16..31 => (0.5, 1.0),
            _ => (0.0, 0.0),
        };
        assert!((layer.adhesive_fraction - share).abs() < 1e-9, "{layer:?}");
        let off = layer.filled_void_fraction - filled;
        assert!(off.abs() < 1e-9, "{layer:?}");
    }
    // Points in voxels compressed to nine tenths of their height, between surfaces as much closer, fill their layers.
    let mut run = Run::new(&stack, 25, -0.6 * VOXEL);
    for at in 0..6 * 32 {
        let [x, row, z] = [at % 8, at / 32, at / 8 % 4].map(|i| i as f64 + 0.5);
        run.add([x, 22.0 + 0.9 * row, z]);
    }
    run.volume.fill((0.9 * VOXEL.powi(3)) as f32);
    let layers = profile(&run.state(), Reference::Mid);
    for layer in layers.iter().filter(|l| l.depth_m.abs() < 2.0 * VOXEL) {
        assert!((layer.filled_void_fraction - 1.0).abs() < 1e-5, "{layer:?}");
    }
    // Measured from the adherends, the 6 layers between them are in no layer of the profile.
    let layers = profile(&state, Reference::Adherend);
    assert_eq!(layers.len(), 44);
    assert!(layers.iter().all(|l| l.adhesive_fraction < 0.51));
}

#[test]
fn sealed_lumens_are_room_outside_wood_but_not_open() {
    // Below the bond line a third of the columns are open lumens, filled to 6 layers; as many are sealed ones
    // behind three layers of wood.
    let stack = Stack::new([12, 50, 4], |x, y, _| match (x % 6, y) {
        (_, 22..28) | (0 | 1, 16..28) => 'a',
        (0 | 1, ..16) | (3 | 4, ..19) => ' ',
        _ => 'w',
    });
    let state = stack.state(Axis::Y);
    let layers = profile(&state, Reference::Mid);
    for (y, void, open) in [(10, 0.0, 0.0), (17, 0.5, 1.0), (20, 1.0, 1.0)] {
        let layer = layers[y];
        let [of_void, of_open] = [layer.filled_void_fraction, layer.filled_open_fraction];
        let off = (of_void - void).abs().max((of_open - open).abs());
        assert!(off < 1e-9, "{layer:?}");
    }
    assert!(layers[40].filled_open_fraction.is_nan());
    let line = line_of(&state, 0.0);
    // Full to nine layers below the middle; above it there are open lumens between the surfaces only.
    let half = line.half_filled_m.map(|depth| depth / VOXEL);
    for (found, wanted) in half.into_iter().zip([9.0, 3.0, 3.0]) {
        assert!((found - wanted).abs() < 1e-9, "{half:?}");
    }
}

#[test]
fn a_profile_between_voxel_faces_keeps_the_volume() {
    let stack = slab(Axis::Y, 10);
    let mut run = Run::new(&stack, 35, 7.3 * VOXEL);
    for i in 0..500 {
        run.add([0.5 + f64::from(i % 24), 25.0 + 0.05 * f64::from(i), 3.5]);
    }
    let state = run.state();
    let layers = profile(&state, Reference::Mid).into_iter();
    let thickness = layers.map(|l| l.adhesive_fraction).sum::<f64>() * VOXEL;
    let volume = thickness * state.area_m2();
    assert!(close(volume, 500.0 * VOXEL.powi(3), 1e-5), "{volume}");
}
