//! Writes the seeds and finds of every target as files: `seeds FOLDER`, one folder a target.

use std::fs;
use std::io;
use std::path::PathBuf;

use attack::TARGETS;

fn main() -> io::Result<()> {
    let folder = std::env::args_os().nth(1);
    let folder = folder.map_or_else(|| "out/fuzz/seeds".into(), PathBuf::from);
    for target in &TARGETS {
        let folder = folder.join(target.name);
        fs::create_dir_all(&folder)?;
        for (i, seed) in (target.seeds)().iter().chain(&target.finds()).enumerate() {
            fs::write(folder.join(format!("seed-{i:02}")), seed)?;
        }
    }
    Ok(())
}
