//! A press programme: stages of speed and pressure that a clamp goes through.

mod run;

use crate::Choice;

pub use run::{CONTROLLED, PressRun, PressStep};

/// What a stage of a press programme does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Press {
    /// Closes at its speed.
    Approach,
    /// Changes the pressure evenly over its time.
    Ramp,
    /// Keeps a pressure.
    Hold,
    /// Presses no more: the clamp's body goes where the liquid pushes it.
    Release,
}

impl Choice for Press {
    const NAMED: &'static [(&'static str, Self)] = &[
        ("approach", Self::Approach),
        ("ramp", Self::Ramp),
        ("hold", Self::Hold),
        ("release", Self::Release),
    ];
}

/// One stage of a press programme, with all that may end it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PressStage {
    /// What it does.
    pub kind: Press,
    /// Largest speed of the clamp, closing or giving way, m/s.
    pub speed: f64,
    /// Pressure at its end, Pa, which an approach ends at; `None` where an approach has no limit.
    pub pressure: Option<f64>,
    /// Longest duration, s.
    pub time_s: f64,
    /// Travel of the clamp since the start of the run that ends it, m.
    pub travel_m: Option<f64>,
    /// Whether the first step in which liquid presses on the clamp's body ends it.
    pub contact: bool,
    /// Speed of the clamp, and so of what leaves the bond line per area, below which it ends, m/s.
    pub slower: Option<f64>,
}

/// What ended a stage.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reason {
    /// Its time was over.
    Time,
    /// Its pressure was reached.
    Pressure,
    /// Liquid pressed on the clamp's body.
    Contact,
    /// Its travel was reached.
    Travel,
    /// The clamp had become slower than asked for.
    Slower,
    /// The clamp had gone all its way: wood lies on wood.
    Closed,
}

impl Choice for Reason {
    const NAMED: &'static [(&'static str, Self)] = &[
        ("time", Self::Time),
        ("pressure", Self::Pressure),
        ("contact", Self::Contact),
        ("travel", Self::Travel),
        ("slower", Self::Slower),
        ("closed", Self::Closed),
    ];
}

/// How a stage ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StageEnd {
    /// Why.
    pub reason: Reason,
    /// When, s since the start of the run.
    pub time_s: f64,
    /// Travel of the clamp then, m.
    pub travel_m: f64,
    /// Pressure on its body then, Pa.
    pub pressure: f64,
}
