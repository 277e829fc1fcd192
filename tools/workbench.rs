//! A folder for a test of a tool, and the tool at work in it.
#![allow(dead_code)] // each tool uses a part

use std::fs::{self, File};
use std::path::PathBuf;
use std::process::{Command, Stdio};

use particle_file::{BitGrid, Block, Draft, Header, Material};
use tempfile::TempDir;

pub struct Bench {
    tool: &'static str,
    folder: TempDir,
}

pub struct Ended {
    line: String,
    status: Option<i32>,
    pub stdout: Vec<u8>,
    pub said: String,
}

impl Bench {
    pub fn new(tool: &'static str) -> Self {
        let folder = TempDir::new().unwrap();
        Self { tool, folder }
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    pub fn read(&self, name: &str) -> Vec<u8> {
        fs::read(self.path(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
    }

    pub fn text(&self, name: &str) -> String {
        String::from_utf8(self.read(name)).unwrap()
    }

    pub fn write(&self, name: &str, content: impl AsRef<[u8]>) {
        fs::write(self.path(name), content).unwrap();
    }

    pub fn write_particles(&self, name: &str, draft: &Draft) {
        let mut out = File::create(self.path(name)).unwrap();
        draft.write_to(&mut out).unwrap();
    }

    /// Writes a specimen of wood and adhesive with its low corner at the origin.
    pub fn write_specimen(&self, name: &str, header: Header, wood: &BitGrid, adhesive: &BitGrid) {
        let voxel_m = header.voxel_m;
        let block = |name, material, bits| Block::new(name, material, [0.0; 3], voxel_m, bits);
        let draft = Draft::new(header)
            .block(block("wood", Material::Rigid, wood), wood)
            .block(block("adhesive", Material::Adhesive, adhesive), adhesive);
        self.write_particles(name, &draft);
    }

    /// Runs the tool in the folder with the words of `line`.
    pub fn run(&self, line: &str) -> Ended {
        let mut tool = Command::new(self.tool);
        self.ended(tool.args(line.split_whitespace()), line)
    }

    /// Runs a line of a shell in the folder, in which the tool is `$TOOL`.
    pub fn shell(&self, line: &str) -> Ended {
        let mut shell = Command::new("sh");
        self.ended(shell.args(["-c", line]).env("TOOL", self.tool), line)
    }

    fn ended(&self, command: &mut Command, line: &str) -> Ended {
        let command = command.current_dir(self.folder.path());
        let ended = command.stdin(Stdio::null()).output().unwrap();
        Ended {
            line: line.to_owned(),
            status: ended.status.code(),
            stdout: ended.stdout,
            said: String::from_utf8_lossy(&ended.stderr).into_owned(),
        }
    }
}

impl Ended {
    /// Of a tool that must succeed.
    #[track_caller]
    pub fn done(self) -> Self {
        assert_eq!(self.status, Some(0), "{}: {}", self.line, self.said);
        self
    }

    /// The standard output of a tool that must succeed.
    #[track_caller]
    pub fn output(self) -> String {
        String::from_utf8(self.done().stdout).unwrap()
    }

    /// Of a tool that must end with this status and say this.
    #[track_caller]
    pub fn refused(self, status: i32, sentence: &str) -> Self {
        assert_eq!(self.status, Some(status), "{}: {}", self.line, self.said);
        assert!(self.said.contains(sentence), "{}: {}", self.line, self.said);
        self
    }
}

pub fn rows(csv: &str) -> Vec<Vec<String>> {
    let split = |line: &str| line.split(',').map(str::to_owned).collect();
    csv.lines().skip(1).map(split).collect()
}

#[track_caller]
pub fn number(field: &str) -> f64 {
    field.parse().unwrap()
}
