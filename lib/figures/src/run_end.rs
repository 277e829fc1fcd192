//! How the run of a file ended, as the summary of its folder has it.

use std::fs::File;
use std::io::{self, ErrorKind, Read};
use std::path::{Path, PathBuf};

use particle_file::RUN_MARK;
use serde_json::Value;

use crate::closing::time_unit;
use crate::command_line::{self, again, of_make};
use crate::{Error, Labelled};

const SUMMARY: &str = "summary.json";
const RESOLVED: &str = "resolved.toml";
const MOST_BYTES: u64 = 1 << 20;
/// Share of the gap below which a press is closed.
const CLOSED: f64 = 1e-3;

/// How a run ended.
#[derive(Clone, Debug, PartialEq)]
pub struct RunEnd {
    /// `closed`, `time-limit` and others, as `summary.json` has them; `not-ended` where there is none.
    pub end: String,
    /// Whether the run found nothing against its results.
    pub sound: bool,
    /// What it found.
    pub reasons: Vec<String>,
    /// Way left until the bond is closed, m; NaN where that is not known.
    pub gap_m: f64,
    /// The same over the whole way.
    pub gap_share: f64,
    /// The stage of a programme that closed the bond, and the pressure then, of a programme that would have pressed on.
    closed_in: Option<String>,
    /// The smallest that it was at the end of a stage, of a programme that ended with a release.
    held_share: Option<f64>,
    /// Total WP before that release, um; NaN where the run did not measure it.
    pub(crate) held_wp_um: Option<f64>,
    /// Effect of a longer press, behind a semicolon.
    outlook: String,
    /// A time limit that would do, s.
    time_limit_s: Option<f64>,
    command: Vec<String>,
}

impl RunEnd {
    /// The end of the run whose folder `file` lies in; none for a file elsewhere.
    ///
    /// # Errors
    /// [`Error::Data`] for a summary that cannot be read.
    pub fn beside(file: &Path) -> Result<Option<Self>, Error> {
        let Some([path, _]) = read_beside(file) else {
            return Ok(None);
        };
        let folder = path.parent().unwrap_or(Path::new(""));
        Self::in_folder(folder).map(|(end, _)| Some(end))
    }

    /// The end of the run in `folder`, and its summary; null where there is none yet.
    ///
    /// # Errors
    /// [`Error::Data`] for a summary that cannot be read.
    pub fn in_folder(folder: &Path) -> Result<(Self, Value), Error> {
        let path = folder.join(SUMMARY);
        let summary: Value = match small_text(&path) {
            Err(e) if e.kind() == ErrorKind::NotFound => Value::Null,
            read => {
                let summary = read.and_then(|text| serde_json::from_str(&text).map_err(Into::into));
                summary
                    .map_err(|e| Error::Data(format!("cannot read '{}': {e}", path.display())))?
            }
        };
        let mut end = Self::of(&summary);
        if summary.is_null() {
            end.command = command_line::of_states(folder).unwrap_or_default();
        }
        Ok((end, summary))
    }

    /// The end that a summary tells of; of no summary, that there is none yet.
    fn of(summary: &Value) -> Self {
        let number = |key| summary.get(key).and_then(Value::as_f64).unwrap_or(f64::NAN);
        let texts = |pointer: &str| -> Vec<String> {
            let found = summary.pointer(pointer).and_then(Value::as_array);
            let texts = found.into_iter().flatten().filter_map(Value::as_str);
            texts.map(str::to_owned).collect()
        };
        let sound = summary.pointer("/verdict/sound").and_then(Value::as_bool);
        let end = summary.get("end").and_then(Value::as_str);
        // It goes into tables that people open in spreadsheets.
        let plain = |c: char| c.is_ascii_lowercase() || c == '-' || c == '_';
        let end = end.filter(|end| {
            end.starts_with(|c: char| c.is_ascii_lowercase()) && end.chars().all(plain)
        });
        let gap_m = number("gap_m");
        let way_m = gap_m + number("travel_m");
        let stages = summary.get("programme").and_then(Value::as_array);
        let stages = stages.map_or(&[][..], Vec::as_slice);
        let closed = stages
            .iter()
            .position(|stage| stage["closed_below"] == true);
        let closed_in = closed.map(|at| {
            let pressure = 1e-6 * stages[at]["pressure_pa"].as_f64().unwrap_or(f64::NAN);
            let kind = stages[at]["kind"].as_str().unwrap_or_default();
            let stage = at + 1;
            format!(
                "closed in stage {stage} ({kind}) at {pressure:.3} MPa, below the pressure of the stage"
            )
        });
        let released = stages.last().is_some_and(|last| last["kind"] == "release");
        let held = stages.iter().rfind(|stage| stage["kind"] != "release");
        let held_wp = held.and_then(|stage| stage["wp_m"].as_f64());
        let travels = stages.iter().filter_map(|stage| stage["travel_m"].as_f64());
        let outlook = summary.pointer("/outlook/said").and_then(Value::as_str);
        Self {
            end: end.unwrap_or("not-ended").replace('_', "-"),
            sound: sound.unwrap_or(false),
            reasons: texts("/verdict/reasons"),
            gap_m,
            gap_share: gap_m / way_m,
            closed_in,
            held_share: released.then(|| 1.0 - travels.fold(f64::NAN, f64::max) / way_m),
            held_wp_um: released.then(|| 1e6 * held_wp.unwrap_or(f64::NAN)),
            outlook: outlook.map_or(String::new(), |said| format!("; {said}")),
            time_limit_s: (summary.pointer("/outlook/time_limit_s")).and_then(Value::as_f64),
            command: texts("/provenance/command"),
        }
    }

