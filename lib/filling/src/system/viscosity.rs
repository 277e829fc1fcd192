//! Viscosity that depends on the shear rate, lagged by one pass (Picard).

use physics::{Liquid, Viscosity};
use rayon::prelude::*;

use super::walls::thinning_distance;
use super::{Found, Operator};

/// Velocities from which shear rates are taken.
pub(crate) struct Sheared<'a, D> {
    /// |dev D| (m/s per cell) between the faces, at points given in cells.
    pub(crate) deviator: D,
    /// Velocity of each face unknown, m/s.
    pub(crate) u: &'a [f64],
    /// Velocities of the bodies, m/s.
    pub(crate) bodies: &'a [[f64; 3]],
}

impl Operator<'_> {
    /// Sets the viscosities of cells and walls by the law of `liquid` at the rates of `field`,
    /// in units of `reference` (Pa s), for cells of `cell_m`. Tells the relative change, weighted
    /// by dissipation in cells and at walls: a bound of the relative change that follows of the power
    /// dissipated, and so of the forces on moving bodies, since viscous flow makes that power least.
    /// It means nothing where there was no viscosity before.
    ///
    /// At a wall the rate is (u - U)/(d_eff + l), that of the wall law (paper Eq. 3), without
    /// the factor of the paper's convention for rates in the liquid; for a law by formula over the
    /// distance that suits it, [`thinning_distance`], of which the viscosity of the link makes up for the difference.
    // Not inlined: make leave-out counts what it takes by its name.
    #[inline(never)]
    pub(crate) fn set_viscosity<D: Fn([f64; 3]) -> f64 + Sync>(
        &mut self,
        liquid: &Liquid,
        reference: f64,
        cell_m: f64,
        field: &Sheared<D>,
    ) -> Found {
        let law = &liquid.viscosity;
        let at = |rate: f64| (law.at(rate) / reference) as f32;
        let window = self.lattice.window;
        let wet = |index: usize| self.volumes.cell[index] > 0.0;
        let (mut viscosity, deviator): (Vec<f32>, Vec<f32>) = (0..window.len())
            .into_par_iter()
            .map(|index| {
                let cell = window.coordinates(index);
                if !wet(index) || window.home(cell) != cell {
                    return (0.0, 0.0);
                }
                let deviator = (field.deviator)(window.corner(cell).map(|x| x + 0.5));
                let eta = at(liquid.shear_rate.factor() * deviator / cell_m);
                (eta, deviator as f32)
            })
            .unzip();
        // Edges on a periodic side average over cells and images of cells.
        for index in (0..window.len()).filter(|&index| wet(index)) {
            viscosity[index] = viscosity[window.index(window.home(window.coordinates(index)))];
        }
        // Power and its change by that of the viscosity.
        let (mut power, mut change) = (0.0, 0.0);
        let mut count = |shear: f64, before: f64, after: f32| {
            power += shear * before;
            change += shear * (f64::from(after) - before).abs();
        };
        for &cell in &self.dofs.cells {
            let cell = cell as usize;
            let volume = f64::from(self.volumes.cell[cell]);
            let shear = 2.0 * f64::from(deviator[cell]).powi(2) * volume;
            let used = self.viscosity.get(cell).map_or(1.0, |&eta| f64::from(eta));
            count(shear * self.factor(cell), used, viscosity[cell]);
        }
        let by_formula = matches!(law, Viscosity::Law(_));
        let mut used = std::mem::replace(&mut self.viscosity, viscosity);
        if by_formula {
            // None yet: that of the unit.
            used.resize(window.len(), 1.0);
        }
        let mut links = Vec::new();
        let mut edges: [Vec<[f32; 2]>; 3] = Default::default();
        if by_formula {
            let rates = self.edge_rates(field.u, field.bodies);
            for (plane, rates) in rates.into_iter().enumerate() {
                let before = std::mem::take(&mut self.edge_viscosity[plane]);
                let etas = (rates.par_iter())
                    .map(|&rate| at(liquid.shear_rate.factor() * f64::from(rate) / cell_m));
                self.edge_viscosity[plane] = etas.collect();
                for (index, &rate) in rates.iter().enumerate().filter(|(_, rate)| !rate.is_nan()) {
                    let used = before.get(index).copied().unwrap_or(1.0);
                    let shear = 2.0 * f64::from(rate).powi(2);
                    count(shear, used.into(), self.edge_viscosity[plane][index]);
                }
                let padded = before.into_iter().chain(std::iter::repeat(1.0));
                edges[plane] = padded.zip(rates).map(|(used, rate)| [used, rate]).collect();
            }
        }
        let length = self.scales.influence_length;
        let widths: Vec<f64> = match by_formula {
            true => (0..self.dofs.faces.len())
                .map(|face| self.walls.width(face))
                .collect(),
            false => Vec::new(),
        };
        let faces = &self.dofs.faces;
        self.walls.set_viscosity(|face, link| {
            let axis = usize::from(faces[face].0);
            let slip = (field.u[face] - field.bodies[usize::from(link.body)][axis]).abs();
            let run = f64::from(link.distance) + length;
            let mut rate = slip / run / cell_m;
            let mut eta = at(rate);
            if by_formula {
                let distance =
                    thinning_distance(link.distance.into(), widths[face], steepness(law, rate));
                let share = run / (distance + length);
                rate *= share;
                eta = at(rate) * share as f32;
                links.push([link.viscosity, rate as f32, share as f32]);
            }
            let shear = slip * slip * f64::from(link.area) / run;
            count(shear, link.viscosity.into(), eta);
            eta
        });
        Found {
            change: if power > 0.0 { change / power } else { 0.0 },
            used,
            deviator,
            edges,
            links,
        }
    }
}

