//! Files that are no volume: a table of what they are built of and of what is said of them.

use crate::build::*;
use crate::check::*;
use crate::tiff_descriptions::single_directory;
use crate::tiff_file::tiff;

const TABLE: &str = include_str!("refused.txt");

/// The files of a line of the table.
fn built(cells: &[&str]) -> Vec<Vec<u8>> {
    let all = volume();
    match *cells {
        ["mhd", kind, more, file] => vec![mhd(kind, more, file)],
        ["nrrd", kind, encoding, more] => vec![nrrd(kind, encoding, more, &[])],
        ["npy", descr, shape] => [false, true]
            .map(|fortran| npy(1, descr, fortran, shape, &all))
            .into(),
        ["npy header", header] => vec![npy_with(1, header, &all)],
        ["nifti", kind, at, byte] => {
            let mut file = nifti(false, kind.parse().unwrap(), &all);
            file[at.parse::<usize>().unwrap()] = byte.parse().unwrap();
            vec![file]
        }
        ["tiff", description] => vec![tiff(&[single_directory(description)])],
        _ => panic!("no file is built of {cells:?}"),
    }
}

#[test]
fn what_is_no_volume_is_refused_with_a_sentence() {
    let is_row = |line: &&str| !line.is_empty() && !line.starts_with('#');
    for line in TABLE.lines().filter(is_row) {
        let line = line.replace("\\n", "\n");
        let cells: Vec<&str> = line.split('|').map(|cell| cell.trim_matches(' ')).collect();
        let (said, cells) = cells.split_last().unwrap();
        for file in built(cells) {
            assert_refused("a", &file, &[said]);
        }
    }
}
