//! Shear rates of a flow, and the viscosities that follow from them (docs/methods.md section 3.8).

use physics::{ShearRate, Viscosity};
use rayon::prelude::*;

use super::couplings::WallCouplings;
use super::edges::Edges;
use super::stretching::stretching;
use super::thinning::{Channel, FlowCurve};
use crate::geometry::{Mesh, Neighbour, others};

/// Viscosities over their unit: of each pore, at the walls of the two halves of each face, and at each edge. The latter two are
/// empty where the viscosities of the pores apply.
#[derive(Clone, Debug, Default)]
pub(crate) struct Viscosities {
    pub(crate) pores: Vec<f64>,
    pub(crate) walls: Vec<[f64; 2]>,
    pub(crate) edges: Vec<f64>,
}

impl Viscosities {
    /// One viscosity everywhere.
    pub(crate) fn constant(mesh: &Mesh, viscosity: f64) -> Self {
        Self {
            pores: vec![viscosity; mesh.pores.len()],
            ..Self::default()
        }
    }

    /// Viscosities at the walls of the two halves of a face; `ends` are its pores.
    pub(super) fn at_walls(&self, face: usize, ends: [usize; 2]) -> [f64; 2] {
        let own = self.walls.get(face).copied();
        own.unwrap_or_else(|| ends.map(|pore| self.pores[pore]))
    }

    /// Viscosities at the `rates` of a flow: `factor` times the `law` (Pa s). That at walls
    /// is the stress over the rate of a Newtonian liquid; `slip` is the influence length, cells.
    pub(crate) fn of(rates: &Rates, law: &Viscosity, factor: f64, slip: f64) -> Self {
        let at = |rate: f64| factor * law.at(rate);
        let curve = FlowCurve::new(law);
        let wall = |wall: &WallShear| match wall.rate > 0.0 {
            true => {
                let rate = curve.wall_rate(&wall.channel, slip, wall.rate);
                [rate / wall.rate * at(rate); 2]
            }
            false => [at(0.0); 2],
        };
        Self {
            pores: rates.pores.par_iter().map(|&rate| at(rate)).collect(),
            walls: rates.walls.par_iter().map(wall).collect(),
            edges: rates.edges.par_iter().map(|&rate| at(rate)).collect(),
        }
    }

    /// The viscosities times a `factor` of each pore; edges take the mean of the four pores around.
    pub(crate) fn thickened(&self, mesh: &Mesh, edges: &Edges, factor: &[f64]) -> Self {
        let mut thick = self.clone();
        if !thick.edges.is_empty() {
            for face in 0..mesh.faces.len() {
                for (index, edge) in edges.of(face).iter().enumerate() {
                    let around = [face, edge.next as usize].map(|face| mesh.faces[face].pores());
                    let sum: f64 = around.as_flattened().iter().map(|&pore| factor[pore]).sum();
                    thick.edges[edges.first(face) + index] *= 0.25 * sum;
                }
            }
        }
        let pores = thick.pores.par_iter_mut().zip(factor);
        pores.for_each(|(viscosity, factor)| *viscosity *= factor);
        let walls = thick.walls.par_iter_mut().zip(&mesh.faces);
        walls.for_each(|(viscosity, face)| {
            viscosity[0] *= factor[face.low as usize];
            viscosity[1] *= factor[face.high as usize];
        });
        thick
    }
}

/// Shear at the walls of a face: the rate that a Newtonian liquid has, 1/s, the area, and the channel.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct WallShear {
    pub(super) rate: f64,
    /// Wall area, square cells.
    area: f64,
    channel: Channel,
}

/// Shear rates by the scene's convention, 1/s: of each pore and edge, and at the walls of each face.
#[derive(Clone, Debug, Default)]
pub(crate) struct Rates {
    pub(crate) pores: Vec<f64>,
    pub(super) edges: Vec<f64>,
    pub(super) walls: Vec<WallShear>,
}

impl Rates {
    /// The rates of pores, edges and walls.
    pub(super) fn values_mut(&mut self) -> impl Iterator<Item = &mut f64> {
        let walls = self.walls.iter_mut().map(|wall| &mut wall.rate);
        self.pores.iter_mut().chain(&mut self.edges).chain(walls)
    }

