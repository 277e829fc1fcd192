//! Permeability of a voxel volume: steady flow under a pressure difference, by the operator of a step without inertia
//! (docs/methods.md section 4).

use physics::{Boundary, VoxelBlock};
use saddle_point::{SaddleOptions, SaddleSolver, SaddleSystem};

use crate::geometry::{Chords, Lattice, Mesh};
use crate::liquid::FaceMap;
use crate::settings::{ITERATION_TOLERANCE, LINEAR_ITERATIONS};
use crate::system::{
    Channels, Coefficients, Edges, Fronts, Problem, Unknowns, Viscosities, WallCouplings, masses,
    resistance,
};

/// Relative residual of the solve. The error of the flux is a tenth of it.
const TOLERANCE: f64 = 0.1 * ITERATION_TOLERANCE;

/// A permeability, its error estimate and the open volume behind it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Permeability {
    /// Permeability found with cells of one voxel, m2.
    pub m2: f64,
    /// Permeability found with cells of two voxels, m2.
    pub coarse_m2: f64,
    /// Share of the volume that is open.
    pub porosity: f64,
    /// Share of the open volume that is connected to both sides.
    pub through: f64,
}

impl Permeability {
    /// Error estimate of `m2`, m2: its difference from the coarse value.
    pub fn error_m2(&self) -> f64 {
        (self.m2 - self.coarse_m2).abs()
    }
}

/// Permeability along `axis` (0 to 2) of the open voxels of `solid`, full of liquid that sticks to the walls. The specimen and
/// its mirror image alternate along the axis, so both sides have constant pressure and normal flow. The other `sides` are
/// mirrors or periodic.
///
/// Darcy: flux over area = permeability x pressure difference/(viscosity x length). 0 where no open voxels connect the sides.
///
/// # Errors
/// Voxels that are no cubes, sides that are open, fewer than two voxels along an axis; a flow that was not solved.
pub fn permeability(
    solid: &VoxelBlock,
    axis: usize,
    sides: Boundary,
) -> Result<Permeability, String> {
    let [edge, y, z] = solid.voxel();
    if [y, z].iter().any(|other| (other / edge - 1.0).abs() > 1e-6) {
        return Err("the voxels are not cubes: permeability needs cubes".into());
    }
    if axis > 2 || sides == Boundary::Open {
        return Err("permeability is along x, y or z, between symmetry or periodic sides".into());
    }
    if let Some(a) = (0..3).find(|&a| solid.dims()[a] < 2) {
        return Err(format!(
            "there is one voxel along {}: permeability needs two or more along every axis",
            ["x", "y", "z"][a]
        ));
    }
    let fine = Through::new(solid, axis, sides, 1);
    let coarse = Through::new(&even(solid, axis, sides), axis, sides, 2);
    let m2 = edge.powi(2);
    let volume = |weight: &dyn Fn(usize) -> f64| -> f64 {
        let pores = 0..fine.mesh.pores.len();
        pores
            // A sum of nothing is -0.
            .fold(0.0, |sum, pore| sum + weight(pore) * fine.mesh.volume(pore))
    };
    let (open, through) = (volume(&|_| 1.0), volume(&|pore| fine.fractions[pore]));
    Ok(Permeability {
        m2: fine.squares()? * m2,
        // In squares of the edge of a cell, which is two voxels.
        coarse_m2: 4.0 * coarse.squares()? * m2,
        porosity: open / fine.cells(),
        through: if open > 0.0 { through / open } else { 0.0 },
    })
}

/// The specimen, with its image beside it along axes of an odd number of voxels, which cells of two do not fill: mirrored, or
/// repeated where it is periodic. The flow is the same.
fn even(solid: &VoxelBlock, axis: usize, sides: Boundary) -> VoxelBlock {
    let dims = solid.dims();
    let at = |a: usize, i: usize| match i.checked_sub(dims[a]) {
        None => i,
        Some(i) if a != axis && sides == Boundary::Periodic => i,
        Some(i) => dims[a] - 1 - i,
    };
    let size = dims.map(|n| n * (1 + n % 2));
    VoxelBlock::from_fn(solid.origin(), solid.voxel(), size, |x, y, z| {
        solid.solid(at(0, x), at(1, y), at(2, z))
    })
}

/// The specimen followed by its mirror image, in cells of `k` voxels.
struct Through {
    axis: usize,
    lattice: Lattice,
    mesh: Mesh,
    /// Volume fraction of each pore: 1 where it is connected to both sides, else 0.
    fractions: Vec<f64>,
}

