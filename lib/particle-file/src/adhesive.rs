//! The adhesive of a file, voxels or points.

use crate::error::Error;
use crate::header::Material;
use crate::read::ParticleFile;

impl ParticleFile {
    /// Calls `visit(position in m, volume in m3)` for every material point of the adhesive,
    /// whether the file stores it as voxels (centre and volume of the voxel) or as liquid
    /// points; always in the order of the file.
    ///
    /// # Errors
    /// When an array is damaged, or liquid points come without position or volume.
    pub fn for_each_adhesive(&self, mut visit: impl FnMut([f64; 3], f64)) -> Result<(), Error> {
        for (index, block) in self.header().blocks.iter().enumerate() {
            if block.material != Material::Adhesive {
                continue;
            }
            let (block, bits) = self.block(index)?;
            let volume = block.voxel_m.powi(3);
            let centre = |a: usize, i: usize| block.origin_m[a] + (i as f64 + 0.5) * block.voxel_m;
            bits.for_each(|index| visit(std::array::from_fn(|a| centre(a, index[a])), volume));
        }
        if self.header().particles > 0 {
            let positions = self.vectors("position")?;
            for (position, &volume) in positions.iter().zip(self.column::<f32>("volume")?) {
                visit(position.map(f64::from), f64::from(volume));
            }
        }
        Ok(())
    }

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
