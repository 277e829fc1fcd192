//! A press of pieces of a real section of spruce beside synthetic spruce.

use std::fmt::Write as _;
use std::path::Path;

use voxels::Stack;

use super::section::{Strip, strip};
use super::wood;
use crate::Result;
use crate::method::Method;
use crate::numbers::{largest, mean};
use crate::outputs::tool;
use crate::study::{Study, filled, printed, side_by_side, table};

/// Voxels of a piece, their edge (um), and the layers below the cut.
const SIZE: [usize; 3] = [160, 192, 64];
const EDGE: f64 = 1.45;
const BELOW: usize = 96;
/// Pieces of either wood.
const PIECES: u32 = 6;
/// Rise of the grain, degrees.
const GRAIN: f64 = 5.0;
/// Adhesive between the pieces, and how far they close, um: a cell of two voxels is left.
const SLAB: f64 = 14.5;
const TRAVEL: f64 = 11.6;
/// Most of a section's pixels that no measured cell may cover.
const UNCOVERED: f64 = 0.02;

/// A piece of wood: its voxels, and of both sides of the cut, below and above, the lumen shares of the middle page
/// and how deep it opens lumens (um, the mean).
struct Piece {
    name: String,
    shares: [f64; 2],
    opened: [f64; 2],
    labels: Vec<u8>,
}

/// What a press of a piece comes to.
struct Pressed {
    /// Bottom, top, total, um.
    wp: [f64; 3],
    /// Pa.
    peak: f64,
    /// um.
    way: f64,
    cpu_s: f64,
}

/// Presses the pieces that the study wants, and gives the section of the page.
pub(super) fn run(study: &Study) -> Result<String> {
    if !study.wants("press") {
        return Ok(String::new());
    }
    let folder = study.folder().join("press");
    let strip = strip(SIZE[0], EDGE)?;
    let mut pieces = strip.as_ref().map_or_else(Vec::new, places);
    for seed in 1..=PIECES {
        pieces.push(grown(&folder, seed)?);
    }
    let done: Vec<Result<Pressed>> = side_by_side(&pieces, |piece| pressed(&folder, piece));
    Ok(section(&pieces, &done, strip.is_some()))
}

/// [`SIZE`] as tools take it.
fn size() -> String {
    SIZE.map(|n| n.to_string()).join("x")
}

/// Synthetic spruce by a seed.
fn grown(folder: &Path, seed: u32) -> Result<Piece> {
    let (stack, _) = wood::grown(folder, "spruce", (&size(), EDGE, GRAIN), seed)?;
    let stack = Stack::open(&[stack])?;
    let (mut labels, mut page) = (Vec::new(), Vec::new());
    for z in 0..SIZE[2] {
        stack.read_page(z, &mut page)?;
        labels.extend_from_slice(&page);
    }
    Ok(Piece::new(format!("synthetic {seed}"), labels))
}

/// Pieces spread over the measured section, extruded along the grain.
fn places(strip: &Strip) -> Vec<Piece> {
    let [nx, ny, nz] = SIZE;
    let rise = |z: usize| (z as f64 * GRAIN.to_radians().tan()).round() as usize;
    let tall = ny + rise(nz);
    let covered = |row: &usize| {
        let bare: usize = strip.uncovered[*row..row + tall].iter().sum();
        bare as f64 <= UNCOVERED * (nx * tall) as f64
    };
    let rows: Vec<usize> = (0..strip.uncovered.len().saturating_sub(tall))
        .filter(covered)
        .collect();
    let extruded = |n: u32| {
        let row = *rows.get(rows.len() * (2 * n as usize + 1) / (2 * PIECES as usize))?;
        let voxel = |z: usize, i: usize| strip.lumen[(row + rise(z)) * nx + i];
        let labels =
            (0..nz).flat_map(|z| (0..nx * ny).map(move |i| if voxel(z, i) { 0 } else { 128 }));
        Some(Piece::new(
            format!("real, {:.2} mm", row as f64 * EDGE * 1e-3),
            labels.collect(),
        ))
    };
    (0..PIECES).filter_map(extruded).collect()
}

impl Piece {
    fn new(name: String, labels: Vec<u8>) -> Self {
        let [nx, ny, nz] = SIZE;
        let page = &labels[nz / 2 * nx * ny..][..nx * ny];
        let share =
            |part: &[u8]| part.iter().filter(|l| **l == 0).count() as f64 / part.len() as f64;
        let (below, above) = page.split_at(BELOW * nx);
        let shares = [share(below), share(above)];
        let lumen = |x: usize, y: usize, z: usize| labels[(z * ny + y) * nx + x] == 0;
        let deep = |(x, z): (usize, usize)| {
            [
                (0..BELOW).rev().take_while(|&y| lumen(x, y, z)).count(),
                (BELOW..ny).take_while(|&y| lumen(x, y, z)).count(),
            ]
        };
        let columns = (0..nz).flat_map(|z| (0..nx).map(move |x| (x, z)));
        let sums = columns
            .map(deep)
            .fold([0; 2], |a, b| [a[0] + b[0], a[1] + b[1]]);
        let opened = sums.map(|sum| EDGE * sum as f64 / (nx * nz) as f64);
        Self {
            name,
            shares,
            opened,
            labels,
        }
    }
}

