//! Values of a case file that are more than a plain quantity.

use physics::Choice;
use serde::Deserialize;
use serde::de::{Deserializer, Error};
use units::{Dimension, Length, Quantity, Speed, Time};

use crate::failure::{RunFailure, refused};

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
        let quantity = Quantity::deserialize(reader)?.positive();
        quantity.map(Self).map_err(Error::custom)
    }
}

/// A quantity greater than zero in SI, or a sentence that ends with what else is accepted.
fn positive<D: Dimension, E: Error>(text: &str, or: &str) -> Result<f64, E> {
    let quantity = text.parse::<Quantity<D>>().and_then(Quantity::positive);
    quantity
        .map(Quantity::si)
        .map_err(|e| E::custom(format!("{e}, or {or}")))
}

/// A number greater than zero before one of the `names` of something that lengths are multiples of; none of a text
/// without such a name.
fn multiple<E: Error>(text: &str, names: &[&str], example: &str) -> Option<Result<f64, E>> {
    let number = names
        .iter()
        .find_map(|name| text.trim().strip_suffix(name))?;
    let number = number.trim().parse::<f64>().ok();
    let sound = number.filter(|n| *n > 0.0 && n.is_finite());
    Some(sound.ok_or_else(|| {
        E::custom(format!(
            "'{text}' is not accepted: a number of {}s greater than zero is needed, such as {example}",
            names[names.len() - 1]
        ))
    }))
}

/// A length, or a multiple of the cell (`"0.01 cell"`).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum CellLength {
    Cells(f64),
    /// In metres.
    Metres(f64),
}

impl CellLength {
    /// In metres for a cell of `cell_m`.
    pub(crate) fn si(self, cell_m: f64) -> f64 {
        match self {
            CellLength::Cells(n) => n * cell_m,
            CellLength::Metres(l) => l,
        }
    }

    /// In cells of `cell_m`.
    pub(crate) fn cells(self, cell_m: f64) -> f64 {
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
        match multiple(&text, &["cell"], "\"0.01 cell\"") {
            Some(cells) => cells.map(Self::Cells),
            None => positive::<Length, _>(&text, "a number of cells such as \"0.01 cell\"")
                .map(Self::Metres),
        }
    }
}

/// The edge of a cell: a length, or a multiple of the specimen's voxel (`"2 voxels"`).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum CellEdge {
    Voxels(f64),
    /// In metres.
    Metres(f64),
}

impl CellEdge {
    /// In metres, with the voxel of a bond file where there is one.
    pub(crate) fn si(self, voxel_m: Option<f64>) -> Result<f64, RunFailure> {
        match (self, voxel_m) {
            (CellEdge::Metres(edge), _) => Ok(edge),
            (CellEdge::Voxels(n), Some(voxel)) => Ok(n * voxel),
            (CellEdge::Voxels(_), None) => refused(
                "[grid] cell is given in voxels, and [[body]] tables have none: give a length such as \"2.9 um\"",
            ),
        }
    }
}

impl<'de> Deserialize<'de> for CellEdge {
    fn deserialize<R: Deserializer<'de>>(reader: R) -> Result<Self, R::Error> {
        let text = text(
            reader,
            "a length such as \"2.9 um\" or a multiple of the specimen's voxel such as \"2 voxels\"",
        )?;
        match multiple(&text, &["voxels", "voxel"], "\"2 voxels\"") {
            Some(voxels) => voxels.map(Self::Voxels),
            None => positive::<Length, _>(&text, "voxels, such as \"2 voxels\"").map(Self::Metres),
        }
    }
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
                    let speed = text.parse::<Quantity<Speed>>();
                    *v = speed.map_err(Error::custom)?.si();
                }
                Ok(BodyVelocity::Constant(v))
            }
            _ => Err(Error::custom(
                "a body's velocity is three speeds such as [\"0 m/s\", \"-1 m/s\", \"0 m/s\"], or \"clamp\"",
            )),
        }
    }
}

/// The alternative that a word names.
pub(super) fn choice<'de, R: Deserializer<'de>, C: Choice>(reader: R) -> Result<C, R::Error> {
    C::named(&String::deserialize(reader)?).map_err(Error::custom)
}

/// The same where a case may leave it out.
pub(super) fn some_choice<'de, R: Deserializer<'de>, C: Choice>(
    reader: R,
) -> Result<Option<C>, R::Error> {
    choice(reader).map(Some)
}

/// A text, where anything else is refused in words that say what is `wanted`.
fn text<'de, R: Deserializer<'de>>(reader: R, wanted: &str) -> Result<String, R::Error> {
    match toml::Value::deserialize(reader)? {
        toml::Value::String(text) => Ok(text),
        other => Err(Error::custom(format!(
            "invalid type: {} `{other}`, expected {wanted}",
            other.type_str()
        ))),
    }
}
