//! Whether a file agrees with its checksums.

use crate::error::Error;
use crate::header::Kind;
use crate::layout::ALIGN;
use crate::read::{ParticleFile, Value};
use crate::section::{Element, Section};

impl ParticleFile {
    /// Reads everything: every array agrees with its checksum, the voxels of every block
    /// with its count, the bytes between arrays are zero, and, but for checkpoints, every
    /// number is finite. The header and the end marker were checked on opening.
    pub fn check(&self) -> Result<(), Error> {
        for index in 0..self.header().blocks.len() {
            self.block(index)?;
        }
        for (index, section) in self.sections().iter().enumerate() {
            self.values_of::<u8>(index)?;
            self.check_padding(section)?;
            if self.header().kind == Kind::Checkpoint {
                continue;
            }
            match section.element {
                Element::F32 => self.check_finite(section, |x: f32| x.is_finite())?,
                Element::F64 => self.check_finite(section, |x: f64| x.is_finite())?,
                _ => {}
            }
        }
        Ok(())
    }

    fn check_finite<T: Value>(
        &self,
        section: &Section,
        finite: impl Fn(T) -> bool,
    ) -> Result<(), Error> {
        let values = self.column::<T>(&section.name)?;
        match values.iter().position(|&x| !finite(x)) {
            None => Ok(()),
            Some(at) => Err(self.corrupt(format!(
                "has a value that is not a finite number in row {} of column '{}'",
                at / section.components as usize,
                section.name
            ))),
        }
    }

    fn check_padding(&self, section: &Section) -> Result<(), Error> {
        let end = section.range().end;
        let padding = &self.bytes()[end..end.next_multiple_of(ALIGN as usize)];
        match padding.iter().all(|&b| b == 0) {
            true => Ok(()),
            false => Err(self.corrupt(format!(
                "has bytes that are not zero behind array '{}'",
                section.name
            ))),
        }
    }
}
