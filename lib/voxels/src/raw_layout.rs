//! How a file of nothing but pixels is to be read; only its owner knows.

use std::str::FromStr;

use crate::sample::Sample;

/// Numbers of voxels along x (columns), y (rows), z (pages): `400x394x400`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Dims(pub [usize; 3]);

impl FromStr for Dims {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let number = |n: &str| n.trim().parse().ok().filter(|n: &usize| *n > 0);
        let dims: Option<Vec<usize>> = text.split('x').map(number).collect();
        let dims = dims.and_then(|dims| dims.try_into().ok()).map(Self);
        dims.ok_or_else(|| {
            format!("'{text}' is no size; accepted is XxYxZ in voxels, as in 400x394x400")
        })
    }
}

/// Number type of a raw file and its byte order: `u8`, `u16`, `u16be`, `f32` ...
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RawType {
    pub(crate) sample: Sample,
    pub(crate) big_endian: bool,
}

impl FromStr for RawType {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (name, big_endian) = match text.strip_suffix("be") {
            Some(name) => (name, true),
            None => (text.strip_suffix("le").unwrap_or(text), false),
        };
        let sample = Sample::named(name).ok_or_else(|| {
            format!(
                "'{text}' is no number type; accepted are u8, i8, u16, i16, u32, i32, u64, i64, f32 and f64, little-endian, or with be behind it"
            )
        })?;
        Ok(Self { sample, big_endian })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_and_types_as_people_write_them() {
        assert_eq!("3x4x50".parse(), Ok(Dims([3, 4, 50])));
        for bad in ["3x4", "3x4x0", "3x4x5x6", "", "axbxc", "-1x2x3"] {
            assert!(bad.parse::<Dims>().is_err(), "{bad}");
        }
        let kind: RawType = "u16be".parse().unwrap();
        assert!(kind.sample == Sample::U16 && kind.big_endian);
        assert_eq!("f32".parse::<RawType>(), "f32le".parse());
        assert!("u12".parse::<RawType>().is_err());
    }
}
