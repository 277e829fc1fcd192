//! What never changes in a run but by cure, made of the scene; and what of a scene the scheme refuses.

use physics::{Dimensions, Liquid, Points, RigidBody, Scene, WallLaw};

use super::Units;
use crate::geometry::{Domain, MAX_BODIES, Solids, Surface, Window, fill_sealed};
use crate::liquid::Particles;
use crate::settings::Settings;
use crate::stages::{Present, stages};
use crate::system::air::{Gas, Outside};
use crate::system::{Scales, WidthRule};

/// Edge of a voxel (cells) below which the steps of a wall add friction of their own.
const FINE_VOXEL: f64 = 0.75;
/// Part of the way that the liquid may go in a step, by a front, that the tolerance is relative to at least.
const SLOW: f64 = 0.01;

/// What never changes in a run; but for the unit of viscosity of a liquid that cures.
pub(super) struct Setup {
    pub(super) settings: Settings,
    pub(super) present: Present,
    pub(super) units: Units,
    pub(super) domain: Domain,
    pub(super) liquid: Liquid,
    wall: WallLaw,
    pub(super) gravity: [f64; 3],
    width: WidthRule,
    pub(super) bottom: Option<usize>,
    pub(super) top: Option<usize>,
    /// Area that pressures refer to, m2.
    pub(super) area: f64,
    /// Bodies before any displacement.
    pub(super) rest: Solids,
    /// The surface that takes water from a liquid that loses it.
    pub(super) surface: Option<Surface>,
    /// Voxels of voids that no liquid can reach, filled in.
    pub(super) sealed: u64,
    /// Air with pressures of its own, and the sides of the domain that it passes.
    pub(super) air: Option<(Gas, Outside)>,
}

impl Setup {
    /// The setup of a scene that passed [`check`], and its particles.
    ///
    /// # Errors
    /// When a point lies in a body or outside the domain.
    pub(super) fn new(scene: Scene, settings: Settings) -> Result<(Self, Particles), String> {
        let present = Present::from(&stages(&scene));
        let units = Units::new(&scene.grid, &scene.liquid, scene.initial_speed());
        let domain = Domain::new(&scene.grid, scene.boundary, scene.dimensions);
        let (width, area) = (width_rule(&scene), scene.grid.area_m2());
        let names: Vec<String> = scene.bodies.iter().map(|body| body.name.clone()).collect();
        let air = settings.air_pressure.map(|pressure| {
            let outside = Outside::new(scene.boundary, scene.clamp.is_some());
            (
                Gas::new(pressure, settings.air_leak_time, scene.liquid.tait),
                outside,
            )
        });
        let (rest, particles, sealed) = contents(scene.bodies, scene.points, domain, units)?;
        let surface = (scene.liquid.water.as_ref())
            .map(|water| Surface::new(&rest, |body| water.enters(&names[usize::from(body)])));
        let setup = Self {
            settings,
            present,
            surface,
            units,
            domain,
            liquid: scene.liquid,
            wall: scene.wall,
            gravity: scene.gravity,
            width,
            bottom: scene.bottom,
            top: scene.top,
            area,
            rest,
            sealed,
            air,
        };
        Ok((setup, particles))
    }

    /// Pressure (Pa) that forces, in the solver's unit, push a body up with.
    pub(super) fn pressure(&self, forces: &[[f64; 3]], body: usize) -> f64 {
        forces[body][1] * self.units.force() / self.area
    }

    /// Influence length of the wall law, cells; infinite without friction.
    pub(super) fn influence_length(&self) -> f64 {
        if self.present.friction {
            self.wall.influence_length() / self.units.h
        } else {
            f64::INFINITY
        }
    }

    /// Whether contact lines hold between two angles.
    pub(super) fn lines_hold(&self) -> bool {
        (self.liquid.wetting).is_some_and(|wetting| wetting.advancing != wetting.receding)
    }

    /// The window of the whole domain.
    pub(super) fn window_of_all(&self) -> Window {
        let cells = self.domain.cells.map(|n| n as i64);
        Window::around(self.domain, [0; 3], cells)
    }

    /// Scales of the terms of a step of `dt` (s).
    pub(super) fn scales(&self, dt: f64) -> Scales {
        let (h, eta) = (self.units.h, self.units.viscosity());
        let weight = self.liquid.density * h * h / eta;
        let [advancing, receding] = (self.liquid.wetting).map_or([0.0; 2], |wetting| {
            wetting.adhesion().map(|tension| tension / eta)
        });
        Scales {
            inertia: weight / dt,
            compressibility: eta / (self.liquid.tait.bulk_modulus * dt),
            gravity: self.gravity.map(|g| weight * g),
            adhesion: 0.5 * (advancing + receding),
            holding: 0.5 * (receding - advancing),
            cell_per_step: h / dt,
            slow: SLOW * self.settings.cfl * h / dt,
            influence_length: self.influence_length(),
            width: self.width,
        }
    }
}

