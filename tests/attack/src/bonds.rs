//! Uses of a forged particle file: read, measured, built into a bond, pressed.

use bondline::{Opening, PlacedVoxels, Specimen};
use metrics::{Datum, Map, Reference, ShearRates, Side, State};
use particle_file::{Kind, ParticleFile};
use units::Axis;

use crate::readers::{self, explained};
use crate::runs::{self, SCHEMES};
use crate::sign::signed;

/// Opens a particle file as it is and signed anew, reads all of it and does with it what the
/// tools do.
pub(crate) fn feed(bytes: &[u8]) -> bool {
    let _ = ParticleFile::from_bytes(bytes).map(|file| file.check());
    let signed = signed(bytes);
    let Ok(file) = ParticleFile::from_bytes(&signed) else {
        return false;
    };
    let _ = (file.sum(), file.content_hash());
    let _ = file.liquid().is_ok();
    read_columns(&file);
    measure(&file);
    match file.header().kind {
        Kind::Specimen => build(&file),
        Kind::Bond => press(&signed),
        Kind::State | Kind::Checkpoint => {}
    }
    file.check().is_ok()
}

fn read_columns(file: &ParticleFile) {
    for column in file.columns() {
        let name = &column.name;
        let _ = (file.column::<f32>(name), file.column::<f64>(name));
        let _ = (file.column::<u32>(name), file.column::<u64>(name));
        let _ = (file.column::<u8>(name), file.vectors(name));
    }
    for section in file.sections() {
        let _ = file.blob(&section.name);
    }
}

fn measure(file: &ParticleFile) {
    let _ = ShearRates::of_file(file, None);
    let Ok(state) = State::of_file(file) else {
        return;
    };
    for reference in [
        Reference::Mid,
        Reference::Adherend,
        Reference::Fit,
        Reference::Plane(2e-5),
    ] {
        let Ok(datum) = Datum::find(reference, &state) else {
            continue;
        };
        let _ = metrics::penetration(&state, &datum);
        let _ = metrics::depth_profile(&state, &datum, &metrics::Sealed::of(&state, &datum));
        let map = Map::new(&state, &datum, Side::Total);
        let _ = metrics::table::write_map(&mut std::io::sink(), &map);
    }
    let _ = metrics::compare(&state, &state);
}

fn build(file: &ParticleFile) {
    let block = |name| file.block_named(name).ok().map(PlacedVoxels::of_block);
    let Some((wood, adhesive)) = block("wood").zip(block("adhesive")) else {
        return;
    };
    let Ok(specimen) = Specimen::new(wood, adhesive) else {
        return;
    };
    let opening = Opening {
        normal: Axis::from_index(file.header().normal.into()).unwrap_or(Axis::Y),
        voxels_per_cell: 2,
        gap_m: None,
        tolerance: 0.5,
    };
    let _ = bondline::build(&specimen, None, &opening);
}

/// Explains the bond and takes one step of it by both schemes.
fn press(bytes: &[u8]) {
    let bond = readers::file("forged.mpts", bytes);
    for case in SCHEMES.map(runs::case_file) {
        explained(&case, Some(&bond));
        let _ = runs::steps(&case, &bond, &runs::empty("pressed"), 1);
    }
}
