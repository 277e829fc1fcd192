//! Shear rate at the walls of a channel in a non-Newtonian liquid (docs/methods.md section 3.8).

use physics::Viscosity;

/// Width over the spacing of edges beyond which the Newtonian distance is used: the correction falls with the width, its cost
/// grows.
const MAX_WIDTH: f64 = 60.0;
/// Bounds on the effective distance over that of a Newtonian liquid.
const RATIOS: [f64; 2] = [1e-3, 4.0];
/// Bound on the tries for the rate at a wall, and its error, relative.
const MOST_TRIES: usize = 50;
const RATE_TOLERANCE: f64 = 1e-4;

/// The part of a channel beside a wall, cells: the effective distance of a Newtonian liquid from the wall, the width H, and the
/// distances of the first edge from the wall and of further ones from each other.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Channel {
    pub(super) distance: f64,
    pub(super) width: f64,
    pub(super) first: f64,
    pub(super) spacing: f64,
}

/// The flux between plates of a law, over the rate at the wall.
pub(super) struct FlowCurve {
    /// Integral of rate times stress over the stress, divided by rate times stress squared, at the rates of [`ln_rate`]:
    /// 1/(p + 2) where the rate goes with the power p of the stress.
    fluxes: Vec<f64>,
}

/// Rates of the table, 1/s: the first one, the number of them, and how many there are in a unit of the logarithm.
const FIRST_RATE: f64 = 1e-8;
const RATES: usize = 400;
const PER_UNIT: f64 = 10.0;

fn ln_rate(index: usize) -> f64 {
    FIRST_RATE.ln() + index as f64 / PER_UNIT
}

impl FlowCurve {
    /// The curve of a `law`. Where its stress falls with the rate, the largest stress before stands.
    pub(super) fn new(law: &Viscosity) -> Self {
        // Newtonian below the first rate.
        let (mut before, mut flux) = (f64::NEG_INFINITY, 1.0 / 3.0);
        let next = |index: usize| {
            let rate = ln_rate(index).exp();
            let ln_stress = (law.at(rate) * rate).ln().max(before);
            if index > 0 {
                // A power law between neighbouring rates.
                let rise = ln_stress - before;
                let kept = (-2.0 * rise - 1.0 / PER_UNIT).exp();
                let index = rise * PER_UNIT;
                flux = kept * flux + (1.0 - kept) * index / (2.0 * index + 1.0);
            }
            before = ln_stress;
            flux
        };
        Self {
            fluxes: (0..RATES).map(next).collect(),
        }
    }

    /// The power p at a rate; Newtonian below the table.
    fn power(&self, ln_rate: f64) -> f64 {
        let place = (ln_rate - FIRST_RATE.ln()) * PER_UNIT;
        let inside = place.clamp(0.0, (RATES - 1) as f64);
        let index = (inside as usize).min(RATES - 2);
        let part = inside - index as f64;
        let flux = self.fluxes[index] + part * (self.fluxes[index + 1] - self.fluxes[index]);
        1.0 / flux - 2.0
    }

    /// Shear rate at the wall of a channel where a Newtonian liquid of the same velocity has the rate `newtonian`; `slip` is the
    /// influence length, cells.
    ///
    /// Derivation. In a slit the stress falls linearly from the wall to the middle; a liquid whose rate goes with the power p
    /// of the stress has there (1 - 2 y/H)^p of the wall's rate. Faces differ by the rate at the edge between them, at y = h1,
    /// h1 + s, ... < H/2, times their distance, w = (h1 + s)/2 at the first edge and s at others; the flux that follows is that
    /// of the profile, the wall's rate times (H/2)^2/(p + 2) on each side, if
    ///
    /// d(p) = H/(2 (p + 2)) - sum over edges of w (1 - 2 y/H)^(p + 1),
    ///
    /// which for p = 1 is d_w of section 3.5. The distance used is `channel.distance` d(p)/d(1), p that of the power law with
    /// the same flux.
    pub(super) fn wall_rate(&self, channel: &Channel, slip: f64, newtonian: f64) -> f64 {
        let Channel {
            distance,
            width,
            first,
            spacing,
        } = *channel;
        if !(width <= MAX_WIDTH * spacing && distance + slip > 0.0) {
            return newtonian;
        }
        let of = |p: f64| {
            let (mut sum, mut y, mut apart) = (0.0, first, 0.5 * (first + spacing));
            while 2.0 * y < width {
                sum += apart * (1.0 - 2.0 * y / width).powf(p + 1.0);
                (y, apart) = (y + spacing, spacing);
            }
            0.5 * width / (p + 2.0) - sum
        };
        let unit = of(1.0);
        // Excess of ln(velocity) at a rate.
        let excess = |ln_wall: f64| {
            let ratio = (of(self.power(ln_wall)) / unit).max(RATIOS[0]);
            ln_wall + ((distance * ratio + slip) / (distance + slip)).ln() - newtonian.ln()
        };
        let [high, low] = RATIOS.map(|ratio| newtonian.ln() - ratio.ln());
        root(excess, [low, high]).exp()
    }
}

