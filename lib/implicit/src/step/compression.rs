//! Compression of full pores by Tait's law, linear around a pressure.

use physics::Tait;

use crate::geometry::Mesh;
use crate::settings::MISSED;

/// The volumes of full pores in a step.
pub(super) struct Compression<'a> {
    pub(super) tait: Tait,
    /// Unit of pressures, Pa.
    pub(super) unit: f64,
    pub(super) mesh: &'a Mesh,
    /// Volume that each pore holds at the start, cells, and its pressure then.
    pub(super) volumes: &'a [f64],
    pub(super) pressure: &'a [f64],
    /// Which pores are full at the start.
    pub(super) full: &'a [bool],
    /// Heights of the gap at the start and at the end. Compression is that of volumes at the end: the film in a gap that
    /// closes is squeezed out before it is compressed.
    pub(super) heights: [f64; 2],
    /// Length of the step, and the time in which the last flow crosses a cell, s.
    pub(super) times: [f64; 2],
}

impl Compression<'_> {
    /// What a pore holds more than its volume at no pressure, over that.
    fn relative_excess(&self, pressure: f64) -> f64 {
        1.0 / (1.0 + self.tait.volume_change(pressure * self.unit)) - 1.0
    }

    /// The same by the law that is linear around another pressure.
    fn linear(&self, pressure: f64, around: f64) -> f64 {
        let slope = self.unit / self.tait.bulk_modulus;
        self.relative_excess(around) + slope * (pressure - around)
    }

    fn pore_volumes(&self, pore: usize) -> [f64; 2] {
        self.heights.map(|height| self.mesh.volume_at(pore, height))
    }

    /// Volumes that `pores` give off by themselves, over the time of the step: compression at the start less that at no
    /// pressure by the law around the pressures `around`; and what full pores hold more or less than their pressure explains.
    /// It goes in the time in which the last flow crosses a cell, not the sooner the shorter the step is.
    pub(super) fn release_rates(&self, pores: &[u32], around: &[f64]) -> Vec<f64> {
        let [dt, crossing] = self.times;
        let released = |&pore: &u32| {
            let pore = pore as usize;
            if !self.full[pore] {
                return 0.0;
            }
            let [before, after] = self.pore_volumes(pore);
            let compressed = before * self.relative_excess(self.pressure[pore]);
            let off = self.volumes[pore] - before - compressed;
            (compressed - after * self.linear(0.0, around[pore])) / dt + off / crossing.max(dt)
        };
        pores.iter().map(released).collect()
    }

    /// Whether the pressures `found` by the law around others obey it.
    pub(super) fn obeys_law(&self, pores: &[u32], around: &[f64], found: &[f64]) -> bool {
        let (mut off, mut all, mut volume) = (0.0, 0.0, 0.0);
        for pore in pores.iter().map(|&pore| pore as usize) {
            if self.full[pore] {
                let [before, after] = self.pore_volumes(pore);
                let denser = self.relative_excess(found[pore]);
                off += after * (denser - self.linear(found[pore], around[pore])).abs();
                let changed = after * (denser - self.relative_excess(self.pressure[pore])).abs();
                all += changed + (before - after).abs();
                volume += after;
            }
        }
        // Liquid that flies on, none of which changes, is off by rounding of many pores.
        off <= MISSED * all + 1e-12 * volume
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What no pressure explains moves a way that is the shorter the shorter the step; what pressure does goes at once.
    #[test]
    fn no_step_is_so_short_that_what_is_held_too_much_crosses_a_cell() {
        let mesh = Mesh::column([0, 1], 0);
        let released = |volume: f64, pressure: f64, dt: f64| {
            let compression = Compression {
                tait: Tait { bulk_modulus: 1e9 },
                unit: 1.0,
                mesh: &mesh,
                volumes: &[volume],
                pressure: &[pressure],
                full: &[true],
                heights: [0.0; 2],
                times: [dt, 1.0],
            };
            dt * compression.release_rates(&[0], &[0.0])[0]
        };
        for off in [-0.1, 0.1] {
            let moved = [1.0, 0.1].map(|dt| released(1.0 + off, 0.0, dt));
            assert!((moved[0] - off).abs() < 1e-12, "{moved:?}");
            assert!((moved[1] - 0.1 * off).abs() < 1e-12, "{moved:?}");
        }
        let denser = 1.0 / (1.0 + Tait { bulk_modulus: 1e9 }.volume_change(1e6)) - 1.0;
        assert!((released(1.0 + denser, 1e6, 0.1) / denser - 1.0).abs() < 1e-9);
    }
}
