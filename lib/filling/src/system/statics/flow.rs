//! Steady flows without particles: all open sub-cells of a region are liquid.

use crate::geometry::{Domain, Lattice, tests};
use crate::liquid::Volumes;
use crate::system::{Before, Operator, Scales, WidthRule};
use physics::{Boundary, VoxelBlock};
use saddle_point::{SaddleOptions, SaddleSolver};

use super::staircase;

/// A scene of bodies in a domain, of unit viscosity and negligible inertia and compressibility.
pub(crate) struct Flow {
    pub(crate) domain: Domain,
    pub(crate) bodies: Vec<Vec<VoxelBlock>>,
    /// Influence length of the wall law, cells.
    pub(crate) slip: f64,
    pub(crate) width: WidthRule,
    pub(crate) gravity: [f64; 3],
    /// Adhesion tension over viscosity.
    pub(crate) adhesion: f64,
    /// How many times as thick liquid is that has dried, by the middle of its cell.
    pub(crate) factor: Option<Box<dyn Fn([f64; 3]) -> f32>>,
    pub(crate) speeds: Vec<[f64; 3]>,
    /// Of the solver.
    pub(crate) tolerance: f64,
}

/// A solved flow.
pub(crate) struct Solved {
    /// Flux along x through the low faces of each layer of cells of the window.
    through: Vec<f64>,
    pub(crate) forces: Vec<[f64; 3]>,
    pub(crate) lattice: Lattice,
    /// Pressure of each cell of the window.
    pub(crate) pressure: Vec<f64>,
}

impl Solved {
    /// Flux along x through the low faces of layer `i` of the domain's cells.
    pub(crate) fn flux_through(&self, i: usize) -> f64 {
        self.through[(i as i64 - self.lattice.window.low[0]) as usize]
    }
}

impl Flow {
    pub(crate) fn new(cells: [usize; 3], axes: usize, bodies: Vec<Vec<VoxelBlock>>) -> Self {
        Self {
            domain: tests::domain(cells, axes),
            slip: 0.0,
            width: WidthRule::Combined,
            gravity: [0.0; 3],
            adhesion: 0.0,
            factor: None,
            speeds: vec![[0.0; 3]; bodies.len()],
            bodies,
            tolerance: 1e-7,
        }
    }

    /// Flux along x per unit body force when the domain repeats along x.
    pub(crate) fn periodic_flux(&mut self) -> f64 {
        self.domain.boundary[0] = Boundary::Periodic;
        self.gravity = [1.0, 0.0, 0.0];
        self.solve(|_| true).flux_through(2)
    }

    /// The steady flow of liquid in the open sub-cells whose centre is in `wet`.
    pub(crate) fn solve(&self, wet: impl Fn([f64; 3]) -> bool) -> Solved {
        let lattice = tests::lattice(self.domain, self.bodies.clone());
        let phi = fractions(&lattice, wet);
        let liquid = Volumes::new(&lattice, &phi);
        let scales = Scales {
            inertia: 1e-9,
            compressibility: 1e-12,
            gravity: self.gravity,
            adhesion: self.adhesion,
            holding: 0.0,
            // Steps too short for pins to hold.
            cell_per_step: f64::INFINITY,
            slow: 0.0,
            influence_length: self.slip,
            width: self.width,
        };
        let mut operator = Operator::new(&lattice, &liquid, scales);
        let w = &lattice.window;
        let factor: Vec<f32> = self.factor.as_ref().map_or_else(Vec::new, |factor| {
            let middle = |cell: usize| w.corner(w.coordinates(cell)).map(|x| x + 0.5);
            (0..w.len()).map(|cell| factor(middle(cell))).collect()
        });
        operator.thicken(&factor);
        let (n, m) = (operator.dofs.faces.len(), operator.dofs.cells.len());
        operator.pull = operator.pull(&vec![0.0; n], &self.speeds);
        let before = Before {
            velocity: &vec![0.0; n],
            pressure: &vec![0.0; m],
            stiffness: &vec![1.0; m],
            lost: &[],
            air: &[],
        };
        let system = operator.assemble(&self.speeds, before).unwrap();
        let (mut u, mut p) = (vec![0.0; n], vec![0.0; m]);
        let options = SaddleOptions {
            tolerance: self.tolerance,
            ..SaddleOptions::default()
        };
        SaddleSolver::new(options)
            .solve(&system.saddle(), &mut u, &mut p)
            .unwrap();
        let forces = system.reactions(&operator.dofs.faces, &u, &p).forces;
        let mut pressure = vec![0.0; w.len()];
        for (&index, &p) in operator.dofs.cells.iter().zip(&p) {
            pressure[index as usize] = p;
        }
        let mut through = vec![0.0; w.cells[0]];
        for (&(axis, index), u) in operator
            .dofs
            .faces
            .iter()
            .zip(&u)
            .filter(|(face, _)| face.0 == 0)
        {
            let cell = w.coordinates(index as usize);
            through[cell[0]] += u * lattice.aperture(usize::from(axis), cell).open;
        }
        Solved {
            through,
            forces,
            pressure,
            lattice,
        }
    }
}