/// Refuses what the scheme cannot do.
pub(super) fn check(scene: &Scene) -> Result<(), String> {
    if scene.points.position.is_empty() {
        return Err("the scene holds no liquid: nothing would move".into());
    }
    if scene.bodies.len() > MAX_BODIES {
        return Err(format!(
            "the scene has {} rigid bodies; the implicit scheme takes at most {MAX_BODIES}",
            scene.bodies.len()
        ));
    }
    let flat = scene.dimensions == Dimensions::Two;
    if flat && (scene.gravity[2] != 0.0 || scene.points.velocity.iter().any(|v| v[2] != 0.0)) {
        return Err(
            "a scene in two dimensions has velocities or gravity along z; both must be zero".into(),
        );
    }
    let axes = if flat { 2 } else { 3 };
    for (axis, name) in ["x", "y", "z"].iter().enumerate().take(axes) {
        if scene.grid.cells[axis] < 2 {
            return Err(format!(
                "the domain has one cell along {name}; it needs at least two"
            ));
        }
    }
    Ok(())
}

/// Which width of lumens suits the scene's voxels.
fn width_rule(scene: &Scene) -> WidthRule {
    let blocks = scene.bodies.iter().flat_map(|body| &body.blocks);
    let fine = blocks.into_iter().any(|block| {
        let edge = block.voxel();
        block.dims().iter().product::<usize>() > 1
            && edge.iter().any(|e| *e < FINE_VOXEL * scene.grid.cell_m)
    });
    if fine {
        WidthRule::Normal
    } else {
        WidthRule::Combined
    }
}

/// Bodies, with the voids that no liquid can reach filled in, particles, and the number of
/// voxels filled in.
///
/// # Errors
/// When a point lies in a body or outside the domain.
fn contents(
    mut bodies: Vec<RigidBody>,
    points: Points,
    domain: Domain,
    units: Units,
) -> Result<(Solids, Particles, u64), String> {
    let positions: Vec<[f64; 3]> = points.position.iter().map(|&x| units.to_cells(x)).collect();
    let mut closed = 0;
    for body in &mut bodies {
        for block in &mut body.blocks {
            if block.dims().iter().product::<usize>() > 1 {
                let low = units.to_cells(block.origin());
                let edge = block.voxel().map(|e| e / units.h);
                let (filled, sealed) = fill_sealed(block, &domain, low, edge);
                // Liquid that starts in a sealed void stays there.
                if sealed > 0
                    && !points
                        .position
                        .iter()
                        .any(|&x| filled.contains(x) && !block.contains(x))
                {
                    *block = filled;
                    closed += sealed;
                }
            }
        }
    }
    let solids = Solids::new(bodies, domain, units.low, units.h);
    for (point, &x) in positions.iter().enumerate() {
        let inside = (0..3).all(|a| x[a] >= 0.0 && x[a] <= domain.cells[a] as f64);
        if !inside {
            return Err(format!("liquid point {point} lies outside the domain"));
        }
        if solids.at(x).is_some() {
            return Err(format!(
                "liquid point {point} lies in a rigid body; liquid and bodies must not overlap"
            ));
        }
    }
    let n = positions.len();
    let particles = Particles {
        position: positions,
        velocity: points
            .velocity
            .iter()
            .map(|v| v.map(|v| v as f32))
            .collect(),
        volume: (points.volume.iter())
            .map(|v| (v / units.h.powi(3)) as f32)
            .collect(),
        j: vec![0.0; n],
        id: (0..n as u32).collect(),
        parts: Vec::new(),
        start: Vec::new(),
    };
    Ok((solids, particles, closed))
}

#[cfg(test)]
mod tests {
    use physics::{Newtonian, ShearRate, Tait, Viscosity};

    use super::*;
    use crate::geometry::tests::{domain, solids};

    /// Cells of 2 m, 3 kg/m3, 0.5 Pa s, 8 Pa: rho h^2/eta = 24 s.
    #[test]
    fn inertia_compressibility_and_weight_are_against_viscosity() {
        let domain = domain([4, 4, 1], 2);
        let setup = Setup {
            settings: Settings::default(),
            present: Present {
                friction: true,
                table: false,
                load: false,
                pid: false,
            },
            units: Units {
                h: 2.0,
                low: [0.0; 3],
                eta: 0.5,
                cured: 1.0,
            },
            domain,
            liquid: Liquid {
                density: 3.0,
                tait: Tait { bulk_modulus: 8.0 },
                viscosity: Viscosity::Newtonian(Newtonian(0.5)),
                shear_rate: ShearRate::Paper,
                cure: None,
                water: None,
                cavitation_pressure: None,
                wetting: None,
            },
            wall: WallLaw::PartialSlip {
                influence_length_m: 0.5,
            },
            gravity: [0.0, -10.0, 0.0],
            width: WidthRule::Normal,
            bottom: None,
            top: None,
            area: 1.0,
            rest: solids(domain, vec![]),
            sealed: 0,
            surface: None,
            air: None,
        };
        let scales = setup.scales(0.25);
        // rho h^2/(eta dt), eta/(K dt), rho h^2 g/eta and the length in cells.
        assert_eq!((scales.inertia, scales.compressibility), (96.0, 0.25));
        assert_eq!(scales.gravity, [0.0, -240.0, 0.0]);
        assert_eq!(scales.influence_length, 0.25);
    }
}