/// Cuts a piece, bonds it again and closes it.
fn pressed(folder: &Path, piece: &Piece) -> Result<Pressed> {
    let name = piece.name.replace([' ', ',', '.'], "-");
    let path = |end: &str| folder.join(format!("{name}{end}")).display().to_string();
    let (raw, wood, bond) = (path(".raw"), path("-wood.mpts"), path("-bond.mpts"));
    std::fs::write(&raw, &piece.labels).map_err(|e| format!("{raw}: {e}"))?;
    let voxel = format!("{EDGE} um");
    let mut reader = tool("xct2particles");
    reader.args(["--quiet", &raw, "--dims", &size(), "--type", "u8"]);
    reader.args(["--voxel", &voxel, "--labels", "void=0,wood=128"]);
    printed(reader.args(["-o", &wood]))?;
    let (plane, slab) = (format!("{} um", BELOW as f64 * EDGE), format!("{SLAB} um"));
    let mut build = tool("build-bondline");
    build.args(["--quiet", &wood, "--plane", &plane, "--slab", &slab]);
    printed(build.args(["-o", &bond]))?;
    let method = Method::implicit().setting(format!("clamp.travel=\"{TRAVEL} um\""));
    let case = Path::new("pipelines/cases/pf-implicit.toml");
    let run = method.run(case, Path::new(&path("")), &["--particles", &bond])?;
    let [bottom, top] = run.columns(["pressure_bottom_Pa", "pressure_top_Pa"])?;
    let [way] = run.ends(["displacement_m"])?;
    let done = Pressed {
        wp: run.weighted_penetration()?,
        peak: largest(bottom.iter().zip(&top).map(|(b, t)| 0.5 * (b + t))),
        way: 1e6 * way,
        cpu_s: run.cpu_s(),
    };
    println!(
        "{name:<32} WP {:.2} um, {:.3} MPa  {:6.1} s",
        done.wp[2],
        1e-6 * done.peak,
        done.cpu_s
    );
    Ok(done)
}

fn section(pieces: &[Piece], done: &[Result<Pressed>], real: bool) -> String {
    let line = |(piece, done): (&Piece, &Result<Pressed>)| {
        let ([below, above], [low, high]) = (piece.shares, piece.opened);
        let ended = match done {
            Ok(p) => {
                let ([bottom, top, total], peak) = (p.wp, 1e-6 * p.peak);
                let (way, cpu_s) = (p.way, p.cpu_s);
                format!("{bottom:.2} / {top:.2} / {total:.2} | {peak:.2} | {way:.2} | {cpu_s:.0}")
            }
            Err(said) => {
                let said = said.to_string();
                let why = said.split("mpm-run: ").last().unwrap_or(&said);
                format!("- | - | {} | -", why.split(';').next().unwrap_or(why))
            }
        };
        let wood = &piece.name;
        format!("| {wood} | {below:.3}, {above:.3} | {low:.1}, {high:.1} | {ended} |")
    };
    let heads = "| wood | lumens below, above | opened (um) | WP bottom / top / total (um) | highest pressure (MPa) | closed (um) | CPU s |";
    let mut means = String::new();
    for name in ["real", "synthetic"].into_iter().skip(usize::from(!real)) {
        let own = (pieces.iter().zip(done)).filter(|(piece, _)| piece.name.starts_with(name));
        let ended: Vec<&Pressed> = own.filter_map(|(_, done)| done.as_ref().ok()).collect();
        let mean = |of: fn(&Pressed) -> f64| mean(ended.iter().copied().map(of));
        let (wp, peak, way) = (mean(|p| p.wp[2]), 1e-6 * mean(|p| p.peak), mean(|p| p.way));
        let _ = writeln!(
            means,
            "Mean of the completed runs, {name}: WP {wp:.2} um, highest pressure {peak:.2} MPa, closed by {way:.2} um."
        );
    }
    if real {
        means += include_str!("press-real.txt");
    }
    let values = [
        ("size", &*size()),
        ("grain", &GRAIN.to_string()),
        ("slab", &SLAB.to_string()),
        ("travel", &TRAVEL.to_string()),
        ("pieces", &PIECES.to_string()),
        ("table", &table(heads, pieces.iter().zip(done).map(line))),
        ("means", &means),
    ];
    let page = filled(include_str!("press.txt"), &values);
    match real {
        true => page,
        false => page + "Real spruce is omitted: its data in ../shared were not found.\n",
    }
}
