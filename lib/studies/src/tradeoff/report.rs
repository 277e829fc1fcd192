//! Results of the trade-off study: a CSV, a figure, a page, and the table that `mpm-run
//! --explain` quotes from.

use std::fmt::Write as _;

use figures::{Mark, Plot};

use super::{Flow, Row};
use crate::Result;
use crate::method::{Method, Scheme};
use crate::study::{PAGE, Study, filled, table};
use crate::verification::report::percent;

/// Where `mpm-run --explain` finds what it quotes.
const QUOTED: &str = "lib/run/src/expected_error.csv";

/// Writes `tradeoff.csv`, `tradeoff.md`, the figures and, after the whole study, the table of
/// expected errors.
pub(super) fn write(study: &Study, rows: &[Row], head: &str) -> Result<()> {
    let columns = "flow,scheme,method,varied,cells,set,error,cpu_s,pareto,failed";
    study.write_csv("tradeoff.csv", columns, rows.iter().map(fields))?;
    for (flow, name) in [(Flow::Slit, "slit"), (Flow::BondPressure, "bond")] {
        let drawing = plot(rows, flow).draw(PAGE);
        study.draw(&format!("tradeoff-{name}.png"), drawing)?;
    }
    study.write("tradeoff.md", page(rows, head))?;
    if study.whole() {
        std::fs::write(QUOTED, expected(rows)).map_err(|e| format!("{QUOTED}: {e}"))?;
    }
    Ok(())
}

fn fields(r: &Row) -> Vec<String> {
    let method = &r.setting.method;
    vec![
        r.flow.name().into(),
        method.scheme.name().into(),
        method.label.clone(),
        r.setting.varied.into(),
        r.setting.cells.to_string(),
        method.set.join(" "),
        format!("{:.4e}", r.error),
        format!("{:.2}", r.cpu_s),
        r.pareto.to_string(),
        r.failed.clone().unwrap_or_default(),
    ]
}

fn plot(rows: &[Row], flow: Flow) -> Plot {
    let of = |wanted: &dyn Fn(&Row) -> bool| -> Vec<[f64; 2]> {
        let own = rows
            .iter()
            .filter(|r| r.flow == flow && r.error.is_finite());
        let mut points: Vec<[f64; 2]> = (own.filter(|r| wanted(r)))
            .map(|r| [r.cpu_s.max(0.01), 100.0 * r.error])
            .collect();
        points.sort_by(|a, b| a[0].total_cmp(&b[0]));
        points
    };
    let title = format!("Error against CPU time: {}", flow.name());
    let mut plot = Plot::new(&title, "CPU time of a run (s)", "error (%)")
        .logarithmic([true, true])
        .with("Pareto front", Mark::Line, of(&|r| r.pareto));
    for name in ["FLIP", "PIC", "APIC", "XPIC", "FMPM", "implicit"] {
        let first = |label: &str| label.split([',', '(']).next() == Some(name);
        let points = of(&|r: &Row| first(&r.setting.method.label));
        if !points.is_empty() {
            plot = plot.with(name, Mark::Dots, points);
        }
    }
    plot
}

fn page(rows: &[Row], head: &str) -> String {
    let values = [
        ("head", head),
        ("cheapest", &*cheapest(rows)),
        ("front", &front(rows)),
    ];
    filled(include_str!("page.txt"), &values) + &failed(rows)
}

/// For each accuracy the cheapest setting of the flows that count, from the rows themselves.
fn cheapest(rows: &[Row]) -> String {
    let mut lines = Vec::new();
    for flow in [Flow::Slit, Flow::Channel, Flow::BondPressure, Flow::BondWp] {
        for goal in [0.3, 0.1, 0.05, 0.02] {
            let cheapest = |explicit: bool| {
                let good = rows.iter().filter(|r| {
                    let scheme = r.setting.method.scheme;
                    r.flow == flow && r.error <= goal && (!explicit || scheme == Scheme::Explicit)
                });
                let best = good.min_by(|a, b| a.cpu_s.total_cmp(&b.cpu_s));
                best.map_or("none | ".to_owned(), |r| {
                    format!("{} | {:.2}", r.setting.method.label, r.cpu_s)
                })
            };
            let (flow, percent) = (flow.name(), 100.0 * goal);
            let (any, explicit) = (cheapest(false), cheapest(true));
            lines.push(format!("| {flow} | {percent:.0} % | {any} | {explicit} |"));
        }
    }
    let heads = "| flow | error | cheapest | CPU (s) | cheapest explicit | CPU (s) |";
    table(heads, lines)
}

