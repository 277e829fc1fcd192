//! Copies of one volume give the same particle file however it is named, and grey values are proposed;
//! the formats themselves are tested in `lib/voxels`.

use std::fs;
use std::path::Path;
use std::process::{Command, Output, Stdio};

use particle_file::ParticleFile;

const DIMS: [usize; 3] = [31, 20, 6];

/// Bands along y: wood, adhesive, void, wood.
fn label(i: usize) -> u8 {
    [1, 2, 0, 1][i / DIMS[0] % DIMS[1] / 5]
}

fn volume() -> Vec<u8> {
    (0..DIMS.iter().product()).map(label).collect()
}

fn run(folder: &Path, arguments: &[&str]) -> Output {
    let mut tool = Command::new(env!("CARGO_BIN_EXE_xct2particles"));
    let tool = tool.args(arguments).current_dir(folder);
    tool.stdin(Stdio::null()).output().unwrap()
}

fn done(folder: &Path, arguments: &[&str]) -> String {
    let output = run(folder, arguments);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "{arguments:?}: {said}");
    said
}

/// All that a particle file holds but how it was made.
fn content(path: &Path) -> impl PartialEq + std::fmt::Debug + use<> {
    let file = ParticleFile::open(path).unwrap();
    let mut header = file.header().clone();
    header.provenance.clear();
    let blocks = ["wood", "adhesive"];
    let words = blocks.map(|name| file.block_named(name).unwrap().1.words().to_vec());
    (format!("{header:?}"), words)
}

#[test]
fn copies_with_and_without_a_header_and_slices_give_the_same_particle_file() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, parts: &[&[u8]]| fs::write(folder.path().join(name), parts.concat());
    let [nx, ny, nz] = DIMS;
    let all = volume();
    write("a.raw", &[&all]).unwrap();
    let wide: Vec<u8> = all
        .iter()
        .flat_map(|l| u16::from(*l).to_be_bytes())
        .collect();
    write("wide.raw", &[&wide]).unwrap();
    let nrrd =
        format!("NRRD0004\ntype: uchar\ndimension: 3\nsizes: {nx} {ny} {nz}\nencoding: raw\n\n");
    write("a.nrrd", &[nrrd.as_bytes(), &all]).unwrap();
    let tiff = |pages: &[u8]| {
        let mut bytes = Vec::new();
        let dims = [nx, ny, pages.len() / (nx * ny)];
        let mut tiff = voxels::TiffWriter::new(&mut bytes, dims, 2e-6).unwrap();
        (pages.chunks(nx * ny)).for_each(|page| tiff.write_page(page).unwrap());
        tiff.finish().unwrap();
        bytes
    };
    write("a.tif", &[&tiff(&all)]).unwrap();
    fs::create_dir(folder.path().join("slices")).unwrap();
    for (z, page) in all.chunks(nx * ny).enumerate() {
        write(&format!("slices/s{z}.tif"), &[&tiff(page)]).unwrap();
    }

    let size = ["--voxel", "2 um", "--labels", "void=0,wood=1,adhesive=2"];
    let made = |stack: &[&str]| {
        done(folder.path(), &[stack, &size, &["-o", "out.mpts"]].concat());
        content(&folder.path().join("out.mpts"))
    };
    let expected = made(&["a.tif"]);
    for stack in [
        &["a.raw", "--dims", "31x20x6", "--type", "u8"][..],
        &["wide.raw", "--dims", "31x20x6", "--type", "u16be"],
        &["a.nrrd"],
        &["slices"],
    ] {
        assert!(made(stack) == expected, "{stack:?}");
    }
    // A page more than is declared was passed over.
    for name in ["a.nrrd", "a.raw"] {
        let longer = [
            fs::read(folder.path().join(name)).unwrap(),
            vec![0; nx * ny],
        ]
        .concat();
        fs::write(folder.path().join(name), longer).unwrap();
    }
    let wrong = run(
        folder.path(),
        &["a.nrrd", "--voxel", "2 um", "-o", "o.mpts"],
    );
    let said = String::from_utf8_lossy(&wrong.stderr);
    assert_eq!(wrong.status.code(), Some(3), "{said}");
    assert!(said.contains("620 bytes stand behind"), "{said}");
    fs::remove_file(folder.path().join("slices/s3.tif")).unwrap();
    let said = done(
        folder.path(),
        &[&["slices"], &size[..], &["-o", "o.mpts"]].concat(),
    );
    assert!(
        said.contains("s2.tif' and 'slices/s4.tif' it is 2"),
        "{said}"
    );
    let wrong = run(
        folder.path(),
        &["a.raw", "--dims", "3x3x3", "-o", "out.mpts"],
    );
    assert_eq!(wrong.status.code(), Some(2));
    let wrong = ["a.raw", "--dims", "30x20x6", "--type", "u8", "-o", "o.mpts"];
    let wrong = run(folder.path(), &wrong);
    let said = String::from_utf8_lossy(&wrong.stderr);
    assert_eq!(wrong.status.code(), Some(2), "{said}");
    assert!(said.contains("3600") && said.contains("4340"), "{said}");
}

#[test]
fn grey_values_are_counted_proposed_and_taken() {
    let folder = tempfile::tempdir().unwrap();
    // Three peaks of seven values each.
    let grey = |i: usize| 10_000 + 8_000 * [1_u16, 2, 0, 1][i / 31 % 20 / 5] + (i % 7) as u16;
    let words: Vec<u8> = (0..31 * 20 * 6)
        .flat_map(|i| grey(i).to_le_bytes())
        .collect();
    fs::write(folder.path().join("a.raw"), words).unwrap();
    let raw = [
        "a.raw", "--dims", "31x20x6", "--type", "u16", "--voxel", "2 um",
    ];
    let said = done(
        folder.path(),
        &[&raw[..], &["--histogram", "h.csv"]].concat(),
    );
    assert!(said.contains("--grey wood="), "{said}");
    let table = fs::read_to_string(folder.path().join("h.csv")).unwrap();
    let mut rows = table.lines();
    assert_eq!(rows.next(), Some("grey,voxels"));
    assert!(rows.next().unwrap().starts_with("10000,"));
    let counts = rows.map(|row| row.split(',').nth(1).unwrap().parse::<u64>().unwrap());
    let first: u64 = table.lines().nth(1).unwrap()[6..].parse().unwrap();
    assert_eq!(first + counts.sum::<u64>(), 31 * 20 * 6);

    let auto = [&raw[..], &["--grey", "auto", "-o", "a.mpts"]].concat();
    done(folder.path(), &auto);
    let file = ParticleFile::open(folder.path().join("a.mpts")).unwrap();
    let count = |name| file.block_named(name).unwrap().1.count();
    assert_eq!(
        [count("wood"), count("adhesive")],
        [31 * 10 * 6, 31 * 5 * 6]
    );

    let alone = [
        "a.raw",
        "--dims",
        "62x20x6",
        "--type",
        "u8",
        "--voxel",
        "2 um",
        "--labels",
        "void=0,wood=1",
    ];
    let refused = run(folder.path(), &[&alone[..], &["-o", "w.mpts"]].concat());
    let said = String::from_utf8_lossy(&refused.stderr);
    assert!(said.contains("no phase has that label"), "{said}");
}
