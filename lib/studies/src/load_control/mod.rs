//! `make load-control`: the implicit scheme's clamp at a pressure limit, over pressures,
//! viscosities and scenes, at a usual and at a small Courant number.

pub mod report;
pub mod scenes;

use std::path::Path;

use crate::Result;
use crate::method::{Method, Scheme};
use crate::numbers::{crossing, largest};
use crate::outputs::Run;
use crate::study::{Study, side_by_side, write};
use scenes::{CELL, Shape, shapes};

/// Pressure limits, Pa.
const PRESSURES: [f64; 5] = [3e4, 1e5, 3e5, 1e6, 2.5e6];
/// Viscosities, Pa s.
const VISCOSITIES: [f64; 5] = [0.05, 0.3, 1.3, 6.0, 30.0];
/// Part of a closing time that is not known: a step that comes within a hundredth of a cell of the end has come there.
const END: f64 = 0.005;
/// Courant numbers: the usual one, and one at which the step does not matter.
const COURANT: [f64; 2] = [0.5, 0.05];
/// Parts of the gap at which the two are compared.
const AT: [f64; 2] = [0.5, 0.25];

/// One press at both Courant numbers.
#[derive(Clone, Debug)]
pub struct Row {
    shape: Shape,
    /// Pressure limit, Pa.
    pub pressure: f64,
    /// Viscosity, Pa s.
    pub viscosity: f64,
    /// By each of [`COURANT`].
    pub courses: [Course; 2],
    /// Largest difference of the way to go from that at the small Courant number, at [`AT`],
    /// relative.
    difference: f64,
    /// The same relative to the distance between the plates.
    pub thickness: f64,
}

/// What a run did.
#[derive(Clone, Debug)]
pub struct Course {
    /// Time and travel after each step, s and m.
    time: Vec<f64>,
    travel: Vec<f64>,
    /// When the clamp had gone all its way, s; infinite when it did not.
    pub closed_s: f64,
    /// Most cells that the clamp crossed in a step over the Courant number.
    pub clamp: f64,
    /// Most cells that a material point crossed in a step.
    points_cross: f64,
    /// Highest pressure over the limit.
    overshoot: f64,
    cpu_s: f64,
}

impl Course {
    fn of(run: &Run, shape: &Shape, pressure: f64, cfl: f64) -> Result<Self> {
        let [time, travel, dt] = run.columns(["time_s", "displacement_m", "dt_s"])?;
        let [speed, fastest, top] =
            run.columns(["closing_speed_m_s", "max_speed_m_s", "pressure_top_Pa"])?;
        let [end, way] = run.ends(["time_s", "displacement_m"])?;
        let cells = |speed: Vec<f64>| largest(speed.iter().zip(&dt).map(|(v, dt)| v * dt / CELL));
        let whole = way >= shape.way() * (1.0 - 1e-6);
        Ok(Self {
            closed_s: if whole { end } else { f64::INFINITY },
            clamp: cells(speed) / cfl,
            points_cross: cells(fastest),
            overshoot: largest(top.iter().map(|p| p / pressure)),
            cpu_s: run.cpu_s(),
            time,
            travel,
        })
    }

    /// Travel (m) at a time (s).
    fn travel(&self, time: f64) -> f64 {
        let last = self.travel.last().copied();
        crossing(&self.time, &self.travel, time)
            .or(last)
            .unwrap_or(0.0)
    }
}

/// The press `shape` at both Courant numbers, run in `folder`.
pub fn row(shape: Shape, pressure: f64, viscosity: f64, folder: &Path) -> Result<Row> {
    let name = format!("{}-{pressure}-{viscosity}", shape.name.replace(' ', "-"));
    let text = shape
        .case(pressure, viscosity)
        .text(Scheme::Implicit.integrator());
    let case = folder.join(format!("{name}.toml"));
    write(&case, text)?;
    let course = |cfl: f64| {
        let method = Method::implicit().setting(format!("integrator.cfl={cfl}"));
        let run = method.run(&case, &folder.join(format!("{name}-{cfl}")), &[])?;
        Course::of(&run, &shape, pressure, cfl)
    };
    let courses = [course(COURANT[0])?, course(COURANT[1])?];
    let [usual, small] = &courses;
    let way = shape.way();
    let mut worst = [0.0_f64; 2];
    for left in AT.map(|part| part * way) {
        let fine = crossing(&small.travel, &small.time, way - left).ok_or("it did not close")?;
        let off = (way - left - usual.travel(fine)).abs();
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
pub fn run(study: &Study) -> Result<bool> {
    let mut wanted = Vec::new();
    for shape in shapes().into_iter().filter(|shape| study.wants(shape.name)) {
        for pressure in PRESSURES {
            wanted.extend(VISCOSITIES.map(|viscosity| (shape, pressure, viscosity)));
        }
    }
    let rows: Result<Vec<Row>> = side_by_side(&wanted, |&(shape, pressure, viscosity)| {
        row(shape, pressure, viscosity, &study.folder())
    });
    let rows = rows?;
    report::write(study, &rows)?;
    Ok(report::sound(&rows))
}

/// Pairs of rows that differ in one step of pressure or viscosity and of which the easier press
/// closes later.
fn out_of_order(rows: &[Row]) -> usize {
    let pairs = rows.iter().flat_map(|a| rows.iter().map(move |b| (a, b)));
    let harder = pairs.filter(|(a, b)| {
        b.shape.name == a.shape.name && b.pressure <= a.pressure && b.viscosity >= a.viscosity
    });
    let courses = harder.flat_map(|(a, b)| a.courses.iter().zip(&b.courses));
    courses
        .filter(|(early, late)| early.closed_s > (1.0 + END) * late.closed_s)
        .count()
}
