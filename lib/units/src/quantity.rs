//! Numbers with a unit.

use std::fmt;
use std::marker::PhantomData;
use std::str::FromStr;

use serde::{Deserialize, Deserializer, de};

use crate::Dimension;

/// A finite number with a unit of dimension `D`, held in SI.
#[derive(Clone, Copy, PartialEq)]
pub struct Quantity<D> {
    si: f64,
    dimension: PhantomData<D>,
}

/// Why a text is not a quantity; one sentence that names the accepted units.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct ParseError(String);

impl<D: Dimension> Quantity<D> {
    /// The value in the SI unit of its dimension.
    pub fn si(self) -> f64 {
        self.si
    }

    /// A quantity from its value in SI.
    fn from_si(si: f64) -> Self {
        Self {
            si,
            dimension: PhantomData,
        }
    }

    /// This quantity if it is not too large to be meant; `text` is what was written.
    fn of_size(self, text: &str) -> Result<Self, ParseError> {
        if self.si.abs() <= D::SIZE[1] {
            Ok(self)
        } else {
            Err(Self::beyond(text))
        }
    }

    fn beyond(what: &str) -> ParseError {
        let ([least, most], unit) = (D::SIZE, D::UNITS[0].0);
        ParseError(format!(
            "{what} is not accepted: {} from {least:e} to {most:e} {unit} is needed",
            D::NAME
        ))
    }

    /// This quantity if it is greater than zero and not too small to be meant, else a sentence
    /// saying so.
    pub fn positive(self) -> Result<Self, ParseError> {
        if self.si >= D::SIZE[0] {
            Ok(self)
        } else if self.si > 0.0 {
            Err(Self::beyond(&format!("{:e} {}", self.si, D::UNITS[0].0)))
        } else {
            Err(ParseError(format!(
                "{self} is not accepted: {} greater than zero is needed",
                D::NAME
            )))
        }
    }

    fn accepted() -> String {
        let names: Vec<_> = D::UNITS.iter().map(|(name, _)| *name).collect();
        names.join(", ")
    }
}

impl<D: Dimension> FromStr for Quantity<D> {
    type Err = ParseError;

    /// Parses `"<number> <unit>"`; the space may be missing (`"1.45um"`).
    fn from_str(text: &str) -> Result<Self, ParseError> {
        let text = text.trim();
        // The longest numeric prefix, so that the 'e' of an exponent is not taken for a unit.
        let split = (1..=text.len())
            .rev()
            .filter(|&end| text.is_char_boundary(end))
            .find(|&end| {
                text[..end]
                    .trim_end()
                    .parse::<f64>()
                    .is_ok_and(f64::is_finite)
            });
        let Some(split) = split else {
            return Err(ParseError(format!(
                "'{text}' is not {}: a number with one of the units {} is needed",
                D::NAME,
                Self::accepted()
            )));
        };
        let number: f64 = text[..split].trim_end().parse().unwrap_or(f64::NAN);
        let unit = text[split..].trim();
        match D::UNITS.iter().find(|(name, _)| *name == unit) {
            Some((_, factor)) => Self::from_si(number * factor).of_size(text),
            None if unit.is_empty() => Err(ParseError(format!(
                "'{text}' has no unit: {} needs one of {}",
                D::NAME,
                Self::accepted()
            ))),
            None => Err(ParseError(format!(
                "'{unit}' in '{text}' is not a unit of {}: accepted are {}",
                D::NAME,
                Self::accepted()
            ))),
        }
    }
}

impl<D: Dimension> fmt::Display for Quantity<D> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}", self.si, D::UNITS[0].0)
    }
}

impl<D: Dimension> fmt::Debug for Quantity<D> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl<'de, D: Dimension> Deserialize<'de> for Quantity<D> {
    fn deserialize<R: Deserializer<'de>>(reader: R) -> Result<Self, R::Error> {
        struct Visitor<D>(PhantomData<D>);
        impl<D: Dimension> de::Visitor<'_> for Visitor<D> {
            type Value = Quantity<D>;

            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                write!(
                    f,
                    "{} as a string with a unit ({})",
                    D::NAME,
                    Quantity::<D>::accepted()
                )
            }

            fn visit_str<E: de::Error>(self, text: &str) -> Result<Self::Value, E> {
                text.parse().map_err(E::custom)
            }
        }
        reader.deserialize_any(Visitor(PhantomData))
    }
}

#[cfg(test)]
mod tests {
    use crate::{
        Acceleration, Density, Dimension, Length, Pressure, Quantity, Speed, Time, Viscosity,
    };

    fn si<D: Dimension>(text: &str) -> f64 {
        text.parse::<Quantity<D>>().unwrap().si()
    }

    fn close(a: f64, b: f64) -> bool {
        (a - b).abs() <= 1e-14 * b.abs()
    }

    #[test]
    fn the_papers_quantities() {
        assert!(close(si::<Length>("1.45 um"), 1.45e-6));
        assert!(close(si::<Length>("2.9um"), 2.9e-6));
        assert!(close(si::<Viscosity>("1300 cP"), 1.3));
        assert!(close(si::<Viscosity>("1.3 Pa s"), 1.3));
        assert!(close(si::<Pressure>("2.5 MPa"), 2.5e6));
        assert!(close(si::<Density>("1.2 g/cm3"), 1200.0));
        assert!(close(si::<Speed>("1 m/s"), 1.0));
        assert!(close(si::<Time>("0.08 ms"), 8e-5));
        assert!(close(si::<Acceleration>("-2.3e5 m/s2"), -2.3e5));
    }

    #[test]
    fn refusals_name_the_accepted_units() {
        for bad in [
            "",
            "um",
            "1.45",
            "1.45 furlong",
            "nan um",
            "inf m",
            "1,5 um",
            "1.45 Um",
        ] {
            let said = bad.parse::<Quantity<Length>>().unwrap_err().to_string();
            assert!(said.contains("um"), "{bad}: {said}");
        }
        assert!(
            "0 um"
                .parse::<Quantity<Length>>()
                .unwrap()
                .positive()
                .is_err()
        );
        assert!(
            "-1 um"
                .parse::<Quantity<Length>>()
                .unwrap()
                .positive()
                .is_err()
        );
    }

    #[test]
    fn sizes_beyond_all_bounds_are_refused() {
        let parse = |text: &str| text.parse::<Quantity<Length>>();
        assert!(parse("1e300 m").is_err() && parse("-1e300 m").is_err());
        assert!(parse("1e308 mm").is_err());
        // Near zero is a place like another, but not an edge or a thickness.
        assert!(parse("1e-300 m").is_ok() && parse("0 m").is_ok());
        let said = parse("1e-300 m").unwrap().positive().unwrap_err();
        assert!(said.to_string().contains("from 1e-12 to 1e9 m"), "{said}");
        assert!(parse("1 nm").unwrap().positive().is_ok());
    }

    #[test]
    fn an_exponent_is_not_a_unit() {
        assert!(close(si::<Length>("1e-3 m"), 1e-3));
        assert!(close(si::<Length>("1e3um"), 1e-3));
    }
}