/// Liquid fraction 1 in the sub-cells of the domain whose centre is in `wet`.
fn fractions(lattice: &Lattice, wet: impl Fn([f64; 3]) -> bool) -> Vec<f32> {
    let w = &lattice.window;
    let dims = w.sub_cells();
    (0..w.sub_len())
        .map(|s| {
            let at = [s % dims[0], s / dims[0] % dims[1], s / dims[0] / dims[1]];
            let centre: [f64; 3] =
                std::array::from_fn(|a| w.low[a] as f64 + (at[a] as f64 + 0.5) / w.parts(a) as f64);
            if wet(centre) { 1.0 } else { 0.0 }
        })
        .collect()
}

/// The number farthest from zero.
pub(crate) fn worst(errors: impl IntoIterator<Item = f64>) -> f64 {
    errors
        .into_iter()
        .fold(0.0, |a: f64, e| if e.abs() > a.abs() { e } else { a })
}

/// Exact flux of a rectangular duct per pressure gradient over viscosity (White 2006, Eq. 3-48).
pub(crate) fn duct_flux(a: f64, b: f64) -> f64 {
    let (a, b) = (a.max(b), a.min(b));
    let sum: f64 = (1..200)
        .step_by(2)
        .map(f64::from)
        .map(|k| (k * std::f64::consts::PI * a / (2.0 * b)).tanh() / k.powi(5))
        .sum();
    a * b.powi(3) / 12.0 * (1.0 - 192.0 * b / (std::f64::consts::PI.powi(5) * a) * sum)
}

/// Flux of a duct of `a` x `b` cells along x over the exact one, walls off by `offset`.
pub(crate) fn duct(a: f64, b: f64, offset: [f64; 2]) -> f64 {
    let (y, z) = (2.0 + offset[0], 2.0 + offset[1]);
    let (ny, nz) = (a as usize + 5, b as usize + 5);
    let far = 99.0;
    let walls = vec![
        VoxelBlock::solid_box([-far, -far, -far], [far, y, far]),
        VoxelBlock::solid_box([-far, y + a, -far], [far, far, far]),
        VoxelBlock::solid_box([-far, y, -far], [far, y + a, z]),
        VoxelBlock::solid_box([-far, y, z + b], [far, y + a, far]),
    ];
    let mut flow = Flow::new([4, ny, nz], 3, vec![walls]);
    flow.periodic_flux() / duct_flux(a, b)
}

/// Whether voxel (j, k) of size `voxel` is in the tube of `radius` around `centre`.
fn in_tube(j: usize, k: usize, voxel: f64, radius: f64, centre: [f64; 2]) -> bool {
    let y = (j as f64 + 0.5) * voxel - centre[0];
    let z = (k as f64 + 0.5) * voxel - centre[1];
    y * y + z * z < radius * radius
}

/// Flux of a tube made of voxels over that by finite differences in the same staircase.
pub(crate) fn tube_of_voxels(radius: f64, shift: [f64; 2], voxel: f64, width: WidthRule) -> f64 {
    tube_off(radius, shift, [0.0; 2], voxel, width)
}

/// The same with the voxels `off` the cells.
pub(crate) fn tube_off(
    radius: f64,
    shift: [f64; 2],
    off: [f64; 2],
    voxel: f64,
    width: WidthRule,
) -> f64 {
    let n = (2.0 * radius).ceil() as usize + 4;
    let centre = shift.map(|s| 0.5 * n as f64 + s - 0.5);
    let voxels = (n as f64 / voxel) as usize;
    let tube = |j: usize, k: usize| in_tube(j, k, voxel, radius, centre);
    let rim = (1.0 / voxel) as usize;
    let size = voxels + 2 * rim;
    let block = VoxelBlock::from_fn(
        [-99.0, off[0] - 1.0, off[1] - 1.0],
        [999.0, voxel, voxel],
        [1, size, size],
        |_, j, k| j < rim || k < rim || !tube(j - rim, k - rim),
    );
    let mut flow = Flow::new([3, n, n], 3, vec![vec![block]]);
    flow.width = width;
    flow.periodic_flux() / (staircase::flux(voxels, tube) * voxel.powi(4))
}
