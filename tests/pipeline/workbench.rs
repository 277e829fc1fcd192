//! A folder with a small hand-made specimen, and the tools to work on it.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use particle_file::ParticleFile;
use studies::outputs;
use tempfile::TempDir;

pub const TOOLS: [&str; 10] = [
    "xct2particles",
    "build-bondline",
    "mpm-run",
    "wp-metrics",
    "shear-stats",
    "synth-xct",
    "bond-figures",
    "bond-report",
    "particles",
    "bond-sweep",
];

/// Voxel edge of every specimen here.
pub const VOXEL: &str = "1.45um";

pub const VOID: u8 = 0;
pub const WOOD: u8 = 128;
pub const ADHESIVE: u8 = 255;

/// The case of a small bond line, of a few hundred steps.
pub const CASE: &str = include_str!("../press.toml");

pub const IMPLICIT: &str = "integrator.scheme=implicit";

/// Cells of one voxel for the small bond line.
pub const FINER: &str = "--set grid.cell=1.45um --set contact.influence_length=0.029um";

/// The update rules and schemes of the six runs and their counterparts, as `--set` values.
pub const METHODS: [&[&str]; 3] = [
    &["integrator.velocity_update=flip"],
    &["integrator.velocity_update=xpic", "integrator.order=5"],
    &[IMPLICIT, "integrator.cfl=0.25"],
];

/// The top of the repository.
pub fn root() -> PathBuf {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    root.canonicalize().unwrap()
}

/// What a tool said on standard error.
pub fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// A folder for one test.
pub struct Workbench(TempDir);

impl Workbench {
    pub fn new() -> Self {
        for tool in TOOLS {
            let built = outputs::bin_folder().join(tool).is_file();
            assert!(
                built,
                "{tool}: cargo build --release --workspace comes first"
            );
        }
        Self(TempDir::new().unwrap())
    }

    /// The stack `specimen.npy`, the files `specimen.mpts` and `bond.mpts` and `case.toml`.
    pub fn with_bond() -> Self {
        let bench = Self::new();
        bench.write("case.toml", CASE);
        bench.write("specimen.npy", npy([16, 32, 16], grooved));
        bench.convert("specimen.npy", "specimen.mpts");
        bench.done("build-bondline -q specimen.mpts -o bond.mpts");
        bench
    }

    /// `bond.mpts` of a synthetic specimen of such an adhesive, size, slab and seed, `case.toml` with this text and the
    /// repository's `pipelines`.
    pub fn with_wood(options: &str, case: impl AsRef<[u8]>) -> Self {
        let bench = Self::new();
        bench.write("case.toml", case);
        std::os::unix::fs::symlink(root().join("pipelines"), bench.path("pipelines")).unwrap();
        bench.grow(options, "bond.mpts");
        bench
    }

    /// The bond of another synthetic specimen.
    pub fn grow(&self, options: &str, bond: &str) {
        self.done(&format!(
            "synth-xct -q --voxel {VOXEL} {options} -o - | xct2particles -q - -o - | build-bondline -q - -o {bond}"
        ));
    }

    pub fn folder(&self) -> &Path {
        self.0.path()
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.folder().join(name)
    }

    /// Names in a folder, in order.
    pub fn names(&self, folder: &str) -> Vec<String> {
        let mut names: Vec<_> = (fs::read_dir(self.path(folder)).unwrap())
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    }

    pub fn write(&self, name: &str, content: impl AsRef<[u8]>) {
        fs::write(self.path(name), content).unwrap();
    }

