//! Stacks of several files that tell of one another, and planes that only a program's own tag tells of.

use std::fs;
use std::path::Path;

use voxels::Stack;

use crate::common::*;

const PLAIN: [&str; 3] = ["0", "1", "2"];

/// An OME description with these TiffData.
fn ome(data: &str) -> String {
    let [nx, ny, nz] = DIMS;
    format!(
        "<?xml version=\"1.0\"?><OME><Image><Pixels SizeX=\"{nx}\" SizeY=\"{ny}\" SizeZ=\"{nz}\" SizeC=\"1\" SizeT=\"1\" PhysicalSizeX=\"2\" PhysicalSizeY=\"2\" PhysicalSizeZ=\"2\">{data}</Pixels></Image></OME>"
    )
}

/// `planes` of the test volume, the first with a description, in a file.
fn write(path: &Path, planes: &[usize], description: &str) {
    let mut pages: Vec<Page> = planes.iter().map(|&z| plain_pages().remove(z)).collect();
    pages[0] = (pages[0].clone()).tag(270, Value::Ascii(description.into()));
    fs::write(path, tiff(CLASSIC, &pages)).unwrap();
}

fn said(path: &Path) -> String {
    Stack::open(&[path.to_owned()]).unwrap_err().to_string()
}

/// A page in each of four files, whose names are in another order than their planes.
#[test]
fn a_page_in_each_file() {
    let names = ["d", "c", "b", "a"].map(|name| format!("w_{name}1.ome.tif"));
    let block = |z: usize| {
        format!(
            "<TiffData FirstZ=\"{z}\" IFD=\"0\" PlaneCount=\"1\"><UUID FileName=\"{}\">urn:uuid:{z}</UUID></TiffData>",
            names[z]
        )
    };
    let text = ome(&(0..4).map(block).collect::<String>());
    let folder = tempfile::tempdir().unwrap();
    let path = |z: usize| folder.path().join(&names[z]);
    for z in 0..4 {
        write(&path(z), &[z], &text);
        // A description may stand in one file alone.
        if z > 0 {
            let elsewhere = format!("<OME><BinaryOnly MetadataFile=\"{}\"/></OME>", names[0]);
            write(&path(z), &[z], &elsewhere);
        }
    }
    assert_test_volume("by the first", &path(0), PLAIN);
    let refused = said(&path(2));
    assert!(refused.contains("stands in 'w_d1.ome.tif'"), "{refused}");
    (0..4).for_each(|z| write(&path(z), &[z], &text));
    assert_test_volume("by one", &path(2), PLAIN);
    let stack = Stack::open(&[path(1)]).unwrap();
    assert!((stack.voxel_size().unwrap().cube_edge().unwrap() - 2e-6).abs() < 1e-15);
    assert_eq!(stack.sources().len(), 4);
    fs::remove_file(path(3)).unwrap();
    let refused = said(&path(0));
    assert!(
        refused.contains("w_a1.ome.tif' cannot be read"),
        "{refused}"
    );
}

#[test]
fn a_folder_of_them() {
    let folder = tempfile::tempdir().unwrap();
    let path = |z: usize| folder.path().join(format!("w_Z{z}.ome.tif"));
    let block = |z: usize| {
        format!("<TiffData FirstZ=\"{z}\" IFD=\"0\"><UUID FileName=\"w_Z{z}.ome.tif\"/></TiffData>")
    };
    let text = ome(&(0..4).map(block).collect::<String>());
    (0..4).for_each(|z| write(&path(z), &[z], &text));
    assert_test_volume("folder", folder.path(), PLAIN);
    write(&path(4), &[0], &text);
    let refused = said(folder.path());
    assert!(
        refused.contains("tells of 4 files, and 5 slices are given"),
        "{refused}"
    );
}

/// Two pages in each of two files, of which one does not say its own name.
#[test]
fn several_pages_in_each_file() {
    let folder = tempfile::tempdir().unwrap();
    let [first, second] = ["a.ome.tif", "b.ome.tif"].map(|name| folder.path().join(name));
    let named = "<UUID FileName=\"b.ome.tif\"/>";
    for own in ["<UUID FileName=\"a.ome.tif\"/>", ""] {
        let text = ome(&format!(
            "<TiffData FirstZ=\"0\" IFD=\"0\" PlaneCount=\"2\">{own}</TiffData><TiffData FirstZ=\"3\" IFD=\"0\">{named}</TiffData><TiffData FirstZ=\"2\" IFD=\"1\"><UUID FileName=\"b.ome.tif\"/></TiffData>"
        ));
        if own.is_empty() {
            // One name alone is the file's own, whatever it is called.
            write(&first, &[0, 1], &text);
            assert!(said(&first).contains("declares 4 planes but it holds 2 pages"));
            continue;
        }
        write(&first, &[0, 1], &text);
        write(&second, &[3, 2], &text);
        assert_test_volume("two", &first, PLAIN);
        assert_test_volume("two", &second, PLAIN);
    }
}

