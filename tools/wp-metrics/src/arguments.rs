//! The command line of wp-metrics.

use std::path::PathBuf;

use clap::Parser;
use cli::Output;
use metrics::Reference;
use units::{Axis, Length};
use voxels::{Dims, GreyLevels, Labels, RawType};

/// Options that have no meaning in tables of wood.
const OF_ADHESIVE: [&str; 10] = [
    "reference",
    "normal",
    "summary",
    "map",
    "profile",
    "compare",
    "finer",
    "series",
    "pressure",
    "ignore_islands",
];

/// Measure weighted and effective penetration of adhesive
///
/// The files are states of a run, bonds, specimens (particle files) or image stacks. Weighted penetration is
/// WP = sqrt(sum V Y^2/sum V) (Eq. 6 of Hammerquist & Nairn), effective penetration EP = sum V/A, with V the volumes
/// of adhesive, Y their distances from the middle of the bond line and A the bond area. slab_wp_um is WP of an
/// unpenetrated slab of the same volume. entered_share is the share of the adhesive beyond the bond surface of its side,
/// mean_depth_um the mean depth of that below the surface.
#[derive(Parser)]
#[command(
    version,
    after_help = "Examples:
  wp-metrics run/final.mpts run/snapshots/*.mpts -o wp.csv
  wp-metrics stack.tif --voxel 1.45um --reference plane=226.2um --map map.csv --profile depth.csv
  wp-metrics scans/ -o specimens.csv --summary mean.csv
  wp-metrics run/final.mpts --compare specimen.mpts
  wp-metrics --series run -o series.csv
  wp-metrics run/final.mpts --finer run-in-half-cells/final.mpts
  wp-metrics specimen.mpts --reference fit --ignore-islands 100
  wp-metrics wood.tif --voxel 1.45um --permeability z
  wp-metrics birch.mpts beech.mpts --pores -o pores.csv"
)]
pub(crate) struct Arguments {
    /// Particle files, stacks as xct2particles reads them (raw volumes with --dims), folders
    /// of slices, or folders of particle files, one per specimen; `-` is standard input
    #[arg(required = true)]
    pub(crate) files: Vec<PathBuf>,
    /// Zero of depth: mid (midway between the bond surfaces), adherend (the bond surface of each side), fit (a tilted
    /// plane midway; adds its turns about x, y and z in degrees, right-handed, with standard errors) or plane=LEN
    #[arg(long, value_name = "WHAT", default_value = "mid", value_parser = reference)]
    pub(crate) reference: Reference,
    /// Axis across the bond: x, y or z [default: the file's, y of a stack]
    #[arg(long, value_name = "AXIS")]
    pub(crate) normal: Option<Axis>,
    /// Table to write; `-` is standard output
    #[arg(short, long, value_name = "CSV", default_value = "-")]
    pub(crate) output: Output,
    /// Write mean and standard deviation over the files, one sample each (two or more, no copies)
    #[arg(long, value_name = "CSV", conflicts_with_all = ["series", "finer"])]
    pub(crate) summary: Option<Output>,
    /// Write WP and volume of every column of voxels across the bond (one FILE only)
    #[arg(long, value_name = "CSV")]
    pub(crate) map: Option<Output>,
    /// Write adhesive and filled void against depth (of one FILE, or of each time of a series)
    #[arg(long, value_name = "CSV")]
    pub(crate) profile: Option<Output>,
    /// Add the agreement with this specimen: Dice coefficient of the adhesive voxels, correlation of the maps
    #[arg(long, value_name = "EXPERIMENT")]
    pub(crate) compare: Option<PathBuf>,
    /// Add WP, EP and pressure extrapolated to zero cell size (first order), with their errors, from STATE, the last
    /// state of the same run in cells at most half as large (one FILE only)
    #[arg(long, value_name = "STATE")]
    pub(crate) finer: Option<PathBuf>,
    /// Sort by time, and add time, gap (remaining travel of the clamp), depth of 95 % of the adhesive, wetted area,
    /// distance of the bond surfaces, depth to which the open lumens are half full, and state of the bond line
    /// (starved: less than half of the space between the bond surfaces and two voxels beyond is filled; squeezed-out: a
    /// twentieth of the adhesive has left through open sides; else filled); FILE may be a run folder
    #[arg(long)]
    pub(crate) series: bool,
    /// Add the pressure on the body that the clamp drives (of states of runs; always with --finer)
    #[arg(long)]
    pub(crate) pressure: bool,
    /// Leave out islands of adhesive of fewer than N pixels in slices normal to z, connected by edges and corners (of
    /// stacks, specimens and bonds)
    #[arg(long, value_name = "N", conflicts_with_all = ["compare", "finer", "series"])]
    pub(crate) ignore_islands: Option<usize>,
    /// Compute the permeability along this axis, x, y or z, instead: steady flow through all that is not wood, without
    /// slip on the wood, in cells of one voxel; the error is the difference from cells of two
    #[arg(long, value_name = "AXIS", conflicts_with_all = OF_ADHESIVE)]
    pub(crate) permeability: Option<Axis>,
    /// Measure pore sizes instead, for bond-figures pores: the share of the open volume up to each diameter; the pore size
    /// at a voxel is the diameter of the largest ball in the open volume that holds it
    #[arg(long, conflicts_with = "permeability", conflicts_with_all = OF_ADHESIVE)]
    pub(crate) pores: bool,
    /// With --permeability: sides parallel to the flow are periodic, not mirrors
    #[arg(long, requires = "permeability")]
    pub(crate) periodic: bool,
    /// Voxel edge of stacks [default: from their metadata]
    #[arg(long, value_name = "LEN", help_heading = "Image stacks", value_parser = units::positive::<Length>)]
    pub(crate) voxel: Option<f64>,
    /// Labels of stacks, as in void=0,wood=1|2,adhesive=255 [default: guessed]
    #[arg(long, value_name = "LABELS", help_heading = "Image stacks")]
    pub(crate) labels: Option<Labels>,
    /// Grey values of stacks, as in wood=90..170,adhesive=171..; auto and auto-wood take and print those that
    /// xct2particles proposes
    #[arg(long, value_name = "auto|auto-wood|RANGES", conflicts_with = "labels")]
    #[arg(help_heading = "Image stacks")]
    pub(crate) grey: Option<GreyLevels>,
    /// Size of stacks that are raw volumes, x fastest
    #[arg(
        long,
        value_name = "XxYxZ",
        requires = "kind",
        help_heading = "Image stacks"
    )]
    pub(crate) dims: Option<Dims>,
    /// Number type of raw volumes: u8, i16, f32 ..., little-endian; big-endian as u16be
    #[arg(long = "type", id = "kind", value_name = "TYPE", requires = "dims")]
    #[arg(help_heading = "Image stacks")]
    pub(crate) kind: Option<RawType>,
    #[command(flatten)]
    pub(crate) common: cli::Common,
}

fn reference(text: &str) -> Result<Reference, String> {
    match (text, text.strip_prefix("plane=")) {
        ("mid", _) => Ok(Reference::Mid),
        ("adherend", _) => Ok(Reference::Adherend),
        ("fit", _) => Ok(Reference::Fit),
        (_, Some(length)) => units::si::<Length>(length)
            .map(Reference::Plane)
            .map_err(|e| e.to_string()),
        _ => Err(format!(
            "'{text}' is not a reference; accepted are mid, adherend, fit and plane=LEN"
        )),
    }
}