/// d ln(rate)/d ln(stress) of a law at a rate, 1/s.
fn steepness(law: &Viscosity, rate: f64) -> f64 {
    /// Ratio of the rates of the difference, and the largest power: a yield stress has any.
    const APART: f64 = 1.01;
    const MOST: f64 = 100.0;
    let index = 1.0 + (law.at(APART * rate) / law.at(rate)).ln() / APART.ln();
    1.0 / index.max(1.0 / MOST)
}

#[cfg(test)]
mod tests {
    use physics::{Law, Newtonian, ShearRate, Table, Tait, Viscosity, VoxelBlock};

    use super::*;
    use crate::geometry::tests::{domain, lattice};
    use crate::liquid::Volumes;
    use crate::system::{Before, Scales};

    #[test]
    fn the_change_told_is_that_of_the_viscosity() {
        let lattice = lattice(domain([4, 4, 1], 2), vec![]);
        let phi = vec![1.0; lattice.window.sub_len()];
        let volumes = Volumes::new(&lattice, &phi);
        let mut operator = Operator::new(&lattice, &volumes, Scales::plain());
        let u = vec![0.0; operator.dofs.faces.len()];
        let field = Sheared {
            deviator: |_: [f64; 3]| 1.0,
            u: &u,
            bodies: &[],
        };
        let mut change = |eta: f64| {
            let liquid = Liquid {
                density: 1.0,
                tait: Tait { bulk_modulus: 1.0 },
                viscosity: Viscosity::Newtonian(Newtonian(eta)),
                shear_rate: ShearRate::Paper,
                cure: None,
                water: None,
                cavitation_pressure: None,
                wetting: None,
            };
            operator.set_viscosity(&liquid, 2.0, 1.0, &field).change
        };
        change(2.0);
        assert_eq!(change(2.0), 0.0);
        assert!((change(6.0) - 2.0).abs() < 1e-6, "three times as viscous");
        assert!((change(3.0) - 0.5).abs() < 1e-6, "half of it");
    }

    /// A power law has one slope; a law that bends has that of the rate to a thousandth; what does not
    /// flow has a hundred.
    #[test]
    fn laws_have_their_slopes() {
        let power = Law::Power {
            consistency: 1.0,
            index: 0.5,
            rates: [1e-9, 1e9],
        };
        assert!((steepness(&Viscosity::Law(power), 3.0) - 2.0).abs() < 1e-9);
        let cross = Law::Cross {
            plateaus: [1.0, 0.0],
            time: 1.0,
            exponent: 0.8,
        };
        // d ln(eta)/d ln(rate) = -0.8 x/(1 + x) with x = rate^0.8 = 1.
        let error = steepness(&Viscosity::Law(cross), 1.0) * 0.6 - 1.0;
        assert!((0.5e-3..2e-3).contains(&error.abs()), "{error}");
        let solid = Law::HerschelBulkley {
            yield_stress: 1e9,
            consistency: 1.0,
            index: 0.5,
            regularisation: 1e-9,
        };
        assert!((steepness(&Viscosity::Law(solid), 1.0) - 100.0).abs() < 1e-9);
    }

    /// Loss of water thickens whatever the law: the flow that dissipates it takes twice the power, in cells,
    /// around edges and at walls.
    #[test]
    fn a_factor_multiplies_every_law() {
        let floor = VoxelBlock::solid_box([-1.0; 3], [9.0, 1.3, 9.0]);
        let lattice = lattice(domain([5, 5, 5], 3), vec![vec![floor]]);
        let phi = vec![1.0; lattice.window.sub_len()];
        let volumes = Volumes::new(&lattice, &phi);
        let scales = Scales {
            inertia: 0.0,
            influence_length: 0.1,
            ..Scales::plain()
        };
        let twice = vec![2.0; lattice.window.len()];
        let table = Table::new(&[(1e-3, 3.0), (1e3, 1.0)]).unwrap();
        let power_law = Law::Power {
            consistency: 1.0,
            index: 0.5,
            rates: [1e-3, 1e3],
        };
        for viscosity in [
            Viscosity::Newtonian(Newtonian(3.0)),
            Viscosity::Table(table),
            Viscosity::Law(power_law),
        ] {
            let liquid = Liquid {
                density: 1.0,
                tait: Tait { bulk_modulus: 1.0 },
                viscosity,
                shear_rate: ShearRate::Paper,
                cure: None,
                water: None,
                cavitation_pressure: None,
                wetting: None,
            };
            let power = |factor: &[f32]| {
                let mut operator = Operator::new(&lattice, &volumes, scales);
                operator.thicken(factor);
                let u: Vec<f64> = (0..operator.dofs.faces.len())
                    .map(|face| (0.7 * face as f64).sin())
                    .collect();
                let bodies = [[0.0; 3]];
                let sheared = Sheared {
                    deviator: |x: [f64; 3]| 1.0 + x[0],
                    u: &u,
                    bodies: &bodies,
                };
                operator.set_viscosity(&liquid, 1.0, 1.0, &sheared);
                let cells = vec![0.0; operator.dofs.cells.len()];
                let before = Before {
                    velocity: &u,
                    pressure: &cells,
                    stiffness: &vec![1.0; cells.len()],
                    lost: &[],
                    air: &[],
                };
                let system = operator.assemble(&bodies, before).unwrap();
                system.reactions(&operator.dofs.faces, &u, &cells).power
            };
            let (once, found) = (power(&[]), power(&twice));
            assert!(
                once > 0.0 && (found / once - 2.0).abs() < 1e-6,
                "{once} {found}"
            );
        }
    }
}
