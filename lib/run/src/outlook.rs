//! Effect of a longer press, where the bond did not close.

use bondline::Room;
use serde::Serialize;

use crate::clock::Clock;
use crate::end_conditions::End;
use crate::summary::time;

/// Share of the way below which a bond is closed, and below which the lumens are full.
const CLOSED: f64 = 1e-3;
const FULL: f64 = 2e-2;
/// Speed over the mean speed of the press below which it creeps, as a film does, and stands still.
const CREEPS: f64 = 0.25;
const STANDS: f64 = 1e-6;
/// How many times as long the rest of the way takes as at the present speed: up to 3.7 times where lumens fill at the pressure
/// limit (quick specimens of poplar, 0.3 to 2.5 MPa). Their liquid goes as the square root of time: a margin over that.
const SLOWS: f64 = 4.0;
const MARGIN: f64 = 1.5;

/// Effect of a longer press.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Outlook {
    /// A sentence without its full stop.
    pub said: String,
    /// A time limit that would do, s.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub time_limit_s: Option<f64>,
}

/// The outlook of a press of this way (m) that ended so. `None` for one that has closed, or of which nothing is known.
pub(crate) fn outlook(
    end: End,
    clock: &Clock,
    whole: Option<f64>,
    room: Option<Room>,
) -> Option<Outlook> {
    let (whole, gap) = (whole?, whole? - clock.travel_m);
    if end == End::Interrupted || gap <= CLOSED * whole {
        return None;
    }
    let short = room.filter(|room| room.least_gap_m > 0.0);
    let way = gap - short.map_or(0.0, |room| room.least_gap_m);
    let mut said: Vec<String> = short.iter().map(Room::to_string).collect();
    let mut time_limit_s = None;
    if short.is_some() && way <= FULL * whole {
        let full =
            "every lumen that the adhesive can reach is full: a longer press changes nothing";
        said.push(full.into());
    } else if matches!(end, End::Time | End::TimeLimit) {
        let (speed, mean) = (clock.last_step.closing_speed, clock.travel_m / clock.time_s);
        let (um, more) = (1e6 * way, way / speed);
        let takes = format!(
            "{um:.2} um take {} more at the present speed",
            time(more, 1)
        );
        said.push(if speed <= STANDS * mean {
            "the press stands still: a longer one changes nothing".into()
        } else if speed < CREEPS * mean {
            format!("the press creeps: the last {takes}, and longer as it slows")
        } else {
            let root = MARGIN * clock.time_s * ((clock.travel_m + way) / clock.travel_m).powi(2);
            time_limit_s = Some(root.max(clock.time_s + SLOWS * more));
            format!("the last {takes}")
        });
    }
    let said = said.join("; ");
    (!said.is_empty()).then_some(Outlook { said, time_limit_s })
}
