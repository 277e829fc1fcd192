//! Boundary conditions where liquid ends: the pressure beyond its surface, lower or higher by that of a meniscus, and the friction
//! of contact lines.

use rayon::prelude::*;
use saddle_point::RowEntries;

use super::assembly::Problem;
use super::unknowns::Unknowns;
use crate::geometry::{Chords, Lattice, Mesh, Neighbour, perimeter_over_area};

/// Neighbour in a step, cells, that counts as rest: far less than a step moves, far more than solutions are off by. A meniscus that goes
/// it is held by half of all that holds it (docs/methods.md section 3.12).
pub(crate) const REST_DISTANCE: f64 = 0.01;

/// How liquid meets the walls, in the units of a step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Wetting {
    /// Surface tension.
    pub(crate) tension: f64,
    /// Cosine of the contact angle at rest.
    pub(crate) cosine: f64,
    /// What it loses per capillary number of a front that advances, times the viscosity in that number.
    pub(crate) dynamic_coefficient: f64,
    /// Length of the step, s.
    pub(crate) dt: f64,
    /// Length of the step before over that, at most 1.
    pub(crate) step_ratio: f64,
}

impl Wetting {
    /// What the jump of a passage of unit perimeter_over_area loses over the speed of a meniscus that advanced at `speed`, no further than
    /// to an angle of 180 or 0 degrees.
    fn dynamic_loss(&self, speed: f64) -> f64 {
        let left = match speed > 0.0 {
            true => 1.0 + self.cosine,
            false => 1.0 - self.cosine,
        };
        let most = left * self.tension / speed.abs().max(f64::MIN_POSITIVE);
        self.dynamic_coefficient.min(most)
    }

    /// Dry friction over the speed of a front that advanced at `speed` where the passage holds it by the jump of `uneven`. It
    /// knows ways, not times: in a longer step the way of the last one counts, or fronts that come to rest would go on as far
    /// as steps grow.
    fn contact_friction(&self, hysteresis: f64, speed: f64) -> f64 {
        let held = self.tension * self.cosine.abs() * hysteresis;
        held / (self.step_ratio * speed.abs() + REST_DISTANCE / self.dt)
    }
}

/// What liquid meets where it ends.
#[derive(Default)]
pub(crate) struct Fronts {
    /// Pressure on liquid that ends in each pore without a pressure of its own, over the unit of viscosity; empty where
    /// nothing pushes.
    pub(crate) pressure: Vec<f64>,
    /// Force against the velocity of each face over that; empty where contact lines resist nothing.
    pub(crate) contact_friction: Vec<f64>,
    /// Loss of the jump in each pore over the flow that comes into it; empty where angles do not depend on the speed.
    pub(crate) dynamic_loss: Vec<f64>,
}

impl Fronts {
    /// Those of pores at the pressures `around` them. Where a full pore meets one that is neither full nor `torn`, the meniscus is that of the passage
    /// there: a jump of tension times cosine times perimeter over area. `velocity` is that of the faces before the step.
    pub(crate) fn new(
        (lattice, chords, mesh): (&Lattice, &Chords, &Mesh),
        (unknowns, torn): (&Unknowns, &[bool]),
        around: Vec<f64>,
        wetting: Option<Wetting>,
        velocity: &[f64],
    ) -> Self {
        let mut fronts = Self {
            pressure: around,
            ..Self::default()
        };
        let Some(wetting) = wetting else {
            return fronts;
        };
        let empty = |pore: usize| !unknowns.has_pressure(pore) && !mesh.is_ghost(mesh.cell(pore));
        let dry: Vec<bool> = (0..mesh.pores.len())
            .into_par_iter()
            .map(|pore| {
                !torn[pore]
                    && empty(pore)
                    && (mesh.neighbours(pore))
                        .any(|neighbour| unknowns.has_pressure(neighbour.pore))
            })
            .collect();
        let perimeter_over_area: Vec<f64> = (0..mesh.pores.len())
            .into_par_iter()
            .map(|pore| {
                let near = dry[pore] || mesh.neighbours(pore).any(|neighbour| dry[neighbour.pore]);
                match near && !mesh.is_ghost(mesh.cell(pore)) {
                    true => perimeter_over_area(lattice, chords, mesh, pore, &|pore| {
                        unknowns.has_pressure(pore)
                    }),
                    false => 0.0,
                }
            })
            .collect();
        let pressures = fronts.pressure.iter_mut().enumerate();
        for (pore, pressure) in pressures.filter(|at| dry[at.0]) {
            *pressure -= wetting.tension * wetting.cosine * perimeter_over_area[pore];
        }
        let view = FrontView {
            mesh,
            dry: &dry,
            empty: &empty,
            perimeter_over_area: &perimeter_over_area,
            wetting,
        };
        let contact_friction =
            |(face, velocity): (usize, &f64)| view.contact_friction(face, *velocity);
        fronts.contact_friction = velocity
            .par_iter()
            .enumerate()
            .map(contact_friction)
            .collect();
        if wetting.dynamic_coefficient > 0.0 {
            let pores = (0..mesh.pores.len()).into_par_iter();
            fronts.dynamic_loss = pores
                .map(|pore| view.dynamic_loss(unknowns, pore, velocity))
                .collect();
        }
        fronts
    }
}

