//! Where viscosity passes go on from: the viscosity that the next flow will have, by how the flow answered
//! the last change of it.

use physics::{Liquid, Rheology, Viscosity};
use rayon::prelude::*;

use super::Operator;

/// Largest exponent of a rate that is anticipated, and how near it is found.
const FARTHEST: f64 = 30.0;
const NEAR: f64 = 1e-3;
/// Mean square of the changes of ln(viscosity) below which they tell nothing of the answer.
const UNMOVED: f64 = 1e-6;

/// What a pass has found.
pub(crate) struct Found {
    /// Relative change of the viscosity, weighted by dissipation.
    pub(crate) change: f64,
    /// Viscosity over eta_0 of each cell that was solved with.
    pub(super) used: Vec<f32>,
    /// |dev D| of each cell, m/s per cell.
    pub(super) deviator: Vec<f32>,
    /// Both of the edges, [`Operator::edge_rates`].
    pub(super) edges: [Vec<[f32; 2]>; 3],
    /// The same of the walls: viscosity, rate in 1/s, and the part of the law's viscosity that it is.
    pub(super) links: Vec<[f32; 3]>,
}

impl Operator<'_> {
    /// How ln(rate) answers ln(viscosity) from the pass `before` to the pass `now`, weighted by
    /// dissipation: -1 where the load is given, 0 where the speed is; `last` where nothing changed.
    pub(crate) fn response(&self, before: &Found, now: &Found, last: f64) -> f64 {
        let (mut answer, mut cause, mut weight) = (0.0, 0.0, 0.0);
        for &cell in &self.dofs.cells {
            let cell = cell as usize;
            let [old, new] = [before, now].map(|pass| {
                let of = |list: &[f32]| f64::from(list[cell]);
                (of(&pass.used), of(&pass.deviator))
            });
            if [old.0, old.1, new.0, new.1].iter().all(|x| *x > 0.0) {
                let power = new.0 * new.1 * new.1 * f64::from(self.volumes.cell[cell]);
                let (eta, rate) = ((new.0 / old.0).ln(), (new.1 / old.1).ln());
                answer += power * eta * rate;
                cause += power * eta * eta;
                weight += power;
            }
        }
        if cause > UNMOVED * weight {
            (answer / cause).clamp(-1.0, 0.0)
        } else {
            last
        }
    }

    /// Sets the viscosities to those that the law of `liquid` has at the rates which follow from them, if
    /// rates go with the power `response` of the viscosity from what the pass `now` found; units as for
    /// [`Operator::set_viscosity`]. Exact in a channel under a given load, where Picard's own passes (a
    /// response of 0) come nearer by a part only, and hardly so where a liquid yields.
    pub(crate) fn anticipate(
        &mut self,
        liquid: &Liquid,
        reference: f64,
        cell_m: f64,
        now: &Found,
        response: f64,
    ) {
        let Viscosity::Law(law) = &liquid.viscosity else {
            return;
        };
        let eta = |used: f32, rate: f64| {
            let at = |rate: f64| (law.viscosity(rate) / reference).ln();
            consistent(at, f64::from(used).ln(), rate, response).exp() as f32
        };
        let per_cell = liquid.shear_rate.factor() / cell_m;
        let window = self.lattice.window;
        let viscosity: Vec<f32> = (self.viscosity.par_iter().enumerate())
            .map(|(index, &found)| {
                let home = window.index(window.home(window.coordinates(index)));
                let rate = f64::from(now.deviator[home]) * per_cell;
                match found > 0.0 && rate > 0.0 && now.used[home] > 0.0 {
                    true => eta(now.used[home], rate),
                    false => found,
                }
            })
            .collect();
        self.viscosity = viscosity;
        for (edges, found) in self.edge_viscosity.iter_mut().zip(&now.edges) {
            let each = edges.par_iter_mut().zip(found);
            each.for_each(|(own, &[used, deviator])| {
                let rate = f64::from(deviator) * per_cell;
                if rate > 0.0 && used > 0.0 {
                    *own = eta(used, rate);
                }
            });
        }
        let mut links = now.links.iter();
        self.walls.set_viscosity(|_, link| match links.next() {
            Some(&[used, rate, share]) if used > 0.0 && rate > 0.0 => {
                eta(used / share, rate.into()) * share
            }
            _ => link.viscosity,
        });
    }
}

