//! The test volume, and what a file must be to be a copy of it.

use std::fs;
use std::path::{Path, PathBuf};

use tempfile::TempDir;
use voxels::{Crop, Error, Phases, Segmented, Stack, segment};

/// Columns, rows and pages of the test volume: odd, and rows that do not fill bytes.
pub const DIMS: [usize; 3] = [21, 13, 4];
pub const PLAIN: &str = "void=0,wood=1,adhesive=2";

/// The label (0, 1 or 2) of a voxel of the test volume.
pub fn label(x: usize, y: usize, z: usize) -> u8 {
    ((x * x + 3 * y + 5 * z + x * y * z) % 7 % 3) as u8
}

/// Values of a page of the test volume.
pub fn page<T>(z: usize, value: impl Fn(u8) -> T) -> Vec<T> {
    let [nx, ny, _] = DIMS;
    let values = (0..nx * ny).map(|i| value(label(i % nx, i / nx, z)));
    values.collect()
}

/// The pages of the test volume as bytes.
pub fn pages() -> Vec<Vec<u8>> {
    (0..DIMS[2]).map(|z| page(z, |l| l)).collect()
}

pub fn volume() -> Vec<u8> {
    pages().concat()
}

/// How many voxels of the test volume have a label.
pub fn count(label: u8) -> u64 {
    volume().iter().filter(|l| **l == label).count() as u64
}

/// The labels of the test volume where `of` gives the value of each.
pub fn labels<T: std::fmt::Display>(of: impl Fn(u8) -> T) -> String {
    format!("void={},wood={},adhesive={}", of(0), of(1), of(2))
}

pub fn by_labels(text: &str) -> Phases {
    Phases::Labels(text.parse().unwrap())
}

pub fn by_grey(text: &str) -> Phases {
    Phases::Grey(text.parse().unwrap())
}

/// Writes `bytes` as `name` into a folder that lives as long as the returned guard.
pub fn stored(name: &str, bytes: &[u8]) -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    fs::write(&path, bytes).unwrap();
    (folder, path)
}

/// A folder of slices, numbered from 8 so that names as text are in another order.
pub fn folder(ending: &str, slice: impl Fn(usize) -> Vec<u8>) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    for z in 0..DIMS[2] {
        let name = format!("slice {}.{ending}", z + 8);
        fs::write(folder.path().join(name), slice(z)).unwrap();
    }
    folder
}

pub fn open(path: &Path) -> Stack {
    Stack::open(&[path.to_owned()]).unwrap()
}

pub fn read_page(stack: &Stack, z: usize) -> Vec<u8> {
    let mut page = Vec::new();
    stack.read_page(z, &mut page).unwrap();
    page
}

/// The sentence with which a file or folder is refused when it is opened.
pub fn refusal(path: &Path) -> String {
    Stack::open(&[path.to_owned()]).unwrap_err().to_string()
}

/// Opens and segments a whole stack.
pub fn segmented(path: &Path, phases: &Phases) -> Result<Segmented, Error> {
    let stack = Stack::open(&[path.to_owned()])?;
    segment(&stack, phases, &Crop::whole(stack.dims()), || {})
}

/// Panics unless the file or folder is the test volume.
pub fn assert_volume(what: &str, path: &Path, labels: &str) {
    let found = segmented(path, &by_labels(labels)).unwrap_or_else(|e| panic!("{what}: {e}"));
    assert_eq!(found.wood.dims(), DIMS, "{what}");
    for (i, expected) in volume().into_iter().enumerate() {
        let [x, y, z] = [i % DIMS[0], i / DIMS[0] % DIMS[1], i / DIMS[0] / DIMS[1]];
        let got = (found.wood.get(x, y, z), found.adhesive.get(x, y, z));
        assert_eq!(got, (expected == 1, expected == 2), "{what}: {x} {y} {z}");
    }
}

/// Panics unless a file of these bytes is the test volume.
pub fn assert_file(name: &str, bytes: &[u8], labels: &str) {
    let (_folder, path) = stored(name, bytes);
    assert_volume(name, &path, labels);
}

/// Panics unless a file is refused, when it is opened or segmented, with a sentence that has these parts.
pub fn assert_refused(name: &str, bytes: &[u8], said: &[&str]) {
    let (_folder, path) = stored(name, bytes);
    assert_says(segmented(&path, &by_labels(PLAIN)), said);
}

/// Panics unless the error has these parts.
pub fn assert_says<T>(refused: Result<T, Error>, said: &[&str]) {
    let sentence = refused.err().expect("it should be refused").to_string();
    assert_has(&sentence, said);
}

pub fn assert_has(sentence: &str, parts: &[&str]) {
    for part in parts {
        assert!(sentence.contains(part), "no {part:?}: {sentence}");
    }
}

/// The edge of the voxels that a file states, m.
pub fn stated_edge(path: &Path) -> Option<Result<f64, String>> {
    open(path).voxel_size().map(voxels::VoxelSize::cube_edge)
}

/// Panics unless the file states voxels of `edge` (m).
pub fn assert_edge(path: &Path, edge: f64) {
    let found = stated_edge(path).unwrap().unwrap();
    assert!((found / edge - 1.0).abs() < 1e-6, "{found}");
}
