//! A body under a known force, whose speed is one more unknown of the coupled system.

use crate::fgmres::{Operator, Precondition};
use crate::preconditioner::Preconditioner;
use crate::vector::{Real, Work, add_scaled, dot};
use crate::{SaddleSystem, SolveError};

/// Coupling of a body's speed V to the system, and the force F on the body:
/// `[A, -G^T, -m; -G, -C, s; -m^T, s^T, d] [u; p; V] = [b; -g; F]`, with b and g for V = 0.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Load {
    /// m: momentum that unit speed drags into each face.
    pub momentum: Vec<f64>,
    /// s: volume that unit speed displaces in each cell.
    pub source: Vec<f64>,
    /// d: force per speed on the body, with liquid at rest and without pressure.
    pub resistance: f64,
    /// F: force on the body.
    pub force: f64,
    /// Scale of errors of F, above zero: F itself, or more if F is almost zero.
    pub scale: f64,
}

impl Load {
    pub(crate) fn check(&self, system: &SaddleSystem) -> Result<(), SolveError> {
        assert_eq!(
            [self.momentum.len(), self.source.len()],
            [system.a.n_rows(), system.g.n_rows()]
        );
        // A body that no liquid touches meets no resistance.
        let acts = |values: &[f64]| values.iter().any(|v| *v != 0.0);
        if self.resistance == 0.0 && !acts(&self.momentum) && !acts(&self.source) {
            return Err(SolveError::Matrix(
                "a load on a body without resistance: its speed is unbounded".into(),
            ));
        }
        let finite = self.scale.is_finite() && self.force.is_finite();
        if finite && self.scale > 0.0 && self.resistance >= 0.0 {
            return Ok(());
        }
        Err(SolveError::Matrix(format!(
            "a load of {} measured by {} against a resistance of {}; the measure must be positive and the \
             resistance not negative",
            self.force, self.scale, self.resistance
        )))
    }

    /// The load for the relative velocities w, with u = w + t V, and t = m/A_ff: the velocity per V of each face by itself.
    /// Liquid that is tightly bound to the body and the body drag each other with nearly equal forces; in terms of u a
    /// preconditioner would have to resolve their small difference.
    pub(crate) fn relative_to_body(&self, system: &SaddleSystem) -> (Self, Vec<f64>) {
        let (a, g) = (system.a, system.g);
        let shares: Vec<f64> = (self.momentum.iter().zip(a.diagonal()))
            .map(|(momentum, own)| momentum / own)
            .collect();
        let mut dragged = vec![0.0; shares.len()];
        a.multiply(&shares, &mut dragged);
        let momentum: Vec<f64> = (self.momentum.iter().zip(&dragged))
            .map(|(momentum, dragged)| momentum - dragged)
            .collect();
        let source = (self.source.iter().enumerate())
            .map(|(cell, source)| source - g.row_times_wide(cell, &shares))
            .collect();
        let relative = Self {
            resistance: self.resistance - dot(&self.momentum, &shares) - dot(&momentum, &shares),
            momentum,
            source,
            force: self.force + dot(&shares, system.b),
            scale: self.scale,
        };
        (relative, shares)
    }

    /// [`SaddleSystem::motion_scale`] with the body moving at `speed`.
    pub(crate) fn motion_scale(&self, system: &SaddleSystem, speed: f64) -> f64 {
        let moving = |known: &[f64], unit: &[f64]| -> Vec<f64> {
            (known.iter().zip(unit))
                .map(|(known, unit)| known + speed * unit)
                .collect()
        };
        let moved = moving(system.volume_source, &self.source);
        system.motion_scale(&moving(system.b, &self.momentum), &moved)
    }

    /// The column of V without its last entry, times `weight`.
    fn column(&self, weight: f64) -> Vec<Work> {
        let momentum = self.momentum.iter().map(|m| Work::nearest(-weight * m));
        momentum
            .chain(self.source.iter().map(|s| Work::nearest(weight * s)))
            .collect()
    }
}

/// The system with the row and the column of the body, both scaled by a weight.
pub(crate) struct LoadedOperator<'a, K> {
    pub(crate) inner: &'a mut K,
    pub(crate) load: &'a Load,
    pub(crate) weight: f64,
}

impl<K: Operator> Operator for LoadedOperator<'_, K> {
    fn apply<X: Real>(&mut self, x: &[X], y: &mut [f64]) {
        let (load, weight) = (self.load, self.weight);
        let ((x, speed), (y, force)) = (split(x), y.split_at_mut(y.len() - 1));
        self.inner.apply(x, y);
        let speed: f64 = speed.into();
        let (y_u, y_p) = y.split_at_mut(load.momentum.len());
        add_scaled(y_u, -weight * speed, &load.momentum);
        add_scaled(y_p, weight * speed, &load.source);
        let (u, p) = x.split_at(load.momentum.len());
        force[0] = weight * (dot(&load.source, p) - dot(&load.momentum, u))
            + weight * weight * load.resistance * speed;
    }
}

