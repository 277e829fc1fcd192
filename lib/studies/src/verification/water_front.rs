//! A column of liquid that a piston presses along a lumen whose walls take water beyond a mouth, along its axis:
//! Darcy's law with the viscosity of each slice, and the balance of solids and water of slices that move
//! with the solids.
//!
//! Lengths in widths of the lumen, times in that in which a front goes sqrt 2 of them from a reservoir without
//! resistance or loss of water: then sum eta u dx = 1, eta over that at the start, u the velocity in a slice.

use crate::numbers::largest;

/// Solids content and factor of the viscosity.
pub const TABLE: [(f64, f64); 2] = [(0.45, 1.0), (0.75, 1e3)];
/// Density of water, kg/m3.
const WATER: f64 = 1000.0;
/// Filled length of a slit, and how far the front's contact lines are behind it: the liquid rolls over them
/// (finite elements, lib/studies/reference/slit-filling.csv, `filled_H` less `contact_H`).
const BEHIND: [(f64, f64); 6] = [
    (0.0, 0.0),
    (0.325, 0.232),
    (0.625, 0.315),
    (1.225, 0.353),
    (2.125, 0.367),
    (4.325, 0.385),
];
/// Slices of a width.
const SLICES: f64 = 20.0;

/// What the course depends on.
#[derive(Clone, Copy, Debug)]
pub struct Front {
    /// Length of the column at the start, from its front at the mouth to the piston.
    pub column: f64,
    /// Volume that the wall takes over that of the lumen, in a unit of time.
    pub sink: f64,
    /// Diffusivity of water.
    pub diffusivity: f64,
    /// Taylor's dispersion along the lumen adds the part (u/D)^2/dispersion.
    pub dispersion: f64,
    /// How far contact lines are behind the filled length over that in a slit.
    pub meniscus: f64,
    /// Equivalent lengths of the flow at the piston, and at a front whose contact lines are as far behind as they get.
    pub ends: [f64; 2],
}

/// Length filled beyond the mouth over time.
pub struct Course(Vec<(f64, f64)>);

impl Course {
    /// The filled length at a time.
    pub fn at(&self, time: f64) -> f64 {
        between(&self.0, time)
    }

    /// The largest filled length.
    pub fn farthest(&self) -> f64 {
        largest(self.0.iter().map(|p| p.1))
    }
}

/// The value at `x` of points that it lies between, linear.
fn between(points: &[(f64, f64)], x: f64) -> f64 {
    let right = points.partition_point(|p| p.0 < x);
    let right = right.clamp(1, points.len() - 1);
    let ((a, fa), (b, fb)) = (points[right - 1], points[right]);
    fa + (x - a) / (b - a) * (fb - fa)
}

/// A slice of the lumen: volumes of solids and water over its section.
#[derive(Clone, Copy, Debug)]
struct Slice {
    solids: f64,
    water: f64,
}

impl Slice {
    fn length(self) -> f64 {
        self.solids + self.water
    }

    fn ratio(self) -> f64 {
        self.water / self.solids
    }

    /// Part of the solids in its volume.
    fn dry(self) -> f64 {
        self.solids / self.length()
    }
}

/// What water and solids of a liquid of a density are.
struct Mixture {
    /// Water over solids by volume at the start and at the end of the table.
    start: f64,
    least: f64,
    /// Density of the solids over that of water.
    solid: f64,
}

impl Mixture {
    fn new(density: f64) -> Self {
        let (solids, end) = (TABLE[0].0, TABLE[1].0);
        let water = (1.0 - solids) * density / WATER;
        let solid = solids * density / WATER / (1.0 - water);
        Self {
            start: water / (1.0 - water),
            least: (1.0 / end - 1.0) * solid,
            solid,
        }
    }

    fn factor(&self, slice: Slice) -> f64 {
        let solids = self.solid / (self.solid + slice.ratio());
        let [(from, one), (to, last)] = TABLE;
        let part = ((solids - from) / (to - from)).clamp(0.0, 1.0);
        one * (last / one).powf(part)
    }
}

impl Front {
    /// The course of liquid of `density` (kg/m3) up to `end`; slices and steps half as long change it by 0.2 %.
    pub fn course(&self, density: f64, end: f64) -> Course {
        let mixture = Mixture::new(density);
        let count = (self.column * SLICES).round();
        let solids = self.column / count / (1.0 + mixture.start);
        let slice = Slice {
            solids,
            water: solids * mixture.start,
        };
        // From the front to the piston.
        let mut slices = vec![slice; count as usize];
        let (mut time, mut speed, mut travel, mut course) = (0.0, 0.0, 0.0, vec![(0.0, 0.0)]);
        while time < end {
            let dt = (0.05 * (time + 1e-3) + 1e-4).min(0.02);
            let asked = self.asked(&slices, travel, &mixture, dt);
            let conductance = self.conductances(&slices, speed);
            let ends = [self.ends[0], self.ends[1] * self.curved(&slices, travel)];
            speed = speed_of(&slices, &mixture, &asked, &conductance, ends);
            for (slice, asked) in slices.iter_mut().zip(&asked) {
                slice.water -= asked * dt;
            }
            mix(&mut slices, &conductance, dt);
            travel += speed * dt;
            time += dt;
            course.push((time, self.filled(&slices, travel)));
        }
        Course(course)
    }

