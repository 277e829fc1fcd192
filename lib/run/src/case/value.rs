//! Values of a case file that are more than a plain quantity.

use std::fmt;

use physics::Choice;
use serde::Deserialize;
use serde::de::{self, Deserializer};
use units::{Dimension, Length, Quantity, Speed, Time};

use super::CaseError;

/// A quantity that must be greater than zero.
#[derive(Clone, Copy, Debug)]
pub struct Positive<D: Dimension>(Quantity<D>);

impl<D: Dimension> Positive<D> {
    /// Value in SI.
    pub fn si(self) -> f64
    where
        D: Copy,
    {
        self.0.si()
    }
}

impl<'de, D: Dimension> Deserialize<'de> for Positive<D> {
    fn deserialize<R: Deserializer<'de>>(reader: R) -> Result<Self, R::Error> {
        Quantity::deserialize(reader)?
            .positive()
            .map(Self)
            .map_err(de::Error::custom)
    }
}

/// A length, or a multiple of the cell (`"0.01 cell"`).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CellLength {
    /// In cells.
    Cells(f64),
    /// In metres.
    Metres(f64),
}

impl CellLength {
    /// In metres for a cell of `cell_m`.
    pub fn si(self, cell_m: f64) -> f64 {
        match self {
            CellLength::Cells(n) => n * cell_m,
            CellLength::Metres(l) => l,
        }
    }

    /// In cells of `cell_m`.
    pub fn cells(self, cell_m: f64) -> f64 {
        match self {
            CellLength::Cells(n) => n,
            CellLength::Metres(l) => l / cell_m,
        }
    }
}

impl<'de> Deserialize<'de> for CellLength {
    fn deserialize<R: Deserializer<'de>>(reader: R) -> Result<Self, R::Error> {
        let text = text(
            reader,
            "a length such as \"29 nm\" or a multiple of the cell such as \"0.01 cell\"",
        )?;
        if let Some(number) = text.trim().strip_suffix("cell") {
            return multiple(number).map(CellLength::Cells).ok_or_else(|| {
                de::Error::custom(format!(
                    "'{text}' is not accepted: a number of cells greater than zero is needed, such as \"0.01 cell\""
                ))
            });
        }
        text.parse::<Quantity<Length>>()
            .and_then(Quantity::positive)
            .map(|l| CellLength::Metres(l.si()))
            .map_err(|e| {
                de::Error::custom(format!("{e}, or a number of cells such as \"0.01 cell\""))
            })
    }
}

/// The edge of a cell: a length, or a multiple of the specimen's voxel (`"2 voxels"`).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CellEdge {
    /// In voxels.
    Voxels(f64),
    /// In metres.
    Metres(f64),
}

impl CellEdge {
    /// In metres, with the voxel of a bond file where there is one.
    ///
    /// # Errors
    /// A multiple of a voxel where nothing has voxels.
    pub fn si(self, voxel_m: Option<f64>) -> Result<f64, CaseError> {
        match (self, voxel_m) {
            (CellEdge::Metres(edge), _) => Ok(edge),
            (CellEdge::Voxels(n), Some(voxel)) => Ok(n * voxel),
            (CellEdge::Voxels(_), None) => Err(CaseError(
                "[grid] cell is given in voxels, and [[body]] tables have none: give a length such as \"2.9 um\"".into(),
            )),
        }
    }
}

impl<'de> Deserialize<'de> for CellEdge {
    fn deserialize<R: Deserializer<'de>>(reader: R) -> Result<Self, R::Error> {
        let text = text(
            reader,
            "a length such as \"2.9 um\" or a multiple of the specimen's voxel such as \"2 voxels\"",
        )?;
        let bare = text.trim();
        let number = bare.strip_suffix("voxels").or(bare.strip_suffix("voxel"));
        if let Some(number) = number {
            return multiple(number).map(CellEdge::Voxels).ok_or_else(|| {
                de::Error::custom(format!(
                    "'{text}' is not accepted: a number of voxels greater than zero is needed, such as \"2 voxels\""
                ))
            });
        }
        text.parse::<Quantity<Length>>()
            .and_then(Quantity::positive)
            .map(|edge| CellEdge::Metres(edge.si()))
            .map_err(|e| de::Error::custom(format!("{e}, or voxels, such as \"2 voxels\"")))
    }
}

/// The number before a unit of which there is a whole or a part.
fn multiple(number: &str) -> Option<f64> {
    let number = number.trim().parse::<f64>().ok();
    number.filter(|n| *n > 0.0 && n.is_finite())
}

/// `stop` of the clamp: `"closed"` or a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StopRule {
    /// When the adherends are back in place.
    Closed,
    /// At this time, s.
    Time(f64),
}

impl<'de> Deserialize<'de> for StopRule {
    fn deserialize<R: Deserializer<'de>>(reader: R) -> Result<Self, R::Error> {
        let text = text(reader, "\"closed\" or a time such as \"0.08 ms\"")?;
        if text == "closed" {
            return Ok(StopRule::Closed);
        }
        text.parse::<Quantity<Time>>()
            .and_then(Quantity::positive)
            .map(|t| StopRule::Time(t.si()))
            .map_err(|e| de::Error::custom(format!("{e}, or \"closed\"")))
    }
}

/// Velocity of a body: three speeds, or `"clamp"` for a rigid body the clamp drives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BodyVelocity {
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
        let wanted = "three speeds such as [\"0 m/s\", \"-1 m/s\", \"0 m/s\"], or \"clamp\"";
        match Raw::deserialize(reader) {
            Ok(Raw::Word(word)) if word == "clamp" => Ok(BodyVelocity::Clamp),
            Ok(Raw::Speeds(speeds)) => {
                let mut v = [0.0; 3];
                for (v, text) in v.iter_mut().zip(&speeds) {
                    *v = text
                        .parse::<Quantity<Speed>>()
                        .map_err(de::Error::custom)?
                        .si();
                }
                Ok(BodyVelocity::Constant(v))
            }
            _ => Err(de::Error::custom(format!("a body's velocity is {wanted}"))),
        }
    }
}

/// The alternative that a word names.
pub(super) fn choice<'de, R: Deserializer<'de>, C: Choice>(reader: R) -> Result<C, R::Error> {
    C::named(&String::deserialize(reader)?).map_err(de::Error::custom)
}

/// The same where a case may leave it out.
pub(super) fn some_choice<'de, R: Deserializer<'de>, C: Choice>(
    reader: R,
) -> Result<Option<C>, R::Error> {
    choice(reader).map(Some)
}

fn text<'de, R: Deserializer<'de>>(reader: R, wanted: &'static str) -> Result<String, R::Error> {
    struct Visitor(&'static str);
    impl de::Visitor<'_> for Visitor {
        type Value = String;
        fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
            f.write_str(self.0)
        }
        fn visit_str<E: de::Error>(self, text: &str) -> Result<String, E> {
            Ok(text.to_owned())
        }
    }
    reader.deserialize_any(Visitor(wanted))
}
