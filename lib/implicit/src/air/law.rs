//! The gas law of a pocket, p V = m with leaks, and its tangent, with which a step is solved (docs/methods.md section 3.13).

use physics::{TAIT_C, Tait};

use crate::geometry::DRIFT;
use crate::settings::ITERATION_TOLERANCE;

/// Bound on the ratio of the volumes of successive tangents, which makes the Newton iteration on V = m/p converge from either
/// side: a larger one overshoots, a smaller one takes more iterations.
const MAX_VOLUME_RATIO: f64 = 4.0;

/// The gas law of a run. Pressures are over the unit of viscosity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Gas {
    /// Absolute ambient pressure.
    pub(crate) outside: f64,
    /// Largest absolute pressure: that of Tait's law at J = 1 - C.
    pub(crate) most: f64,
    /// Time in which the excess pressure of a pocket of fixed volume decays to 1/e, s; infinite where walls are tight.
    pub(crate) leak_time: f64,
}

/// The gas law of a pocket linearised about a volume: V_end = `volume` - `compliance` (p - `pressure`). Pressures are
/// relative to ambient.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Tangent {
    /// Volume about which the law is linearised, cells.
    pub(crate) volume: f64,
    /// Pressure at that volume.
    pub(crate) pressure: f64,
    /// -dV/dp, cells per unit of pressure.
    pub(crate) compliance: f64,
}

impl Tangent {
    /// Volume at a pressure relative to ambient, at most [`MAX_VOLUME_RATIO`] from that of the tangent.
    pub(crate) fn volume_at(&self, pressure: f64) -> f64 {
        let volume = self.volume - self.compliance * (pressure - self.pressure);
        volume.clamp(
            self.volume / MAX_VOLUME_RATIO,
            self.volume * MAX_VOLUME_RATIO,
        )
    }
}

impl Gas {
    /// Air with the ambient pressure `outside` (Pa, absolute), next to a liquid of the law `tait`; `unit` is that of
    /// pressure, Pa.
    pub(crate) fn new(outside: f64, leak_time: f64, tait: Tait, unit: f64) -> Self {
        Self {
            outside: outside / unit,
            most: tait.pressure(-TAIT_C) / unit,
            leak_time,
        }
    }

    /// Tangent about a `volume` (cells) at the end of a step of `dt` (s), for a pocket with the `mass` m, absolute pressure
    /// times volume at the start of the step: p V = m - (exp(dt/t_leak) - 1) (p - p_0) V, which is exact at constant volume.
    pub(crate) fn tangent(&self, mass: f64, volume: f64, dt: f64) -> Tangent {
        let leak = self.leak_factor(dt);
        // A lower bound on the pressure within the tolerance: a void without air would have no finite tangent.
        let thinnest = ITERATION_TOLERANCE * self.outside;
        let absolute = (mass / volume + leak * self.outside) / (1.0 + leak);
        Tangent {
            volume,
            pressure: absolute.clamp(thinnest, self.most) - self.outside,
            compliance: volume * (1.0 + leak) / (mass / volume).max(thinnest),
        }
    }

    /// Whether a pressure (relative to ambient) and the volume that the tangent gives for it obey the gas law. An absolute
    /// error of [`DRIFT`] in the volume is accepted: a void without air collapses to nothing at any liquid pressure.
    pub(crate) fn obeys_law(&self, mass: f64, tangent: &Tangent, pressure: f64, dt: f64) -> bool {
        let right = self.tangent(mass, tangent.volume_at(pressure), dt);
        let off = right.compliance * (pressure - right.pressure).abs();
        off <= (ITERATION_TOLERANCE * right.volume).max(DRIFT)
    }

    /// The part of `mass` that leaks out in a step of `dt` (s), at whose end the pocket has this volume and this pressure
    /// (relative to ambient).
    pub(crate) fn leaked(&self, mass: f64, volume: f64, pressure: f64, dt: f64) -> f64 {
        (self.leak_factor(dt) * pressure * volume).min(mass)
    }

    /// exp(dt/t_leak) - 1.
    fn leak_factor(&self, dt: f64) -> f64 {
        /// Bound at which all excess leaks: a larger factor would swamp the other terms of a sum in rounding.
        const ALL: f64 = 1e9;
        (dt / self.leak_time).exp_m1().min(ALL)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::system::MAX_PASSES;

    /// Newton iteration for a front that a pressure pushes against viscous friction. It converges from volumes far off to both
    /// sides, with and without a leak, and for a void without air that grows or collapses.
    #[test]
    fn tangents_lead_to_the_pressure_of_the_volume() {
        let pushes = [(1e3, 1e2), (-99.0, 1e2), (5e4, 1e-3), (0.0, 1.0)];
        for (mass, leak_time, (push, resistance)) in
            [(1e3, f64::INFINITY), (1e3, 0.03), (0.0, f64::INFINITY)]
                .into_iter()
                .flat_map(|(mass, time)| pushes.map(|push| (mass, time, push)))
        {
            let gas = Gas {
                outside: 1e2,
                most: 1e6,
                leak_time,
            };
            let (first, dt) = (10.0, 0.1);
            let mut tangent = gas.tangent(mass, first, dt);
            let mut passes = 0;
            let p = loop {
                // V_end = V + dt (p - push)/resistance.
                let Tangent {
                    volume,
                    pressure,
                    compliance,
                } = tangent;
                let known = volume + compliance * pressure - first + dt * push / resistance;
                let p = known / (compliance + dt / resistance);
                if gas.obeys_law(mass, &tangent, p, dt) {
                    break p;
                }
                tangent = gas.tangent(mass, tangent.volume_at(p), dt);
                passes += 1;
                assert!(passes < MAX_PASSES, "{push} {resistance}");
            };
            let (volume, absolute) = (tangent.volume_at(p), p + gas.outside);
            let leaked = gas.leaked(mass, volume, p, dt);
            let swept = first + dt * (p - push) / resistance;
            assert!((swept - volume).abs() < 2e-3 * first);
            assert!(mass == 0.0 || (absolute * volume + leaked - mass).abs() < 2e-3 * mass);
        }
    }

    #[test]
    fn a_leak_is_exact_in_steps_of_any_length_where_the_volume_stays() {
        let gas = Gas {
            outside: 1e2,
            most: 1e6,
            leak_time: 0.1,
        };
        for dt in [1e-3, 0.1, 0.4] {
            let over = gas.tangent(3.0 * 150.0, 3.0, dt).pressure;
            assert!(
                (over / (50.0 * (-dt / 0.1).exp()) - 1.0).abs() < 1e-9,
                "{dt}: {over}"
            );
            let left = 3.0 * 150.0 - gas.leaked(3.0 * 150.0, 3.0, over, dt);
            assert!((left / (3.0 * (100.0 + over)) - 1.0).abs() < 1e-9);
        }
        assert!(gas.tangent(3.0 * 150.0, 3.0, 1e3).pressure.abs() < 1e-6);
    }

    #[test]
    fn a_void_without_air_pulls_as_a_vacuum_does_and_a_crushed_one_stays_below_the_liquids_law() {
        let gas = Gas {
            outside: 1e2,
            most: 1e6,
            leak_time: f64::INFINITY,
        };
        assert!((gas.tangent(0.0, 3.0, 1.0).pressure + 99.9).abs() < 1e-9);
        assert!((gas.tangent(1e9, 1e-9, 1.0).pressure + 1e2 - 1e6).abs() < 1e-3);
    }
}
