//! Measures of a state by `wp-metrics`, with errors by the size of the cells.

use toml::Value;
use units::Pressure;

use crate::run_end::case_beside;
use crate::table::Table;
use crate::{Error, Labelled};

/// A number as it was run, and carried on to cells of no size with the error of that; NaN where it is
/// not known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Known {
    /// In the cells of the run.
    pub as_run: f64,
    /// In cells of no size, by first order; NaN where no finer run was given.
    pub extrapolated: f64,
    /// Of that.
    pub error: f64,
}

/// Relative error of a pressure below which it may be the one that the clamp holds, and how near that it is then.
pub(crate) const HELD: f64 = 2e-4;
pub(crate) const NEAR: f64 = 0.01;

/// A quantity and where a table has it.
pub(crate) struct Quantity {
    pub(crate) name: &'static str,
    pub(crate) side: &'static str,
    pub(crate) unit: &'static str,
    /// Its columns begin and end so.
    column: [&'static str; 2],
    /// Value in `unit` over that in the column.
    factor: f64,
    pub(crate) decimals: usize,
}

pub(crate) const SIDES: [&str; 3] = ["bottom", "top", "total"];

const fn depth(name: &'static str, side: usize, column: &'static str) -> Quantity {
    Quantity {
        name,
        side: SIDES[side],
        unit: "um",
        column: [column, "um"],
        factor: 1.0,
        decimals: 2,
    }
}

/// What is read of each run, in its order. The total EP is the volume of liquid, which no cell changes.
pub(crate) const QUANTITIES: [Quantity; 6] = [
    depth("WP", 0, "wp"),
    depth("WP", 1, "wp"),
    depth("WP", 2, "wp"),
    depth("EP", 0, "ep"),
    depth("EP", 1, "ep"),
    Quantity {
        name: "pressure",
        side: SIDES[2],
        unit: "MPa",
        column: ["pressure", "pa"],
        factor: 1e-6,
        decimals: 3,
    },
];

impl Known {
    /// A number without an error.
    pub fn plain(as_run: f64) -> Self {
        Self {
            as_run,
            extrapolated: f64::NAN,
            error: f64::NAN,
        }
    }

    /// WP of the bottom, the top and in total (um), EP of the bottom and the top (um) and the pressure (MPa) in
    /// the rows of a table of `wp-metrics`.
    ///
    /// # Errors
    /// [`Error::Data`] for a table without sides or a value that is not a number.
    pub fn read(table: &Table) -> Result<[Self; 6], Error> {
        let sides = table.texts("side")?;
        let mut read = [Self::plain(f64::NAN); 6];
        for (known, q) in read.iter_mut().zip(&QUANTITIES) {
            let row = sides.iter().position(|side| *side == q.side);
            let number = |what: &str| {
                let column = format!("{}{what}_{}", q.column[0], q.column[1]);
                match row.filter(|_| table.has(&column)) {
                    // A side without adhesive has no WP.
                    Some(row) => (table.numbers_but(&column, |_| true)).map(|n| q.factor * n[row]),
                    None => Ok(f64::NAN),
                }
            };
            known.as_run = number("")?;
            let [extrapolated, error] = [number("_extrapolated")?, number("_error")?];
            if extrapolated.is_finite() && error.is_finite() {
                (known.extrapolated, known.error) = (extrapolated, error);
            }
        }
        Ok(read)
    }

    /// Whether there is an error.
    pub fn has_error(self) -> bool {
        self.error.is_finite()
    }

    /// The best that is known of it.
    pub fn best(self) -> f64 {
        match self.has_error() {
            true => self.extrapolated,
            false => self.as_run,
        }
    }

    /// The best that is known of it and, where there is one, its error to one digit at least, as texts.
    pub fn told(self, decimals: usize) -> Vec<String> {
        let error = Some(self.error).filter(|error| self.has_error() && *error != 0.0);
        let error = error.map(|error| fine(error, decimals));
        match self.best() {
            best if best.is_finite() => [fixed(best, decimals)].into_iter().chain(error).collect(),
            _ => vec!["-".into()],
        }
    }