/// The dry side of the front.
struct FrontView<'a> {
    mesh: &'a Mesh,
    /// Whether each pore is of it.
    dry: &'a [bool],
    /// Whether a meniscus that has filled a pore of it may go on to a pore.
    empty: &'a (dyn Fn(usize) -> bool + Sync),
    /// Perimeter over area of passages on both sides.
    perimeter_over_area: &'a [f64],
    wetting: Wetting,
}

impl FrontView<'_> {
    /// What holds menisci at a face over its velocity.
    fn contact_friction(&self, face: usize, velocity: f64) -> f64 {
        let f = &self.mesh.faces[face];
        let [low, high] = f.ends();
        let (wet, dry, up) = match [low, high].map(|pore| self.dry[pore]) {
            [false, true] => (low, high, true),
            [true, false] => (high, low, false),
            _ => return 0.0,
        };
        let speed = if up { velocity } else { -velocity };
        let hysteresis = self.hysteresis(usize::from(f.axis), up, wet, dry);
        self.mesh.area(face) * self.wetting.contact_friction(hysteresis, speed)
    }

    /// Loss of the jump in a pore over what comes into it, by the velocities before the step. Its section is its volume over an
    /// edge.
    fn dynamic_loss(&self, unknowns: &Unknowns, pore: usize, velocity: &[f64]) -> f64 {
        let (perimeter_over_area, section) =
            (self.perimeter_over_area[pore], self.mesh.volume(pore));
        if !(self.dry[pore] && perimeter_over_area > 0.0 && section > 0.0) {
            return 0.0;
        }
        let into = wet_faces(self.mesh, unknowns, pore).map(|(face, area)| area * velocity[face]);
        perimeter_over_area * self.wetting.dynamic_loss(into.sum::<f64>() / section) / section
    }

    /// Half of what the perimeter_over_area varies by where a meniscus that leaves `wet` for `dry` along an axis may rest: where
    /// its pull falls ahead, and along it.
    fn hysteresis(&self, axis: usize, up: bool, wet: usize, dry: usize) -> f64 {
        let here = self.perimeter_over_area[dry];
        let (mut behind, mut ahead) = (
            [
                here.min(self.perimeter_over_area[wet]),
                here.max(self.perimeter_over_area[wet]),
            ],
            [here; 2],
        );
        for neighbour in self.mesh.neighbours(dry) {
            let Neighbour { pore: beside, .. } = neighbour;
            let perimeter_over_area = self.perimeter_over_area[beside];
            let widen = |range: &mut [f64; 2]| {
                *range = [
                    range[0].min(perimeter_over_area),
                    range[1].max(perimeter_over_area),
                ]
            };
            if neighbour.axis == axis && neighbour.up == up {
                widen(&mut ahead);
            } else if neighbour.axis != axis && (self.empty)(beside) {
                widen(&mut behind);
                widen(&mut ahead);
            }
        }
        // A liquid that does not wet is pressed back by narrower places.
        let fall = match self.wetting.cosine > 0.0 {
            true => behind[1] - ahead[0],
            false => ahead[1] - behind[0],
        };
        0.5 * fall.max(0.0)
    }
}

/// Faces by which a pore without a pressure is filled by those that have one, and their areas, negative where a positive
/// velocity leaves it.
fn wet_faces<'a>(
    mesh: &'a Mesh,
    unknowns: &'a Unknowns,
    pore: usize,
) -> impl Iterator<Item = (usize, f64)> + 'a {
    (mesh.neighbours(pore))
        .filter(|neighbour| unknowns.has_pressure(neighbour.pore))
        .map(|neighbour| {
            (
                neighbour.face,
                -neighbour.sign() * mesh.area(neighbour.face),
            )
        })
}

impl Problem<'_> {
    /// Adds what a dynamic angle resists the velocity of a face with: what a meniscus moves by is all that comes into its pore,
    /// or steps of a front between pores would be ways around it.
    pub(super) fn add_dynamic_angle(&self, face: usize, entries: &mut RowEntries) {
        let ends = self.ends(face);
        for (dry, wet, sign) in [(ends[0], ends[1], -1.0), (ends[1], ends[0], 1.0)] {
            let loss = self
                .fronts
                .dynamic_loss
                .get(dry)
                .copied()
                .unwrap_or_default();
            if loss == 0.0 || !self.unknowns.has_pressure(wet) {
                continue;
            }
            let own = sign * loss * self.mesh.area(face);
            for (other, area) in wet_faces(self.mesh, self.unknowns, dry) {
                if let Some(number) = self.unknowns.face(other) {
                    entries.add(number, own * area);
                }
            }
        }
    }

    /// Force on a face by what is beyond the surface of liquid that ends there.
    pub(super) fn front_force(&self, face: usize) -> f64 {
        let ends = self.ends(face);
        let pressure = |pore: usize| self.fronts.pressure.get(pore).copied().unwrap_or_default();
        let pressure = match ends.map(|pore| self.unknowns.has_pressure(pore)) {
            [true, false] => -pressure(ends[1]),
            [false, true] => pressure(ends[0]),
            _ => return 0.0,
        };
        pressure * self.mesh.area(face)
    }

    /// Adds the outflow of a pore to those beside it that count.
    pub(super) fn add_outflow(
        &self,
        pore: usize,
        entries: &mut RowEntries,
        counts: impl Fn(usize) -> bool,
    ) {
        for neighbour in self
            .mesh
            .neighbours(pore)
            .filter(|neighbour| counts(neighbour.pore))
        {
            if let Some(number) = self.unknowns.face(neighbour.face) {
                entries.add(number, neighbour.sign() * self.mesh.area(neighbour.face));
            }
        }
    }
}
