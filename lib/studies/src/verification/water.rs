//! A piston at constant pressure presses a column of adhesive along a lumen whose walls take its water beyond a
//! mouth: the front slows down and stops. Against the balance along the axis of `water_front`.

use super::lumen::{Rectangle, Section, quarter};
use super::water_front::{Front, TABLE};
use super::{LUMEN, Measured, Scene};
use crate::case_text::{Body, CaseText, PF, Viscosity};
use crate::numbers::{largest, worst};

/// Pressure, Pa: it takes a minute.
const PRESSURE: f64 = 1e3;
/// Viscosity at the start, Pa s.
pub const VISCOSITY: f64 = 130.0;
/// End, in the unit of time of [`Front`]: when the front has stopped.
const END: f64 = 30.0;
/// Lengths of column and lumen, in widths.
const COLUMN: f64 = 5.0;
const BEYOND: f64 = 3.5;
/// How far the contact line in a tube is behind the filled length over that in a slit: a half ball's 2/3 of the radius
/// over a half circle's pi/4.
const BALL: f64 = 0.85;

/// A slit of `n` cells.
pub fn slit_scene(n: u32) -> Scene {
    let cell = LUMEN / f64::from(n);
    let (low, high) = (2.0 * cell, 2.0 * cell + LUMEN);
    let rectangle = |x: [f64; 2]| Rectangle {
        low: [x[0], 0.0],
        high: [x[1], cell],
    };
    Column {
        name: format!("water-slit-n{n}"),
        cell,
        dimensions: 2,
        side: [high + 2.0 * cell, cell],
        walls: [[0.0, low], [high, high + 2.0 * cell]]
            .map(rectangle)
            .to_vec(),
        open: vec![rectangle([low, high])],
        resistance: 12.0,
        wall: 2.0,
        dispersion: 210.0,
        meniscus: 1.0,
        piston: 0.304 + 0.357 * (f64::from(n) / 6.0).ln(),
        front: -0.19,
    }
    .scene()
}

/// A quarter of a tube of `n` cells, of voxels of half a cell.
pub fn tube_scene(n: u32) -> Scene {
    let (section, cell) = (Section::Round(2), LUMEN / f64::from(n));
    let far = 0.5 * LUMEN + 2.0 * cell;
    let shape = quarter(section, n, LUMEN, far);
    Column {
        name: format!("water-tube-n{n}"),
        cell,
        dimensions: 3,
        side: [far; 2],
        walls: shape.sides.into_iter().chain([shape.roof]).collect(),
        open: shape.open,
        resistance: section.staircase_resistance(n),
        wall: std::f64::consts::PI / section.area(n),
        dispersion: 192.0,
        meniscus: BALL,
        piston: 0.183 + 0.268 * (f64::from(n) / 6.0).ln(),
        front: -0.146,
    }
    .scene()
}

/// A lumen and the column in it.
struct Column {
    name: String,
    /// m
    cell: f64,
    dimensions: u8,
    /// Edges of the domain across the lumen, m.
    side: [f64; 2],
    walls: Vec<Rectangle>,
    open: Vec<Rectangle>,
    /// Pressure gradient over viscosity and mean velocity times the square of the width.
    resistance: f64,
    /// Circumference over area times the width.
    wall: f64,
    dispersion: f64,
    meniscus: f64,
    /// Equivalent length of a piston whose corners are as sharp as a cell (lib/studies/reference/plug.py). It has no limit
    /// in finer cells: Taylor's scraper.
    piston: f64,
    /// Equivalent length of the front's shape, by finite elements.
    front: f64,
}

