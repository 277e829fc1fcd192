//! `load-control.csv` and `load-control.md`.

use super::scenes::{Shape, shapes};
use super::{COURANT, Course, Row, out_of_order};
use crate::Result;
use crate::numbers::{largest, mean};
use crate::study::{Study, filled, table};

/// Writes the table and the page.
pub(super) fn write(study: &Study, rows: &[Row]) -> Result<()> {
    let mut header = String::from("scene,pressure_Pa,viscosity_Pa_s");
    for cfl in COURANT {
        header += &format!(
            ",closed_s_{cfl},clamp_over_cfl_{cfl},points_cross_cells_{cfl},pressure_over_limit_{cfl},cpu_s_{cfl}"
        );
    }
    header.push_str(",way_difference,thickness_difference");
    let fields = rows.iter().map(|row| {
        let mut list = vec![
            row.shape.name.into(),
            row.pressure.to_string(),
            row.viscosity.to_string(),
        ];
        for c in &row.courses {
            list.push(format!("{:.5e}", c.closed_s));
            list.push(format!("{:.6}", c.clamp));
            list.push(format!("{:.4}", c.points_cross));
            list.push(format!("{:.5}", c.overshoot));
            list.push(format!("{:.2}", c.cpu_s));
        }
        list.extend([row.difference, row.thickness].map(|x| format!("{x:.5}")));
        list
    });
    study.write_csv("load-control.csv", &header, fields)?;
    let head = study.head(rows.iter().flat_map(|row| &row.courses).map(|c| c.cpu_s));
    study.write("load-control.md", page(rows, &head))
}

/// Largest difference between the Courant numbers.
const NEAR: f64 = 0.1;
/// Most of the Courant number that a step may cross.
const EXCESS: f64 = 1.1;

/// Whether every row keeps the Courant number, closes, is in order and near the small step: in the
/// way to go where the plate touches the liquid from the start, in the distance between the plates
/// where it first crosses air, a film of which thinner than half a cell is not resolved.
pub fn sound(rows: &[Row]) -> bool {
    rows.iter().all(|row| {
        row.thickness <= NEAR
            && (row.difference <= NEAR || !row.shape.touches())
            && (row.courses.iter()).all(|c| c.clamp <= EXCESS && c.closed_s.is_finite())
    }) && out_of_order(rows) == 0
}

fn page(rows: &[Row], head: &str) -> String {
    let line = |shape: Shape| {
        let own: Vec<&Row> = rows.iter().filter(|r| r.shape.name == shape.name).collect();
        if own.is_empty() {
            return None;
        }
        let worst = |of: fn(&Row) -> f64| 100.0 * largest(own.iter().map(|row| of(row)));
        let courses = || own.iter().flat_map(|row| &row.courses);
        let most = |of: fn(&Course) -> f64| largest(courses().map(of));
        Some(format!(
            "| {} | {} | {:.1} % | {:.1} % | {:.1} % | {:.1} % | {:.3} | {:.2} | {:.3} | {:.1} |",
            shape.name,
            2 * own.len(),
            worst(|r| r.difference),
            100.0 * mean(own.iter().map(|r| r.difference)),
            worst(|r| r.thickness),
            worst(|r| (r.courses[0].closed_s / r.courses[1].closed_s - 1.0).abs()),
            most(|c| c.clamp),
            most(|c| c.points_cross),
            most(|c| c.overshoot),
            courses().map(|c| c.cpu_s).sum::<f64>(),
        ))
    };
    let heads = "| scene | runs | travel left, worst | mean | plates, worst | closing time, worst | clamp | points | pressure | CPU s |";
    let open = rows.iter().flat_map(|r| &r.courses);
    let open = open.filter(|c| c.closed_s.is_infinite()).count();
    let values = [
        ("head", head),
        ("cfl", &format!("{} and {}", COURANT[0], COURANT[1])),
        (
            "table",
            &table(heads, shapes().into_iter().filter_map(line)),
        ),
        ("open", &open.to_string()),
        ("out_of_order", &out_of_order(rows).to_string()),
    ];
    filled(include_str!("page.txt"), &values)
}
