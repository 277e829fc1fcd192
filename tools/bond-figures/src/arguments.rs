//! The command line of bond-figures.

use clap::{Args, Parser, Subcommand};
use cli::Output;
use figures::{Case, Colouring, Labelled, Position, Shown};
use units::{Axis, Pressure};

use crate::picture::{Look, Picture, Print};
use crate::values::{
    Extent, Target, cell, experiment, given, labelled, name, number, one_of, part, png, position,
    run, share,
};

/// Draw the figures of the pipeline and print Table 2 from the tools' output files
#[derive(Parser)]
#[command(
    version,
    after_help = "Examples:
  bond-figures pressure --run \"XPIC(5)=out/pf-xpic\" --run FLIP=out/pf-flip -o pressure.svg
  bond-figures slice start=bond.mpts end=out/pf-xpic/final.mpts --normal z -o slices.png
  bond-figures map --map experiment=exp-map.csv --width \"84 mm\" --dpi 300 -o map.png -o map.pdf
  bond-figures table2 --experiment pf=pf.csv --run pf:xpic=out/pf-xpic/wp.csv -o table2.csv"
)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    pub(crate) figure: Figure,
    #[command(flatten)]
    pub(crate) common: cli::Common,
}

#[derive(Subcommand)]
pub(crate) enum Figure {
    /// Clamping pressure and closing speed against time, with the stages of a press programme (Figs. 5 and 6)
    #[command(after_help = "Examples:
  bond-figures pressure --run \"XPIC(5)=out/pf-xpic\" --run FLIP=out/pf-flip -o pressure.svg
  bond-figures pressure --run out/pf-xpic --limit \"2.5 MPa\" --title PF -o pf.svg -o pf.png
  bond-figures pressure --run quick=history.csv -o - > pressure.svg")]
    Pressure {
        /// A run: its folder or its history.csv; may be repeated
        #[arg(long, value_name = "[LABEL=]RUNDIR", required = true, value_parser = given(labelled))]
        run: Vec<Labelled>,
        /// The run of the same LABEL in cells half as large; may be repeated. A band is drawn at equal travel of the
        /// clamps: from the coarser run's pressure over the finer one's to twice their difference beyond that, cut at
        /// zero and at the limit. (Table 2 compares the last steps, whose travels differ a little)
        #[arg(long, value_name = "LABEL=RUNDIR", value_parser = given(labelled))]
        finer: Vec<Labelled>,
        /// Draw this pressure as a dashed line [default: the pressure limit, if that of all runs]
        #[arg(long, value_name = "PRESSURE", value_parser = units::positive::<Pressure>)]
        limit: Option<f64>,
        /// Title above the figure
        #[arg(long, value_name = "TEXT")]
        title: Option<String>,
        #[command(flatten)]
        picture: Picture,
    },
    /// Weighted penetration over the bond plane (Figs. 8 and 9)
    #[command(after_help = "Examples:
  bond-figures map --map experiment=exp-map.csv --map \"XPIC(5)=xpic-map.csv\" -o map.png
  wp-metrics final.mpts --map map.csv && bond-figures map --map map.csv -o map.svg
  bond-figures map --map a.csv --map b.csv -o ab.svg -o ab.png")]
    Map {
        /// A map as `wp-metrics --map` writes; may be repeated
        #[arg(long, value_name = "[LABEL=]CSV", required = true, value_parser = given(labelled))]
        map: Vec<Labelled>,
        #[command(flatten)]
        picture: Picture,
    },
    /// Quantiles of the shear rate against time (Figs. 10 and 11)
    #[command(after_help = "Examples:
  bond-figures shear shear.csv -o shear.svg
  bond-figures shear PF=pf-shear.csv PVA-PF=pva-pf-shear.csv -o shear.png
  shear-stats out/pf/snapshots/*.mpts -o s.csv && bond-figures shear PF=s.csv -o s.svg")]
    Shear {
        /// Tables of `shear-stats`, one panel each
        #[arg(value_name = "[LABEL=]CSV", required = true, value_parser = given(labelled))]
        files: Vec<Labelled>,
        #[command(flatten)]
        picture: Picture,
    },
    /// Penetration of each side and wetted area over time, filled lumens by depth
    #[command(after_help = "Examples:
  wp-metrics --series out/press -o series.csv && bond-figures penetration series.csv -o depth.svg
  bond-figures penetration PF=pf-series.csv PVAc=pvac-series.csv -o depth.png
  bond-figures penetration --show filled depth-profile.csv -o filled.svg")]
    Penetration {
        /// Tables of `wp-metrics --series`, or runs (folder or history.csv) whose case has [output] penetration = true;
        /// for --show filled, tables of its --profile
        #[arg(value_name = "[LABEL=]CSV", required = true, value_parser = given(labelled))]
        files: Vec<Labelled>,
        /// Weighted penetration and depth of 95 % of the adhesive, or wetted area, over time; or filled share of the open
        /// lumens by depth
        #[arg(long, value_name = "WHAT", default_value = "depth", value_parser = one_of::<Shown>())]
        show: Shown,
        #[command(flatten)]
        picture: Picture,
    },
    /// Pore sizes: the share of the open volume up to each diameter
    #[command(after_help = "Examples:
  wp-metrics birch.tif --pores -o pores.csv && bond-figures pores birch=pores.csv -o pores.svg
  bond-figures pores beech=beech.csv birch=birch.csv -o species.png
  wp-metrics wood/ --pores | bond-figures pores - -o pores.pdf")]
    Pores {
        /// Tables of `wp-metrics --pores`
        #[arg(value_name = "[LABEL=]CSV", required = true, value_parser = given(labelled))]
        files: Vec<Labelled>,
        #[command(flatten)]
        picture: Picture,
    },
    /// Slices through specimens, bonds and states of a run
    #[command(after_help = "Examples:
  bond-figures slice bond.mpts -o bond.png
  bond-figures slice start=bond.mpts end=final.mpts --normal x --at 40% -o ends.png
  bond-figures slice final.mpts --at \"46.4 um\" --colour pressure -o pressure.svg
  bond-figures slice bond.mpts --part \"0 um:40 um,20 um:60 um\" --grid \"2 voxels\" -o fig3.svg")]
    Slice(SliceArgs),
    /// A result of a sweep with its error, pressure and pressing time, against each parameter
    #[command(after_help = "Examples:
  bond-figures response out/sweep/table.csv -o response.svg
  bond-figures response sweep.csv --result wp_top_um --error 8% -o ep.png
  bond-sweep collect sweep -o - | bond-figures response - -o response.svg")]
    Response {
        /// Table of `bond-sweep collect`
        #[arg(value_name = "CSV", value_parser = given(labelled))]
        sweep: Labelled,
        /// Column of the result to draw [default: entered_share with mean_depth_um, which grow with penetration;
        /// weighted penetration of a table without them]
        #[arg(long, value_name = "COLUMN")]
        result: Option<String>,
        /// Error by cell size of that result, in per cent [default: for weighted penetration and pressure the
        /// largest of the bonds of make, none for others]
        #[arg(long, value_name = "PERCENT", value_parser = share)]
        error: Option<f64>,
        #[command(flatten)]
        picture: Picture,
    },
    /// Set-up of a run: stack, slice, adherends apart, slab between them (Fig. 2)
    #[command(after_help = "Examples:
  bond-figures setup experiment.mpts bond.mpts -o setup.svg
  bond-figures setup experiment.mpts bond.mpts --width \"174 mm\" -o setup.pdf
  build-bondline exp.mpts -o bond.mpts && bond-figures setup exp.mpts bond.mpts -o setup.png")]
    Setup {
        /// Particle file of the specimen
        #[arg(value_name = "SPECIMEN", value_parser = given(labelled))]
        specimen: Labelled,
        /// Particle file of the bond made from it
        #[arg(value_name = "BOND", value_parser = given(labelled))]
        bond: Labelled,
        #[command(flatten)]
        picture: Picture,
    },
    /// Specimens, bonds and states of a run in three dimensions (Figs. 1 and 7)
    #[command(after_help = "Examples:
  bond-figures view start=bond.mpts mid=run/snapshots/0004.mpts end=run/final.mpts -o fig1.png
  bond-figures view experiment=exp.mpts FLIP=flip/final.mpts --wood hidden -o fig7.pdf
  bond-figures view final.mpts --turn -60 --tilt 40 --width \"84 mm\" --dpi 600 -o view.png")]
    View {
        /// Particle files, one panel each
        #[arg(value_name = "[LABEL=]FILE", required = true, value_parser = given(labelled))]
        files: Vec<Labelled>,
        #[command(flatten)]
        look: Look,
        #[command(flatten)]
        picture: Picture,
    },
    /// States of a run in three dimensions as an animated PNG, which browsers play
    #[command(after_help = "Examples:
  bond-figures movie out/pf-implicit -o press.png
  bond-figures movie PF=out/pf-implicit --wood hidden --rate 10 -o press.png
  bond-figures movie out/pf-implicit --turn -60 --width \"84 mm\" --dpi 150 -o small.png")]
    Movie(MovieArgs),
    /// Weighted penetration of experiment and runs, with errors (Table 2)
    #[command(after_help = "Examples:
  bond-figures table2 --experiment pf=experiment.csv --run pf:xpic=xpic.csv -o table2.csv
  bond-figures table2 --run pf:flip=flip.csv --run pva-pf:flip=pva-flip.csv -o -
  wp-metrics final.mpts -o wp.csv && bond-figures table2 --run \"pf:XPIC(5)=wp.csv\" -o -
  bond-figures table2 --run pf:implicit=wp.csv --errors errors.csv -o table2.csv
  bond-figures table2 --run pf:flip=wp.csv --name pf=PF --picture t.pdf --width \"84 mm\" -o t.csv")]
    Table2(Table2Args),
}

#[derive(Args)]
pub(crate) struct SliceArgs {
    /// Particle files, one panel each
    #[arg(value_name = "[LABEL=]FILE", required = true, value_parser = given(labelled))]
    pub(crate) files: Vec<Labelled>,
    /// Axis that the slice is normal to: x, y or z
    #[arg(long, value_name = "AXIS", default_value = "z")]
    pub(crate) normal: Axis,
    /// Position along that axis: a length, or a percentage of the box
    #[arg(long, value_name = "LEN|PERCENT", default_value = "50%", allow_hyphen_values = true,
          value_parser = position)]
    pub(crate) at: Position,
    /// Colour the adhesive: plain, or by its pressure
    #[arg(long, default_value = "plain", value_parser = one_of::<Colouring>())]
    pub(crate) colour: Colouring,
    /// Part of the slice to draw: its range to the right, then its range upwards, as lengths or voxels
    #[arg(long, value_name = "LEN:LEN,LEN:LEN", allow_hyphen_values = true, value_parser = part)]
    pub(crate) part: Option<[[Extent; 2]; 2]>,
    /// Draw the grid of a run in cells of this size (Fig. 3), a length or voxels
    #[arg(long, value_name = "LEN", value_parser = cell)]
    pub(crate) grid: Option<Extent>,
    #[command(flatten)]
    pub(crate) picture: Picture,
}

#[derive(Args)]
pub(crate) struct MovieArgs {
    /// Run folder; frames are its snapshots and its last state
    #[arg(value_name = "[LABEL=]RUNDIR", value_parser = given(labelled))]
    pub(crate) run: Labelled,
    /// Animated PNG to write; `-` is standard output
    #[arg(short, long, value_name = "PNG", value_parser = given(png))]
    pub(crate) output: Output,
    /// Frames a second, 0.1 to 60; the last frame stays for two seconds
    #[arg(long, value_name = "NUMBER", default_value = "5", value_parser = |text: &str| number(text, [0.1, 60.0]))]
    pub(crate) rate: f64,
    #[command(flatten)]
    pub(crate) look: Look,
    #[command(flatten)]
    pub(crate) print: Print,
}

#[derive(Args)]
pub(crate) struct Table2Args {
    /// Table of `wp-metrics` of an experiment; may be repeated
    #[arg(long, value_name = "ADHESIVE=CSV", required_unless_present = "run",
          value_parser = given(experiment))]
    pub(crate) experiment: Vec<Case>,
    /// Table of `wp-metrics` of a run's final state; may be repeated
    #[arg(long, value_name = "ADHESIVE:RUN=CSV", value_parser = given(run))]
    pub(crate) run: Vec<Case>,
    /// Write WP, EP and pressure extrapolated to zero cell size with their errors (from tables of
    /// `wp-metrics --finer`), and the difference of the other runs from them
    #[arg(long, value_name = "CSV")]
    pub(crate) errors: Option<Output>,
    /// Show the paper's numbers, which are of another specimen, below the table
    #[arg(long)]
    pub(crate) paper: bool,
    /// The table as a picture, .svg, .png or .pdf; may be repeated
    #[arg(long, value_name = "FILE", value_parser = given(Target::file))]
    pub(crate) picture: Vec<Target>,
    /// Name of an adhesive or a run in the picture; may be repeated
    #[arg(long, value_name = "KEY=TEXT", value_parser = name)]
    pub(crate) name: Vec<(String, String)>,
    /// CSV to write; `-` is standard output
    #[arg(short, long, value_name = "CSV")]
    pub(crate) output: Output,
    #[command(flatten)]
    pub(crate) print: Print,
}
