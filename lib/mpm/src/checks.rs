//! Checks of the whole state: what ends a run, its likely cause, and the limits of the step.

use physics::Failure;

use crate::explicit::Explicit;
use crate::plan::acoustic_limit;
use crate::real::Real;

/// Courant numbers of the two limits below which a point alone in its cells is stable with any
/// shape but the hat: dt 2 nu q < 1 and 3 (c dt)^2 q < 2, q at most 28/3 per cell^2, the sum over
/// nodes of slope^2 / weight of GIMP along an axis.
const ALONE_VISCOUS: f64 = 0.4;
const ALONE_ACOUSTIC: f64 = 0.25;
/// Relative volume changes j outside which Eq. 1 has no meaning.
const SOUND_J: std::ops::Range<Real> = -0.7..1.0;

impl Explicit {
    /// Checks all points: stops an unstable run and renews the limits of the time step.
    pub(crate) fn check(&mut self) -> Result<(), Failure> {
        let sound = self.scene.liquid.sound_speed();
        let (mut fastest, mut least): (f64, Real) = (0.0, 0.0);
        for tile in &self.grid.tiles {
            for (motion, id) in tile.points.motion.iter().zip(&tile.points.id) {
                let [vx, vy, vz, j] = motion.0;
                let square = f64::from(vx * vx + vy * vy + vz * vz);
                if !(square.sqrt() < 10.0 * sound && SOUND_J.contains(&j)) {
                    return Err(Failure(format!(
                        "step {}: liquid point {id} has speed {:.3e} m/s and volume ratio J = {:.4}: {}",
                        self.state.step,
                        square.sqrt(),
                        1.0 + j,
                        self.cause(*id, j)
                    )));
                }
                fastest = fastest.max(square);
                least = least.min(j);
            }
        }
        let acoustic = acoustic_limit(&self.scene, fastest.sqrt(), f64::from(least));
        self.state.limit_s = acoustic.min(self.plan.viscous_s);
        if let Some(projection) = &mut self.projection {
            projection.speed = fastest.sqrt();
        }
        Ok(())
    }

    /// The shortest and the longest step limit (s) that a sound run can have.
    pub(crate) fn limits_s(&self) -> (f64, f64) {
        let fastest = 10.0 * self.scene.liquid.sound_speed();
        let least = acoustic_limit(&self.scene, fastest, f64::from(SOUND_J.start));
        let first = self.plan.acoustic_s.min(self.plan.viscous_s);
        (least.min(first), self.plan.viscous_s)
    }

    fn cause(&self, id: u32, j: Real) -> String {
        if self.is_alone(id) {
            self.unstable(id)
        } else if j <= SOUND_J.start {
            "the liquid is crushed, probably between bodies that leave no room for it".into()
        } else if j >= SOUND_J.end {
            match self.scene.liquid.cavitation_pressure {
                None => "the liquid is torn apart; a cavitation_pressure would limit its tension",
                Some(_) => "the liquid has broken up, which a volume ratio cannot describe",
            }
            .into()
        } else {
            self.unstable(id)
        }
    }

    /// The likely cause of an instability at a point.
    pub(crate) fn unstable(&self, id: u32) -> String {
        let advice = format!(
            "the time step is {} times its {} limit",
            self.settings.cfl, self.plan.limit
        );
        if self.is_alone(id) {
            // No other point shares the nodes and carries their velocity gradient to the next step, so
            // that the stress reverses the gradient in each.
            return format!(
                "the run is unstable at a single point, a drop smaller than a cell; {advice}; a single point needs {ALONE_VISCOUS} times the viscous and {ALONE_ACOUSTIC} times the acoustic limit"
            );
        }
        format!("the run is unstable; {advice}, and a smaller cfl may help")
    }

    /// Whether no other point is within a cell and a half, the reach of a node, of this one.
    fn is_alone(&self, id: u32) -> bool {
        let nodes = || {
            self.grid.tiles.iter().flat_map(|tile| {
                let points = &tile.points;
                (0..points.len()).map(move |p| (points.id[p], tile.node_of(points.base[p])))
            })
        };
        let Some((_, own)) = nodes().find(|(other, _)| *other == id) else {
            return false;
        };
        let near = |node: [i32; 3]| (0..3).all(|a| (node[a] - own[a]).abs() <= 1);
        nodes().filter(|(_, node)| near(*node)).count() == 1
    }
}