/// A root of a function that grows between two bounds, by false position (Illinois variant); a bound where there is none.
fn root(excess: impl Fn(f64) -> f64, [mut low, mut high]: [f64; 2]) -> f64 {
    let [mut at_low, mut at_high] = [low, high].map(&excess);
    if at_low >= 0.0 {
        return low;
    }
    if at_high <= 0.0 {
        return high;
    }
    let mut side = 0;
    for _ in 0..MOST_TRIES {
        let next = (low * at_high - high * at_low) / (at_high - at_low);
        let found = excess(next);
        if found.abs() < RATE_TOLERANCE || high - low < RATE_TOLERANCE {
            return next;
        }
        if found > 0.0 {
            (high, at_high) = (next, found);
            at_low *= if side == 1 { 0.5 } else { 1.0 };
            side = 1;
        } else {
            (low, at_low) = (next, found);
            at_high *= if side == -1 { 0.5 } else { 1.0 };
            side = -1;
        }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;
    use physics::Law;

    /// Flux through half a channel of `rows` rows of a `spacing`, the first edge `first` from the wall, by the rates at the
    /// wall and the edges, over that of the law: velocities of the cells times their heights.
    fn flux(law: &Viscosity, channel: &Channel, wall: f64, velocity: f64) -> f64 {
        let stress = law.at(wall) * wall;
        let rate = |stress: f64| -> f64 {
            let [mut low, mut high] = [1e-12_f64, 1e12];
            while high / low > 1.0 + 1e-9 {
                let middle = (low * high).sqrt();
                match law.at(middle) * middle < stress {
                    true => low = middle,
                    false => high = middle,
                }
            }
            low
        };
        let half = 0.5 * channel.width;
        let (mut sum, mut y) = (velocity * half, channel.first);
        let mut apart = 0.5 * (channel.first + channel.spacing);
        while y < half {
            sum += apart * rate(stress * (1.0 - y / half)) * (half - y);
            (y, apart) = (y + channel.spacing, channel.spacing);
        }
        // Quadrature of the profile: the integral of the rate times the distance from the middle.
        let parts = 4000;
        let exact: f64 = (0..parts)
            .map(|i| (i as f64 + 0.5) / parts as f64)
            .map(|share| rate(stress * share) * share * half * half / parts as f64)
            .sum();
        sum / exact
    }

    /// Rows of a gap are lower than a cell; a law may change its slope between the wall and the middle.
    #[test]
    fn the_flux_between_plates_is_that_of_the_law() {
        let power = |n: f64, rates: [f64; 2]| Viscosity::Law(Law::Power { k: 1.0, n, rates });
        let laws = [
            power(0.5, [1e-6, 1e8]),
            power(0.3, [1e-6, 1e8]),
            power(0.04, [1e-6, 1e8]),
            // Constant viscosity at the wall, a plug inside; and the other way round.
            power(0.04, [1e-6, 1.0]),
            power(0.04, [2.0, 1e8]),
        ];
        for (rows, spacing, first) in [
            (1, 0.05, 0.025),
            (2, 0.7, 0.7),
            (5, 0.7, 0.7),
            (6, 1.0, 0.5),
        ] {
            let width = rows as f64 * spacing;
            let mut channel = Channel {
                distance: 0.0,
                width,
                first,
                spacing,
            };
            let newtonian = Viscosity::Newtonian(physics::Newtonian(1.0));
            let [none, one] = [0.0, 1.0].map(|velocity| flux(&newtonian, &channel, 1.0, velocity));
            channel.distance = (1.0 - none) / (one - none);
            // The rates at the edges are those of one power.
            for law in &laws[..if rows > 2 { 3 } else { 5 }] {
                for wall in [0.03, 0.8, 3.0, 20.0_f64] {
                    let [none, one] =
                        [0.0, 1.0].map(|velocity| flux(law, &channel, wall, velocity));
                    let velocity = (1.0 - none) / (one - none);
                    let found =
                        FlowCurve::new(law).wall_rate(&channel, 0.0, velocity / channel.distance);
                    let off = law.at(found) * found / (law.at(wall) * wall) - 1.0;
                    assert!(off.abs() < 5e-3, "{law:?} {rows} {wall}: {off}");
                }
            }
        }
    }
}
