//! A run's own account: `summary.json` and `resolved.toml` of its folder.

use std::path::Path;

use figures::{Known, RunEnd, Table, fixed, pressure_limit, time_unit};
use particle_file::{ParticleFile, command_line, file_of_run};
use serde_json::Value;

use crate::setup::Setup;
use crate::{Error, Labelled, html, read_text};

const MOST_BYTES: u64 = 1 << 20;
/// How far the table beside a run may be from what the run says of itself: else it is another state's.
const SAME: f64 = 1e-3;

/// A measured specimen.
pub struct Measured {
    /// Its name.
    pub(crate) label: String,
    /// Share of its adhesive that entered the wood, %, and the mean depth of that, um.
    pub(crate) entered: [String; 2],
    /// WP of its bottom, its top and in total, um.
    pub(crate) wp: [Known; 3],
    /// Hashes of the files that it was measured in.
    content: Vec<String>,
}

/// A run folder.
pub struct RunFolder {
    /// What it is called.
    pub(crate) label: String,
    summary: Value,
    resolved: String,
    pub(crate) end: RunEnd,
    pub(crate) setup: Setup,
    /// Bottom, top, total; um.
    pub(crate) wp: [Known; 3],
    /// At the end, MPa.
    pub(crate) pressure: Known,
    /// The most that the press may come to, MPa; NaN where that is not known.
    pub(crate) limit: f64,
    /// What is odd about its voxels.
    pub(crate) voxel_doubts: Vec<String>,
    /// Hashes of the files that its bond was made from.
    made_of: Vec<String>,
}

impl RunFolder {
    /// Reads a run folder; one without a summary is of a run that has not ended, which it then says.
    /// Errors of penetration are of the `wp.csv` that lies there.
    ///
    /// # Errors
    /// A folder without `resolved.toml`, or files that are not a run's.
    pub fn read(folder: &Labelled) -> Result<Self, Error> {
        let case = file_of_run(&folder.path, "resolved.toml")?;
        let (end, summary) = RunEnd::in_folder(&folder.path)?;
        let resolved = read_text(&case, MOST_BYTES)?;
        let case = summary.pointer("/provenance/inputs/0/path");
        let case = Path::new(case.and_then(Value::as_str).unwrap_or("case"));
        let case = case.file_name().unwrap_or_default().to_string_lossy();
        let number = |pointer: &str, unit: f64| {
            let found = summary.pointer(pointer).and_then(Value::as_f64);
            Known::plain(unit * found.unwrap_or(f64::NAN))
        };
        let sides = ["bottom", "top", "total"];
        let mut wp = sides.map(|side| number(&format!("/penetration/wp_m/{side}"), 1e6));
        let mut pressure = number("/final_pressure_pa", 1e-6);
        let beside = folder.path.join("wp.csv");
        if beside.is_file() {
            let [bottom, top, total, .., last] = Known::read(&Table::read(&beside)?)?;
            let found = [bottom, top, total];
            let near = |(own, found): (&Known, &Known)| {
                let [own, found] = [own.as_run, found.as_run];
                (found - own).abs() <= SAME * found || own.is_nan() && found.is_nan()
            };
            if wp.iter().zip(&found).all(near) {
                wp = found;
                if last.best().is_finite() {
                    pressure = last;
                }
            }
        }
        let state = ParticleFile::open(folder.path.join("final.mpts")).ok();
        let made = state.iter().flat_map(|state| &state.header().provenance);
        let made_of =
            made.flat_map(|made| made.inputs.iter().map(|(_, hash)| format!("{hash:016x}")));
        Ok(Self {
            label: folder.label.clone(),
            made_of: made_of.collect(),
            voxel_doubts: state.map_or(Vec::new(), |state| {
                let doubts = [
                    voxels::doubt_of_file(state.header()),
                    voxels::swapped_in_file(&state),
                ];
                doubts.into_iter().flatten().collect()
            }),
            end,
            setup: Setup::read(&folder.path, &case, &resolved),
            wp,
            pressure,
            limit: pressure_limit(&resolved),
            summary,
            resolved,
        })
    }

    /// Files of a run's folder that a page is made of, as far as they are there.
    pub const FILES: [&str; 4] = ["summary.json", "resolved.toml", "wp.csv", "final.mpts"];

    /// Whether its bond was made from this specimen.
    pub(crate) fn is_of(&self, experiment: &Measured) -> bool {
        experiment
            .content
            .iter()
            .any(|hash| self.made_of.contains(hash))
    }

