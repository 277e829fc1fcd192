//! The runs that are measured: synthetic specimens of the paper's wood, pressed for a few steps.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

use crate::Result;
use crate::outputs::{Run, synthetic_bond};
use crate::study::done;

/// One line of the page.
pub(super) struct Piece {
    /// Name of the specimen in tables and `ONLY=`.
    pub(super) size: &'static str,
    /// Case file of [`CASES`].
    pub(super) case: &'static str,
    /// Worker threads.
    pub(super) threads: usize,
    /// Runs, of which the median counts.
    pub(super) times: usize,
}

/// What is run, the cheap first.
pub(super) fn plan() -> Vec<Piece> {
    let plan = [
        ("small", "pf-implicit", 1, 3),
        ("medium", "pf-implicit", 1, 3),
        ("medium", "pva-pf-implicit", 1, 1),
        ("large", "pf-implicit", 1, 1),
        ("full", "pf-implicit", 1, 1),
        ("full", "pf-implicit", 2, 1),
        ("medium", "pf-flip", 1, 3),
        ("medium", "pf-xpic", 1, 3),
        ("medium", "pva-pf-flip", 1, 1),
        ("full", "pf-flip", 1, 1),
        ("full", "pf-xpic", 1, 1),
        ("full", "pf-xpic", 2, 1),
    ];
    let piece = |(size, case, threads, times)| Piece {
        size,
        case,
        threads,
        times,
    };
    plan.map(piece).into()
}

/// Folder of the case files.
const CASES: &str = "pipelines/cases";
/// Material points per cell of a bond whose cells are two voxels.
const POINTS_PER_CELL: f64 = 8.0;

/// What a step of a run costs.
#[derive(Clone, Debug)]
pub(super) struct Cost {
    pub(super) steps: f64,
    /// Material points.
    pub(super) points: f64,
    /// Processor seconds per step.
    pub(super) cpu_s: f64,
    /// Wall seconds per step.
    pub(super) wall_s: f64,
    /// Peak memory of the process, bytes.
    pub(super) memory: f64,
    /// Part of each stage in the time of the steps, by name.
    pub(super) stages: Vec<(String, f64)>,
}

impl Cost {
    /// Cells filled with liquid.
    pub(super) fn cells(&self) -> f64 {
        self.points / POINTS_PER_CELL
    }

    /// The one with the middle processor time.
    pub(super) fn median(mut list: Vec<Cost>) -> Cost {
        list.sort_by(|a, b| a.cpu_s.total_cmp(&b.cpu_s));
        list.swap_remove(list.len() / 2)
    }
}

impl Piece {
    /// Name in tables.
    pub(super) fn name(&self) -> String {
        format!("{} {} {}", self.size, self.case, self.threads)
    }

    /// What a step costs by the build in a folder: the part of the run's processor time that its stages take of the
    /// clock, so that neither start nor end counts.
    pub(super) fn cost(&self, bin: &Path, bond: &Path, folder: &Path) -> Result<Cost> {
        let start = Instant::now();
        let run = self.press(bin, bond, folder)?;
        let elapsed = start.elapsed().as_secs_f64();
        let number = |key: &str| {
            let value = run.summary(key);
            value.ok_or_else(|| format!("summary.json of {} has no {key}", run.folder.display()))
        };
        let stages = run.summary_value("stages");
        let stages = stages.as_ref().and_then(|list| list.as_array());
        let stage = |item: &serde_json::Value| {
            Some((item["name"].as_str()?.to_owned(), item["wall_s"].as_f64()?))
        };
        let stages: Vec<(String, f64)> = stages.into_iter().flatten().filter_map(stage).collect();
        let whole: f64 = stages.iter().map(|s| s.1).sum();
        let steps = number("steps")?;
        Ok(Cost {
            steps,
            points: number("liquid_points")?,
            cpu_s: number("cpu_s")? * whole / elapsed / steps,
            wall_s: whole / steps,
            memory: number("peak_memory_bytes")?,
            stages: (stages.into_iter())
                .map(|(name, s)| (name, s / whole))
                .collect(),
        })
    }

    fn press(&self, bin: &Path, bond: &Path, folder: &Path) -> Result<Run> {
        // A few steps by either scheme; an older build takes the same case, so the same Courant number, but may know no cells in
        // voxels.
        let [case, own] =
            [Path::new(CASES), folder].map(|at| at.join(format!("{}.toml", self.case)));
        let text = fs::read_to_string(&case).map_err(|e| format!("{}: {e}", case.display()))?;
        fs::write(&own, text.replace("2 voxels", "2.9 um"))
            .map_err(|e| format!("{}: {e}", own.display()))?;
        let until_us = if self.case.ends_with("implicit") {
            12.0
        } else {
            0.1
        };
        let run = folder.join("run");
        let mut command = Command::new(bin.join("mpm-run"));
        command.arg(&own);
        command.arg("--particles").arg(bond).arg("-o").arg(&run);
        command.args(["--overwrite", "--quiet", "--set", "output.snapshots=0"]);
        command.args(["--threads", &self.threads.to_string()]);
        command.args(["--set", &format!("clamp.time_limit=\"{until_us} us\"")]);
        done(&mut command).map_err(|said| format!("{}: {said}", self.name()))?;
        Ok(Run { folder: run })
    }
}

/// The bond file of a size; made once, by this build.
pub(super) fn specimen(size: &str, folder: &Path) -> Result<PathBuf> {
    // Voxels along x, y, z, and the thickness of the adhesive.
    let (voxels, slab) = match size {
        "small" => ("40x96x40", "14.5 um"),
        "medium" => ("100x394x100", "55.1 um"),
        "large" => ("200x394x200", "55.1 um"),
        _ => ("394x394x400", "55.1 um"),
    };
    let path = folder.join(format!("{size}.mpts"));
    synthetic_bond(&path, voxels, slab)?;
    Ok(path)
}
