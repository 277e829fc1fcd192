//! The command line, and what it asks for.

use std::path::PathBuf;

use clap::{Args, Parser};
use cli::{Failure, Output};
use units::{Axis, Density, Length, Spread, positive};

/// Replace the adhesive of a specimen by a slab between its adherends, moved apart; or lay up undamaged wood around a slab
///
/// Undamaged wood is one piece cut at --plane, or two pieces, --bottom and --top; --slab or --spread gives the adhesive.
/// The high side of the bottom piece is glued to the low side of the top piece.
#[derive(Parser)]
#[command(
    version,
    after_help = "Examples:
  build-bondline specimen.mpts -o bond.mpts
  xct2particles stack.tif --voxel 1.45um -o - | build-bondline - -o bond.mpts
  build-bondline specimen.mpts --normal z --plane 226.2um --voxels-per-cell 1 -o bond.mpts
  build-bondline --bottom a.mpts --top b.mpts --slab '55.1 um' -o bond.mpts
  build-bondline wood.mpts --plane 139.2um --turn-top 90 --spread '60 g/m2' --density '1.2 g/cm3' -o plywood.mpts"
)]
pub(crate) struct Arguments {
    /// Particle file of xct2particles with wood and adhesive, or with undamaged wood to cut
    /// at --plane; `-` is standard input
    #[arg(required_unless_present = "bottom", conflicts_with_all = ["bottom", "top"])]
    pub(crate) specimen: Option<PathBuf>,
    /// Particle file to write; `-` is standard output
    #[arg(short, long, value_name = "BOND")]
    pub(crate) output: Output,
    /// Axis across the bond: x, y or z [default: the specimen's, usually y]
    #[arg(long, value_name = "AXIS")]
    pub(crate) normal: Option<Axis>,
    /// Plane at which the wood is split: auto, or a length from the low face of the stack
    #[arg(long, value_name = "auto|LEN", default_value = "auto", value_parser = auto_or_length)]
    pub(crate) plane: AutoOr,
    /// Voxels along the edge of a grid cell; the slab is a whole number of cells thick
    #[arg(long, value_name = "N", default_value_t = 2, value_parser = clap::value_parser!(u16).range(1..=64))]
    pub(crate) voxels_per_cell: u16,
    /// Displacement of the top adherend: auto (just enough for the slab) or a length, from its place
    /// in the specimen or, for undamaged wood, from contact of the pieces
    #[arg(long, value_name = "auto|LEN", default_value = "auto", value_parser = auto_or_length)]
    pub(crate) gap: AutoOr,
    /// Largest accepted change of the adhesive volume by rounding
    #[arg(long, value_name = "PERCENT", default_value = "5%", value_parser = percent)]
    pub(crate) tolerance: f64,
    #[command(flatten)]
    pub(crate) wood: Wood,
    #[command(flatten)]
    pub(crate) common: cli::Common,
}

/// Options of undamaged wood.
#[derive(Args)]
#[command(next_help_heading = "Undamaged wood")]
pub(crate) struct Wood {
    /// Undamaged wood whose high side is glued; `-` is standard input
    #[arg(long, value_name = "SPECIMEN", requires = "top")]
    pub(crate) bottom: Option<PathBuf>,
    /// Undamaged wood whose low side is glued; `-` is standard input
    #[arg(long, value_name = "SPECIMEN", requires = "bottom")]
    pub(crate) top: Option<PathBuf>,
    /// Adhesive as the thickness of its slab
    #[arg(long, value_name = "LEN", allow_hyphen_values = true, value_parser = positive::<Length>, conflicts_with = "spread")]
    pub(crate) slab: Option<f64>,
    /// Adhesive as mass per area of one bond line
    #[arg(long, value_name = "MASS/AREA", allow_hyphen_values = true, value_parser = positive::<Spread>, requires = "density")]
    pub(crate) spread: Option<f64>,
    /// Density of the adhesive that is spread
    #[arg(long, value_name = "DENSITY", allow_hyphen_values = true, value_parser = positive::<Density>, requires = "spread")]
    pub(crate) density: Option<f64>,
    /// Turn the top piece about the bond normal, right-handed, in degrees; 90 is plywood
    #[arg(long, value_name = "DEGREES", value_parser = ["0", "90", "180", "270"])]
    pub(crate) turn_top: Option<String>,
    /// Crop pieces of unequal width, from their low corners, to the common size
    #[arg(long)]
    pub(crate) crop_to_fit: bool,
    /// Remove loose pieces of wood in front of a glued face
    #[arg(long)]
    pub(crate) drop_islands: bool,
}

impl Wood {
    pub(crate) fn quarters(&self) -> usize {
        let degrees = self.turn_top.as_deref().and_then(|text| text.parse().ok());
        degrees.map_or(0, |degrees: usize| degrees / 90)
    }

    /// Thickness of the slab asked for, m; `None` for a bonded specimen.
    pub(crate) fn slab_m(&self) -> Result<Option<f64>, Failure> {
        if let Some(slab_m) = self.slab {
            return Ok(Some(slab_m));
        }
        if let (Some(spread), Some(density)) = (self.spread, self.density) {
            return Ok(Some(spread / density));
        }
        if self.bottom.is_some() {
            return Err(Failure::usage(
                "two pieces of wood have no adhesive: give its amount with --slab, or with --spread and --density",
            ));
        }
        if self.turn_top.is_some() || self.crop_to_fit || self.drop_islands {
            return Err(Failure::usage(
                "--turn-top, --crop-to-fit and --drop-islands are for undamaged wood, with --slab or --spread",
            ));
        }
        Ok(None)
    }
}

/// A length in metres, or none for `auto`.
#[derive(Clone, Copy)]
pub(crate) struct AutoOr(pub(crate) Option<f64>);

fn auto_or_length(text: &str) -> Result<AutoOr, String> {
    if text == "auto" {
        return Ok(AutoOr(None));
    }
    let length = units::si::<Length>(text).map_err(|error| format!("{error}, or 'auto'"))?;
    Ok(AutoOr(Some(length)))
}

fn percent(text: &str) -> Result<f64, String> {
    let number = text.strip_suffix('%').map(|n| n.trim().parse::<f64>());
    match number {
        Some(Ok(percent)) if percent.is_finite() && percent >= 0.0 => Ok(percent / 100.0),
        _ => Err(format!(
            "'{text}' is not a percentage: a number of at least 0 with % is needed, e.g. 5%"
        )),
    }
}
