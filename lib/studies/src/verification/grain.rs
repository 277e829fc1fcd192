//! Flow along the grain through cells of real wood, driven by a body force, against a public code.

use voxels::{Stack, WOOD};

use super::spheres::{driven, permeability};
use super::{Measured, Scene};
use crate::case_text::CaseText;
use crate::voxels::Voxels;

/// The cube of the stack below whose void and adhesive the liquid fills: voxels along an edge, first row and first
/// column, from the first page on.
const EDGE: usize = 48;
const ROW: usize = 24;
const COLUMN: usize = 40;
const STACK: &str = "../../pipelines/examples/acer/bondline-acer-64x192x128.tif";
/// Edge of a voxel, m.
const VOXEL: f64 = 1.45e-6;
/// Permeability along the grain in squares of the edge of a voxel, by lattice Boltzmann with each voxel split
/// ever more finely (lib/studies/reference/README.md).
const PERMEABILITY: f64 = 2.941;

/// The cube joined to itself on all sides, with `n` cells along an edge and voxels of half a cell.
///
/// # Panics
/// Without the stack of the repository.
pub fn scene(n: u32) -> Scene {
    let split = n as usize / (EDGE / 2);
    let pages = pages().expect("the acer stack of pipelines/examples");
    let wood = |x: usize, y: usize, z: usize| {
        let [x, y, z] = [x, y, z].map(|i| i / split);
        pages[x][(ROW + y) * 128 + COLUMN + z] == WOOD
    };
    let voxels = Voxels::new(VOXEL / split as f64, [EDGE * split; 3], wood);
    let (porosity, edge) = (voxels.porosity(), EDGE as f64 * VOXEL);
    let darcy = PERMEABILITY * VOXEL.powi(2);
    let case = CaseText {
        title: "Flow along the grain through 48 x 48 x 48 voxels of the acer stack. Against the same voxels by lattice Boltzmann, refined.".into(),
        boundary: ["periodic"; 3],
        ..driven(voxels, edge / f64::from(n), [edge; 3], darcy)
    };
    let g = case.gravity[0];
    let name = format!("grain-n{n}");
    Scene::new(name, "lattice Boltzmann", case, move |run| {
        let found = permeability(run, porosity, g)?;
        Ok(vec![Measured::relative("permeability", found, darcy)])
    })
}

/// The first pages of the stack, along the grain.
fn pages() -> Result<Vec<Vec<u8>>, voxels::Error> {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join(STACK);
    let stack = Stack::open(&[path])?;
    let page = |z| {
        let mut page = Vec::new();
        stack.read_page(z, &mut page).map(|()| page)
    };
    (0..EDGE).map(page).collect()
}
