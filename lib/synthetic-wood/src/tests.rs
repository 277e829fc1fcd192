//! Synthetic wood against what the literature says of it.

mod adhesive;

use super::*;

const VOXEL: f64 = 1.45e-6;

fn bonded(size: [usize; 3], adhesive: AdhesiveSystem, seed: u64) -> Recipe {
    Recipe {
        size,
        adhesive: Some(adhesive),
        seed,
        ..Recipe::default()
    }
}

fn wood(species: Species, size: [usize; 3], seed: u64) -> Recipe {
    Recipe {
        size,
        species,
        seed,
        ..Recipe::default()
    }
}

fn grow(size: [usize; 3], adhesive: AdhesiveSystem, seed: u64) -> Specimen {
    Specimen::grow(&bonded(size, adhesive, seed)).unwrap()
}

/// Every number the literature gives for a species is met, and its error printed.
#[test]
fn wood_has_the_anatomy_of_its_species() {
    let poplar = [393, 393, 24];
    for recipe in [
        bonded(poplar, AdhesiveSystem::Pf, 1),
        bonded(poplar, AdhesiveSystem::PvaPf, 2),
        wood(Species::HybridPoplar, poplar, 1),
        wood(Species::Beech, [480, 393, 24], 1),
        wood(Species::Birch, [480, 393, 24], 1),
        // A whole growth ring.
        wood(Species::Spruce, [600, 560, 60], 1),
    ] {
        let (species, specimen) = (recipe.species, Specimen::grow(&recipe).unwrap());
        let named = species.timber().targets.keys();
        assert!(
            named
                .into_iter()
                .all(|name| Anatomy::NAMES.contains(&&**name))
        );
        let values = specimen.anatomy().values;
        for ((name, target), value) in Anatomy::NAMES.iter().zip(species.targets()).zip(values) {
            let Some(target) = target else { continue };
            let (usual, [low, high]) = (target.value, target.range);
            let error = 100.0 * (value / usual - 1.0);
            println!("{species:?}: {name} {value:.3}, usually {usual} ({error:+.0} %)");
            assert!((low..=high).contains(&value), "{species:?}: {name} {value}");
        }
        if species == Species::HybridPoplar {
            let mut lumens = lumen_diameters(&specimen.pages().nth(12).unwrap(), 393, 1.45);
            // Smaller ones are ray cells and tapered ends, larger ones vessels.
            lumens.retain(|diameter| (9.0..35.0).contains(diameter));
            let quartiles = [1, 3].map(|i| lumens[i * lumens.len() / 4]);
            println!("{} lumens, quartiles {quartiles:.1?} um", lumens.len());
            assert!(lumens.len() > 200 && quartiles[0] > 14.0 && quartiles[1] < 20.0);
        }
        let adhesive = specimen.labels().contains(&ADHESIVE);
        assert_eq!(adhesive, recipe.adhesive.is_some());
    }
}

/// Lumens shift from page to page as their angle says: by the rows that match best 30 pages on.
#[test]
fn fibres_run_at_their_grain_angle() {
    for angle in [0.0_f64, 10.0, 20.0, 30.0] {
        let mut recipe = wood(Species::Spruce, [160, 160, 40], 1);
        recipe.grain_angle = Some(angle.to_radians());
        let specimen = Specimen::grow(&recipe).unwrap();
        let [nx, ny, _] = specimen.size();
        let [from, to] = [4, 34].map(|z| specimen.pages().nth(z).unwrap());
        let is_wood = |page: &[u8], x: isize, y: isize| page[y as usize * nx + x as usize] == WOOD;
        let [columns, rows] = [nx, ny].map(|n| 20..n as isize - 20);
        let alike = |&(dx, dy): &(isize, isize)| {
            let middle = rows
                .clone()
                .flat_map(|y| columns.clone().map(move |x| (x, y)));
            let same = |&(x, y): &_| is_wood(&from, x, y) == is_wood(&to, x + dx, y + dy);
            middle.filter(same).count()
        };
        let shifts = (-3..=3).flat_map(|dx| (-20..=20).map(move |dy| (dx, dy)));
        let (_, dy) = shifts.max_by_key(alike).unwrap();
        let expected = 30.0 * angle.to_radians().tan();
        println!("{angle} degrees: {dy} rows in 30 pages, {expected:.1} expected");
        assert!((dy.unsigned_abs() as f64 - expected).abs() < 1.0);
    }
}

/// Early wood is open and late wood dense, in rows along the rays, with a sharp ring border.
#[test]
fn spruce_goes_from_early_to_late_wood_and_begins_anew() {
    let specimen = Specimen::grow(&wood(Species::Spruce, [120, 600, 24], 2)).unwrap();
    let [nx, ny, nz] = specimen.size();
    let labels = specimen.labels();
    let row = |y: usize| {
        let voxels = (0..nx * nz).map(|i| labels[(i / nx * ny + y) * nx + i % nx]);
        voxels.filter(|&label| label != WOOD).count() as f64 / (nx * nz) as f64
    };
    // Over 40 voxels, more than an early cell.
    let open: Vec<f64> = (0..ny).map(row).collect();
    let mean = open.windows(40).map(|rows| rows.iter().sum::<f64>() / 40.0);
    let [least, most] = [mean.clone().fold(1.0, f64::min), mean.fold(0.0, f64::max)];
    println!("open share of layers {least:.3} in late, {most:.3} in early wood");
    assert!(least < 0.5 && most > 0.72);
}

/// The tissue counts must agree with the labels themselves: porosity from the labels of the
/// rows that no face reaches.
#[test]
fn the_reported_porosity_is_that_of_the_labels() {
    let specimen = grow([300, 300, 24], AdhesiveSystem::PvaPf, 3);
    let [nx, ny, _] = specimen.size();
    let far = |i: &usize| (i / nx % ny).abs_diff(ny / 2) > 40;
    let labels = specimen.labels();
    let deep: Vec<u8> = (0..labels.len()).filter(far).map(|i| labels[i]).collect();
    let porosity = deep.iter().filter(|&&l| l != WOOD).count() as f64 / deep.len() as f64;
    let reported = specimen.anatomy().values[0];
    println!("labels {porosity:.3}, reported {reported:.3}");
    assert!((porosity - reported).abs() < 0.03);
}
