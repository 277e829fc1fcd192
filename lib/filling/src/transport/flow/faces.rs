//! The profiles of all faces, and the walls ahead of them.

use rayon::prelude::*;

use super::profile::{Across, Profile};
use super::seen::{Seen, TOUCH, extent, see};
use super::{LEAST_RUN, tangents};
use crate::geometry::{Column, Lattice, OPEN, SIDE};
use crate::system::NONE;

/// A wall this close ahead (cells) leaves a sliver, in which a face's velocity follows from the
/// wall's and the next face's.
const SLIVER: f64 = 0.5;
/// Faces per task.
const CHUNK: usize = 1 << 12;

/// Velocity over the control volume of a face and what lies ahead of it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Face {
    pub(super) profile: Profile,
    /// Distance along the axis to the wall that closes the next face below and above; infinite
    /// when that one is open.
    run: [f32; 2],
    /// Velocities of those walls along the axis.
    wall: [f32; 2],
    /// Bit 2 t: reaches beyond its own edge above along tangent t, bit 2 t + 1: below.
    pub(super) reaches: u8,
}

impl Face {
    /// Velocity at a distance towards the wall below (0) or above (1), falling linearly from
    /// `value` at the face to the wall's, which counts as 0 without `MOTION`.
    #[inline]
    pub(super) fn towards_wall<const MOTION: bool>(
        &self,
        side: usize,
        distance: f64,
        value: f64,
    ) -> f64 {
        let wall = if MOTION { self.wall[side].into() } else { 0.0 };
        wall + (value - wall) * (1.0 - distance / f64::from(self.run[side])).max(0.0)
    }
}

/// Slots of the faces with a value, and the faces.
pub(super) fn build(
    lattice: &Lattice,
    value: &[Vec<f32>; 3],
    active: &[Vec<u32>; 3],
    bodies: &[[f64; 3]],
    influence: f64,
) -> ([Vec<u32>; 3], Vec<Face>) {
    let window = &lattice.window;
    let mut known: Vec<(u8, u32)> = Vec::new();
    for (axis, value) in value.iter().enumerate().take(window.domain.axes) {
        known.par_extend(
            (value.par_iter().enumerate().with_min_len(CHUNK)).filter_map(|(index, v)| {
                let within = || window.inner(window.coordinates(index));
                (!v.is_nan() && within()).then_some((axis as u8, index as u32))
            }),
        );
    }
    let mut slot: [Vec<u32>; 3] = std::array::from_fn(|axis| {
        let n = if axis < window.domain.axes {
            window.len()
        } else {
            0
        };
        vec![NONE; n]
    });
    for (place, &(axis, index)) in known.iter().enumerate() {
        slot[usize::from(axis)][index as usize] = place as u32;
    }
    let seen = (known.par_iter().with_min_len(CHUNK))
        .map(|&(axis, index)| see(lattice, axis.into(), index as usize))
        .collect();
    let builder = Builder {
        lattice,
        value,
        active,
        bodies,
        influence,
        slot: &slot,
        seen,
    };
    let faces = (known.par_iter().with_min_len(CHUNK))
        .map(|&(axis, index)| builder.face(axis.into(), index as usize))
        .collect();
    (slot, faces)
}

struct Builder<'a> {
    lattice: &'a Lattice,
    value: &'a [Vec<f32>; 3],
    active: &'a [Vec<u32>; 3],
    bodies: &'a [[f64; 3]],
    influence: f64,
    slot: &'a [Vec<u32>; 3],
    /// What each face sees along its tangents.
    seen: Vec<[Seen; 2]>,
}

