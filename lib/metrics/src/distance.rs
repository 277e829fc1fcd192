//! Exact Euclidean distances between voxels, squared.

use rayon::prelude::*;

/// Squared distance if there is no target point.
pub(crate) const NO_TARGET: u32 = u32::MAX;

/// The centres of the voxels of a grid, or the corners between them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PointLattice {
    pub(crate) dims: [usize; 3],
    /// Offset of the first point from the first centre, half voxels.
    shift: [usize; 3],
}

impl PointLattice {
    pub(crate) fn centres(dims: [usize; 3]) -> Self {
        let shift = [0; 3];
        Self { dims, shift }
    }

    /// The corners inside the box; along an axis of one voxel, the centres.
    pub(crate) fn corners(dims: [usize; 3]) -> Self {
        let shift = dims.map(|n| usize::from(n > 1));
        let dims = std::array::from_fn(|i| dims[i] - shift[i]);
        Self { dims, shift }
    }
}

/// Squared distances (half voxels) from every point of the lattice `from`, x fastest, to the nearest point of the lattice
/// `to` for which `is_target` holds.
///
/// Axis by axis, by lower envelopes of parabolas (Felzenszwalb and Huttenlocher 2012, Theory of Computing 8, 415-428).
/// Squares that do not fit, in grids longer than 30 000 voxels, are capped.
pub(crate) fn squared_distances(
    to: PointLattice,
    is_target: impl Fn(usize) -> bool + Sync,
    from: PointLattice,
) -> Vec<u32> {
    let points = 0..to.dims.iter().product::<usize>();
    let of = |index| if is_target(index) { 0 } else { NO_TARGET };
    let mut squares: Vec<u32> = points.into_par_iter().map(of).collect();
    let mut dims = to.dims;
    // Each pass moves the last axis to the front, so three passes restore the order.
    for axis in [2, 1, 0] {
        let (first, places) = ([to.shift[axis], from.shift[axis]], from.dims[axis]);
        squares = pass_along_last_axis(&squares, dims, first, places);
        dims = [places, dims[0], dims[1]];
    }
    squares
}

/// One pass along the slowest axis, which becomes the fastest: from the feet of the parabolas to `places`. The first ones
/// are at `foot` and `place`, half voxels.
fn pass_along_last_axis(
    squares: &[u32],
    [nx, ny, nz]: [usize; 3],
    [foot, place]: [usize; 2],
    places: usize,
) -> Vec<u32> {
    let lines = nx * ny;
    let mut passed = vec![NO_TARGET; lines * places];
    let rows = passed.par_chunks_mut(places.max(1)).enumerate();
    rows.for_each_init(Envelope::default, |envelope, (line, out)| {
        envelope.clear();
        for z in 0..nz {
            envelope.add(2 * z + foot, squares[z * lines + line]);
        }
        envelope.read(place, out);
    });
    passed
}

/// The lower envelope of parabolas along a line.
#[derive(Default)]
struct Envelope {
    feet: Vec<(i64, i64)>,
    /// Place from which each parabola is the lowest.
    from: Vec<f64>,
}

impl Envelope {
    fn clear(&mut self) {
        self.feet.clear();
        self.from.clear();
    }

    fn add(&mut self, place: usize, height: u32) {
        if height == NO_TARGET {
            return;
        }
        let (place, height) = (place as i64, i64::from(height));
        let mut from = f64::NEG_INFINITY;
        while let (Some(&(p, h)), Some(&lowest)) = (self.feet.last(), self.from.last()) {
            let meet = (height + place * place - h - p * p) as f64 / (2 * (place - p)) as f64;
            if meet > lowest {
                from = meet;
                break;
            }
            self.feet.pop();
            self.from.pop();
        }
        self.feet.push((place, height));
        self.from.push(from);
    }

    /// Reads the envelope at every second place from `first` on.
    fn read(&self, first: usize, out: &mut [u32]) {
        let mut at = 0;
        for (i, square) in out.iter_mut().enumerate() {
            let place = (2 * i + first) as i64;
            while (self.from.get(at + 1)).is_some_and(|&from| from < place as f64) {
                at += 1;
            }
            let Some((foot, height)) = self.feet.get(at) else {
                return;
            };
            let found = (place - foot).pow(2) + height;
            *square = found.min(i64::from(NO_TARGET - 1)) as u32;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_are_those_to_the_nearest_of_all() {
        let [centres, corners] = [
            PointLattice::centres([7, 12, 9]),
            PointLattice::corners([7, 12, 9]),
        ];
        let place = |of: PointLattice, i: usize| {
            let [nx, ny, _] = of.dims;
            let index = [i % nx, i / nx % ny, i / (nx * ny)];
            [0, 1, 2].map(|a| 2 * index[a] + of.shift[a])
        };
        for (to, from) in [(centres, centres), (centres, corners), (corners, centres)] {
            // Scattered points, by a multiplicative hash.
            let points = 0..to.dims.iter().product::<usize>();
            let near: Vec<usize> = points.filter(|i| i * 2_654_435_761 % 97 < 3).collect();
            let found = squared_distances(to, |i| near.contains(&i), from);
            assert_eq!(found.len(), from.dims.iter().product::<usize>());
            for (i, square) in found.into_iter().enumerate() {
                let way = |&other: &usize| -> usize {
                    let pairs = place(from, i).into_iter().zip(place(to, other));
                    pairs.map(|(a, b)| a.abs_diff(b).pow(2)).sum()
                };
                assert_eq!(Some(square as usize), near.iter().map(way).min());
            }
            let none = squared_distances(to, |_| false, from);
            assert!(none.into_iter().all(|square| square == NO_TARGET));
        }
    }
}
