//! What a longer press would change, where the bond did not close.

use bondline::Room;
use serde::Serialize;

use crate::end_conditions::End;
use crate::summary::time;

/// Share of the way below which a bond is closed, and below which the lumens are full.
const CLOSED: f64 = 1e-3;
const FULL: f64 = 1e-2;
/// Speed over the mean speed of the press below which it creeps, as a film does, and stands still.
const CREEPS: f64 = 0.25;
const STANDS: f64 = 1e-6;
/// How many times as long the rest of the way takes as at the present speed: up to 3.7 times where lumens fill at the pressure
/// limit (quick specimens of poplar, 0.3 to 2.5 MPa).
const SLOWS: f64 = 4.0;

/// What a longer press would change.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Outlook {
    /// A sentence without its full stop.
    pub said: String,
    /// A time limit that would do, s.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub time_limit_s: Option<f64>,
}

/// The outlook of a press that ended so; `gaps` are times (s) and gaps (m) from its start to its end. `None` for one that has
/// closed, or to which time is no limit.
pub(crate) fn outlook(end: End, gaps: &[[f64; 2]], room: Option<Room>) -> Option<Outlook> {
    let ([_, whole], [now, gap]) = (*gaps.first()?, *gaps.last()?);
    let least = room.map_or(0.0, |room| room.least_gap_m);
    let way = gap - least;
    let says = |said: String, time_limit_s| Some(Outlook { said, time_limit_s });
    if end == End::Interrupted || gap <= CLOSED * whole {
        return None;
    }
    if least > 0.0 && way <= FULL * whole {
        let said =
            "every lumen that the adhesive can reach is full: a longer press changes nothing";
        return says(said.into(), None);
    }
    if !matches!(end, End::Time | End::TimeLimit) {
        return None;
    }
    // Single steps of the explicit scheme tell little.
    let lately = 10.0 * (gap_at(gaps, 0.9 * now) - gap) / now;
    let mean = (whole - gap) / now;
    if lately <= STANDS * mean {
        return says(
            "the press stands still: a longer one changes nothing".into(),
            None,
        );
    }
    let (um, more) = (1e6 * way, way / lately);
    let takes = format!(
        "the last {um:.2} um take {} more at the present speed",
        time(more, 1)
    );
    match lately < CREEPS * mean {
        true => says(
            format!("a film creeps: {takes}, and longer as it slows"),
            None,
        ),
        false => says(takes, Some(now + SLOWS * more)),
    }
}

/// The gap (m) at a time (s), between those of `gaps`.
fn gap_at(gaps: &[[f64; 2]], time_s: f64) -> f64 {
    let after = gaps.partition_point(|[time, _]| *time < time_s).max(1);
    let [[t0, g0], [t1, g1]] = [after - 1, after].map(|at| gaps[at.min(gaps.len() - 1)]);
    match t1 > t0 {
        true => g0 + (g1 - g0) * (time_s - t0) / (t1 - t0),
        false => g0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A press of 10 um at 1 m/s, then at `speed` from 4 um down to `gap`.
    fn told(speed: f64, gap_um: f64, least_um: f64, end: End) -> Option<Outlook> {
        let least_gap_m = 1e-6 * least_um;
        let room = Room {
            share: 0.5,
            least_gap_m,
        };
        let gap_m = 1e-6 * gap_um;
        let slow_s = (4e-6 - gap_m) / speed;
        let gaps = [[0.0, 1e-5], [6e-6, 4e-6], [6e-6 + slow_s, gap_m]];
        outlook(end, &gaps, Some(room))
    }

    #[test]
    fn what_a_longer_press_changes_follows_from_its_speed_at_the_end() {
        let end = End::TimeLimit;
        // 4 us of 10 at half the speed: the rest takes 4 us, four times that at most.
        let ahead = told(0.5, 2.0, 0.0, end).unwrap();
        assert_eq!(
            ahead.said,
            "the last 2.00 um take 4.0 us more at the present speed"
        );
        assert!((ahead.time_limit_s.unwrap() - 26e-6).abs() < 1e-12);
        let way = told(0.5, 2.0, 1.0, end).unwrap();
        assert!(
            way.said.starts_with("the last 1.00 um take 2.0 us"),
            "{}",
            way.said
        );
        let creeps = told(1e-3, 3.8, 0.0, end).unwrap();
        let said = "a film creeps: the last 3.80 um take 3.8 ms more at the present speed, and longer as it slows";
        assert_eq!((creeps.said.as_str(), creeps.time_limit_s), (said, None));
        let full =
            "every lumen that the adhesive can reach is full: a longer press changes nothing";
        for end in [end, End::Programme, End::Set] {
            assert_eq!(told(1e-3, 2.0, 1.95, end).unwrap().said, full);
        }
        assert_eq!(told(1e-3, 2.0, 0.0, End::Programme), None);
        assert_eq!(told(0.5, 0.0, 0.0, end), None);
        let still = outlook(end, &[[0.0, 1e-5], [6e-6, 4e-6], [1.0, 4e-6]], None).unwrap();
        assert!(still.said.contains("stands still"), "{}", still.said);
    }
}
