//! Forecast of a run's time and memory, and the bounds beyond which a run needs `--yes-really`.

use std::fmt::Display;

use physics::Stages;

/// A scheme's forecast of a run.
#[derive(Clone, Debug)]
pub(crate) struct Forecast {
    /// First time step, s.
    pub(crate) dt_s: f64,
    /// Name of the limit that sets the time step.
    pub(crate) limit: String,
    /// Steps to the nominal end, at the clamp's full speed.
    pub(crate) steps: f64,
    /// Steps to the latest end, if a pressure limit holds the clamp back.
    pub(crate) most_steps: f64,
    /// Largest resident memory, bytes.
    pub(crate) memory_bytes: f64,
    /// Wall time of a step on the available threads, s.
    pub(crate) step_s: f64,
    /// Further lines of the plan, such as unknowns and caps.
    pub(crate) notes: String,
    /// The stages of a step.
    pub(crate) stages: Stages,
}

/// Most steps of a run that starts unasked: at a millisecond each they take twelve days.
const MOST_STEPS: f64 = 1e9;
/// Longest wall time of a run that starts unasked, s: a week.
const MOST_WALL_S: f64 = 7.0 * 86_400.0;

impl Forecast {
    /// A sentence if the run exceeds the bounds of steps, wall time or memory.
    pub(crate) fn excess(&self) -> Option<String> {
        let seconds = self.most_steps * self.step_s;
        // NaN counts as excess.
        let fits = |value: f64, most: f64| value <= most;
        if !(fits(self.most_steps, MOST_STEPS) && fits(seconds, MOST_WALL_S)) {
            return Some(format!(
                "the run would take up to {:.1e} steps of {:.2e} s, {}, more than {MOST_STEPS:e} steps or a week; the binding limit is {}; an earlier end (stop, time_limit), a coarser cell or another scheme is needed",
                self.most_steps,
                self.dt_s,
                cli::duration(seconds),
                self.limit
            ));
        }
        let need = match self.memory_bytes.is_nan() {
            true => u64::MAX,
            false => self.memory_bytes as u64,
        };
        let short = machine::shortage(need)?;
        Some(format!(
            "the run would need {short}; a coarser cell, fewer points_per_direction or a smaller specimen is needed"
        ))
    }
}

/// A line of the plan.
pub(crate) fn line(name: &str, text: impl Display) -> String {
    format!("  {name:<18} {text}\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_run_that_will_not_end_or_fit_is_named_with_its_limit() {
        let forecast = |most_steps, memory_bytes| Forecast {
            dt_s: 6e-19,
            limit: "viscous".into(),
            steps: 1.0,
            most_steps,
            memory_bytes,
            step_s: 1e-6,
            notes: String::new(),
            stages: Stages::default(),
        };
        let said = forecast(6e13, 0.0).excess().expect("a refusal");
        assert!(
            said.contains("6.0e13 steps") && said.contains("viscous"),
            "{said}"
        );
        // The paper's own runs take some 50,000 steps, a full-size one some 1e5.
        assert_eq!(forecast(1e6, 1e6).excess(), None);
        assert!(forecast(f64::NAN, 0.0).excess().is_some());
        let slow = Forecast {
            step_s: 1.0,
            ..forecast(1e6, 0.0)
        };
        assert!(slow.excess().is_some_and(|said| said.contains("11.6 days")));
        if cfg!(target_os = "linux") {
            for bytes in [1e18, f64::NAN] {
                let said = forecast(1.0, bytes).excess().expect("a refusal");
                assert!(said.contains("GB of memory, but this process"), "{said}");
            }
        }
    }
}
