//! Moving particles through a step.

use physics::Boundary;
use rayon::prelude::*;

use crate::geometry::{Domain, Solids};
use crate::liquid::Particles;

/// Particles per task and partial count.
const CHUNK: usize = 1 << 13;
/// Distance (cells) that particles keep from symmetry planes.
const CLEARANCE: f64 = 1e-6;

/// Where and when particles move: bodies at the start and the end of the step.
#[derive(Clone, Copy)]
pub(crate) struct Path<'a> {
    /// Bodies at the start.
    pub(crate) before: &'a Solids,
    /// Bodies at the end.
    pub(crate) after: &'a Solids,
    /// Cells per velocity unit: the time step over the cell for velocities in m/s.
    pub(crate) scale: f64,
}

/// What a move met.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Moved {
    /// Particles that a wall deflected.
    pub(crate) deflected: u64,
    /// Largest distance (cells) that one would have been behind its wall.
    pub(crate) deepest: f64,
    /// Particles between closing walls that found no free place nearby; they are in a solid.
    pub(crate) pinched: u64,
    /// Particles that left through an open side, and were removed.
    pub(crate) lost: u64,
}

impl Path<'_> {
    /// Moves the particles along `velocity` by the midpoint rule, and off walls; those that leave
    /// through an open side are removed. A task hands what it keeps for `velocity` from point to point.
    pub(crate) fn follow<N: Default>(
        &self,
        particles: &mut Particles,
        velocity: impl Fn([f64; 3], &mut N) -> [f64; 3] + Sync,
    ) -> Moved {
        if self.after.is_empty() {
            self.follow_by::<false, N>(particles, velocity)
        } else {
            self.follow_by::<true, N>(particles, velocity)
        }
    }

    /// The same, where there are `WALLS` or none.
    fn follow_by<const WALLS: bool, N: Default>(
        &self,
        particles: &mut Particles,
        velocity: impl Fn([f64; 3], &mut N) -> [f64; 3] + Sync,
    ) -> Moved {
        let sides = Sides::new(&self.after.domain);
        let counts: Vec<Moved> = (particles.position.par_chunks_mut(CHUNK))
            .map(|chunk| {
                let (mut moved, mut near) = (Moved::default(), N::default());
                for x in chunk {
                    let first = velocity(*x, &mut near);
                    let half = sides.inside(self.shifted(*x, first, 0.5));
                    let second = velocity(half, &mut near);
                    let mut end = sides.symmetric(self.shifted(*x, second, 1.0));
                    if WALLS {
                        end = sides.symmetric(self.off_walls(*x, end, &mut moved));
                    }
                    *x = sides.wrapped(end);
                }
                moved
            })
            .collect();
        let mut moved = Moved::default();
        for part in counts {
            moved.deflected += part.deflected;
            moved.deepest = moved.deepest.max(part.deepest);
            moved.pinched += part.pinched;
        }
        let domain = self.after.domain;
        if (0..domain.axes).any(|a| domain.boundary[a] == Boundary::Open) {
            moved.lost = particles
                .retain(|x| (0..domain.axes).all(|a| x[a] >= 0.0 && x[a] < domain.cells[a] as f64))
                as u64;
        }
        moved
    }

    /// Where the particles get with the velocities they carry, off walls and in the domain; none goes
    /// further than a cell along an axis.
    pub(crate) fn ahead(&self, particles: &Particles) -> Vec<[f64; 3]> {
        if self.after.is_empty() {
            self.ahead_by::<false>(particles)
        } else {
            self.ahead_by::<true>(particles)
        }
    }

    /// The same, where there are `WALLS` or none.
    fn ahead_by<const WALLS: bool>(&self, particles: &Particles) -> Vec<[f64; 3]> {
        let sides = Sides::new(&self.after.domain);
        (particles.position.par_iter().zip(&particles.velocity))
            .map(|(&x, v)| {
                let way = v.map(|v| (self.scale * f64::from(v)).clamp(-1.0, 1.0));
                let mut end = sides.inside(std::array::from_fn(|a| x[a] + way[a]));
                if WALLS {
                    end = self.before.deflect(self.after, x, end).point;
                }
                sides.wrapped(sides.inside(end))
            })
            .collect()
    }

    #[inline]
    fn shifted(&self, x: [f64; 3], velocity: [f64; 3], part: f64) -> [f64; 3] {
        std::array::from_fn(|a| x[a] + part * self.scale * velocity[a])
    }

    /// The end of a path to `to` that passes no wall.
    fn off_walls(&self, from: [f64; 3], to: [f64; 3], moved: &mut Moved) -> [f64; 3] {
        let end = self.before.deflect(self.after, from, to);
        if end.depth > 0.0 {
            moved.deflected += 1;
            moved.deepest = moved.deepest.max(end.depth);
        }
        moved.pinched += u64::from(end.pinched);
        end.point
    }
}

/// The sides of the domain.
struct Sides {
    /// Least and most place along each axis that is still in the domain; periodic axes have no end.
    ends: [[f64; 2]; 3],
    /// The same, where only symmetry planes are ends.
    planes: [[f64; 2]; 3],
    /// Cells along periodic axes.
    period: [Option<f64>; 3],
}

impl Sides {
    fn new(domain: &Domain) -> Self {
        let between = |held: &dyn Fn(usize) -> bool| {
            std::array::from_fn(|a| match a < domain.axes && held(a) {
                true => [CLEARANCE, domain.cells[a] as f64 - CLEARANCE],
                false => [f64::NEG_INFINITY, f64::INFINITY],
            })
        };
        Self {
            ends: between(&|a| !domain.periodic(a)),
            planes: between(&|a| domain.boundary[a] == Boundary::Symmetry),
            period: std::array::from_fn(|a| domain.periodic(a).then_some(domain.cells[a] as f64)),
        }
    }

    /// A point kept in the domain, so that the window has a cell for it.
    #[inline]
    fn inside(&self, x: [f64; 3]) -> [f64; 3] {
        std::array::from_fn(|a| x[a].clamp(self.ends[a][0], self.ends[a][1]))
    }

    /// A point kept off the symmetry planes.
    #[inline]
    fn symmetric(&self, x: [f64; 3]) -> [f64; 3] {
        std::array::from_fn(|a| x[a].clamp(self.planes[a][0], self.planes[a][1]))
    }

    /// A point that has left through a periodic side where it comes in again.
    #[inline]
    fn wrapped(&self, mut x: [f64; 3]) -> [f64; 3] {
        for (x, period) in x.iter_mut().zip(self.period) {
            if let Some(n) = period {
                *x = x.rem_euclid(n);
                // A tiny negative place wraps to the end itself.
                if *x >= n {
                    *x = 0.0;
                }
            }
        }
        x
    }
}
