//! Loss of water to the cell walls of wood: rate, limit, and effect on the viscosity.

use super::neighbours;

/// Density of water, kg/m3.
const WATER_DENSITY: f64 = 1000.0;
/// Rounding of a solids content, relative.
const ROUNDING: f64 = 1e-9;

/// The law of the loss of water in a case.
#[derive(Clone, Debug, PartialEq)]
pub struct WaterLaw {
    /// Volume of water that wood takes per wetted area and time, m/s.
    pub uptake: f64,
    /// Solids content of the liquid at the start, by mass.
    pub solids: f64,
    /// Volume of water that a wall holds per area, m; `None`: unlimited.
    pub capacity: Option<f64>,
    /// Solids content at which the loss ends; `None`: that of the last point of `factor`.
    pub limit: Option<f64>,
    /// Diffusivity of water in the liquid, m2/s.
    pub diffusivity: f64,
    /// Points (solids content, factor on the viscosity); ln(factor) is linear between them.
    pub factor: Vec<(f64, f64)>,
    /// Names of the bodies that take water; empty: all.
    pub walls: Vec<String>,
}

/// The loss of water, resolved from a [`WaterLaw`]. The state variable is the ratio of the volumes of water and solids.
/// Volumes are additive: the liquid shrinks by the water it loses.
#[derive(Clone, Debug, PartialEq)]
pub struct Water {
    law: WaterLaw,
    limit: f64,
    /// Density of the solids, kg/m3.
    solids_density: f64,
}

impl Water {
    /// Resolves `law` for a liquid of `density` (kg/m3) at the start.
    ///
    /// # Errors
    /// One sentence on the value out of range.
    pub fn new(law: WaterLaw, density: f64) -> Result<Self, String> {
        let (Some(&first), Some(&last)) = (law.factor.first(), law.factor.last()) else {
            return Err("viscosity_by_solids needs two rows or more".into());
        };
        if !(law.solids > 0.0 && law.solids < 1.0) {
            return Err(format!(
                "solids = {} is not accepted: a part of the mass between 0 and 1 is needed",
                law.solids
            ));
        }
        if law.factor.len() < 2 || (first.0 - law.solids).abs() > ROUNDING || first.1 != 1.0 {
            return Err(format!(
                "viscosity_by_solids needs two rows or more, the first of them [{}, 1.0]: the solids content at the start, at which the viscosity is that of [adhesive]",
                law.solids
            ));
        }
        let rises = |pair: &[(f64, f64)]| pair[0].0 < pair[1].0 && pair[0].1 <= pair[1].1;
        if !(law.factor.windows(2).all(rises) && last.0 < 1.0 && last.1.is_finite()) {
            let said = "viscosity_by_solids: solids contents must increase and stay below 1, factors must not fall";
            return Err(said.into());
        }
        let limit = law.limit.unwrap_or(last.0);
        if !(limit > law.solids && limit <= last.0 * (1.0 + ROUNDING)) {
            return Err(format!(
                "limit = {limit} is not accepted: it must be above solids ({}) and not beyond the last row of viscosity_by_solids ({})",
                law.solids, last.0
            ));
        }
        let water = (1.0 - law.solids) * density / WATER_DENSITY;
        if water >= 1.0 {
            return Err(format!(
                "solids = {} at a density of {density} kg/m3 leaves no room for the solids: one litre would have {water:.3} l of water",
                law.solids
            ));
        }
        let solids_density = law.solids * density / (1.0 - water);
        Ok(Self {
            law,
            limit,
            solids_density,
        })
    }

    /// Volume of water over that of the solids at the start.
    pub fn start(&self) -> f64 {
        self.ratio(self.law.solids)
    }

    /// Volume of water over that of the solids at which the loss ends.
    pub fn least(&self) -> f64 {
        self.ratio(self.limit)
    }

    /// Volume of water over that of the solids at a solids content by mass.
    pub fn ratio(&self, solids: f64) -> f64 {
        (1.0 / solids - 1.0) * self.solids_density / WATER_DENSITY
    }

    /// Solids content by mass at a volume of water over that of the solids.
    pub fn solids(&self, ratio: f64) -> f64 {
        self.solids_density / (self.solids_density + WATER_DENSITY * ratio)
    }