/// ln(viscosity) x with x = ln eta(rate exp(response (x - used))), for a stress that does not fall with
/// the rate: by the Illinois variant of false position in the exponent.
fn consistent(ln_eta: impl Fn(f64) -> f64, used: f64, rate: f64, response: f64) -> f64 {
    let at = |exponent: f64| ln_eta(rate * exponent.exp());
    let excess = |exponent: f64| exponent - response * (at(exponent) - used);
    let (mut low, mut at_low) = (0.0, excess(0.0));
    if at_low.abs() <= NEAR {
        return at(-at_low);
    }
    // The excess grows with the exponent: the root lies on the side it points away from.
    let mut high = -at_low;
    let mut at_high = excess(high);
    while at_high * at_low > 0.0 && high.abs() < FARTHEST {
        (low, at_low) = (high, at_high);
        high *= 2.0;
        at_high = excess(high);
    }
    if at_high * at_low > 0.0 {
        return at(high);
    }
    while (high - low).abs() > NEAR {
        let next = (low * at_high - high * at_low) / (at_high - at_low);
        let found = excess(next);
        if found.abs() <= NEAR * NEAR {
            return at(next);
        }
        if found * at_high < 0.0 {
            (low, at_low) = (high, at_high);
        } else {
            at_low *= 0.5;
        }
        (high, at_high) = (next, found);
    }
    at(high)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::tests::{domain, lattice};
    use crate::liquid::Volumes;
    use crate::system::Scales;

    /// eta = rate^-0.7: under a given stress eta rate = 2, from a viscosity of 1 and so a rate of 2.
    #[test]
    fn a_given_stress_has_its_viscosity_at_once() {
        let ln_eta = |rate: f64| -0.7 * rate.ln();
        let eta = consistent(ln_eta, 0.0, 2.0, -1.0).exp();
        // rate^0.3 = 2
        let rate = 2_f64.powf(1.0 / 0.3);
        assert!((eta / rate.powf(-0.7) - 1.0).abs() < 1e-3, "{eta}");
        let picard = consistent(ln_eta, 0.0, 2.0, 0.0).exp();
        assert!((picard / 2_f64.powf(-0.7) - 1.0).abs() < 1e-12);
    }

    /// A liquid that hardly resists at any rate: its rate of e^999 is looked for up to e^30 in doublings.
    #[test]
    fn no_rate_is_sought_beyond_thirteen_decades() {
        let ln_eta = |rate: f64| -0.999 * rate.ln();
        let found = consistent(ln_eta, 0.0, std::f64::consts::E, -1.0);
        assert!(
            (found + 0.999 * (1.0 + 0.999 * 32.0)).abs() < 1e-9,
            "{found}"
        );
    }

    /// One cell whose viscosity changed by a part and whose rate by half of that, the other way.
    #[test]
    fn a_viscosity_that_did_not_move_tells_nothing() {
        let lattice = lattice(domain([4, 4, 1], 2), vec![]);
        let phi = vec![1.0; lattice.window.sub_len()];
        let volumes = Volumes::new(&lattice, &phi);
        let operator = Operator::new(&lattice, &volumes, Scales::plain());
        let told = |part: f32| {
            let pass = |eta: f32, rate: f32| Found {
                change: 0.0,
                used: vec![eta; lattice.window.len()],
                deviator: vec![rate; lattice.window.len()],
                edges: Default::default(),
                links: Vec::new(),
            };
            let now = pass(part.exp(), (-0.5 * part).exp());
            operator.response(&pass(1.0, 1.0), &now, -0.25)
        };
        assert_eq!(told(0.85e-3), -0.25);
        assert!((told(1.2e-3) + 0.5).abs() < 1e-3);
    }
}
