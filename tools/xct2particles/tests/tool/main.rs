//! The tool as a process: exit statuses, sentences, outputs that are whole or absent. Formats are tested in `lib/voxels`.

mod grey_values;
mod looked_at;
mod stacks;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use particle_file::ParticleFile;
use tempfile::TempDir;
use voxels::TiffWriter;

/// A folder in which the tool is run.
struct Folder(TempDir);

impl Folder {
    fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    /// One with `acer.tif`, the bond of maple of the examples.
    fn with_acer() -> Self {
        let top = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        let acer = top.join("pipelines/examples/acer/bondline-acer-64x192x128.tif");
        let folder = Self::new();
        std::os::unix::fs::symlink(acer, folder.path("acer.tif")).unwrap();
        folder
    }

    fn write(&self, name: &str, bytes: &[u8]) {
        fs::write(self.path(name), bytes).unwrap();
    }

    fn tool(&self, arguments: &str) -> Command {
        let mut tool = Command::new(env!("CARGO_BIN_EXE_xct2particles"));
        let words = arguments.split_whitespace();
        tool.args(words).current_dir(self.0.path());
        tool.stdin(Stdio::null());
        tool
    }

    /// Runs the tool with the words of `arguments` and expects the exit status; what it
    /// said, which has these parts.
    fn run(&self, arguments: &str, status: i32, parts: &[&str]) -> String {
        said(&mut self.tool(arguments), status, parts)
    }

    fn file(&self, name: &str) -> ParticleFile {
        ParticleFile::open(self.path(name)).unwrap()
    }
}

fn said(tool: &mut Command, status: i32, parts: &[&str]) -> String {
    let output = tool.output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(status), "{tool:?}: {said}");
    for part in parts.iter().chain(&[""]) {
        assert!(said.contains(part), "no {part:?} of {tool:?}: {said}");
    }
    assert!(!said.contains("panicked"), "{said}");
    assert!(output.stdout.is_empty() || status == 0);
    said
}

/// A TIFF with voxels of 1.45 um.
fn tiff([nx, ny, nz]: [usize; 3], label: impl Fn(usize, usize, usize) -> u8) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut writer = TiffWriter::new(&mut bytes, [nx, ny, nz], 1.45e-6).unwrap();
    for z in 0..nz {
        let page: Vec<u8> = (0..nx * ny).map(|i| label(i % nx, i / nx, z)).collect();
        writer.write_page(&page).unwrap();
    }
    writer.finish().unwrap();
    bytes
}

/// Voxels of wood and adhesive.
fn counts(file: &ParticleFile) -> [u64; 2] {
    ["wood", "adhesive"].map(|name| file.block_named(name).unwrap().1.count())
}

/// Which voxels are wood and adhesive.
fn bits(file: &ParticleFile) -> [Vec<u64>; 2] {
    ["wood", "adhesive"].map(|name| file.block_named(name).unwrap().1.words().to_vec())
}
