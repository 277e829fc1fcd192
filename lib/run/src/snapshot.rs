//! Snapshots: states of a run as particle files.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

use particle_file::{Draft, Header, Kind, ParticleFile, Provenance};
use physics::{LiquidState, Scheme, ShearRate};
use units::Axis;

use crate::checkpoint::Clock;
use crate::drive::RunError;
use crate::load::swap;
use crate::resolve::Setup;

const IDENTITY: &str = "identity";

/// Whether `folder` holds the final state of the run with this identity.
pub(crate) fn is_final_of(folder: &Path, identity: &str) -> bool {
    ParticleFile::open(folder.join("final.mpts"))
        .is_ok_and(|file| file.header().attribute(IDENTITY) == Some(identity))
}

/// Writes states of one run.
pub struct SnapshotWriter {
    folder: PathBuf,
    header: Header,
    /// The bond file, whose wood blocks every state repeats at their current place.
    bond: Option<ParticleFile>,
    normal: Axis,
}

impl SnapshotWriter {
    /// A writer into `folder`; wood comes from `bond` where there is one. `identity` says
    /// which run a state is of.
    pub fn new(
        folder: &Path,
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
            folder: folder.to_owned(),
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
        let folder = self.folder.join("snapshots");
        fs::create_dir_all(&folder).map_err(RunError::write(&folder))?;
        self.write(
            &folder.join(format!("{:04}.mpts", clock.snapshots)),
            clock,
            scheme,
        )?;
        clock.snapshots += 1;
        Ok(())
    }

    /// Writes `final.mpts`.
    ///
    /// # Errors
    /// The file and the system's reason.
    pub fn write_final(&self, clock: &Clock, scheme: &dyn Scheme) -> Result<(), RunError> {
        self.write(&self.folder.join("final.mpts"), clock, scheme)
    }

    fn write(&self, path: &Path, clock: &Clock, scheme: &dyn Scheme) -> Result<(), RunError> {
        let mut state = scheme.liquid();
        self.to_file_axes(&mut state);
        let mut header = self.header.clone();
        (header.time_s, header.step) = (clock.time_s, clock.step);
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
        let draft = draft
            .column("position", 3, position)
            .column("velocity", 3, velocity)
            .column("volume", 1, &state.volume)
            .column("pressure", 1, &state.pressure)
            .column("shear_rate", 1, &state.shear_rate);
        write_whole(path, |out| draft.write_to(out))
    }

    fn to_file_axes(&self, state: &mut LiquidState) {
        if self.normal != Axis::Y {
            for v in state.position.iter_mut().chain(&mut state.velocity) {
                *v = swap(*v, self.normal);
            }
        }
    }
}

/// Writes a file beside `path` and renames it, so that `path` is whole or absent.
pub(crate) fn write_whole(
    path: &Path,
    body: impl FnOnce(&mut dyn Write) -> std::io::Result<()>,
) -> Result<(), RunError> {
    let aside = path.with_extension("tmp");
    let write = || {
        let mut out = std::io::BufWriter::with_capacity(1 << 20, fs::File::create(&aside)?);
        body(&mut out)?;
        out.into_inner().map_err(|e| e.into_error())?.sync_all()?;
        fs::rename(&aside, path)
    };
    write().map_err(|error| {
        // The failed attempt is of no use; that it cannot be removed changes nothing.
        let _ = fs::remove_file(&aside);
        RunError::write(path)(error)
    })
}
