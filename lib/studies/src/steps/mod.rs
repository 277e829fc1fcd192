//! `make steps`: what the length of a step and the size of a cell change in presses by the implicit scheme.

mod report;

use std::path::Path;

use crate::Result;
use crate::lines::{self, Values};
use crate::method::Method;
use crate::numbers::{crossing, worst};
use crate::outputs::{Run, bond};
use crate::study::{Study, said, side_by_side, write};

/// Drives and their keys. At full speed a film of a cell is left: in a closing one the pressure has no bound.
const DRIVES: [[&str; 2]; 3] = [
    ["0.3 MPa", "clamp.max_pressure=0.3MPa clamp.time_limit=4ms"],
    ["2.5 MPa", "clamp.max_pressure=2.5MPa clamp.time_limit=1ms"],
    ["full speed", "clamp.travel=8.7um"],
];
/// Courant numbers in cells of two voxels: the default, shorter steps, those of the reference.
const CFL: [&str; 4] = ["1", "0.5", "0.2", "0.05"];
/// Voxels a cell, and the Courant number that makes steps equally long, of the first drive.
const CELLS: [[&str; 2]; 3] = [["2", "0.25"], ["1", "0.5"], ["0.5", "1"]];
/// By what factor the pressure grows in a step in which a void fills.
const FILLING: f64 = 1.5;

struct Press {
    /// Bond, drive, voxels a cell, Courant number, exit status and what was said.
    name: [String; 6],
    /// Time (s), gap left (m), final pressure (Pa), WP of bottom, top and total (um), CPU time (s); NaN of a run that failed.
    numbers: [f64; 7],
    /// Middles and lengths (s) and pressures (Pa) of its steps.
    course: [Vec<f64>; 3],
}

impl Press {
    fn of([bond, drive, cell, cfl]: [&str; 4], keys: &str, folder: &Path) -> Result<Self> {
        let particles = folder.join(bond).display().to_string() + ".mpts";
        let label = format!("{bond}-{drive}-{cell}-{cfl}").replace(' ', "-");
        let keys = format!("{keys} grid.cell={cell}voxels integrator.cfl={cfl}");
        let method = keys.split(' ').fold(Method::implicit(), Method::setting);
        let (case, path) = (folder.join("case.toml"), folder.join(&label));
        let output = method.attempt(&case, &path, &["--particles", &particles])?;
        let run = Run { folder: path };
        let exit = output.status.code().unwrap_or(-1).to_string();
        let said = said(&output);
        println!("{label:<32} {said}");
        let name = [bond, drive, cell, cfl, &exit, &said].map(String::from);
        let mut press = Self {
            name,
            numbers: [f64::NAN; 7],
            course: Default::default(),
        };
        if output.status.success() {
            let [bottom, top, total] = run.ends(["wp_bottom_um", "wp_top_um", "wp_total_um"])?;
            let number = |key| run.summary(key).unwrap_or(f64::NAN);
            let [time, gap, pressure] = ["time_s", "gap_m", "final_pressure_pa"].map(number);
            press.numbers = [time, gap, pressure, bottom, top, total, run.cpu_s()];
            let [lengths, pressures] = run.columns(["dt_s", "pressure_top_Pa"])?;
            press.course = [run.history("time_s")?, lengths, pressures];
        }
        Ok(press)
    }

    /// Relative errors of WP of bottom, top and total, of the time or the gap at the end, one of which is given, of the final
    /// pressure, and the worst of the pressures of the first step, of those in which voids fill and of the others.
    fn errors(&self, fine: &Self) -> [f64; 8] {
        let of = |i: usize| self.numbers[i] / fine.numbers[i] - 1.0;
        let mut kinds = vec![Vec::new(); 3];
        for i in 0..self.course[0].len() {
            let [end, length, pressure] = [0, 1, 2].map(|column| self.course[column][i]);
            let at = |time| crossing(&fine.course[0], &fine.course[2], time);
            if let (Some(before), Some(now)) = (at(end - length), at(end)) {
                let later = if now > FILLING * before { 1 } else { 2 };
                kinds[later * usize::from(i > 0)].push(pressure / now - 1.0);
            }
        }
        kinds.push(vec![of(0), of(1)]);
        let worst = |i: usize| worst(kinds[i].iter().copied()).unwrap_or(f64::NAN);
        let [first, filling, others, end] = [0, 1, 2, 3].map(worst);
        [of(3), of(4), of(5), end, of(2), first, filling, others]
    }
}

/// The study, on the bonds so named; whether all runs ended well.
pub fn run(study: &Study) -> Result<bool> {
    let folder = study.folder();
    write(&folder.join("case.toml"), include_str!("case.toml"))?;
    let bonds = lines::read(include_str!("bonds.txt"), |line| {
        let (words, wood) = line.split_once(" | ")?;
        let here = |file: &str| Path::new(file).is_file();
        let here = |of: &Values| of.word("needs").is_none_or(here);
        let bond = |of: Values| (of.within(of.name), of.within(wood), here(&of));
        Some(Values::all(words).into_iter().map(bond).collect())
    });
    let (mut wanted, mut absent) = (Vec::new(), Vec::new());
    for (name, wood, here) in bonds.iter().filter(|bond| study.wants(&bond.0)) {
        if !here {
            absent.push(name.as_str());
            continue;
        }
        let path = folder.join(name.clone() + ".mpts");
        bond(&path, wood, "--plane 46.4um --slab 11.6um")?;
        for (i, [drive, keys]) in DRIVES.into_iter().enumerate() {
            let sizes = CELLS.into_iter().filter(|_| i == 0);
            let settings = sizes.chain(CFL.map(|cfl| ["2", cfl]));
            wanted.extend(settings.map(|[cell, cfl]| ([name, drive, cell, cfl], keys)));
        }
    }
    let all: Result<Vec<_>> = side_by_side(&wanted, |&(name, keys)| Press::of(name, keys, &folder));
    let all = all?;
    report::write(study, &all, &absent.join(", "))?;
    Ok(all.iter().all(|press| press.name[4] == "0"))
}
