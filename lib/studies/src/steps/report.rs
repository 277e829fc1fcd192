//! `steps.csv`, `steps.md` and `steps.png`.

use figures::{Mark, Plot};

use super::{CELLS, CFL, DRIVES, Press};
use crate::Result;
use crate::numbers::worst;
use crate::study::{PAGE, Study, distinct, filled};
use crate::verification::report::percent;

/// Writes them, with the names of bonds left out.
pub(super) fn write(study: &Study, all: &[Press], absent: &str) -> Result<()> {
    let columns = "bond,drive,voxels_a_cell,cfl,exit,said,time_s,gap_m,final_pressure_Pa,wp_bottom_um,wp_top_um,wp_total_um,cpu_s";
    let numbers = |p: &Press| p.numbers.map(|number| format!("{number:.5e}"));
    let rows = all.iter().map(|p| [&p.name[..], &numbers(p)].concat());
    study.write_csv("steps.csv", columns, rows)?;
    let values = [
        ("head", &*study.head(all.iter().map(|p| p.numbers[6]))),
        ("absent", if absent.is_empty() { "none" } else { absent }),
        ("steps", &errors(all, &CFL, [1, 3])),
        ("bonds", &errors(all, &CFL[..1], [0, 1])),
        ("cells", &cells(all)),
    ];
    study.write("steps.md", filled(include_str!("page.txt"), &values))?;
    let title = "Error of total WP by length of step, worst of all bonds";
    let plot = Plot::new(title, "Courant number", "error (%)").logarithmic([true, true]);
    let plot = DRIVES.iter().fold(plot, |plot, [drive, _]| {
        let error = |cfl| 100.0 * worst_of(all, |p| p.name[1..4] == [drive, "2", cfl])[2].abs();
        let points = CFL[..3]
            .iter()
            .map(|cfl| [cfl.parse().unwrap_or(f64::NAN), error(cfl)]);
        plot.with(drive, Mark::LineAndDots, points.collect())
    });
    study.draw("steps.png", plot.draw(PAGE))
}

/// The press of the same bond by the same drive with another setting.
fn with<'a>(all: &'a [Press], press: &Press, setting: [&str; 2]) -> Option<&'a Press> {
    let same = |p: &&Press| p.name[..2] == press.name[..2] && p.name[2..4] == setting;
    all.iter().find(same)
}

/// Worst errors of presses; NaN where there are none.
fn worst_of(all: &[Press], own: impl Fn(&Press) -> bool) -> [f64; 8] {
    let errors = |p: &Press| Some(p.errors(with(all, p, ["2", CFL[3]])?));
    let own = all.iter().filter(|p| own(p));
    let errors: Vec<[f64; 8]> = own.filter_map(errors).collect();
    let of = |i: usize| worst(errors.iter().map(|e| e[i]).filter(|e| e.is_finite()));
    [0, 1, 2, 3, 4, 5, 6, 7].map(|i| of(i).unwrap_or(f64::NAN))
}

/// Exit status and worst errors of presses that agree in two parts of their names, a row each.
fn errors(all: &[Press], cfl: &[&str], parts: [usize; 2]) -> String {
    let wanted = |p: &Press| p.name[2] == "2" && cfl.contains(&&*p.name[3]);
    let named = |p: &Press| wanted(p).then(|| parts.map(|part| &*p.name[part]).join(" | "));
    let row = |name: String| {
        let own = |p: &Press| named(p).as_ref() == Some(&name);
        let count = |exit| all.iter().filter(|p| own(p) && p.name[4] == exit).count();
        let [well, failed, unread] = ["0", "1", "3"].map(count);
        let errors = worst_of(all, own).map(|e| format!("| {} ", percent(e).replace("NaN %", "-")));
        format!(
            "| {name} | {well}, {failed}, {unread} {}|\n",
            errors.concat()
        )
    };
    let names = distinct(all.iter().filter_map(named));
    names.into_iter().map(row).collect()
}

/// WP by three sizes of cells, with its order, a row for each bond.
fn cells(all: &[Press]) -> String {
    let row = |p: &Press| {
        let [two, one, half] = CELLS.map(|setting| Some(with(all, p, setting)?.numbers));
        let (two, one, half) = (two?, one?, half?);
        let side = |i: usize| {
            let [two, one, half] = [two[i], one[i], half[i]];
            let order = ((two - one) / (one - half)).log2();
            format!("{two:.3} | {one:.3} | {half:.3} | {order:.1} | ")
        };
        let (bond, sides) = (&p.name[0], [3, 4, 5].map(side).concat());
        Some(format!("| {bond} | {sides}{:.0} |\n", half[6]))
    };
    let first = all.iter().filter(|p| p.name[2..4] == CELLS[0]);
    first.filter_map(row).collect()
}
