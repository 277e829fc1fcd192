//! The face velocities of the last step, from which a viscosity that depends on the shear rate starts.
//!
//! Velocities deposited from particles are smeared over a cell: their rates at walls are 21 % too high
//! at any resolution.

use physics::{Array, Saved};

use crate::geometry::{Domain, PAD, Window};
use crate::system::Dofs;

/// Velocities of the faces of a window, those of the air next to liquid included.
pub(super) struct LastFlow {
    window: Window,
    /// Velocity of the low face of each cell along x, y, z, m/s; NaN where there is none.
    value: [Vec<f32>; 3],
}

impl LastFlow {
    pub(super) fn new(window: Window, value: [Vec<f32>; 3]) -> Self {
        Self { window, value }
    }

    /// Velocities (m/s) at the face unknowns of `dofs` on `window`; those of `otherwise` at faces that
    /// had none.
    pub(super) fn at(&self, window: &Window, dofs: &Dofs, otherwise: &[f64]) -> Vec<f64> {
        let known = |axis: usize, index: usize| {
            let cell = window.coordinates(index);
            let mut own = [0; 3];
            for a in 0..3 {
                let place = window.low[a] + cell[a] as i64 - self.window.low[a];
                own[a] = usize::try_from(place).ok()?;
                if own[a] >= self.window.cells[a] {
                    return None;
                }
            }
            let value = self.value[axis][self.window.index(own)];
            (!value.is_nan()).then_some(f64::from(value))
        };
        (dofs.faces.iter().zip(otherwise))
            .map(|(&(axis, index), &u)| known(axis.into(), index as usize).unwrap_or(u))
            .collect()
    }

    /// As arrays of a checkpoint.
    pub(super) fn save(&self) -> [(String, Array); 2] {
        let Window { low, cells, .. } = self.window;
        let place = low.map(|x| x as f64).into_iter();
        let place = place.chain(cells.map(|n| n as f64)).collect();
        [
            ("window".into(), Array::F64(place)),
            ("face_velocity".into(), Array::F32(self.value.concat())),
        ]
    }

    /// Those of a checkpoint, for the domain of `window`.
    ///
    /// # Errors
    /// Where they are absent, or of no window of that domain.
    pub(super) fn restore(saved: &Saved, domain: Domain) -> Result<Self, String> {
        let (place, values) = (saved.f64s("window")?, saved.f32s("face_velocity")?);
        let wrong = || format!("the checkpoint's window is none of this scene: {place:?}");
        let &[a, b, c, i, j, k] = place else {
            return Err(wrong());
        };
        let (low, cells) = ([a, b, c], [i, j, k]);
        let pad = PAD as f64;
        let sound = (0..3).all(|axis| {
            let (pad, n) = match axis < domain.axes {
                true => (pad, domain.cells[axis] as f64),
                false => (0.0, 1.0),
            };
            let whole = low[axis].fract() == 0.0 && cells[axis].fract() == 0.0;
            let end = low[axis] + cells[axis];
            whole && low[axis] >= -pad && cells[axis] >= 1.0 && end <= n + pad
        });
        if !sound {
            return Err(wrong());
        }
        let window = Window {
            low: low.map(|x| x as i64),
            cells: cells.map(|n| n as usize),
            domain,
        };
        if values.len() != domain.axes * window.len() {
            return Err("the checkpoint's face velocities do not fill its window".into());
        }
        if values.iter().any(|v| v.is_infinite()) {
            return Err("a face velocity of the checkpoint is infinite".into());
        }
        let mut parts = values.chunks(window.len()).map(<[f32]>::to_vec);
        Ok(Self {
            window,
            value: std::array::from_fn(|_| parts.next().unwrap_or_default()),
        })
    }
}
