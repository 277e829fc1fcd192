//! `stability.csv` and `stability.md`.

use super::trial::{Row, Verdict};
use crate::Result;
use crate::method::Scheme;
use crate::study::{Study, distinct, table};

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
    fn sentence(&self) -> &str {
        match self {
            Verdict::Stable | Verdict::Noisy => "",
            Verdict::Refused(said) | Verdict::Stopped(said) | Verdict::Broken(said) => said,
        }
    }
}

/// A number, or nothing where there is none.
fn number(x: f64) -> String {
    if x.is_finite() {
        format!("{x:.4e}")
    } else {
        String::new()
    }
}

const COLUMNS: &str = "varied,value,method,cfl,verdict,part_computed,steps,cpu_s,energy_over_flow,\
travel_over_full_speed,J_min,J_max,lost_points,balance_error,sentence,warning";

/// Writes the table and the page, which ends with `more`.
pub(super) fn write(study: &Study, rows: &[Row], more: &str) -> Result<()> {
    let fields = rows.iter().map(|row| {
        let trial = &row.trial;
        let (cfl, verdict) = (trial.cfl.to_string(), row.verdict.word());
        let head = [
            trial.varied,
            &trial.value,
            &trial.method.label,
            &cfl,
            verdict,
        ];
        let numbers = [row.part, row.steps, row.cpu_s, row.energy, row.travel];
        let ends = [row.j[0], row.j[1], row.lost, row.balance];
        let said = [row.verdict.sentence(), &row.warning].map(String::from);
        let numbers = numbers.into_iter().chain(ends).map(number);
        (head.map(String::from).into_iter().chain(numbers))
            .chain(said)
            .collect()
    });
    study.write_csv("stability.csv", COLUMNS, fields)?;
    let head = study.head(rows.iter().map(|row| row.cpu_s));
    study.write("stability.md", page(rows, &head) + more)
}

/// A line for the terminal.
pub(super) fn said(row: &Row) -> String {
    let trial = &row.trial;
    format!(
        "{:<22} {:<30} {:<9} {:>5} {:?} energy {:.2e} J {:.3} to {:.3} balance {:+.1e} {:.1} s",
        trial.varied,
        trial.value,
        trial.method.label,
        trial.cfl,
        row.verdict,
        row.energy,
        row.j[0],
        row.j[1],
        row.balance,
        row.cpu_s
    )
}

/// The page; `head` says what made it.
fn page(rows: &[Row], head: &str) -> String {
    let mut out = format!("{INTRODUCTION}\n{head}\n");
    summary(&mut out, rows);
    not_stable(&mut out, rows);
    closing(&mut out, rows);
    out
}

/// How many runs ended how, for each quantity varied.
fn summary(out: &mut String, rows: &[Row]) {
    let words = ["stable", "noisy", "refused", "stopped", "BROKEN"];
    let line = |name: &str, of: &dyn Fn(&Row) -> bool| {
        let own: Vec<&Row> = rows.iter().filter(|row| of(row)).collect();
        let count = |word| own.iter().filter(|row| row.verdict.word() == word).count();
        let counts = words.map(|word| count(word).to_string());
        format!("| {name} | {} |", counts.join(" | "))
    };
    let varied = distinct(rows.iter().map(|row| row.trial.varied)).into_iter();
    let varied = varied.map(|varied| line(varied, &|row| row.trial.varied == varied));
    let schemes = Scheme::ALL.map(|scheme| {
        let name = format!("**all {}**", scheme.name());
        line(&name, &|row| row.trial.method.scheme == scheme)
    });
    let heads = format!("| varied | {} |", words.join(" | "));
    *out += "## In short\n\n";
    *out += &table(&heads, varied.chain(schemes));
}

