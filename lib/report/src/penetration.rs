//! Penetration of a run with its error, as `wp-metrics` and the run itself have it.

use std::path::Path;

use serde_json::Value;

use crate::{Error, Labelled, Table};

const SIDES: [&str; 3] = ["bottom", "top", "total"];
/// How far the table beside a run may be from what the run says of itself: else it is another state's.
const SAME: f64 = 1e-3;

/// A number with its error, NaN where none is known.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Known {
    pub(crate) value: f64,
    pub(crate) error: f64,
}

impl Known {
    const NOTHING: Self = Self {
        value: f64::NAN,
        error: f64::NAN,
    };

    pub(crate) fn told(self, decimals: usize) -> String {
        let Self { value, error } = self;
        match (value.is_finite(), error.is_finite()) {
            (true, true) => format!("{value:.decimals$} \u{b1} {error:.decimals$}"),
            (true, false) => format!("{value:.decimals$}"),
            _ => "-".into(),
        }
    }
}

/// What a run came to.
#[derive(Clone, Debug)]
pub(crate) struct Penetration {
    /// Bottom, top, total; um.
    pub(crate) wp: [Known; 3],
    /// At the end, MPa.
    pub(crate) pressure: Known,
}

impl Penetration {
    /// Of the run in `folder` with this summary; errors are of the `wp.csv` that lies there.
    ///
    /// # Errors
    /// A table there that cannot be read.
    pub(crate) fn read(folder: &Path, summary: &Value) -> Result<Self, Error> {
        let number = |pointer: &str| {
            let found = summary.pointer(pointer).and_then(Value::as_f64);
            found.unwrap_or(f64::NAN)
        };
        let plain = |value| Known {
            value,
            ..Known::NOTHING
        };
        let wp = SIDES.map(|side| plain(1e6 * number(&format!("/penetration/wp_m/{side}"))));
        let own = Self {
            wp,
            pressure: plain(1e-6 * number("/final_pressure_pa")),
        };
        let path = folder.join("wp.csv");
        if !path.is_file() {
            return Ok(own);
        }
        let label = String::new();
        let table = Table::read(&Labelled { label, path })?;
        let at = |side: &str, column: &str| table.number(("side", side), column);
        let differs = |k: usize| {
            let found = at(SIDES[k], "wp_um");
            (found - own.wp[k].value).abs() > SAME * found
        };
        if (0..3).any(differs) {
            return Ok(own);
        }
        let known = |side: &str, columns: [&str; 3], unit: f64| {
            let [value, best, error] = columns.map(|column| at(side, column) * unit);
            match best.is_finite() && error.is_finite() {
                true => Known { value: best, error },
                false => plain(value),
            }
        };
        let wp = ["wp_um", "wp_extrapolated_um", "wp_error_um"];
        let pressure = [
            "pressure_pa",
            "pressure_extrapolated_pa",
            "pressure_error_pa",
        ];
        let pressure = known("total", pressure, 1e-6);
        Ok(Self {
            wp: SIDES.map(|side| known(side, wp, 1.0)),
            pressure: if pressure.value.is_finite() {
                pressure
            } else {
                own.pressure
            },
        })
    }
}
