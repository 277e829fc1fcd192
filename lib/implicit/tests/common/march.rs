//! Runs to a time or a travel that is met exactly.

use implicit::Implicit;
use physics::{Scheme, StepLimit, StepReport};

/// Steps until `end` (s); `seen` gets each report and its time.
pub fn until(scheme: &mut Implicit, end: f64, mut seen: impl FnMut(&StepReport, f64)) {
    let mut time = 0.0;
    while time < end * (1.0 - 1e-9) {
        let limit = StepLimit {
            time_s: end - time,
            travel_m: f64::INFINITY,
        };
        let report = scheme.advance(limit).unwrap();
        time += report.dt_s;
        seen(&report, time);
    }
}
