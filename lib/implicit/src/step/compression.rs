//! Compression of full pores: Tait's law, linearised about a pressure (docs/methods.md section 3.4).

use physics::Tait;

use crate::geometry::Mesh;
use crate::settings::ITERATION_TOLERANCE;

/// What the compression of full pores in a step depends on.
pub(super) struct Compression<'a> {
    pub(super) tait: Tait,
    /// Unit of pressures, Pa.
    pub(super) unit: f64,
    pub(super) mesh: &'a Mesh,
    /// Liquid volume (at zero pressure, cells) and pressure of each pore at the start of the step.
    pub(super) volumes: &'a [f64],
    pub(super) pressure: &'a [f64],
    /// Which pores are full at the start.
    pub(super) full: &'a [bool],
    /// Heights of the gap at the start and at the end of the step. Compression refers to volumes at the end: the film in a
    /// closing gap is squeezed out before it is compressed.
    pub(super) heights: [f64; 2],
    /// Length of the step, and the time in which the last flow crosses a cell, s.
    pub(super) times: [f64; 2],
}

impl Compression<'_> {
    /// 1/J - 1: relative excess of the liquid in a pore, at a pressure, over the pore's volume.
    fn relative_excess(&self, pressure: f64) -> f64 {
        1.0 / (1.0 + self.tait.volume_change(pressure * self.unit)) - 1.0
    }

    /// 1/J - 1 by the law linearised about the pressure `around`.
    fn linear(&self, pressure: f64, around: f64) -> f64 {
        let slope = self.unit / self.tait.bulk_modulus;
        self.relative_excess(around) + slope * (pressure - around)
    }

    /// Volumes of a pore at the start and at the end of the step.
    fn pore_volumes(&self, pore: usize) -> [f64; 2] {
        self.heights.map(|height| self.mesh.volume_at(pore, height))
    }

    /// Known source of the volume balance of `pores`, volume over time: the compression at the start less the constant term
    /// of the law linearised about the pressures `around`, over dt; plus the volume that the pressure at the start does not
    /// explain. The latter leaves within the time in which the last flow crosses a cell, not faster in shorter steps.
    pub(super) fn release_rates(&self, pores: &[u32], around: &[f64]) -> Vec<f64> {
        let [dt, crossing] = self.times;
        let released = |&pore: &u32| {
            let pore = pore as usize;
            let [before, after] = self.pore_volumes(pore);
            let compressed = before * self.relative_excess(self.pressure[pore]);
            let off = self.volumes[pore] - before - compressed;
            (compressed - after * self.linear(0.0, around[pore])) / dt + off / crossing.max(dt)
        };
        pores.iter().map(released).collect()
    }

    /// Whether the pressures `found` with the law linearised about `around` obey Tait's law.
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
        // The last term is rounding: in free flight nothing changes volume.
        off <= ITERATION_TOLERANCE * all + 1e-12 * volume
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Volume that no pressure explains leaves in proportion to the step length; compressed volume leaves at once.
    #[test]
    fn unexplained_volume_leaves_in_proportion_to_a_short_step() {
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
