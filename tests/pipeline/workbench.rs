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
pub const VOXEL: &str = "1.45 um";

pub const VOID: u8 = 0;
pub const WOOD: u8 = 128;
pub const ADHESIVE: u8 = 255;

/// The case of a small bond line, of a few hundred steps.
pub const CASE: &str = include_str!("../press.toml");

/// The update rules and schemes of the six runs and their counterparts, as `--set` values.
pub const METHODS: [&[&str]; 3] = [
    &["integrator.velocity_update=flip"],
    &["integrator.velocity_update=xpic", "integrator.order=5"],
    &["integrator.scheme=implicit", "integrator.cfl=0.25"],
];

/// A built tool.
pub fn tool(name: &str) -> Command {
    let path = outputs::bin_folder().join(name);
    assert!(
        path.is_file(),
        "{} is missing: build the tools first with `cargo build --release --workspace`",
        path.display()
    );
    Command::new(path)
}

/// What a tool said on standard error.
pub fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// A folder for one test.
pub struct Workbench(TempDir);

impl Workbench {
    pub fn new() -> Self {
        Self(TempDir::new().unwrap())
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

    /// Runs a tool inside the folder.
    pub fn run(&self, name: &str, arguments: &[&str]) -> Output {
        self.command(name, arguments).output().unwrap()
    }

    pub fn command(&self, name: &str, arguments: &[&str]) -> Command {
        let mut command = tool(name);
        command
            .args(arguments)
            .current_dir(self.folder())
            .stdin(Stdio::null());
        command
    }

    /// Runs a tool that must succeed; its standard output.
    pub fn done(&self, name: &str, arguments: &[&str]) -> String {
        let output = self.run(name, arguments);
        assert!(
            output.status.success(),
            "{name} {arguments:?}: {}",
            said(&output)
        );
        String::from_utf8(output.stdout).unwrap()
    }

    /// A shell line inside the folder with the tools on the path.
    pub fn shell(&self, line: &str) -> Output {
        self.shell_command(line).output().unwrap()
    }

    /// A line of bash with the tools on its path.
    pub fn shell_command(&self, line: &str) -> Command {
        let path = std::env::var_os("PATH").unwrap_or_default();
        let folders = [outputs::bin_folder()]
            .into_iter()
            .chain(std::env::split_paths(&path));
        let mut command = Command::new("bash");
        command
            .args(["-c", &format!("set -euo pipefail; {line}")])
            .env("PATH", std::env::join_paths(folders).unwrap())
            .current_dir(self.folder())
            .stdin(Stdio::null());
        command
    }

    /// The stack `specimen.npy`, the files `specimen.mpts` and `bond.mpts` and `case.toml`.
    pub fn with_bond() -> Self {
        let bench = Self::new();
        bench.write("case.toml", CASE);
        bench.write("specimen.npy", npy([16, 32, 16], grooved));
        bench.convert("specimen.npy", "specimen.mpts");
        bench.done(
            "build-bondline",
            &["-q", "specimen.mpts", "-o", "bond.mpts"],
        );
        bench
    }

    pub fn convert(&self, stack: &str, specimen: &str) {
        self.done(
            "xct2particles",
            &["-q", stack, "--voxel", VOXEL, "-o", specimen],
        );
    }

    /// Runs `case.toml` on `bond.mpts` into `folder`.
    pub fn press(&self, folder: &str, changes: &[&str], more: &[&str]) -> Output {
        self.run("mpm-run", &press_arguments(folder, changes, more))
    }

    pub fn pressed(&self, folder: &str, changes: &[&str], more: &[&str]) {
        let output = self.press(folder, changes, more);
        assert!(output.status.success(), "{changes:?}: {}", said(&output));
    }

    /// Order-free sum of the points in a particle file.
    pub fn sum(&self, file: &str) -> String {
        let line = self.done("particles", &["sum", file]);
        line.split_whitespace().next().unwrap().to_owned()
    }

    pub fn particles(&self, file: &str) -> ParticleFile {
        ParticleFile::open(self.path(file)).unwrap()
    }
}

pub fn press_arguments<'a>(folder: &'a str, changes: &[&'a str], more: &[&'a str]) -> Vec<&'a str> {
    let mut arguments = vec!["-q", "case.toml", "--particles", "bond.mpts", "-o", folder];
    for change in changes {
        arguments.extend(["--set", change]);
    }
    arguments.extend(more);
    arguments
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

/// A stack as the bytes of an `.npy` file of unsigned bytes; `dims` is (x, y, z).
pub fn npy(dims: [usize; 3], label: impl Fn(usize, usize, usize) -> u8) -> Vec<u8> {
    let [nx, ny, nz] = dims;
    let header =
        format!("{{'descr': '|u1', 'fortran_order': False, 'shape': ({nz}, {ny}, {nx}), }}");
    let padded = format!("{header:<117}\n");
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend((padded.len() as u16).to_le_bytes());
    bytes.extend(padded.as_bytes());
    for z in 0..nz {
        for y in 0..ny {
            bytes.extend((0..nx).map(|x| label(x, y, z)));
        }
    }
    bytes
}
