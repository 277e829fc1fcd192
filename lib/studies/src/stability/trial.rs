//! One run: how it ended and what it kept.

use std::path::{Path, PathBuf};
use std::process::Output;

use super::scenes::{Balance, Scene};
use crate::Result;
use crate::case_text::{PF, Viscosity};
use crate::method::{Method, Scheme};
use crate::numbers::{largest, mean, range};
use crate::outputs::{Point, Run};
use crate::study::{said, write};

/// Tait constant of paper Eq. 1.
const TAIT_C: f64 = 0.0894;
/// Explicit steps of a trial at most: where more would be needed, the row says so.
const MOST_STEPS: f64 = 20_000.0;
/// Kinetic energy over that of the scene's own motion from which a run that ended counts as
/// noisy: the speeds of the points are then noise, not flow.
const NOISY: f64 = 10.0;

/// A scene by a method.
#[derive(Clone, Debug)]
pub(super) struct Trial {
    /// What is varied, e.g. "viscosity".
    pub(super) varied: &'static str,
    pub(super) value: String,
    pub(super) scene: Scene,
    pub(super) method: Method,
    pub(super) cfl: f64,
}

/// How a trial ended: its energy is that of the flow, or mostly noise; not accepted; with exit status 1; or in any other way,
/// a fault of the program.
pub(super) const ENDS: [&str; 5] = ["stable", "noisy", "refused", "stopped", "BROKEN"];

/// A row of the table.
#[derive(Clone, Debug)]
pub(super) struct Row {
    pub(super) trial: Trial,
    /// How it ended, one of [`ENDS`], and what was said.
    pub(super) verdict: &'static str,
    pub(super) sentence: String,
    /// What was computed of the scene's motion, 1 for all of it.
    pub(super) part: f64,
    /// Steps and CPU seconds; NaN if it did not end.
    pub(super) steps: f64,
    pub(super) cpu_s: f64,
    /// Largest kinetic energy over that of the scene's own motion.
    pub(super) energy: f64,
    /// Smallest and largest J at the end.
    pub(super) j: [f64; 2],
    /// Points lost through sides, or inside bodies deeper than a point spacing.
    pub(super) lost: f64,
    /// What a clamped body has moved over what it would have at its closing speed.
    pub(super) travel: f64,
    /// Error of the balance, see [`Balance`].
    pub(super) balance: f64,
    /// Warnings, first sentence.
    pub(super) warning: String,
}

/// rho h^2 / (8 eta) and h / c, the shorter times `cfl`: the explicit step.
fn explicit_step(scene: &Scene, cfl: f64) -> f64 {
    let eta = match &scene.case.viscosity {
        Viscosity::Newtonian(eta) => *eta,
        Viscosity::Table(rows) => rows.iter().map(|r| r[1]).fold(f64::INFINITY, f64::min),
        // By the implicit scheme alone.
        Viscosity::Law(_) => f64::INFINITY,
    };
    let h = scene.case.cell;
    let sound = (scene.case.bulk_modulus / PF[0]).sqrt();
    cfl * (h / (sound + scene.speed)).min(PF[0] * h * h / (8.0 * eta))
}

impl Trial {
    /// Name of its files.
    fn name(&self) -> String {
        let plain = |text: &str| {
            text.replace(
                |c: char| !c.is_ascii_alphanumeric() && !".-".contains(c),
                "_",
            )
        };
        let (varied, value) = (plain(self.varied), plain(&self.value));
        format!(
            "{varied}-{value}-{}-cfl{}",
            self.method.file_label(),
            self.cfl
        )
    }

    /// Runs it, with case and run folder below `folder`.
    pub(super) fn run(self, folder: &Path) -> Result<Row> {
        let whole = self.scene.duration;
        let seconds = match self.method.scheme {
            Scheme::Explicit => whole.min(MOST_STEPS * explicit_step(&self.scene, self.cfl)),
            Scheme::Implicit => whole,
        };
        let case = folder.join(format!("{}.toml", self.name()));
        let out = folder.join(self.name());
        let integrator = self.method.scheme.integrator();
        write(&case, self.scene.lasting(seconds).text(integrator))?;
        let cfl = format!("integrator.cfl={}", self.cfl);
        let ended = self.method.attempt(&case, &out, &["--set", &cfl]);
        Ok(self.judge(ended, out, seconds / whole))
    }

