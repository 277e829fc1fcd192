//! Points, their law, and what they give to and take from the nodes.

use physics::{Liquid, Newtonian, TAIT_C};

use super::tiles::Tile;
use crate::fields::point::J;
use crate::gradient::Gradient;
use crate::lanes::{Lanes4, Lanes8, first_eight, transposed, transposed_eight};
use crate::lattice::{EDGE, HALO, nearest, window};
use crate::real::{Real, exp_m1, exp_m1_of_eight};
use crate::runs::{reorder, run_end, run_order};
use crate::settings::ShapeFunction;
use crate::simd::Kernel;
use crate::tiles::base_of;
use crate::window::{
    BATCH, NOTHING, Sides, add, differences, gather, gather_lane, nodal, of_point, offsets, spread,
};

/// A material point on its way to another tile.
#[derive(Clone, Copy, Debug)]
pub(super) struct Point {
    pub(super) id: u32,
    pub(super) place: Lanes4,
    pub(super) motion: Lanes4,
    pub(super) stress: Lanes8,
}

/// The points of a tile in lists of equal length.
#[derive(Clone, Debug, Default)]
pub(super) struct Points {
    pub(super) id: Vec<u32>,
    /// Where a point's 3 x 3 x 3 nodes begin in the halo of the tile.
    window: Vec<u16>,
    /// Offset from the nearest node, and mass.
    pub(super) place: Vec<Lanes4>,
    /// Velocity and j = J - 1.
    pub(super) motion: Vec<Lanes4>,
    /// xx yy zz xy xz yz, and two lanes not used.
    stress: Vec<Lanes8>,
    /// Displacement in this step, 0 beside it, where a place has the mass.
    shift: Vec<Lanes4>,
    gradient: Gradient,
}

impl Points {
    /// Adds a point with its nearest node, counted from the lowest of the tile.
    pub(super) fn push(&mut self, node: [i32; 3], point: Point) {
        self.id.push(point.id);
        self.window.push(base_of(node));
        self.place.push(point.place);
        self.motion.push(point.motion);
        self.stress.push(point.stress);
        self.shift.push(Lanes4::ZERO);
    }

    /// Takes out point `p`; the last one takes its place.
    fn swap_remove(&mut self, p: usize) -> Point {
        self.window.swap_remove(p);
        self.shift.swap_remove(p);
        Point {
            id: self.id.swap_remove(p),
            place: self.place.swap_remove(p),
            motion: self.motion.swap_remove(p),
            stress: self.stress.swap_remove(p),
        }
    }

    /// Brings the points of each node together where moves have scattered them.
    pub(super) fn gather_runs(&mut self) {
        if let Some(order) = run_order(&self.window) {
            reorder(&mut self.id, &order);
            reorder(&mut self.window, &order);
            reorder(&mut self.place, &order);
            reorder(&mut self.motion, &order);
            reorder(&mut self.stress, &order);
        }
    }

    /// The nearest node of point `p`, from the lowest of the tile.
    pub(super) fn node(&self, p: usize) -> [i32; 3] {
        let w = usize::from(self.window[p]);
        [w % HALO, w / HALO % HALO, w / (HALO * HALO)].map(|x| x as i32)
    }

    /// The same after it has moved, to which its offset then refers.
    #[inline(never)]
    fn find_node(&mut self, p: usize) -> [i32; 3] {
        let mut node = self.node(p);
        for (a, n) in node.iter_mut().enumerate() {
            let d = &mut self.place[p].0[a];
            if *d >= 0.5 {
                *d -= 1.0;
                *n += 1;
            } else if *d < -0.5 {
                *d += 1.0;
                *n -= 1;
            }
        }
        node
    }
}

/// Step 2: mass m S, momentum m v S, impulse of the stress -dt V sigma grad S and volume V S of the
/// points, summed at the nodes of a tile's halo.
pub(super) struct PointsToNodes<'a> {
    pub(super) tile: &'a mut Tile,
    /// s/m.
    pub(super) dt_over_cell: Real,
}

