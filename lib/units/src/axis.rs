//! Coordinate axes by name.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

/// A coordinate axis. A stack is indexed (z = page, y = row, x = column).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Axis {
    /// Columns of a page.
    X,
    /// Rows of a page; the bond normal by default.
    Y,
    /// Pages.
    Z,
}

impl Axis {
    /// The three axes in the order of their index.
    pub const ALL: [Axis; 3] = [Axis::X, Axis::Y, Axis::Z];

    /// Position of this axis in a vector `[x, y, z]`.
    pub fn index(self) -> usize {
        self as usize
    }

    /// The axis with this position in `[x, y, z]`, if there is one.
    pub fn from_index(index: usize) -> Option<Axis> {
        Self::ALL.get(index).copied()
    }
}

impl fmt::Display for Axis {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(["x", "y", "z"][self.index()])
    }
}

impl FromStr for Axis {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "x" | "X" => Ok(Axis::X),
            "y" | "Y" => Ok(Axis::Y),
            "z" | "Z" => Ok(Axis::Z),
            _ => Err(format!("'{text}' is not an axis; accepted are x, y and z")),
        }
    }
}