    /// The same of a pressure of a press with this limit, NaN where none is known; with `between` before its error.
    /// Two sizes of cells agree to [`HELD`] where the clamp holds it.
    pub fn told_pressure(self, decimals: usize, between: &str, limit: f64) -> String {
        let near = self.extrapolated > 0.0 && (self.extrapolated - limit).abs() <= NEAR * limit;
        match near && self.error <= HELD * self.extrapolated {
            true => format!("{:.decimals$} at the limit", self.extrapolated),
            false => self.told(decimals).join(between),
        }
    }
}

/// The largest pressure of the press of a `resolved.toml` of this text, MPa; NaN where it has none.
pub fn pressure_limit(resolved: &str) -> f64 {
    let mpa = |table: &Value, key: &str| {
        let pressure: units::Quantity<Pressure> = table.get(key)?.as_str()?.parse().ok()?;
        Some(1e-6 * pressure.si())
    };
    let clamp = clamp(resolved);
    let pressures = stages(&clamp).filter_map(|stage| mpa(stage, "pressure"));
    let limit = mpa(&clamp, "max_pressure");
    limit.into_iter().chain(pressures).fold(f64::NAN, f64::max)
}

/// The pressure limit of the cases of all runs, Pa; none where they differ or one is a programme.
pub(crate) fn limit_of(runs: &[Labelled]) -> Option<f64> {
    let cases = runs.iter().map(|run| case_beside(&run.path));
    let limits = cases.map(|case| match stage_kinds(&case).is_empty() {
        true => 1e6 * pressure_limit(&case),
        false => f64::NAN,
    });
    let limits: Vec<f64> = limits.collect();
    let first = *limits.first()?;
    limits.iter().all(|limit| *limit == first).then_some(first)
}

/// The kinds of the stages of its programme.
pub(crate) fn stage_kinds(resolved: &str) -> Vec<String> {
    let clamp = clamp(resolved);
    let kinds = stages(&clamp).filter_map(|stage| stage.get("kind")?.as_str());
    kinds.map(str::to_owned).collect()
}

/// Its press; nothing in it where it has none.
fn clamp(resolved: &str) -> Value {
    let mut case: toml::Table = resolved.parse().unwrap_or_default();
    case.remove("clamp").unwrap_or(toml::Table::new().into())
}

fn stages(clamp: &Value) -> impl Iterator<Item = &Value> {
    let stages = clamp.get("stage").and_then(Value::as_array);
    stages.into_iter().flatten()
}

/// A number with so many decimals, or as it takes for a digit that is not zero.
fn fine(number: f64, decimals: usize) -> String {
    let mut texts = [decimals, decimals + 1]
        .map(|n| format!("{number:.n$}"))
        .into_iter();
    let told = texts.find(|text| text.parse() != Ok(0.0));
    told.unwrap_or_else(|| format!("{number:.0e}"))
}

/// A number with so many decimals; 0 where they are all zero.
pub fn fixed(number: f64, decimals: usize) -> String {
    let text = format!("{number:.decimals$}");
    match text.parse() {
        Ok(0.0) => "0".into(),
        _ => text,
    }
}

/// The same with a sign where it is above zero.
pub fn signed(number: f64, decimals: usize) -> String {
    match fixed(number, decimals) {
        text if number > 0.0 && text != "0" => format!("+{text}"),
        text => text,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Neither pressures of nothing nor those of a press without a limit are "at the limit", however well two sizes of cells agree.
    #[test]
    fn a_pressure_is_at_the_limit_of_its_case_alone() {
        let known = |extrapolated, error| Known {
            as_run: extrapolated,
            extrapolated,
            error,
        };
        let programme = "[clamp]\n[[clamp.stage]]\npressure = \"1 MPa\"\n[[clamp.stage]]\npressure = \"0.2 MPa\"\n";
        let limit = pressure_limit(programme);
        assert_eq!(limit, 1.0);
        assert!(pressure_limit("[clamp]\nclosing_speed = \"1 m/s\"\n").is_nan());
        for (known, limit, told) in [
            (known(0.995, 1e-5), limit, "0.99 at the limit"),
            (known(0.98, 1e-5), limit, "0.98 +- 1e-5"),
            (known(0.98, 0.004), limit, "0.98 +- 0.004"),
            (known(0.995, 1e-5), f64::NAN, "0.99 +- 1e-5"),
            (known(0.0, 0.0), limit, "0"),
            (known(-3e-15, 2e-15), limit, "0 +- 2e-15"),
        ] {
            assert_eq!(known.told_pressure(2, " +- ", limit), told);
        }
    }

    #[test]
    fn a_value_that_rounds_to_zero_is_printed_as_0() {
        assert_eq!([fixed(-4e-4, 3), signed(4e-4, 3)], ["0", "0"]);
        assert_eq!([signed(0.25, 2), signed(-1.0, 1)], ["+0.25", "-1.0"]);
    }
}
