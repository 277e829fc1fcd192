//! The blocks of voxels of a scene, and their images beyond periodic sides.

use std::sync::Arc;

use super::placed::{Placed, TOUCH, floor};
use super::rows::Rows;

/// A block of voxels.
pub(super) type Block = Placed<Arc<Rows>>;

impl Block {
    /// Cuts a block of one voxel along `axis` to `0..period`, where its images must not
    /// overlap it.
    pub(super) fn clip(&mut self, axis: usize, period: f64) {
        if self.rows.block.dims()[axis] == 1 {
            let low = self.rest[axis].clamp(0.0, period);
            let high = (self.rest[axis] + self.edge[axis]).clamp(0.0, period);
            self.rest[axis] = low;
            self.edge[axis] = (high - low).max(TOUCH);
            self.origin = self.rest;
        }
    }

    /// Its image that lies off it by `shift`.
    fn shifted(&self, shift: [f64; 3]) -> Placed<&Rows> {
        let off = |place: [f64; 3]| std::array::from_fn(|a| place[a] + shift[a]);
        Placed {
            body: self.body,
            rows: &self.rows,
            rest: off(self.rest),
            origin: off(self.origin),
            edge: self.edge,
        }
    }
}

/// How far apart the images of a scene's blocks are along each axis, cells; 0 where nothing repeats.
#[derive(Clone, Copy, Debug)]
pub(super) struct Periods([f64; 3]);

impl Periods {
    /// None where nothing repeats.
    pub(super) fn new(lengths: [f64; 3]) -> Option<Self> {
        lengths.iter().any(|&l| l > 0.0).then_some(Self(lengths))
    }

    /// The images of `blocks`, themselves among them, that reach the box with opposite corners `from` and `to`.
    #[inline]
    pub(super) fn images<'a>(
        &'a self,
        blocks: &'a [Block],
        from: [f64; 3],
        to: [f64; 3],
    ) -> impl Iterator<Item = Placed<&'a Rows>> {
        let mut blocks = blocks.iter();
        let mut images: Option<Images> = None;
        std::iter::from_fn(move || {
            loop {
                if let Some(image) = images.as_mut().and_then(|images| images.next(self)) {
                    return Some(image);
                }
                images = Some(Images::new(blocks.next()?, self, from, to));
            }
        })
    }

    /// How many periods along an axis the images of a block lie off it that reach an interval: the least and the most.
    #[inline]
    fn shifts(&self, block: &Block, axis: usize, from: f64, to: f64) -> [i64; 2] {
        let period = self.0[axis];
        if period == 0.0 {
            return [0; 2];
        }
        let length = block.rows.block.dims()[axis] as f64 * block.edge[axis];
        let beyond = (from.min(to) - TOUCH - length - block.origin[axis]) / period;
        let last = (from.max(to) + TOUCH - block.origin[axis]) / period;
        [floor(beyond) + 1, floor(last)]
    }
}

/// Images of one block.
struct Images<'a> {
    block: &'a Block,
    /// Periods along each axis that the first, the last and the next one lie off it.
    first: [i64; 3],
    last: [i64; 3],
    next: [i64; 3],
}

impl<'a> Images<'a> {
    #[inline]
    fn new(block: &'a Block, periods: &Periods, from: [f64; 3], to: [f64; 3]) -> Self {
        let shifts = [0, 1, 2].map(|a| periods.shifts(block, a, from[a], to[a]));
        let [first, last] = [0, 1].map(|end| shifts.map(|ends| ends[end]));
        Self {
            block,
            first,
            last,
            next: first,
        }
    }

    #[inline]
    fn next(&mut self, periods: &Periods) -> Option<Placed<&'a Rows>> {
        if (0..3).any(|a| self.next[a] > self.last[a]) {
            return None;
        }
        let shift = std::array::from_fn(|a| self.next[a] as f64 * periods.0[a]);
        self.next[0] += 1;
        for a in 0..2 {
            if self.next[a] > self.last[a] {
                self.next[a] = self.first[a];
                self.next[a + 1] += 1;
            }
        }
        Some(self.block.shifted(shift))
    }
}

/// Runs `$body` for `$block`, one after the other the `$blocks` and their images that reach the box with opposite corners `$from`
/// and `$to`. The body is there twice, so that where nothing repeats it is that of a plain loop: points ask millions of times.
macro_rules! for_each {
    ($block:ident in $periods:expr, $blocks:expr, $from:expr, $to:expr => $body:block) => {
        match $periods {
            None => {
                for $block in $blocks $body
            }
            Some(periods) => {
                for image in periods.images($blocks, $from, $to) {
                    let $block = &image;
                    $body
                }
            }
        }
    };
}
pub(super) use for_each;

#[cfg(test)]
mod tests {
    use physics::{Boundary, VoxelBlock};