    /// Whether adhesive came to the end of the specimen.
    pub(crate) fn outer_face_reached(&self) -> bool {
        let reached = self.summary.pointer("/penetration/outer_face_reached");
        reached.and_then(Value::as_bool).unwrap_or(false)
    }

    /// The share of its adhesive that left through open sides.
    pub(crate) fn left(&self) -> f64 {
        let points = ["/points_left", "/liquid_points"].map(|at| self.summary.pointer(at));
        let [left, of] = points.map(|points| points.and_then(Value::as_f64));
        left.unwrap_or(0.0) / of.unwrap_or(f64::INFINITY)
    }

    /// What it says of air that is closed off where the specimen ends.
    pub(crate) fn beyond_sides(&self) -> Option<&str> {
        let mut left_out = self.list("/left_out").iter();
        left_out.find(|item| item["what"] == "beyond the sides")?["why"].as_str()
    }

    /// The share of its adhesive that entered the wood, %, and the mean depth of that, um.
    pub(crate) fn entered(&self) -> [String; 2] {
        [
            self.number("/penetration/entered_share/total", 100.0, 1),
            self.number("/penetration/mean_depth_m/total", 1e6, 2),
        ]
    }

    /// A number of the summary by its path, times `unit`, with so many decimals.
    fn number(&self, pointer: &str, unit: f64, decimals: usize) -> String {
        let value = self.summary.pointer(pointer).unwrap_or(&Value::Null);
        number(value, unit, decimals)
    }

    /// The simulated time in a unit that suits it: runs take from microseconds to hours.
    fn time(&self) -> String {
        let time = self.summary.pointer("/time_s").and_then(Value::as_f64);
        time.map_or("-".into(), |time| {
            let (unit, name) = time_unit(time);
            format!("{:.2} {}", time / unit, name.replace('µ', "u"))
        })
    }

    fn text(&self, pointer: &str) -> String {
        self.summary.pointer(pointer).map_or("-".into(), plain)
    }

