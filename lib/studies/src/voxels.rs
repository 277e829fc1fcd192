//! Scenes of voxels: wood and liquid written as a bond file, the way a scanned specimen comes.

use std::path::Path;

use particle_file::{BitGrid, Block, Draft, Header, Kind, Material, Provenance};

use crate::Result;
use crate::study::write;

/// Wood among liquid that fills all the rest of a box whose low corner is the origin.
#[derive(Clone, Debug)]
pub(crate) struct Voxels {
    /// Edge of a voxel, m.
    edge: f64,
    dims: [usize; 3],
    wood: BitGrid,
}

impl Voxels {
    /// A box of `dims` voxels with wood where `wood(x, y, z)` says so.
    pub(crate) fn new(
        edge: f64,
        dims: [usize; 3],
        wood: impl Fn(usize, usize, usize) -> bool + Sync,
    ) -> Self {
        let wood = BitGrid::from_fn(dims, wood);
        Self { edge, dims, wood }
    }

    /// Share of the box that is liquid.
    pub(crate) fn porosity(&self) -> f64 {
        1.0 - self.wood.count() as f64 / self.dims.iter().product::<usize>() as f64
    }

    /// Writes the bond file, the wood of the lower half along y as the lower adherend.
    pub(crate) fn write(&self, path: &Path) -> Result<()> {
        let half = self.dims[1] / 2;
        let part = |top: bool| {
            BitGrid::from_fn(self.dims, |x, y, z| {
                self.wood.get(x, y, z) && (y >= half) == top
            })
        };
        let liquid = BitGrid::from_fn(self.dims, |x, y, z| !self.wood.get(x, y, z));
        let parts = [
            ("wood-bottom", Material::Rigid, part(false)),
            ("wood-top", Material::Rigid, part(true)),
            ("adhesive", Material::Adhesive, liquid),
        ];
        let high = self.dims.map(|n| n as f64 * self.edge);
        let mut header = Header::new(Kind::Bond, self.edge, 1, [0.0; 3], high);
        header.set_attribute("gap_m", 0.0);
        let version = env!("CARGO_PKG_VERSION");
        let made = Provenance::of_process(env!("CARGO_PKG_NAME"), version, Vec::new());
        header.provenance.push(made);
        let mut draft = Draft::new(header);
        for (name, material, bits) in &parts {
            let block = Block::new(name, *material, [0.0; 3], self.edge, bits);
            draft = draft.block(block, bits);
        }
        let mut bytes = Vec::new();
        draft.write_to(&mut bytes)?;
        write(path, bytes)
    }
}
