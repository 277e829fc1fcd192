//! Results of the bench: a page and a table.

use super::Row;
use crate::Result;
use crate::study::{Study, filled, table};

const COLUMNS: &str = "size,case,threads,liquid_cells,points,steps,cpu_us_per_cell_step,\
                       cpu_over_base,points_steps_per_cpu_s,wall_s_per_step,bytes_per_cell,stages";

/// A row in words.
pub(super) fn line(row: &Row) -> String {
    let per_cell = 1e6 * row.cost.cpu_s / row.cost.cells();
    let ratio = ratio(row).map_or(String::new(), |r| format!(", {r:.2} of the base"));
    format!(
        "{:<32} {per_cell:8.3} us per cell and step{ratio}",
        row.piece.name()
    )
}

/// Processor time over that of the older build.
fn ratio(row: &Row) -> Option<f64> {
    let base = row.base.as_ref()?;
    Some((row.cost.cpu_s * row.cost.steps) / (base.cpu_s * base.steps))
}

/// Writes `bench.csv` and `bench.md`.
pub(super) fn write(study: &Study, rows: &[Row]) -> Result<()> {
    study.write_csv("bench.csv", COLUMNS, rows.iter().map(fields))?;
    study.write("bench.md", page(study, rows))
}

fn fields(row: &Row) -> Vec<String> {
    let (cost, cells) = (&row.cost, row.cost.cells());
    vec![
        row.piece.size.into(),
        row.piece.case.into(),
        row.piece.threads.to_string(),
        format!("{cells:.0}"),
        format!("{:.0}", cost.points),
        cost.steps.to_string(),
        format!("{:.4}", 1e6 * cost.cpu_s / cells),
        ratio(row).map_or(String::new(), |r| format!("{r:.3}")),
        format!("{:.4e}", cost.points / cost.cpu_s),
        format!("{:.4}", cost.wall_s),
        format!("{:.0}", cost.memory / cells),
        stages(row),
    ]
}

/// Parts of the time that are 1 % or more.
fn stages(row: &Row) -> String {
    let shown = row.cost.stages.iter().filter(|(_, part)| *part >= 0.01);
    let shown: Vec<String> = shown
        .map(|(name, part)| format!("{name} {:.0} %", 100.0 * part))
        .collect();
    shown.join(", ")
}

fn page(study: &Study, rows: &[Row]) -> String {
    let heads = "| specimen | case | threads | liquid cells | CPU us per cell and step | ratio | points x steps per CPU s | \
         memory per cell | wall s per step | stages |";
    let line = |row: &Row| {
        let (cost, cells) = (&row.cost, row.cost.cells());
        format!(
            "| {} | {} | {} | {cells:.0} | {:.3} | {} | {:.3} M | {:.0} B | {:.3} | {} |",
            row.piece.size,
            row.piece.case,
            row.piece.threads,
            1e6 * cost.cpu_s / cells,
            ratio(row).map_or("-".into(), |r| format!("{r:.2}")),
            cost.points / cost.cpu_s / 1e6,
            cost.memory / cells,
            cost.wall_s,
            stages(row)
        )
    };
    let values = [
        ("origin", study.origin()),
        ("table", &table(heads, rows.iter().map(line))),
    ];
    filled(include_str!("page.txt"), &values)
}
