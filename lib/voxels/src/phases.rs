//! Which values are void, wood and adhesive.

use std::fmt;
use std::str::FromStr;

use crate::label::Label;

/// What a voxel holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, strum::Display, strum::EnumString)]
#[strum(serialize_all = "lowercase")]
pub enum Phase {
    /// Air.
    Void,
    /// Cell wall.
    Wood,
    /// Adhesive.
    Adhesive,
}

impl Phase {
    pub(crate) const ALL: [Phase; 3] = [Phase::Void, Phase::Wood, Phase::Adhesive];

    /// The phase and the rest of `PHASE=...`, of which there is an `example`.
    fn split<'a>(part: &'a str, example: &str) -> Result<(Self, &'a str), String> {
        let (name, rest) =
            (part.split_once('=')).ok_or_else(|| format!("'{part}' is not PHASE={example}"))?;
        let name = name.trim();
        let phase = name.parse().map_err(|_| {
            format!("'{name}' is not a phase; accepted are void, wood and adhesive")
        })?;
        Ok((phase, rest))
    }
}

/// How stored values become phases.
#[derive(Clone, Debug, PartialEq)]
pub enum Phases {
    /// The stack must hold exactly the labels {0, 1, 2} or {0, 128, 255} for void, wood and
    /// adhesive, or the first two of either.
    Guess,
    /// Every label of the stack is named.
    Labels(Labels),
    /// Ranges of grey values.
    Grey(Grey),
}

/// The labels of each phase, e.g. `void=0,wood=1|2|7,adhesive=255`.
#[derive(Clone, Debug, PartialEq)]
pub struct Labels(Vec<(Label, Phase)>);

impl Labels {
    /// The phase of `label`, if it is named.
    pub fn phase(&self, label: Label) -> Option<Phase> {
        self.0.iter().find(|(l, _)| *l == label).map(|(_, p)| *p)
    }

    /// Whether they are colours.
    pub(crate) fn are_colours(&self) -> bool {
        self.0.iter().any(|(l, _)| matches!(l, Label::Rgb(_)))
    }
}

impl FromStr for Labels {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let mut labels = Self(Vec::new());
        for part in text.split(',') {
            let example = "LABEL, as in void=0,wood=1|2,adhesive=255";
            let (phase, values) = Phase::split(part, example)?;
            if labels.0.iter().any(|(_, p)| *p == phase) {
                return Err(format!(
                    "{phase} is named twice; its labels stand together, as in {phase}=1|2"
                ));
            }
            for value in values.split('|') {
                let label = value.parse()?;
                if let Some(other) = labels.phase(label) {
                    return Err(format!(
                        "label {label} is given to {other} and to {phase}; a label has one phase"
                    ));
                }
                labels.0.push((label, phase));
            }
        }
        // Wood alone, before it is bonded, has no adhesive.
        for phase in [Phase::Void, Phase::Wood] {
            if labels.0.iter().all(|(_, p)| *p != phase) {
                return Err(format!(
                    "no label is given for {phase}; void and wood are needed, and adhesive where there is some, as in void=0,wood=128,adhesive=255"
                ));
            }
        }
        Ok(labels)
    }
}

/// Inclusive ranges of grey values for wood and, unless it is undamaged, adhesive, e.g.
/// `wood=90..170,adhesive=171..`; every other value is void.
#[derive(Clone, Debug, PartialEq)]
pub struct Grey {
    wood: (f64, f64),
    adhesive: Option<(f64, f64)>,
}

impl Grey {
    /// The phase of a grey value; infinity and what is not a number have none.
    pub fn phase(&self, grey: f64) -> Option<Phase> {
        let within = |(low, high): (f64, f64)| low <= grey && grey <= high;
        match () {
            () if !grey.is_finite() => None,
            () if within(self.wood) => Some(Phase::Wood),
            () if self.adhesive.is_some_and(within) => Some(Phase::Adhesive),
            () => Some(Phase::Void),
        }
    }

    /// The same with its thresholds moved by so much; its upper end stays.
    pub fn moved(&self, by: f64) -> Self {
        let end = self
            .adhesive
            .map_or(self.wood.1, |(_, high)| high.max(self.wood.1));
        let moved = |v: f64| if v == end { v } else { v + by };
        let both = |(low, high)| (moved(low), moved(high));
        Self {
            wood: both(self.wood),
            adhesive: self.adhesive.map(both),
        }
    }

    /// Void below the first threshold, wood from there on, adhesive from the second on where there is
    /// one. What is at `top` and above is void again. `whole` numbers end at the last before the next.
    pub(crate) fn of_thresholds(thresholds: &[f64], top: Option<f64>, whole: bool) -> Self {
        let before = |v: f64| if whole { v - 1.0 } else { v.next_down() };
        let range = |i: usize| {
            let from = *thresholds.get(i)?;
            let top = top.filter(|top| *top > from);
            let next = thresholds.get(i + 1).copied().or(top);
            Some((from, next.map_or(f64::INFINITY, before)))
        };
        Self {
            wood: range(0).unwrap_or((f64::INFINITY, f64::INFINITY)),
            adhesive: range(1),
        }
    }
}

