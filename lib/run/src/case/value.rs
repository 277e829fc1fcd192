//! Values of a case file that are not plain quantities.

use physics::Choice;
use serde::Deserialize;
use serde::de::{Deserializer, Error};
use units::{Dimension, Length, Quantity, Speed, Time};

/// A quantity that must be greater than zero.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Positive<D: Dimension>(Quantity<D>);

impl<D: Dimension + Copy> Positive<D> {
    /// Value in SI.
    pub(crate) fn si(self) -> f64 {
        self.0.si()
    }
}

impl<'de, D: Dimension> Deserialize<'de> for Positive<D> {
    fn deserialize<R: Deserializer<'de>>(reader: R) -> Result<Self, R::Error> {
        let quantity = Quantity::deserialize(reader)?;
        let given = quantity.to_string();
        quantity.positive(given).map(Self).map_err(Error::custom)
    }
}

/// A quantity greater than zero, in SI. The error names `or` as the accepted alternative.
fn positive<D: Dimension, E: Error>(text: &str, or: &str) -> Result<f64, E> {
    units::positive::<D>(text).map_err(|e| E::custom(format!("{e}, or {or}")))
}

/// A length, or a multiple of an edge: of a cell (`"0.01 cell"`) or, for the cell itself, of a voxel (`"2 voxels"`).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum EdgeLength {
    Edges(f64),
    /// In metres.
    Metres(f64),
}

impl EdgeLength {
    /// In metres, for edges of `edge_m`.
    pub(crate) fn si(self, edge_m: f64) -> f64 {
        match self {
            Self::Edges(n) => n * edge_m,
            Self::Metres(l) => l,
        }
    }

    /// In edges of `edge_m`.
    pub(crate) fn edges(self, edge_m: f64) -> f64 {
        match self {
            Self::Edges(n) => n,
            Self::Metres(l) => l / edge_m,
        }
    }

    /// Parses a number followed by one of the `names` of an edge, as in `example`, or a length. The error on a wrong length
    /// names `or` as the alternative.
    fn parse<E: Error>(text: &str, names: &[&str], example: &str, or: &str) -> Result<Self, E> {
        let number = names.iter().find_map(|n| text.trim().strip_suffix(n));
        let Some(number) = number else {
            let length = positive::<Length, _>(text, &format!("{or} such as {example}"));
            return length.map(Self::Metres);
        };
        let number = number.trim().parse::<f64>().ok();
        let sound = number.filter(|n| *n > 0.0 && n.is_finite());
        sound.map(Self::Edges).ok_or_else(|| {
            E::custom(format!(
                "'{text}' is not accepted: a finite number of {}s greater than zero is needed, such as {example}",
                names[names.len() - 1]
            ))
        })
    }
}

/// Edges are those of cells.
impl<'de> Deserialize<'de> for EdgeLength {
    fn deserialize<R: Deserializer<'de>>(reader: R) -> Result<Self, R::Error> {
        let wanted = "a length such as \"29 nm\" or a multiple of the cell such as \"0.01 cell\"";
        let text = text(reader, wanted)?;
        Self::parse(&text, &["cell"], "\"0.01 cell\"", "a number of cells")
    }
}

/// Reads an [`EdgeLength`] whose edges are those of voxels.
pub(super) fn in_voxels<'de, R: Deserializer<'de>>(reader: R) -> Result<EdgeLength, R::Error> {
    let wanted =
        "a length such as \"2.9 um\" or a multiple of the specimen's voxel such as \"2 voxels\"";
    let text = text(reader, wanted)?;
    EdgeLength::parse(&text, &["voxels", "voxel"], "\"2 voxels\"", "voxels,")
}

/// `stop` of the clamp: `"closed"` or a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum StopRule {
    /// When the adherends are back in place.
    Closed,
    /// At this time, s.
    Time(f64),
}

impl<'de> Deserialize<'de> for StopRule {
    fn deserialize<R: Deserializer<'de>>(reader: R) -> Result<Self, R::Error> {
        match text(reader, "\"closed\" or a time such as \"0.08 ms\"")?.as_str() {
            "closed" => Ok(StopRule::Closed),
            text => positive::<Time, _>(text, "\"closed\"").map(StopRule::Time),
        }
    }
}

/// Velocity of a body: three speeds, or `"clamp"` for a rigid body the clamp drives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum BodyVelocity {
    /// Constant, m/s.
    Constant([f64; 3]),
    /// Along -y at the clamp's closing speed.
    Clamp,
}

impl<'de> Deserialize<'de> for BodyVelocity {
    fn deserialize<R: Deserializer<'de>>(reader: R) -> Result<Self, R::Error> {
        #[derive(Deserialize)]
        #[serde(untagged)]
        enum Raw {
            Word(String),
            Speeds([String; 3]),
        }
        match Raw::deserialize(reader) {
            Ok(Raw::Word(word)) if word == "clamp" => Ok(BodyVelocity::Clamp),
            Ok(Raw::Speeds(speeds)) => {
                let mut v = [0.0; 3];
                for (v, text) in v.iter_mut().zip(&speeds) {
                    *v = units::si::<Speed>(text).map_err(Error::custom)?;
                }
                Ok(BodyVelocity::Constant(v))
            }
            _ => Err(Error::custom(
                "a body's velocity is three speeds such as [\"0 m/s\", \"-1 m/s\", \"0 m/s\"], or \"clamp\"",
            )),
        }
    }
}

/// A choice by its name.
pub(super) fn choice<'de, R: Deserializer<'de>, C: Choice>(reader: R) -> Result<C, R::Error> {
    C::named(&String::deserialize(reader)?).map_err(Error::custom)
}

/// An optional choice by its name.
pub(super) fn some_choice<'de, R: Deserializer<'de>, C: Choice>(
    reader: R,
) -> Result<Option<C>, R::Error> {
    choice(reader).map(Some)
}

/// A string; the error on anything else names what is `wanted`.
fn text<'de, R: Deserializer<'de>>(reader: R, wanted: &str) -> Result<String, R::Error> {
    match toml::Value::deserialize(reader)? {
        toml::Value::String(text) => Ok(text),
        other => Err(Error::custom(format!(
            "{other} is not accepted: {wanted} is needed"
        ))),
    }
}