    /// Whether it leaves another share of the gap than `other`.
    pub(crate) fn is_apart(&self, other: &Self) -> bool {
        (self.gap_share - other.gap_share).abs() > CLOSED
    }

    /// What keeps its results from being those of a closed bond, in a few words.
    pub fn mark(&self) -> Option<String> {
        let open = self.gap_share > CLOSED;
        let held = (self.held_share).filter(|held| self.gap_share - held > CLOSED);
        match self.end.as_str() {
            "not-ended" | "interrupted" => Some("not ended".into()),
            "failed" => Some("failed".into()),
            _ if !self.sound => Some("not sound".into()),
            _ if open => {
                let gap = percent(self.gap_share);
                Some(match held {
                    None => format!("not closed, {gap} of the gap left"),
                    Some(held) if held > CLOSED => {
                        let held = percent(held);
                        format!("not closed, {held} of the gap left, {gap} after the release")
                    }
                    Some(_) => format!("opened by the release, {gap} of the gap left"),
                })
            }
            "time-limit" => Some("not closed".into()),
            _ => None,
        }
    }

    /// Which WP it has, of a programme that ended with a release.
    pub fn released(&self) -> Option<String> {
        let before = match self.held_wp_um? {
            wp if wp.is_finite() => format!(", in total {wp:.2} um before it"),
            _ => String::new(),
        };
        Some(format!("WP is after the release{before}"))
    }

    /// Of a press programme that closed the bond before its pressure: when.
    pub fn closed_in(&self) -> Option<&str> {
        self.closed_in.as_deref()
    }

    /// What to do about the mark, in sentences; none where there is nothing to do.
    pub fn advice(&self) -> Option<String> {
        let mark = self.mark()?;
        let open = format!("{mark} ({:.2} um)", 1e6 * self.gap_m);
        let ahead = &self.outlook;
        Some(match self.end.as_str() {
            "not-ended" | "interrupted" => {
                let command = again(&self.command, "--resume", None);
                format!("{mark}: mpm-run --resume continues it{command}")
            }
            end if end == "failed" || !self.sound => mark + ": " + &self.reasons.join("; ") + ahead,
            "time-limit" => {
                let said = format!("{open}: the penetration is that of an unfinished press{ahead}");
                let Some(limit_s) = self.time_limit_s else {
                    return Some(said);
                };
                let limit = format!("clamp.time_limit={}", time(limit_s));
                let command = again(&self.command, "--overwrite", Some(&limit));
                let make = of_make(&self.command, &limit);
                format!("{said}. For a longer press: --set \"{limit}\" ({make}){command}")
            }
            end => format!("{open} when the run ended ({end}){ahead}"),
        })
    }
}

/// What is read of the run whose folder `file` lies in: its summary and its case.
pub fn read_beside(file: &Path) -> Option<[PathBuf; 2]> {
    let folder = file.parent()?;
    let read = || [SUMMARY, RESOLVED].map(|name| folder.join(name));
    folder.join(RUN_MARK).is_file().then(read)
}

/// The case of the run whose folder `file` lies in, as it was run; nothing where it is not known.
pub(crate) fn case_beside(file: &Path) -> String {
    let read = |[_, case]: [PathBuf; 2]| small_text(&case).ok();
    read_beside(file).and_then(read).unwrap_or_default()
}

/// The text of a record, of 1 MiB at most.
pub(crate) fn small_text(path: &Path) -> io::Result<String> {
    let mut text = String::new();
    let file = File::open(path)?;
    file.take(MOST_BYTES).read_to_string(&mut text)?;
    Ok(text)
}

impl Labelled {
    /// The same with what there is to say against the run of its folder behind its label.
    ///
    /// # Errors
    /// As of [`RunEnd::beside`].
    pub fn marked(mut self) -> Result<Self, Error> {
        if let Some(mark) = RunEnd::beside(&self.path)?.and_then(|end| end.mark()) {
            self.label += &format!(" ({mark})");
        }
        Ok(self)
    }
}

fn percent(share: f64) -> String {
    let percent = 100.0 * share;
    let digits = usize::from(percent < 1.0);
    format!("{percent:.digits$} %")
}

