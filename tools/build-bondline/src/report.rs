//! Messages of the tool on standard error.

use bondline::{Bond, Face, Press, Room, Specimen};
use metrics::{Datum, Reference, State};
use units::Axis;

/// Rise of the bond plane, in effective penetrations, from which on the user is warned: it adds 5 % to WP of a slab, less
/// of what has penetrated. Fits of level, rough faces 64 voxels wide rise by up to 0.23.
const WORTH_LEVELLING: f64 = 0.33;

pub(crate) fn report(bond: &Bond, normal: Axis) {
    let um = |metres: f64| 1e6 * metres;
    let um3 = |voxels: f64| voxels * um(bond.voxel_m).powi(3);
    plane(bond, normal);
    if bond.trimmed != [0; 3] {
        cli::note(format!(
            "cut off {:?} layers at the high x, y and z sides, so that the bond is a whole number of cells wide",
            bond.trimmed
        ));
    }
    cli::note(format!(
        "wood: {} voxels in the bottom adherend, {} in the top one",
        bond.bottom.bits.count(),
        bond.top.bits.count()
    ));
    let out = bond.adhesive_out as f64;
    cli::note(format!(
        "adhesive: {:.0} voxels = {:.1} um3 in the specimen, {out} voxels = {:.1} um3 in the slab, rounding {:+.3} %",
        bond.adhesive_in,
        um3(bond.adhesive_in),
        um3(out),
        100.0 * bond.rounding()
    ));
    let of = match bond.faces {
        None => "effective penetration of the specimen",
        Some(_) => "asked for",
    };
    cli::note(format!(
        "slab: {:.3} um = {} cells of {:.3} um ({of} {:.4} um); gap {:.3} um",
        um(bond.slab_m()),
        bond.slab_cells,
        um(bond.cell_m),
        um(bond.effective_penetration_m()),
        um(bond.gap_m)
    ));
    if let Some(room) = room(bond, normal) {
        let say = if room.least_gap_m == 0.0 {
            cli::note
        } else {
            cli::warn
        };
        say(format!("{room} (closed sides)"));
    }
}

/// Room for the slab in the wood, with sides through which nothing leaves.
fn room(bond: &Bond, normal: Axis) -> Option<Room> {
    let n = normal.index();
    let end_m = bond.bottom.origin_m[n] + bond.bottom.bits.dims()[n] as f64 * bond.voxel_m;
    let voxel_m3 = bond.voxel_m.powi(3);
    Room::of(&Press {
        adherends: [&bond.bottom, &bond.top].map(|body| (body.bits.view(), voxel_m3)),
        normal,
        area_m2: bond.area as f64 * bond.voxel_m.powi(2),
        apart_m: bond.top.origin_m[n] - bond.gap_m - end_m,
        adhesive_m3: bond.adhesive_out as f64 * voxel_m3,
        periodic: [false; 3],
        open: [false; 3],
    })
}

fn plane(bond: &Bond, normal: Axis) {
    let um = |metres: f64| 1e6 * metres;
    let share = 100.0 * bond.severed as f64 / bond.area as f64;
    if let Some(faces) = &bond.faces {
        for (name, face) in ["bottom", "top"].iter().zip(faces) {
            piece(name, face, bond.voxel_m);
        }
        cli::note(format!(
            "bond plane: {normal} = {:.3} um, midway between the levels of the closed pieces; wood touches in {} columns, {share:.2} % of the bond area",
            um(bond.plane_m),
            bond.severed,
        ));
        return;
    }
    let how = match bond.found {
        Some(line) => format!(
            "found midway between the bond surfaces at {} and {} voxels; the excess of adhesive over wood is largest in layer {}, {:.1} % of the area",
            line.bottom,
            line.top,
            line.seed,
            100.0 * line.contrast
        ),
        None => "as given, at the nearest face between voxels".into(),
    };
    cli::note(format!(
        "bond plane: {normal} = {:.3} um ({how}); it separates {} pairs of touching wood voxels, {share:.2} % of the bond area",
        um(bond.plane_m),
        bond.severed,
    ));
    bondline::severed_doubt(bond.severed, bond.area)
        .into_iter()
        .for_each(cli::warn);
}

fn piece(name: &str, face: &Face, voxel_m: f64) {
    let um = 1e6 * voxel_m;
    cli::note(format!(
        "{name} face, from its highest wood: level {:.3} um (a quarter of the wood fraction inside), mean {:.3} um, rms roughness {:.3} um (first wood of each column, opened lumens included), wood in {:.2} % of the columns",
        face.level as f64 * um,
        face.mean * um,
        face.roughness * um,
        100.0 * face.covered
    ));
    if face.islands > 0 {
        cli::warn(format!(
            "{} loose wood voxels in front of the {name} face keep the pieces apart; --drop-islands removes them",
            face.islands
        ));
    }
}

/// How the bond plane of a specimen is tilted, or why that is not known.
pub(crate) fn tilt(specimen: &Specimen, bond: &Bond, normal: Axis) {
    let state = State::of_specimen(specimen, normal);
    let tilt = match Datum::find(Reference::Fit, &state) {
        Err(why) => return cli::warn(why),
        Ok(plane) => match (plane.fit_doubt(), plane.tilt()) {
            (None, Some(tilt)) => tilt,
            (doubt, _) => return doubt.into_iter().for_each(cli::warn),
        },
    };
    let n = normal.index();
    let width = |axis: usize| state.box_max_m[axis] - state.box_min_m[axis];
    // A turn about one axis across the bond is a rise along the other.
    let across = (0..3).filter(|&axis| axis != n);
    let rise: f64 = across
        .map(|axis| tilt.deg[axis].to_radians().tan().abs() * width(3 - axis - n))
        .sum();
    let said = format!("the bond plane is {tilt} and rises by {:.1} um", 1e6 * rise);
    match rise < WORTH_LEVELLING * bond.effective_penetration_m() {
        true => cli::note(said),
        false => cli::warn(format!(
            "{said}, but the wood is cut level; xct2particles --level {normal} turns the specimen"
        )),
    }
}
