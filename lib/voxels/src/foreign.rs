//! Formats of volumes that are not read, and how to come from them to one that is.

use std::path::Path;

/// The conversion for a file that begins with `head`, where its format is known.
pub(crate) fn conversion(head: &[u8]) -> Option<&'static str> {
    let text = |at: usize, magic: &[u8]| head.get(at..).is_some_and(|h| h.starts_with(magic));
    if text(0, b"\x89HDF\r\n\x1a\n") {
        Some(
            "it is HDF5, which is not read; save its data set as .npy: python3 -c \"import h5py, numpy; numpy.save('stack.npy', h5py.File('FILE')['NAME'])\"",
        )
    } else if text(0, b"# AmiraMesh") || text(0, b"# Avizo") || text(0, b"# HyperSurface") {
        Some(
            "it is Amira or Avizo, which is not read; save it as 3D TIFF there (Export Data As), or in Fiji: open it and File > Save As > Tiff",
        )
    } else if text(128, b"DICM") {
        Some(
            "it is DICOM, which is not read; save the series as one TIFF in Fiji (File > Import > Image Sequence, then Save As > Tiff), or as .nii.gz with dcm2niix",
        )
    } else {
        None
    }
}

/// The conversion for a folder without slices, where it is of a known format.
pub(crate) fn conversion_of_folder(folder: &Path) -> Option<&'static str> {
    let zarr = [".zarray", ".zgroup", "zarr.json"];
    if zarr.iter().any(|name| folder.join(name).exists()) {
        return Some(
            "it is Zarr, which is not read; save its array as .npy: python3 -c \"import zarr, numpy; numpy.save('stack.npy', zarr.open('FOLDER')[:])\"",
        );
    }
    let dicom = |entry: std::fs::DirEntry| {
        let path = entry.path();
        path.extension()
            .is_some_and(|e| e.eq_ignore_ascii_case("dcm"))
    };
    let mut entries = std::fs::read_dir(folder).ok()?.flatten();
    entries
        .any(dicom)
        .then_some("it holds DICOM slices, which are not read; save the series as one TIFF in Fiji (File > Import > Image Sequence, then Save As > Tiff), or as .nii.gz with dcm2niix")
}
