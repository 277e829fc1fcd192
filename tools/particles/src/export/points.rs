//! Points and their columns as a table.

use std::borrow::Cow;

use cli::Failure;
use particle_file::{Element, Material, ParticleFile, Section};

/// Material points as a table: the liquid points of a file with all their columns or, where
/// it has none, the adhesive voxels with centre and volume.
pub struct Points<'a> {
    pub rows: usize,
    pub columns: Vec<Column<'a>>,
}

pub struct Column<'a> {
    pub name: &'a str,
    pub components: usize,
    pub element: Element,
    /// The values as stored, little-endian, rows one behind the other.
    pub bytes: Cow<'a, [u8]>,
}

impl<'a> Points<'a> {
    pub fn of(file: &'a ParticleFile) -> Result<Self, Failure> {
        let rows = file.header().particles;
        if rows == 0 {
            return Self::of_voxels(file);
        }
        let columns = (file.columns().filter(|s| s.rows == rows))
            .map(|section| column(file, section))
            .collect::<Result<_, _>>()?;
        Ok(Self {
            rows: rows as usize,
            columns,
        })
    }

    fn of_voxels(file: &ParticleFile) -> Result<Self, Failure> {
        let blocks = file.header().blocks.iter().enumerate();
        let adhesive = blocks.filter(|(_, block)| block.material == Material::Adhesive);
        let blocks = adhesive.map(|(index, _)| file.block(index));
        let blocks = blocks
            .collect::<Result<Vec<_>, _>>()
            .map_err(Failure::data)?;
        // By their bits: a header can claim any number.
        let count: u64 = blocks.iter().map(|(_, bits)| bits.count()).sum();
        let bytes = count.saturating_mul(4 * size_of::<f32>() as u64);
        file.fits(bytes, "a table of its adhesive")
            .map_err(Failure::data)?;
        let mut position = Vec::with_capacity(3 * count as usize);
        let mut volume = Vec::with_capacity(count as usize);
        for (block, bits) in blocks {
            bits.for_each(|index| {
                let centre = |a| block.origin_m[a] + (index[a] as f64 + 0.5) * block.voxel_m;
                position.extend([0, 1, 2].map(|a| centre(a) as f32));
                volume.push(block.voxel_m.powi(3) as f32);
            });
        }
        if volume.is_empty() {
            return Err(Failure::data(format!("'{}' has no adhesive", file.name())));
        }
        let column = |name, components, values: Vec<f32>| Column {
            name,
            components,
            element: Element::F32,
            bytes: bytemuck::cast_slice(&values).to_vec().into(),
        };
        Ok(Self {
            rows: volume.len(),
            columns: vec![column("position", 3, position), column("volume", 1, volume)],
        })
    }
}

pub fn column<'a>(file: &'a ParticleFile, section: &'a Section) -> Result<Column<'a>, Failure> {
    let bytes = file.bytes_of(section).map_err(Failure::data)?;
    Ok(Column {
        name: &section.name,
        components: section.components as usize,
        element: section.element,
        bytes: bytes.into(),
    })
}