impl Column {
    fn scene(self) -> Scene {
        let front = Front {
            column: COLUMN,
            sink: 0.02,
            diffusivity: 0.5,
            dispersion: self.dispersion,
            meniscus: self.meniscus,
            ends: [self.piston, self.front],
        };
        let unit = self.resistance * VISCOSITY / PRESSURE;
        let edges = |r: &Rectangle| (r.high[0] - r.low[0]) * (r.high[1] - r.low[1]);
        let area: f64 = self.open.iter().map(edges).sum();
        let end = END * unit;
        let piston = (BEYOND + COLUMN) * LUMEN;
        let [pressure, travel] = [
            PRESSURE * area / (self.side[0] * self.side[1]),
            0.95 * COLUMN * LUMEN * 1e6,
        ];
        let case = CaseText {
            title: "A piston at constant pressure presses a column of adhesive along a lumen whose walls take its water.\nAgainst Darcy's law and the balance of solids and water along the lumen.".into(),
            clamp: Some(format!(
                "closing_speed = \"0.2 mm/s\"\nmax_pressure = \"{pressure:.9} Pa\"\nstop = \"{end} s\"\ntravel = \"{travel:.6} um\"\n"
            )),
            viscosity: Viscosity::Newtonian(VISCOSITY),
            water: Some(water(&front, self.wall, unit)),
            bodies: self.bodies(piston),
            history_every: end / 300.0,
            ..CaseText::new(
                self.cell,
                self.dimensions,
                [self.side[0], piston + 3.0 * self.cell, self.side[1]],
            )
        };
        Scene::new(self.name, "viscosity front", case, move |run| {
            let [times, travel, taken] =
                run.columns(["time_s", "displacement_m", "water_in_walls_m3"])?;
            let exact = front.course(PF[0], END);
            // What the piston displaces and the walls do not take is beyond the mouth.
            let lengths = travel
                .iter()
                .zip(&taken)
                .map(|(s, w)| (s - w / area) / LUMEN);
            let course: Vec<(f64, f64)> = times.iter().map(|t| t / unit).zip(lengths).collect();
            let beyond = course.iter().map(|(t, l)| (exact.at(*t), l));
            let beyond = beyond.filter(|(exact, _)| *exact >= 1.0);
            let worst = worst(beyond.map(|(exact, l)| l / exact - 1.0));
            let missing = run.summary("water_missing");
            Ok(vec![
                Measured::relative(
                    "L at the end",
                    largest(course.iter().map(|p| p.1)),
                    exact.farthest(),
                ),
                Measured::absolute(
                    "L(t) from L = d on, worst",
                    worst.ok_or("it was not filled to one width")?,
                ),
                Measured::absolute(
                    "mass of water",
                    missing.ok_or("it has no account of water")?,
                ),
            ])
        })
    }

    /// Walls above and below the mouth, the piston at its height and the column.
    fn bodies(&self, piston: f64) -> Vec<Body> {
        let mouth = BEYOND * LUMEN;
        let top = piston + 3.0 * self.cell;
        let bar = |r: &Rectangle, low: f64, high: f64| {
            ([r.low[0], low, r.low[1]], [r.high[0], high, r.high[1]])
        };
        let mut bodies = Vec::new();
        for wall in &self.walls {
            for (low, high, name) in [(0.0, mouth, "lumen"), (mouth, top, "bottom")] {
                let (min, max) = bar(wall, low, high);
                bodies.push(Body::wall(min, max).named(name));
            }
        }
        for open in &self.open {
            let (min, max) = bar(open, piston, top + COLUMN * LUMEN);
            bodies.push(Body::wall(min, max).clamped().named("top"));
            let (min, max) = bar(open, mouth, piston);
            bodies.push(Body::liquid(min, max));
        }
        bodies
    }
}

/// Lines of `[adhesive.water]` for a lumen of this circumference over area (1/width) and unit of time, s.
fn water(front: &Front, wall: f64, unit: f64) -> String {
    let rows = TABLE.map(|(solids, factor)| format!("[{solids}, {factor:?}]"));
    format!(
        "solids = {}\nuptake = \"{:e} m/s\"\ndiffusivity = \"{:e} m2/s\"\nviscosity_by_solids = [{}]\nwalls = [\"lumen\"]\n",
        TABLE[0].0,
        front.sink * LUMEN / (wall * unit),
        front.diffusivity * LUMEN * LUMEN / unit,
        rows.join(", ")
    )
}