    /// Viscous dissipation in each pore with these viscosities, and at the walls of each face, which may differ from its pores.
    /// `slip` is the influence length, cells.
    pub(crate) fn power(
        &self,
        viscosities: &Viscosities,
        mesh: &Mesh,
        fractions: &[f64],
        slip: f64,
    ) -> Vec<f64> {
        let in_pore = |pore: usize| {
            let stress = viscosities.pores[pore] * self.pores[pore];
            stress * self.pores[pore] * mesh.volume(pore) * fractions[pore]
        };
        let at_walls = |face: usize| {
            let wall = &self.walls[face];
            let [low, high] = mesh.faces[face].pores().map(|pore| fractions[pore]);
            let volume = 0.5 * (low + high) * wall.area * (wall.channel.distance + slip);
            viscosities.walls[face][0] * wall.rate.powi(2) * volume
        };
        let pores = (0..mesh.pores.len()).into_par_iter().map(in_pore);
        let faces = (0..viscosities.walls.len()).into_par_iter().map(at_walls);
        pores.chain(faces).collect()
    }
}

/// Shear rate by the convention, from the square of the rate of simple shear, 2 D:D.
fn rate_of_square(square: f64, convention: ShearRate) -> f64 {
    // The factor is of |dev D|; the rate of simple shear, sqrt(2 D:D), is sqrt(2) of it.
    convention.factor() / std::f64::consts::SQRT_2 * square.max(0.0).sqrt()
}

/// A flow with the wall couplings and edges that its shear rates depend on.
pub(crate) struct FlowField<'a> {
    pub(crate) mesh: &'a Mesh,
    pub(crate) couplings: &'a WallCouplings,
    pub(crate) edges: &'a Edges,
    /// Velocity of each face relative to the grid, cells/s.
    pub(crate) velocity: &'a [f64],
    /// Closing speed, cells/s.
    pub(crate) speed: f64,
}

