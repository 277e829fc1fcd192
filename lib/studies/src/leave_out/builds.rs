//! Builds of `mpm-run` with and without a feature, from one scratch copy of the committed tree.

use std::path::{Path, PathBuf};
use std::process::Command;

/// The scratch copy and where its builds go. Only files that a patch or a new commit touches are
/// written, so that only these are compiled again.
pub struct Builds {
    folder: PathBuf,
    patches: PathBuf,
    git_dir: String,
}

impl Builds {
    /// For a scratch copy in `folder` of the repository this runs in.
    ///
    /// # Errors
    /// What git or the system said.
    pub fn new(folder: &Path, patches: &Path) -> Result<Self, String> {
        let whole =
            |path: &Path| std::path::absolute(path).map_err(|e| format!("{}: {e}", path.display()));
        let folder = whole(folder)?;
        for part in ["tree", "bin"] {
            let path = folder.join(part);
            std::fs::create_dir_all(&path).map_err(|e| format!("{}: {e}", path.display()))?;
        }
        let mut own = Command::new("git");
        let git_dir = output(own.args(["rev-parse", "--absolute-git-dir"]))?;
        Ok(Self {
            folder,
            patches: whole(patches)?,
            git_dir: git_dir.trim().to_owned(),
        })
    }

    /// Builds the tree as committed.
    ///
    /// # Errors
    /// What git or cargo said.
    pub fn full(&self) -> Result<PathBuf, String> {
        self.reset()?;
        self.build("full")
    }

    /// Builds the tree without a feature.
    ///
    /// # Errors
    /// That the patch of this name is missing or does not apply any more, or what cargo said.
    pub fn without(&self, feature: &str) -> Result<PathBuf, String> {
        self.reset()?;
        let name = format!("{feature}.patch");
        let patch = self.patches.join(&name).display().to_string();
        self.git(&["apply", &patch])
            .map_err(|said| format!("{name} does not apply to this commit: {said}"))?;
        self.build(feature)
    }

    /// Brings the copy to the last commit.
    fn reset(&self) -> Result<(), String> {
        self.git(&["read-tree", "--reset", "-u", "HEAD"])
    }

    /// Runs git on the copy, with an index of its own so that the user's is left alone.
    fn git(&self, arguments: &[&str]) -> Result<(), String> {
        let mut command = Command::new("git");
        command
            .current_dir(self.folder.join("tree"))
            .env("GIT_DIR", &self.git_dir)
            .env("GIT_WORK_TREE", ".")
            .env("GIT_INDEX_FILE", self.folder.join("index"))
            .args(arguments);
        output(&mut command).map(drop)
    }

    fn build(&self, name: &str) -> Result<PathBuf, String> {
        let target = self.folder.join("target");
        let cargo = std::env::var("CARGO").unwrap_or_else(|_| "cargo".into());
        let mut command = Command::new(cargo);
        command
            .args(["build", "--release", "--quiet", "--locked", "-p", "mpm-run"])
            .arg("--manifest-path")
            .arg(self.folder.join("tree/Cargo.toml"))
            .arg("--target-dir")
            .arg(&target);
        output(&mut command).map_err(|said| format!("the build without {name} failed: {said}"))?;
        let program = self.folder.join("bin").join(name);
        std::fs::copy(target.join("release/mpm-run"), &program)
            .map_err(|e| format!("{}: {e}", program.display()))?;
        Ok(program)
    }
}

/// Standard output of a command, or what it said on standard error.
fn output(command: &mut Command) -> Result<String, String> {
    let name = command.get_program().display().to_string();
    let output = command
        .output()
        .map_err(|e| format!("{name} cannot be started: {e}"))?;
    if output.status.success() {
        Ok(String::from_utf8_lossy(&output.stdout).into_owned())
    } else {
        let said = String::from_utf8_lossy(&output.stderr);
        Err(said.split_whitespace().collect::<Vec<_>>().join(" "))
    }
}
