//! Particle files in other formats; one module per format.

mod csv;
mod npz;
mod points;
mod series;
mod vtk;

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use cli::{Failure, InputRecord, Output, Record};
use particle_file::{ParticleFile, by_time};
use voxels::LabelVolume;

use points::Points;

#[derive(Args, Debug)]
pub struct Arguments {
    /// Particle files; '-' is standard input; all formats but pvd take one, and pvd states of one run
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    /// Output file; '-' is standard output
    #[arg(short, long, value_name = "FILE")]
    output: Output,
    /// Format [default: the extension of the output file]
    #[arg(short, long)]
    format: Option<Format>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Format {
    /// A line per point, units in the column names
    Csv,
    /// Every array, for NumPy
    Npz,
    /// Points, for ParaView
    Vtp,
    /// Labels, for ParaView
    Vti,
    /// A series in time, for ParaView
    Pvd,
    /// Labels, for ImageJ and xct2particles
    Tiff,
}

pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let format = format(arguments)?;
    if arguments.files.len() > 1 && format != Format::Pvd {
        return Err(Failure::usage(format!(
            "{} files were given, but only pvd takes more than one",
            arguments.files.len()
        )));
    }
    let read = arguments.files.iter().map(PathBuf::as_path);
    cli::keep_apart_with_records(read, [&arguments.output])?;
    let files = by_time(arguments.files.clone());
    let files = files.map_err(|e| Failure::of_input(e.is_usage(), e))?;
    let files: Vec<ParticleFile> = files.into_iter().map(|(_, file)| file).collect();
    let inputs = (files.iter())
        .map(|f| InputRecord::new(f.name().into(), f.content_hash()))
        .collect();
    let record = Record::new(env!("CARGO_PKG_NAME"), env!("CARGO_PKG_VERSION"), inputs);
    let output = &arguments.output;
    // Several files are a series, as was checked above.
    let [file] = files.as_slice() else {
        return series::write(&files, output, &record);
    };
    match format {
        Format::Csv => {
            let points = Points::of(file)?;
            output.write_with_record(&record, |out| csv::write(&points, out))
        }
        Format::Vtp => {
            let points = Points::of(file)?;
            let time_s = file.header().time_s;
            output.write_with_record(&record, |out| vtk::write_points(&points, time_s, out))
        }
        Format::Vti => {
            let labels = labels_of(file)?;
            let time_s = file.header().time_s;
            output.write_with_record(&record, |out| vtk::write_labels(&labels, time_s, out))
        }
        Format::Tiff => {
            let labels = labels_of(file)?;
            output.write_with_record(&record, |out| labels.write_tiff(out))
        }
        Format::Npz => npz::write(file, output, &record),
        Format::Pvd => series::write(&files, output, &record),
    }
}

/// The labels of everything in `file`; says where the liquid's volume is not that of its voxels.
fn labels_of(file: &ParticleFile) -> Result<LabelVolume<'_>, Failure> {
    let labels = LabelVolume::of(file).map_err(Failure::data)?;
    let (worth, found) = labels.liquid_voxels();
    let missing = worth - found as f64;
    // Half a voxel is the rounding to whole ones.
    if missing > 0.005 * worth + 0.5 {
        cli::warn(format!(
            "{:.1} % of the liquid in '{}' is missing from the voxels: points lie outside the box or in too little space",
            100.0 * missing / worth,
            file.name()
        ));
    }
    Ok(labels)
}

/// The format asked for or else the one of the output's extension.
fn format(arguments: &Arguments) -> Result<Format, Failure> {
    if let Some(format) = arguments.format {
        return Ok(format);
    }
    let extension = match &arguments.output {
        Output::Stdout => None,
        Output::File(path) => path.extension().and_then(|e| e.to_str()),
    };
    let format = match extension {
        Some("tif" | "TIF") => Some(Format::Tiff),
        Some(name) => Format::from_str(name, true).ok(),
        None => None,
    };
    format.ok_or_else(|| {
        Failure::usage(format!(
            "cannot tell the format of {}; use --format csv, npz, vtp, vti, pvd or tiff",
            arguments.output
        ))
    })
}

/// `name` with nothing in it that means something in XML, a path or an archive.
fn plain(name: &str) -> String {
    let keep = |c: char| c.is_alphanumeric() || c == '-' || c == '_';
    name.chars()
        .map(|c| if keep(c) { c } else { '_' })
        .collect()
}
