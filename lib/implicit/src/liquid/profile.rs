//! Velocity at a place in a pore, from those of its faces.

use crate::geometry::{Lattice, MIRROR, Mesh, OPEN, others};

/// A flow, to find velocities within pores. Along its own axis a velocity is linear from face to face. Across it is a
/// parabola whose means are the velocities of the face and of the faces beside it; at a wall it has the slope that the
/// influence length asks for, and none where the liquid ends: the profile of Poiseuille flow where faces have its fluxes.
pub(crate) struct Profile<'a> {
    pub(crate) lattice: &'a Lattice,
    pub(crate) mesh: &'a Mesh,
    /// Velocity of each face against the grid, and the closing speed, cells/s.
    pub(crate) velocity: &'a [f64],
    pub(crate) speed: f64,
    /// Influence length of the walls, cells; infinite without friction.
    pub(crate) influence_length: f64,
}

/// Velocities of the columns of voxels at a side of a pore, by their place across: the first axis runs fastest.
type Columns = [Option<f64>; 4];

/// The pores behind the voxel faces at the sides of a pore, by axis, side and place across.
type Around = [[[Option<u32>; 4]; 2]; 3];

/// What one side of a column asks of u(y) - mean = a y + c (y^2 - h^2/12): that `slope` times a, away from the column's
/// middle, and `curvature` times c add up to `difference`.
#[derive(Clone, Copy, Debug)]
struct Side {
    slope: f64,
    curvature: f64,
    difference: f64,
}

impl Side {
    /// The end of the liquid, or a wall without friction, of a column of height `h`.
    fn free(h: f64) -> Self {
        Self {
            slope: 1.0,
            curvature: h,
            difference: 0.0,
        }
    }

    /// A wall that goes faster by `difference` and is slipped along by `length` times the slope.
    fn wall(h: f64, length: f64, difference: f64) -> Self {
        Self {
            slope: 0.5 * h + length,
            curvature: h * h / 6.0 + length * h,
            difference,
        }
    }

    /// A column of height `beside` that is faster by `difference`.
    fn column(h: f64, beside: f64, difference: f64) -> Self {
        Self {
            slope: 0.5 * (h + beside),
            curvature: h * h / 6.0 + 0.5 * h * beside + beside * beside / 3.0,
            difference,
        }
    }
}

/// a and c by what the low and the high side ask for.
fn parabola([low, high]: [Side; 2]) -> [f64; 2] {
    let determinant = low.slope * high.curvature + high.slope * low.curvature;
    [
        (high.difference * low.curvature - low.difference * high.curvature) / determinant,
        (high.difference * low.slope + low.difference * high.slope) / determinant,
    ]
}

