//! Times at which two boxes in uniform motion overlap, also through periodic sides.

/// Times (s) at which two boxes overlap along one axis: from `begin` to `end`, and again after every `period`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct AxisOverlap {
    begin: f64,
    end: f64,
    /// Infinite without periodic sides or without motion along the axis.
    period: f64,
    /// Relative speed along the axis, m/s.
    speed: f64,
    /// Largest overlap, m.
    largest: f64,
}

/// An interval of time in which boxes overlap along all axes.
#[derive(Clone, Copy, Debug)]
pub(super) struct JointOverlap {
    /// Begin, s; negative if the boxes overlap from the start.
    pub(super) begin: f64,
    /// End, s.
    pub(super) end: f64,
    /// The intervals of overlap along each axis, s.
    along: [(f64, f64); 3],
}

impl AxisOverlap {
    /// The times at which `a` and `b`, from low to high side (m), overlap; `a` moves at `v` (m/s) relative to `b`. The domain
    /// repeats after `length` (m; infinite without periodic sides). Overlaps up to `slack` (m) do not count.
    pub(super) fn of(a: [f64; 2], b: [f64; 2], v: f64, length: f64, slack: f64) -> Option<Self> {
        let (below, above) = (b[0] + slack - a[1], b[1] - slack - a[0]);
        let largest = (a[1] - a[0]).min(b[1] - b[0]);
        let always = |largest| Self {
            begin: f64::NEG_INFINITY,
            end: f64::INFINITY,
            period: f64::INFINITY,
            speed: 0.0,
            largest,
        };
        if v == 0.0 {
            let shared = a[1].min(b[1]) - a[0].max(b[0]);
            return (below < 0.0 && above > 0.0).then(|| always(shared));
        }
        // Together they fill the period.
        if above - below >= length {
            return Some(always(largest));
        }
        (above > below).then(|| Self {
            begin: (below / v).min(above / v),
            end: (below / v).max(above / v),
            period: length / v.abs(),
            speed: v.abs(),
            largest,
        })
    }

    /// The first interval that ends after `time`, as begin and end.
    fn after(&self, time: f64) -> Option<(f64, f64)> {
        let shifted = |by: f64| (self.begin + by, self.end + by);
        if self.period.is_infinite() {
            return (self.end > time).then_some((self.begin, self.end));
        }
        let periods = ((time - self.end) / self.period).floor() + 1.0;
        // Rounding of the quotient may give the interval before, which has ended.
        let found = shifted(periods * self.period);
        Some(match found.1 > time {
            true => found,
            false => shifted((periods + 1.0) * self.period),
        })
    }

    /// AxisOverlap (m) at time 0, which lies in this interval of overlap.
    fn at_start(&self, (begin, end): (f64, f64)) -> f64 {
        match self.speed {
            0.0 => self.largest,
            speed => (-begin * speed).min(end * speed).min(self.largest),
        }
    }
}

/// The intervals until `until` (s) in which boxes overlap along all axes, in order.
pub(super) fn joint_overlaps(
    axes: [AxisOverlap; 3],
    until: f64,
) -> impl Iterator<Item = JointOverlap> {
    let mut time = 0.0;
    std::iter::from_fn(move || {
        while time < until {
            let mut along = [(0.0, 0.0); 3];
            for (interval, axis) in along.iter_mut().zip(&axes) {
                *interval = axis.after(time)?;
            }
            let begin = along.iter().map(|a| a.0).fold(f64::NEG_INFINITY, f64::max);
            let end = along.iter().map(|a| a.1).fold(f64::INFINITY, f64::min);
            // Until `begin` one axis separates the boxes; after `end` another does.
            time = if begin < end { end } else { begin };
            if begin < end && begin < until {
                return Some(JointOverlap { begin, end, along });
            }
        }
        None
    })
}