    /// Columns of the table of all runs, and its row.
    pub(crate) fn row(&self) -> [(&'static str, String); 10] {
        let sound = match self.end.sound {
            true => "sound",
            false if self.end.end == "not-ended" => "not known",
            false => "not sound",
        };
        let volume = self.number("/invariants/volume_change", 100.0, 3);
        let deepest = self.number("/invariants/deepest_m", 1e6, 3);
        let memory = self.number("/peak_memory_bytes", 1e-6, 0);
        [
            ("run", self.label.clone()),
            ("end", self.end.end.replace('-', " ")),
            ("results", sound.into()),
            ("steps", self.text("/steps")),
            ("simulated", self.time()),
            ("gap left (um)", self.number("/gap_m", 1e6, 2)),
            ("volume change (%)", volume),
            ("deepest point in wood (um)", deepest),
            ("CPU (s)", self.number("/cpu_s", 1.0, 1)),
            ("memory (MB)", memory),
        ]
    }

    fn list(&self, pointer: &str) -> &[Value] {
        let found = self.summary.pointer(pointer).and_then(Value::as_array);
        found.map_or(&[], Vec::as_slice)
    }

    /// Everything that it says, to be opened.
    pub(crate) fn to_html(&self) -> String {
        let mut out = html::details(
            "Parameters, including defaults (resolved.toml)",
            &html::verbatim(&self.resolved),
        );
        out += &html::details("Expected error", &self.expected_error());
        let left_out = rows(self.list("/left_out"), ["what", "why"]);
        let left_out = html::table("Not computed", &["effect", "reason"], &left_out);
        out += &html::details("Effects not modelled", &left_out);
        let mut checks = self.object("/invariants");
        checks.extend(self.object("/counts"));
        let checks = html::table("Last state and counts", &["quantity", "value"], &checks);
        out += &html::details("Invariants", &checks);
        out += &html::details("Cost", &self.cost());
        out + &html::details("Provenance", &self.provenance())
    }

    fn object(&self, pointer: &str) -> Vec<Vec<String>> {
        let found = self.summary.pointer(pointer).and_then(Value::as_object);
        let row = |(name, value): (&String, &Value)| vec![name.replace('_', " "), rounded(value)];
        found.into_iter().flatten().map(row).collect()
    }

    fn expected_error(&self) -> String {
        let Some(expected) = self.summary.get("expected_error") else {
            return "<p>Not recorded: the run has not ended, or an earlier version made it. <code>mpm-run --explain</code> prints it.</p>\n".into();
        };
        let across = self.number("/expected_error/cells_per_lumen", 1.0, 1);
        let Some(cells) = expected.get("measured_with_cells").and_then(Value::as_f64) else {
            return format!(
                "<p>Not measured with this update, shape and options. A lumen of 17.4 um is {across} cells across.</p>\n"
            );
        };
        let list = self.list("/expected_error/errors");
        let mut errors = rows(list, ["quantity", "scene"]);
        for (row, error) in errors.iter_mut().zip(list) {
            row.push(number(&error["relative"], 100.0, 2));
        }
        let others = self.list("/expected_error/not_as_measured");
        let others: Vec<String> = others.iter().map(plain).collect();
        let others = match others.join(", ") {
            none if none.is_empty() => String::new(),
            some => format!(" Measured with the default {some}, unlike this run."),
        };
        let lumens = rows(self.list("/lumens"), ["what", "why"]).into_iter();
        let lumens = lumens.map(|item| format!("<p>{}</p>\n", html::escape(&item.join(": "))));
        html::table(
            "Measured error of this scheme and its options",
            &["quantity", "scene", "about (%)"],
            &errors,
        ) + &lumens.collect::<String>()
            + &format!(
                "<p>A lumen of 17.4 um is {across} cells across here and was {cells} in the measurement, with some walls between nodes. References are finite elements for the slit and finer runs of the implicit scheme for the bond line.{}</p>\n",
                html::escape(&others)
            )
    }

    fn cost(&self) -> String {
        let stepping = self.number("/stepping_wall_s", 1.0, 2);
        let memory = self.number("/peak_memory_bytes", 1e-6, 1);
        let speed = self.number("/particle_steps_per_s", 1.0, 0);
        let facts = [
            ("CPU time (s)", self.number("/cpu_s", 1.0, 2)),
            ("wall time in steps (s)", stepping),
            ("threads", self.text("/threads")),
            ("peak memory (MB)", memory),
            ("material points", self.text("/liquid_points")),
            ("particle-steps per second", speed),
        ];
        let facts = facts.map(|(name, value)| vec![name.to_owned(), value]);
        let list = self.list("/stages");
        let mut stages = rows(list, ["name"]);
        for (row, stage) in stages.iter_mut().zip(list) {
            row.push(number(&stage["wall_s"], 1.0, 3));
        }
        html::table("Whole run", &["quantity", "value"], &facts)
            + &html::table("Stages of a step", &["stage", "wall time (s)"], &stages)
    }

    fn provenance(&self) -> String {
        let command = self.list("/provenance/command");
        let command: Vec<String> = command.iter().map(plain).collect();
        let inputs = rows(self.list("/provenance/inputs"), ["path", "xxh3"]);
        let tool = self.text("/provenance/tool") + " " + &self.text("/provenance/version");
        format!("<p>{}</p>\n", html::escape(&tool))
            + &html::verbatim(&command_line(&command))
            + &html::table("Inputs", &["file", "XXH3-64"], &inputs)
    }
}

/// What was measured of a state that is no run's: WP of the bottom, the top and in total, by `wp-metrics`.
///
/// # Errors
/// An unreadable table, or none of `wp-metrics`.
pub fn measured(file: &Labelled) -> Result<Measured, Error> {
    let table = Table::read(&file.path)?;
    let [bottom, top, total, ..] = Known::read(&table)?;
    let (_, inputs) = figures::record(&file.path).unwrap_or_default();
    Ok(Measured {
        label: file.label.clone(),
        entered: [("entered_share", 100.0, 1), ("mean_depth_um", 1.0, 2)]
            .map(|(column, unit, decimals)| number(&table.in_total(column).into(), unit, decimals)),
        wp: [bottom, top, total],
        content: inputs.into_iter().map(|(_, hash)| hash).collect(),
    })
}

/// A number times `unit`, with so many decimals.
fn number(value: &Value, unit: f64, decimals: usize) -> String {
    let value = value.as_f64();
    value.map_or("-".into(), |x| fixed(x * unit, decimals))
}

/// Some members of each object.
fn rows<const N: usize>(list: &[Value], keys: [&str; N]) -> Vec<Vec<String>> {
    let member = |value: &Value, key: &str| value.get(key).map_or("-".into(), plain);
    let row = |value: &Value| keys.map(|key| member(value, key)).to_vec();
    list.iter().map(row).collect()
}

/// A number to three digits, else as [`plain`].
fn rounded(value: &Value) -> String {
    match value.as_f64().filter(|_| value.is_f64()) {
        Some(number) => html::rounded(number),
        None => plain(value),
    }
}

/// A text without its quotes, else JSON.
fn plain(value: &Value) -> String {
    let text = value.as_str().map(str::to_owned);
    text.unwrap_or_else(|| value.to_string())
}