impl Profile<'_> {
    /// Velocities at the middles of the voxels of a pore, in their order, cells/s.
    pub(crate) fn of_pore(&self, pore: usize) -> impl Iterator<Item = [f64; 3]> {
        let around = self.around(pore);
        let sides: [[Columns; 2]; 3] = std::array::from_fn(|axis| {
            [false, true].map(|up| match self.lattice.flat && axis == 2 {
                true => [None; 4],
                false => self.columns(pore, &around, axis, up),
            })
        });
        let at = move |voxel: [usize; 3]| {
            std::array::from_fn(|axis| {
                let [(first, low), (last, high)] = [false, true]
                    .map(|up| self.end(pore, voxel, &sides[axis][usize::from(up)], axis, up));
                let part = (voxel[axis] as f64 + 0.5 - first) / (last - first);
                let between = |a: f64, b: f64| a + part * (b - a);
                let own = match (low, high) {
                    (Some(low), Some(high)) => between(low, high),
                    (one, other) => one.or(other).unwrap_or(0.0),
                };
                let [low, high] = [false, true].map(|up| self.frame(pore, axis, up));
                own + between(low, high)
            })
        };
        self.mesh.voxels(pore).map(at)
    }

    fn around(&self, pore: usize) -> Around {
        let mut around = Around::default();
        for way in self.mesh.ways(pore) {
            let open = self.mesh.faces[way.face].open;
            for (place, beside) in around[way.axis][usize::from(way.up)].iter_mut().enumerate() {
                if open >> place & 1 == 1 {
                    *beside = Some(way.beside as u32);
                }
            }
        }
        around
    }

    /// Velocity of a pore by the means of its faces on the two sides along each axis, cells/s.
    pub(crate) fn mean(&self, pore: usize) -> [f64; 3] {
        let mesh = self.mesh;
        std::array::from_fn(|axis| {
            let side = |up: bool| {
                let faces = mesh.faces_at(pore, axis, up);
                let (flux, area) = faces.fold((0.0, 0.0), |(flux, area), face| {
                    let own = mesh.area(face);
                    (flux + own * self.velocity[face], area + own)
                });
                self.frame(pore, axis, up) + if area > 0.0 { flux / area } else { 0.0 }
            };
            0.5 * (side(false) + side(true))
        })
    }

    /// Velocity of the grid along an axis at one side of a pore's cell.
    fn frame(&self, pore: usize, axis: usize, up: bool) -> f64 {
        if axis != 1 {
            return 0.0;
        }
        let row = self.mesh.row_of(pore);
        let share = self.mesh.rows().share(row + usize::from(up));
        self.lattice.speed_at(share) * self.speed
    }

    /// Where a voxel's column along an axis ends, voxels from the low side of the cell, and the velocity against the grid there,
    /// of those of the side; none where the liquid ends.
    fn end(
        &self,
        pore: usize,
        voxel: [usize; 3],
        side: &Columns,
        axis: usize,
        up: bool,
    ) -> (f64, Option<f64>) {
        let mesh = self.mesh;
        let mut last = voxel;
        let end = if up { mesh.k - 1 } else { 0 };
        while last[axis] != end {
            let mut next = last;
            next[axis] = if up { last[axis] + 1 } else { last[axis] - 1 };
            if !mesh.holds(pore, next) {
                return ((last[axis] + usize::from(up)) as f64, Some(0.0));
            }
            last = next;
        }
        let [s, t] = others(axis);
        let own = side[last[s] + mesh.k * last[t]];
        ((last[axis] + usize::from(up)) as f64, own)
    }

    /// Whether a face had a velocity in the step: others have none at all.
    fn moves(&self, face: usize) -> bool {
        self.velocity[face] != 0.0
    }

    /// Velocities against the grid of the columns of voxels at one side of a pore: 0 at walls, none where the liquid ends.
    fn columns(&self, pore: usize, around: &Around, axis: usize, up: bool) -> Columns {
        let (mesh, across) = (self.mesh, others(axis));
        let k = mesh.k;
        let mut side: Columns = [Some(0.0); 4];
        for face in mesh.faces_at(pore, axis, up) {
            let mut departures = [0.0; 4];
            for (&t, other) in across.iter().zip([across[1], across[0]]) {
                let counts = self.moves(face) && !(self.lattice.flat && t == 2);
                for place in 0..if counts { k } else { 0 } {
                    let mut voxel = [0; 3];
                    voxel[axis] = if up { k - 1 } else { 0 };
                    voxel[other] = place;
                    self.add_departures(face, (pore, around), voxel, t, |at, departure| {
                        departures[at[across[0]] + k * at[across[1]]] += departure;
                    });
                }
            }
            for (place, own) in side.iter_mut().enumerate() {
                if mesh.faces[face].open >> place & 1 == 1 {
                    *own = (self.moves(face)).then(|| departures[place] + self.velocity[face]);
                }
            }
        }
        side
    }

    /// Adds what the velocities in the middles of the voxels of a face's column along `t` differ by from the column's mean.
    fn add_departures(
        &self,
        face: usize,
        (pore, around): (usize, &Around),
        mut voxel: [usize; 3],
        t: usize,
        mut add: impl FnMut([usize; 3], f64),
    ) {
        let mesh = self.mesh;
        let edge = mesh.edge(pore, t) / mesh.k as f64;
        let Some([first, last]) = self.column(face, voxel, t) else {
            return;
        };
        let height = edge * (last + 1 - first) as f64;
        let sides = [(first, false), (last, true)].map(|(i, up)| {
            let mut end = voxel;
            end[t] = i;
            self.side(face, (pore, around), end, (t, up), height)
        });
        let [slope, curvature] = parabola(sides);
        let middle = 0.5 * (first + last + 1) as f64;
        for i in first..=last {
            voxel[t] = i;
            let y = edge * (i as f64 + 0.5 - middle);
            let departure = slope * y + curvature * (y * y - height * height / 12.0);
            add(voxel, departure);
        }
    }

    /// The first and the last of the voxels along `t` through `voxel` that a face is open to, if it is to any.
    fn column(&self, face: usize, voxel: [usize; 3], t: usize) -> Option<[usize; 2]> {
        let is_open = |&i: &usize| {
            let mut at = voxel;
            at[t] = i;
            self.mesh.is_open(face, at)
        };
        let mut open = (0..self.mesh.k).filter(is_open);
        let first = open.next()?;
        Some([first, open.next_back().unwrap_or(first)])
    }

    /// What a column of a face ends at beyond a voxel, which is its last.
    fn side(
        &self,
        face: usize,
        (pore, around): (usize, &Around),
        voxel: [usize; 3],
        (t, up): (usize, bool),
        height: f64,
    ) -> Side {
        let mesh = self.mesh;
        let (f, cell) = (mesh.faces[face], mesh.cell(pore));
        let axis = usize::from(f.axis);
        let own = self.velocity[face];
        // The one of the two along `t`, in this cell or beyond its side.
        let mut next = voxel;
        next[t] = mesh.k - 1 - voxel[t];
        let open = match voxel[t] == if up { mesh.k - 1 } else { 0 } {
            false => mesh.pore_with(cell, next),
            true => {
                let [a, b] = others(t);
                let beside = around[t][usize::from(up)][voxel[a] + mesh.k * voxel[b]];
                beside.map(|pore| pore as usize)
            }
        };
        let Some(open) = open else {
            let code = (mesh.next_voxel(cell, voxel, t, up))
                .map_or(MIRROR, |(cell, at)| mesh.code(cell, at));
            let length = self.influence_length;
            let is_wall = code != OPEN && code != MIRROR && length.is_finite();
            return match is_wall {
                true => Side::wall(height, length, self.wall(code, face, axis) - own),
                false => Side::free(height),
            };
        };
        let mut others = mesh.faces_at(open, axis, f.low as usize == pore);
        let other = others.find(|&other| mesh.is_open(other, next));
        let Some(other) = other.filter(|&other| other != face && self.moves(other)) else {
            return Side::free(height);
        };
        let edge = mesh.edge(open, t) / mesh.k as f64;
        let [first, last] = self.column(other, next, t).unwrap_or([next[t]; 2]);
        let beyond = edge * (last + 1 - first) as f64;
        Side::column(height, beyond, self.velocity[other] - own)
    }

    /// Velocity of a wall along an axis against the grid at a face.
    fn wall(&self, code: u8, face: usize, axis: usize) -> f64 {
        let body = usize::from(code - 1);
        match axis {
            1 => {
                let frame = self.mesh.frame(self.lattice, face);
                (self.lattice.speed_of(body) - frame) * self.speed
            }
            _ => self.lattice.slide[body][axis],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// u = 3 + 2 y + 5 y^2 over a height of 0.5, beside columns of 0.25, and walls that are slipped along by 0.1 times the
    /// slope.
    #[test]
    fn a_parabola_is_found_again_from_its_sides() {
        let (h, beside, length) = (0.5, 0.25, 0.1);
        let sum = |y: f64| 3.0 * y + y * y + 5.0 * y.powi(3) / 3.0;
        let mean = |from: f64, to: f64| (sum(to) - sum(from)) / (to - from);
        let own = mean(-0.25, 0.25);
        let slope = |y: f64| 2.0 + 10.0 * y;
        let wall = |y: f64| 3.0 + 2.0 * y + 5.0 * y * y + 4.0 * y * length * slope(y) - own;
        let walls = [-0.25, 0.25].map(|y| Side::wall(h, length, wall(y)));
        let columns = [mean(-0.5, -0.25), mean(0.25, 0.5)];
        let columns = columns.map(|mean| Side::column(h, beside, mean - own));
        for sides in [
            columns,
            walls,
            [walls[0], columns[1]],
            [columns[0], walls[1]],
        ] {
            let [a, c] = parabola(sides);
            assert!(
                (a - 2.0).abs() < 1e-12 && (c - 5.0).abs() < 1e-12,
                "{a} {c}"
            );
        }
        // u = 5 (y + 0.25)^2, without slope at -0.25: means 5/12 and 95/48.
        let [a, c] = parabola([
            Side::free(h),
            Side::column(h, beside, 95.0 / 48.0 - 5.0 / 12.0),
        ]);
        assert!(
            (a - 2.5).abs() < 1e-12 && (c - 5.0).abs() < 1e-12,
            "{a} {c}"
        );
    }
}
