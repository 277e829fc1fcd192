//! `resolved.toml`: the case of a run with the defaults of all keys that were not given. Used as a case file it repeats the
//! run.

use mpm::{PressureFrom, ShapeFunction, VelocityUpdate};
use physics::{Choice, Pid};
use units::{Dimension, Length, Time};

use crate::case::{Case, ReferenceTable, SchemeName, StopRule, tables};
use crate::changed_keys::value_at;
use crate::resolve::Setup;
use crate::schemes;

const OPENING: &str = "\
# The case of this run with all defaults; used as a case file, it repeats the run.
# mpm-run --reference explains the keys.
";

/// Comment after a default value.
const DEFAULT: &str = " # default";
/// Tables whose defaults hold even if the case does not name them.
const IMPLIED: [&str; 3] = ["output", "gravity", "boundary"];
/// Most differing keys that a message names.
const MOST_NAMED: usize = 3;

/// The content of `resolved.toml` for the case parsed from `text`.
pub(crate) fn text(text: &str, case: &Case, setup: &Setup) -> String {
    let given = toml::Value::Table(text.parse().unwrap_or_default());
    let none = toml::Value::Table(toml::Table::new());
    let mut out = String::from(OPENING);
    for table in tables() {
        let places = match value_at(&given, table.path) {
            Some(toml::Value::Array(list)) => list.iter().collect(),
            Some(place) => vec![place],
            None if IMPLIED.contains(&table.path) => vec![&none],
            None => Vec::new(),
        };
        if places.is_empty() {
            out += &format!("\n# {}: not given\n", table.heading);
        }
        for place in places {
            out += &table_text(&table, place, case, setup);
        }
    }
    out
}

fn table_text(table: &ReferenceTable, place: &toml::Value, case: &Case, setup: &Setup) -> String {
    let mut out = format!("\n{}\n", table.heading);
    for key in &table.keys {
        let name = key.name();
        let derived = || derived(&format!("{}.{name}", table.path), case, setup);
        let words = key.default().replace('`', "");
        out += &match value_at(place, name) {
            Some(value) => format!("{name} = {value}"),
            None => match (derived(), key.value()) {
                (Some(Some(value)), _) => format!("{name} = {value}{DEFAULT}"),
                (Some(None), _) => format!("# {name}: not used"),
                (None, Some(value)) => format!("{name} = {value}{DEFAULT}"),
                (None, None) if words.starts_with("needed") => {
                    format!("# {name}: not given, {words}")
                }
                (None, None) => format!("# {name}: {words}"),
            },
        };
        out.push('\n');
    }
    out
}

/// A default that follows from case and scene, as TOML: `Some(None)` if the key is not used, `None` for all other keys.
fn derived(key: &str, case: &Case, setup: &Setup) -> Option<Option<String>> {
    let explicit = case.integrator.scheme == SchemeName::Explicit;
    let grid = || (!case.body.is_empty()).then_some(&setup.scene.grid);
    let clamp = case.clamp.as_ref();
    let unstaged = clamp.filter(|clamp| clamp.stage.is_empty());
    let closes = unstaged.filter(|clamp| matches!(clamp.stop, None | Some(StopRule::Closed)));
    let word = |name: &str| format!("\"{name}\"");
    let of_explicit = |name: &str| explicit.then(|| word(name));
    let gain = |gain: f64| {
        let held = clamp.is_some_and(|clamp| clamp.max_pressure.is_some());
        (held && explicit).then(|| format!("{gain:?}"))
    };
    Some(match key {
        "grid.shape" => of_explicit(ShapeFunction::default().name()),
        "grid.domain.min" => grid().map(|grid| corner(grid.min_m)),
        "grid.domain.max" => grid().map(|grid| corner(grid.max_m())),
        "clamp.pid.kp" => gain(Pid::default().kp),
        "clamp.pid.ki" => gain(Pid::default().ki),
        "clamp.pid.kd" => gain(Pid::default().kd),
        "clamp.stop" => unstaged.map(|_| word("closed")),
        "clamp.time_limit" => closes.map(|_| si::<Time>(setup.time_limit_s)),
        "clamp.travel" => clamp.and(setup.initial_gap_m).map(si::<Length>),
        "integrator.velocity_update" => of_explicit(VelocityUpdate::default().name()),
        "integrator.cfl" => Some(format!("{:?}", schemes::cfl(case))),
        "integrator.pressure" => of_explicit(PressureFrom::default().name()),
        "integrator.tolerance" => {
            (!explicit).then(|| format!("{:?}", implicit::Settings::default().tolerance))
        }
        "output.history_every" => {
            (setup.history_every_s > 0.0).then(|| si::<Time>(setup.history_every_s))
        }
        _ => return None,
    })
}

/// A value in SI as TOML, in the unit with the fewest digits; it reads back to the same number.
fn si<D: Dimension>(value: f64) -> String {
    let texts = D::UNITS.iter().filter_map(|(unit, factor)| {
        let short = units::shortened(value / factor);
        (short * factor == value).then(|| format!("{short} {unit}"))
    });
    let exact = || format!("{value:?} {}", D::UNITS[0].0);
    format!(
        "\"{}\"",
        texts.min_by_key(String::len).unwrap_or_else(exact)
    )
}

fn corner(metres: [f64; 3]) -> String {
    format!("[{}]", metres.map(si::<Length>).join(", "))
}

/// The first keys in which two `resolved.toml` differ, with both values, for the message on a run that is not continued.
/// Defaults are ignored, as some follow from the bond. `part` selects the part of the text to compare. A list of tables
/// counts as one key. Empty if a text is no TOML.
pub(crate) fn differences(texts: [&str; 2], part: fn(&str) -> String) -> Vec<String> {
    let given = |text: &str| -> Option<toml::Value> {
        let lines = text.lines().filter(|line| !line.ends_with(DEFAULT));
        let text = part(&lines.collect::<Vec<_>>().join("\n"));
        text.parse().ok().map(toml::Value::Table)
    };
    let [Some(is), Some(was)] = texts.map(given) else {
        return Vec::new();
    };
    let paths = tables().flat_map(|table| match table.repeated() {
        true => vec![table.path.to_owned()],
        false => (table.keys.iter())
            .map(|key| format!("{}.{}", table.path, key.name()))
            .collect(),
    });
    let value = |of: Option<&toml::Value>| of.map_or("not given".to_owned(), ToString::to_string);
    paths
        .filter_map(|path| {
            let [is, was] = [value_at(&is, &path), value_at(&was, &path)];
            (is != was).then(|| format!("{path} is {}, was {}", value(is), value(was)))
        })
        .take(MOST_NAMED)
        .collect()
}
