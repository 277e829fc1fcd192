//! What changes from step to step.

use super::length::Trend;
use super::{Drive, LastFlow};
use crate::liquid::Particles;
use crate::system::air::Held;
use crate::transport::Flow;
use crate::water::Account;

/// What the next step goes on from.
pub(super) struct State {
    pub(super) particles: Particles,
    /// Displacement of each body, m.
    pub(super) displacement: Vec<[f64; 3]>,
    pub(super) drive: Drive,
    /// Speed that sets the time step, m/s.
    pub(super) pace: f64,
    pub(super) trend: Trend,
    /// Clamp travel, m.
    pub(super) travel: f64,
    pub(super) steps: u64,
    /// Time since the start, s.
    pub(super) time: f64,
    /// Power of viscosity and friction in the last step, W.
    pub(super) power: f64,
    pub(super) rates: Rates,
    /// Where the viscosity depends on the shear rate: what the next step takes rates from.
    pub(super) last: Option<LastFlow>,
    /// Air of the pockets, where they have pressures.
    pub(super) air: Held,
    pub(super) counts: Counts,
    /// Of a liquid that loses water.
    pub(super) water: Option<Account>,
    /// Where walls hold a part only: water in each piece of their surface, cells.
    pub(super) soaked: Vec<f32>,
}

/// What the shear rates of the particles follow from.
pub(super) enum Rates {
    /// Nothing has moved yet.
    Zero,
    /// Velocity in the last step.
    Of(Box<Flow>),
    /// Those of a restored state, 1/s.
    Restored(Vec<f32>),
}

/// How often so far: particles that ...
#[derive(Default)]
pub(super) struct Counts {
    /// ... left through open sides.
    pub(super) lost: u64,
    /// ... a wall turned back.
    pub(super) deflected: u64,
    /// ... found no free place nearby between closing walls.
    pub(super) pinched: u64,
    /// ...; steps whose viscosity did not become that of their flow.
    pub(super) unsettled: u64,
    /// ...; and steps in which it was not found which contact lines hold.
    pub(super) undecided: u64,
}

impl State {
    /// The state at the start, with the fastest motion known (m/s).
    pub(super) fn new(
        particles: Particles,
        drive: Drive,
        pace: f64,
        water: Option<Account>,
    ) -> Self {
        Self {
            particles,
            displacement: vec![[0.0; 3]; drive.motions().len()],
            drive,
            pace,
            trend: Trend::default(),
            travel: 0.0,
            steps: 0,
            time: 0.0,
            power: 0.0,
            rates: Rates::Zero,
            last: None,
            air: Held::default(),
            counts: Counts::default(),
            water,
            soaked: Vec::new(),
        }
    }
}
