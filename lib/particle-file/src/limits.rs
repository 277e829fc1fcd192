//! The bounds on what is read, in one place. They stand far above what a specimen, a scan or a
//! case needs; beyond them a number is a mistake or an attack, and is refused before anything is
//! computed or allocated from it.

use std::ops::RangeInclusive;

/// Most voxels of a stack or block, and most cells of a grid, along an axis.
pub const PER_AXIS: u64 = 100_000;
/// Most voxels along an axis of the box around all there is in a particle file: a run without
/// wood writes voxels of half a cell.
pub const SPAN_PER_AXIS: u64 = 2 * PER_AXIS;
/// Edges that a voxel may have, m: half the smallest and twice the largest length that tools
/// accept as an argument.
pub const VOXEL_M: RangeInclusive<f64> = 0.5e-12..=2e9;
/// How far from zero a coordinate may be, in voxels: the next voxel must be another number.
pub const FROM_ZERO: f64 = 1e9;
/// Longest name of a block, an array or an attribute, bytes.
pub const NAME: usize = 255;
/// Most arrays of a particle file.
pub const ARRAYS: usize = 1024;

/// What may be made of an input that only describes it, such as voxels of an image or rows of a
/// map, in bytes for each byte of the input. A sound file of bits has eight voxels a byte.
pub const MADE_PER_BYTE: u64 = 64;
/// What may be made of any input, however small, bytes.
pub const MADE_AT_LEAST: u64 = 32 << 20;

/// Most cells of a run's grid for each byte of its bond file; a sound file has one to eight.
pub const CELLS_PER_BYTE: u64 = 64;
/// Cells that a run may have however small its bond file.
pub const CELLS_AT_LEAST: u64 = 1 << 22;

/// Most voxels of a stack for each byte of its files: deflate packs 1032 bytes into one, and a
/// byte holds eight pixels of one bit.
pub const VOXELS_PER_BYTE: u64 = 8 * 1032;

/// Longest table that figures are drawn from, bytes; a million rows of a history take 200 MB.
pub const TABLE: u64 = 1 << 28;
/// Longest case file, bytes.
pub const CASE: u64 = 1 << 20;

/// Bytes that may be made of an input of `len` bytes.
pub fn made_of(len: u64) -> u64 {
    MADE_AT_LEAST.saturating_add(len.saturating_mul(MADE_PER_BYTE))
}

/// Cells that a run of a bond file of `len` bytes may have.
pub fn cells_of(len: u64) -> u64 {
    CELLS_AT_LEAST.saturating_add(len.saturating_mul(CELLS_PER_BYTE))
}

/// The product of three numbers, as large as numbers go where it is larger.
pub fn volume(dims: [u64; 3]) -> u64 {
    dims.into_iter().fold(1, u64::saturating_mul)
}