impl JointOverlap {
    /// Whether boxes that overlap from the start have only just begun to: along the axis on which they met last, they overlap
    /// less than along any other of the first `count` axes.
    pub(super) fn has_just_begun(&self, axes: &[AxisOverlap; 3], count: usize) -> bool {
        let came = (0..3).find(|&i| self.along[i].0 == self.begin);
        let Some(way) = came.filter(|_| self.begin.is_finite()) else {
            return false;
        };
        let depth = -self.begin * axes[way].speed;
        -self.begin <= self.end
            && (0..count).all(|i| i == way || depth <= axes[i].at_start(self.along[i]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SLACK: f64 = 1e-9;

    type Corners = ([f64; 3], [f64; 3]);

    fn axes(a: Corners, b: Corners, v: [f64; 3], lengths: [f64; 3]) -> Option<[AxisOverlap; 3]> {
        let along = |i: usize| {
            let [a, b] = [a, b].map(|(low, high)| [low[i], high[i]]);
            AxisOverlap::of(a, b, v[i], lengths[i], SLACK)
        };
        Some([along(0)?, along(1)?, along(2)?])
    }

    fn met(a: Corners, b: Corners, v: [f64; 3], lengths: [f64; 3]) -> Option<f64> {
        let axes = axes(a, b, v, lengths)?;
        joint_overlaps(axes, 1e3)
            .find(|found| found.begin >= 0.0 || found.has_just_begun(&axes, 2))
            .map(|found| found.begin)
    }

    #[test]
    fn boxes_meet_when_their_gap_is_used_up_and_not_when_they_pass() {
        let floor = ([0.0; 3], [4.0, 1.0, 1.0]);
        let plate = ([0.0, 3.0, 0.0], [4.0, 4.0, 1.0]);
        let far = ([-10.0, 3.0, 0.0], [-6.0, 4.0, 1.0]);
        let beside = ([4.0, 0.0, 0.0], [5.0, 4.0, 1.0]);
        let within = ([0.0; 3], [4.0, 3.1, 1.0]);
        for (a, b, v, when, why) in [
            (plate, floor, [0.0, -2.0, 0.0], Some(1.0), "it comes down"),
            (plate, floor, [0.0, 2.0, 0.0], None, "it moves away"),
            (plate, floor, [8.0, -2.0, 0.0], None, "it has passed"),
            (far, floor, [2.0, -2.0, 0.0], None, "it falls past it"),
            (plate, beside, [0.0, -2.0, 0.0], None, "it slides along"),
            (plate, within, [0.0, -2.0, 0.0], Some(-0.05), "begun"),
            (plate, within, [0.0, 2.0, 0.0], None, "it comes out"),
            (plate, within, [1.0, 0.0, 0.0], None, "a wall along it"),
        ] {
            let found = met(a, b, v, [f64::INFINITY; 3]);
            match (found, when) {
                (Some(found), Some(when)) => assert!((found - when).abs() < 1e-6, "{why}: {found}"),
                (found, when) => assert_eq!(found, when, "{why}"),
            }
        }
    }

    /// Checked against all images one by one: in 40 s a box moves by at largest twelve periods.
    #[test]
    fn boxes_meet_through_periodic_sides_when_one_of_all_images_does() {
        const UNTIL: f64 = 40.0;
        let mut place = 0.5_f64;
        let mut next = || {
            place = (place * 997.0 + 0.137) % 1.0;
            place
        };
        let mut found = 0;
        for case in 0..400 {
            let lengths = [8.0, 10.0, f64::INFINITY];
            let mut corners = || {
                let low = [5.0 * next(), 7.0 * next(), 0.0];
                (low, [low[0] + 3.0 * next(), low[1] + 3.0 * next(), 1.0])
            };
            let (a, b) = (corners(), corners());
            let mut v = [4.0 * next() - 2.0, 4.0 * next() - 2.0, 0.0];
            if case % 3 == 0 {
                v[case % 2] = 0.0;
            }
            let images =
                (-14..=14).flat_map(|i| (-14..=14).map(move |j| [f64::from(i), f64::from(j)]));
            let first = images
                .filter_map(|[i, j]| {
                    let by = [8.0 * i, 10.0 * j, 0.0];
                    let off = |x: [f64; 3]| std::array::from_fn(|a| x[a] + by[a]);
                    let image = (off(b.0), off(b.1));
                    let axes = axes(a, image, v, [f64::INFINITY; 3])?;
                    joint_overlaps(axes, UNTIL).next().map(|first| first.begin)
                })
                .filter(|&begin| begin < UNTIL)
                .reduce(f64::min);
            let here = axes(a, b, v, lengths).and_then(|axes| joint_overlaps(axes, UNTIL).next());
            match (first, here.map(|first| first.begin)) {
                (Some(first), Some(here)) => {
                    found += 1;
                    assert!((first - here).abs() < 1e-9, "{case}: {here} for {first}");
                }
                (first, here) => assert_eq!(first, here, "{case}"),
            }
        }
        assert!((200..400).contains(&found), "{found}");
    }

    /// A box as long as a period fills the axis. Boxes that overlap from the start may collide in a later period.
    #[test]
    fn boxes_meet_in_a_later_period() {
        let plate = ([0.0, 5.0, 0.0], [8.0, 6.0, 1.0]);
        let post = ([3.0, 0.0, 0.0], [4.0, 2.0, 1.0]);
        let block = ([3.6, 1.0, 0.0], [3.9, 3.0, 1.0]);
        let lengths = [8.0, f64::INFINITY, f64::INFINITY];
        assert_eq!(met(plate, post, [5.0, 0.0, 0.0], lengths), None);
        for (body, v, when) in [
            (plate, [5.0, -0.1, 0.0], 30.0),
            (block, [1.0, 0.0, 0.0], 7.1),
        ] {
            let time = met(body, post, v, lengths).unwrap();
            assert!((time - when).abs() < 1e-6, "{time}");
        }
    }
}
