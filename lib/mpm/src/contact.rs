//! Contact of the liquid with a rigid body at one node.

use std::num::NonZeroU32;

use physics::{Rheology, WallLaw};

use crate::fields::{body, wall_sum};
use crate::lanes::Lanes8;
use crate::real::Real;
use crate::settings::ShapeFunction;

/// Largest separation (cells) of liquid and body, by positions extrapolated to the node, at
/// which they are in contact.
///
/// For a plane wall touched by liquid (points at +-1/4 cell) the separation grows from 0.71 cells
/// with the node on the wall to 0.77 with the node half a cell into the liquid (GIMP and hat),
/// so 0.8, the public code's value, finds every surface by its nearest node and not by the
/// next. The quadratic B-spline reaches farther: 0.83 and 0.90 in the same places, hence 0.92.
pub(crate) fn separation_limit(shape: ShapeFunction) -> Real {
    match shape {
        ShapeFunction::Gimp | ShapeFunction::Linear => 0.8,
        ShapeFunction::Bspline2 => 0.92,
    }
}

/// Volume of a body at a node (cells) from which the node counts as inside it; a node on a
/// plane wall has one half.
const INSIDE: Real = 0.501;

/// Liquid and a body meet at a node.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Meeting {
    /// Which body.
    pub(crate) body: usize,
    /// Its velocity, m/s.
    pub(crate) velocity: [Real; 3],
    /// Unit normal from the body into the liquid.
    pub(crate) normal: [Real; 3],
    /// Contact area, cells^2 (Nairn, Hammerquist & Smith 2018).
    area: Real,
    /// The node lies inside the body.
    inside: bool,
}

fn dot(a: [Real; 3], b: [Real; 3]) -> Real {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Whether liquid and body meet at a node, and how.
///
/// `rigid` is the body's volume, gradient and first moment; `mass` and `volume` are the
/// liquid's, `sums` its first moment of mass and volume gradient. On mirror planes (`planes`,
/// bit per axis) the other half is not in the sums, and their normal components are left out.
pub(crate) fn meeting(
    body: usize,
    velocity: [Real; 3],
    rigid: &Lanes8,
    (mass, volume, sums): (Real, Real, &Lanes8),
    planes: u8,
    limit: Real,
) -> Option<Meeting> {
    let rigid_volume = rigid.0[body::VOLUME];
    let mut normal = std::array::from_fn(|a| rigid.0[body::GRADIENT + a]);
    let mut apart = [0.0; 3];
    for a in 0..3 {
        if planes & (1 << a) != 0 {
            normal[a] = 0.0;
        } else {
            apart[a] =
                sums.0[wall_sum::MOMENT + a] / mass - rigid.0[body::MOMENT + a] / rigid_volume;
        }
    }
    // The body's gradient is exact, so it gives the normal (the rigid bias of the public code);
    // in the middle of a thin wall it vanishes and the liquid's takes over.
    if dot(normal, normal) < 1e-4 * rigid_volume * rigid_volume {
        for a in 0..3 {
            if planes & (1 << a) == 0 {
                normal[a] = -sums.0[wall_sum::GRADIENT + a];
            }
        }
    }
    let length = dot(normal, normal).sqrt();
    if length <= Real::MIN_POSITIVE {
        return None;
    }
    // Behind a thin wall the body's gradient points away from the liquid; the extrapolated
    // positions still tell the side the liquid is on.
    let gap = dot(normal, apart) / length;
    let sign = if gap < 0.0 { -1.0 } else { 1.0 } / length;
    // A node inside the body is in contact whatever the separation: it has little liquid, all of
    // it far away, and left free it would let the liquid flow into the wall.
    let whole = rigid_volume * (1_u32 << planes.count_ones()) as Real;
    let inside = whole > INSIDE;
    (inside || gap.abs() < limit).then(|| Meeting {
        inside,
        body,
        velocity,
        normal: normal.map(|n| sign * n),
        area: (2.0 * volume.min(rigid_volume) * (volume + rigid_volume)).sqrt(),
    })
}

impl Meeting {
    /// Whether liquid with velocity `v` stays on the body. It is free to leave, but not at a
    /// node inside: what little liquid is felt there has no way to go, and its noise would
    /// strain the points next to the wall.
    pub(crate) fn holds(&self, v: [Real; 3]) -> bool {
        self.inside || dot(self.relative(&v), self.normal) <= 0.0
    }

    /// Contact before the forces: removes approach, and all sliding where the wall law sticks.
    /// Friction acts once a step, after the forces.
    pub(crate) fn stop_approach(&self, v: &mut [Real; 3], law: WallLaw) {
        let remaining = if law == WallLaw::Stick { 0.0 } else { 1.0 };
        self.apply(v, remaining);
    }

    /// Contact after the forces: removes approach and applies the wall law.
    ///
    /// `dt_over_mass` is dt / (m rho cell) in m2 s/kg per cell^2 of area.
    pub(crate) fn resolve<R: Rheology>(
        &self,
        v: &mut [Real; 3],
        law: WallLaw,
        rheology: &R,
        dt_over_mass: f64,
    ) {
        let slip = self.relative(v);
        let normal = dot(slip, self.normal);
        let speed = (dot(slip, slip) - normal * normal).max(0.0).sqrt();
        if !(speed.is_finite() && normal.is_finite()) {
            // No flow law has an answer; the points that this reaches end the run.
            return;
        }
        let dose = f64::from(self.area) * dt_over_mass;
        let remaining = law.remaining_slip(rheology, f64::from(speed), dose);
        self.apply(v, remaining as Real);
    }

    /// What the velocity filter asks for.
    pub(crate) fn restraint(&self) -> Restraint {
        Restraint {
            normal: self.normal,
            after: NonZeroU32::MIN.saturating_add(self.body as u32),
        }
    }

    fn relative(&self, v: &[Real; 3]) -> [Real; 3] {
        std::array::from_fn(|a| v[a] - self.velocity[a])
    }

    /// Leaves no approach and the fraction `remaining` of the sliding.
    fn apply(&self, v: &mut [Real; 3], remaining: Real) {
        let slip = self.relative(v);
        let normal = dot(slip, self.normal);
        let leaving = if self.inside { 0.0 } else { normal.max(0.0) };
        for a in 0..3 {
            let sliding = slip[a] - normal * self.normal[a];
            v[a] = self.velocity[a] + leaving * self.normal[a] + remaining * sliding;
        }
    }
}

/// A meeting as the velocity filter keeps it at a node: no more, since most nodes of a lumen have one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Restraint {
    /// Unit normal from the body into the liquid.
    normal: [Real; 3],
    /// One more than the body's place in the list, so that no restraint takes no room beside it.
    after: NonZeroU32,
}