    fn judge(self, ended: Result<Output>, folder: PathBuf, part: f64) -> Row {
        let said = ended.as_ref().map_or(String::new(), said);
        let warning = said.lines().find(|l| l.starts_with("warning"));
        let sentence = || {
            let last = said.lines().last().unwrap_or("").trim();
            last.strip_prefix("mpm-run: ").unwrap_or(last).to_owned()
        };
        let mut row = Row {
            verdict: "",
            sentence: String::new(),
            part,
            steps: f64::NAN,
            cpu_s: f64::NAN,
            energy: f64::NAN,
            j: [f64::NAN; 2],
            lost: f64::NAN,
            travel: f64::NAN,
            balance: f64::NAN,
            warning: (warning.unwrap_or(""))
                .trim_start_matches("warning: ")
                .to_owned(),
            trial: self,
        };
        let measured = row.measure(&Run { folder });
        let [stable, noisy, refused, stopped, broken] = ENDS;
        let code = ended.map(|output| output.status.code());
        (row.verdict, row.sentence) = match (code, measured) {
            (Ok(Some(0)), Ok(())) if row.energy > NOISY => (noisy, String::new()),
            (Ok(Some(0)), Ok(())) => (stable, String::new()),
            (Ok(Some(0)), Err(said)) => (broken, format!("ended, but {said}")),
            (Ok(Some(1)), _) => (stopped, sentence()),
            (Ok(Some(2)), _) => (refused, sentence()),
            (Ok(code), _) => (broken, format!("exit {code:?}: {}", sentence())),
            (Err(said), _) => (broken, said.to_string()),
        };
        row
    }
}

impl Row {
    /// Reads what the run left; NaN anywhere is an error.
    fn measure(&mut self, run: &Run) -> Result<()> {
        let energy = run.history("kinetic_energy_J")?;
        if energy.iter().any(|e| !e.is_finite()) {
            return Err("its history has an energy that is not a number".into());
        }
        let volume = run.history("adhesive_volume_m3")?;
        let scene = &self.trial.scene;
        // The volume of the first row: the liquid has hardly been compressed yet.
        let mass = PF[0] * volume.first().copied().unwrap_or(f64::NAN);
        let own = 0.5 * mass * scene.speed.powi(2);
        self.energy = largest(energy.into_iter()) / own;
        let [lost, moved] = run.ends(["lost_particles", "displacement_m"])?;
        self.lost = lost + run.summary("points_deep_in_wood").unwrap_or(0.0);
        self.steps = run.summary("steps").unwrap_or(f64::NAN);
        self.cpu_s = run.cpu_s();
        if scene.travel > 0.0 {
            self.travel = moved / (scene.travel * self.part);
        }
        self.balance = balance(run, scene)?;
        self.j = volume_ratios(run, scene)?;
        Ok(())
    }
}

/// Error of what the scene balances.
fn balance(run: &Run, scene: &Scene) -> Result<f64> {
    match scene.balance {
        Balance::None => Ok(f64::NAN),
        Balance::Forces => {
            let columns = run.columns(["pressure_bottom_Pa", "pressure_top_Pa"])?;
            let late = |list: Vec<f64>| mean(list[list.len() / 2..].iter().copied());
            let [bottom, top] = columns.map(late);
            // What turning a stream of the scene's speed takes: forces may differ by it.
            let inertia = PF[0] * scene.speed.powi(2);
            Ok((top - bottom) / top.abs().max(bottom.abs()).max(inertia))
        }
        Balance::Momentum(start) => {
            let points = run.points()?;
            let off = |a: usize| mean(points.iter().map(|p| p.velocity[a])) - start[a];
            Ok(off(0).hypot(off(1)) / scene.speed)
        }
    }
}

/// Smallest and largest J of the final state, from the pressures by Eq. 1.
fn volume_ratios(run: &Run, scene: &Scene) -> Result<[f64; 2]> {
    let scale = TAIT_C * scene.case.bulk_modulus;
    let points = run.points()?;
    if points.iter().any(|p| !p.pressure.is_finite()) {
        return Err("its final state has a pressure that is not a number".into());
    }
    let ratio = |p: &Point| 1.0 - TAIT_C * (p.pressure / scale).ln_1p();
    Ok(range(points.iter().map(ratio)))
}
