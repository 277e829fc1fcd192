//! Synthetic wood beside wood that others measured: permeability along the grain, and the lumens of spruce.

use std::path::{Path, PathBuf};

use synthetic_wood::lumen_diameters;
use voxels::Stack;

use crate::Result;
use crate::outputs::tool;
use crate::study::{Study, done, ended, filled, said, side_by_side, table};

/// Edge of a voxel of the permeable pieces and of the spruce, um.
const EDGE: [f64; 2] = [2.0, 1.45];
/// Voxels of both.
const SIZE: [&str; 2] = ["160x160x24", "600x1240x24"];
const SEEDS: [u32; 2] = [1, 2];
/// Diameters of the circles of lumen areas of 11,685 cells of *Picea abies* in rings of 2007 to 2013, um: quantiles
/// [`QUANTILES`] of the column CA of LOT_PICEA in the data of cran/RAPTOR@5704ee0.
const MEASURED: [f64; 5] = [8.1, 13.9, 25.6, 33.0, 38.7];
const QUANTILES: [f64; 5] = [0.1, 0.25, 0.5, 0.75, 0.9];
/// A tomogram that is not in the repository: FiberForm of 1.3 um (nasa/puma@65a05d7).
const FIBERFORM: &str = "../shared/data/experiments/100_fiberform.tif";

/// A permeability to be found.
enum Piece {
    /// A synthetic species by a seed, along the grain.
    Wood(&'static str, u32),
    /// The tomogram along an axis.
    FiberForm(char),
}

/// Runs what the study wants, and gives the sections of the page.
pub(super) fn run(study: &Study) -> Result<String> {
    let mut pieces = Vec::new();
    for species in ["hybrid-poplar", "birch"] {
        if study.wants(species) {
            pieces.extend(SEEDS.map(|seed| Piece::Wood(species, seed)));
        }
    }
    let tomogram = Path::new(FIBERFORM).is_file();
    if study.wants("fiberform") && tomogram {
        pieces.extend(['x', 'y', 'z'].map(Piece::FiberForm));
    }
    let rows: Result<Vec<String>> = side_by_side(&pieces, |piece| permeability(study, piece));
    let mut page = permeabilities(rows?, tomogram);
    if study.wants("spruce") {
        page += &lumens(study)?;
    }
    Ok(page)
}

/// Grows a piece of undamaged wood in a folder: so many voxels of an edge (um), fibres at an angle (degrees). Gives its stack
/// and what `synth-xct` says of it.
pub(super) fn grown(
    folder: &Path,
    species: &str,
    (size, edge, grain): (&str, f64, f64),
    seed: u32,
) -> Result<(PathBuf, String)> {
    let path = folder.join(format!("{species}-{seed}.tif"));
    let (voxel, grain) = (format!("{edge} um"), format!("{grain} deg"));
    let mut command = tool("synth-xct");
    command.args(["--adhesive", "none", "--species", species, "--size", size]);
    command.args(["--voxel", &voxel, "--grain-angle", &grain]);
    command.args(["--seed", &seed.to_string(), "-o"]).arg(&path);
    std::fs::create_dir_all(folder)?;
    let output = done(&mut command)?;
    Ok((path, said(&output)))
}

/// The row of a piece.
fn permeability(study: &Study, piece: &Piece) -> Result<String> {
    let mut command = tool("wp-metrics");
    // Vessels per mm2 and their median diameter, um.
    let (name, vessels) = match piece {
        Piece::Wood(species, seed) => {
            let (path, anatomy) = grown(&study.folder(), species, (SIZE[0], EDGE[0], 0.0), *seed)?;
            command.arg(path);
            command.args(["--labels", "void=0,wood=128", "--permeability", "z"]);
            let number = |name: &str| {
                let line = anatomy
                    .lines()
                    .find_map(|line| line.trim().strip_prefix(name))?;
                line.split_whitespace().next()?.parse::<f64>().ok()
            };
            let vessels = number("vessels per mm2").zip(number("vessel lumen um"));
            (format!("{species} {seed}"), vessels)
        }
        Piece::FiberForm(axis) => {
            command.args([FIBERFORM, "--voxel", "1.3 um", "--grey", "wood=90.."]);
            command.args(["--permeability", &axis.to_string()]);
            (format!("FiberForm, {axis}"), None)
        }
    };
    let before = std::time::Instant::now();
    let output = ended(command.args(["--quiet"]).env("RAYON_NUM_THREADS", "1"))?;
    let clock_s = before.elapsed().as_secs_f64();
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let row: Vec<&str> = text.lines().nth(1).unwrap_or("").split(',').collect();
    let number = |i: usize| row.get(i).and_then(|cell| cell.parse().ok());
    let numbers: (_, Option<f64>, Option<f64>) = (number(2), number(3), number(4));
    let (Some(permeability), Some(error), Some(porosity)) = numbers else {
        return Err(format!("{name}: {}", said(&output)).into());
    };
    println!("{name:<32} {permeability:.3e} m2  {clock_s:6.1} s");
    let tubes = vessels.map_or("- | -".into(), |(n, d): (f64, f64)| {
        let tubes = n * 1e6 * std::f64::consts::PI * (1e-6 * d).powi(4) / 128.0;
        format!("{tubes:.2e} | {:.2}", permeability / tubes)
    });
    let error = 100.0 * error / permeability;
    Ok(format!(
        "| {name} | {porosity:.3} | {permeability:.3e} | {error:.1} % | {tubes} | {clock_s:.0} |"
    ))
}

fn permeabilities(rows: Vec<String>, tomogram: bool) -> String {
    let heads = "| piece | porosity | permeability (m2) | error | Poiseuille (m2) | ratio | wall time (s) |";
    let values = [
        ("size", SIZE[0]),
        ("edge", &EDGE[0].to_string()),
        ("table", &table(heads, rows)),
        (
            "fiberform",
            match tomogram {
                true => include_str!("fiberform.txt"),
                false => "FiberForm is omitted: its volume in ../shared was not found.",
            },
        ),
    ];
    filled(include_str!("wood.txt"), &values) + "\n"
}

/// The lumens of synthetic spruce beside measured ones.
fn lumens(study: &Study) -> Result<String> {
    let row = |name: &str, cells: usize, of: [f64; 5]| {
        let of = of.map(|d| format!("{d:.1}")).join(" | ");
        format!("| {name} | {cells} | {of} |")
    };
    let mut rows = vec![row("measured", 11_685, MEASURED)];
    for seed in SEEDS {
        let (path, _) = grown(&study.folder(), "spruce", (SIZE[1], EDGE[1], 0.0), seed)?;
        let stack = Stack::open(&[path])?;
        let mut page = Vec::new();
        stack.read_page(12, &mut page)?;
        let all = lumen_diameters(&page, 600, EDGE[1]);
        let at = |q: f64| all.get((q * all.len() as f64) as usize).copied();
        let of = QUANTILES.map(|q| at(q).unwrap_or(f64::NAN));
        rows.push(row(&format!("synthetic, seed {seed}"), all.len(), of));
    }
    let table = table("| | cells | 10 % | 25 % | 50 % | 75 % | 90 % |", rows);
    let values = [("size", SIZE[1]), ("table", &table)];
    Ok(filled(include_str!("lumens.txt"), &values))
}
