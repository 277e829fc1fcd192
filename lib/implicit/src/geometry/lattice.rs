//! The voxel lattice of a scene: the body in each voxel, and the motion of the bodies.

use physics::{Boundary, Dimensions, Motion, RigidBody, Scene, VoxelBlock};

use super::frames::{Frames, check_motions};
use super::rows::RowKind;

/// Code of an open voxel. Voxels of body `b` have the code `b + 1`.
pub(crate) const OPEN: u8 = 0;
/// Code of a voxel beyond a symmetry plane: neither open nor a wall.
pub(crate) const MIRROR: u8 = u8::MAX;
/// Largest distance of a body's face from the lattice, voxels, that counts as rounding in files. A larger one would displace
/// walls, a smaller one would refuse aligned bodies.
pub(super) const ALIGNMENT_TOLERANCE: f64 = 1e-3;

/// A layer of voxels at constant y: codes, x fastest.
type Layer = Vec<u8>;

/// Voxels of a scene, `k` to the edge of a cell.
#[derive(Clone, Debug)]
pub(crate) struct Lattice {
    /// Voxels along the edge of a cell: 1 or 2.
    pub(crate) k: usize,
    /// Cells along x and z.
    pub(crate) cells: [usize; 2],
    pub(crate) boundary: [Boundary; 3],
    /// Plane strain: no velocity along z.
    pub(crate) flat: bool,
    /// The three parts along y, by [`RowKind`](super::RowKind): layers below the gap, counted downwards; the gap, one layer that
    /// stands for all heights; layers above the gap, counted upwards.
    pub(crate) layers: [Vec<Layer>; 3],
    /// At the start: y of the low side of the gap, m, and the height of the gap, cells.
    pub(crate) gap_low_m: f64,
    pub(crate) gap_height: f64,
    /// The body that moves along y at the closing speed.
    pub(crate) moving: Option<Moving>,
    /// Velocity of each body as a sliding wall, cells/s, of which only the part along its walls is used.
    pub(crate) slide: Vec<[f64; 3]>,
}

/// A body that moves along y together with the grid rows on its side of the gap: down from above, or up from below.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Moving {
    pub(crate) body: usize,
    pub(crate) down: bool,
}

/// Checks that the scheme can mesh a scene, without making the mesh.
///
/// # Errors
/// A sentence on a body off the lattice, a motion that the scheme does not take, or bodies that meet within their travel.
pub fn check(scene: &Scene) -> Result<(), String> {
    checked(scene).map(|_| ())
}

/// The frames of a scene and the number of voxels along the edge of a cell.
fn checked(scene: &Scene) -> Result<(Frames, usize), String> {
    // Body codes lie between OPEN and MIRROR.
    let most = usize::from(MIRROR - OPEN) - 1;
    if scene.bodies.len() > most {
        return Err(format!(
            "the scene has {} rigid bodies; the implicit scheme accepts at most {most}",
            scene.bodies.len()
        ));
    }
    let frames = Frames::new(scene)?;
    // One voxel a cell where all faces of bodies lie on cell faces, else two.
    let k = match off_lattice(scene, &frames, scene.grid.cell_m) {
        None => 1,
        Some(_) => 2,
    };
    let edge = scene.grid.cell_m / k as f64;
    if let Some((body, a)) = off_lattice(scene, &frames, edge) {
        return Err(format!(
            "the faces of body '{}' lie off the grid along {}: with the implicit scheme a cell must be one or two \
             voxels wide, or a voxel a whole number of cells, and boxes must end on cell faces or half way between them",
            body.name,
            ["x", "y", "z"][a]
        ));
    }
    check_motions(scene, &frames)?;
    Ok((frames, k))
}

impl Lattice {
    /// The lattice of a scene.
    ///
    /// # Errors
    /// As [`check`].
    pub(crate) fn new(scene: &Scene) -> Result<Self, String> {
        let (frames, k) = checked(scene)?;
        let grid = &scene.grid;
        let edge = grid.cell_m / k as f64;
        let across = [0, 2].map(|a| grid.cells[a] * k);
        let layers = |from: f64, to: f64| {
            ((to - from) / edge + ALIGNMENT_TOLERANCE).floor().max(0.0) as usize
        };
        let [low, high] = [grid.min_m[1], grid.max_m()[1]];
        let code = |at: [f64; 3]| {
            let body = scene.bodies.iter().position(|body| body.contains(at));
            body.map_or(OPEN, |body| body as u8 + 1)
        };
        let centre = |a: usize, i: usize| grid.min_m[a] + (i as f64 + 0.5) * edge;
        let layer = |y: f64| -> Layer {
            let at = |i: usize| [centre(0, i % across[0]), y, centre(2, i / across[0])];
            (0..across[0] * across[1]).map(|i| code(at(i))).collect()
        };
        let [bottom, top] = frames.gap;
        let below = (0..layers(low, bottom)).map(|n| layer(bottom - (n as f64 + 0.5) * edge));
        let above = (0..layers(top, high)).map(|n| layer(top + (n as f64 + 0.5) * edge));
        let gap = layer(0.5 * (bottom + top));
        Ok(Self {
            k,
            cells: [grid.cells[0], grid.cells[2]],
            boundary: scene.boundary,
            flat: scene.dimensions == Dimensions::Two,
            layers: [below.collect(), vec![gap], above.collect()],
            gap_low_m: bottom,
            gap_height: (top - bottom) / grid.cell_m,
            moving: frames.moving,
            slide: (scene.bodies.iter())
                .map(|body| match body.motion {
                    Motion::Constant(v) => v.map(|v| v * (1.0 / grid.cell_m)),
                    _ => [0.0; 3],
                })
                .collect(),
        })
    }

