//! A file of any kind that wp-metrics reads, in memory or mapped.

use std::fs::File;
use std::io::{Read, Write};
use std::path::Path;

use bondline::{PlacedVoxels, Specimen};
use cli::{Failure, InputRecord};
use metrics::{Adhesive, State};
use particle_file::{BitGrid, Header, Kind, Mapped, ParticleFile, temporary_file};
use units::Axis;
use voxels::{Crop, GreyLevels, Histogram, Phases, Segmented, Source, Stack, VoxelEdge};

use crate::arguments::Arguments;

/// Which values of `stack` are what.
fn phases(stack: &Stack, arguments: &Arguments) -> Result<Phases, Failure> {
    Ok(match (&arguments.labels, &arguments.grey) {
        (Some(labels), _) => Phases::Labels(labels.clone()),
        (None, Some(GreyLevels::Given(grey))) => Phases::Grey(grey.clone()),
        (None, Some(auto)) => {
            let whole = Crop::whole(stack.dims());
            let histogram = Histogram::of(stack, &whole).map_err(stack_failure)?;
            let name = stack.name();
            let proposal = histogram.propose(*auto == GreyLevels::AutoWood);
            let proposal = proposal.map_err(|why| Failure::usage(format!("{name}: {why}")))?;
            let grey = proposal.grey;
            cli::note(format_args!("{name}: grey values: {grey}"));
            proposal.left_out.iter().for_each(cli::warn);
            Phases::Grey(grey)
        }
        (None, None) => Phases::Guess,
    })
}

pub struct Input {
    pub name: String,
    content: Content,
}

enum Content {
    Particles(ParticleFile),
    Stack {
        stack: Stack,
        voxels: Segmented,
        edge_m: f64,
    },
}

impl Input {
    /// Opens a particle file or an image stack; `-` is standard input.
    pub fn open(path: &Path, arguments: &Arguments) -> Result<Self, Failure> {
        let name = path.display().to_string();
        let content = if path.is_dir() {
            stack(Stack::open(&[path.to_owned()]), arguments)?
        } else {
            open_file(path, arguments)?
        };
        Ok(Self { name, content })
    }

    /// What it shows; `normal` overrides the axis across the bond of a specimen. A bond and what was pressed of it have their own.
    pub fn state(&self, normal: Option<Axis>) -> Result<State<'_>, Failure> {
        match &self.content {
            Content::Particles(file) => {
                let mut state = State::of_file(file).map_err(|e| self.failure(&e))?;
                let (own, kind) = (state.normal, self.kind());
                state.normal = normal.unwrap_or(own);
                match state.normal == own || kind == Kind::Specimen {
                    true => Ok(state),
                    false => Err(Failure::usage(format!(
                        "'{}' is a {kind} across {own}, not across {}: leave out --normal",
                        self.name, state.normal
                    ))),
                }
            }
            Content::Stack { voxels, edge_m, .. } => {
                let parts = [&voxels.wood, &voxels.adhesive];
                let [wood, adhesive] =
                    parts.map(|bits| PlacedVoxels::at_origin(bits.view(), *edge_m));
                let specimen = Specimen::new(wood, adhesive).map_err(Failure::data)?;
                Ok(State::of_specimen(&specimen, normal.unwrap_or(Axis::Y)))
            }
        }
    }

    /// The adhesive of its state without islands of fewer than `least` pixels.
    pub fn without_islands(&self, state: &State, least: usize) -> Result<BitGrid, Failure> {
        match state.adhesive {
            Adhesive::Voxels(adhesive) => Ok(metrics::without_islands(adhesive, least)),
            Adhesive::Points { .. } => Err(Failure::usage(format!(
                "'{}' holds material points, which have no slices: --ignore-islands takes stacks, specimens and bonds (particles export makes a stack of it)",
                self.name
            ))),
        }
    }

    /// What it is; a stack is a specimen.
    pub fn kind(&self) -> Kind {
        self.header().map_or(Kind::Specimen, |header| header.kind)
    }

    /// Simulated time of a state, s; 0 of anything else.
    pub fn time_s(&self) -> f64 {
        self.header().map_or(0.0, |header| header.time_s)
    }

    fn header(&self) -> Option<&Header> {
        match &self.content {
            Content::Particles(file) => Some(file.header()),
            Content::Stack { .. } => None,
        }
    }

    /// A number that `mpm-run` notes at the states of a run.
    pub fn noted(&self, name: &str) -> Result<f64, Failure> {
        let text = self.header().and_then(|header| header.attribute(name));
        let number = text.and_then(|text| text.parse().ok());
        number.filter(|n: &f64| n.is_finite()).ok_or_else(|| {
            Failure::usage(format!(
                "'{}' has no {name}: a state of a run is needed",
                self.name
            ))
        })
    }

    pub fn failure(&self, error: &metrics::Error) -> Failure {
        Failure::of_input(error.is_usage(), format!("'{}': {error}", self.name))
    }

    /// The files that a stack is read from: its slices, or its header and data.
    pub fn stack_files(&self) -> impl Iterator<Item = &Path> {
        let sources = match &self.content {
            Content::Particles(_) => &[],
            Content::Stack { stack, .. } => stack.sources(),
        };
        sources.iter().map(Source::path)
    }

    pub fn records(&self) -> Result<Vec<InputRecord>, Failure> {
        match &self.content {
            Content::Particles(file) => {
                let record = InputRecord::new(self.name.clone(), file.content_hash());
                Ok(vec![record])
            }
            Content::Stack { stack, .. } => stack.sources().iter().map(record).collect(),
        }
    }
}

