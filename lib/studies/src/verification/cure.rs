//! Filling at constant pressure with an adhesive that cures: L^2 = (r^2/4) integral of P/eta dt in a tube,
//! (H^2/6) of it in a slit, both with the equivalent length of entrance and front; the run ends once set.

use super::lumen::Section;
use super::piston::{self, Drive};
use super::{LUMEN, Measured, Scene, slit};
use crate::case_text::PF;
use crate::numbers::worst;

/// Pressure, Pa: filling takes half a second.
const PRESSURE: f64 = 1e3;
/// Growth of the viscosity at which a run counts as set.
const SET: f64 = 1e6;

/// How the viscosity grows by a law with one time, s: t_gel, or that of the last point.
#[derive(Clone, Copy, Debug)]
pub struct Growth {
    pub(super) name: &'static str,
    /// The time for an integral of 1/factor of so much, s.
    time: fn(f64) -> f64,
    /// Integral of 1/factor by that time up to another, s.
    fluidity: fn(f64, f64) -> f64,
    /// When the viscosity has grown to [`SET`] times that at the start, s.
    set: fn(f64) -> f64,
    keys: fn(f64) -> String,
}

/// (1 - t/t_gel)^-2.
pub const GEL: Growth = Growth {
    name: "gel",
    time: |whole| 3.0 * whole,
    fluidity: |time, until| time / 3.0 * (1.0 - (1.0 - until / time).powi(3)),
    set: |time| time * (1.0 - SET.powf(-0.5)),
    keys: |time| format!("gel_time = \"{time} s\"\nexponent = 2.0\n"),
};

/// Exponentially, by a table of two points, to [`SET`].
pub const TABLE: Growth = Growth {
    name: "table",
    time: |whole| SET.ln() * whole,
    fluidity: |time, until| time / SET.ln() * (1.0 - SET.powf(-until / time)),
    set: |time| time,
    keys: |time| format!("factor = [[\"0 s\", 1.0], [\"{time} s\", {SET:e}]]\n"),
};

/// A slit of `n` cells that fills to 4.5 of its widths.
pub fn slit_scene(n: u32, growth: Growth) -> Scene {
    let h = LUMEN / f64::from(n);
    let filling = Filling {
        name: format!("cure-slit-n{n}-{}", growth.name),
        growth,
        limit: PRESSURE * 4.0 * LUMEN / slit::domain(h),
        unit: 12.0 * PF[2] / PRESSURE,
        entrance: slit::entrance(n),
        goal: 4.5,
        travel: 0.25,
    };
    filling.of(slit::filled_scene(n, 0.0))
}

/// A tube of `n` cells that fills to 2.5 of its diameters.
pub fn tube_scene(n: u32, growth: Growth) -> Scene {
    let section = Section::Round(2);
    let right = LUMEN + 2.0 * LUMEN / f64::from(n);
    let filling = Filling {
        name: format!("cure-tube-n{n}-{}", growth.name),
        growth,
        limit: PRESSURE * (LUMEN / right).powi(2),
        unit: section.staircase_resistance(n) * PF[2] / PRESSURE,
        entrance: piston::entrance(section, n),
        goal: 2.5,
        travel: section.area(n) / 4.0,
    };
    filling.of(piston::scene(section, n, Drive::Pressure(PRESSURE)))
}

/// A lumen filled at constant pressure, lengths in its widths.
struct Filling {
    name: String,
    growth: Growth,
    /// Pressure on the domain's cross-section, Pa.
    limit: f64,
    /// Time in which a length of sqrt 2 is filled without entrance or cure, s.
    unit: f64,
    /// Equivalent length of entrance and front.
    entrance: f64,
    /// Where it comes to rest.
    goal: f64,
    /// Travel of the piston per filled width.
    travel: f64,
}

impl Filling {
    /// The scene of `filling` without cure, with cure.
    fn of(self, filling: Scene) -> Scene {
        let whole = self.unit * (0.5 * self.goal * self.goal + self.entrance * self.goal);
        let time = (self.growth.time)(whole);
        let set = (self.growth.set)(time);
        let mut case = filling.case;
        let travel = 1.2 * self.goal * self.travel * LUMEN * 1e6;
        let law = self.growth.name;
        case.title = format!(
            "Filling at constant pressure with an adhesive that cures ({law}).\nAgainst Washburn's law with the integral of P/eta dt."
        );
        case.clamp = Some(format!(
            "closing_speed = \"0.02 m/s\"\nmax_pressure = \"{:.6} Pa\"\nstop = \"{} s\"\ntravel = \"{travel:.6} um\"\n",
            self.limit,
            10.0 * time,
        ));
        case.cure = Some((self.growth.keys)(time));
        case.history_every = set / 400.0;
        let name = self.name.clone();
        Scene::new(name, "Washburn with cure", case, move |run| {
            let [times, travel] = run.columns(["time_s", "displacement_m"])?;
            let [end, came] = run.ends(["time_s", "displacement_m"])?;
            let filled = |s: f64| s / (self.travel * LUMEN);
            let done = |t: f64| (self.growth.fluidity)(time, t) / self.unit;
            let exact = |from: f64, since: f64, t: f64| {
                let start = from + self.entrance;
                (start * start + 2.0 * (done(t) - since)).sqrt() - self.entrance
            };
            let first = travel.iter().position(|&s| filled(s) >= 1.0);
            let first = first.ok_or("it was not filled to one width")?;
            let (from, since) = (filled(travel[first]), done(times[first]));
            let rows = times.iter().zip(&travel).skip(first);
            let worst = worst(rows.map(|(&t, &s)| filled(s) / exact(from, since, t) - 1.0));
            let worst = worst.unwrap_or(f64::NAN);
            Ok(vec![
                Measured::relative("L at the end", filled(came), exact(0.0, 0.0, end)),
                Measured::absolute("L(t) from L = d on, worst", worst),
                Measured::relative("time at the end", end, set),
            ])
        })
    }
}