    /// The lattice of one body at rest followed by its mirror image along `axis`: `size` cells of `k` voxels an edge from
    /// its low corner, periodic along `axis`, with these `sides` along the other axes.
    pub(crate) fn of_voxels(
        solid: &VoxelBlock,
        k: usize,
        mut size: [usize; 3],
        axis: usize,
        sides: Boundary,
    ) -> Self {
        let single = size[axis] * k;
        size[axis] *= 2;
        let mut boundary = [sides; 3];
        boundary[axis] = Boundary::Periodic;
        let [nx, ny, nz] = size.map(|n| n * k);
        let code = |mut at: [usize; 3]| {
            at[axis] = at[axis].min(2 * single - 1 - at[axis]);
            match solid.solid(at[0], at[1], at[2]) {
                true => OPEN + 1,
                false => OPEN,
            }
        };
        let layer = |y: usize| (0..nx * nz).map(|i| code([i % nx, y, i / nx])).collect();
        let layers = (0..ny).map(layer).collect();
        Self::still(k, [size[0], size[2]], boundary, layers)
    }

    /// A lattice of one body at rest without a gap, from its layers, the lowest first.
    fn still(k: usize, cells: [usize; 2], boundary: [Boundary; 3], above: Vec<Layer>) -> Self {
        Self {
            k,
            cells,
            boundary,
            flat: false,
            layers: [
                Vec::new(),
                vec![vec![OPEN; cells[0] * cells[1] * k * k]],
                above,
            ],
            gap_low_m: 0.0,
            gap_height: 0.0,
            moving: None,
            slide: vec![[0.0; 3]],
        }
    }

    /// Whether bodies stand in the gap, as the side walls of a piston do.
    pub(crate) fn gap_has_walls(&self) -> bool {
        let mut gap = self.layers[RowKind::Gap as usize].iter().flatten();
        gap.any(|&code| code != OPEN && code != MIRROR)
    }

    /// Velocity of a body along y per unit of closing speed.
    pub(crate) fn body_speed(&self, body: usize) -> f64 {
        match self.moving {
            Some(moving) if moving.body == body && moving.down => -1.0,
            Some(moving) if moving.body == body => 1.0,
            _ => 0.0,
        }
    }

    /// Velocity of the grid along y per unit of closing speed, at a fraction `share` of the gap's height ([`super::Rows`]).
    pub(crate) fn grid_speed(&self, share: f64) -> f64 {
        match self.moving {
            Some(Moving { down: true, .. }) => -share,
            Some(_) => 1.0 - share,
            None => 0.0,
        }
    }

    /// Voxels along x and z.
    pub(crate) fn layer_size(&self) -> [usize; 2] {
        self.cells.map(|n| n * self.k)
    }
}

/// A body with a face off the lattice of voxels of this `edge` (m), and the axis normal to that face.
fn off_lattice<'a>(scene: &'a Scene, frames: &Frames, edge: f64) -> Option<(&'a RigidBody, usize)> {
    let (low, high) = (scene.grid.min_m, scene.grid.max_m());
    let whole = |x: f64| (x / edge - (x / edge).round()).abs() < ALIGNMENT_TOLERANCE;
    let fits = |block: &VoxelBlock, a: usize| {
        let from = if a == 1 { frames.gap } else { [low[a]; 2] };
        let inside = |x: f64| x > low[a] && x < high[a];
        let placed = |x: f64| !inside(x) || from.iter().any(|from| whole(x - from));
        let layered = block.dims()[a] == 1 || whole(block.voxel()[a]);
        layered && placed(block.origin()[a]) && placed(block.max()[a])
    };
    let bodies = scene.bodies.iter();
    let mut each = bodies.flat_map(|body| (0..3).map(move |a| (body, a)));
    each.find(|(body, a)| !body.blocks.iter().all(|block| fits(block, *a)))
}

#[cfg(test)]
impl super::mesh::Mesh {
    /// A column of open cells between mirrors: `parts` cells below and above a closing gap of `gap` cells.
    pub(crate) fn column(parts: [usize; 2], gap: usize) -> Self {
        Self::column_from(parts, gap, 0)
    }

    /// The rows of that column from `start` on.
    pub(crate) fn column_from(parts: [usize; 2], gap: usize, start: usize) -> Self {
        Self::column_of(parts, gap, start, |size| {
            super::region::Region::new(size, true)
        })
    }

    /// The active cells of these rows.
    pub(crate) fn column_of(
        [below, above]: [usize; 2],
        gap: usize,
        start: usize,
        region: impl Fn([usize; 3]) -> super::region::Region,
    ) -> Self {
        let (body, down) = (0, true);
        let lattice = Lattice {
            layers: [below, 1, above].map(|n| vec![vec![OPEN]; n]),
            gap_height: gap as f64,
            moving: Some(Moving { body, down }),
            ..Lattice::still(1, [1, 1], [Boundary::Symmetry; 3], Vec::new())
        };
        let rows = lattice.rows();
        let range = start..rows.len();
        let region = region(Self::size_of(&lattice, &range));
        Self::new(&lattice, rows, range, region)
    }
}
