//! Synthetic wood beside wood that others measured: permeability along the grain, and the lumens of spruce.

use std::path::{Path, PathBuf};

use synthetic_wood::lumen_diameters;
use voxels::Stack;

use crate::Result;
use crate::outputs::tool;
use crate::study::{Study, done, ended, said, side_by_side, table};

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
///
/// # Errors
/// What a tool or the system said.
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

/// Grows a piece of undamaged wood; gives its stack and what `synth-xct` says of it.
fn grown(study: &Study, species: &str, which: usize, seed: u32) -> Result<(PathBuf, String)> {
    let path = study.folder().join(format!("{species}-{seed}.tif"));
    let mut command = tool("synth-xct");
    command.args(["--adhesive", "none", "--species", species]);
    let voxel = format!("{} um", EDGE[which]);
    command.args(["--size", SIZE[which], "--voxel", &voxel]);
    command.args(["--grain-angle", "0 deg", "--seed", &seed.to_string(), "-o"]);
    std::fs::create_dir_all(study.folder())?;
    let output = done(command.arg(&path))?;
    Ok((path, said(&output)))
}

/// The row of a piece.
fn permeability(study: &Study, piece: &Piece) -> Result<String> {
    let mut command = tool("wp-metrics");
    // Vessels per mm2 and their median diameter, um.
    let (name, vessels) = match piece {
        Piece::Wood(species, seed) => {
            let (path, anatomy) = grown(study, species, 0, *seed)?;
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
    let [edge, _] = EDGE;
    let mut out = format!(
        "## Permeability along the grain\n\n\
         `synth-xct --adhesive none --grain-angle \"0 deg\" --size {} --voxel \"{edge} um\"`, then `wp-metrics --permeability z`: steady flow through all\n\
         open lumens. Error: distance from cells of two voxels. Poiseuille: pi d^4/128 by the number of vessels and their median diameter, of some eight in a piece.\n\n",
        SIZE[0]
    );
    let heads = "| piece | porosity | permeability (m2) | error | Poiseuille (m2) | ratio | s by the clock |";
    out += &table(heads, rows);
    out.push_str(
        "\nPublished: *Populus nigra* 1.05e-10 and 1.63e-10 m2 at vessel lumens of 63 and 67 um (Taghiyari et al. 2011, abstract), 0.49e-10 in outer wood (Taghiyari 2014, abstract).\n\
         Birch carries 0.34 (water) to 0.38 (air) of Poiseuille's flow through its vessels, half of the resistance at perforation plates and a fifth of the vessels\n\
         ending within 20 mm (Petty, abstract). The synthetic vessels are open tubes, longer than the piece, with rims where elements meet and no plates: they carry what Poiseuille says of\n\
         their diameters and more, for the fourth power counts the widest. Real birch carries a third of that, and a press of the synthetic one goes that much too easily along the grain.\n",
    );
    match tomogram {
        true => out.push_str(
            "FiberForm, a crop of 0.13 mm of carbon fibre of 10 um (of nasa/puma, solid from grey 90 on): the material has 5.57e-11 m2 at a porosity of 0.87 (Panerai et al. 2016); across its layers (x) the crop\nhas that within 12 %, along them seven to nine times as much. So small a crop is one sample of many.\n\n",
        ),
        false => out.push_str("FiberForm is left out: ../shared is not here.\n\n"),
    }
    out
}

/// The lumens of synthetic spruce beside measured ones.
fn lumens(study: &Study) -> Result<String> {
    let mut out = format!(
        "## Lumens of spruce\n\nDiameters (um) of the circles of lumen areas: 11,685 cells of *Picea abies* ([LOT_PICEA of RAPTOR](../../lib/studies/reference/README.md#squeeze-flow-and-lumens-that-others-measured), rings of 2007 to 2013) and the middle page of\n\
         `synth-xct --adhesive none --species spruce --size {}`, a ring and more.\n\n",
        SIZE[1]
    );
    let row = |name: &str, cells: usize, of: [f64; 5]| {
        let of = of.map(|d| format!("{d:.1}")).join(" | ");
        format!("| {name} | {cells} | {of} |")
    };
    let mut rows = vec![row("measured", 11_685, MEASURED)];
    for seed in SEEDS {
        let (path, _) = grown(study, "spruce", 1, seed)?;
        let stack = Stack::open(&[path])?;
        let mut page = Vec::new();
        stack.read_page(12, &mut page)?;
        let all = lumen_diameters(&page, 600, EDGE[1]);
        let at = |q: f64| all.get((q * all.len() as f64) as usize).copied();
        let of = QUANTILES.map(|q| at(q).unwrap_or(f64::NAN));
        rows.push(row(&format!("synthetic, seed {seed}"), all.len(), of));
    }
    out += &table("| | cells | 10 % | 25 % | 50 % | 75 % | 90 % |", rows);
    out.push_str(
        "\nThe smallest lumens of late wood, a tenth below 8 um, are two voxels and less of 1.45 um across and stay wider here. Walls are thinner than measured (half of a double wall 1.7 to 3.4 um,\n\
         measured 2.7 to 5.4 at 10 and 90 %): that spruce of a dry alpine valley is denser than the 430 kg/m3 that the species stands for.\n\
         Birch's vessels stay those of Wagenführ's table, 80 um (generated 74 to 86; docs/wood.md). Its share of vessels and its vessels per mm2 ask for that: 0.25 of the section over 50 per mm2 is 80 um a vessel.\n\
         Reports of 39 to 53 um came without a distribution, a number per mm2 or a share: at the same share they would be 113 to 209 per mm2, two to four times what the table has, and one diameter changed alone\n\
         would be no wood that anybody measured. At the same share permeability goes with the square of the diameter, so that such wood has a quarter to a half of the birch above. What is measured of birch here is its\n\
         basic density, 0.545 +- 0.058 g/cm3 (*Betula pendula*, Global Wood Density Database 2): shrunk by 14 % that is a porosity of 0.58 +- 0.05; the pieces above have 0.62 to 0.63.\n",
    );
    Ok(out)
}
