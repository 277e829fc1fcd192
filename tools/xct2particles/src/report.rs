//! Messages of the tool on standard error.

use metrics::Tilt;
use units::Axis;
use voxels::{Crop, Despeckled, Doubt, Proposal, Segmented, Stack, VoxelEdge};

/// A given edge further than this from the stated one is worth a warning.
const EDGE_TOLERANCE: f64 = 0.01;
/// Voxels that a piece of noise has at most.
const SPECK: usize = 4;
/// Pieces as small that any specimen may have.
const FEW: usize = 5;

/// The stack, what is kept of it, and the size of its voxels.
pub(crate) fn stack(stack: &Stack, crop: &Crop, edge: &VoxelEdge) {
    let size = |[nx, ny, nz]: [usize; 3]| format!("{nx} x {ny} x {nz} voxels");
    let (whole, kept) = (size(stack.dims()), size(crop.dims()));
    let cropped = match kept == whole {
        true => String::new(),
        false => format!(", cropped to {kept}"),
    };
    cli::note(format_args!(
        "stack       {}, {whole} (x, y, z), {}{cropped}",
        stack.name(),
        stack.format().sample
    ));
    let um = edge.metres * 1e6;
    cli::note(format_args!("voxel edge  {um:.6} um, from {}", edge.from));
    let Some(stated) = stack.voxel_size() else {
        return;
    };
    let near = |metres: f64| (metres / edge.metres - 1.0).abs() <= EDGE_TOLERANCE;
    if stated.from() == edge.from {
        if !stated.states_spacing() {
            cli::note(
                "            the distance between pages is not given: cubic voxels are assumed",
            );
        }
    } else if !stated.cube_edge().is_ok_and(near) {
        cli::warn(format_args!(
            "by {} a voxel is {stated}; {} is taken instead",
            stated.from(),
            edge.from
        ));
    }
}

/// What thresholds would part.
pub(crate) fn proposal(proposed: &Result<Proposal, String>) {
    match proposed {
        Ok(Proposal { grey, left_out }) => {
            cli::note(format_args!(
                "grey        proposed by Otsu's thresholds: --grey {grey}"
            ));
            left_out.iter().for_each(cli::warn);
        }
        Err(why) => cli::warn(format_args!("no grey values are proposed: {why}")),
    }
}

/// What became of specks of at most so many voxels.
pub(crate) fn despeckled(found: &Despeckled, most: u16) {
    let [void, wood, adhesive] = found.voxels;
    cli::note(format_args!(
        "despeckled  {} pieces of at most {most} voxels changed to the phase around them: {adhesive} voxels of adhesive, {wood} of wood, {void} of void",
        found.pieces
    ));
}

/// Noise that grey values brought along. Clean specimens have one such piece in 40,000 voxels at most, noisy ones one in
/// a few hundred.
pub(crate) fn noise(specimen: &Segmented) {
    let [pieces, voxels] = specimen.small_pieces(SPECK);
    if pieces > FEW + voxels / 10_000 {
        cli::warn(format_args!(
            "{pieces} pieces of at most {SPECK} voxels look like noise: --despeckle {SPECK} changes them to the phase around them"
        ));
    }
}

/// How much of a segmentation by grey values the noise decides, what thresholds `moved` by it give, and the `cure`.
pub(crate) fn doubt(doubt: Doubt, moved: &str, cure: &str) {
    let said = format!("{doubt}; with thresholds moved by it {moved}");
    match doubt.overlaps() {
        true => cli::warn(format_args!("phases overlap: {said}; {cure}")),
        false => cli::note(format_args!("noise       {said}")),
    }
}

/// How a specimen was turned.
pub(crate) fn level(tilt: &Tilt, [x, y, z]: [usize; 3]) {
    cli::note(format_args!(
        "level       the bond plane was {tilt}; after levelling, {x} x {y} x {z} voxels are left"
    ));
}

/// Counts, fractions and bond area, across `normal`, of a specimen with voxels of `edge` (m).
pub(crate) fn phases(specimen: &Segmented, edge: f64, normal: Axis) {
    match specimen.guessed {
        Some([void, wood, adhesive]) => cli::note(format_args!(
            "labels      guessed: void={void},wood={wood},adhesive={adhesive}"
        )),
        Some([void, wood]) => cli::note(format_args!(
            "labels      guessed: void={void},wood={wood}, without adhesive"
        )),
        _ => {}
    }
    let dims = specimen.wood.dims().map(|n| n as u64);
    let (wood, adhesive) = (specimen.wood.count(), specimen.adhesive.count());
    let total: u64 = dims.iter().product();
    let void = total - wood - adhesive;
    for (name, voxels) in [("void", void), ("wood", wood), ("adhesive", adhesive)] {
        let fraction = voxels as f64 / total as f64;
        cli::note(format_args!(
            "{name:<10} {voxels:>12} voxels  {fraction:.6}"
        ));
        if voxels == 0 && name == "wood" {
            cli::warn("no voxel is wood");
        }
    }
    specimen.walls_of_adhesive().into_iter().for_each(cli::warn);
    let um = edge * 1e6;
    let columns = total / dims[normal.index()];
    let area = columns as f64 * um * um;
    let along = Axis::ALL.into_iter().filter(|axis| *axis != normal);
    let along: Vec<String> = along.map(|axis| axis.to_string()).collect();
    let along = along.join(" times ");
    let rest = match adhesive {
        0 => "; undamaged wood, to be bonded by build-bondline --slab or --spread".into(),
        n => {
            let thickness = n as f64 * um / columns as f64;
            format!(", adhesive volume over it {thickness:.4} um")
        }
    };
    cli::note(format_args!("bond area   {area:.1} um2 ({along}){rest}"));
}
