//! The arguments of the tool.

use std::ffi::OsString;
use std::path::PathBuf;

use clap::Parser;
use cli::Output;
use units::{Axis, Length};
use voxels::{Crop, Dims, GreyLevels, Labels, RawType};

/// Turn a stack of XCT label images into a particle file
///
/// Every voxel of wood or adhesive becomes one material point. Labels are the stored sample values, whatever colours an
/// image program shows. Where pages give one value different colours, the colours are the labels. Pages are z, rows y,
/// columns x.
#[derive(Parser)]
#[command(
    version,
    after_help = "Examples:
  xct2particles bondline.tif --voxel '1.45 um' --labels void=0,wood=128,adhesive=255 -o specimen.mpts
  xct2particles slices/ --voxel 1.45um --grey wood=90..170,adhesive=171.. -o grey.mpts
  xct2particles scan/ --voxel 1.45um --grey auto --denoise --despeckle 2 --preview look.png
  xct2particles tilted.tif --voxel 1.45um --level y -o level.mpts
  xct2particles undamaged.tif --voxel 1.45um --grey auto-wood -o wood.mpts
  xct2particles scan.raw --dims 400x394x400 --type u16 --voxel 1.45um --histogram grey.csv
  xct2particles stack.ome.tif --crop 0:200,50:250,0:100 -o - | wp-metrics -"
)]
pub(crate) struct Arguments {
    /// A multi-page TIFF, .npy, .npz, .mhd, .nrrd or .nii file, a raw volume (--dims), a folder of
    /// TIFF, BMP, PNG or JPEG slices, or several slices; `-` is standard input
    #[arg(required = true, value_name = "STACK")]
    pub(crate) stack: Vec<PathBuf>,
    /// Voxel edge [default: from the stack's metadata]
    #[arg(long, value_name = "LEN", allow_hyphen_values = true, value_parser = units::positive::<Length>)]
    pub(crate) voxel: Option<f64>,
    /// Size of a raw volume, x fastest
    #[arg(long, value_name = "XxYxZ", requires = "kind")]
    pub(crate) dims: Option<Dims>,
    /// Number type of a raw volume: u8, i16, f32 ..., little-endian; big-endian as u16be
    #[arg(long = "type", id = "kind", value_name = "TYPE", requires = "dims")]
    pub(crate) kind: Option<RawType>,
    /// Labels of each phase; several as 1|2|7, colours as R:G:B; without adhesive for undamaged wood
    /// [default: guessed if the stack holds exactly 0, 1, 2 or 0, 128, 255, or, for undamaged wood, 0, 1 or 0, 128]
    #[arg(long, value_name = "void=L,wood=L,adhesive=L", conflicts_with = "grey")]
    pub(crate) labels: Option<Labels>,
    /// Grey values of wood and adhesive, both ends included, for a stack without labels; without adhesive for undamaged
    /// wood. auto proposes them (Otsu's two thresholds) for wood darker than adhesive, auto-wood for undamaged wood (one
    /// threshold): check them by --preview
    #[arg(long, value_name = "auto|auto-wood|wood=A..B,adhesive=C..")]
    pub(crate) grey: Option<GreyLevels>,
    /// Write the number of voxels of each grey value (CSV: grey,voxels), and print what --grey auto would take
    #[arg(long, value_name = "CSV")]
    pub(crate) histogram: Option<Output>,
    /// Remove pieces of at most N voxels (connected by faces, edges or corners) as noise: they become the phase of most
    /// faces around them
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1000))]
    pub(crate) despeckle: Option<u16>,
    /// Take noise out of the grey values first, by the median of each voxel and its neighbours at faces, edges and corners.
    /// What is one voxel thin may go with it
    #[arg(long, requires = "grey")]
    pub(crate) denoise: bool,
    /// Turn the specimen until its bond plane, fitted across this axis, is level: each voxel takes the phase at its
    /// centre, the box shrinks to fit within the stack, and this axis becomes the bond normal of the file
    #[arg(long, value_name = "AXIS")]
    pub(crate) level: Option<Axis>,
    /// Draw the phases in three cuts through the middle, to check the segmentation
    #[arg(long, value_name = "PNG", value_parser = picture)]
    pub(crate) preview: Option<Output>,
    /// Box of voxels to keep; the first of a range is included, the last is not
    #[arg(long, value_name = "x0:x1,y0:y1,z0:z1")]
    pub(crate) crop: Option<Crop>,
    /// Particle file to write; `-` is standard output
    #[arg(
        short,
        long,
        value_name = "FILE",
        required_unless_present_any = ["histogram", "preview"]
    )]
    pub(crate) output: Option<Output>,
    /// Continue where two phases look exchanged, or the voxel edge is above 50 um or below 10 nm
    #[arg(long)]
    pub(crate) yes_really: bool,
    #[command(flatten)]
    pub(crate) common: cli::Common,
}

fn picture(text: &str) -> Result<Output, String> {
    match text == "-" || text.to_lowercase().ends_with(".png") {
        true => Ok(OsString::from(text).into()),
        false => Err(format!("'{text}' is no name of a PNG: it must end in .png")),
    }
}
