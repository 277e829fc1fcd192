//! The explicit scheme as a run sees it: `physics::Scheme`.

use physics::{
    Diagnostics, Failure, LiquidState, Saved, Saving, Scheme, StageTime, StepLimit, StepReport,
};

use crate::explicit::{Corrections, Explicit};
use crate::fields::point;
use crate::real::Real;

impl Scheme for Explicit {
    fn advance(&mut self, limit: StepLimit) -> Result<StepReport, Failure> {
        self.step(limit)
    }

    fn diagnostics(&self) -> Diagnostics {
        let (cell, density) = (self.scene.grid.cell_m, self.scene.liquid.density);
        let volume = cell.powi(3);
        let mut sum = Diagnostics::default();
        let mut capped = 0.0;
        for tile in &self.grid.tiles {
            let points = &tile.points;
            for p in 0..points.len() {
                let [vx, vy, vz, j] = points.motion[p].0.map(f64::from);
                let v0 = f64::from(points.place[p].0[point::VOLUME]) * volume;
                let now = v0 * (1.0 + j);
                let square = vx * vx + vy * vy + vz * vz;
                let rate = f64::from(points.stress[p].0[point::SHEAR_RATE]);
                let viscosity = f64::from(points.stress[p].0[point::VISCOSITY]) * density;
                // 2 eta D':D' with rate = f |D'|
                let norm = rate / self.scene.liquid.shear_rate.factor();
                sum.kinetic_energy += 0.5 * density * v0 * square;
                sum.viscous_power += 2.0 * viscosity * norm * norm * now;
                sum.volume += now;
                sum.max_speed = sum.max_speed.max(square.sqrt());
                if self.scene.liquid.viscosity.at(rate) > 1.001 * self.plan.viscosity_cap {
                    capped += now;
                }
            }
        }
        sum.capped_fraction = if sum.volume > 0.0 {
            capped / sum.volume
        } else {
            0.0
        };
        sum
    }

    fn liquid(&self) -> LiquidState {
        let (cell, min) = (self.scene.grid.cell_m, self.scene.grid.min_m);
        let count = self.grid.tiles.iter().map(|tile| tile.points.len()).sum();
        let ranks = self.ranks();
        let mut state = LiquidState {
            position: vec![[0.0; 3]; count],
            velocity: vec![[0.0; 3]; count],
            volume: vec![0.0; count],
            pressure: vec![0.0; count],
            shear_rate: vec![0.0; count],
            solids: Vec::new(),
        };
        for tile in &self.grid.tiles {
            let points = &tile.points;
            for p in 0..points.len() {
                let id = points.id[p] as usize;
                let at = ranks.get(id).map_or(id, |&rank| rank as usize);
                let node = tile.node_of(points.base[p]);
                let [vx, vy, vz, j] = points.motion[p].0;
                state.position[at] = std::array::from_fn(|a| {
                    let offset = f64::from(node[a]) + f64::from(points.place[p].0[a]);
                    (min[a] + offset * cell) as f32
                });
                state.velocity[at] = [vx, vy, vz].map(|v| v as f32);
                let v0 = f64::from(points.place[p].0[point::VOLUME]) * cell.powi(3);
                state.volume[at] = (v0 * (1.0 + f64::from(j))) as f32;
                let pressure = self.stress.pressure(j) * self.scene.liquid.density as Real;
                state.pressure[at] = pressure as f32;
                state.shear_rate[at] = points.stress[p].0[point::SHEAR_RATE] as f32;
            }
        }
        state
    }

    fn displacements(&self) -> Vec<[f64; 3]> {
        self.state.displacement.clone()
    }

    fn saving(&self) -> Vec<(String, Saving<'_>)> {
        self.to_saving()
    }

    fn restore(&mut self, saved: &Saved) -> Result<(), String> {
        self.take_saved(saved)
    }

    fn counts(&self) -> Vec<(&'static str, u64)> {
        let Corrections { stopped, trapped } = self.state.corrections;
        let mut counts = vec![
            ("points stopped at walls", stopped),
            ("points trapped in walls", trapped),
        ];
        if let Some(projection) = &self.projection {
            counts.push(("density projections", projection.count));
        }
        counts
    }

    fn stage_times(&self) -> Vec<StageTime> {
        self.clock.times()
    }

    fn objection(&self) -> Option<String> {
        (self.control.as_ref()?.overwhelmed()).map(physics::broken)
    }
}

impl Explicit {
    /// The place of each point in the order of their numbers; empty where none is lost, so that they are it.
    fn ranks(&self) -> Vec<u32> {
        if self.state.lost == 0 {
            return Vec::new();
        }
        let tiles = &self.grid.tiles;
        let ids = || tiles.iter().flat_map(|tile| &tile.points.id);
        let mut ranks = vec![0; ids().max().map_or(0, |&last| last as usize + 1)];
        for &id in ids() {
            ranks[id as usize] = 1;
        }
        let mut before = 0;
        for rank in &mut ranks {
            (*rank, before) = (before, before + *rank);
        }
        ranks
    }
}
