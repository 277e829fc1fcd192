//! The runs that are measured: synthetic specimens of the paper's wood, pressed for a few steps.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

use crate::outputs::{Run, bin_folder};
use crate::study::{ended, said};

/// A specimen: its name, and what `synth-xct` makes it of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Size {
    /// In tables and `ONLY=`.
    pub name: &'static str,
    /// Voxels along x, y, z.
    pub voxels: &'static str,
    /// Thickness of the adhesive.
    pub slab: &'static str,
}

const SMALL: Size = Size {
    name: "small",
    voxels: "40x96x40",
    slab: "14.5 um",
};
const MEDIUM: Size = Size {
    name: "medium",
    voxels: "100x394x100",
    slab: "55.1 um",
};
const LARGE: Size = Size {
    name: "large",
    voxels: "200x394x200",
    slab: "55.1 um",
};
const FULL: Size = Size {
    name: "full",
    voxels: "394x394x400",
    slab: "55.1 um",
};

/// One line of the page.
#[derive(Clone, Copy, Debug)]
pub struct Piece {
    /// The specimen.
    pub size: Size,
    /// Case file of [`CASES`].
    pub case: &'static str,
    /// Worker threads.
    pub threads: usize,
    /// Time of the clamp that is pressed for, us.
    pub until_us: f64,
    /// Runs, of which the median counts.
    pub times: usize,
}

impl Piece {
    /// Name in tables.
    pub fn name(&self) -> String {
        format!("{} {} {}", self.size.name, self.case, self.threads)
    }
}

/// A few steps by either scheme; an older build takes the same case file, so the same Courant number.
const IMPLICIT_US: f64 = 12.0;
const EXPLICIT_US: f64 = 0.1;

const fn piece(
    size: Size,
    case: &'static str,
    until_us: f64,
    threads: usize,
    times: usize,
) -> Piece {
    Piece {
        size,
        case,
        threads,
        until_us,
        times,
    }
}

/// What is run, the cheap first.
pub const PLAN: [Piece; 12] = [
    piece(SMALL, "pf-implicit", IMPLICIT_US, 1, 3),
    piece(MEDIUM, "pf-implicit", IMPLICIT_US, 1, 3),
    piece(MEDIUM, "pva-pf-implicit", IMPLICIT_US, 1, 1),
    piece(LARGE, "pf-implicit", IMPLICIT_US, 1, 1),
    piece(FULL, "pf-implicit", IMPLICIT_US, 1, 1),
    piece(FULL, "pf-implicit", IMPLICIT_US, 2, 1),
    piece(MEDIUM, "pf-flip", EXPLICIT_US, 1, 3),
    piece(MEDIUM, "pf-xpic", EXPLICIT_US, 1, 3),
    piece(MEDIUM, "pva-pf-flip", EXPLICIT_US, 1, 1),
    piece(FULL, "pf-flip", EXPLICIT_US, 1, 1),
    piece(FULL, "pf-xpic", EXPLICIT_US, 1, 1),
    piece(FULL, "pf-xpic", EXPLICIT_US, 2, 1),
];

/// Folder of the case files.
const CASES: &str = "pipelines/cases";
/// Material points per cell of a bond whose cells are two voxels.
const POINTS_PER_CELL: f64 = 8.0;

/// What a step of a run costs; of a run, before it is divided.
#[derive(Clone, Debug)]
pub struct Cost {
    /// Steps.
    pub steps: f64,
    /// Material points.
    pub points: f64,
    /// Processor seconds per step.
    pub cpu_s: f64,
    /// Wall seconds per step.
    pub wall_s: f64,
    /// Peak memory of the process, bytes.
    pub memory: f64,
    /// Part of each stage in the time of the steps, by name.
    pub stages: Vec<(String, f64)>,
}

impl Cost {
    /// Cells filled with liquid.
    pub fn cells(&self) -> f64 {
        self.points / POINTS_PER_CELL
    }

    /// The one with the middle processor time.
    pub fn median(mut list: Vec<Cost>) -> Cost {
        list.sort_by(|a, b| a.cpu_s.total_cmp(&b.cpu_s));
        list.swap_remove(list.len() / 2)
    }
}

