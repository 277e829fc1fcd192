//! Where the water is that the liquid does not hold.

use crate::geometry::DRIFT;

/// The account of the water, and what the next step goes by.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Account {
    /// Water in the liquid at the start, cells.
    pub(crate) start: f64,
    /// Water in the walls, cells.
    pub(crate) in_walls: f64,
    /// Water that left the domain with its liquid, cells.
    pub(crate) left: f64,
    /// Change of ln(viscosity) per time where the liquid dries, 1/s.
    pub(crate) pace: f64,
    /// Mean of 1/factor of the viscosity over the liquid.
    pub(crate) fluidity: f64,
}

impl Account {
    /// Water found nowhere, over that at the start, with so much in the liquid (cells).
    pub(crate) fn missing(&self, held: f64) -> f64 {
        (self.start - held - self.in_walls - self.left) / self.start
    }

    /// As an array of a checkpoint.
    pub(crate) fn save(&self) -> Vec<f64> {
        vec![
            self.start,
            self.in_walls,
            self.left,
            self.pace,
            self.fluidity,
        ]
    }

    /// From an array of a checkpoint whose liquid holds so much water (cells), of a run that began with as much as this one.
    ///
    /// # Errors
    /// Numbers that no run saves.
    pub(crate) fn restore(&self, saved: &[f64], held: f64) -> Result<Self, String> {
        let wrong = || format!("the checkpoint's account of water is none of this run: {saved:?}");
        let &[start, in_walls, left, pace, fluidity] = saved else {
            return Err(wrong());
        };
        let found = Self {
            start,
            in_walls,
            left,
            pace,
            fluidity,
        };
        let sound = start == self.start
            && [in_walls, left, pace]
                .iter()
                .all(|x| (0.0..=f64::MAX).contains(x))
            && fluidity > 0.0
            && fluidity <= 1.0
            && found.missing(held).abs() <= DRIFT;
        if sound { Ok(found) } else { Err(wrong()) }
    }
}
