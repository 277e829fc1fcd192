//! Copies of one small volume in every format are one volume; whatever is none is refused with a sentence. Files are
//! built byte by byte, independently of the readers.

#![allow(clippy::print_stdout, reason = "prints for developers")]

mod arrays;
mod build;
mod check;
mod colours;
mod damaged;
mod grey_auto;
mod headers;
mod refused;
mod slices;
mod tiff_descriptions;
mod tiff_file;
mod tiff_layouts;
mod tiff_samples;
mod tiff_sets;
mod values;
