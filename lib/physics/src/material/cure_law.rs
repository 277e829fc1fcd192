//! The law of cure in a case: the viscosity over that at the start, against time and temperature.

use super::neighbours;

/// Gas constant, J/(mol K) (CODATA 2018).
pub(super) const GAS: f64 = 8.314_462_618;
/// A liquid counts as gelled this fraction of the gel time before it.
const GELLED: f64 = 1e-6;
/// Accepted temperatures of a press, K; others are mistakes.
const TEMPERATURES: [f64; 2] = [200.0, 700.0];

/// The law of cure in a case.
#[derive(Clone, Debug, PartialEq)]
pub struct CureLaw {
    /// The factor over time at the reference temperature; `None`: no cure, only temperature.
    pub course: Option<Course>,
    /// Temperature (K) against time (s), linear between points and constant outside; empty: always the reference temperature.
    pub temperature: Vec<(f64, f64)>,
    /// Temperature for which `course` and the viscosity law hold, K.
    pub reference: f64,
    /// Activation energy of cure E, J/mol: cure is exp(-E/R (1/T - 1/T_ref)) times as fast.
    pub cure_energy: f64,
    /// Activation energy of flow E, J/mol: the viscosity is exp(E/R (1/T - 1/T_ref)) times as large.
    pub flow_energy: f64,
}

/// A factor against time at one temperature.
#[derive(Clone, Debug, PartialEq)]
pub enum Course {
    /// Points (s, factor), ln(factor) linear between them and constant outside.
    Table(Vec<(f64, f64)>),
    /// (1 - t/t_gel)^-n.
    Gel {
        /// t_gel, s.
        time: f64,
        /// n.
        exponent: f64,
    },
}

impl CureLaw {
    /// ln(factor) of the course at `age`, the equivalent time (s) at the reference temperature.
    fn ln_cured(&self, age: f64) -> f64 {
        match &self.course {
            None => 0.0,
            Some(Course::Table(points)) => interpolated(points, age, f64::ln),
            Some(Course::Gel { time, exponent }) => -exponent * (1.0 - age / time).max(0.0).ln(),
        }
    }

    /// 1/(R T) - 1/(R T_ref) at a time (s), mol/J.
    fn inverse_difference(&self, time: f64) -> f64 {
        if self.temperature.is_empty() {
            return 0.0;
        }
        (1.0 / interpolated(&self.temperature, time, |t| t) - 1.0 / self.reference) / GAS
    }

    /// ln of the speed of cure over that at the reference temperature.
    pub(super) fn ln_speed(&self, time: f64) -> f64 {
        -self.cure_energy * self.inverse_difference(time)
    }

    pub(super) fn ln_factor(&self, time: f64, age: f64) -> f64 {
        self.ln_cured(age) + self.flow_energy * self.inverse_difference(time)
    }

    /// Whether the law has reached its gel time, where the factor is infinite for any exponent.
    pub(super) fn has_gelled(&self, age: f64) -> bool {
        matches!(self.course, Some(Course::Gel { time, .. }) if age >= time * (1.0 - GELLED))
    }

    pub(super) fn check(&self) -> Result<(), String> {
        let rises = |what: &str, points: &[(f64, f64)]| {
            let sound = points.first().is_none_or(|p| p.0 >= 0.0)
                && points.windows(2).all(|pair| pair[0].0 < pair[1].0);
            let message = || format!("the times of {what} must increase, from 0 or later on");
            if sound { Ok(()) } else { Err(message()) }
        };
        rises("temperature", &self.temperature)?;
        let kelvins = self.temperature.iter().map(|p| p.1).chain([self.reference]);
        let [low, high] = TEMPERATURES;
        if let Some(odd) = kelvins.into_iter().find(|t| !(low..=high).contains(t)) {
            return Err(format!(
                "{odd} K is not accepted: {low} to {high} K is needed"
            ));
        }
        match &self.course {
            Some(Course::Table(points))
                if points.len() < 2 || points.iter().any(|p| p.1 <= 0.0) =>
            {
                Err("factor needs two points or more, and factors above zero".into())
            }
            Some(Course::Table(points)) => rises("factor", points),
            Some(Course::Gel { exponent, .. }) if !(*exponent > 0.0 && *exponent <= 10.0) => {
                Err(format!(
                    "exponent = {exponent} is not accepted: a number above 0 and at most 10 is needed"
                ))
            }
            Some(Course::Gel { .. }) => Ok(()),
            None if self.temperature.is_empty() => {
                Err("gel_time, factor or temperature is needed".into())
            }
            None => Ok(()),
        }
    }
}

/// Interpolates `of` the values linearly between points (argument, value); constant outside.
pub(super) fn interpolated(points: &[(f64, f64)], x: f64, of: impl Fn(f64) -> f64) -> f64 {
    match neighbours(points, x) {
        [Some((a, fa)), Some((b, fb))] => of(fa) + (x - a) / (b - a) * (of(fb) - of(fa)),
        [one, other] => one.or(other).map_or(0.0, |point| of(point.1)),
    }
}
