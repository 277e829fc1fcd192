//! A press programme: stages of speed and pressure of a clamp.

mod run;

use crate::Choice;

pub use run::{CONTROLLED, PressRun, PressStep};

/// Kind of a stage of a press programme.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Press {
    /// Closes at its speed.
    Approach,
    /// Changes the pressure evenly over its time.
    Ramp,
    /// Keeps a pressure.
    Hold,
    /// Sets zero pressure: the liquid may push the clamp's body back.
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

/// A stage of a press programme, with all its end conditions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PressStage {
    /// Kind of the stage.
    pub kind: Press,
    /// Largest speed of the clamp, closing or giving way, m/s.
    pub speed: f64,
    /// Pressure at its end, Pa, which ends an approach; `None` for an approach without a limit.
    pub pressure: Option<f64>,
    /// Longest duration, s.
    pub time_s: f64,
    /// Travel of the clamp since the start of the run that ends it, m.
    pub travel_m: Option<f64>,
    /// Whether the first step in which liquid presses on the clamp's body ends it.
    pub contact: bool,
    /// Speed of the clamp, i.e. outflow per bond area, below which it ends, m/s.
    pub slower: Option<f64>,
}

/// Reason of the end of a stage.
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
    /// The clamp reached the end of its travel: wood lies on wood.
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

/// The end of a stage.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StageEnd {
    /// Reason.
    pub reason: Reason,
    /// Time since the start of the run, s.
    pub time_s: f64,
    /// Travel of the clamp at that time, m.
    pub travel_m: f64,
    /// Pressure on the clamp's body at that time, Pa.
    pub pressure: f64,
}