    use crate::geometry::solids::Hit;
    use crate::geometry::tests::{domain, solids};
    use crate::geometry::{Across, Domain, Solids};

    const CELLS: [usize; 3] = [9, 8, 7];

    /// A domain whose sides along `axes` are periodic.
    fn repeating(axes: &[usize]) -> Domain {
        let mut domain = domain(CELLS, 3);
        for a in 0..3 {
            domain.boundary[a] = match axes.contains(&a) {
                true => Boundary::Periodic,
                false => Boundary::Open,
            };
        }
        domain
    }

    /// Voxels of half a cell that fill the domain, hanging over its sides by a third.
    fn wood(low: [f64; 3]) -> VoxelBlock {
        let solid = |i, j, k| (i * i + 3 * j * k + j + 5 * k) % 7 < 3;
        VoxelBlock::from_fn(low, [0.5; 3], CELLS.map(|n| 2 * n), solid)
    }

    /// What is asked of solids around a place.
    fn asked(solids: &Solids, after: &Solids, x: [f64; 3], reach: f64) -> String {
        let high = std::array::from_fn(|a| x[a] + [0.7, 1.3, 0.0][a]);
        let (mut volume, mut edges) = (0.0, Vec::new());
        solids.overlaps(x, high, |_, v| volume += v);
        let [low, high] = [[x[1] - 1.5, x[2] - 1.5], [x[1] + 1.5, x[2] + 1.5]];
        let (axis, along) = (0, x[0]);
        solids.reentrant(
            &Across {
                axis,
                along,
                low,
                high,
            },
            &mut edges,
        );
        edges.sort_by(|a, b| {
            a.at[0]
                .total_cmp(&b.at[0])
                .then(a.at[1].total_cmp(&b.at[1]))
        });
        let ray = [0, 1, 2].map(|axis| solids.ray(x, axis, true, reach));
        let near = |hit: Option<Hit>| hit.map(|hit| (hit.near, hit.body));
        let rays = [0, 1, 2].map(|axis| solids.rays(x, axis, reach).map(near));
        let to = [x[0] + 0.9, x[1] - 0.6, x[2] + 0.4];
        // Where points that walls have pinched are put depends on the sides of the domain.
        let inside = (0..3).all(|a| 2.5 < x[a] && x[a] < CELLS[a] as f64 - 2.5);
        let end = inside.then(|| solids.deflect(after, x, to));
        let mut row = [1.0; 9];
        solids.carve_row([x[1], x[1] + 0.5], [x[2], x[2] + 0.5], x[0], 0.5, &mut row);
        format!(
            "{:?} {ray:.6?} {rays:.6?} {volume:.6} {edges:.6?} {end:.6?} {row:.4?}",
            solids.at(x)
        )
    }

    /// Blocks that repeat are what the same blocks laid side by side are.
    #[test]
    fn images_are_the_blocks_again() {
        let low = [-0.31, 0.17, 0.23];
        for axes in [&[0][..], &[1, 2], &[0, 1, 2]] {
            let count = |a: usize| if axes.contains(&a) { -3..4 } else { 0..1 };
            let mut copies = Vec::new();
            for (x, y, z) in
                count(0).flat_map(|x| count(1).flat_map(move |y| count(2).map(move |z| (x, y, z))))
            {
                let by = [x, y, z];
                copies.push(wood(std::array::from_fn(|a| {
                    low[a] + f64::from(by[a]) * CELLS[a] as f64
                })));
            }
            let images = solids(repeating(axes), vec![vec![wood(low)]]);
            let copies = solids(repeating(&[]), vec![copies]);
            let by = [[0.2, -0.15, 0.1]];
            let after = [images.displaced(&by), copies.displaced(&by)];
            for n in 0..400_u32 {
                let part = |of: f64| f64::from(n) * of % 1.0;
                let x = [part(0.317) * 9.0, part(0.731) * 8.0, part(0.093) * 7.0];
                let [found, wanted] =
                    [(&images, &after[0]), (&copies, &after[1])].map(|(s, a)| asked(s, a, x, 19.0));
                assert_eq!(found, wanted, "{axes:?} {x:?}");
            }
        }
    }

    /// However far a body has gone over periodic sides.
    #[test]
    fn a_body_that_went_many_periods_is_where_it_was() {
        let start = solids(repeating(&[0, 1, 2]), vec![vec![wood([0.125; 3])]]);
        let gone = start.displaced(&[[9000.0, -8000.0, 700.0]]);
        for n in 0..200_u32 {
            let part = |of: f64| f64::from(n) * of % 1.0;
            let x = [part(0.317) * 9.0, part(0.731) * 8.0, part(0.093) * 7.0];
            assert_eq!(
                asked(&gone, &gone, x, 64.0),
                asked(&start, &start, x, 64.0),
                "{x:?}"
            );
        }
    }
}