    fn filled(&self, slices: &[Slice], travel: f64) -> f64 {
        let length: f64 = slices.iter().map(|slice| slice.length()).sum();
        length - (self.column - travel)
    }

    /// Volume that the walls take of each slice in a unit of time.
    fn asked(&self, slices: &[Slice], travel: f64, mixture: &Mixture, dt: f64) -> Vec<f64> {
        let mut high = self.filled(slices, travel);
        let contact = high - self.meniscus * between(&BEHIND, high);
        let of_slice = |slice: &Slice| {
            let low = high - slice.length();
            let wetted = (high.min(contact) - low.max(0.0)).max(0.0);
            high = low;
            let left = (slice.water - mixture.least * slice.solids).max(0.0);
            (self.sink * wetted).min(left / dt)
        };
        slices.iter().map(of_slice).collect()
    }

    /// Conductances of water from each slice to the one nearer to the piston.
    fn conductances(&self, slices: &[Slice], speed: f64) -> Vec<f64> {
        let dispersed = (speed / self.diffusivity).powi(2) / self.dispersion;
        let each = slices.windows(2).map(|pair| {
            let between = pair[0].length() + pair[1].length();
            self.diffusivity * (1.0 + dispersed) * (pair[0].dry() + pair[1].dry()) / between
        });
        each.collect()
    }

    /// How far the front is curved: the distance of its contact lines over the largest.
    fn curved(&self, slices: &[Slice], travel: f64) -> f64 {
        between(&BEHIND, self.filled(slices, travel)) / BEHIND[BEHIND.len() - 1].1
    }
}

/// Speed of the piston by Darcy's law, where each slice loses what its walls take and gains what diffuses into it.
fn speed_of(
    slices: &[Slice],
    mixture: &Mixture,
    asked: &[f64],
    conductance: &[f64],
    ends: [f64; 2],
) -> f64 {
    let passed = |i: usize| conductance[i] * (slices[i + 1].ratio() - slices[i].ratio());
    let (mut lost, mut drop, mut resistance) = (0.0, 0.0, 0.0);
    let last = slices.len() - 1;
    for (i, slice) in slices.iter().enumerate().rev() {
        let from = if i < last { passed(i) } else { 0.0 };
        let on = if i > 0 { passed(i - 1) } else { 0.0 };
        let net = asked[i] - from + on;
        let end = [(last, ends[0]), (0, ends[1])];
        let more = end.iter().filter(|(at, _)| *at == i).map(|(_, e)| e);
        let length = slice.length() + more.sum::<f64>();
        let friction = mixture.factor(*slice) * length;
        drop += friction * (lost + 0.5 * net);
        resistance += friction;
        lost += net;
    }
    (1.0 + drop) / resistance
}

/// Diffusion along the lumen for `dt`, implicit: a tridiagonal system by Thomas' algorithm.
fn mix(slices: &mut [Slice], conductance: &[f64], dt: f64) {
    let k = |i: usize| conductance.get(i).map_or(0.0, |k| k * dt);
    let (mut above, mut right): (Vec<f64>, Vec<f64>) = (Vec::new(), Vec::new());
    for (i, slice) in slices.iter().enumerate() {
        let (below, a, r) = match i {
            0 => (0.0, 0.0, 0.0),
            _ => (k(i - 1), above[i - 1], right[i - 1]),
        };
        let pivot = slice.solids + below + k(i) - below * a;
        above.push(k(i) / pivot);
        right.push((slice.water + below * r) / pivot);
    }
    let mut ratio = 0.0;
    for i in (0..slices.len()).rev() {
        ratio = right[i] + above[i] * ratio;
        slices[i].water = ratio * slices[i].solids;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn front(sink: f64) -> Front {
        Front {
            column: 5.0,
            sink,
            diffusivity: 0.5,
            dispersion: 210.0,
            meniscus: 1.0,
            ends: [0.16, 0.0],
        }
    }

    #[test]
    fn without_loss_of_water_the_column_goes_on_at_one_speed() {
        let course = front(0.0).course(1200.0, 20.0);
        for time in [1.0, 5.0, 20.0] {
            let found = course.at(time) * 5.16 / time;
            assert!((found - 1.0).abs() < 1e-6, "{time}: {found}");
        }
    }

    /// Length and end as by another program of the same equations; where the column's ends resist does not matter.
    #[test]
    fn with_loss_of_water_the_front_stops() {
        let course = front(0.02).course(1200.0, 40.0);
        assert!(
            (course.farthest() / 3.04 - 1.0).abs() < 0.005,
            "{}",
            course.farthest()
        );
        assert!(course.at(40.0) < 1.01 * course.at(30.0), "it goes on");
        let other = Front {
            ends: [0.0, 0.16],
            ..front(0.02)
        };
        let other = other.course(1200.0, 30.0).farthest() / course.farthest();
        assert!((other - 1.0).abs() < 0.005, "{other}");
    }
}