impl Builder<'_> {
    fn body(&self, id: u8, axis: usize) -> f64 {
        if id < OPEN {
            self.bodies[usize::from(id)][axis]
        } else {
            0.0
        }
    }

    fn seen(&self, axis: usize, index: usize) -> Option<&[Seen; 2]> {
        self.seen.get(*self.slot[axis].get(index)? as usize)
    }

    fn face(&self, axis: usize, index: usize) -> Face {
        let cell = self.lattice.window.coordinates(index);
        let mut u = f64::from(self.value[axis][index]);
        let (mut run, mut wall) = ([f32::INFINITY; 2], [0.0; 2]);
        for side in 0..2 {
            if let Some((distance, velocity)) = self.ahead(axis, index, cell, side == 1) {
                run[side] = distance.max(LEAST_RUN) as f32;
                wall[side] = velocity as f32;
                if distance < SLIVER - TOUCH
                    && let Some(next) = self.behind(axis, index, side == 1)
                {
                    u = velocity + distance * (next - velocity) / (1.0 + distance);
                }
            }
        }
        let mut reaches = 0;
        let mut across = [Across::FLAT; 2];
        for (which, seen) in self.seen(axis, index).into_iter().flatten().enumerate() {
            across[which] = self.across(axis, index, which, seen);
            reaches |= seen.reaches << (2 * which);
        }
        Face {
            profile: Profile::new(u, across),
            run,
            wall,
            reaches,
        }
    }

    /// Distance to and velocity of the wall ahead, when the next face is closed.
    fn ahead(&self, axis: usize, index: usize, cell: [usize; 3], up: bool) -> Option<(f64, f64)> {
        let stride = self.lattice.window.stride(axis);
        let next = if up { index + stride } else { index - stride };
        let state = *self.lattice.faces[axis].get(next)?;
        if state == OPEN {
            return None;
        }
        if state == SIDE {
            return Some((1.0, 0.0));
        }
        let centre = self.lattice.window.face_centre(axis, cell);
        let tangents = self.lattice.tangents(axis);
        let mut farthest = 0.0;
        let mut body = state;
        for corner in 0..1_usize << tangents.len() {
            let mut point = centre;
            for (bit, &t) in tangents.iter().enumerate() {
                point[t] += [-0.25, 0.25][corner >> bit & 1];
            }
            match self.lattice.solids.ray(point, axis, up, 1.0) {
                Some(hit) if hit.near > farthest => (farthest, body) = (hit.near, hit.body),
                Some(_) => {}
                None => farthest = 1.0,
            }
        }
        Some((farthest, self.body(body, axis)))
    }

    /// The solved velocity of the next face on the side away from the wall.
    fn behind(&self, axis: usize, index: usize, wall_above: bool) -> Option<f64> {
        let stride = self.lattice.window.stride(axis);
        let next = if wall_above {
            index.checked_sub(stride)?
        } else {
            index + stride
        };
        let solved = *self.active[axis].get(next)? != NONE;
        solved.then(|| f64::from(self.value[axis][next]))
    }

    fn across(&self, axis: usize, index: usize, which: usize, seen: &Seen) -> Across {
        if seen.nearest.touches(0) || seen.nearest.touches(1) {
            if self.influence.is_infinite() {
                return Across::FLAT;
            }
            if seen.uneven {
                return self.along_steps(axis, index, which);
            }
            return self.walled(axis, &seen.nearest);
        }
        if self.active[axis][index] == NONE {
            return Across::FLAT;
        }
        let own = f64::from(self.value[axis][index]);
        let sides = [false, true].map(|up| self.neighbour(axis, index, which, up, seen));
        match sides {
            [Some((below, w)), Some((above, v))] => {
                Across::free([below - own, above - own], [w, v])
            }
            _ => Across::FLAT,
        }
    }

    /// The profile between the walls of a column, of which one is near.
    fn walled(&self, axis: usize, column: &Column) -> Across {
        let [low, high] = column.distance;
        let above = !(column.touches(0) && (!column.touches(1) || low <= high));
        let (d, opposite) = if above { (high, low) } else { (low, high) };
        let velocity = self.body(column.body[usize::from(above)], axis);
        Across::wall(
            velocity,
            above,
            [d, opposite, column.width(), self.influence],
        )
    }

    /// The profile where the columns of a face meet different walls, as along the steps of voxels:
    /// that between the farthest ones, with mean 1 over the open parts of the columns. The
    /// parabola between the nearest ones would be far below zero in the rest.
    fn along_steps(&self, axis: usize, index: usize, which: usize) -> Across {
        let cell = self.lattice.window.coordinates(index);
        let columns = self.lattice.columns(axis, cell, tangents(axis)[which]);
        let open = columns.iter().filter(|column| !column.blocked());
        let farthest = open.clone().fold(None, |farthest: Option<Column>, column| {
            let mut all = farthest.unwrap_or(*column);
            for side in 0..2 {
                if column.distance[side] > all.distance[side] {
                    all.distance[side] = column.distance[side];
                    all.body[side] = column.body[side];
                }
            }
            Some(all)
        });
        match farthest {
            Some(all) if all.touches(0) || all.touches(1) => {
                self.walled(axis, &all).with_mean_over(open.map(extent))
            }
            _ => Across::FLAT,
        }
    }

    /// Velocity and width of the control volume of the next face across, if the solve determined
    /// it. Beyond a symmetry plane it is the mirror image of the face.
    fn neighbour(
        &self,
        axis: usize,
        index: usize,
        which: usize,
        up: bool,
        seen: &Seen,
    ) -> Option<(f64, f64)> {
        let side = usize::from(up);
        if seen.nearest.body[side] == SIDE && seen.nearest.distance[side] <= 0.5 + TOUCH {
            return Some((f64::from(self.value[axis][index]), 1.0));
        }
        let stride = self.lattice.window.stride(tangents(axis)[which]);
        let next = if up {
            index + stride
        } else {
            index.checked_sub(stride)?
        };
        if *self.active[axis].get(next)? == NONE {
            return None;
        }
        let beyond = &self.seen(axis, next)?[which].nearest;
        let wall = beyond.touches(side);
        let width = if wall {
            0.5 + beyond.distance[side]
        } else {
            1.0
        };
        Some((f64::from(self.value[axis][next]), width))
    }
}