impl Kernel for PointsToNodes<'_> {
    #[inline(always)]
    fn run<const FMA: bool>(self) {
        let Tile { points, halo, .. } = self.tile;
        halo.fill(Lanes8::ZERO);
        let n = points.id.len();
        let (places, motions) = (&points.place[..n], &points.motion[..n]);
        let (stresses, windows) = (&points.stress[..n], &points.window[..n]);
        let mut start = 0;
        while start < n {
            // All points of a node, by up to eight.
            let (end, mut sums) = (run_end(windows, start), NOTHING);
            while start < end {
                let batch = start..end.min(start + BATCH);
                let d = offsets::<FMA>(&places[start..]);
                let sides = Sides::new::<3, FMA>(ShapeFunction::Gimp, &d);
                for (i, p) in batch.enumerate() {
                    let ([.., mass], [vx, vy, vz, j]) = (places[p].0, motions[p].0);
                    let volume = mass * (1.0 + j);
                    let stress = stresses[p].scaled::<FMA>(-self.dt_over_cell * volume);
                    let [xx, yy, zz, xy, xz, yz, ..] = stress.0;
                    let [px, py, pz] = [mass * vx, mass * vy, mass * vz];
                    let x = Lanes8([px, py, pz, mass, 0.0, 0.0, 0.0, volume]);
                    let stress = [
                        Lanes8([0.0, 0.0, 0.0, 0.0, xx, xy, xz, 0.0]),
                        Lanes8([0.0, 0.0, 0.0, 0.0, xy, yy, yz, 0.0]),
                        Lanes8([0.0, 0.0, 0.0, 0.0, xz, yz, zz, 0.0]),
                    ];
                    let (w, g) = (of_point(&sides.w, i), of_point(&sides.g, i));
                    spread::<3, FMA>(&mut sums, (&w, &g), x, stress);
                }
                start = end.min(start + BATCH);
            }
            nodal::<3, FMA>(&mut sums);
            let first = usize::from(windows[end - 1]);
            add::<3, FMA>(&mut halo[first..first + window(3)], &sums);
        }
    }
}

/// Step 6: velocity and displacement of a tile's points, and the gradient of velocity there; `halo`
/// holds the velocities of the nodes. FLIP adds the nodes' change of velocity; the displacement is by
/// their velocity in the middle of that change.
pub(super) struct NodesToPoints<'a> {
    pub(super) tile: &'a mut Tile,
    /// s/m.
    pub(super) dt_over_cell: Real,
}

impl Kernel for NodesToPoints<'_> {
    #[inline(always)]
    fn run<const FMA: bool>(self) {
        let Tile { points, halo, .. } = self.tile;
        let n = points.id.len();
        let (places, windows) = (&points.place[..n], &points.window[..n]);
        let (motion, shift) = (&mut points.motion[..n], &mut points.shift[..n]);
        points.gradient.resize(n);
        let scale = Lanes8([self.dt_over_cell; BATCH]);
        let mut start = 0;
        while start < n {
            let (first, end) = (usize::from(windows[start]), run_end(windows, start));
            let field = differences::<3, FMA>(&halo[first..first + window(3)]);
            while start < end {
                let batch = start..end.min(start + BATCH);
                let sides =
                    Sides::new::<3, FMA>(ShapeFunction::Gimp, &offsets::<FMA>(&places[start..]));
                let old = transposed::<FMA>(&first_eight(&motion[start..]));
                // New velocity and j, displacement.
                let mut fields = [Lanes8::ZERO; 8];
                fields[J] = old[J];
                for c in 0..3 {
                    let (after, slopes) = gather::<3, FMA>(&field, c, &sides);
                    let change = gather_lane::<3, FMA>(&field, 4 + c, &sides.w);
                    points.gradient.set(start, c, &slopes);
                    fields[c] = old[c].plus::<FMA>(change);
                    let travel = after.add_product::<FMA>(Lanes8([-0.5; BATCH]), change);
                    fields[4 + c] = travel.times::<FMA>(scale);
                }
                let list = transposed_eight::<FMA>(&fields);
                let ends = motion[batch.clone()]
                    .iter_mut()
                    .zip(&mut shift[batch.clone()]);
                for ((motion, shift), end) in ends.zip(&list) {
                    (*motion, *shift) = (end.low(), end.high());
                }
                start = batch.end;
            }
        }
    }
}

