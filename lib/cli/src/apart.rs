//! Outputs that would replace what is not theirs to replace are refused, and those without a folder.

use std::fs;
use std::path::{Path, PathBuf};

use crate::{Failure, Output};
use crate::{aside, output, provenance};

/// Files that only their own tool writes: kinds of folders, marks in each of them, and their files; `*` stands for any characters.
const OWNED: [[&str; 3]; 2] = [
    [
        "run",
        "bondline-run.toml",
        "bondline-run.toml resolved.toml history.csv checkpoint.mpts final.mpts summary.json snapshots/*.mpts",
    ],
    [
        "sweep",
        "plan.json runs",
        "plan.json runs.txt runs/*/case.toml runs/*/row.csv specimens/*/*",
    ],
];

/// Refuses outputs that would replace a file that is read, one another, a file of a run or a sweep, another file's provenance
/// record or a write-protected file, or have no folder to lie in.
///
/// # Errors
/// Exit 2 with the file that is named twice or is not the tool's own; exit 1 with the one that cannot be written.
pub fn keep_apart<'a>(
    inputs: impl IntoIterator<Item = &'a Path>,
    outputs: impl IntoIterator<Item = &'a Output>,
) -> Result<(), Failure> {
    let outputs: Vec<&Output> = outputs.into_iter().collect();
    Places::apart(inputs, &outputs).map(|_| ())
}

/// As [`keep_apart`], for outputs written by [`Output::write_with_record`]: their records are
/// outputs too, and replace nothing but records.
///
/// # Errors
/// Exit 2 with the file that is named twice, or that stands where a record goes; exit 1 with the one that cannot
/// be written.
pub fn keep_apart_with_records<'a>(
    inputs: impl IntoIterator<Item = &'a Path>,
    outputs: impl IntoIterator<Item = &'a Output>,
) -> Result<(), Failure> {
    let outputs: Vec<&Output> = outputs.into_iter().collect();
    let mut places = Places::apart(inputs, &outputs)?;
    for output in outputs {
        let Some(record) = output.record_path() else {
            continue;
        };
        if let Some(other) = places.taken(&record, ["is read", "is another output"]) {
            return Err(Failure::usage(format!(
                "'{}' {other} and would be replaced by the provenance record of {output}: give another file name",
                record.display()
            )));
        }
        provenance::may_replace(&record)?;
    }
    Ok(())
}

struct Places {
    read: Vec<PathBuf>,
    written: Vec<PathBuf>,
}

