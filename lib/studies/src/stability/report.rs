//! The table as CSV and as a page.

use std::fmt::Write;

use super::trial::{Row, Verdict};

impl Verdict {
    fn word(&self) -> &'static str {
        match self {
            Verdict::Stable => "stable",
            Verdict::Noisy => "noisy",
            Verdict::Refused(_) => "refused",
            Verdict::Stopped(_) => "stopped",
            Verdict::Broken(_) => "BROKEN",
        }
    }

    /// What was said.
    pub fn sentence(&self) -> &str {
        match self {
            Verdict::Stable | Verdict::Noisy => "",
            Verdict::Refused(said) | Verdict::Stopped(said) | Verdict::Broken(said) => said,
        }
    }
}

/// One field of a CSV row.
fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('"', "'"))
}

/// A number, or nothing where there is none.
fn number(x: f64) -> String {
    if x.is_finite() {
        format!("{x:.4e}")
    } else {
        String::new()
    }
}

/// The rows as CSV.
pub fn csv(rows: &[Row]) -> String {
    let mut out = String::from(
        "varied,value,method,cfl,verdict,part_computed,steps,cpu_s,energy_over_flow,travel_over_full_speed,J_min,J_max,lost_points,balance_error,sentence,warning\n",
    );
    for row in rows {
        let trial = &row.trial;
        // Writing to a string cannot fail.
        let _ = writeln!(
            out,
            "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}",
            quoted(trial.varied),
            quoted(&trial.value),
            quoted(&trial.method.label),
            trial.cfl,
            row.verdict.word(),
            number(row.part),
            number(row.steps),
            number(row.cpu_s),
            number(row.energy),
            number(row.travel),
            number(row.j[0]),
            number(row.j[1]),
            number(row.lost),
            number(row.balance),
            quoted(row.verdict.sentence()),
            quoted(&row.warning),
        );
    }
    out
}

/// The rows as a page; `head` says what made it.
pub fn page(rows: &[Row], head: &str) -> String {
    let mut out = format!("{INTRODUCTION}\n{head}\n");
    let _ = writeln!(out, "## In short\n");
    for verdict in ["stable", "noisy", "refused", "stopped", "BROKEN"] {
        let of = |scheme: &str| {
            let has = |row: &&Row| {
                row.verdict.word() == verdict && row.trial.method.scheme.name() == scheme
            };
            rows.iter().filter(has).count()
        };
        let _ = writeln!(
            out,
            "- {verdict}: {} explicit, {} implicit",
            of("explicit"),
            of("implicit")
        );
    }
    let mut heading = "";
    for row in rows {
        if row.trial.varied != heading {
            heading = row.trial.varied;
            let _ = writeln!(out, "\n## {heading}\n\n{HEADER}");
        }
        line(&mut out, row);
    }
    out
}

fn line(out: &mut String, row: &Row) {
    let trial = &row.trial;
    let short = |x: f64, digits: usize| {
        if x.is_finite() {
            format!("{x:.digits$}")
        } else {
            String::new()
        }
    };
    let mut note = row.verdict.sentence().to_owned();
    if row.part < 0.999 {
        let _ = write!(note, " (first {:.2e} of the motion only)", row.part);
    }
    if !row.warning.is_empty() {
        let said = row.warning.split(':').next().unwrap_or("");
        let _ = write!(note, " (warned: {said})");
    }
    let balance = if row.balance.is_finite() {
        format!("{:+.2e}", row.balance)
    } else {
        String::new()
    };
    let energy = if row.energy.is_finite() {
        format!("{:.2e}", row.energy)
    } else {
        String::new()
    };
    let j = if row.j[0].is_finite() {
        format!("{:.4} to {:.4}", row.j[0], row.j[1])
    } else {
        String::new()
    };
    let _ = writeln!(
        out,
        "| {} | {} | {} | {} | {} | {energy} | {} | {} | {} | {balance} | {} |",
        trial.value,
        trial.method.label,
        trial.cfl,
        row.verdict.word(),
        short(row.steps, 0),
        short(row.travel, 3),
        j,
        short(row.lost, 0),
        note.trim(),
    );
}

const HEADER: &str =
    "| value | method | CFL | ended | steps | energy | travel | J | lost | balance | said |
|---|---|---|---|---|---|---|---|---|---|---|";

const INTRODUCTION: &str = "# Stability on stiff and extreme cases

`make stability` runs small scenes (lib/studies/src/stability) through the real `mpm-run`: a slab of PF 16
cells wide and 4 thick, walls a quarter cell off the nodes, pressed at 1 m/s and at most 2.5 MPa into
a lumen of 6 cells by 1.5 cells of travel, and variations of it; sealed chambers; liquid torn apart;
drops. One value is varied at a time; sticking walls and CFL 0.5 unless said.

- *ended*: `stable`; `noisy`, when the run ended but its kinetic energy was at some time more than ten
  times that of the scene's own motion; `refused` (exit 2) and `stopped` (exit 1) with the
  sentence said; `BROKEN` would be a run that ended in values that are not numbers, in a signal or not
  at all, of which there must be none.
- *energy*: largest kinetic energy over that of all liquid at the speed of the scene's own motion (in
  the lumen, for a press).
- *travel*: how far the clamp moved over how far it would have at its closing speed; less than 1 where the
  pressure limit holds it back. Stable is not yet right: where the explicit scheme's travel stays near 0 and
  the implicit one's does not, the liquid has locked (explicit-options.md).
- *J*: smallest and largest volume ratio of the points at the end, from their pressures by Eq. 1.
- *lost*: points that left the domain or lie deeper than a point spacing in a wall.
- *balance*: difference of the mean forces on upper and lower body in the later half of the run over
  the larger of them, or over rho v^2 if that is more; for free drops the change of mean velocity
  over the speed.
- Explicit runs take at most 20,000 steps; where that is less than the scene's motion, the row says
  how much of it was computed. A balance of forces then is of the start-up, not of the flow.
";
