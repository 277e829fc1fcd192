//! How large a voxel is, by a file's metadata.

use std::fmt;

use particle_file::limits;
use units::{Length, Quantity};

use crate::Error;

/// How far the edges of a voxel may differ and still make a cube.
const CUBE_TOLERANCE: f64 = 0.01;
/// Resolutions in dots per inch that image programs write by default; they do not say how
/// large a voxel is.
const DEFAULT_DPI: [f64; 5] = [72.0, 96.0, 150.0, 300.0, 600.0];

/// Size of a voxel as a file states it.
#[derive(Clone, Debug, PartialEq)]
pub struct VoxelSize {
    /// Edges along x, y, z in metres; z is none when the file describes one plane only.
    edges: (f64, f64, Option<f64>),
    /// Which metadata said so.
    from: &'static str,
}

impl VoxelSize {
    /// A size from edges in metres, if they are sizes at all.
    pub(crate) fn new(x: f64, y: f64, z: Option<f64>, from: &'static str) -> Option<Self> {
        let is_size = |edge: f64| edge.is_finite() && edge > 0.0;
        (is_size(x) && is_size(y) && z.is_none_or(is_size)).then_some(Self {
            edges: (x, y, z),
            from,
        })
    }

    /// A size from pixels per centimetre or inch (TIFF tags 282, 283, 296).
    pub(crate) fn from_resolution(x: f64, y: f64, unit: u64) -> Option<Self> {
        let metres = match unit {
            2 => 0.0254,
            3 => 0.01,
            _ => return None,
        };
        let dpi = (0.0254 * x / metres).round();
        if unit == 2 && (x - dpi).abs() < 1e-6 && DEFAULT_DPI.contains(&dpi) {
            return None;
        }
        Self::new(metres / x, metres / y, None, "the resolution tags")
    }

    /// Which metadata said so, e.g. `ImageJ metadata`.
    pub fn from(&self) -> &'static str {
        self.from
    }

    /// Whether the distance of pages is stated; if not, [`VoxelSize::cube_edge`] takes voxels
    /// to be as high as they are wide.
    pub fn states_spacing(&self) -> bool {
        self.edges.2.is_some()
    }

    /// The edge (m) of a cubic voxel: edges within 1 % of each other count as equal, and the
    /// cube keeps their volume.
    ///
    /// # Errors
    /// A sentence when the voxels are no cubes.
    pub fn cube_edge(&self) -> Result<f64, String> {
        let (x, y, z) = (
            self.edges.0,
            self.edges.1,
            self.edges.2.unwrap_or(self.edges.0),
        );
        let (low, high) = (x.min(y).min(z), x.max(y).max(z));
        if high > low * (1.0 + CUBE_TOLERANCE) {
            return Err(format!(
                "{} says a voxel is {self}; voxels must be cubes to 1 %: resample the stack, or give the true edge with --voxel",
                self.from
            ));
        }
        Ok(if low == high { x } else { (x * y * z).cbrt() })
    }
}

impl fmt::Display for VoxelSize {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (x, y, z) = self.edges;
        write!(f, "{} x {}", micrometres(x), micrometres(y))?;
        match z {
            Some(z) => write!(f, " x {} um", micrometres(z)),
            None => write!(f, " um (no spacing of pages given)"),
        }
    }
}

/// Micrometres, rounded to the picometre so that conversions leave no trailing digits.
pub(crate) fn micrometres(metres: f64) -> f64 {
    (metres * 1e12).round() * 1e-6
}

/// Metres of `1 unit` where `unit` is spelled as imaging programs do; none for pixels and
/// for units that are not lengths.
pub(crate) fn metres_of_unit(unit: &str) -> Option<f64> {
    let unit = unit.trim();
    let quantity = match unit.to_lowercase().as_str() {
        "micron" | "microns" | "micrometer" | "micrometre" | "\\u00b5m" => "1 um".into(),
        "millimeter" | "millimetre" => "1 mm".into(),
        "nanometer" | "nanometre" => "1 nm".into(),
        "cm" | "centimeter" | "centimetre" => "10 mm".into(),
        "inch" | "in" => "25.4 mm".into(),
        "meter" | "metre" => "1 m".into(),
        _ => format!("1 {unit}"),
    };
    quantity.parse::<Quantity<Length>>().ok().map(Quantity::si)
}

/// The voxel edge of a stack and where it comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VoxelEdge {
    /// Edge of the cubic voxel, m.
    pub metres: f64,
    /// `--voxel` or the kind of metadata.
    pub from: &'static str,
}

impl VoxelEdge {
    /// The edge given by the user, else the one the stack's metadata state.
    ///
    /// # Errors
    /// Neither says, or the stack's voxels are no cubes.
    pub fn resolve(
        given: Option<f64>,
        stated: Option<&VoxelSize>,
        name: &str,
    ) -> Result<Self, Error> {
        if let Some(metres) = given {
            let from = "--voxel";
            return Ok(Self { metres, from });
        }
        let stated = stated.ok_or_else(|| {
            Error::Usage(format!(
                "{name} does not say how large a voxel is; give its edge, e.g. --voxel '1.45 um'"
            ))
        })?;
        let metres = stated.cube_edge().map_err(|what| Error::file(name, what))?;
        let from = stated.from;
        let accepted = limits::VOXEL_M;
        if !accepted.contains(&metres) {
            return Err(Error::file(
                name,
                format!(
                    "{from} says a voxel is {metres:e} m; accepted are {:e} to {:e} m: give the true edge with --voxel",
                    accepted.start(),
                    accepted.end()
                ),
            ));
        }
        Ok(Self { metres, from })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(a: f64, b: f64) -> bool {
        (a - b).abs() < 1e-12 * b
    }

    #[test]
    fn cubes_to_one_per_cent() {
        let size = |z| VoxelSize::new(1.45e-6, 1.45e-6, z, "test").unwrap();
        assert_eq!(size(None).cube_edge(), Ok(1.45e-6));
        assert_eq!(size(Some(1.45e-6)).cube_edge(), Ok(1.45e-6));
        let near = size(Some(1.46e-6)).cube_edge().unwrap();
        assert!(near > 1.45e-6 && near < 1.46e-6);
        let said = size(Some(2.9e-6)).cube_edge().unwrap_err();
        assert!(said.contains("1.45 x 1.45 x 2.9 um"), "{said}");
        assert_eq!(VoxelSize::new(0.0, 1.0, None, "test"), None);
        assert_eq!(VoxelSize::new(1.0, f64::INFINITY, None, "test"), None);
    }

    #[test]
    fn resolution_tags_but_not_printer_defaults() {
        let edge = |x, unit| VoxelSize::from_resolution(x, x, unit).map(|s| s.cube_edge().unwrap());
        assert!(close(edge(10_000.0, 3).unwrap(), 1e-6));
        assert!(close(edge(25_400.0, 2).unwrap(), 1e-6));
        assert_eq!(edge(72.0, 2), None);
        assert_eq!(edge(1.0, 1), None);
    }

    #[test]
    fn units_as_programs_spell_them() {
        for micron in ["micron", "um", "µm", "μm", "\\u00B5m", "Microns"] {
            assert!(close(metres_of_unit(micron).unwrap(), 1e-6), "{micron}");
        }
        assert!(close(metres_of_unit("inch").unwrap(), 0.0254));
        assert_eq!(metres_of_unit("pixel"), None);
    }
}