/// The settings that nothing cheaper matches on some flow, and those as a case has them by default.
fn front(rows: &[Row]) -> String {
    let line = |row: &Row| {
        let label = &row.setting.method.label;
        let own = || rows.iter().filter(|r| r.setting.method.label == *label);
        let shown = row.setting.varied == "update" || own().any(|r| r.pareto);
        let of = |flow| own().find(|r| r.flow == flow);
        let cells = Flow::ALL.map(|flow| of(flow).map_or(String::new(), cell));
        shown.then(|| format!("| {label} | {} |", cells.join(" | ")))
    };
    let heads = format!("| setting | {} |", Flow::ALL.map(Flow::name).join(" | "));
    let slits = rows.iter().filter(|r| r.flow == Flow::Slit);
    table(&heads, slits.filter_map(line))
}

fn failed(rows: &[Row]) -> String {
    let line = |r: &Row| {
        let said = r.failed.as_ref()?.split("mpm-run: ").last()?;
        let (label, flow) = (&r.setting.method.label, r.flow.name());
        Some(format!("- {label}, {flow}: {}\n", said.replace('\n', " ")))
    };
    let lines: String = rows.iter().filter_map(line).collect();
    match lines.is_empty() {
        true => lines,
        false => format!("\n## Failed\n\n{lines}"),
    }
}

fn cell(row: &Row) -> String {
    if row.error.is_nan() {
        return "failed".into();
    }
    let error = percent(row.error).trim_start_matches('+').to_owned();
    let mark = if row.pareto { "**" } else { "" };
    format!("{mark}{error}, {:.2}{mark}", row.cpu_s)
}

/// The table that `mpm-run --explain` quotes: one row per scheme, update, shape, option and cells,
/// all else as a case has it by default.
fn expected(rows: &[Row]) -> String {
    let mut csv = String::from(
        "scheme,update,order,shape,pressure,density_projection,cells_per_lumen,piston_pressure,channel_flux,bond_pressure,bond_wp\n",
    );
    for r in rows.iter().filter(|r| r.flow == Flow::Slit) {
        let method = &r.setting.method;
        let other = value(method, "contact.separation").is_some();
        if other || !["update", "cell", "shape", "option"].contains(&r.setting.varied) {
            continue;
        }
        let error = |flow| {
            let own = (rows.iter()).find(|o| o.flow == flow && o.setting.method == *method);
            let found = own.filter(|o| o.error.is_finite());
            found.map_or(String::new(), |o| format!("{:.4}", o.error))
        };
        let of = |key, usual| value(method, key).unwrap_or(usual);
        let key = match method.scheme {
            Scheme::Implicit => ",,,,".to_owned(),
            Scheme::Explicit => [
                of("integrator.velocity_update", "flip"),
                of("integrator.order", ""),
                of("grid.shape", "gimp"),
                of("integrator.pressure", "point"),
                value(method, "integrator.density_projection").map_or("no", |_| "yes"),
            ]
            .join(","),
        };
        let errors = [Flow::Slit, Flow::Channel, Flow::BondPressure, Flow::BondWp].map(error);
        let (scheme, cells) = (method.scheme.name(), r.setting.cells);
        let _ = writeln!(csv, "{scheme},{key},{cells},{}", errors.join(","));
    }
    csv
}

fn value<'a>(method: &'a Method, key: &str) -> Option<&'a str> {
    let change = method.set.iter().find_map(|s| s.strip_prefix(key))?;
    Some(change.trim_start_matches('=').trim_matches('"'))
}
