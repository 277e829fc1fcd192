//! Writes the seeds and finds of every target as files: `seeds FOLDER`, one folder a target.

use std::fs;
use std::io;
use std::path::Path;

use attack::Target;

fn main() -> io::Result<()> {
    let folder = std::env::args_os()
        .nth(1)
        .unwrap_or_else(|| "out/fuzz/seeds".into());
    for target in Target::ALL {
        let folder = Path::new(&folder).join(target.name());
        fs::create_dir_all(&folder)?;
        for (i, seed) in target.seeds().iter().chain(&target.finds()).enumerate() {
            fs::write(folder.join(format!("seed-{i:02}")), seed)?;
        }
    }
    Ok(())
}