/// A build of the tools.
pub struct Program {
    bin: PathBuf,
}

impl Program {
    /// This build.
    pub fn own() -> Self {
        Self { bin: bin_folder() }
    }

    /// The one in a folder.
    pub fn at(bin: PathBuf) -> Self {
        Self { bin }
    }

    /// What a step of a piece costs: the part of the run's processor time that its stages take of the
    /// clock, so that neither start nor end counts.
    ///
    /// # Errors
    /// What `mpm-run` said.
    pub fn cost(&self, piece: &Piece, bond: &Path, folder: &Path) -> Result<Cost, String> {
        let start = Instant::now();
        let run = self.press(piece, bond, folder)?;
        let elapsed = start.elapsed().as_secs_f64();
        let whole: f64 = run.stages.iter().map(|s| s.1).sum();
        Ok(Cost {
            cpu_s: run.cpu_s * whole / elapsed / run.steps,
            wall_s: whole / run.steps,
            stages: run
                .stages
                .into_iter()
                .map(|(n, s)| (n, s / whole))
                .collect(),
            ..run
        })
    }

    /// The run: sums, not per step.
    fn press(&self, piece: &Piece, bond: &Path, folder: &Path) -> Result<Cost, String> {
        let run = folder.join("run");
        let mut command = Command::new(self.bin.join("mpm-run"));
        command.arg(format!("{CASES}/{}.toml", piece.case));
        command.arg("--particles").arg(bond).arg("-o").arg(&run);
        command.args(["--overwrite", "--quiet", "--threads"]);
        command.arg(piece.threads.to_string());
        for change in [
            format!("clamp.time_limit=\"{} us\"", piece.until_us),
            "output.snapshots=0".into(),
        ] {
            command.args(["--set", &change]);
        }
        let output = ended(&mut command)?;
        if !output.status.success() {
            return Err(format!("{}: {}", piece.name(), said(&output)));
        }
        read(&Run { folder: run })
    }
}

/// The sums of a run that ended.
fn read(run: &Run) -> Result<Cost, String> {
    let number = |key: &str| {
        let value = run.summary(key);
        value.ok_or_else(|| format!("summary.json of {} has no {key}", run.folder.display()))
    };
    let text = std::fs::read_to_string(run.folder.join("summary.json")).unwrap_or_default();
    let list = text.split("\"stages\":").nth(1).unwrap_or_default();
    let list = list.split(']').next().unwrap_or_default();
    let stages = list.split('{').skip(1).filter_map(|item| {
        let name = item.split('"').nth(3)?.to_owned();
        let seconds = item.split("\"wall_s\":").nth(1)?;
        let seconds = seconds.trim().trim_end_matches([',', '\n', ' ', '}']);
        Some((name, seconds.trim().parse().ok()?))
    });
    Ok(Cost {
        steps: number("steps")?,
        points: number("liquid_points")?,
        cpu_s: number("cpu_s")?,
        wall_s: number("stepping_wall_s")?,
        memory: number("peak_memory_bytes")?,
        stages: stages.collect(),
    })
}

/// The bond file of a size; made once, by this build.
///
/// # Errors
/// What a tool said.
pub fn specimen(size: &Size, folder: &Path) -> Result<PathBuf, String> {
    std::fs::create_dir_all(folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    let bond = folder.join(format!("{}.mpts", size.name));
    let bin = bin_folder();
    let bin = bin.display();
    let synth = format!(
        "\"{bin}/synth-xct\" -q --adhesive pf --voxel '1.45 um' --seed 1 --size {} --slab '{}' -o -",
        size.voxels, size.slab
    );
    let pipe = format!(
        "set -o pipefail; {synth} | \"{bin}/xct2particles\" -q - -o - | \"{bin}/build-bondline\" -q - -o '{}'",
        bond.display()
    );
    let output = ended(Command::new("bash").args(["-c", &pipe]))?;
    if output.status.success() {
        return Ok(bond);
    }
    Err(said(&output))
}