impl Places {
    fn apart<'a>(
        inputs: impl IntoIterator<Item = &'a Path>,
        outputs: &[&Output],
    ) -> Result<Self, Failure> {
        // Standard input may be a file that has a name.
        let stdin = Path::new("/dev/stdin");
        let named = |path| if path == Path::new("-") { stdin } else { path };
        let mut places = Self {
            read: (inputs.into_iter().map(named).filter_map(place)).collect(),
            written: Vec::new(),
        };
        (outputs.iter()).try_for_each(|output| places.write_at(output))?;
        (outputs.iter()).try_for_each(|output| refuse_owned(output))?;
        Ok(places)
    }

    fn write_at(&mut self, output: &Output) -> Result<(), Failure> {
        let Output::File(path) = output else {
            return Ok(());
        };
        let twice = [
            "is an input and cannot also be the output: give another file name",
            "is given for two outputs: give each its own file name",
        ];
        match self.taken(path, twice) {
            Some(why) => Err(Failure::usage(format!("{output} {why}"))),
            None => output::target(path)
                .and_then(|target| target.map_or(Ok(None), |_| machine::replaced_permissions(path)))
                .map(|_| ())
                .map_err(|e| Failure::write(output, &e)),
        }
    }

    /// Why another file cannot be written at `path`, of the two reasons, or nothing, and the place is taken from now on.
    fn taken(&mut self, path: &Path, [read, written]: [&'static str; 2]) -> Option<&'static str> {
        // What cannot be placed holds nothing that could be replaced.
        let place = place(path)?;
        if self.read.contains(&place) {
            return Some(read);
        }
        if self.written.contains(&place) {
            return Some(written);
        }
        self.written.push(place);
        None
    }
}

/// Refuses an output that would be a file of a run or a sweep, or the provenance record of another file.
fn refuse_owned(output: &Output) -> Result<(), Failure> {
    let place = match output {
        Output::File(path) => place(path),
        Output::Stdout => None,
    };
    match place.and_then(|place| owner(&place)) {
        Some(owner) => Err(Failure::usage(format!(
            "{output} {owner} and is not replaced: give another file name"
        ))),
        None => Ok(()),
    }
}

/// Owner of the file at `place`, in words.
fn owner(place: &Path) -> Option<String> {
    let recorded = place
        .to_str()
        .and_then(|p| p.strip_suffix(provenance::ENDING));
    if let Some(of) = recorded.filter(|of| Path::new(of).is_file()) {
        return Some(format!("is the provenance record of '{of}'"));
    }
    let is_of = |[what, marks, files]: &[&str; 3]| {
        let folder = files.split(' ').find_map(|file| {
            let parts = file.split('/').rev();
            let folder = place.ancestors().nth(parts.clone().count())?;
            let fits = parts.zip(place.iter().rev()).all(|(part, name)| {
                let name = name.as_encoded_bytes();
                match part.strip_prefix('*') {
                    Some(end) => name.ends_with(end.as_bytes()),
                    None => name == part.as_bytes(),
                }
            });
            let marked = || marks.split(' ').all(|mark| folder.join(mark).exists());
            (fits && marked()).then_some(folder)
        });
        folder.map(|folder| format!("belongs to the {what} in '{}'", folder.display()))
    };
    OWNED.iter().find_map(is_of)
}

/// Where a regular file is or would be; `None` for devices and pipes, which hold nothing that
/// could be replaced.
fn place(path: &Path) -> Option<PathBuf> {
    if let Ok(found) = fs::metadata(path) {
        return found.is_file().then(|| fs::canonicalize(path).ok())?;
    }
    let target = aside::behind_links(path).ok()?;
    let folder = fs::canonicalize(aside::folder_of(&target)).ok()?;
    Some(folder.join(target.file_name()?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_same_file_by_another_path_is_found_and_devices_are_not() {
        let folder = tempfile::tempdir().unwrap();
        let inside = |name: &str| folder.path().join(name);
        fs::write(inside("a"), b"x").unwrap();
        fs::create_dir(inside("b")).unwrap();
        let file = |name: &str| Output::File(inside(name));
        let [input, other] = [inside("a"), inside("none")];
        let check = |outputs: &[Output]| keep_apart([input.as_path(), &other], outputs);
        assert!(check(&[file("b/../a")]).is_err());
        assert!(check(&[file("c"), file("b/../c")]).is_err());
        assert!(check(&[file("c"), file("b/c"), Output::Stdout]).is_ok());
        std::os::unix::fs::symlink("b/new", inside("link")).unwrap();
        assert!(check(&[file("link"), file("b/new")]).is_err());
        let null = || Output::File("/dev/null".into());
        assert!(check(&[null(), null()]).is_ok());
        for nowhere in ["", "none/c"] {
            assert!(check(&[file(nowhere)]).is_err());
        }
    }

    #[test]
    fn a_record_is_an_output_and_replaces_only_records() {
        let folder = tempfile::tempdir().unwrap();
        let inside = |name: &str| folder.path().join(name);
        let file = |name: &str| Output::File(inside(name));
        let input = inside("a.csv.provenance.json");
        let check = |all: &[Output]| keep_apart_with_records([input.as_path()], all).is_ok();
        fs::write(&input, b"x").unwrap();
        assert!(!check(&[file("a.csv")]));
        for pair in [["b", "b.provenance.json"], ["b.provenance.json", "b"]] {
            assert!(!check(&pair.map(file)), "{pair:?}");
        }
        let own = crate::Record::new("tool", "1.0", Vec::new());
        let record = own.to_json();
        let mistyped = record.replace("tool\":", "tol\":");
        let more = record.replacen('{', "{\"more\": 1,", 1);
        let longer = record.clone() + "x";
        for content in ["", "{}", "[]", "text", &mistyped, &more, &longer] {
            fs::write(inside("c.provenance.json"), content).unwrap();
            assert!(!check(&[file("c")]), "{content}");
            let written = file("c").write_with_record(&own, |_| panic!("written without record"));
            assert!(written.is_err() && !inside("c").exists());
            let kept = fs::read_to_string(inside("c.provenance.json")).unwrap();
            assert_eq!(kept, content);
        }
        fs::write(inside("c.provenance.json"), record).unwrap();
        assert!(check(&[file("c"), file("d")]));
        fs::create_dir(inside("d.provenance.json")).unwrap();
        assert!(!check(&[file("d")]));
        assert!(check(&["/dev/null".into()].map(Output::File)));
    }
}
