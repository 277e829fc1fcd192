//! Shear rates in a state, and at the wall of the paper's tube.

use std::str::FromStr;

use particle_file::ParticleFile;

use crate::Error;
use crate::quantile::quantiles;

/// Definition of the shear rate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Convention {
    /// 2 |dev D| of the paper (section 2.2), sqrt(2) times that of a rheometer.
    Paper,
    /// sqrt(2 D:D), which is du/dy in simple shear, as of a rheometer.
    Rheometer,
}

impl Convention {
    /// Factor on a rheometer's shear rate.
    pub fn factor(self) -> f64 {
        match self {
            Convention::Paper => std::f64::consts::SQRT_2,
            Convention::Rheometer => 1.0,
        }
    }
}

impl FromStr for Convention {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "paper" => Ok(Convention::Paper),
            "rheometer" => Ok(Convention::Rheometer),
            _ => Err(format!(
                "'{text}' is not a convention; accepted are paper and rheometer"
            )),
        }
    }
}

/// Volume-weighted distribution of shear rates in one state of a run (paper Figs. 10, 11).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShearRates {
    /// Time of the state, s.
    pub time_s: f64,
    /// Rates (1/s) not exceeded by [`ShearRates::SHARES`] of the volume.
    pub quantiles: [f64; 7],
    /// Largest rate, 1/s.
    pub max: f64,
    /// Mean rate, 1/s.
    pub mean: f64,
    /// Volume of adhesive, m3.
    pub volume_m3: f64,
}

impl ShearRates {
    /// Shares of the volume.
    pub const SHARES: [f64; 7] = [0.05, 0.10, 0.25, 0.50, 0.75, 0.90, 0.95];

    /// The distribution in a snapshot, in `convention`; `None`: as stored.
    ///
    /// # Errors
    /// Missing or damaged columns, values that are no shear rates, and a snapshot without a stored convention if `convention`
    /// is given.
    pub fn of_file(file: &ParticleFile, convention: Option<Convention>) -> Result<Self, Error> {
        let factor = match convention {
            None => 1.0,
            Some(wanted) => wanted.factor() / stored_convention(file)?.factor(),
        };
        let rates = file.column::<f32>("shear_rate")?;
        let volumes = file.column::<f32>("volume")?;
        let is_sound = |x: &f32| x.is_finite() && *x >= 0.0;
        let pairs = rates.iter().zip(volumes);
        let unfit = pairs
            .clone()
            .position(|(r, v)| !(is_sound(r) && is_sound(v)));
        if let Some(i) = unfit {
            return Err(Error::Data(format!(
                "material point {i} has shear rate {} 1/s and volume {} m3: numbers of at least 0 are needed",
                rates[i], volumes[i]
            )));
        }
        // In the worst case, with equal rates, all of them are sorted.
        let bytes = rates.len() * size_of::<(f64, f64)>();
        file.fits(bytes as u64, "the order of its shear rates")?;
        let parcels = pairs.map(|(&r, &v)| (factor * f64::from(r), f64::from(v)));
        let max = parcels.clone().map(|(r, _)| r).fold(f64::NAN, f64::max);
        let volume_m3: f64 = parcels.clone().map(|(_, v)| v).sum();
        let each = |visit: &mut dyn FnMut(f64, f64)| parcels.clone().for_each(|(r, v)| visit(r, v));
        Ok(Self {
            time_s: file.header().time_s,
            quantiles: quantiles(max, volume_m3, each, Self::SHARES),
            max,
            mean: parcels.clone().map(|(r, v)| r * v).sum::<f64>() / volume_m3,
            volume_m3,
        })
    }
}

fn stored_convention(file: &ParticleFile) -> Result<Convention, Error> {
    let name = "shear_rate_convention";
    let stored = file.header().attribute(name).ok_or_else(|| {
        Error::Usage(format!(
            "there is no attribute '{name}', so its rates cannot be converted; leave out --convention"
        ))
    })?;
    stored
        .parse()
        .map_err(|said| Error::Data(format!("attribute '{name}': {said}")))
}

/// Shear rate (1/s) at the wall of a tube of `diameter` (m) at mean speed `speed` (m/s):
/// 8 v / d (paper Eq. 7; Wilkes 2006). A rheometer's shear rate.
pub fn tube_shear_rate(speed: f64, diameter: f64) -> f64 {
    8.0 * speed / diameter
}