/// The values before the last one, and the last one.
fn split<X: Real>(x: &[X]) -> (&[X], X) {
    let (rest, last) = x.split_at(x.len() - 1);
    (rest, last[0])
}

/// The preconditioner M of the system without the body, bordered by the body's row and column. With the column k of V and
/// z = M^-1 k it takes V = (r_V - k^T M^-1 r)/(d - k^T z) and x = M^-1 r - V z. Sealed pockets of n cells have the mean
/// pressure (s V - r)/C, with the means s of the column and r of the residual: this adds sum n s^2/C to d and sum n s r/C to
/// r_V.
pub(crate) struct Bordered<'a, 'b> {
    inner: &'b mut Preconditioner<'a>,
    faces: usize,
    column: Vec<Work>,
    response: Vec<Work>,
    /// Mean over each sealed pocket of the volumes that unit speed displaces.
    moved: Vec<f64>,
    /// d times the square of the weight.
    resistance: f64,
    pivot: f64,
}

impl<'a, 'b> Bordered<'a, 'b> {
    pub(crate) fn new(inner: &'b mut Preconditioner<'a>, load: &Load, weight: f64) -> Self {
        let source: Vec<f64> = load.source.iter().map(|s| weight * s).collect();
        let mut bordered = Self {
            faces: load.momentum.len(),
            column: load.column(weight),
            response: Vec::new(),
            moved: inner.sealed().displaced(&source),
            resistance: weight * weight * load.resistance,
            pivot: 0.0,
            inner,
        };
        bordered.update_response();
        bordered
    }

    /// Computes the response z to the column, and the pivot.
    fn update_response(&mut self) {
        self.inner.apply(&self.column, &mut self.response);
        // Positive if the preconditioner is close enough to the system, which resists motion.
        let pivot = self.resistance - dot(&self.column, &self.response)
            + self.inner.sealed().force(&self.moved, &self.moved);
        self.pivot = pivot.abs().max(f64::MIN_POSITIVE);
    }
}

impl Precondition for Bordered<'_, '_> {
    fn apply(&mut self, r: &[Work], z: &mut Vec<Work>) {
        let (r, force) = r.split_at(r.len() - 1);
        self.inner.apply(r, z);
        let (sealed, faces) = (self.inner.sealed(), self.faces);
        let means = sealed.means(&r[faces..]);
        let force = f64::from(force[0]) - dot(&self.column, z) + sealed.force(&self.moved, &means);
        let speed = force / self.pivot;
        add_scaled(z, -speed, &self.response);
        // Pockets in which the body displaces nothing are left to the correction in double precision.
        let residuals = means.iter().zip(&self.moved).map(|(r, moved)| match moved {
            0.0 => 0.0,
            moved => r - moved * speed,
        });
        sealed.subtract(&sealed.negative_pressures(residuals), &mut z[faces..]);
        z.push(Work::nearest(speed));
    }

    fn strengthen(&mut self) -> bool {
        let stronger = self.inner.strengthen();
        if stronger {
            self.update_response();
        }
        stronger
    }

    /// Adds the mean pressures of sealed pockets and the speed: beside them, the rest would be lost in single precision.
    fn correct_in_double(&self, r: &[f64], x: &mut [f64]) -> bool {
        let sealed = self.inner.sealed();
        if sealed.is_empty() {
            return false;
        }
        let ((r, force), (x, speed)) = (split(r), x.split_at_mut(x.len() - 1));
        let means = sealed.means(&r[self.faces..]);
        let change = (force + sealed.force(&self.moved, &means)) / self.pivot;
        let residuals = means
            .iter()
            .zip(&self.moved)
            .map(|(r, moved)| r - moved * change);
        sealed.subtract(&sealed.negative_pressures(residuals), &mut x[self.faces..]);
        speed[0] += change;
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Csr, VelocityBlock};

    /// Two faces and a cell: 3 and 4 N on the faces at rest; the body's speed adds 2 to the second face and 8 to the cell.
    #[test]
    fn the_tolerance_is_measured_by_what_moves() {
        let a = VelocityBlock::assemble(2, |row, entries| entries.add(row, 1.0)).unwrap();
        let g = Csr::assemble(1, 2, |_, entries| entries.add(0, 1.0)).unwrap();
        let load = Load {
            momentum: vec![0.0, 1.0],
            source: vec![4.0],
            resistance: 1.0,
            force: 4.0,
            scale: 4.0,
        };
        let measure = |b: &[f64; 2], speed: f64| {
            let system = SaddleSystem {
                b,
                carried: &[3e3],
                ..SaddleSystem::still(&a, &g, &[1.0; 2], &[0.0; 2])
            };
            load.check(&system).unwrap();
            load.motion_scale(&system, speed)
        };
        // sqrt(3^2 + (4 + 2)^2 + 8^2) = sqrt(109).
        assert!((measure(&[3.0, 4.0], 2.0) - 109_f64.sqrt()).abs() < 1e-12);
        assert_eq!(measure(&[3.0, 4.0], 0.0), 5.0);
        assert_eq!(
            measure(&[0.0; 2], 0.0),
            3.0,
            "nothing moves but what was compressed"
        );
    }
}
