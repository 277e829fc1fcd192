//! Stacks of several files that tell of one another, and planes that only a program's own tag tells of.

use std::fs;
use std::path::Path;

use crate::check::*;
use crate::tiff_file::*;

/// An OME description with these TiffData.
fn ome(data: &str) -> String {
    let [nx, ny, nz] = DIMS;
    format!(
        "<?xml version=\"1.0\"?><OME><Image><Pixels SizeX=\"{nx}\" SizeY=\"{ny}\" SizeZ=\"{nz}\" SizeC=\"1\" SizeT=\"1\" PhysicalSizeX=\"2\" PhysicalSizeY=\"2\" PhysicalSizeZ=\"2\">{data}</Pixels></Image></OME>"
    )
}

/// A page of plane `z` in a directory of a file.
fn block(z: usize, directory: usize, file: &str) -> String {
    format!(
        "<TiffData FirstZ=\"{z}\" IFD=\"{directory}\"><UUID FileName=\"{file}\">urn:uuid:{z}</UUID></TiffData>"
    )
}

/// `planes` of the test volume, the first with a description, in a file.
fn write(path: &Path, planes: &[usize], description: &str) {
    let mut pages: Vec<Page> = planes.iter().map(|&z| plain_pages().remove(z)).collect();
    pages[0] = pages[0].clone().described(description);
    fs::write(path, tiff(&pages)).unwrap();
}

/// A page in each of four files, whose names are in another order than their planes.
#[test]
fn ome_planes_of_single_page_files_are_one_volume() {
    let names = ["d", "c", "b", "a"].map(|name| format!("w_{name}1.ome.tif"));
    let text = ome(&[0, 1, 2, 3].map(|z| block(z, 0, &names[z])).concat());
    let folder = tempfile::tempdir().unwrap();
    let path = |z: usize| folder.path().join(&names[z]);
    // A description may stand in one file alone.
    let elsewhere = format!("<OME><BinaryOnly MetadataFile=\"{}\"/></OME>", names[0]);
    (0..4).for_each(|z| write(&path(z), &[z], if z == 0 { &text } else { &elsewhere }));
    assert_volume("by the first", &path(0), PLAIN);
    assert_has(&refusal(&path(2)), &["stands in 'w_d1.ome.tif'"]);
    (0..4).for_each(|z| write(&path(z), &[z], &text));
    assert_volume("by one", &path(2), PLAIN);
    assert_edge(&path(1), 2e-6);
    assert_eq!(open(&path(1)).sources().len(), 4);
    fs::remove_file(path(3)).unwrap();
    assert_has(&refusal(&path(0)), &["w_a1.ome.tif' cannot be read"]);
}

#[test]
fn ome_slices_in_a_folder_are_one_volume() {
    let folder = tempfile::tempdir().unwrap();
    let name = |z: usize| format!("w_Z{z}.ome.tif");
    let text = ome(&[0, 1, 2, 3].map(|z| block(z, 0, &name(z))).concat());
    (0..4).for_each(|z| write(&folder.path().join(name(z)), &[z], &text));
    assert_volume("folder", folder.path(), PLAIN);
    write(&folder.path().join(name(4)), &[0], &text);
    let said = refusal(folder.path());
    assert_has(&said, &["tells of 4 files, and 5 slices are given"]);
}

/// Two pages in each of two files, of which one does not say its own name.
#[test]
fn several_pages_in_each_file() {
    let folder = tempfile::tempdir().unwrap();
    let [first, second] = ["a.ome.tif", "b.ome.tif"].map(|name| folder.path().join(name));
    let text = |own: &str| {
        let first = format!("<TiffData FirstZ=\"0\" IFD=\"0\" PlaneCount=\"2\">{own}</TiffData>");
        ome(&[first, block(3, 0, "b.ome.tif"), block(2, 1, "b.ome.tif")].concat())
    };
    let named = text("<UUID FileName=\"a.ome.tif\"/>");
    write(&first, &[0, 1], &named);
    write(&second, &[3, 2], &named);
    assert_volume("two", &first, PLAIN);
    assert_volume("two", &second, PLAIN);
    // One name alone is the file's own, whatever it is called.
    write(&first, &[0, 1], &text(""));
    assert_has(
        &refusal(&first),
        &["declares 4 planes but it holds 2 pages"],
    );
}

#[test]
fn pages_of_one_file_in_another_order() {
    let (_folder, path) = stored("renamed.ome.tif", b"");
    let blocks = |places: &[(usize, usize)]| {
        let blocks = places.iter().map(|&(z, at)| block(z, at, "old.ome.tif"));
        ome(&blocks.collect::<String>())
    };
    let permuted = blocks(&[(0, 1), (1, 3), (2, 0), (3, 2)]);
    write(&path, &[2, 0, 3, 1], &permuted);
    assert_volume("permuted", &path, PLAIN);
    for whole in ["<TiffData/>", "<TiffData IFD=\"0\" PlaneCount=\"4\"/>"] {
        write(&path, &[0, 1, 2, 3], &ome(whole));
        assert_volume(whole, &path, PLAIN);
    }
    for (places, said) in [
        (
            &[(0, 0), (1, 1), (2, 2), (3, 2)][..],
            "a page at two planes",
        ),
        (&[(0, 0), (1, 1), (2, 2), (3, 4)], "plane 3, which is none"),
        (&[(0, 0), (0, 1)], "plane 0, which is none or has one"),
        (&[(0, 0), (1, 1)], "no page for plane 2"),
        (&[(9, 0)], "plane 9"),
    ] {
        write(&path, &[0, 1, 2, 3], &blocks(places));
        assert_has(&refusal(&path), &[said]);
    }
}

/// MetaMorph's STK has a directory for its first plane and a tag with a value for each.
#[test]
fn planes_that_the_tag_of_stk_counts() {
    let [nx, ny, nz] = DIMS;
    let strips = |rows: usize| {
        let page = plain_pages().remove(0).strips(rows);
        let mut page = page.longs(33628, &[0, 0]).longs(33629, &vec![1; nz]);
        let lengths: Vec<u32> = page.chunks.iter().map(|c| c.len() as u32).collect();
        // The other planes stand in the last strip's chunk, behind the first plane.
        let others = pages()[1..].concat();
        page.chunks.last_mut().unwrap().extend(others);
        page.longs(279, &lengths)
    };
    for rows in [ny, 4] {
        assert_file("a.stk", &tiff(&[strips(rows)]), PLAIN);
    }
    let mut cut = strips(ny);
    cut.chunks[0].truncate(3 * nx * ny);
    assert_refused("a.stk", &tiff(&[cut]), &["truncated"]);
}