    pub fn read(&self, name: &str) -> Vec<u8> {
        fs::read(self.path(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
    }

    pub fn text(&self, name: &str) -> String {
        String::from_utf8(self.read(name)).unwrap()
    }

    pub fn table(&self, name: &str) -> Table {
        Table::new(&self.text(name))
    }

    /// The table that wp-metrics prints: bottom, top and total.
    pub fn measured(&self, files: &str) -> Table {
        Table::new(&self.done(&format!("wp-metrics -q {files}")))
    }

    /// A number of the summary of a run.
    pub fn summary(&self, run: &str, key: &str) -> f64 {
        let folder = self.path(run);
        outputs::Run { folder }.summary(key).expect(key)
    }

    /// Copies a file with one bit changed, `from_end` bytes before its end.
    pub fn damage(&self, from: &str, to: &str, from_end: usize) {
        let mut bytes = self.read(from);
        let at = bytes.len() - from_end;
        bytes[at] ^= 4;
        self.write(to, bytes);
    }

    /// A tool with arguments that are not words of a shell, inside the folder.
    pub fn tool(&self, name: &str) -> Command {
        let mut command = Command::new(outputs::bin_folder().join(name));
        command.current_dir(self.folder()).stdin(Stdio::null());
        command
    }

    /// A line of bash inside the folder, with the tools on its path.
    pub fn command(&self, line: &str) -> Command {
        let path = std::env::var_os("PATH").unwrap_or_default();
        let folders = [outputs::bin_folder()].into_iter();
        let folders = folders.chain(std::env::split_paths(&path));
        let mut command = Command::new("bash");
        command
            .args(["-c", &format!("set -euo pipefail; {line}")])
            .env("PATH", std::env::join_paths(folders).unwrap())
            .current_dir(self.folder())
            .stdin(Stdio::null());
        command
    }

    pub fn shell(&self, line: &str) -> Output {
        self.command(line).output().unwrap()
    }

    /// A line that must end with this status, say this and not panic; all that it said.
    pub fn ends(&self, status: i32, line: &str, sentence: &str) -> String {
        let output = self.shell(line);
        let said = said(&output);
        assert_eq!(output.status.code(), Some(status), "{line}: {said}");
        assert!(said.contains(sentence), "{line}: {said}");
        assert!(!said.contains("panicked"), "{line}: {said}");
        said
    }

    /// A line that must succeed; its standard output.
    pub fn done(&self, line: &str) -> String {
        let output = self.shell(line);
        assert!(output.status.success(), "{line}: {}", said(&output));
        String::from_utf8(output.stdout).unwrap()
    }

    pub fn convert(&self, stack: &str, specimen: &str) {
        self.done(&format!(
            "xct2particles -q {stack} --voxel {VOXEL} -o {specimen}"
        ));
    }

    /// Runs `case.toml` on `bond.mpts` into `folder`.
    pub fn press(&self, folder: &str, changes: &[&str], more: &str) {
        self.done(&press(folder, changes, more));
    }

    /// Order-free sum of the points in a particle file.
    pub fn sum(&self, file: &str) -> String {
        self.done(&format!("particles sum '{file}' | cut -d ' ' -f 1"))
    }

    pub fn particles(&self, file: &str) -> ParticleFile {
        ParticleFile::open(self.path(file)).unwrap()
    }
}

/// The line that runs `case.toml`, changed by `--set`, on `bond.mpts` into `folder`.
pub fn press(folder: &str, changes: &[&str], more: &str) -> String {
    let sets: String = changes.iter().map(|c| format!(" --set '{c}'")).collect();
    format!("mpm-run -q case.toml --particles bond.mpts -o {folder}{sets} {more}")
}

/// A CSV table, its cells apart.
#[derive(Debug)]
pub struct Table {
    pub header: Vec<String>,
    pub rows: Vec<Vec<String>>,
}

impl Table {
    pub fn new(text: &str) -> Self {
        let mut lines = text
            .lines()
            .map(|line| line.split(',').map(str::to_owned).collect());
        let header = lines.next().unwrap();
        Self {
            header,
            rows: lines.collect(),
        }
    }

    /// The numbers of a column.
    pub fn column(&self, name: &str) -> Vec<f64> {
        let found = self.header.iter().position(|column| column == name);
        let at = found.unwrap_or_else(|| panic!("{name} is not in {:?}", self.header));
        self.rows
            .iter()
            .map(|row| row[at].parse().unwrap())
            .collect()
    }

    /// The last number of a column: of both sides together where there are sides.
    pub fn last(&self, name: &str) -> f64 {
        *self.column(name).last().unwrap()
    }
}

/// Wood with grooves along z, some open to the bond line, and a layer of adhesive of four
/// voxels in the middle of 32 rows.
pub fn grooved(x: usize, y: usize, z: usize) -> u8 {
    let open_below = (2..6).contains(&x) && (6..16).contains(&y);
    let open_above = (9..13).contains(&x) && (16..28).contains(&y) && (4..12).contains(&z);
    let closed = (8..12).contains(&x) && (3..9).contains(&y);
    match y {
        14..18 => ADHESIVE,
        _ if open_below || open_above || closed => VOID,
        _ => WOOD,
    }
}

/// The header of an `.npy` file of unsigned bytes; `dims` is (x, y, z).
pub fn npy_header([nx, ny, nz]: [usize; 3], fortran: &str) -> Vec<u8> {
    let header =
        format!("{{'descr': '|u1', 'fortran_order': {fortran}, 'shape': ({nz}, {ny}, {nx}), }}");
    let padded = format!("{header:<117}\n");
    let length = (padded.len() as u16).to_le_bytes();
    [b"\x93NUMPY\x01\x00", &length[..], padded.as_bytes()].concat()
}

/// A stack as an `.npy` file.
pub fn npy(dims: [usize; 3], label: impl Fn(usize, usize, usize) -> u8) -> Vec<u8> {
    let [nx, ny, nz] = dims;
    let mut bytes = npy_header(dims, "False");
    for z in 0..nz {
        for y in 0..ny {
            bytes.extend((0..nx).map(|x| label(x, y, z)));
        }
    }
    bytes
}
