//! Snapshots: states of a run as particle files.

use std::path::Path;

use particle_file::{Draft, Header, Kind, ParticleFile, Provenance};
use physics::{LiquidState, Scheme, ShearRate};
use units::Axis;

use crate::begin::snapshot_name;
use crate::checkpoint::Clock;
use crate::drive::RunError;
use crate::folder::{FINAL, RunFolder};
use crate::load::swap;
use crate::request::RunFailure;
use crate::resolve::Setup;

const IDENTITY: &str = "identity";
/// Pressure on the upper body, which a clamp drives, in the step before, Pa.
const PRESSURE: &str = "pressure_pa";

/// Whether `folder` holds the final state of the run with this identity, whole.
///
/// # Errors
/// It does, but what it holds is damaged.
pub(crate) fn is_final_of(folder: &Path, identity: &str) -> Result<bool, RunFailure> {
    let Ok(file) = ParticleFile::open(folder.join(FINAL)) else {
        return Ok(false);
    };
    if file.header().attribute(IDENTITY) != Some(identity) {
        return Ok(false);
    }
    match file.check() {
        Ok(()) => Ok(true),
        Err(error) => Err(RunFailure::Data(format!(
            "the run has ended, but its final state is damaged ({error}): use --overwrite to run it again"
        ))),
    }
}

/// Writes states of one run.
pub(crate) struct SnapshotWriter<'a> {
    folder: &'a RunFolder,
    header: Header,
    /// The bond file, whose wood blocks every state repeats at their current place.
    bond: Option<ParticleFile>,
    normal: Axis,
}

impl<'a> SnapshotWriter<'a> {
    /// A writer into `folder`; wood comes from `bond` where there is one. `identity` says
    /// which run a state is of.
    pub(crate) fn new(
        folder: &'a RunFolder,
        setup: &Setup,
        bond: Option<ParticleFile>,
        by: Provenance,
        identity: &str,
    ) -> Self {
        let grid = &setup.scene.grid;
        let normal = setup.normal;
        let (voxel_m, min, max) = match &bond {
            Some(file) => (
                file.header().voxel_m,
                file.header().box_min_m,
                file.header().box_max_m,
            ),
            None => (0.5 * grid.cell_m, grid.min_m, grid.max_m()),
        };
        let mut header = Header::new(Kind::State, voxel_m, normal.index() as u8, min, max);
        if let Some(file) = &bond {
            header.attributes.clone_from(&file.header().attributes);
            header.provenance.clone_from(&file.header().provenance);
        }
        header.provenance.push(by);
        header.set_attribute("cell_m", grid.cell_m);
        header.set_attribute(IDENTITY, identity);
        header.set_attribute(
            "shear_rate_convention",
            match setup.scene.liquid.shear_rate {
                ShearRate::Paper => "paper",
                ShearRate::Rheometer => "rheometer",
            },
        );
        Self {
            folder,
            header,
            bond,
            normal,
        }
    }

    /// Writes `snapshots/NNNN.mpts` and counts it on the clock.
    pub(crate) fn write_numbered(
        &self,
        clock: &mut Clock,
        scheme: &dyn Scheme,
    ) -> Result<(), RunError> {
        self.folder.make_snapshots()?;
        self.write(&snapshot_name(clock.snapshots), clock, scheme)?;
        clock.snapshots += 1;
        Ok(())
    }

    /// Writes `final.mpts`.
    ///
    /// # Errors
    /// The file and the system's reason.
    pub(crate) fn write_final(&self, clock: &Clock, scheme: &dyn Scheme) -> Result<(), RunError> {
        self.write(FINAL, clock, scheme)
    }

    fn write(&self, name: &str, clock: &Clock, scheme: &dyn Scheme) -> Result<(), RunError> {
        let mut state = scheme.liquid();
        self.to_file_axes(&mut state);
        let mut header = self.header.clone();
        (header.time_s, header.step) = (clock.time_s, clock.step);
        header.set_attribute(PRESSURE, clock.last.pressure_top);
        let mut draft = Draft::new(header);
        let displacements = scheme.displacements();
        if let Some(bond) = &self.bond {
            // Bodies 0 and 1 of a bond scene are its bottom and top adherend.
            for (name, shift) in ["wood-bottom", "wood-top"].iter().zip(&displacements) {
                let (block, bits) = bond
                    .block_named(name)
                    .map_err(|e| RunError::Checkpoint(e.to_string()))?;
                let mut block = block.clone();
                let shift = swap(*shift, self.normal);
                block.origin_m = std::array::from_fn(|a| block.origin_m[a] + shift[a]);
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

    fn to_file_axes(&self, state: &mut LiquidState) {
        if self.normal != Axis::Y {
            for v in state.position.iter_mut().chain(&mut state.velocity) {
                *v = swap(*v, self.normal);
            }
        }
    }
}
