//! `make load-control`: the implicit scheme's clamp at a pressure limit, over pressures,
//! viscosities and scenes, at a usual and at a small Courant number.

pub mod report;
pub mod scenes;

use std::path::Path;

use crate::job::write_text;
use crate::method::{Method, Scheme};
use crate::outputs::Run;
use crate::study::{Study, side_by_side};
use scenes::{CELL, SHAPES, Shape};

/// Pressure limits, Pa.
pub const PRESSURES: [f64; 5] = [3e4, 1e5, 3e5, 1e6, 2.5e6];
/// Viscosities, Pa s.
pub const VISCOSITIES: [f64; 5] = [0.05, 0.3, 1.3, 6.0, 30.0];
/// Part of a closing time that is not known: a step that comes within a hundredth of a cell of the end has come there.
const END: f64 = 0.005;
/// Courant numbers: the usual one, and one at which the step does not matter.
pub const COURANT: [f64; 2] = [0.5, 0.05];
/// Parts of the gap at which the two are compared.
const AT: [f64; 2] = [0.5, 0.25];

/// One press at both Courant numbers.
#[derive(Clone, Debug)]
pub struct Row {
    /// The scene.
    pub shape: Shape,
    /// Pressure limit, Pa.
    pub pressure: f64,
    /// Viscosity, Pa s.
    pub viscosity: f64,
    /// By each of [`COURANT`].
    pub courses: [Course; 2],
    /// Largest difference of the way to go from that at the small Courant number, at [`AT`],
    /// relative.
    pub difference: f64,
    /// The same relative to the distance between the plates.
    pub thickness: f64,
}

/// What a run did.
#[derive(Clone, Debug)]
pub struct Course {
    /// Time and travel after each step, s and m.
    points: Vec<[f64; 2]>,
    /// When the clamp had gone all its way, s; infinite when it did not.
    pub closed_s: f64,
    /// Most cells that the clamp crossed in a step over the Courant number.
    pub clamp: f64,
    /// Most cells that a material point crossed in a step.
    pub points_cross: f64,
    /// Highest pressure over the limit.
    pub overshoot: f64,
    /// Processor seconds.
    pub cpu_s: f64,
}

impl Course {
    fn of(run: &Run, shape: &Shape, pressure: f64, cfl: f64) -> Result<Self, String> {
        let [time, dt, speed, travel, fastest, top] = [
            "time_s",
            "dt_s",
            "closing_speed_m_s",
            "displacement_m",
            "max_speed_m_s",
            "pressure_top_Pa",
        ]
        .map(|column| run.history(column));
        let (time, dt, travel) = (time?, dt?, travel?);
        let cells = |speed: Vec<f64>| {
            let crossed = speed.iter().zip(&dt).map(|(v, dt)| v * dt / CELL);
            crossed.fold(0.0, f64::max)
        };
        let points: Vec<_> = time.iter().zip(&travel).map(|(&t, &s)| [t, s]).collect();
        let end = points.last().ok_or("the history is empty")?;
        let whole = end[1] >= shape.travel * CELL * (1.0 - 1e-6);
        Ok(Self {
            closed_s: if whole { end[0] } else { f64::INFINITY },
            clamp: cells(speed?) / cfl,
            points_cross: cells(fastest?),
            overshoot: top?.iter().fold(0.0, |most: f64, p| most.max(p / pressure)),
            cpu_s: run.summary("cpu_s").unwrap_or(f64::NAN),
            points,
        })
    }

    /// Travel (m) at a time (s).
    fn travel(&self, time: f64) -> f64 {
        let after = self.points.partition_point(|p| p[0] < time);
        let Some(&[t, s]) = self.points.get(after) else {
            return self.points.last().map_or(0.0, |p| p[1]);
        };
        let [before, from] = after.checked_sub(1).map_or([0.0; 2], |i| self.points[i]);
        from + (s - from) * (time - before) / (t - before)
    }

    /// Time (s) at a travel (m).
    fn time(&self, travel: f64) -> Option<f64> {
        let after = self.points.iter().position(|p| p[1] >= travel)?;
        let [t, s] = self.points[after];
        let [before, from] = after.checked_sub(1).map_or([0.0; 2], |i| self.points[i]);
        Some(before + (t - before) * (travel - from) / (s - from))
    }
}

/// The press `shape` at both Courant numbers, run in `folder`.
///
/// # Errors
/// What a run said.
pub fn row(shape: Shape, pressure: f64, viscosity: f64, folder: &Path) -> Result<Row, String> {
    let name = format!("{}-{pressure}-{viscosity}", shape.name.replace(' ', "-"));
    let text = shape
        .case(pressure, viscosity)
        .text(Scheme::Implicit.integrator());
    let case = folder.join(format!("{name}.toml"));
    write_text(&case, &text)?;
    let course = |cfl: f64| {
        let method = Method::implicit().setting(format!("integrator.cfl={cfl}"));
        let run = method.run(&case, &folder.join(format!("{name}-{cfl}")), &[])?;
        Course::of(&run, &shape, pressure, cfl)
    };
    let courses = [course(COURANT[0])?, course(COURANT[1])?];
    let way = shape.travel * CELL;
    let mut worst = [0.0_f64; 2];
    for left in AT.map(|part| part * way) {
        let fine = courses[1].time(way - left).ok_or("it did not close")?;
        let off = (way - left - courses[0].travel(fine)).abs();
        let between = shape.gap() - (way - left);
        worst = [worst[0].max(off / left), worst[1].max(off / between)];
    }
    Ok(Row {
        shape,
        pressure,
        viscosity,
        difference: worst[0],
        thickness: worst[1],
        courses,
    })
}

/// The study.
///
/// # Errors
/// What a run or the system said.
pub fn run(study: &Study) -> Result<bool, String> {
    let mut wanted = Vec::new();
    for shape in SHAPES.into_iter().filter(|shape| study.wants(shape.name)) {
        for pressure in PRESSURES {
            wanted.extend(VISCOSITIES.map(|viscosity| (shape, pressure, viscosity)));
        }
    }
    let done = side_by_side(&wanted, |&(shape, pressure, viscosity)| {
        row(shape, pressure, viscosity, &study.folder())
    });
    let rows = done.into_iter().collect::<Result<Vec<Row>, String>>()?;
    report::write(study, &rows)?;
    Ok(report::sound(&rows))
}

/// Pairs of rows that differ in one step of pressure or viscosity and of which the easier press
/// closes later.
pub fn out_of_order(rows: &[Row]) -> Vec<[&Row; 2]> {
    let mut found = Vec::new();
    for a in rows {
        for b in rows.iter().filter(|b| b.shape.name == a.shape.name) {
            let harder = b.pressure <= a.pressure && b.viscosity >= a.viscosity;
            for course in 0..COURANT.len() {
                let (early, late) = (&a.courses[course], &b.courses[course]);
                if harder && early.closed_s > (1.0 + END) * late.closed_s {
                    found.push([a, b]);
                }
            }
        }
    }
    found
}