/// A time as a case takes it, rounded up to one digit.
fn time(seconds: f64) -> String {
    let (unit, name) = time_unit(seconds);
    let count = seconds / unit;
    let digit = 10_f64.powf(count.log10().floor());
    let count = ((count / digit - 1e-9).ceil() * digit).round();
    format!("{count} {}", name.replace('µ', "u"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn summary(end: &str, gap_m: f64) -> Value {
        serde_json::json!({
            "end": end, "verdict": { "sound": true, "reasons": [] }, "gap_m": gap_m,
            "travel_m": 1e-5 - gap_m, "time_s": 7.5e-5,
            "outlook": { "said": "the last 4.20 um take 18 us more", "time_limit_s": 2.26e-4 },
            "provenance": { "command": ["bin/mpm-run", "a case.toml", "--resume", "-o", "run"] },
        })
    }

    #[test]
    fn a_press_that_did_not_close_is_marked_with_what_goes_on() {
        let end = RunEnd::of(&summary("time-limit", 4.2e-6));
        assert_eq!(end.mark().unwrap(), "not closed, 42 % of the gap left");
        let advice = end.advice().unwrap();
        let command = "(make as before with SET='clamp.time_limit=300 us'):\n    bin/mpm-run 'a case.toml' -o run --overwrite --set 'clamp.time_limit=300 us'";
        assert!(advice.ends_with(command), "{advice}");
        assert!(advice.contains("(4.20 um)"), "{advice}");
        assert!(
            advice.contains("; the last 4.20 um take 18 us more."),
            "{advice}"
        );
        let mut full = summary("time-limit", 4.2e-6);
        full["outlook"] = serde_json::json!({ "said": "every lumen is full" });
        let advice = RunEnd::of(&full).advice().unwrap();
        assert!(advice.ends_with("press; every lumen is full"), "{advice}");
        for closed in ["closed", "time"] {
            assert_eq!(RunEnd::of(&summary(closed, 0.0)).mark(), None);
        }
        let nearly = RunEnd::of(&summary("set", 2e-8));
        assert_eq!(nearly.mark().unwrap(), "not closed, 0.2 % of the gap left");
        let set = RunEnd::of(&summary("set", 1e-6));
        assert_eq!(set.mark().unwrap(), "not closed, 10 % of the gap left");
        assert!(!set.advice().unwrap().contains("--set"));
        let mut told = summary("closed", 0.0);
        told["verdict"]["sound"] = false.into();
        assert_eq!(RunEnd::of(&told).mark().unwrap(), "not sound");
    }

    /// Air that was pressed pushes a bond line open again, which was closed until then.
    #[test]
    fn a_press_that_its_release_opened_says_so() {
        let mark = |held_um: f64, gap_m: f64, last: &str| {
            let mut told = summary("programme", gap_m);
            told["programme"] = serde_json::json!([
                { "kind": "hold", "travel_m": 1e-6 * held_um, "wp_m": 7e-6, "closed_below": true, "pressure_pa": 1e4 },
                { "kind": last, "travel_m": 1e-5 - gap_m },
            ]);
            let end = RunEnd::of(&told);
            let released = "WP is after the release, in total 7.00 um before it";
            let closed = "closed in stage 1 (hold) at 0.010 MPa, below the pressure of the stage";
            assert_eq!(end.closed_in(), Some(closed));
            assert_eq!(end.released(), (last == "release").then(|| released.into()));
            end.mark()
        };
        for (held_um, gap_m, last, said) in [
            (
                10.0,
                3.5e-6,
                "release",
                "opened by the release, 35 % of the gap left",
            ),
            (
                8.0,
                9.9e-6,
                "release",
                "not closed, 20 % of the gap left, 99 % after the release",
            ),
            (8.0, 2e-6, "release", "not closed, 20 % of the gap left"),
            (8.0, 2e-6, "hold", "not closed, 20 % of the gap left"),
        ] {
            assert_eq!(mark(held_um, gap_m, last).unwrap(), said);
        }
        assert_eq!(mark(10.0, 0.0, "release"), None);
    }

    #[test]
    fn times_are_rounded_up_to_a_digit() {
        let rounded = [2.26e-4, 9.1e-4, 0.03, 900.1].map(time);
        assert_eq!(rounded, ["300 us", "1000 us", "30 ms", "1000 s"]);
    }

    #[test]
    fn only_files_in_run_folders_are_marked() {
        let folder = tempfile::tempdir().unwrap();
        let write =
            |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
        let file = folder.path().join("wp.csv");
        write(SUMMARY, &summary("time-limit", 4.2e-6).to_string());
        assert_eq!(RunEnd::beside(&file).unwrap(), None);
        write(RUN_MARK, "");
        let label = "FLIP".to_owned();
        let path = file.clone();
        let marked = Labelled { label, path }.marked().unwrap();
        assert_eq!(marked.label, "FLIP (not closed, 42 % of the gap left)");
        write(SUMMARY, "{");
        assert!(RunEnd::beside(&file).is_err());
    }
}