impl Restraint {
    /// Which body.
    pub(crate) fn body(&self) -> usize {
        self.after.get() as usize - 1
    }

    /// Takes from an increment of velocity what a contact does not allow.
    pub(crate) fn restrain(&self, w: &mut [Real; 3], law: WallLaw) {
        if law == WallLaw::Stick {
            *w = [0.0; 3];
            return;
        }
        let normal = dot(*w, self.normal);
        for (w, n) in w.iter_mut().zip(self.normal) {
            *w -= normal * n;
        }
    }
}

#[cfg(test)]
mod tests {
    use physics::Table;

    use super::*;

    /// In an unstable run speeds pass every bound before a point does; no flow law may be asked about them.
    #[test]
    fn a_velocity_beyond_numbers_is_left_as_it_is() {
        let table = Table::new(&[(1.0, 210.0), (40.0, 1.7), (501.0, 1.0)]).unwrap();
        let law = WallLaw::PartialSlip {
            influence_length_m: 3e-8,
        };
        let meeting = Meeting {
            body: 0,
            velocity: [0.0; 3],
            normal: [0.0, 1.0, 0.0],
            area: 1.0,
            inside: true,
        };
        for huge in [Real::MAX, Real::INFINITY] {
            let mut v = [huge, 0.0, 0.0];
            meeting.resolve(&mut v, law, &table, 1e-3);
            assert_eq!(v, [huge, 0.0, 0.0]);
        }
        let mut v = [3.0, -1.0, 0.0];
        meeting.resolve(&mut v, law, &table, 1e-3);
        assert!(v[1] == 0.0 && v[0] > 0.0 && v[0] < 3.0, "{v:?}");
    }
}
