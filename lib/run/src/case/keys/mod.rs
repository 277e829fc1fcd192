//! Every key of a case file as a user reads of it: one entry a key, the home of `mpm-run --reference`,
//! docs/case-file.md and the defaults in `resolved.toml`. A key of the schema without its entry fails a test.

mod air;
mod liquid;
mod press;
#[cfg(test)]
mod probe;
mod process;
mod scene;
mod scheme;
mod water;
mod wetting;

use physics::Choice;
use units::Dimension;

use crate::case::Case;
use crate::resolve::Setup;

/// A table of a case file and its keys.
pub(crate) struct Table {
    /// Its place, `clamp` or `clamp.stage`.
    pub path: &'static str,
    /// Whether it may be given several times, as `[[body]]` is.
    pub repeated: bool,
    /// Whether its defaults hold in a case that does not name it.
    pub always: bool,
    /// What it is about, in a sentence or two.
    pub about: &'static str,
    /// Its keys in the order in which they are told and written.
    pub keys: &'static [Key],
}

/// A key of a [`Table`].
pub(crate) struct Key {
    /// Its name; `pid.kp` is `kp` in the inline table `pid`.
    pub name: &'static str,
    /// What may be given.
    pub form: fn() -> String,
    /// What holds where it is not given.
    pub absent: Absent,
    /// What it is, and when to change it.
    pub text: &'static str,
}

/// What holds where a key is not given.
pub(crate) enum Absent {
    /// Nothing, always or in the case told: the run is refused.
    Needed(&'static str),
    /// This value, as TOML.
    Value(&'static str),
    /// What the words say; the value as TOML in a run, where there is one that a case could name.
    Of(&'static str, fn(&Case, &Setup) -> Option<String>),
    /// No value: the words say what that means.
    Nothing(&'static str),
}

/// The tables of a case file.
pub(crate) const TABLES: &[Table] = &[
    scene::GRID,
    process::ADHESIVE,
    liquid::POWER_LAW,
    liquid::CROSS,
    liquid::CARREAU_YASUDA,
    liquid::HERSCHEL_BULKLEY,
    liquid::CURE,
    water::WATER,
    process::CONTACT,
    process::CLAMP,
    press::STAGE,
    process::STOP,
    scheme::INTEGRATOR,
    scheme::OUTPUT,
    scene::BODY,
    scene::GRAVITY,
    air::AIR,
    scene::BOUNDARY,
];

/// `a length` without its article.
pub(in crate::case) fn quantity<D: Dimension>() -> String {
    let words = D::NAME;
    words
        .split_once(' ')
        .map_or(words, |(_, noun)| noun)
        .to_owned()
}

/// The alternatives of a choice.
pub(super) fn choice<C: Choice>() -> String {
    let names = C::NAMED.iter().map(|(name, _)| format!("`\"{name}\"`"));
    names.collect::<Vec<_>>().join(", ")
}

/// A name as TOML.
pub(super) fn word(name: &str) -> String {
    format!("\"{name}\"")
}

/// A value in SI as TOML that reads back to the same number.
pub(super) fn si<D: Dimension>(value: f64) -> String {
    format!("\"{value:?} {}\"", D::UNITS[0].0)
}

/// Three of them.
pub(super) fn three<D: Dimension>(values: [f64; 3]) -> String {
    format!("[{}]", values.map(si::<D>).join(", "))
}
