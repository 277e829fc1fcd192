//! How large a voxel is, by a file's metadata.

use std::fmt;
use std::ops::RangeInclusive;

use particle_file::Header;
use units::{Length, Quantity};

use crate::Error;

/// How far the edges of a voxel may differ and still make a cube.
const CUBE_TOLERANCE: f64 = 0.01;
/// Edges (m) that are believed: what lies beyond is mostly what programs write by default, or in another unit than they
/// say.
const BELIEVED: RangeInclusive<f64> = 1e-8..=50e-6;
/// Edges (m) of voxels in which cells of wood are seen.
const USUAL: RangeInclusive<f64> = 0.1e-6..=20e-6;
/// Dots per inch of screens, printers and scanners, which image programs write by default; they
/// do not say how large a voxel is.
const DEFAULT_DPI: [f64; 8] = [72.0, 96.0, 150.0, 300.0, 600.0, 1200.0, 2400.0, 4800.0];
/// How far a rounded resolution may be from one of them.
const DPI_TOLERANCE: f64 = 1e-3;

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

    /// A size from edges along x, y, z and their units as metadata spell them.
    pub(crate) fn in_units(edges: [f64; 3], units: [&str; 3], from: &'static str) -> Option<Self> {
        let metres = |i: usize| Some(edges[i] * metres_of_unit(units[i])?);
        Self::new(metres(0)?, metres(1)?, Some(metres(2)?), from)
    }

    /// A size from pixels per centimetre or inch (TIFF tags 282, 283, 296).
    pub(crate) fn from_resolution(x: f64, y: f64, unit: u64) -> Option<Self> {
        let metres = match unit {
            2 => 0.0254,
            3 => 0.01,
            _ => return None,
        };
        let dpi = 0.0254 * x / metres;
        let default = |usual: &f64| (dpi / usual - 1.0).abs() <= DPI_TOLERANCE;
        if DEFAULT_DPI.iter().any(default) {
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
    /// A sentence when the voxels are not cubes.
    pub fn cube_edge(&self) -> Result<f64, String> {
        let (x, y, z) = self.edges;
        let z = z.unwrap_or(x);
        let (low, high) = (x.min(y).min(z), x.max(y).max(z));
        if high > low * (1.0 + CUBE_TOLERANCE) {
            return Err(format!(
                "by {} a voxel is {self}; voxels must be cubes to 1 %: resample the stack, or give the true edge with --voxel",
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
    (metres * 1e12).round() / 1e6
}

/// A number as people and programs write it, with a point or a comma before its decimals.
pub(crate) fn decimal(text: &str) -> Option<f64> {
    let text = text.trim();
    let number = match text.contains('.') {
        true => text.parse(),
        false => text.replacen(',', ".", 1).parse(),
    };
    number.ok().filter(|n: &f64| n.is_finite())
}

/// Metres of `1 unit` where `unit` is spelled as imaging programs do; none for pixels and
/// for units that are not lengths.
pub(crate) fn metres_of_unit(unit: &str) -> Option<f64> {
    // ImageJ escapes the sign of micro; read in another encoding it is two letters.
    let unit = unit.trim().trim_matches('"').to_lowercase();
    let unit = unit
        .replace("\\u00b5", "µ")
        .replace("\\u03bc", "µ")
        .replace("âµ", "µ");
    let quantity = match unit.trim_end_matches('s') {
        "micron" | "micrometer" | "micrometre" | "mu" | "µ" => "1 um".into(),
        "millimeter" | "millimetre" => "1 mm".into(),
        "nanometer" | "nanometre" => "1 nm".into(),
        "angstrom" | "ångström" | "å" => "0.1 nm".into(),
        "cm" | "centimeter" | "centimetre" => "10 mm".into(),
        "inch" | "inche" | "in" => "25.4 mm".into(),
        "meter" | "metre" => "1 m".into(),
        short => format!("1 {short}"),
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
        let Some(stated) = stated else {
            return Err(Error::Usage(format!(
                "{name} does not say how large a voxel is, in a unit of length; give its edge, e.g. --voxel '1.45 um'"
            )));
        };
        let refused = |why: String| Error::Usage(format!("{name}: {why}"));
        let (metres, from) = (stated.cube_edge().map_err(refused)?, stated.from);
        let edge = Self { metres, from };
        if !edge.is_believed() {
            return Err(refused(format!(
                "by {from} a voxel is {}, which is mostly a default or a wrong unit (believed are {} to {}): give the true edge with --voxel",
                length(metres),
                length(*BELIEVED.start()),
                length(*BELIEVED.end())
            )));
        }
        Ok(edge)
    }

    /// A sentence about an edge that is rare for wood, and may be in a wrong unit.
    pub fn doubt(&self) -> Option<String> {
        doubt(self.metres, self.from)
    }

    /// Whether cells of wood may be seen in such voxels.
    pub fn is_believed(&self) -> bool {
        BELIEVED.contains(&self.metres)
    }
}

/// [`VoxelEdge::doubt`] of the voxels of a particle file.
pub fn doubt_of_file(header: &Header) -> Option<String> {
    let from = header.attribute("voxel_from");
    doubt(header.voxel_m, from.unwrap_or("the particle file"))
}

fn doubt(metres: f64, from: &str) -> Option<String> {
    (!USUAL.contains(&metres)).then(|| {
        format!(
            "a voxel is {} by {from} (is the unit right?), and cells of wood are seen in voxels of {} to {}",
            length(metres),
            length(*USUAL.start()),
            length(*USUAL.end())
        )
    })
}

/// A length with its unit.
fn length(metres: f64) -> String {
    match metres {
        1e-12..1e-3 => format!("{} um", micrometres(metres)),
        1e-3..1.0 => format!("{} mm", micrometres(metres) / 1e3),
        _ => format!("{metres:e} m"),
    }
}

#[cfg(test)]
mod tests {
    use particle_file::Kind;

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
        // Rounded, or written per centimetre; in no unit.
        for (x, unit) in [
            (72.0, 2),
            (72.009, 2),
            (28.35, 3),
            (236.22, 3),
            (4800.0, 2),
            (1.0, 1),
        ] {
            assert_eq!(edge(x, unit), None, "{x} {unit}");
        }
    }

    #[test]
    fn numbers_and_units_as_programs_spell_them() {
        for (names, metres) in [
            (
                "micron um µm μm \\u00B5m \\u03bcm Âµm Microns micrometers \"um\" µ",
                1e-6,
            ),
            ("nm nanometre", 1e-9),
            ("mm millimeter", 1e-3),
            ("cm centimetre", 1e-2),
            ("in inch inches", 0.0254),
            ("m meter", 1.0),
        ] {
            for name in names.split(' ') {
                assert!(close(metres_of_unit(name).unwrap(), metres), "{name}");
            }
        }
        for none in ["pixel", "pixels", "", "s", "voxel", "gray", "1 um"] {
            assert_eq!(metres_of_unit(none), None, "{none}");
        }
        assert_eq!([" 1,45 ", "1.45"].map(decimal), [Some(1.45); 2]);
        for none in ["1,450.5", "1.450,5", "1,4,5", "", "nan", "inf", "x"] {
            assert_eq!(decimal(none), None, "{none}");
        }
    }

    #[test]
    fn sizes_that_a_file_is_not_believed_need_the_argument() {
        let stated = |metres| VoxelSize::new(metres, metres, None, "test");
        let resolve = |given, metres| VoxelEdge::resolve(given, stated(metres).as_ref(), "'a'");
        for (metres, said) in [(1e-3, "1 mm"), (50.1e-6, "50.1 um"), (9e-9, "0.009 um")] {
            let error = resolve(None, metres).unwrap_err();
            assert!(error.is_usage());
            let error = error.to_string();
            assert!(error.contains(said) && error.contains("--voxel"), "{error}");
            assert_eq!(resolve(Some(1e-3), metres).unwrap().metres, 1e-3);
        }
        assert_eq!(resolve(None, 50e-6).unwrap().metres, 50e-6);
    }

    #[test]
    fn edges_beyond_what_shows_cells_are_doubted() {
        let from = "--voxel";
        let doubt = |metres| VoxelEdge { metres, from }.doubt();
        assert_eq!([1.45e-6, 0.1e-6, 20e-6].map(doubt), [None, None, None]);
        assert!(doubt(1.45e-3).unwrap().contains("1.45 mm by --voxel"));
        assert!(doubt(0.09e-6).unwrap().contains("unit"));
        let header = |edge| Header::new(Kind::Bond, edge, 1, [0.0; 3], [edge; 3]);
        assert_eq!(doubt_of_file(&header(1.45e-6)), None);
        let said = doubt_of_file(&header(100e-6)).unwrap();
        assert!(said.contains("100 um by the particle file"), "{said}");
    }
}
