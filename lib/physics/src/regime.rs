//! The dimensionless numbers of a run.

use std::fmt;

use crate::{Amount, Scene};

/// Surface tension of a typical wood adhesive, N/m (paper, below Eq. 4).
const SURFACE_TENSION: f64 = 0.03;

/// Dimensionless numbers of a run, by which terms may be left out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Regime {
    /// Speed of sound at rest, m/s.
    pub sound_speed: f64,
    /// Driving speed over speed of sound.
    pub mach: f64,
    /// rho v d / eta for a lumen of six cells with the smallest viscosity at its tube rate.
    pub reynolds: f64,
    /// rho (d/2)^2 / eta of that lumen, s: time in which a velocity profile settles.
    pub diffusion_time: f64,
    /// 8 v / d, the tube shear rate of paper Eq. 7, 1/s.
    pub tube_shear_rate: f64,
    /// 2 gamma cos theta / r of that lumen, Pa (paper Eq. 4); with a typical gamma and cos theta = 1 if the scene has no
    /// surface tension.
    pub capillary_pressure: f64,
    /// Whether the run computes capillary pressure.
    pub capillarity: bool,
    /// Largest pressure over bulk modulus; `None` without a pressure limit.
    pub volume_strain: Option<f64>,
    /// Pressure limit, Pa, if there is one.
    pub max_pressure: Option<f64>,
}

impl Regime {
    /// The numbers of `scene` with `amount` of liquid, for a lumen of six cells and the largest speed.
    pub fn of(scene: &Scene, amount: &Amount) -> Self {
        let liquid = &scene.liquid;
        let lumen = 6.0 * scene.grid.cell_m;
        let speed = scene.speed_with(amount);
        let rate = 8.0 * speed / lumen;
        let eta = liquid.viscosity.at(rate);
        let adhesion = (liquid.wetting).map_or(SURFACE_TENSION, |wetting| wetting.adhesion());
        let max_pressure = scene.clamp.and_then(|c| c.max_pressure);
        Self {
            sound_speed: liquid.sound_speed(),
            mach: speed / liquid.sound_speed(),
            reynolds: liquid.density * speed * lumen / eta,
            diffusion_time: liquid.density * (0.5 * lumen).powi(2) / eta,
            tube_shear_rate: rate,
            capillary_pressure: 4.0 * adhesion / lumen,
            capillarity: liquid.wetting.is_some(),
            volume_strain: max_pressure.map(|p| p / liquid.tait.bulk_modulus),
            max_pressure,
        }
    }

    /// Warnings about terms that are left out although this regime needs them.
    pub fn warnings(&self) -> Vec<String> {
        let mut said = Vec::new();
        if self.mach > 0.1 {
            said.push(format!(
                "the Mach number is {:.2}: sound waves matter and an explicit run is needed",
                self.mach
            ));
        }
        if self.reynolds > 1.0 {
            said.push(format!(
                "the Reynolds number of a six-cell lumen is {:.2}: inertia is not negligible there",
                self.reynolds
            ));
        }
        let drawn = |p: &f64| !self.capillarity && self.capillary_pressure > 0.05 * p;
        if let Some(limit) = self.max_pressure.filter(drawn) {
            let [drawn, limit] = [self.capillary_pressure, limit].map(|p| p / 1e3);
            said.push(format!(
                "capillary pressure in a six-cell lumen is {drawn:.1} kPa, more than 5 % of the clamp's {limit:.1} kPa, and is not modelled"
            ));
        }
        if let Some(strain) = self.volume_strain.filter(|s| *s > 0.05) {
            said.push(format!(
                "the liquid shrinks by {:.0} % at the pressure limit: its bulk modulus is too low for a nearly incompressible liquid",
                100.0 * strain
            ));
        }
        said
    }
}

impl fmt::Display for Regime {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "sound speed        {:.4} m/s, Mach {:.2e}\n\
             Reynolds number    {:.3e} (lumen of six cells)\n\
             diffusion time     {:.3e} s across that lumen\n\
             tube shear rate    {:.3e} 1/s (paper Eq. 7)\n\
             capillary pressure {:.3e} Pa (paper Eq. 4)",
            self.sound_speed,
            self.mach,
            self.reynolds,
            self.diffusion_time,
            self.tube_shear_rate,
            self.capillary_pressure
        )?;
        if let Some(strain) = self.volume_strain {
            write!(f, "\nvolume strain      {strain:.2e} at the pressure limit")?;
        }
        Ok(())
    }
}
