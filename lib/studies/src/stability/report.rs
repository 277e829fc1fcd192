//! `stability.csv` and `stability.md`.

use super::trial::{ENDS, Row};
use crate::Result;
use crate::method::Scheme;
use crate::study::{Study, distinct, filled, table};

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

/// Writes the table and the page with the table of what was `unstable`.
pub(super) fn write(study: &Study, rows: &[Row], unstable: &str) -> Result<()> {
    let fields = rows.iter().map(|row| {
        let trial = &row.trial;
        let (method, cfl) = (&trial.method.label, trial.cfl.to_string());
        let head = [trial.varied, &trial.value, method, &cfl, row.verdict];
        let numbers = [row.part, row.steps, row.cpu_s, row.energy, row.travel];
        let ends = [row.j[0], row.j[1], row.lost, row.balance];
        let said = [row.sentence.clone(), row.warning.clone()];
        let numbers = numbers.into_iter().chain(ends).map(number);
        (head.map(String::from).into_iter().chain(numbers))
            .chain(said)
            .collect()
    });
    study.write_csv("stability.csv", COLUMNS, fields)?;
    let head = study.head(rows.iter().map(|row| row.cpu_s));
    study.write("stability.md", page(rows, &head, unstable))
}

/// A line for the terminal.
pub(super) fn said(row: &Row) -> String {
    let trial = &row.trial;
    let (varied, value, method, cfl) = (trial.varied, &trial.value, &trial.method.label, trial.cfl);
    let (verdict, sentence, [low, high]) = (row.verdict, &row.sentence, row.j);
    let (energy, balance, cpu_s) = (row.energy, row.balance, row.cpu_s);
    format!(
        "{varied:<22} {value:<30} {method:<9} {cfl:>5} {verdict} {sentence} energy {energy:.2e} J {low:.3} to {high:.3} balance {balance:+.1e} {cpu_s:.1} s"
    )
}

/// The page; `head` says what made it.
fn page(rows: &[Row], head: &str, unstable: &str) -> String {
    let values = [
        ("head", head),
        ("summary", &summary(rows)),
        ("not_stable", &not_stable(rows)),
        ("closing", &closing(rows)),
        ("instability", unstable),
    ];
    filled(include_str!("page.txt"), &values)
}

/// How many runs ended how, for each quantity varied.
fn summary(rows: &[Row]) -> String {
    let line = |name: &str, of: &dyn Fn(&Row) -> bool| {
        let own: Vec<&Row> = rows.iter().filter(|row| of(row)).collect();
        let count = |word| own.iter().filter(|row| row.verdict == word).count();
        let counts = ENDS.map(|word| count(word).to_string());
        format!("| {name} | {} |", counts.join(" | "))
    };
    let varied = distinct(rows.iter().map(|row| row.trial.varied)).into_iter();
    let varied = varied.map(|varied| line(varied, &|row| row.trial.varied == varied));
    let schemes = Scheme::ALL.map(|scheme| {
        let name = format!("**all {}**", scheme.name());
        line(&name, &|row| row.trial.method.scheme == scheme)
    });
    let heads = format!("| varied | {} |", ENDS.join(" | "));
    table(&heads, varied.chain(schemes))
}

/// A row for each value at which methods ended in the same word, but for the stable ones.
fn not_stable(rows: &[Row]) -> String {
    let unstable = rows.iter().filter(|row| row.verdict != ENDS[0]);
    let rows: Vec<&Row> = unstable.collect();
    let kind = |row: &Row| {
        let (varied, value) = (row.trial.varied, row.trial.value.clone());
        (varied, value, row.verdict)
    };
    let line = |of: (&str, String, &str)| {
        let same: Vec<&&Row> = rows.iter().filter(|row| kind(row) == of).collect();
        let methods = same.iter().map(|row| row.trial.method.label.as_str());
        let methods = methods.collect::<Vec<_>>().join(", ");
        let ((varied, value, ended), sentence) = (of, &same[0].sentence);
        format!("| {varied} | {value} | {ended} | {methods} | {sentence} |")
    };
    let kinds = distinct(rows.iter().map(|row| kind(row)));
    let heads = "| varied | value | ended | methods | message of the first |";
    table(heads, kinds.into_iter().map(line))
}

/// How far the clamp of a press closes where the pressure limit holds it back.
fn closing(rows: &[Row]) -> String {
    let methods = ["FLIP", "XPIC(5)", "APIC", "APIC, cell mean", "implicit"];
    let press = |row: &Row| (row.trial.varied, row.trial.value.clone());
    let locking = |row: &&Row| LOCKING.contains(&row.trial.varied);
    let rows: Vec<&Row> = rows.iter().filter(locking).collect();
    let line = |of: (&str, String)| {
        let travel = |label| {
            let own = |row: &&&Row| press(row) == of && row.trial.method.label == label;
            let found = rows.iter().find(own).filter(|row| row.travel.is_finite());
            found.map_or(String::new(), |row| format!("{:.3}", row.travel))
        };
        let (travels, (varied, value)) = (methods.map(travel).join(" | "), &of);
        format!("| {varied} {value} | {travels} |")
    };
    let presses = distinct(rows.iter().map(|row| press(row)));
    let heads = format!("| press | {} |", methods.join(" | "));
    table(&heads, presses.into_iter().map(line))
}

/// What is varied where the explicit scheme locks.
const LOCKING: [&str; 3] = ["bulk modulus", "lumen width", "slab thickness"];
