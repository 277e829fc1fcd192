//! Small scenes and their runs.

use std::cell::Cell;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use particle_file::{BitGrid, Block, Draft, Header, Material, Provenance};
use run::{Mode, PossibleEnd, Request, RunFailure, Summary};
use tempfile::TempDir;

/// A case with cells of `cell`: a plane-strain scene within `corners` (um), or a bond without `corners`. The liquid has
/// 1.3 Pa s; `tables` are the other tables.
pub fn case(cell: &str, corners: Option<[i32; 4]>, tables: &str) -> String {
    let domain = corners.map_or(String::new(), |corners| {
        format!("dimensions = 2\ndomain = {}\n", corners_of(corners))
    });
    format!(
        r#"[grid]
cell = "{cell}"
{domain}[adhesive]
density = "1200 kg/m3"
bulk_modulus = "1 GPa"
viscosity = "1.3 Pa s"
{tables}"#
    )
}

fn corners_of([x, y, to_x, to_y]: [i32; 4]) -> String {
    format!(r#"{{ min = ["{x} um", "{y} um", "0 um"], max = ["{to_x} um", "{to_y} um", "1 um"] }}"#)
}

/// A body of `material`, with further keys, within corners x, y to x, y (um).
pub fn body(material: &str, keys: &str, corners: [i32; 4]) -> String {
    let corners = corners_of(corners);
    format!("[[body]]\nmaterial = \"{material}\"\nbox = {corners}\n{keys}\n")
}

/// A case of a drop `drop` um wide and 10 um high on the lower of two plates in a box `wide` um wide,
/// the upper one `gap` um above it and driven by the clamp; `tables` are those of clamp, integrator and output.
pub fn plates(wide: i32, gap: i32, drop: i32, tables: &str) -> String {
    let top = 6 + gap;
    let tables = [
        "[contact]\nlaw = \"stick\"\n",
        tables,
        "\n",
        &body("rigid", "name = \"bottom\"", [0, 0, wide, 6]),
        &body(
            "rigid",
            "name = \"top\"\nvelocity = \"clamp\"",
            [0, top, wide, top + 22],
        ),
        &body("adhesive", "", [0, 6, drop, 16]),
    ];
    case("2 um", Some([0, 0, wide, 30]), &tables.concat())
}

/// Number of steps that lets a run reach its end.
pub const END: usize = usize::MAX;
pub const PLAIN: Mode = Mode {
    resume: false,
    overwrite: false,
    however_long: false,
};
pub const RESUME: Mode = Mode {
    resume: true,
    ..PLAIN
};
pub const OVERWRITE: Mode = Mode {
    overwrite: true,
    ..PLAIN
};

/// A folder with a case, and with a bond if a test puts `bond.mpts` there.
pub struct Bench(TempDir);

impl Bench {
    pub fn with(case: &str) -> Self {
        let bench = Self(tempfile::tempdir().unwrap());
        bench.write("case.toml", case);
        bench
    }

    /// Liquid between two plates, with some rows of the history and snapshots.
    pub fn new(integrator: &str, stop: &str, every: &str) -> Self {
        let tables = format!(
            r#"[clamp]
closing_speed = "1 m/s"
max_pressure = "2.5 MPa"
travel = "4 um"
stop = "{stop}"
[integrator]
{integrator}
[output]
history_every = "{every}"
snapshots = 3"#
        );
        Self::with(&plates(24, 10, 4, &tables))
    }

    /// About thirty explicit steps.
    pub fn explicit() -> Self {
        Self::new("scheme = \"explicit\"", "0.007 us", "0.001 us")
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    pub fn write(&self, name: &str, content: impl AsRef<[u8]>) {
        fs::write(self.path(name), content).unwrap();
    }

    pub fn bytes(&self, name: &str) -> Vec<u8> {
        fs::read(self.path(name)).unwrap()
    }

    pub fn remove(&self, name: &str) {
        fs::remove_file(self.path(name)).unwrap();
    }

    /// Writes `bond.mpts` with this header: wood below, wood above and adhesive, each from a height (m) along the normal on.
    pub fn put_bond(&self, header: Header, parts: [(f64, BitGrid); 3]) {
        let names = [
            ("wood-bottom", Material::Rigid),
            ("wood-top", Material::Rigid),
            ("adhesive", Material::Adhesive),
        ];
        let (voxel, normal) = (header.voxel_m, usize::from(header.normal));
        let mut draft = Draft::new(header);
        for ((name, material), (low, bits)) in names.into_iter().zip(&parts) {
            let mut origin = [0.0; 3];
            origin[normal] = *low;
            draft = draft.block(Block::new(name, material, origin, voxel, bits), bits);
        }
        let mut bytes = Vec::new();
        draft.write_to(&mut bytes).unwrap();
        self.write("bond.mpts", bytes);
    }

    pub fn read(&self, changes: &[&str]) -> Result<Request, RunFailure> {
        let changes: Vec<String> = changes.iter().map(|change| (*change).to_owned()).collect();
        let bond = self.path("bond.mpts");
        let bond = bond.exists().then_some(bond.as_path());
        Request::read(&self.path("case.toml"), bond, &changes)
    }

    /// The sentence by which the case is refused.
    pub fn refusal(&self, changes: &[&str]) -> String {
        self.read(changes).unwrap_err().to_string()
    }

    /// The plan with single spaces.
    pub fn plan(&self, changes: &[&str]) -> Result<String, RunFailure> {
        let plan = self.read(changes)?.explain()?;
        let words = |line: &str| line.split_whitespace().collect::<Vec<_>>().join(" ");
        Ok(plan.lines().map(|line| words(line) + "\n").collect())
    }

    /// Runs the case into `folder`, stopped after `steps` steps of this process.
    pub fn run(
        &self,
        folder: &str,
        mode: Mode,
        steps: usize,
        changes: &[&str],
    ) -> Result<Option<Summary>, RunFailure> {
        let left = Cell::new(steps);
        let stop = || {
            left.set(left.get() - 1);
            left.get() == 0
        };
        self.run_told(folder, mode, &stop, &mut |_, _| {}, changes)
    }

    pub fn run_told(
        &self,
        folder: &str,
        mode: Mode,
        stop: &dyn Fn() -> bool,
        progress: &mut dyn FnMut(&[PossibleEnd], String),
        changes: &[&str],
    ) -> Result<Option<Summary>, RunFailure> {
        let by = Provenance {
            tool: "mpm-run".into(),
            version: "test".into(),
            ..Provenance::default()
        };
        // With `resume`, a warning says if the run does not continue.
        let warn = |said: String| assert!(mode.resume && said.contains(" starts"), "{said}");
        let request = self.read(changes)?;
        request.execute(&self.path(folder), mode, by, stop, progress, &warn)
    }

    /// A run that must not fail, to its end or stopped before.
    pub fn ran(&self, folder: &str, mode: Mode, steps: usize) -> Summary {
        let ended = self.run(folder, mode, steps, &[]).unwrap();
        ended.expect("a run that has not ended")
    }

    /// Asserts that the run in `run` is refused in these words.
    #[track_caller]
    pub fn refuses(&self, mode: Mode, changes: &[&str], words: &[&str]) {
        let said = self.run("run", mode, END, changes).unwrap_err();
        has(&said.to_string(), words);
    }

    /// A column of the history of the run in `run`.
    pub fn column(&self, name: &str) -> Vec<String> {
        let text = fs::read_to_string(self.path("run/history.csv")).unwrap();
        let header = text.lines().next().unwrap();
        let place = header.split(',').position(|own| own == name).expect(name);
        let rows = text.lines().skip(1);
        rows.map(|row| row.split(',').nth(place).unwrap().to_owned())
            .collect()
    }

    pub fn numbers(&self, name: &str) -> Vec<f64> {
        let text = self.column(name);
        text.iter().map(|number| number.parse().unwrap()).collect()
    }

    /// All entries of the run folder `run` by name.
    pub fn everything(&self) -> BTreeMap<String, Vec<u8>> {
        everything(&self.path("run"))
    }
}

#[track_caller]
pub fn has(text: &str, parts: &[&str]) {
    for part in parts {
        assert!(text.contains(part), "'{part}' is not in\n{text}");
    }
}

/// The files of a run folder by name, without the summary, which holds the cost of the run.
pub fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut files = everything(folder);
    files.remove("summary.json");
    files
}

/// All files below a folder by name.
pub fn everything(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut files = BTreeMap::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_str().unwrap().to_owned();
        if path.is_dir() {
            let below = everything(&path).into_iter();
            files.extend(below.map(|(file, bytes)| (format!("{name}/{file}"), bytes)));
        } else {
            files.insert(name, fs::read(&path).unwrap());
        }
    }
    files
}
