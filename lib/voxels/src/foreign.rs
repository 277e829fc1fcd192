//! Formats of volumes that are not read, and how to come from them to one that is.

use std::path::Path;

const DICOM: &str = "DICOM, which is not read; save the series as one TIFF in Fiji (File > Import > Image Sequence, then Save As > Tiff), or as .nii.gz with dcm2niix";
const HDF5: &str = "HDF5, which is not read; save its data set as .npy: python3 -c \"import h5py, numpy; numpy.save('stack.npy', h5py.File('FILE')['NAME'])\"";
const AMIRA: &str = "Amira or Avizo, which is not read; save it as 3D TIFF there (Export Data As), or in Fiji: open it and File > Save As > Tiff";
const ZARR: &str = "Zarr, which is not read; save its array as .npy: python3 -c \"import zarr, numpy; numpy.save('stack.npy', zarr.open('FOLDER')[:])\"";

/// What it is and the conversion for a file that begins with `head`, where its format is known.
pub(crate) fn conversion(head: &[u8]) -> Option<&'static str> {
    let formats: [(usize, &[u8], _); 5] = [
        (0, b"\x89HDF\r\n\x1a\n", HDF5),
        (0, b"# AmiraMesh", AMIRA),
        (0, b"# Avizo", AMIRA),
        (0, b"# HyperSurface", AMIRA),
        (128, b"DICM", DICOM),
    ];
    let is = |at, magic| head.get(at..).is_some_and(|h| h.starts_with(magic));
    let known = formats.into_iter().find(|(at, magic, _)| is(*at, *magic));
    known.map(|(.., conversion)| conversion)
}

/// As [`conversion`], for a folder without slices.
pub(crate) fn conversion_of_folder(folder: &Path) -> Option<&'static str> {
    let zarr = [".zarray", ".zgroup", "zarr.json"];
    if zarr.iter().any(|name| folder.join(name).exists()) {
        return Some(ZARR);
    }
    let mut entries = std::fs::read_dir(folder).ok()?.flatten();
    let is_dicom = |ending: &std::ffi::OsStr| ending.eq_ignore_ascii_case("dcm");
    let dicom = entries.any(|entry| entry.path().extension().is_some_and(is_dicom));
    dicom.then_some(DICOM)
}
