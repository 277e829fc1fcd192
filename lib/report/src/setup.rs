//! Specimen, adhesive, press and date of a run, in words.

use std::path::Path;
use std::time::SystemTime;

use particle_file::{Header, ParticleFile};
use toml::{Table, Value};

/// What a run pressed. Runs of the same are told of together.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Setup {
    pub(crate) specimen: String,
    /// What of the specimen a program grew: wood, wood and adhesive, or nothing.
    pub(crate) synthetic: String,
    pub(crate) size: String,
    pub(crate) adhesive: String,
    pub(crate) press: String,
    /// Of the run's summary.
    pub(crate) date: String,
    /// Content of the bond file, and the case but for cells and scheme, where both are known.
    pressed: Option<(u64, Table)>,
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
/// The tool that presses: its inputs are a case and a bond file.
const PRESS: &str = "mpm-run";
/// Keys of one scheme, besides [integrator].
const OF_SCHEMES: [(&str, &str); 2] = [("clamp", "pid"), ("contact", "separation")];

impl Setup {
    /// Of the run in `folder` with this case; what is not known is a dash.
    pub(crate) fn read(folder: &Path, case: &str, text: &str) -> Self {
        let resolved: Table = text.parse().unwrap_or_default();
        let mut setup = Self {
            specimen: "-".into(),
            size: "-".into(),
            adhesive: format!("{case}: {}", adhesive(&resolved)),
            press: press(&resolved),
            date: date(&folder.join("summary.json")).unwrap_or_else(|| "-".into()),
            ..Self::default()
        };
        if let Ok(file) = ParticleFile::open(folder.join("final.mpts")) {
            setup.of_state(&file);
            setup.pressed = pressed(file.header(), text);
        }
        setup
    }

    /// Whether another run is known to be of the same bond and case, whatever its scheme and cells.
    pub(crate) fn is_pressed_as(&self, other: &Self) -> bool {
        self.pressed.is_some() && self.pressed == other.pressed
    }

    fn of_state(&mut self, file: &ParticleFile) {
        let header = file.header();
        let first = header.provenance.first();
        if let Some((path, _)) = first.and_then(|made| made.inputs.first()) {
            let name = Path::new(path).file_name().unwrap_or_default();
            self.specimen = name.to_string_lossy().into_owned();
        }
        self.synthetic = header.attribute("synthetic").unwrap_or_default().to_owned();
        let edges = (0..3).map(|a| 1e6 * (header.box_max_m[a] - header.box_min_m[a]));
        let edges: Vec<String> = edges.map(|edge| format!("{edge:.0}")).collect();
        let voxel = (1e6 * header.voxel_m) as f32;
        self.size = format!("{} um, voxels of {voxel} um", edges.join(" x "));
    }
}

/// What the run pressed that ended with this state, and how, but for cells and scheme.
fn pressed(state: &Header, resolved: &str) -> Option<(u64, Table)> {
    let run = state.provenance.iter().rfind(|made| made.tool == PRESS)?;
    let (_, bond) = run.inputs.get(1)?;
    let cell_m = state.attribute("cell_m")?.parse().ok()?;
    let mut case = metrics::case_without_cells(resolved, cell_m, true)?;
    case.remove("integrator");
    for (table, key) in OF_SCHEMES {
        let table = case.get_mut(table).and_then(Value::as_table_mut);
        table.and_then(|table| table.remove(key));
    }
    Some((*bond, case))
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
    use particle_file::{Draft, Kind, Provenance};

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

    /// Runs with air, stopped early, with another travel or slab are other presses.
    #[test]
    fn the_same_press_has_the_same_bond_and_case_but_cells_and_scheme() {
        let read = |resolved: &str, cell_m: f64, bond: u64| {
            let folder = tempfile::tempdir().unwrap();
            let mut header = Header::new(Kind::State, 1.0, 1, [0.0; 3], [1.0; 3]);
            header.set_attribute("cell_m", cell_m);
            for (tool, inputs) in [
                ("xct2particles", vec![("stack.tif".into(), 1)]),
                (
                    PRESS,
                    vec![("a.toml".into(), 2), ("bond.mpts".into(), bond)],
                ),
            ] {
                header.provenance.push(Provenance {
                    tool: tool.into(),
                    version: String::new(),
                    command: Vec::new(),
                    inputs,
                });
            }
            let mut state = Vec::new();
            Draft::new(header).write_to(&mut state).unwrap();
            std::fs::write(folder.path().join("final.mpts"), state).unwrap();
            Setup::read(folder.path(), "a.toml", resolved)
        };
        let case = "[grid]\ncell = \"2 um\"\n[contact]\ninfluence_length = \"0.01 cell\"\n[clamp]\nstop = \"closed\"\n\
            time_limit = \"4e-5 s\" # default\ntravel = \"1.5e-5 m\" # default\n[integrator]\nscheme = \"implicit\"\n";
        let plain = read(case, 2e-6, 3);
        let other = case
            .replace("2 um", "1 um")
            .replace("0.01", "0.02")
            .replace("4e-5", "5e-5")
            .replace("1.5e-5 m", "15 um")
            .replace("implicit", "explicit")
            + "[output]\nsnapshots = 2\n";
        assert!(read(&other, 1e-6, 3).is_pressed_as(&plain));
        let metres = case.replace("0.01 cell", "20 nm");
        assert!(read(&metres, 2e-6, 3).is_pressed_as(&plain));
        assert!(!read(case, 2e-6, 4).is_pressed_as(&plain));
        assert!(!read(case, 1e-6, 3).is_pressed_as(&plain));
        for (is, was) in [
            ("[integrator]", "[air]\npressure = \"1 bar\"\n[integrator]"),
            ("[integrator]", "[boundary]\nx = \"periodic\"\n[integrator]"),
            ("\"closed\"", "\"0.02 ms\""),
            ("\"4e-5 s\" # default", "\"4e-5 s\""),
            ("1.5e-5", "1.4e-5"),
            (
                "[integrator]",
                "[[clamp.stage]]\ncontact = true\n[integrator]",
            ),
        ] {
            let other = read(&case.replace(is, was), 2e-6, 3);
            assert!(!other.is_pressed_as(&plain), "{was}");
        }
    }

    #[test]
    fn a_day_is_that_of_the_file() {
        let file = tempfile::NamedTempFile::new().unwrap();
        let day = date(file.path()).unwrap();
        assert!(day.len() == 10 && day.starts_with("20"), "{day}");
    }
}
