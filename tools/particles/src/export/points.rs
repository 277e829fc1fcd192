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
        let count = adhesive_voxels(file).map_err(Failure::data)?;
        let bytes = count.saturating_mul(4 * size_of::<f32>() as u64);
        file.fits(bytes, "a table of its adhesive")
            .map_err(Failure::data)?;
        let mut position = Vec::with_capacity(3 * count as usize);
        let mut volume = Vec::with_capacity(count as usize);
        file.for_each_adhesive(|p, v| {
            position.extend(p.map(|x| x as f32));
            volume.push(v as f32);
        })
        .map_err(Failure::data)?;
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

/// How many there are, by their bits: a header can claim any number.
fn adhesive_voxels(file: &ParticleFile) -> Result<u64, particle_file::Error> {
    let blocks = file.header().blocks.iter().enumerate();
    blocks
        .filter(|(_, block)| block.material == Material::Adhesive)
        .map(|(index, _)| Ok(file.block(index)?.1.count()))
        .sum()
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
