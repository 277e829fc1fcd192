//! Specimen, adhesive, press and date of a run, in words.

use std::path::Path;
use std::time::SystemTime;

use particle_file::ParticleFile;
use toml::{Table, Value};

/// What a run pressed. Runs of the same are told of together.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Setup {
    pub(crate) specimen: String,
    /// Whether a program grew the specimen.
    pub(crate) synthetic: bool,
    pub(crate) size: String,
    pub(crate) adhesive: String,
    pub(crate) press: String,
    /// Of the run's summary.
    pub(crate) date: String,
    /// Of the specimen's file.
    hash: Option<u64>,
    /// Adhesive and contact, as the case has them.
    tables: [Option<Value>; 2],
}

/// Laws of viscosity, and effects, by their tables in a case.
const LAWS: [(&str, &str); 4] = [
    ("power_law", "power law"),
    ("cross", "Cross law"),
    ("carreau_yasuda", "Carreau-Yasuda law"),
    ("herschel_bulkley", "Herschel-Bulkley law"),
];
const EFFECTS: [(&str, &str); 3] = [
    ("cure", "cures"),
    ("water", "loses water"),
    ("surface_tension", "menisci"),
];
/// The tool that grows specimens, and what marks its record beside one.
const GROWN: &str = "\"tool\": \"synth-xct\"";

impl Setup {
    /// Of the run in `folder` with this case; what is not known is a dash.
    pub(crate) fn read(folder: &Path, case: &str, resolved: &str) -> Self {
        let resolved: Table = resolved.parse().unwrap_or_default();
        let mut setup = Self {
            specimen: "-".into(),
            size: "-".into(),
            adhesive: format!("{case}: {}", adhesive(&resolved)),
            press: press(&resolved),
            date: date(&folder.join("summary.json")).unwrap_or_else(|| "-".into()),
            tables: ["adhesive", "contact"].map(|table| resolved.get(table).cloned()),
            ..Self::default()
        };
        if let Ok(file) = ParticleFile::open(folder.join("final.mpts")) {
            setup.of_state(&file);
        }
        setup
    }

    /// Whether another run is known to press the same specimen with the same adhesive, whatever its scheme and cells.
    pub(crate) fn is_pressed_as<'a>(&'a self, other: &'a Self) -> bool {
        let of = |setup: &'a Self| (setup.hash, &setup.press, &setup.tables);
        self.hash.is_some() && of(self) == of(other)
    }

    fn of_state(&mut self, file: &ParticleFile) {
        let header = file.header();
        let first = header.provenance.first();
        if let Some((path, hash)) = first.and_then(|made| made.inputs.first()) {
            self.hash = Some(*hash);
            let name = Path::new(path).file_name().unwrap_or_default();
            self.specimen = name.to_string_lossy().into_owned();
            let record = std::fs::read_to_string(format!("{path}.provenance.json"));
            self.synthetic = record.is_ok_and(|record| record.contains(GROWN));
        }
        let edges = (0..3).map(|a| 1e6 * (header.box_max_m[a] - header.box_min_m[a]));
        let edges: Vec<String> = edges.map(|edge| format!("{edge:.0}")).collect();
        let voxel = (1e6 * header.voxel_m) as f32;
        self.size = format!("{} um, voxels of {voxel} um", edges.join(" x "));
    }
}

/// A text of a table of the case.
fn text<'a>(case: &'a Table, table: &str, key: &str) -> Option<&'a str> {
    case.get(table)?.get(key)?.as_str()
}

fn adhesive(case: &Table) -> String {
    let table = case.get("adhesive");
    let has = |key: &str| table.is_some_and(|table| table.get(key).is_some());
    let law = LAWS.iter().find(|(key, _)| has(key)).map(|(_, name)| *name);
    let mut said = match (text(case, "adhesive", "viscosity"), law) {
        (_, Some(law)) => law.to_owned(),
        (Some(viscosity), None) => viscosity.to_owned(),
        (None, None) => "viscosity by a table".to_owned(),
    };
    for (_, effect) in EFFECTS.iter().filter(|(key, _)| has(key)) {
        said += &format!(", {effect}");
    }
    if let Some(walls) = text(case, "contact", "law") {
        said += &format!("; walls: {walls}");
    }
    said
}

fn press(case: &Table) -> String {
    let stages = case.get("clamp").and_then(|clamp| clamp.get("stage"));
    if let Some(stages) = stages.and_then(Value::as_array) {
        let stage = |stage: &Value| {
            let values = ["kind", "speed", "pressure", "time"];
            let words = values.iter().filter_map(|key| stage.get(*key)?.as_str());
            words.collect::<Vec<_>>().join(" ")
        };
        return stages.iter().map(stage).collect::<Vec<_>>().join(", ");
    }
    let value = |key| text(case, "clamp", key);
    match (value("closing_speed"), value("max_pressure")) {
        (Some(speed), Some(limit)) => format!("{speed}, at most {limit}"),
        (Some(speed), None) => format!("{speed}, no pressure limit"),
        _ => "-".into(),
    }
}

/// The day that a file was written, UTC.
fn date(file: &Path) -> Option<String> {
    let written = file.metadata().ok()?.modified().ok()?;
    let text = humantime::format_rfc3339_seconds(written.max(SystemTime::UNIX_EPOCH)).to_string();
    text.split_once('T').map(|(day, _)| day.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_case_is_told_in_words() {
        let read = |text: &str| Setup::read(Path::new("/nowhere"), "a.toml", text);
        let plain = read(
            "[adhesive]\nviscosity = \"1300 cP\"\n[contact]\nlaw = \"partial-slip\"\n[clamp]\nclosing_speed = \"1 m/s\"\nmax_pressure = \"2.5 MPa\"\n",
        );
        assert_eq!(plain.adhesive, "a.toml: 1300 cP; walls: partial-slip");
        assert_eq!(plain.press, "1 m/s, at most 2.5 MPa");
        assert_eq!((plain.specimen.as_str(), plain.date.as_str()), ("-", "-"));
        let programme = read(
            "[adhesive.cross]\nn = 1\n[adhesive.cure]\nn = 1\n[[clamp.stage]]\nkind = \"ramp\"\npressure = \"1 MPa\"\ntime = \"2 s\"\n[[clamp.stage]]\nkind = \"hold\"\ntime = \"5 min\"\n",
        );
        assert_eq!(programme.adhesive, "a.toml: Cross law, cures");
        assert_eq!(programme.press, "ramp 1 MPa 2 s, hold 5 min");
        assert_eq!(read("not TOML").press, "-");
    }

    #[test]
    fn a_day_is_that_of_the_file() {
        let file = tempfile::NamedTempFile::new().unwrap();
        let day = date(file.path()).unwrap();
        assert!(day.len() == 10 && day.starts_with("20"), "{day}");
    }
}
