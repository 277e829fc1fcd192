//! Pressure of a pocket by its air and its volume, and the tangent that a step is solved with.

use physics::{TAIT_C, Tait};

/// Least absolute pressure of a void, over that outside: what liquid opens without air is no vacuum, which
/// would have no tangent.
const THINNEST: f64 = 1e-3;
/// Largest ratio of the volumes that one tangent and the next are taken at.
const STEEPEST: f64 = 4.0;
/// Absolute pressure, over that outside, that errors of smaller ones are measured by.
const FAINT: f64 = 0.01;
/// Way of the front, cells, that the volumes of pockets may be off their pressures by, mean over the front.
const ASTRAY: f64 = 0.02;

/// The air of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Gas {
    /// Absolute pressure outside, Pa.
    pub(crate) outside: f64,
    /// Time in which what a pocket of fixed volume has above that falls to 1/e of it, s; infinite where
    /// walls are tight.
    pub(crate) leak_time: f64,
    /// Largest absolute pressure of a pocket, Pa.
    pub(crate) most: f64,
}

/// What pressures and volumes of a step are measured by.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Measure {
    /// Length of the step, s.
    pub(crate) dt: f64,
    /// Pressure unit, Pa.
    pub(crate) pressure: f64,
    /// Cell, m.
    pub(crate) cell: f64,
}

/// A pocket's law near one volume, as a row of the system: G u + C (p - `pressure`) = `growth`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Tangent {
    /// C, scaled.
    pub(crate) softness: f64,
    /// Scaled.
    pub(crate) pressure: f64,
    /// To that volume in the step, scaled.
    pub(crate) growth: f64,
    /// Where the law is touched: volume, cells, absolute pressure, Pa, and -dV/dp, cells/Pa.
    at: [f64; 3],
}

impl Tangent {
    /// The volume (cells) at an absolute pressure (Pa).
    fn volume(&self, absolute: f64) -> f64 {
        let [volume, pressure, yielding] = self.at;
        (volume - yielding * (absolute - pressure)).clamp(volume / STEEPEST, volume * STEEPEST)
    }
}

/// The pockets of a step: air (Pa cells) of each, and its volume (cells) at the start of the step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Contents<'a> {
    pub(crate) mass: &'a [f64],
    pub(crate) volume: &'a [f64],
}

impl Gas {
    /// Air that is at `outside` (Pa, absolute) where nothing closes it off, beside a liquid of the law `tait`:
    /// the most that it comes to is the pressure at which the liquid has lost the part C of its volume.
    pub(crate) fn new(outside: f64, leak_time: f64, tait: Tait) -> Self {
        Self {
            outside,
            leak_time,
            most: tait.pressure(-TAIT_C),
        }
    }

    /// Absolute pressure (Pa) at the end of a step in a pocket that comes to a volume (cells), of so much air
    /// (Pa cells) at its start: p V = m - dt/t_leak (p - p_0) V.
    fn pressure(&self, mass: f64, volume: f64, dt: f64) -> f64 {
        let leak = dt / self.leak_time;
        let pressure = (mass / volume + leak * self.outside) / (1.0 + leak);
        pressure.clamp(THINNEST * self.outside, self.most)
    }

    /// Air (Pa cells) that is left of `mass` in a pocket that comes to an absolute pressure (Pa) in a step.
    fn left(&self, mass: f64, pressure: f64, dt: f64) -> f64 {
        let leak = dt / self.leak_time;
        if leak == 0.0 {
            return mass;
        }
        let density = (1.0 + leak) * pressure - leak * self.outside;
        // Beyond its bounds the law has no volume.
        if density > THINNEST * self.outside {
            mass * pressure / density
        } else {
            mass
        }
    }

    /// The law of `mass` at `volume`, for a step that starts with `first` (both cells).
    fn tangent(&self, mass: f64, first: f64, volume: f64, measure: Measure) -> Tangent {
        let pressure = self.pressure(mass, volume, measure.dt);
        let pace = measure.cell / measure.dt;
        // -V dp/dV without its bounds, but no less than where the air is thinnest.
        let leak = measure.dt / self.leak_time;
        let stiffness = (mass / volume).max(THINNEST * self.outside) / (1.0 + leak);
        let yielding = volume / stiffness;
        let softness = yielding * pace * measure.pressure;
        let gauge = (pressure - self.outside) / measure.pressure;
        Tangent {
            softness,
            pressure: gauge,
            growth: (volume - first) * pace,
            at: [volume, pressure, yielding],
        }
    }

    /// Tangents of pockets at their volumes.
    pub(crate) fn tangents(&self, pockets: Contents, measure: Measure) -> Vec<Tangent> {
        (pockets.mass.iter().zip(pockets.volume))
            .map(|(&mass, &volume)| self.tangent(mass, volume, volume, measure))
            .collect()
    }