#[test]
fn pages_of_one_file_in_another_order() {
    let (_folder, path) = stored("renamed.ome.tif", b"");
    let block = |z: usize, directory: usize| {
        format!(
            "<TiffData FirstZ=\"{z}\" IFD=\"{directory}\"><UUID FileName=\"old.ome.tif\"/></TiffData>"
        )
    };
    let blocks = |order: [usize; 4]| {
        let blocks = order.iter().enumerate().map(|(z, &d)| block(z, d));
        ome(&blocks.collect::<String>())
    };
    write(&path, &[2, 0, 3, 1], &blocks([1, 3, 0, 2]));
    assert_test_volume("permuted", &path, PLAIN);
    write(&path, &[0, 1, 2, 3], &ome("<TiffData/>"));
    assert_test_volume("bare", &path, PLAIN);
    write(
        &path,
        &[0, 1, 2, 3],
        &ome("<TiffData IFD=\"0\" PlaneCount=\"4\"/>"),
    );
    assert_test_volume("at once", &path, PLAIN);
    for (text, refused) in [
        (blocks([0, 1, 2, 2]), "a page at two planes"),
        (blocks([0, 1, 2, 4]), "plane 3, which is none"),
        (
            ome(&(block(0, 0) + &block(0, 1))),
            "plane 0, which is none or has one",
        ),
        (ome(&(block(0, 0) + &block(1, 1))), "no page for plane 2"),
        (ome(&block(9, 0)), "plane 9"),
    ] {
        write(&path, &[0, 1, 2, 3], &text);
        assert!(said(&path).contains(refused), "{}", said(&path));
    }
}

/// MetaMorph's STK has a directory for its first plane and a tag with a value for each.
#[test]
fn planes_that_the_tag_of_stk_counts() {
    let [nx, ny, nz] = DIMS;
    let strips = |rows: usize| {
        let mut page = Page::new(nx, ny, 8, Vec::new())
            .tag(278, Value::Long(vec![rows as u32]))
            .tag(33628, Value::Long(vec![0, 0]))
            .tag(33629, Value::Long(vec![1; nz]));
        let first: Vec<Vec<u8>> = pages(|l| [l])[0]
            .chunks(rows * nx)
            .map(<[u8]>::to_vec)
            .collect();
        let lengths: Vec<u32> = first.iter().map(|c| c.len() as u32).collect();
        page.chunks = first;
        // The other planes stand in the last strip's chunk, behind the first plane.
        let last = page.chunks.len() - 1;
        page.chunks[last].extend(pages(|l| [l])[1..].concat());
        page.tag(279, Value::Long(lengths))
    };
    for rows in [ny, 4] {
        let bytes = tiff(CLASSIC, &[strips(rows)]);
        let (_folder, path) = stored("a.stk", &bytes);
        assert_test_volume("STK", &path, PLAIN);
    }
    let mut cut = strips(ny);
    cut.chunks[0].truncate(3 * nx * ny);
    let sentence = refusal("a.stk", &tiff(CLASSIC, &[cut]));
    assert!(sentence.contains("truncated"), "{sentence}");
}

/// Writers leave out tiles that are all 0; strips without bytes are a file cut short.
#[test]
fn tiles_without_bytes_are_empty() {
    let dims = [20, 20, 1];
    let value = |x: usize, y: usize| u8::from(x < 16 && y >= 16) * (1 + (x % 2) as u8);
    let tile: Vec<u8> = (0..256).map(|i| value(i % 16, 16 + i / 16)).collect();
    let page = |chunks: [Vec<u8>; 4]| {
        let mut page = (Page::new(dims[0], dims[1], 8, Vec::new()).short(322, 16)).short(323, 16);
        (page.tiled, page.chunks) = (true, chunks.to_vec());
        page
    };
    let read = |pages: &[Page]| {
        let (_folder, path) = stored("a.tif", &tiff(CLASSIC, pages));
        let stack = Stack::open(&[path]).unwrap();
        // What another page left behind is not shown.
        let mut page = vec![7; 400];
        (0..pages.len()).for_each(|z| stack.read_page(z, &mut page).unwrap());
        page
    };
    let none = Vec::new;
    let stored = [none(), none(), tile.clone(), none()];
    let right: Vec<u8> = (0..400).map(|i| value(i % 20, i / 20)).collect();
    assert_eq!(read(&[page(stored.clone())]), right);
    assert_eq!(
        read(&[page([none(), none(), none(), none()])]),
        vec![0; 400]
    );
    let full = [vec![3; 256], vec![4; 256], vec![5; 256], vec![6; 256]];
    assert_eq!(read(&[page(full), page(stored)]), right);
    let mut strips = Page::new(20, 20, 8, Vec::new()).tag(278, Value::Long(vec![10]));
    strips.chunks = vec![none(), vec![1; 200]];
    assert!(refusal("a.tif", &tiff(CLASSIC, &[strips])).contains("corrupt"));
}
