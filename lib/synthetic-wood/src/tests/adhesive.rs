//! The adhesive of synthetic specimens: how much, how deep, and whether it hangs together.

use super::*;

/// Voxels reached from `start` through voxels that `passes` allows; `diagonal` also steps
/// over edges and corners.
fn flood(specimen: &Specimen, start: u8, passes: fn(u8) -> bool, diagonal: bool) -> Vec<bool> {
    let [nx, ny, nz] = specimen.size();
    let labels = specimen.labels();
    let plane = (0..labels.len()).filter(|i| i / nx % ny == ny / 2 && labels[*i] == start);
    let mut open: Vec<usize> = plane.collect();
    let mut reached = vec![false; labels.len()];
    open.iter().for_each(|&i| reached[i] = true);
    while let Some(i) = open.pop() {
        let at = [i % nx, i / nx % ny, i / (nx * ny)].map(|c| c as isize);
        for step in 0..27_isize {
            let step = [step % 3 - 1, step / 3 % 3 - 1, step / 9 - 1];
            let straight = step.iter().filter(|s| **s != 0).count() == 1;
            let [x, y, z] = [0, 1, 2].map(|a| (at[a] + step[a]) as usize);
            if (diagonal || straight) && x < nx && y < ny && z < nz {
                let next = (z * ny + y) * nx + x;
                if !reached[next] && passes(labels[next]) {
                    reached[next] = true;
                    open.push(next);
                }
            }
        }
    }
    reached
}

#[test]
fn the_adhesive_has_the_slabs_volume() {
    for (adhesive, slab) in [
        (AdhesiveSystem::Pf, 23.2e-6),
        (AdhesiveSystem::PvaPf, 29.0e-6),
    ] {
        let recipe = Recipe {
            slab: Some(slab),
            ..bonded([48, 96, 40], adhesive, 7)
        };
        let specimen = Specimen::grow(&recipe).unwrap();
        let voxels = specimen.labels().iter().filter(|&&l| l == ADHESIVE).count();
        assert_eq!(voxels, (slab / VOXEL).round() as usize * 48 * 40);
        let anatomy = specimen.anatomy();
        assert!((anatomy.slab / slab - 1.0).abs() < 1e-6, "{}", anatomy.slab);
        let expected = slab * 48.0 * 40.0 * VOXEL * VOXEL;
        assert!((anatomy.adhesive_volume / expected - 1.0).abs() < 1e-5);
    }
}

/// At equal pressure and time a tube is filled to a depth that goes with its radius (Washburn).
#[test]
fn wide_lumens_are_filled_deeper_in_proportion_to_their_radius() {
    let size = [24, 240, 24];
    let recipe = Recipe {
        slab: Some(30e-6),
        ..bonded(size, AdhesiveSystem::PvaPf, 1)
    };
    let plan = Plan::new(&recipe).unwrap();
    let is_gap = |[_, y, _]: [usize; 3]| (118..=121).contains(&y);
    let radius = |[x, _, _]: [usize; 3]| if x <= 5 { 40.0 } else { 10.0 };
    let mut cells = Cells::new(size);
    for index in cells.indices() {
        let place = cells.place(index);
        let state = match place[0] {
            _ if is_gap(place) => State::Adhesive,
            0..=5 | 12..=13 => State::Open,
            _ => State::Wood,
        };
        cells.set(index, state);
    }
    penetration::fill(&mut cells, &plan, 24 * 4 * 24, is_gap, radius).unwrap();
    let depth = |x: usize| {
        let column = (122..240).map(|y| cells.get(cells.index([x, y, 0])));
        column.take_while(|&c| c == State::Adhesive).count() as f64
    };
    let (wide, narrow) = (depth(2), depth(12));
    let ratio = wide / narrow;
    println!("depth {wide} at radius 40 um, {narrow} at 10 um: ratio {ratio:.2}");
    assert!(narrow > 4.0 && wide < 118.0 && (ratio - 4.0).abs() < 0.4);
}

#[test]
fn adhesive_is_connected_to_the_gap_but_for_the_tube_of_pf() {
    for adhesive in [AdhesiveSystem::Pf, AdhesiveSystem::PvaPf] {
        let specimen = grow([300, 300, 40], adhesive, 1);
        let all = specimen.labels().iter().filter(|&&l| l == ADHESIVE).count();
        let through_adhesive = flood(&specimen, ADHESIVE, |label| label == ADHESIVE, false);
        let connected = through_adhesive.iter().filter(|r| **r).count();
        let tube = specimen.anatomy().adhesive_voxels[2];
        println!("{adhesive:?}: {all} voxels, {connected} connected, {tube} in the tube");
        assert_eq!(connected + tube, all);
        assert_eq!(tube > 0, adhesive == AdhesiveSystem::Pf);
        // Not even over voxel corners and through empty lumens does the tube meet the gap.
        let through_void = flood(&specimen, ADHESIVE, |label| label != WOOD, true);
        let labels = specimen.labels();
        let outside = labels.iter().zip(&through_void);
        let isolated = outside.filter(|(label, reached)| **label == ADHESIVE && !**reached);
        assert_eq!(isolated.count(), tube);
    }
}

/// The specimens of the plain `make` must let adhesive in on both sides.
#[test]
fn small_boxes_have_open_lumens_on_both_sides() {
    for size in [[40, 96, 40], [48, 96, 48], [64, 128, 64]] {
        for seed in 1..6 {
            let specimen = grow(size, AdhesiveSystem::PvaPf, seed);
            let reached = flood(&specimen, ADHESIVE, |label| label != WOOD, false);
            let [nx, ny, _] = size;
            let mut per_side = [0_usize; 2];
            for (i, _) in reached.iter().enumerate().filter(|(_, r)| **r) {
                per_side[usize::from(i / nx % ny >= ny / 2)] += 1;
            }
            let side = specimen.labels().len() / 2;
            let shares = per_side.map(|n| n as f64 / side as f64);
            println!("{size:?} seed {seed}: reachable {shares:.2?}");
            assert!(shares.iter().all(|share| *share > 0.15), "{shares:?}");
        }
    }
}
