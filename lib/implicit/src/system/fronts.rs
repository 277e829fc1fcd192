//! Boundary conditions at the liquid's surface: ambient or pocket pressure, capillary pressure of menisci, friction of contact
//! lines (docs/methods.md section 3.12).

use rayon::prelude::*;
use saddle_point::RowEntries;

use super::assembly::Problem;
use super::unknowns::Unknowns;
use crate::geometry::{Chords, Lattice, Mesh, perimeter_over_area};

/// Displacement in a step that counts as rest, cells: far less than a step moves, far more than the error of a solution. It
/// makes v_0 = REST_DISTANCE/dt of docs/methods.md section 3.12: a meniscus that moves by it feels half of the contact-line
/// friction.
pub(crate) const REST_DISTANCE: f64 = 0.01;

/// Wetting of the walls, in the units of a step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Wetting {
    /// Surface tension.
    pub(crate) tension: f64,
    /// Cosine of the contact angle at rest.
    pub(crate) cosine: f64,
    /// k eta: loss of the cosine per capillary number, times the viscosity in that number.
    pub(crate) dynamic_coefficient: f64,
    /// Length of the step, s.
    pub(crate) dt: f64,
    /// Length of the last step over that of this one, at most 1.
    pub(crate) step_ratio: f64,
}

impl Wetting {
    /// Loss of capillary pressure per speed of the meniscus, for a throat of unit perimeter over area. Bounded so that the
    /// contact angle of a meniscus at `speed`, that of the last step, stays within 0 and 180 degrees.
    fn dynamic_loss(&self, speed: f64) -> f64 {
        let left = match speed > 0.0 {
            true => 1.0 + self.cosine,
            false => 1.0 - self.cosine,
        };
        let most = left * self.tension / speed.abs().max(f64::MIN_POSITIVE);
        self.dynamic_coefficient.min(most)
    }

    /// Pinning friction of a contact line per area and speed: F/(|u'| + v_0) with u' the `speed` of the last step. Friction
    /// depends on the displacement, not the time: in a longer step u' is scaled to the displacement of the last one, or
    /// fronts that come to rest would creep on as steps grow.
    fn contact_friction(&self, hysteresis: f64, speed: f64) -> f64 {
        let pinning = self.tension * self.cosine.abs() * hysteresis;
        pinning / (self.step_ratio * speed.abs() + REST_DISTANCE / self.dt)
    }
}

/// The boundary conditions at the surface of the liquid.
#[derive(Default)]
pub(crate) struct Fronts {
    /// p_front in each pore without an unknown pressure, over the unit of viscosity; empty if zero everywhere.
    pub(crate) pressure: Vec<f64>,
    /// Friction of contact lines at each face, force per velocity; empty without menisci.
    pub(crate) contact_friction: Vec<f64>,
    /// Loss of capillary pressure in each pore per inflow; empty if the contact angle does not depend on the speed.
    pub(crate) dynamic_loss: Vec<f64>,
}

impl Fronts {
    /// The boundary conditions for pores with the pressures `around` of their gas or torn liquid. A meniscus stands in each
    /// pore that is neither full nor `torn` and borders on a full one; its capillary pressure is tension times cosine times
    /// perimeter over area of the throat. `velocity` is that of the faces before the step.
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
                let is_around =
                    dry[pore] || mesh.neighbours(pore).any(|neighbour| dry[neighbour.pore]);
                match is_around && !mesh.is_ghost(mesh.cell(pore)) {
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

/// The menisci and the throats around them.
struct FrontView<'a> {
    mesh: &'a Mesh,
    /// Whether each pore holds a meniscus: it is not full and borders on a full pore.
    dry: &'a [bool],
    /// Whether a pore can still be filled, so that a meniscus may move on into it.
    empty: &'a (dyn Fn(usize) -> bool + Sync),
    /// Perimeter over area of the throat at each pore with a meniscus and at its neighbours.
    perimeter_over_area: &'a [f64],
    wetting: Wetting,
}

impl FrontView<'_> {
    /// Friction of the contact line at a face, force per velocity.
    fn contact_friction(&self, face: usize, velocity: f64) -> f64 {
        let f = &self.mesh.faces[face];
        let [low, high] = f.pores();
        let (wet, dry, up) = match [low, high].map(|pore| self.dry[pore]) {
            [false, true] => (low, high, true),
            [true, false] => (high, low, false),
            _ => return 0.0,
        };
        let speed = if up { velocity } else { -velocity };
        let hysteresis = self.hysteresis(usize::from(f.axis), up, wet, dry);
        self.mesh.area(face) * self.wetting.contact_friction(hysteresis, speed)
    }

    /// Loss of capillary pressure in a pore per inflow, by the velocities before the step. The cross-section of the pore is its
    /// volume over the edge of a cell.
    fn dynamic_loss(&self, unknowns: &Unknowns, pore: usize, velocity: &[f64]) -> f64 {
        let (perimeter_over_area, section) =
            (self.perimeter_over_area[pore], self.mesh.volume(pore));
        if !(self.dry[pore] && perimeter_over_area > 0.0 && section > 0.0) {
            return 0.0;
        }
        let into = wet_faces(self.mesh, unknowns, pore).map(|(face, area)| area * velocity[face]);
        perimeter_over_area * self.wetting.dynamic_loss(into.sum::<f64>() / section) / section
    }

    /// Delta/2 of docs/methods.md section 3.12: half of the fall of perimeter over area for a meniscus that moves from `wet`
    /// into `dry` along an axis, to the pores ahead and to empty ones along the front.
    fn hysteresis(&self, axis: usize, up: bool, wet: usize, dry: usize) -> f64 {
        // A non-wetting liquid is repelled by narrower throats.
        let sign = if self.wetting.cosine > 0.0 { 1.0 } else { -1.0 };
        let pull = |pore: usize| sign * self.perimeter_over_area[pore];
        let (mut behind, mut ahead) = (pull(dry).max(pull(wet)), pull(dry));
        for neighbour in self.mesh.neighbours(dry) {
            let beside = pull(neighbour.pore);
            if neighbour.axis == axis && neighbour.up == up {
                ahead = ahead.min(beside);
            } else if neighbour.axis != axis && (self.empty)(neighbour.pore) {
                (behind, ahead) = (behind.max(beside), ahead.min(beside));
            }
        }
        0.5 * (behind - ahead)
    }
}

/// The faces of a pore towards full pores, with their areas, negative where a positive velocity leaves the pore.
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
    /// Adds the loss of capillary pressure by the dynamic angle to the equation of a face. The speed of a meniscus is the
    /// inflow into its pore through all faces: friction at each face alone would let a stepped front, which has more faces,
    /// pass faster.
    pub(super) fn add_dynamic_angle(&self, face: usize, entries: &mut RowEntries) {
        let ends = self.face_pores(face);
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

    /// Force on a face by p_front beyond the surface.
    pub(super) fn front_force(&self, face: usize) -> f64 {
        let ends = self.face_pores(face);
        let pressure = |pore: usize| self.fronts.pressure.get(pore).copied().unwrap_or_default();
        let pressure = match ends.map(|pore| self.unknowns.has_pressure(pore)) {
            [true, false] => -pressure(ends[1]),
            [false, true] => pressure(ends[0]),
            _ => return 0.0,
        };
        pressure * self.mesh.area(face)
    }

    /// Adds the outflow of a pore through its faces towards neighbours for which `counts` holds.
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
