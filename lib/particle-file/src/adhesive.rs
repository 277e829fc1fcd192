//! The liquid points of a file.

use crate::error::Error;
use crate::read::ParticleFile;

impl ParticleFile {
    /// Positions (m) and volumes (m3) of the liquid points.
    ///
    /// # Errors
    /// Columns that are absent or damaged, a position or volume that is not finite, or a volume
    /// that is not positive.
    pub fn liquid(&self) -> Result<(&[[f32; 3]], &[f32]), Error> {
        let position = self.vectors("position")?;
        let volume = self.column::<f32>("volume")?;
        let unfit = position
            .iter()
            .zip(volume)
            .position(|(p, &v)| !(p.iter().all(|x| x.is_finite()) && v.is_finite() && v > 0.0));
        match unfit {
            None => Ok((position, volume)),
            Some(i) => Err(self.corrupt(format!(
                "has a material point {i} at {:?} m with a volume of {} m3: finite numbers and a positive volume are needed",
                position[i], volume[i]
            ))),
        }
    }
}
