//! Command lines of runs, to be given again.

use std::path::Path;

use particle_file::{ParticleFile, command_line, quoted, states_of_run};

/// The command of the run in `folder` by its checkpoint or, before the first, a state: a run that was killed has no summary.
pub(crate) fn of_states(folder: &Path) -> Option<Vec<String>> {
    let states = states_of_run(folder).unwrap_or_default();
    let files = [folder.join("checkpoint.mpts")].into_iter().chain(states);
    let file = files
        .filter_map(|path| ParticleFile::open(path).ok())
        .next()?;
    Some(file.header().provenance.last()?.command.clone())
}

/// The end of a sentence: the command of a run again, with an option and a key; nothing where it is not known.
pub(crate) fn again(command: &[String], option: &str, key: Option<&str>) -> String {
    let tool = command.first().map(|tool| Path::new(tool).file_name());
    if tool != Some(Some("mpm-run".as_ref())) {
        return String::new();
    }
    let kept = command.iter().map(String::as_str);
    let kept = kept.filter(|word| !matches!(*word, "--resume" | "--overwrite"));
    let set = key.into_iter().flat_map(|key| ["--set", key]);
    let words: Vec<&str> = kept.chain([option]).chain(set).collect();
    format!(":\n    {}", command_line(&words))
}

/// The SET with which the same `make` does a run again with this key: that of the run, but for what make gives of its own, and
/// the key.
pub(crate) fn of_make(command: &[String], key: &str) -> String {
    if command.is_empty() {
        return format!("make as before with {} added to your SET", quoted(key));
    }
    let name = key.split_inclusive('=').next().unwrap_or_default();
    let others = |set: &&str| {
        let own = ["grid.cell=", "contact.influence_length=0.02 cell", name];
        !own.iter().any(|own| set.starts_with(own))
    };
    let pairs = command.windows(2).filter(|pair| pair[0] == "--set");
    let sets = pairs.map(|pair| pair[1].as_str()).filter(others);
    let sets: Vec<&str> = sets.chain([key]).collect();
    format!("make as before with SET={}", quoted(&sets.join(" ")))
}

#[cfg(test)]
mod tests {
    use particle_file::{Draft, Header, Kind, Provenance};

    use super::of_make;
    use crate::RunEnd;

    /// The SET of the run was left out, so that another press was run.
    #[test]
    fn the_set_of_a_run_is_kept() {
        let command = "mpm-run|a.toml|--set|grid.cell=1 voxel|--set|adhesive.viscosity=500 cP|--set|clamp.time_limit=20 us";
        let command: Vec<String> = command.split('|').map(String::from).collect();
        let set = "make as before with SET='adhesive.viscosity=500 cP clamp.time_limit=60 us'";
        assert_eq!(of_make(&command, "clamp.time_limit=60 us"), set);
        let unknown = "make as before with 'clamp.time_limit=60 us' added to your SET";
        assert_eq!(of_make(&[], "clamp.time_limit=60 us"), unknown);
    }

    #[test]
    fn a_killed_run_is_told_with_the_command_of_its_checkpoint() {
        let folder = tempfile::tempdir().unwrap();
        let advice = || RunEnd::in_folder(folder.path()).unwrap().0.advice();
        let known = "not ended: mpm-run --resume continues it";
        assert_eq!(advice().unwrap(), known);
        let mut header = Header::new(Kind::Checkpoint, 1.0, 1, [0.0; 3], [1.0; 3]);
        header.provenance.push(Provenance {
            tool: "mpm-run".into(),
            version: String::new(),
            command: ["mpm-run", "a.toml", "-o", "my run"]
                .map(String::from)
                .to_vec(),
            inputs: Vec::new(),
        });
        let mut bytes = Vec::new();
        Draft::new(header).write_to(&mut bytes).unwrap();
        std::fs::write(folder.path().join("checkpoint.mpts"), bytes).unwrap();
        let command = "\n    mpm-run a.toml -o 'my run' --resume";
        assert_eq!(advice().unwrap(), format!("{known}:{command}"));
    }
}