impl FlowField<'_> {
    /// Shear rates of pores, edges and walls. That of a pore is the rate with its mean dissipation.
    pub(crate) fn rates(&self, convention: ShearRate, slip: f64) -> Rates {
        let (pores, parts) = self.pore_rates(convention);
        let rate = |square: f64| rate_of_square(square, convention);
        let edges = self.edges.rates(self.mesh, self.velocity, &parts);
        let faces = 0..self.mesh.faces.len();
        let own: Vec<WallShear> = (faces.clone().into_par_iter())
            .map(|face| self.wall_shear(face, slip))
            .collect();
        let wall = |face: usize| WallShear {
            rate: rate(self.wall_square(face, &own)),
            ..own[face]
        };
        Rates {
            pores,
            edges: edges.into_iter().map(rate).collect(),
            walls: faces.into_par_iter().map(wall).collect(),
        }
    }

    /// Shear rates of pores, and the parts of their squares: by stretching, and by shear about x, y, z.
    pub(crate) fn pore_rates(&self, convention: ShearRate) -> (Vec<f64>, Vec<[f64; 4]>) {
        let mesh = self.mesh;
        let sheared: Vec<[f64; 2]> = (0..mesh.faces.len())
            .into_par_iter()
            .map(|face| self.edge_dissipation(face))
            .collect();
        let (parts, walls): (Vec<[f64; 4]>, Vec<f64>) = (0..mesh.pores.len())
            .into_par_iter()
            .map(|pore| self.square_parts(pore, &sheared))
            .unzip();
        let square = |(parts, walls): (&[f64; 4], &f64)| parts.iter().sum::<f64>() + walls;
        let rates = parts.iter().zip(&walls);
        let rates = rates.map(|of| rate_of_square(square(of), convention));
        (rates.collect(), parts)
    }

    /// Dissipation over viscosity at the edges of a face, a quarter of each, summed by the axis of the edge, the lower first.
    fn edge_dissipation(&self, face: usize) -> [f64; 2] {
        let (mesh, u) = (self.mesh, self.velocity);
        let [first, _] = others(usize::from(mesh.faces[face].axis));
        let mut sums = [0.0; 2];
        for edge in self.edges.of(face) {
            let along = u[edge.next as usize] - u[face];
            if along == 0.0 {
                continue;
            }
            let [low, high] = edge.across(mesh, face).map(|face| u[face]);
            let [shear, length] = edge.geometry(mesh, face);
            let sheared = shear * along + length * (high - low);
            sums[usize::from(edge.axis(mesh, face) != first)] += 0.25 * along * sheared;
        }
        sums
    }

    /// Parts of the squared shear rate of a pore: stretching and shear about x, y, z; and that by wall friction. `sheared` is
    /// [`Self::edge_dissipation`] of each face.
    fn square_parts(&self, pore: usize, sheared: &[[f64; 2]]) -> ([f64; 4], f64) {
        let (mesh, u) = (self.mesh, self.velocity);
        let (mut parts, mut walls) = ([0.0; 4], 0.0);
        for Neighbour { face, axis, up, .. } in mesh.neighbours(pore) {
            // Terms of its low faces, or of its high ones if it has no low ones.
            if !up || mesh.faces_at(pore, axis, false).len() == 0 {
                stretching(mesh, face, !up, |term| {
                    let other = term.other.map_or(0.0, |other| u[other]);
                    let rate = other - u[face] + term.closing * self.speed;
                    parts[0] += term.weight * rate.powi(2);
                });
            }
            for (around, sheared) in others(axis).into_iter().zip(sheared[face]) {
                parts[1 + around] += sheared;
            }
            let coupling = self.couplings.of(face);
            let half = usize::from(!up);
            if coupling.friction[half] > 0.0 {
                let [own, closing] = coupling.sliding[half];
                let wall = (own + closing * self.speed) / coupling.friction[half];
                walls += coupling.friction[half] * (u[face] - wall).powi(2);
            }
        }
        let volume = mesh.volume(pore);
        (parts.map(|part| part / volume), walls / volume)
    }

    /// Square of the rate of simple shear at the walls of a face: its own, and the mean of those of other axes around it.
    fn wall_square(&self, face: usize, own: &[WallShear]) -> f64 {
        let (mesh, f) = (self.mesh, self.mesh.faces[face]);
        let mut square = own[face].rate.powi(2);
        if own[face].area == 0.0 {
            return square;
        }
        for axis in others(usize::from(f.axis)) {
            let (mut sum, mut area) = (0.0, 0.0);
            for (pore, up) in f
                .pores()
                .into_iter()
                .flat_map(|pore| [(pore, false), (pore, true)])
            {
                for wall in mesh.faces_at(pore, axis, up).map(|face| own[face]) {
                    sum += wall.area * wall.rate.powi(2);
                    area += wall.area;
                }
            }
            if area > 0.0 {
                square += sum / area;
            }
        }
        square
    }

    /// Shear at the walls of a face by its own velocity; `slip` is the influence length, cells.
    fn wall_shear(&self, face: usize, slip: f64) -> WallShear {
        let coupling = self.couplings.of(face);
        let friction: f64 = coupling.friction.iter().sum();
        if friction == 0.0 {
            return WallShear::default();
        }
        let wall: f64 = (0..2)
            .map(|half| coupling.sliding[half][0] + coupling.sliding[half][1] * self.speed)
            .sum();
        if coupling.area == 0.0 {
            // Only past a corner: the wall is a cell away.
            let channel = Channel {
                distance: 1.0,
                width: f64::INFINITY,
                ..Channel::default()
            };
            let rate = (self.velocity[face] - wall / friction).abs();
            let area = friction;
            return WallShear {
                rate,
                area,
                channel,
            };
        }
        let mesh = self.mesh;
        WallShear {
            rate: (friction * self.velocity[face] - wall).abs() / coupling.area,
            area: coupling.area,
            channel: Channel {
                distance: (coupling.area / friction - slip).max(0.0),
                width: coupling.inverse_width_squared.powf(-0.5),
                first: coupling.height / coupling.area,
                spacing: match mesh.faces[face].axis {
                    1 => 1.0,
                    _ => mesh.height(mesh.faces[face].low as usize),
                },
            },
        }
    }
}
