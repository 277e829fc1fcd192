//! Points, their law, and what they give to and take from the nodes.

use physics::{Liquid, Newtonian, TAIT_C};

use super::tiles::Tile;
use crate::lanes::{Oct, Quad};
use crate::lattice::{EDGE, HALO};
use crate::real::{Real, exp_m1};
use crate::simd::Kernel;

/// A material point.
#[derive(Clone, Copy, Debug)]
pub(super) struct Point {
    pub(super) id: u32,
    /// Where its 3 x 3 x 3 nodes begin in the halo of its tile.
    pub(super) window: u32,
    /// Offset from its nearest node, and mass.
    pub(super) place: Quad,
    /// Velocity and j = J - 1.
    pub(super) motion: Quad,
    /// xx yy zz xy xz yz.
    pub(super) stress: [Real; 6],
}

impl Point {
    /// Its nearest node, from the lowest of its tile.
    pub(super) fn node(&self) -> [i32; 3] {
        let w = self.window as usize;
        [w % HALO, w / HALO % HALO, w / (HALO * HALO)].map(|x| x as i32)
    }
}

/// Window of the node (x, y, z), each 0..4, of a tile.
pub(super) fn window(node: [i32; 3]) -> u32 {
    ((node[2] * HALO as i32 + node[1]) * HALO as i32 + node[0]) as u32
}

/// Halo entries from the first to the last node of a window, and from one layer to the next.
const LAYER: usize = HALO * HALO;
const WINDOW: usize = 2 * LAYER + 2 * HALO + 3;

/// Weights S and slopes S' (per cell) of a point at offset `d` from its nearest node on the nodes -1,
/// 0, +1 of each axis: the hat averaged over the point's box of half a cell.
#[inline(always)]
fn gimp(d: Quad) -> ([Quad; 3], [Quad; 3]) {
    let (mut w, mut g) = ([Quad::ZERO; 3], [Quad::ZERO; 3]);
    for a in 0..4 {
        // Part of the box beyond the node, at most all of it.
        let s = (d.0[a] + 0.25).clamp(0.0, 0.5);
        let t = 0.5 - s;
        w[0].0[a] = t * t + (-d.0[a] - 0.25).max(0.0);
        w[2].0[a] = s * s + (d.0[a] - 0.25).max(0.0);
        w[1].0[a] = 1.0 - w[0].0[a] - w[2].0[a];
        g[0].0[a] = -2.0 * t;
        g[2].0[a] = 2.0 * s;
        g[1].0[a] = -(g[0].0[a] + g[2].0[a]);
    }
    (w, g)
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
        halo.fill(Oct::ZERO);
        for point in points {
            let (w, g) = gimp(point.place);
            let ([.., mass], [vx, vy, vz, j]) = (point.place.0, point.motion.0);
            let volume = mass * (1.0 + j);
            let k = -self.dt_over_cell * volume;
            let [xx, yy, zz, xy, xz, yz] = point.stress.map(|s| k * s);
            let sums = [mass, mass * vx, mass * vy, mass * vz, 0.0, 0.0, 0.0, volume];
            let stress_x = Oct([0.0, 0.0, 0.0, 0.0, xx, xy, xz, 0.0]);
            let stress_y = Oct([0.0, 0.0, 0.0, 0.0, xy, yy, yz, 0.0]);
            let stress_z = Oct([0.0, 0.0, 0.0, 0.0, xz, yz, zz, 0.0]);
            let window = point.window as usize;
            let nodes = &mut halo[window..window + WINDOW];
            // The weight of a node is a product over the axes: z, then y, then x.
            for layer in 0..3 {
                let (wz, gz) = (w[layer].0[2], g[layer].0[2]);
                let sums = Oct(sums).scaled(wz).add_scaled::<FMA>(gz, stress_z);
                let (stress_y, stress_x) = (stress_y.scaled(wz), stress_x.scaled(wz));
                for row in 0..3 {
                    let (wy, gy) = (w[row].0[1], g[row].0[1]);
                    let sums = sums.scaled(wy).add_scaled::<FMA>(gy, stress_y);
                    let stress_x = stress_x.scaled(wy);
                    let at = layer * LAYER + row * HALO;
                    for i in 0..3 {
                        nodes[at + i] = nodes[at + i]
                            .add_scaled::<FMA>(w[i].0[0], sums)
                            .add_scaled::<FMA>(g[i].0[0], stress_x);
                    }
                }
            }
        }
    }
}

