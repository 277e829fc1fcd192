//! Messages, refusals and output of the tool.

mod common;

use std::fs::{self, File};
use std::process::{Command, Stdio};

use common::{particles, state, stderr, stdout};
use tempfile::tempdir;

#[test]
fn info_says_what_a_file_holds() {
    let folder = tempdir().unwrap();
    state(folder.path(), 2);
    let text = stdout(folder.path(), &["info", "0002.mpts"]);
    for expected in [
        "kind        state of a run",
        "voxel       1.5 um",
        "normal      y",
        "time        2e-6 s, step 2",
        "wood-top: rigid, 168 of 70 x 4 x 3 voxels (20.00 %) of 1.5 um from 0, 8.25, 0 um",
        "liquid      3 points",
        "position: 3 rows of 3 f32",
    ] {
        assert!(text.contains(expected), "'{expected}' is not in\n{text}");
    }
}

#[test]
fn the_man_page_needs_no_file() {
    let folder = tempdir().unwrap();
    for arguments in [
        ["--generate", "man"].as_slice(),
        &["info", "--generate=man"],
    ] {
        assert!(stdout(folder.path(), arguments).contains(".TH particles 1"));
    }
}

#[test]
fn the_sum_is_the_same_from_a_file_a_redirection_and_a_pipe() {
    let folder = tempdir().unwrap();
    let path = state(folder.path(), 0);
    let sum = |text: String| text.split(' ').next().unwrap().to_owned();
    let named = sum(stdout(folder.path(), &["sum", "0000.mpts"]));
    assert_eq!(named.len(), 16);
    let mut command = Command::new(env!("CARGO_BIN_EXE_particles"));
    command.args(["sum", "-"]);
    let redirected = command.stdin(File::open(&path).unwrap()).output().unwrap();
    assert_eq!(sum(String::from_utf8(redirected.stdout).unwrap()), named);

    let mut piped = command
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let mut pipe = piped.stdin.take().unwrap();
    std::io::copy(&mut File::open(&path).unwrap(), &mut pipe).unwrap();
    drop(pipe);
    let piped = piped.wait_with_output().unwrap();
    assert_eq!(sum(String::from_utf8(piped.stdout).unwrap()), named);

    state(folder.path(), 1);
    assert_ne!(sum(stdout(folder.path(), &["sum", "0001.mpts"])), named);
}

#[test]
fn check_finds_every_damaged_file_and_exits_with_3() {
    let folder = tempdir().unwrap();
    let whole = fs::read(state(folder.path(), 0)).unwrap();
    assert_eq!(
        stdout(folder.path(), &["check", "0000.mpts"]),
        "0000.mpts: ok\n"
    );
    fs::write(folder.path().join("short.mpts"), &whole[..whole.len() - 1]).unwrap();
    let mut flipped = whole.clone();
    let last_value = whole.len() - 16 - 64;
    flipped[last_value] ^= 1;
    fs::write(folder.path().join("flipped.mpts"), &flipped).unwrap();
    fs::write(folder.path().join("foreign.mpts"), b"II*\0 a TIFF, maybe").unwrap();
    fs::write(folder.path().join("empty.mpts"), b"").unwrap();
    for (name, reason) in [
        ("short.mpts", "truncated"),
        ("flipped.mpts", "damaged array 'pressure'"),
        ("foreign.mpts", "is not a particle file"),
        ("empty.mpts", "is not a particle file"),
        ("absent.mpts", "cannot read 'absent.mpts'"),
        (".", "folder"),
    ] {
        let output = particles(folder.path(), &["check", name]);
        assert_eq!(output.status.code(), Some(3), "{name}");
        assert!(stderr(&output).contains(reason), "{}", stderr(&output));
        assert_eq!(stderr(&output).lines().count(), 1, "{}", stderr(&output));
    }
    let all = particles(
        folder.path(),
        &["check", "short.mpts", "0000.mpts", "flipped.mpts"],
    );
    assert_eq!(all.status.code(), Some(3));
    assert_eq!(all.stdout, b"0000.mpts: ok\n");
    let said = stderr(&all);
    assert!(
        said.contains("short.mpts") && said.contains("2 files are damaged"),
        "{said}"
    );
}
