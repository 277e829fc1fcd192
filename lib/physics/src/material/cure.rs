//! Cure: a factor on the viscosity that depends on time and temperature, not on the shear rate.

use super::cure_law::{Course, CureLaw, interpolated};

/// Growth of the viscosity since the start at which the liquid counts as set.
pub const SET: f64 = 1e6;
/// Largest change of ln(factor), and of ln(speed of cure), between knots.
const MOST_CHANGE: f64 = 0.02;

/// The factor on the viscosity against time, resolved from a [`CureLaw`] to knots. Its logarithm is linear between knots and
/// constant after the last one.
#[derive(Clone, Debug, PartialEq)]
pub struct Cure {
    /// Times from 0 on (s), and ln(factor).
    knots: Vec<(f64, f64)>,
    set: bool,
}

impl Cure {
    /// Resolves `law` by marching over time in small steps.
    ///
    /// # Errors
    /// One sentence on the value out of range.
    pub fn new(law: &CureLaw) -> Result<Self, String> {
        law.check()?;
        let temperature_times: Vec<f64> = law.temperature.iter().map(|p| p.0).collect();
        let ages: Vec<f64> = match &law.course {
            None => Vec::new(),
            Some(Course::Table(points)) => points.iter().map(|p| p.0).collect(),
            Some(Course::Gel { time, .. }) => vec![*time],
        };
        let begin = law.ln_factor(0.0, 0.0);
        let (mut time, mut age, mut step) = (0.0_f64, 0.0_f64, f64::INFINITY);
        let mut cure = Self {
            knots: vec![(0.0, begin)],
            set: false,
        };
        while let Some(left) = time_to_change(law, &temperature_times, &ages, time, age) {
            let (from, mut dt) = (law.ln_factor(time, age), left.min(step));
            let (older, to) = loop {
                // Simpson's rule for the age over the step.
                let ln_speeds = [0.0, 0.5, 1.0].map(|part| law.ln_speed(time + part * dt));
                let [a, b, c] = ln_speeds.map(f64::exp);
                let older = age + dt / 6.0 * (a + 4.0 * b + c);
                let to = law.ln_factor(time + dt, older);
                let change = (to - from).abs().max((ln_speeds[2] - ln_speeds[0]).abs());
                if change <= MOST_CHANGE {
                    break (older, to);
                }
                dt *= 0.5;
            };
            let end = begin + SET.ln();
            cure.set = to >= end || law.has_gelled(older);
            if to >= end {
                cure.knots
                    .push((time + (end - from) / (to - from) * dt, end));
                break;
            }
            (time, age, step) = (time + dt, older, 2.0 * dt);
            cure.knots.push((time, to));
            if cure.set {
                cure.knots.push((time, end));
                break;
            }
        }
        Ok(cure)
    }

    /// Factor on the viscosity at a time, s.
    pub fn factor(&self, time: f64) -> f64 {
        interpolated(&self.knots, time, |ln| ln).exp()
    }

    /// Time (s) at which the liquid has set, i.e. the viscosity is [`SET`] times that at the start; `None`: never.
    pub fn set_at(&self) -> Option<f64> {
        self.knots.last().filter(|_| self.set).map(|knot| knot.0)
    }

    /// Duration (s) from `time` (s) on in which ln(factor) changes by no more than `most`.
    pub fn steady(&self, time: f64, most: f64) -> f64 {
        let here = interpolated(&self.knots, time, |ln| ln);
        let first = self.knots.partition_point(|knot| knot.0 <= time);
        let (mut last, mut from) = (time, here);
        for &(then, to) in &self.knots[first..] {
            let off = (to - here).abs();
            if off > most {
                let bound = here + most * (to - here).signum();
                return last + (bound - from) / (to - from) * (then - last) - time;
            }
            (last, from) = (then, to);
        }
        f64::INFINITY
    }

    /// Total variation of ln(factor) at the knots up to `time`, s.
    pub fn change(&self, time: f64) -> f64 {
        let before = self.knots.windows(2).filter(|pair| pair[0].0 < time);
        before.map(|pair| (pair[1].1 - pair[0].1).abs()).sum()
    }
}

/// Time to the next point at which the formula of `law` changes, s; `None` after the last one.
fn time_to_change(
    law: &CureLaw,
    temperature_times: &[f64],
    ages: &[f64],
    time: f64,
    age: f64,
) -> Option<f64> {
    let heat = temperature_times.iter().find(|mark| **mark > time);
    let heat = heat.map(|mark| mark - time);
    // A tolerance for the rounding of a sum of many steps.
    let course = ages.iter().find(|mark| **mark > age * (1.0 + 1e-12));
    let course = course.map(|mark| (mark - age) / law.ln_speed(time).exp());
    match (heat, course) {
        (Some(heat), Some(course)) => Some(heat.min(course)),
        (heat, course) => heat.or(course),
    }
}

#[cfg(test)]
mod tests {
    use super::super::cure_law::GAS;
    use super::*;

    fn course(exponent: f64) -> Option<Course> {
        let time = 100.0;
        Some(Course::Gel { time, exponent })
    }

    fn gel(temperature: &[(f64, f64)]) -> CureLaw {
        CureLaw {
            course: course(2.0),
            temperature: temperature.to_vec(),
            reference: 400.0,
            cure_energy: 80e3,
            flow_energy: 0.0,
        }
    }

