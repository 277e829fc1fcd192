//! The files of a figure.

use std::fs::File;
use std::path::PathBuf;

use cli::{Failure, InputRecord, Output, Record};
use figures::{Case, Labelled, read_beside};
use particle_file::{ParticleFile, file_of_run};

/// The files of a figure; standard input is among them as a temporary file.
pub(crate) struct Inputs {
    files: Vec<Labelled>,
    /// The files as the user named them.
    given: Vec<PathBuf>,
    /// Summaries and cases of the runs in whose folders the files lie.
    beside: Vec<PathBuf>,
    /// Keeps the copy of standard input, which has no name, until the figure is written.
    _spooled: Option<File>,
}

impl Inputs {
    /// Takes the files as they are, `-` as standard input.
    pub(crate) fn new(mut files: Vec<Labelled>) -> Result<Self, Failure> {
        let given: Vec<PathBuf> = files.iter().map(|file| file.path.clone()).collect();
        // A particle file begins as one, and a text has no zeros.
        let known = |head: &[u8]| ParticleFile::recognises(head) || !head.contains(&0);
        let paths = files.iter_mut().map(|file| &mut file.path);
        let spooled = cli::stdin_in_place(paths, known)?;
        let beside = given.iter().filter_map(|path| read_beside(path)).flatten();
        let mut beside: Vec<PathBuf> = beside.filter(|path| path.is_file()).collect();
        beside.sort();
        beside.dedup();
        Ok(Self {
            files,
            given,
            beside,
            _spooled: spooled,
        })
    }

    /// As [`Inputs::new`]; a run folder stands for its `history.csv`.
    pub(crate) fn of_runs(mut runs: Vec<Labelled>) -> Result<Self, Failure> {
        for run in &mut runs {
            if run.path.is_dir() {
                run.path = file_of_run(&run.path, "history.csv").map_err(Failure::data)?;
            }
        }
        Self::new(runs)
    }

    /// As [`Inputs::new`], of the files of cases, which are put in place.
    pub(crate) fn of_cases(cases: &mut [Case]) -> Result<Self, Failure> {
        let file = |case: &Case| Labelled {
            label: case.name.clone(),
            path: case.path.clone(),
        };
        let inputs = Self::new(cases.iter().map(file).collect())?;
        for (case, file) in cases.iter_mut().zip(&inputs.files) {
            case.path.clone_from(&file.path);
        }
        Ok(inputs)
    }

    /// The same with labels that differ, and a mark on those of files of runs that have not closed or are not sound.
    pub(crate) fn marked(mut self) -> Result<Self, Failure> {
        Labelled::tell_apart(&mut self.files);
        let marked = self.files.into_iter().map(Labelled::marked);
        self.files = marked.collect::<Result<_, _>>().map_err(Failure::data)?;
        Ok(self)
    }

    pub(crate) fn files(&self) -> &[Labelled] {
        &self.files
    }

    /// Refuses outputs that would replace one of the files or one another.
    pub(crate) fn keep_from<'a>(
        &'a self,
        outputs: impl IntoIterator<Item = &'a Output>,
    ) -> Result<(), Failure> {
        let read = self.given.iter().chain(&self.beside);
        cli::keep_apart_with_records(read.map(PathBuf::as_path), outputs)
    }

    /// The provenance of an output made of these files.
    pub(crate) fn record(&self) -> Result<Record, Failure> {
        let files = self.files.iter().map(|file| &file.path).zip(&self.given);
        let files = files.chain(self.beside.iter().zip(&self.beside));
        let hashed =
            files.map(|(file, given)| InputRecord::of_file(file, given.display().to_string()));
        let hashed = hashed.collect::<Result<_, _>>()?;
        let (tool, version) = (env!("CARGO_PKG_NAME"), env!("CARGO_PKG_VERSION"));
        Ok(Record::new(tool, version, hashed))
    }
}
