//! The liquid's particles: markers of volume that carry velocity and volume change.

use rayon::prelude::*;

use crate::geometry::Window;

/// Particles in flat arrays of equal length, sorted by cell of the window ([`Particles::sort`]).
///
/// Positions are in cells from the domain's low corner and in double precision: a wall is
/// met to 1e-12 cells anywhere in the domain, and slow particles do not freeze on the last bit.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Particles {
    /// Positions, cells.
    pub(crate) position: Vec<[f64; 3]>,
    /// Velocities, m/s.
    pub(crate) velocity: Vec<[f32; 3]>,
    /// Volumes at J = 1, cells.
    pub(crate) volume: Vec<f32>,
    /// Relative volume change J - 1.
    pub(crate) j: Vec<f32>,
    /// Index of each particle in the scene.
    pub(crate) id: Vec<u32>,
    /// Volumes of solids and water at J = 1, cells; none where the liquid loses no water.
    pub(crate) parts: Vec<[f64; 2]>,
    /// Positions at the start of a step while `position` holds others; else empty.
    pub(crate) start: Vec<[f64; 3]>,
}

/// Where the particles of each cell of a window are: cell c holds `start[c]..start[c + 1]`.
#[derive(Clone, Debug, Default)]
pub(crate) struct Bins {
    /// Offsets, one more than cells.
    pub(crate) start: Vec<u32>,
}

impl Bins {
    /// The particles of a cell.
    #[inline]
    pub(crate) fn of(&self, cell: usize) -> std::ops::Range<usize> {
        self.start[cell] as usize..self.start[cell + 1] as usize
    }

    /// The particles of consecutive cells.
    #[inline]
    pub(crate) fn of_range(&self, cells: std::ops::Range<usize>) -> std::ops::Range<usize> {
        self.start[cells.start] as usize..self.start[cells.end] as usize
    }
}

impl Particles {
    /// Number of particles.
    pub(crate) fn len(&self) -> usize {
        self.position.len()
    }

    /// Whether there is none.
    pub(crate) fn is_empty(&self) -> bool {
        self.position.is_empty()
    }

    /// Current volume of all particles, cells.
    pub(crate) fn total_volume(&self) -> f64 {
        let sums: Vec<f64> = (self.volume.par_chunks(1 << 16))
            .zip(self.j.par_chunks(1 << 16))
            .map(|(volume, j)| {
                let now = |(&v, &j): (&f32, &f32)| f64::from(v) * (1.0 + f64::from(j));
                volume.iter().zip(j).map(now).sum()
            })
            .collect();
        sums.iter().sum()
    }

    /// Lowest cell and one past the highest cell (domain indices) that hold particles; an
    /// empty box at the origin when there are none.
    pub(crate) fn extent(&self) -> ([i64; 3], [i64; 3]) {
        let merge = |a: ([f64; 3], [f64; 3]), b: ([f64; 3], [f64; 3])| {
            (
                std::array::from_fn(|i| a.0[i].min(b.0[i])),
                std::array::from_fn(|i| a.1[i].max(b.1[i])),
            )
        };
        let none = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        let (low, high) = (self.position.par_iter())
            .map(|&x| (x, x))
            .reduce(|| none, merge);
        if self.is_empty() {
            return ([0; 3], [0; 3]);
        }
        (
            low.map(|x| x.floor() as i64),
            high.map(|x| x.floor() as i64 + 1),
        )
    }

    /// Sorts by cell of `window`, stable, and says where each cell's particles are.
    ///
    /// # Panics
    /// When a particle lies outside the window; [`Window::around`] the extent holds all.
    pub(crate) fn sort(&mut self, window: &Window, bins: &mut Bins) {
        let keys: Vec<u32> = (self.position.par_iter())
            .map(|&x| window.index(window.local(x).map(|s| s as usize)) as u32)
            .collect();
        // Counting and placing are sequential: 20 ns per particle, and the order is that of
        // the last step whatever the number of threads.
        let start = &mut bins.start;
        start.clear();
        start.resize(window.len() + 1, 0);
        for &key in &keys {
            start[key as usize + 1] += 1;
        }
        for cell in 0..window.len() {
            start[cell + 1] += start[cell];
        }
        if keys.is_sorted() {
            return;
        }
        let mut order = vec![0_u32; keys.len()];
        for (p, &key) in keys.iter().enumerate() {
            let place = &mut start[key as usize];
            order[*place as usize] = p as u32;
            *place += 1;
        }
        // Placing has moved each offset to the next cell's.
        start.rotate_right(1);
        start[0] = 0;
        self.take(&order);
    }