    /// Factor on the viscosity at a volume of water over that of the solids; outside the table that of its nearer end.
    pub fn factor(&self, ratio: f64) -> f64 {
        let solids = self.solids(ratio);
        match neighbours(&self.law.factor, solids) {
            [Some((a, fa)), Some((b, fb))] => fa * (fb / fa).powf((solids - a) / (b - a)),
            [one, other] => one.or(other).map_or(1.0, |point| point.1),
        }
    }

    /// Volume of water that wood takes per wetted area and time, m/s.
    pub fn uptake(&self) -> f64 {
        self.law.uptake
    }

    /// Volume of water that a wall holds per area, m.
    pub fn capacity(&self) -> Option<f64> {
        self.law.capacity
    }

    /// Diffusivity of water in the liquid, m2/s.
    pub fn diffusivity(&self) -> f64 {
        self.law.diffusivity
    }

    /// Whether the body named `body` takes water.
    pub fn enters(&self, body: &str) -> bool {
        self.law.walls.is_empty() || self.law.walls.iter().any(|name| name == body)
    }

    /// The first name in `walls` that is not among the names `bodies`.
    pub fn stray<'a>(&'a self, bodies: &[&str]) -> Option<&'a str> {
        let mut names = self.law.walls.iter().map(String::as_str);
        names.find(|name| !bodies.contains(name))
    }

    /// Mass (kg) of a volume of water, m3.
    pub fn mass(volume: f64) -> f64 {
        WATER_DENSITY * volume
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn law() -> WaterLaw {
        WaterLaw {
            uptake: 1e-6,
            solids: 0.4,
            capacity: None,
            limit: None,
            diffusivity: 1e-10,
            factor: vec![(0.4, 1.0), (0.5, 10.0), (0.8, 1000.0)],
            walls: Vec::new(),
        }
    }

    /// 1 kg of 1250 kg/m3: 0.8 l, of which 0.6 l are water; 0.4 kg of solids fill 0.2 l.
    #[test]
    fn volumes_of_water_and_solids_add_up() {
        let water = Water::new(law(), 1250.0).unwrap();
        assert!((water.start() - 3.0).abs() < 1e-12);
        // 0.1 kg of water to 0.4 kg of solids.
        assert!((water.least() - 0.5).abs() < 1e-12);
        for solids in [0.4, 0.55, 0.8] {
            assert!((water.solids(water.ratio(solids)) - solids).abs() < 1e-12);
        }
    }

    #[test]
    fn the_table_is_linear_in_the_logarithm_of_its_factors() {
        let water = Water::new(law(), 1250.0).unwrap();
        let at = |solids: f64| water.factor(water.ratio(solids));
        for (solids, exact) in [(0.4, 1.0), (0.45, 10_f64.sqrt()), (0.65, 100.0), (0.8, 1e3)] {
            assert!((at(solids) / exact - 1.0).abs() < 1e-9, "{solids}");
        }
        assert!((at(0.3) - 1.0).abs() < 1e-12 && (at(0.9) / 1e3 - 1.0).abs() < 1e-12);
    }

    #[test]
    fn what_is_no_loss_of_water_is_refused_in_a_sentence() {
        type Change = fn(&mut WaterLaw);
        let cases: [(Change, f64, &str); 8] = [
            (|l| l.solids = 1.2, 1250.0, "between 0 and 1"),
            (|l| l.solids = 0.41, 1250.0, "[0.41, 1.0]"),
            (|l| l.factor[1].1 = 0.5, 1250.0, "must not fall"),
            (|l| l.factor[2].0 = 0.45, 1250.0, "must increase"),
            (|l| l.limit = Some(0.9), 1250.0, "beyond the last row"),
            (|l| l.limit = Some(0.4), 1250.0, "above solids"),
            (|_| (), 1700.0, "no room for the solids"),
            (|l| l.factor.truncate(1), 1250.0, "two rows"),
        ];
        for (change, density, sentence) in cases {
            let mut law = law();
            change(&mut law);
            let said = Water::new(law, density).unwrap_err();
            assert!(said.contains(sentence), "{said}");
        }
    }
}