fn open_file(path: &Path, arguments: &Arguments) -> Result<Content, Failure> {
    if let Some((dims, kind)) = arguments.dims.zip(arguments.kind)
        && !begins_as_particles(path)
    {
        return stack(Stack::open_raw(path, dims, kind), arguments);
    }
    let from_stdin = path == Path::new("-");
    let name = match from_stdin {
        true => "standard input".to_owned(),
        false => format!("'{}'", path.display()),
    };
    let known = |head: &[u8]| ParticleFile::recognises(head) || Stack::recognises(head);
    let bytes = Mapped::open(path, known)
        .map_err(|error| Failure::data(format!("cannot read {name}: {error}")))?;
    if ParticleFile::recognises(&bytes) {
        let own_name = if from_stdin {
            name
        } else {
            path.display().to_string()
        };
        let file = ParticleFile::from_mapped(own_name, bytes).map_err(Failure::data)?;
        (voxels::doubt_of_file(file.header()).into_iter()).for_each(cli::warn);
        return Ok(Content::Particles(file));
    }
    if from_stdin {
        // A pipe has been read already; a stack is read from a file.
        let file = copy(&bytes)
            .map_err(|error| Failure::failed(format!("cannot keep standard input: {error}")))?;
        return stack(Stack::of_open_file(&name, file), arguments);
    }
    stack(Stack::open(&[path.to_owned()]), arguments)
}

/// Whether a regular file begins as a particle file; what else it is its reader says.
fn begins_as_particles(path: &Path) -> bool {
    let mut head = Vec::new();
    let read = File::open(path).and_then(|file| file.take(64).read_to_end(&mut head));
    path.is_file() && read.is_ok() && ParticleFile::recognises(&head)
}

fn copy(bytes: &[u8]) -> std::io::Result<File> {
    let mut file = temporary_file(bytes.len() as u64)?;
    file.write_all(bytes)?;
    Ok(file)
}

fn stack(opened: Result<Stack, voxels::Error>, arguments: &Arguments) -> Result<Content, Failure> {
    let stack = opened.map_err(stack_failure)?;
    let edge = VoxelEdge::resolve(arguments.voxel, stack.voxel_size(), stack.name())
        .map_err(stack_failure)?;
    edge.doubt().into_iter().for_each(cli::warn);
    stack.gap().into_iter().for_each(cli::warn);
    let whole = Crop::whole(stack.dims());
    let phases = phases(&stack, arguments)?;
    let voxels = voxels::segment(&stack, &phases, &whole, || ()).map_err(stack_failure)?;
    voxels.swapped().into_iter().for_each(cli::warn);
    if let Phases::Grey(grey) = &phases {
        let histogram = Histogram::of(&stack, &whole).map_err(stack_failure)?;
        let doubt = histogram.doubt(grey);
        if doubt.overlaps() {
            cli::warn(format_args!(
                "{}: phases overlap: {doubt}; xct2particles tells what that does to penetration, and --denoise there takes noise out",
                stack.name()
            ));
        }
    }
    if let Some([void, wood, adhesive]) = voxels.guessed {
        cli::note(format!(
            "{}: labels taken as void={void}, wood={wood}, adhesive={adhesive}",
            stack.name()
        ));
    }
    Ok(Content::Stack {
        stack,
        voxels,
        edge_m: edge.metres,
    })
}

fn stack_failure(error: voxels::Error) -> Failure {
    Failure::of_input(error.is_usage(), error)
}

fn record(source: &Source) -> Result<InputRecord, Failure> {
    let hash = source.reader().and_then(cli::hash_reader);
    match hash {
        Ok(hash) => Ok(InputRecord::new(source.name().to_owned(), hash)),
        Err(error) => Err(Failure::data(format!("cannot read {source}: {error}"))),
    }
}