impl fmt::Display for Grey {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let bound = |v: f64| match v.is_finite() {
            true => v.to_string(),
            false => String::new(),
        };
        let range = |(low, high)| format!("{}..{}", bound(low), bound(high));
        write!(f, "wood={}", range(self.wood))?;
        match self.adhesive {
            Some(adhesive) => write!(f, ",adhesive={}", range(adhesive)),
            None => Ok(()),
        }
    }
}

impl FromStr for Grey {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (mut wood, mut adhesive) = (None, None);
        let example = "wood=90..170,adhesive=171..";
        for part in text.split(',') {
            let (phase, range) = Phase::split(part, &format!("LOW..HIGH, as in {example}"))?;
            let slot = match phase {
                Phase::Void => return Err("void is what no range names; leave it out".into()),
                Phase::Wood => &mut wood,
                Phase::Adhesive => &mut adhesive,
            };
            if slot.replace(parse_range(range)?).is_some() {
                return Err(format!("{phase} has two ranges; give one"));
            }
        }
        let wood = wood.ok_or_else(|| {
            format!("wood needs a range, and adhesive where there is some, as in {example}")
        })?;
        let meets = |adhesive: (f64, f64)| wood.0 <= adhesive.1 && adhesive.0 <= wood.1;
        if adhesive.is_some_and(meets) {
            return Err(format!(
                "the ranges of wood and adhesive overlap in '{text}'; both ends belong to a range"
            ));
        }
        Ok(Self { wood, adhesive })
    }
}

fn parse_range(text: &str) -> Result<(f64, f64), String> {
    let bound = |part: &str, open: f64| match part.trim() {
        "" => Some(open),
        number => number.parse().ok().filter(|v: &f64| v.is_finite()),
    };
    text.split_once("..")
        .and_then(|(low, high)| Some((bound(low, f64::NEG_INFINITY)?, bound(high, f64::INFINITY)?)))
        .filter(|(low, high)| low <= high)
        .ok_or_else(|| {
            format!("'{text}' is not a range of grey values; accepted are 90..170, 171.. and ..89")
        })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_of_several_values_and_colours() {
        assert!("void=0,wood=1".parse::<Labels>().is_ok());
        let labels: Labels = "void=0,wood=1|2|7,adhesive=255:0:0".parse().unwrap();
        let red = Label::Rgb([255.0, 0.0, 0.0]);
        let found = [Label::Value(7.0), red, Label::Value(3.0)].map(|label| labels.phase(label));
        assert_eq!(found, [Some(Phase::Wood), Some(Phase::Adhesive), None]);
        for (bad, word) in [
            ("wood=1,adhesive=2", "no label is given for void"),
            ("void=0,adhesive=1", "no label is given for wood"),
            ("void=0,wood=1,adhesive=1", "one phase"),
            ("void=0,wood=x,adhesive=1", "not a label"),
            ("void=0,wood=1:2,adhesive=1", "R:G:B"),
            ("void=0,wood=1,wood=2,adhesive=3", "wood is named twice"),
            ("void=0,wood,adhesive=1", "PHASE=LABEL"),
            ("void=0,glue=2", "not a phase"),
            ("void=0,wood=9007199254740993,adhesive=1", "2^53"),
            ("void=0,wood=0.1", "whole number"),
            ("void=0,wood=nan", "whole number"),
            ("void=0,wood=1:0.5:0", "whole number"),
            ("", "PHASE=LABEL"),
        ] {
            let said = bad.parse::<Labels>().unwrap_err();
            assert!(said.contains(word), "{bad}: {said}");
        }
    }

    #[test]
    fn grey_ranges_hold_both_ends() {
        let grey: Grey = "wood=90..170,adhesive=171..".parse().unwrap();
        let found = [89.0, 90.0, 170.0, 171.0].map(|v| grey.phase(v).unwrap() as u8);
        assert_eq!(found, [0, 1, 1, 2]);
        for none in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert_eq!(grey.phase(none), None);
        }
        let bare: Grey = "wood=90..".parse().unwrap();
        assert_eq!(bare.to_string(), "wood=90..");
        let found = [89.0, 90.0, 1e9].map(|v| bare.phase(v).unwrap() as u8);
        assert_eq!(found, [0, 1, 1]);
        for bad in [
            "adhesive=90..170",
            "wood=90..170,adhesive=170..",
            "wood=170..90,adhesive=171..",
            "wood=90,adhesive=171..",
            "void=0..1,wood=2..3,adhesive=4..",
            "wood=1..2,wood=3..4,adhesive=5..",
        ] {
            assert!(bad.parse::<Grey>().is_err(), "{bad}");
        }
    }
}