/// The liquid's law (paper Eqs. 1 and 2), its constants over the density.
pub(super) struct Law {
    /// C K, m2/s2.
    stiffness: Real,
    /// m2/s.
    viscosity: Real,
    /// Cells per metre.
    per_cell: Real,
}

impl Law {
    pub(super) fn new(liquid: &Liquid, viscosity: Newtonian, cell: f64) -> Self {
        Self {
            stiffness: (TAIT_C * liquid.tait.bulk_modulus / liquid.density) as Real,
            viscosity: (viscosity.0 / liquid.density) as Real,
            per_cell: (1.0 / cell) as Real,
        }
    }

    /// Eq. 1, p = C K (exp((1 - J)/C) - 1).
    #[inline(always)]
    pub(super) fn pressure(&self, j: Real) -> Real {
        self.stiffness * exp_m1(-j * (1.0 / TAIT_C) as Real)
    }

    /// The same of eight points.
    #[inline(always)]
    fn pressures<const FMA: bool>(&self, j: Lanes8) -> Lanes8 {
        let strain = j.scaled::<FMA>(-1.0).scaled::<FMA>((1.0 / TAIT_C) as Real);
        exp_m1_of_eight::<FMA>(strain).scaled::<FMA>(self.stiffness)
    }
}

/// Step 7: volume change and stress, 2 eta D' - p, of a tile's points.
pub(super) struct Stresses<'a> {
    pub(super) tile: &'a mut Tile,
    pub(super) law: &'a Law,
    /// s.
    pub(super) dt: Real,
}

impl Kernel for Stresses<'_> {
    #[inline(always)]
    fn run<const FMA: bool>(self) {
        let Self { tile, law, dt } = self;
        let points = &mut tile.points;
        let n = points.id.len();
        let (motion, stress) = (&mut points.motion[..n], &mut points.stress[..n]);
        let mut start = 0;
        while start < n {
            let end = n.min(start + BATCH);
            let mut j = Lanes8::ZERO;
            for p in start..end {
                j.0[p - start] = motion[p].0[J];
            }
            let [x, y, z] = points.gradient.of_eight(start);
            let trace = x[0].plus::<FMA>(y[1]).plus::<FMA>(z[2]);
            let trace = trace.scaled::<FMA>(law.per_cell);
            let now = Lanes8([1.0; BATCH]).plus::<FMA>(j);
            let j = j.plus::<FMA>(now.times::<FMA>(trace.scaled::<FMA>(dt)));
            let pressure = law.pressures::<FMA>(j);
            let mut third = trace;
            for third in &mut third.0 {
                *third /= 3.0;
            }
            let mut fields = [
                x[0],
                y[1],
                z[2],
                x[1].plus::<FMA>(y[0]),
                x[2].plus::<FMA>(z[0]),
                y[2].plus::<FMA>(z[1]),
                Lanes8::ZERO,
                Lanes8::ZERO,
            ];
            let k = 2.0 * law.viscosity;
            for a in 0..3 {
                let rate = fields[a].scaled::<FMA>(law.per_cell).minus::<FMA>(third);
                fields[a] = rate.scaled::<FMA>(k).minus::<FMA>(pressure);
                let half = fields[3 + a].scaled::<FMA>(0.5 * law.per_cell);
                fields[3 + a] = half.scaled::<FMA>(k);
            }
            let new = transposed_eight::<FMA>(&fields);
            for p in start..end {
                motion[p].0[J] = j.0[p - start];
                stress[p] = new[p - start];
            }
            start = end;
        }
    }
}

/// Step 8: moves a tile's points, those that come nearest to another tile's node into `leaving`.
pub(super) struct Moves<'a>(pub(super) &'a mut Tile);

impl Kernel for Moves<'_> {
    #[inline(always)]
    fn run<const FMA: bool>(self) {
        let Tile {
            points, leaving, ..
        } = self.0;
        let mut p = 0;
        while p < points.id.len() {
            let d = points.place[p].plus::<FMA>(points.shift[p]);
            points.place[p] = d;
            if d.is_within(nearest(3)) {
                p += 1;
                continue;
            }
            let node = points.find_node(p);
            if node.iter().all(|n| (0..EDGE as i32).contains(n)) {
                points.window[p] = base_of(node);
                p += 1;
            } else {
                leaving.push((node, points.swap_remove(p)));
            }
        }
    }
}