    /// Tangents anew at the volumes that follow from scaled pressures `p`; `None` where those are the
    /// pressures of these volumes, for fronts of `area` (cells) together.
    pub(crate) fn nearer(
        &self,
        tangents: &[Tangent],
        p: &[f64],
        pockets: Contents,
        area: f64,
        measure: Measure,
    ) -> Option<Vec<Tangent>> {
        let (mut astray, mut sound) = (0.0, true);
        let volumes: Vec<f64> = (tangents.iter().zip(p).zip(pockets.mass))
            .map(|((tangent, p), &mass)| {
                let absolute = p * measure.pressure + self.outside;
                let found = tangent.volume(absolute);
                let right = self.pressure(mass, found, measure.dt);
                sound &= absolute > 0.0;
                astray += found * (absolute - right).abs() / right.max(FAINT * self.outside);
                found
            })
            .collect();
        (!sound || astray > ASTRAY * area).then(|| {
            (volumes.iter().zip(pockets.mass).zip(pockets.volume))
                .map(|((&volume, &mass), &first)| self.tangent(mass, first, volume, measure))
                .collect()
        })
    }

    /// Volumes (cells) of pockets at their scaled pressures.
    pub(crate) fn volumes(&self, tangents: &[Tangent], p: &[f64], measure: Measure) -> Vec<f64> {
        (tangents.iter().zip(p))
            .map(|(tangent, p)| tangent.volume(p * measure.pressure + self.outside))
            .collect()
    }

    /// Takes from each mass (Pa cells) what leaks in a step that ends with the scaled pressures `p`; how much
    /// that is together, with what comes in negative.
    pub(crate) fn leak(&self, mass: &mut [f64], p: &[f64], measure: Measure) -> f64 {
        let mut lost = 0.0;
        for (mass, p) in mass.iter_mut().zip(p) {
            let absolute = p * measure.pressure + self.outside;
            let left = self.left(*mass, absolute, measure.dt);
            lost += *mass - left;
            *mass = left;
        }
        lost
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GAS: Gas = Gas {
        outside: 1e5,
        leak_time: f64::INFINITY,
        most: 1e9,
    };
    const MEASURE: Measure = Measure {
        dt: 0.1,
        pressure: 1e3,
        cell: 1.0,
    };

    /// A front of one cell that a pressure pushes against friction: Newton's steps from one volume come
    /// to the pressure of the volume there from far to both sides, with a leak and without, and never to
    /// one below zero.
    #[test]
    fn tangents_lead_to_the_pressure_of_the_volume() {
        let pushes = [(1e6, 1e2), (-9.9e4, 1e2), (5e7, 1e-3), (0.0, 1.0)];
        for (leak_time, (push, resistance)) in [f64::INFINITY, 0.03]
            .into_iter()
            .flat_map(|time| pushes.map(|push| (time, push)))
        {
            let gas = Gas { leak_time, ..GAS };
            let pockets = Contents {
                mass: &[1e6],
                volume: &[10.0],
            };
            let mut tangents = gas.tangents(pockets, MEASURE);
            let mut passes = 0;
            let p = loop {
                // u = (p - push)/resistance, all scaled, and u + C p = known.
                let t = tangents[0];
                let known = t.growth + t.softness * t.pressure;
                let p = (known + push / 1e3 / resistance) / (1.0 / resistance + t.softness);
                match gas.nearer(&tangents, &[p], pockets, 1e-6, MEASURE) {
                    Some(next) => tangents = next,
                    None => break p,
                }
                passes += 1;
                assert!(passes < 20, "{push} {resistance}");
            };
            let pressure = p * 1e3 + gas.outside;
            let volume = 10.0 + (p - push / 1e3) / resistance * MEASURE.dt;
            let mut mass = [1e6];
            let lost = gas.leak(&mut mass, &[p], MEASURE);
            assert!((mass[0] + lost - 1e6).abs() < 1e-3);
            assert!(pressure > 0.0 && (pressure * volume / mass[0] - 1.0).abs() < 1e-6);
            let through = MEASURE.dt / leak_time * (pressure - gas.outside) * volume;
            assert!((lost - through).abs() < 1.0, "{lost} {through}");
        }
    }

    #[test]
    fn a_void_without_air_pulls_as_a_vacuum_does_and_a_crushed_one_stays_below_the_liquids_law() {
        let pockets = Contents {
            mass: &[0.0, 1e9],
            volume: &[3.0, 1e-9],
        };
        let [empty, crushed] = GAS.tangents(pockets, MEASURE)[..] else {
            panic!("two pockets");
        };
        let pressure = |t: Tangent| t.pressure * 1e3 + 1e5;
        assert!((pressure(empty) - 1e2).abs() < 1e-6);
        assert!((pressure(crushed) / GAS.most - 1.0).abs() < 1e-9);
    }

    /// Next to a vacuum errors are measured by a hundredth of the pressure outside.
    #[test]
    fn a_void_next_to_a_vacuum_needs_no_exact_pressure() {
        let pockets = Contents {
            mass: &[0.0],
            volume: &[3.0],
        };
        let tangents = GAS.tangents(pockets, MEASURE);
        // 600 Pa where 100 Pa is right: half of 1 % of 1e5 Pa, of a volume down to a quarter of 3, over two
        // hundredths of a cell.
        let edge = 0.5 * 0.75 / 0.02;
        let again = |area: f64| {
            let p = [(600.0 - GAS.outside) / 1e3];
            GAS.nearer(&tangents, &p, pockets, area, MEASURE).is_some()
        };
        assert!(again(0.99 * edge) && !again(1.01 * edge), "{edge}");
    }
}