    /// Puts the particles elsewhere, until [`Particles::go_back`].
    pub(crate) fn visit(&mut self, elsewhere: Vec<[f64; 3]>) {
        self.start = std::mem::replace(&mut self.position, elsewhere);
    }

    /// Puts the particles where they were before [`Particles::visit`].
    pub(crate) fn go_back(&mut self) {
        self.position = std::mem::take(&mut self.start);
    }

    /// Removes the particles that `keep` refuses, and returns how many.
    pub(crate) fn retain(&mut self, keep: impl Fn([f64; 3]) -> bool + Sync) -> usize {
        let kept: Vec<u32> = (0..self.len() as u32)
            .into_par_iter()
            .filter(|&p| keep(self.position[p as usize]))
            .collect();
        let removed = self.len() - kept.len();
        if removed > 0 {
            self.take(&kept);
        }
        removed
    }

    /// Takes the particles of these places, in this order.
    fn take(&mut self, places: &[u32]) {
        permute(&mut self.position, places);
        permute(&mut self.velocity, places);
        permute(&mut self.volume, places);
        permute(&mut self.j, places);
        permute(&mut self.id, places);
        if !self.parts.is_empty() {
            permute(&mut self.parts, places);
        }
        if !self.start.is_empty() {
            permute(&mut self.start, places);
        }
    }
}

fn permute<T: Copy + Send + Sync>(values: &mut Vec<T>, order: &[u32]) {
    *values = order.par_iter().map(|&p| values[p as usize]).collect();
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::geometry::Domain;
    use physics::Boundary;

    /// A reproducible sequence in [0, 1).
    pub(crate) fn sequence(seed: u64) -> impl FnMut() -> f64 {
        let mut state = seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1;
        move || {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            (state >> 11) as f64 / (1_u64 << 53) as f64
        }
    }

    /// Particles at given positions with equal volumes.
    pub(crate) fn at(position: Vec<[f64; 3]>, volume: f32) -> Particles {
        let n = position.len();
        Particles {
            position,
            velocity: vec![[0.0; 3]; n],
            volume: vec![volume; n],
            j: vec![0.0; n],
            id: (0..n as u32).collect(),
            parts: Vec::new(),
            start: Vec::new(),
        }
    }

    #[test]
    fn sorting_is_stable_and_bins_hold_their_cells() {
        let domain = Domain {
            cells: [7, 5, 4],
            boundary: [Boundary::Symmetry; 3],
            axes: 3,
        };
        let mut random = sequence(3);
        let points = (0..5000)
            .map(|_| [7.0 * random(), 5.0 * random(), 4.0 * random()])
            .collect();
        let mut particles = at(points, 0.125);
        let (low, high) = particles.extent();
        let window = Window::around(domain, low, high);
        let mut bins = Bins::default();
        particles.sort(&window, &mut bins);
        let mut seen = 0;
        for cell in 0..window.len() {
            let range = bins.of(cell);
            for p in range.clone() {
                let at = window.local(particles.position[p]).map(|x| x as usize);
                assert_eq!(window.index(at), cell);
            }
            assert!(particles.id[range.clone()].is_sorted(), "not stable");
            seen += range.len();
        }
        assert_eq!(seen, 5000);
        let once = particles.clone();
        particles.sort(&window, &mut bins);
        assert!(once == particles);
        let shifted = once.position.iter().map(|x| x.map(|x| 3.0 - 0.4 * x));
        particles.visit(shifted.collect());
        particles.sort(&window, &mut bins);
        particles.go_back();
        let mut back = particles.clone();
        back.sort(&window, &mut bins);
        let by_id = |particles: &Particles| {
            let mut list: Vec<_> = particles.id.iter().zip(&particles.position).collect();
            list.sort_by_key(|(id, _)| **id);
            list.into_iter().map(|(_, &x)| x).collect::<Vec<_>>()
        };
        assert!(by_id(&back) == by_id(&once), "not where they were");
        let removed = particles.retain(|x| x[0] < 3.5);
        assert_eq!(removed + particles.len(), 5000);
        assert!(particles.position.iter().all(|x| x[0] < 3.5));
    }
}
