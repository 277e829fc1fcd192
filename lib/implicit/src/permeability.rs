//! Permeability of voxels: steady flow through them by the operator of a step, under a difference of pressure.

use physics::{Boundary, VoxelBlock};
use saddle_point::{SaddleOptions, SaddleSolver, SaddleSystem};

use crate::geometry::{Chords, Lattice, Mesh};
use crate::liquid::FaceMap;
use crate::settings::MISSED;
use crate::system::{
    Channels, Edges, Fronts, Problem, Scales, Unknowns, Viscosities, WallCouplings, masses,
    resistance, stiffnesses,
};

/// Relative residual of the solve, a tenth of what a step may miss: the flux is within a tenth of it.
const TOLERANCE: f64 = 0.1 * MISSED;
/// Iterations of the solve at most, so that one that stagnates ends: more than in a step, which the next one goes on from.
const ITERATIONS: usize = 500;

/// A permeability and what it was found from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Permeability {
    /// That of the flow in cells of one voxel, m2.
    pub m2: f64,
    /// That in cells of two voxels, m2.
    pub coarse_m2: f64,
    /// Share of the volume that is open.
    pub porosity: f64,
    /// Share of it through which liquid flows from side to side.
    pub through: f64,
}

impl Permeability {
    /// What is to be thought of as the error of `m2`, m2: its distance from that in cells of two voxels.
    pub fn error_m2(&self) -> f64 {
        (self.m2 - self.coarse_m2).abs()
    }
}

/// Permeability along `axis` (0 to 2) of what `solid` leaves open, all of it full of liquid that sticks to the walls, between two
/// sides at constant pressures that it crosses at right angles, as if the specimen and its mirror image took turns. The other
/// `sides` are mirrors or periodic. A last layer of an odd number of voxels is left out.
///
/// Darcy: flux over area = permeability x difference of pressure/(viscosity x length). 0 where nothing leads through.
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
        return Err("the voxels are no cubes: a permeability is found of cubes alone".into());
    }
    if axis > 2 || sides == Boundary::Open {
        return Err(
            "a permeability is along x, y or z, between sides that mirror or are periodic".into(),
        );
    }
    if let Some(a) = (0..3).find(|&a| solid.dims()[a] < 2) {
        return Err(format!(
            "there is one voxel along {}: a permeability takes two or more along every axis",
            ["x", "y", "z"][a]
        ));
    }
    let [fine, coarse] = [1, 2].map(|k| Through::new(solid, axis, sides, k));
    let m2 = edge.powi(2);
    let volume = |weight: &dyn Fn(usize) -> f64| -> f64 {
        let pores = 0..fine.mesh.pores.len();
        pores
            .map(|pore| weight(pore) * fine.mesh.volume(pore))
            .sum()
    };
    let (open, through) = (volume(&|_| 1.0), volume(&|pore| fine.fractions[pore]));
    Ok(Permeability {
        m2: fine.squares()? * m2,
        // Cells of two voxels have an edge of two.
        coarse_m2: 4.0 * coarse.squares()? * m2,
        porosity: open / fine.cells(),
        through: if open > 0.0 { through / open } else { 0.0 },
    })
}

/// Voxels and their mirror image behind them, in cells of `k` voxels.
struct Through {
    axis: usize,
    lattice: Lattice,
    mesh: Mesh,
    /// 1 of pores that a way leads through from side to side.
    fractions: Vec<f64>,
}

impl Through {
    fn new(solid: &VoxelBlock, axis: usize, sides: Boundary, k: usize) -> Self {
        // Both sizes of cells see the same voxels.
        let size = solid.dims().map(|n| n / 2 * 2 / k);
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

    /// Permeability in squares of the edge of a cell: the mean flux of steady flow at a unit of pressure per cell and of viscosity.
    fn squares(&self) -> Result<f64, String> {
        match self.fractions.iter().any(|&fraction| fraction > 0.0) {
            true => Ok(self.flux()? / self.cells()),
            false => Ok(0.0),
        }
    }

    /// Sum of the fluxes through all sections.
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
        let halves: Vec<[f64; 2]> = (mesh.faces.iter())
            .map(|face| face.ends().map(|pore| fractions[pore]))
            .collect();
        let viscosities = Viscosities::constant(mesh, 1.0);
        let problem = Problem {
            lattice,
            mesh,
            couplings: &couplings,
            edges: &Edges::new(mesh, lattice, &FaceMap::default(), &Edges::default()),
            unknowns: &unknowns,
            fractions,
            halves: &halves,
            masses: &masses(mesh, &halves),
            stiffnesses: &stiffnesses(mesh, &halves, &viscosities),
            viscosities: &viscosities,
            before: &[],
            speed_before: 0.0,
            end_height: 0.0,
            fronts: &Fronts::default(),
            pockets: &[],
            scales: Scales {
                dt: f64::INFINITY,
                ..Scales::default()
            },
        };
        let (a, g) = problem
            .velocity_block()
            .and_then(|a| Ok((a, problem.outflow()?)))
            .map_err(|e| e.to_string())?;
        let faces = || unknowns.faces.iter().map(|&face| face as usize);
        // A pressure that falls by a unit a cell pushes: what is solved for is what pressures differ from it.
        let push = |face: usize| match usize::from(mesh.faces[face].axis) == self.axis {
            true => mesh.area(face),
            false => 0.0,
        };
        let push: Vec<f64> = faces().map(push).collect();
        let friction: Vec<f64> = faces().map(|face| resistance(&problem, face)).collect();
        let (mut u, mut p) = (vec![0.0; push.len()], vec![0.0; unknowns.pores.len()]);
        let none = vec![0.0; p.len()];
        let system = SaddleSystem {
            a: &a,
            g: &g,
            pockets: 0,
            // Next to none, so that there is one mean pressure.
            c: &vec![TOLERANCE * TOLERANCE; p.len()],
            friction: &friction,
            two_eta: &vec![2.0; p.len()],
            b: &push,
            standing: &[],
            clinging: &[],
            slow: 0.0,
            volume_source: &none,
            carried: &none,
        };
        let solver = SaddleSolver::new(SaddleOptions {
            tolerance: TOLERANCE,
            max_iterations: ITERATIONS,
        });
        let solved = solver.solve(&system, &mut u, &mut p);
        solved.map_err(|e| e.to_string())?;
        Ok(push.iter().zip(&u).map(|(push, u)| push * u).sum())
    }
}

/// 1 for pores through which a way leads from side to side of the voxels along `axis` without their mirror image, or of that
/// image; 0 for others.
fn full(mesh: &Mesh, axis: usize) -> Vec<f64> {
    let n = mesh.size[axis];
    let layer = |pore: usize| mesh.place(mesh.cell(pore))[axis];
    let reached = |sides: [usize; 2]| {
        let mut seen: Vec<bool> = (0..mesh.pores.len())
            .map(|pore| sides.contains(&layer(pore)))
            .collect();
        let mut next: Vec<usize> = (0..seen.len()).filter(|&pore| seen[pore]).collect();
        while let Some(pore) = next.pop() {
            for other in mesh.neighbours(pore).map(|neighbour| neighbour.pore) {
                let mirrored = (layer(other) < n / 2) != (layer(pore) < n / 2);
                if !seen[other] && !mirrored {
                    seen[other] = true;
                    next.push(other);
                }
            }
        }
        seen
    };
    let (low, high) = (reached([0, n - 1]), reached([n / 2 - 1, n / 2]));
    let both = low.iter().zip(high).map(|(low, high)| *low && high);
    both.map(|both| f64::from(u8::from(both))).collect()
}
