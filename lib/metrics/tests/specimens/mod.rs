//! Specimens whose penetration is known in closed form.
#![allow(dead_code)] // each test file uses a part

use bondline::{PlacedVoxels, Specimen};
use metrics::{Adhesive, State, Wood};
use particle_file::BitGrid;
use units::Axis;

pub const VOXEL: f64 = 1.45e-6;

pub struct Stack {
    pub wood: BitGrid,
    pub adhesive: BitGrid,
}

impl Stack {
    /// A stack from one letter per voxel: `w` wood, `a` adhesive, else void.
    pub fn new(dims: [usize; 3], letter: impl Fn(usize, usize, usize) -> char + Sync) -> Self {
        Self {
            wood: BitGrid::from_fn(dims, |x, y, z| letter(x, y, z) == 'w'),
            adhesive: BitGrid::from_fn(dims, |x, y, z| letter(x, y, z) == 'a'),
        }
    }

    pub fn state(&self, normal: Axis) -> State<'_> {
        let specimen = Specimen::new(placed(&self.wood), placed(&self.adhesive)).unwrap();
        State::of_specimen(&specimen, normal)
    }
}

/// 30 layers of wood with grooves, `t` layers of adhesive, 30 layers of wood with grooves.
pub fn slab(normal: Axis, t: usize) -> Stack {
    let mut dims = [24, 24, 24];
    dims[normal.index()] = 60 + t;
    Stack::new(dims, move |x, y, z| {
        let index = [x, y, z];
        let across = index[(normal.index() + 1) % 3];
        match index[normal.index()] {
            l if (30..30 + t).contains(&l) => 'a',
            _ if across.is_multiple_of(3) => ' ',
            _ => 'w',
        }
    })
}

pub fn placed(bits: &BitGrid) -> PlacedVoxels<'_> {
    PlacedVoxels {
        origin_m: [0.0; 3],
        voxel_m: VOXEL,
        bits: bits.view(),
    }
}

/// A state of a run: points, and the adherends of a stack parted at layer `plane` along y, the top one `gap` away.
pub struct Run {
    bottom: BitGrid,
    top: BitGrid,
    plane: usize,
    pub gap: f64,
    pub position: Vec<[f32; 3]>,
    pub volume: Vec<f32>,
}

impl Run {
    pub fn new(stack: &Stack, plane: usize, gap: f64) -> Self {
        let [nx, ny, nz] = stack.wood.dims();
        Self {
            bottom: BitGrid::from_fn([nx, plane, nz], |x, y, z| stack.wood.get(x, y, z)),
            top: BitGrid::from_fn([nx, ny - plane, nz], |x, y, z| {
                stack.wood.get(x, y + plane, z)
            }),
            plane,
            gap,
            position: Vec::new(),
            volume: Vec::new(),
        }
    }

    /// The same, with the adhesive voxels of the stack as points that moved with the adherends.
    pub fn of(stack: &Stack, plane: usize, gap: f64) -> Self {
        let mut run = Self::new(stack, plane, gap);
        stack.adhesive.view().for_each(|index| {
            let mut place = index.map(|i| i as f64 + 0.5);
            place[1] += if index[1] >= plane { gap / VOXEL } else { 0.0 };
            run.add(place);
        });
        run
    }

    /// Adds a point of one voxel's volume at `place` in voxels.
    pub fn add(&mut self, place: [f64; 3]) {
        self.position.push(place.map(|x| (x * VOXEL) as f32));
        self.volume.push(VOXEL.powi(3) as f32);
    }

    pub fn state(&self) -> State<'_> {
        let [nx, top_layers, nz] = self.top.dims();
        let mut top = placed(&self.top);
        top.origin_m[1] = self.plane as f64 * VOXEL + self.gap;
        let height = (self.plane + top_layers) as f64 * VOXEL + self.gap;
        State {
            normal: Axis::Y,
            voxel_m: VOXEL,
            box_min_m: [0.0; 3],
            box_max_m: [nx as f64 * VOXEL, height, nz as f64 * VOXEL],
            wood: Wood::Parted {
                bottom: placed(&self.bottom),
                top,
            },
            adhesive: Adhesive::Points {
                position: &self.position,
                volume: &self.volume,
            },
        }
    }
}

pub fn close(a: f64, b: f64, relative: f64) -> bool {
    (a - b).abs() <= relative * a.abs().max(b.abs())
}