impl Through {
    fn new(solid: &VoxelBlock, axis: usize, sides: Boundary, k: usize) -> Self {
        let size = solid.dims().map(|n| n / k);
        let lattice = Lattice::of_voxels(solid, k, size, axis, sides);
        let rows = lattice.rows();
        let mesh = Mesh::whole(&lattice, rows, 0..rows.len());
        let fractions = full(&mesh, axis);
        Self {
            axis,
            lattice,
            mesh,
            fractions,
        }
    }

    fn cells(&self) -> f64 {
        self.mesh.size.iter().product::<usize>() as f64
    }

    /// Permeability in squares of the edge of a cell: the mean velocity at unit pressure gradient and unit viscosity.
    fn squares(&self) -> Result<f64, String> {
        match self.fractions.iter().any(|&fraction| fraction > 0.0) {
            true => Ok(self.flux()? / self.cells()),
            false => Ok(0.0),
        }
    }

    /// Sum over all cross-sections of the flux along the axis at unit pressure gradient.
    fn flux(&self) -> Result<f64, String> {
        let (mesh, lattice, fractions) = (&self.mesh, &self.lattice, &self.fractions);
        let channels = Channels {
            lattice,
            chords: &Chords::new(lattice),
            mesh,
            influence_length: 0.0,
        };
        let couplings =
            WallCouplings::new(&channels, &FaceMap::default(), &WallCouplings::default());
        let unknowns = Unknowns::new(mesh, fractions, &vec![false; mesh.pores.len()]);
        let viscosities = Viscosities::constant(mesh, 1.0);
        let problem = Problem {
            lattice,
            mesh,
            couplings: &couplings,
            edges: &Edges::new(mesh, lattice, &FaceMap::default(), &Edges::default()),
            unknowns: &unknowns,
            fractions,
            masses: &masses(mesh, fractions),
            viscosities: &viscosities,
            before: &[],
            speed_before: 0.0,
            end_height: 0.0,
            fronts: &Fronts::default(),
            pockets: &[],
            coefficients: Coefficients {
                dt: f64::INFINITY,
                ..Coefficients::default()
            },
        };
        let (a, g) = problem
            .velocity_block()
            .and_then(|a| Ok((a, problem.outflow()?)))
            .map_err(|e| e.to_string())?;
        let faces = || unknowns.faces.iter().map(|&face| face as usize);
        // The mean pressure falls by a unit a cell and drives the flow; the unknown p is the deviation from it.
        let driving = |face: usize| match usize::from(mesh.faces[face].axis) == self.axis {
            true => mesh.area(face),
            false => 0.0,
        };
        let driving: Vec<f64> = faces().map(driving).collect();
        let friction: Vec<f64> = faces().map(|face| resistance(&problem, face)).collect();
        let (mut u, mut p) = (vec![0.0; driving.len()], vec![0.0; unknowns.pores.len()]);
        let none = vec![0.0; p.len()];
        let system = SaddleSystem {
            a: &a,
            g: &g,
            pockets: 0,
            // A tiny compressibility fixes the mean pressure, which is otherwise undetermined.
            c: &vec![TOLERANCE * TOLERANCE; p.len()],
            friction: &friction,
            b: &driving,
            standing: &[],
            clinging: &[],
            slow: 0.0,
            volume_source: &none,
            carried: &none,
        };
        let solver = SaddleSolver::new(SaddleOptions {
            tolerance: TOLERANCE,
            max_iterations: LINEAR_ITERATIONS,
        });
        let solved = solver.solve(&system, &mut u, &mut p);
        solved.map_err(|e| e.to_string())?;
        Ok(driving.iter().zip(&u).map(|(driving, u)| driving * u).sum())
    }
}

/// Volume fractions: 1 for pores that are connected to both sides along `axis` within the specimen, or within its mirror image;
/// else 0.
fn full(mesh: &Mesh, axis: usize) -> Vec<f64> {
    let n = mesh.size[axis];
    let layer = |pore: usize| mesh.cell_indices(mesh.cell(pore))[axis];
    let mut fractions = vec![0.0; mesh.pores.len()];
    for half in [0..n / 2, n / 2..n] {
        for part in mesh.components(|pore| half.contains(&layer(pore))) {
            let reaches = |side: usize| part.iter().any(|&pore| layer(pore as usize) == side);
            if reaches(half.start) && reaches(half.end - 1) {
                part.iter().for_each(|&pore| fractions[pore as usize] = 1.0);
            }
        }
    }
    fractions
}