    /// (1 - t/t_gel)^-0.3 is 63 a millionth before the gel time, and infinite there.
    #[test]
    fn whatever_its_exponent_a_liquid_has_set_at_its_gel_time() {
        for exponent in [0.1, 0.3, 0.499, 0.501, 3.0] {
            let course = course(exponent);
            let cure = Cure::new(&CureLaw { course, ..gel(&[]) }).unwrap();
            let set = cure.set_at().expect("it sets");
            assert!((98.9..=100.0 + 1e-9).contains(&set), "{exponent}: {set}");
            assert!((cure.factor(set) / SET - 1.0).abs() < 1e-9, "{exponent}");
        }
    }

    #[test]
    fn the_gel_law_to_its_end() {
        let cure = Cure::new(&gel(&[])).unwrap();
        for time in [0.0, 10.0, 50.0, 90.0, 99.0, 99.89] {
            let exact = (1.0_f64 - time / 100.0).powi(-2);
            assert!((cure.factor(time) / exact - 1.0).abs() < 1e-3, "{time}");
        }
        // 1e6-fold at (1 - t)^2 = 1e-6.
        let set = cure.set_at().unwrap();
        assert!((set - 99.9).abs() < 1e-3, "{set}");
        assert!((cure.factor(set) / SET - 1.0).abs() < 1e-9);
    }

    /// At 20 K below the reference the cure takes exp(E/R (1/380 - 1/400)) = 3.55 times as long; while it heats up, the time
    /// follows from the integral of the rates.
    #[test]
    fn the_cure_is_slower_in_the_cold() {
        let slower = (80e3 / GAS * (1.0 / 380.0 - 1.0 / 400.0)).exp();
        let cold = Cure::new(&gel(&[(0.0, 380.0)])).unwrap();
        let set = cold.set_at().unwrap();
        assert!((set / (99.9 * slower) - 1.0).abs() < 1e-5, "{set}");
        let heated = Cure::new(&gel(&[(0.0, 300.0), (60.0, 420.0)])).unwrap();
        let rate = |t: f64| (-80e3 / GAS * (1.0 / t - 1.0 / 400.0)).exp();
        let age: f64 = (0..60_000)
            .map(|i| 1e-3 * rate(300.0 + 2.0 * (f64::from(i) + 0.5) * 1e-3))
            .sum();
        let exact = 60.0 + (99.9 - age) / rate(420.0);
        let set = heated.set_at().unwrap();
        assert!((set / exact - 1.0).abs() < 1e-4, "{set} {exact}");
    }

    #[test]
    fn a_table_and_a_flow_that_thins_as_it_heats() {
        let mut law = gel(&[(10.0, 300.0), (20.0, 400.0)]);
        law.course = table(&[(5.0, 2.0), (15.0, 200.0)]);
        (law.cure_energy, law.flow_energy) = (0.0, 30e3);
        let cure = Cure::new(&law).unwrap();
        let thick = |t: f64| (30e3 / GAS * (1.0 / t - 1.0 / 400.0)).exp();
        for (time, exact) in [
            (0.0, 2.0 * thick(300.0)),
            (10.0, 20.0 * thick(300.0)),
            (15.0, 200.0 * thick(350.0)),
            (20.0, 200.0),
            (1e9, 200.0),
        ] {
            assert!((cure.factor(time) / exact - 1.0).abs() < 1e-3, "{time}");
        }
        assert_eq!(cure.set_at(), None);
    }

    #[test]
    fn a_step_can_be_bounded_by_the_change_in_it() {
        let cure = Cure::new(&gel(&[])).unwrap();
        for time in [0.0, 30.0, 99.0] {
            let dt = cure.steady(time, 0.2);
            let grown = (cure.factor(time + dt) / cure.factor(time)).ln();
            assert!((grown - 0.2).abs() < 1e-9, "{time}: {grown}");
        }
        let set = cure.set_at().unwrap();
        assert_eq!(cure.steady(set, 0.2), f64::INFINITY);
        assert!((cure.change(set) / SET.ln() - 1.0).abs() < 1e-9);
    }

    fn table(points: &[(f64, f64)]) -> Option<Course> {
        Some(Course::Table(points.to_vec()))
    }

    #[test]
    fn what_is_no_cure_is_refused_in_a_sentence() {
        type Change = fn(&mut CureLaw);
        let cases: [(Change, &str); 6] = [
            (|law| law.temperature.reverse(), "must increase"),
            (|law| law.reference = 20.0, "20 K is not accepted"),
            (|law| law.course = table(&[(0.0, 1.0)]), "two points"),
            (
                |law| law.course = table(&[(0.0, 1.0), (1.0, 0.0)]),
                "above zero",
            ),
            (|law| law.course = course(0.0), "exponent"),
            (
                |law| (law.course, law.temperature) = (None, Vec::new()),
                "is needed",
            ),
        ];
        for (change, sentence) in cases {
            let mut law = gel(&[(0.0, 300.0), (1.0, 400.0)]);
            change(&mut law);
            let said = Cure::new(&law).unwrap_err();
            assert!(said.contains(sentence), "{said}");
        }
    }
}