/// A row for each value at which methods ended in the same word, but for the stable ones.
fn not_stable(out: &mut String, rows: &[Row]) {
    let unstable = rows.iter().filter(|row| row.verdict != Verdict::Stable);
    let rows: Vec<&Row> = unstable.collect();
    let kind = |row: &Row| {
        let (varied, value) = (row.trial.varied, row.trial.value.clone());
        (varied, value, row.verdict.word())
    };
    let line = |of: (&str, String, &str)| {
        let same: Vec<&&Row> = rows.iter().filter(|row| kind(row) == of).collect();
        let methods = same.iter().map(|row| row.trial.method.label.as_str());
        let methods = methods.collect::<Vec<_>>().join(", ");
        let ((varied, value, ended), sentence) = (of, same[0].verdict.sentence());
        format!("| {varied} | {value} | {ended} | {methods} | {sentence} |")
    };
    let kinds = distinct(rows.iter().map(|row| kind(row)));
    let heads = "| varied | value | ended | methods | said by the first |";
    *out += "\n## Not stable\n\n";
    *out += &table(heads, kinds.into_iter().map(line));
}

/// How far the clamp of a press closes where the pressure limit holds it back.
fn closing(out: &mut String, rows: &[Row]) {
    let methods = ["FLIP", "XPIC(5)", "APIC", "APIC, cell mean", "implicit"];
    let press = |row: &Row| (row.trial.varied, row.trial.value.clone());
    let locking = |row: &&Row| LOCKING.contains(&row.trial.varied);
    let rows: Vec<&Row> = rows.iter().filter(locking).collect();
    let line = |of: (&str, String)| {
        let travel = |label| {
            let own = |row: &&&Row| press(row) == of && row.trial.method.label == label;
            let found = rows.iter().find(own);
            found.map_or(String::new(), |row| format!("{:.3}", row.travel))
        };
        let (travels, (varied, value)) = (methods.map(travel).join(" | "), &of);
        format!("| {varied} {value} | {travels} |")
    };
    let presses = distinct(rows.iter().map(|row| press(row)));
    let heads = format!("| press | {} |", methods.join(" | "));
    *out += CLOSING;
    *out += &table(&heads, presses.into_iter().map(line));
}

/// What is varied where the explicit scheme locks.
const LOCKING: [&str; 3] = ["bulk modulus", "lumen width", "slab thickness"];

const CLOSING: &str = "
## How far a press closes

Travel of the clamp over that at its closing speed; less than 1 where the pressure limit of 2.5 MPa holds it back. Where the explicit
scheme's stays near 0 and the implicit one's does not, the liquid has locked (explicit-options.md).

";

const INTRODUCTION: &str = "# Stability on stiff and extreme cases

`make stability` runs small scenes (lib/studies/src/stability) through the real `mpm-run`: a slab of PF 16
cells wide and 4 thick, walls a quarter and half a cell off the nodes, pressed at 1 m/s and at most 2.5 MPa into
a lumen of 6 cells by 1.5 cells of travel, and variations of it; sealed chambers; liquid torn apart;
drops. One value is varied at a time; sticking walls and CFL 0.5 unless said. A run ends `stable`;
`noisy`, when its kinetic energy was at some time more than ten times that of the scene's own motion; `refused`
(exit 2) and `stopped` (exit 1) with a sentence; `BROKEN` would be a run that ended in values that
are not numbers, in a signal or not at all, of which there must be none. All runs are in
[stability.csv](stability.csv), where

- `part_computed` is the part of the scene's motion that was computed: explicit runs take at most 20,000 steps; a balance of
  forces then is of the start-up, not of the flow;
- `energy_over_flow` is the largest kinetic energy over that of all liquid at the speed of the scene's own motion (in the lumen, for a press);
- `travel_over_full_speed` is how far the clamp moved over how far it would have at its closing speed;
- `J_min` and `J_max` are the volume ratios of the points at the end, from their pressures by Eq. 1;
- `lost_points` left the domain or lie deeper than a point spacing in a wall;
- `balance_error` is the difference of the mean forces on upper and lower body in the later half of the run over
  the larger of them, or over rho v^2 if that is more; for free drops the change of mean velocity over the speed.
";
