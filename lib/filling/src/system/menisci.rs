//! Which faces of the front are one meniscus, and the pressure that it has.

use super::capillarity::Patch;
use super::{NONE, Operator};
use crate::geometry::OPEN;

/// How many times narrower a passage may be than one whose meniscus is the same, where they meet through air only.
const ALIKE: f64 = 2.0;

impl Operator<'_> {
    /// Gives all parts of one meniscus their mean: it has one pressure, and differences between its parts would
    /// stir the liquid for ever; half of how far a part was off its mean holds it. Parts belong together that meet in a
    /// cell, and those in neighbouring cells of air whose passages are not [`ALIKE`] times as narrow as each other.
    pub(super) fn level(&self, patches: &mut [Patch]) {
        let window = &self.lattice.window;
        let home = |cell: usize| window.index(window.home(window.coordinates(cell))) as u32;
        let mut at: Vec<(u32, u32)> = (patches.iter().zip(0..))
            .flat_map(|(patch, number)| {
                let (axis, index) = self.dofs.faces[patch.face as usize];
                let index = index as usize;
                [index, index - window.stride(usize::from(axis))].map(|cell| (home(cell), number))
            })
            .collect();
        at.sort_unstable();
        let of = |cell: u32| {
            let from = at.partition_point(|entry| entry.0 < cell);
            at[from..].iter().take_while(move |entry| entry.0 == cell)
        };
        let mut parts = Parts((0..patches.len() as u32).collect());
        for &(cell, one) in &at {
            let index = cell as usize;
            let beside = (0..window.domain.axes).filter_map(|axis| {
                let next = index + window.stride(axis);
                let air = [index, next].iter().all(|&c| self.dofs.cell[c] == NONE);
                (air && self.lattice.face(axis, next) == OPEN).then(|| home(next))
            });
            for &(_, other) in of(cell) {
                parts.join(one, other);
            }
            for near in beside {
                for &(_, other) in of(near) {
                    let [a, b] = [one, other].map(|n| patches[n as usize].narrowness);
                    if a < ALIKE * b && b < ALIKE * a {
                        parts.join(one, other);
                    }
                }
            }
        }
        let mut sums = vec![[0.0; 2]; patches.len()];
        for (patch, number) in patches.iter().zip(0..) {
            let sum = &mut sums[parts.first(number) as usize];
            sum[0] += patch.front.abs();
            sum[1] += patch.front.abs() * patch.narrowness;
        }
        for (patch, number) in patches.iter_mut().zip(0..) {
            let [area, sum] = sums[parts.first(number) as usize];
            patch.uneven += 0.5 * (patch.narrowness - sum / area).abs();
            patch.narrowness = sum / area;
        }
    }
}

/// Which of several things belong together: each refers to one of lower number, or to itself.
struct Parts(Vec<u32>);

impl Parts {
    /// The lowest number of those that belong together with `one`.
    fn first(&mut self, mut one: u32) -> u32 {
        while self.0[one as usize] != one {
            let next = self.0[one as usize];
            self.0[one as usize] = self.0[next as usize];
            one = next;
        }
        one
    }

    fn join(&mut self, one: u32, other: u32) {
        let (a, b) = (self.first(one), self.first(other));
        self.0[a.max(b) as usize] = a.min(b);
    }
}

#[cfg(test)]
mod tests {
    use super::super::Scales;
    use super::*;
    use crate::geometry::tests::{domain, lattice};
    use crate::liquid::Volumes;

    /// Two faces, of one cell or of two cells of air side by side, have the mean of both by area; through air only if
    /// neither passage is twice as narrow. Half of what that takes from either holds it.
    #[test]
    fn parts_of_a_meniscus_have_one_pressure() {
        let lattice = lattice(domain([4, 4, 1], 2), vec![]);
        let window = &lattice.window;
        let [left, right, above] = [[1.5, 1.5, 0.5], [2.5, 1.5, 0.5], [2.5, 2.5, 0.5]]
            .map(|at| window.local(at).map(|x| x as usize));
        let mut phi = vec![1.0; window.sub_len()];
        for cell in [left, right] {
            let first = window.first_sub(cell);
            for sub in [0, 1, window.sub_stride(1), window.sub_stride(1) + 1] {
                phi[first + sub] = 0.0;
            }
        }
        let volumes = Volumes::new(&lattice, &phi);
        let operator = Operator::new(&lattice, &volumes, Scales::plain());
        let levelled = |faces: [(usize, [usize; 3]); 2], other: f64| {
            let mut narrowness = [1.0, other].into_iter().zip([3.0, -1.0]);
            let mut patches = faces.map(|(axis, cell)| {
                let (narrowness, front) = narrowness.next().unwrap();
                Patch {
                    face: operator.dofs.face[axis][window.index(cell)],
                    front,
                    narrowness,
                    uneven: 0.0,
                    walls: [(OPEN, 0.0); 6],
                }
            });
            assert!(patches.iter().all(|patch| patch.face != NONE));
            operator.level(&mut patches);
            patches.map(|patch| (patch.narrowness, patch.uneven))
        };
        let of_one_cell = [(0, left), (1, left)];
        assert_eq!(levelled(of_one_cell, 5.0), [(2.0, 0.5), (2.0, 1.5)]);
        let across = [(1, left), (1, right)];
        assert_eq!(levelled(across, 1.5), [(1.125, 0.0625), (1.125, 0.1875)]);
        assert_eq!(levelled(across, 2.04), [(1.0, 0.0), (2.04, 0.0)]);
        let apart = [(0, left), (0, above)];
        assert_eq!(levelled(apart, 2.04), [(1.0, 0.0), (2.04, 0.0)]);
    }
}
