//! Snapshots: states of a run as particle files.

use std::path::Path;

use particle_file::{BitsRef, Block, Draft, Header, IDENTITY, Kind, ParticleFile, Provenance};
use physics::{Choice, LiquidState, Scheme};
use units::Axis;

use crate::clock::Clock;
use crate::failure::RunFailure;
use crate::folder::{FINAL, RunFolder, snapshot_name};
use crate::resolve::{Setup, swap};

/// Attribute: pressure on the upper body in the last step, Pa.
const PRESSURE: &str = "pressure_pa";
/// Attribute: travel left until the clamp has closed the bond, m; in a bond file the whole travel.
const GAP: &str = "gap_m";
/// Attribute: fraction of the liquid that left through open sides.
const LEFT_FRACTION: &str = "left_through_open_sides";

/// Whether `folder` holds the undamaged final state of the run with this identity. A damaged one is an error unless
/// `replaceable`.
pub(crate) fn is_final_of(
    folder: &Path,
    identity: &str,
    replaceable: bool,
) -> Result<bool, RunFailure> {
    let Ok(file) = ParticleFile::open(folder.join(FINAL)) else {
        return Ok(false);
    };
    if file.header().attribute(IDENTITY) != Some(identity) {
        return Ok(false);
    }
    match file.check() {
        Ok(()) => Ok(true),
        Err(_) if replaceable => Ok(false),
        Err(error) => Err(RunFailure::Data(format!(
            "the run has ended, but its final state is damaged ({error}): use --overwrite to run it again"
        ))),
    }
}

/// Writes the state files of a run.
pub(crate) struct SnapshotWriter<'a> {
    folder: &'a RunFolder,
    header: Header,
    /// The bond file; every state repeats its wood blocks at their current place.
    bond: Option<&'a ParticleFile>,
    normal: Axis,
    initial_gap_m: Option<f64>,
    /// Material points of the liquid at the start.
    points: u64,
}

impl<'a> SnapshotWriter<'a> {
    /// A writer into `folder`; the wood comes from `bond`, if given. `identity` identifies the run.
    pub(crate) fn new(
        folder: &'a RunFolder,
        setup: &Setup,
        bond: Option<&'a ParticleFile>,
        by: Provenance,
        identity: &str,
    ) -> Self {
        let grid = &setup.scene.grid;
        let normal = setup.normal;
        let own = (0.5 * grid.cell_m, grid.min_m, grid.max_m());
        let (voxel_m, min, max) = bond.map_or(own, |file| {
            let header = file.header();
            (header.voxel_m, header.box_min_m, header.box_max_m)
        });
        let mut header = Header::new(Kind::State, voxel_m, normal.index() as u8, min, max);
        if let Some(file) = bond {
            header.attributes.clone_from(&file.header().attributes);
            header.provenance.clone_from(&file.header().provenance);
        }
        header.attributes.retain(|(name, _)| name != GAP);
        header.provenance.push(by);
        header.set_attribute("cell_m", grid.cell_m);
        header.set_attribute(IDENTITY, identity);
        let convention = setup.scene.liquid.shear_rate.name();
        header.set_attribute("shear_rate_convention", convention);
        Self {
            folder,
            header,
            bond,
            normal,
            initial_gap_m: setup.initial_gap_m,
            points: setup.liquid.points,
        }
    }

    /// Writes `snapshots/NNNN.mpts` and counts it in `clock`.
    pub(crate) fn write_numbered(
        &self,
        clock: &mut Clock,
        scheme: &dyn Scheme,
    ) -> Result<(), RunFailure> {
        self.folder.make_snapshots()?;
        let mut liquid = scheme.liquid();
        in_file_axes(&mut liquid, self.normal);
        let name = snapshot_name(clock.snapshots);
        self.write(&name, clock, &liquid, &scheme.displacements())?;
        clock.snapshots += 1;
        Ok(())
    }

    /// Writes the state file `name`. `state` is in the axes of the file; `displacements` (m) are those of the bodies.
    pub(crate) fn write(
        &self,
        name: &str,
        clock: &Clock,
        state: &LiquidState,
        displacements: &[[f64; 3]],
    ) -> Result<(), RunFailure> {
        let mut header = self.header.clone();
        (header.time_s, header.step) = (clock.time_s, clock.step);
        header.set_attribute(PRESSURE, clock.last_step.pressure_top);
        header.set_attribute(
            LEFT_FRACTION,
            clock.last_step.lost as f64 / self.points as f64,
        );
        if let Some(gap_m) = self.initial_gap_m {
            header.set_attribute(GAP, gap_m - clock.travel_m);
        }
        let mut draft = Draft::new(header);
        if let Some(bond) = self.bond {
            for (block, bits) in displaced_wood(bond, displacements, self.normal)? {
                draft = draft.block(block, bits);
            }
        }
        let (position, velocity) = (state.position.as_flattened(), state.velocity.as_flattened());
        let mut draft = draft
            .column("position", 3, position)
            .column("velocity", 3, velocity)
            .column("volume", 1, &state.volume)
            .column("pressure", 1, &state.pressure)
            .column("shear_rate", 1, &state.shear_rate);
        if !state.solids.is_empty() {
            draft = draft.column("solids_content", 1, &state.solids);
        }
        self.folder.write_whole(name, |out| draft.write_to(out))
    }
}

/// Turns a state from the axes of the scene to those of a file with bond normal `normal`.
pub(crate) fn in_file_axes(state: &mut LiquidState, normal: Axis) {
    if normal != Axis::Y {
        for v in state.position.iter_mut().chain(&mut state.velocity) {
            *v = swap(*v, normal);
        }
    }
}

/// Bottom and top adherend of `bond` (bodies 0 and 1 of the scene) at their current place.
pub(crate) fn displaced_wood<'a>(
    bond: &'a ParticleFile,
    displacements: &[[f64; 3]],
    normal: Axis,
) -> Result<[(Block, BitsRef<'a>); 2], RunFailure> {
    let place = |name, body: usize| -> Result<_, RunFailure> {
        let (block, bits) = bond.block_named(name)?;
        let mut block = block.clone();
        let shift = swap(displacements[body], normal);
        block.origin_m = std::array::from_fn(|a| block.origin_m[a] + shift[a]);
        Ok((block, bits))
    };
    Ok([place("wood-bottom", 0)?, place("wood-top", 1)?])
}
