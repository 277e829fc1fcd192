//! Numbers with a unit.

use std::fmt;
use std::marker::PhantomData;
use std::str::FromStr;

use serde::{Deserialize, Deserializer, de};

use crate::Dimension;

/// A finite number with a unit of dimension `D`, held in SI.
#[derive(Clone, Copy, Debug, PartialEq)]
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

    fn beyond(what: impl fmt::Display) -> ParseError {
        let ([least, most], unit) = (D::SIZE, D::UNITS[0].0);
        ParseError(format!(
            "{what} is not accepted: {} from {least:e} to {most:e} {unit} is needed",
            D::NAME
        ))
    }

    /// This quantity if it is greater than zero and not too small to be meant, else a sentence
    /// saying so of what was `given`.
    pub fn positive(self, given: impl fmt::Display) -> Result<Self, ParseError> {
        if self.si >= D::SIZE[0] {
            Ok(self)
        } else if self.si > 0.0 {
            Err(Self::beyond(given))
        } else {
            Err(ParseError(format!(
                "{given} is not accepted: {} greater than zero is needed",
                D::NAME
            )))
        }
    }

    fn accepted() -> String {
        let names: Vec<_> = D::UNITS.iter().map(|(name, _)| *name).collect();
        names.join(", ")
    }
}

/// The value in SI of a text such as `"1.45 um"`, as a parser of arguments.
pub fn si<D: Dimension>(text: &str) -> Result<f64, ParseError> {
    text.parse::<Quantity<D>>().map(Quantity::si)
}

/// The same of a quantity that must be greater than zero.
pub fn positive<D: Dimension>(text: &str) -> Result<f64, ParseError> {
    let quantity = text.parse::<Quantity<D>>()?;
    quantity.positive(text.trim()).map(Quantity::si)
}

impl<D: Dimension> FromStr for Quantity<D> {
    type Err = ParseError;

    /// Parses `"<number> <unit>"`; the space may be missing (`"1.45um"`).
    fn from_str(text: &str) -> Result<Self, ParseError> {
        let text = text.trim();
        // The longest numeric prefix, so that the 'e' of an exponent is not taken for a unit.
        // Words such as "inf" are none.
        let number = |end: usize| {
            let digits = text.get(..end)?.trim_end();
            let number = digits.parse::<f64>().ok();
            let number = number.filter(|_| digits.contains(|c: char| c.is_ascii_digit()));
            number.map(|x| (x, digits, text[end..].trim()))
        };
        let (name, accepted) = (D::NAME, Self::accepted());
        let Some((number, digits, unit)) = (1..=text.len()).rev().find_map(number) else {
            return Err(ParseError(format!(
                "'{text}' is not {name}: a number with one of the units {accepted} is needed"
            )));
        };
        match D::UNITS.iter().find(|(symbol, _)| *symbol == unit) {
            Some((_, factor)) => {
                let si = number * factor;
                // A double holds neither 1e400 nor 1e-400.
                let mantissa = digits.split(['e', 'E']).next().unwrap_or_default();
                let lost = si == 0.0 && mantissa.contains(|c| ('1'..='9').contains(&c));
                let dimension = PhantomData;
                match si.abs() <= D::SIZE[1] && !lost {
                    true => Ok(Self { si, dimension }),
                    false => Err(Self::beyond(text)),
                }
            }
            None if unit.is_empty() => Err(ParseError(format!(
                "'{text}' has no unit: {name} needs one of {accepted}"
            ))),
            None => Err(ParseError(format!(
                "'{unit}' in '{text}' is not a unit of {name}: accepted are {accepted}"
            ))),
        }
    }
}

impl<D: Dimension> fmt::Display for Quantity<D> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}", self.si, D::UNITS[0].0)
    }
}

impl<'de, D: Dimension> Deserialize<'de> for Quantity<D> {
    fn deserialize<R: Deserializer<'de>>(reader: R) -> Result<Self, R::Error> {
        struct Visitor<D>(PhantomData<D>);
        impl<D: Dimension> de::Visitor<'_> for Visitor<D> {
            type Value = Quantity<D>;

            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                let accepted = Quantity::<D>::accepted();
                write!(f, "{} as a string with a unit ({accepted})", D::NAME)
            }

            fn visit_str<E: de::Error>(self, text: &str) -> Result<Self::Value, E> {
                text.parse().map_err(E::custom)
            }

            fn visit_f64<E: de::Error>(self, number: f64) -> Result<Self::Value, E> {
                self.visit_str(&number.to_string())
            }

            fn visit_i64<E: de::Error>(self, number: i64) -> Result<Self::Value, E> {
                self.visit_str(&number.to_string())
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

    #[test]
    fn the_papers_quantities() {
        for (found, si) in [
            (si::<Length>("1.45 um"), 1.45e-6),
            (si::<Length>("2.9um"), 2.9e-6),
            (si::<Viscosity>("1300 cP"), 1.3),
            (si::<Viscosity>("1.3 Pa s"), 1.3),
            (si::<Pressure>("2.5 MPa"), 2.5e6),
            (si::<Density>("1.2 g/cm3"), 1200.0),
            (si::<Speed>("1 m/s"), 1.0),
            (si::<Time>("0.08 ms"), 8e-5),
            (si::<Acceleration>("-2.3e5 m/s2"), -2.3e5),
            // An exponent is not a unit.
            (si::<Length>("1e-3 m"), 1e-3),
            (si::<Length>("1e3um"), 1e-3),
        ] {
            assert!((found - si).abs() <= 1e-14 * si.abs(), "{found} {si}");
        }
    }

    #[test]
    fn refusals_name_the_accepted_units_and_sizes() {
        let refused = |text| super::si::<Length>(text).unwrap_err().to_string();
        for bad in ["", "um", "1.45", "nan um", "inf m", "1,5 um", "1.45 Um"] {
            assert!(refused(bad).contains("um"), "{bad}: {}", refused(bad));
        }
        // Near zero is a place like another, but not an edge or a thickness.
        let positive = super::positive::<Length>;
        let (sizes, none) = ("from 1e-12 to 1e9 m", "greater than zero");
        let beyond = "1e300 m,-1e300 m,1e308 mm,1e400 um,-1E400m,1e-400 um,1e-320 nm,1e-297 mm";
        let beyond = beyond.split(',').map(|text| (text, sizes));
        for (text, why) in beyond.chain([("0 um", none), ("-1.45 um", none)]) {
            let said = positive(text).unwrap_err().to_string();
            assert_eq!(
                said,
                format!("{text} is not accepted: a length {why} is needed")
            );
        }
        assert!(positive("1 nm").is_ok());
    }
}