/// Steps 6 to 8: velocity, its gradient, j, stress and place of a tile's points. `halo` holds the
/// velocities of the nodes.
pub(super) struct NodesToPoints<'a> {
    pub(super) tile: &'a mut Tile,
    pub(super) law: &'a Law,
    /// s.
    pub(super) dt: Real,
    /// s/m.
    pub(super) dt_over_cell: Real,
}

impl Kernel for NodesToPoints<'_> {
    #[inline(always)]
    fn run<const FMA: bool>(self) {
        let Tile {
            points,
            halo,
            leaving,
        } = self.tile;
        let mut p = 0;
        while p < points.len() {
            let point = &mut points[p];
            let (value, gradient) = gather::<FMA>(halo, point);
            let [vx, vy, vz, weight, change @ .., _] = value.0;
            // Divided by the sum of the weights as it was rounded.
            let inverse = 1.0 / weight;
            let plus = [vx * inverse, vy * inverse, vz * inverse];
            for a in 0..3 {
                point.motion.0[a] += change[a];
                let travel = plus[a] - 0.5 * change[a];
                point.place.0[a] += self.dt_over_cell * travel;
            }
            self.law.update(point, &gradient, self.dt);
            let [x, y, z, _] = point.place.0;
            if x.abs() < 0.5 && y.abs() < 0.5 && z.abs() < 0.5 {
                p += 1;
                continue;
            }
            let node = nearest_node(point);
            if node.iter().all(|n| (0..EDGE as i32).contains(n)) {
                point.window = window(node);
                p += 1;
            } else {
                leaving.push((node, points.swap_remove(p)));
            }
        }
    }
}

/// Nodal velocities at a point, and their derivatives along x, y, z (per cell).
#[inline(always)]
fn gather<const FMA: bool>(halo: &[Oct], point: &Point) -> (Oct, [Oct; 3]) {
    let (w, g) = gimp(point.place);
    let window = point.window as usize;
    let nodes = &halo[window..window + WINDOW];
    let (mut value, mut slope) = (Oct::ZERO, [Oct::ZERO; 3]);
    for layer in 0..3 {
        let (mut plane, mut plane_x, mut plane_y) = (Oct::ZERO, Oct::ZERO, Oct::ZERO);
        for row in 0..3 {
            let at = layer * LAYER + row * HALO;
            let (mut line, mut line_x) = (Oct::ZERO, Oct::ZERO);
            for i in 0..3 {
                line = line.add_scaled::<FMA>(w[i].0[0], nodes[at + i]);
                line_x = line_x.add_scaled::<FMA>(g[i].0[0], nodes[at + i]);
            }
            plane = plane.add_scaled::<FMA>(w[row].0[1], line);
            plane_x = plane_x.add_scaled::<FMA>(w[row].0[1], line_x);
            plane_y = plane_y.add_scaled::<FMA>(g[row].0[1], line);
        }
        let (wz, gz) = (w[layer].0[2], g[layer].0[2]);
        value = value.add_scaled::<FMA>(wz, plane);
        slope[0] = slope[0].add_scaled::<FMA>(wz, plane_x);
        slope[1] = slope[1].add_scaled::<FMA>(wz, plane_y);
        slope[2] = slope[2].add_scaled::<FMA>(gz, plane);
    }
    (value, slope)
}

/// The nearest node of a point that has moved, from the lowest of its tile; its offset is then from there.
#[inline]
fn nearest_node(point: &mut Point) -> [i32; 3] {
    let mut node = point.node();
    for a in 0..3 {
        let d = &mut point.place.0[a];
        if *d >= 0.5 {
            *d -= 1.0;
            node[a] += 1;
        } else if *d < -0.5 {
            *d += 1.0;
            node[a] -= 1;
        }
    }
    node
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

    /// Volume change and stress, 2 eta D' - p, of a point after a step of `dt` with the velocity
    /// gradient of which `x`, `y`, `z` are the derivatives along the axes.
    #[inline(always)]
    fn update(&self, point: &mut Point, [x, y, z]: &[Oct; 3], dt: Real) {
        let trace = (x.0[0] + y.0[1] + z.0[2]) * self.per_cell;
        let j = &mut point.motion.0[3];
        *j += (1.0 + *j) * (dt * trace);
        let (k, p) = (2.0 * self.viscosity, self.pressure(*j));
        let third = trace / 3.0;
        let half = 0.5 * self.per_cell;
        point.stress = [
            k * (x.0[0] * self.per_cell - third) - p,
            k * (y.0[1] * self.per_cell - third) - p,
            k * (z.0[2] * self.per_cell - third) - p,
            k * ((x.0[1] + y.0[0]) * half),
            k * ((x.0[2] + z.0[0]) * half),
            k * ((y.0[2] + z.0[1]) * half),
        ];
    }
}
