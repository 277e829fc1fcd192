//! Copies of one volume in several formats give the same particle file, and grey values are
//! proposed.

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
fn copies_in_every_format_give_the_same_particle_file() {
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
    let mhd = format!(
        "NDims = 3\nDimSize = {nx} {ny} {nz}\nElementType = MET_UCHAR\nElementDataFile = a.raw\n"
    );
    write("a.mhd", &[mhd.as_bytes()]).unwrap();
    let npy = format!("{{'descr': '|u1', 'fortran_order': False, 'shape': ({nz}, {ny}, {nx}), }}");
    let npy = format!("{npy:<117}\n");
    let magic = [&b"\x93NUMPY\x01\x00"[..], &(npy.len() as u16).to_le_bytes()].concat();
    write("a.npy", &[&magic, npy.as_bytes(), &all]).unwrap();
    let mut nifti = vec![0; 352];
    let mut put = |at: usize, bytes: &[u8]| nifti[at..at + bytes.len()].copy_from_slice(bytes);
    put(0, &348_u32.to_le_bytes());
    for (i, n) in [3, nx, ny, nz].into_iter().enumerate() {
        put(40 + 2 * i, &(n as u16).to_le_bytes());
    }
    put(70, &2_u16.to_le_bytes());
    put(108, &352_f32.to_le_bytes());
    put(344, b"n+1\0");
    write("a.nii", &[&nifti, &all]).unwrap();
    let mut tiff = Vec::new();
    let mut pages = voxels::TiffWriter::new(&mut tiff, DIMS, 2e-6).unwrap();
    all.chunks(nx * ny)
        .for_each(|page| pages.write_page(page).unwrap());
    pages.finish().unwrap();
    write("a.tif", &[&tiff]).unwrap();
    fs::create_dir(folder.path().join("slices")).unwrap();
    for (z, page) in all.chunks(nx * ny).enumerate() {
        // Grey slices of 8 bits from the top, with a palette of 256 entries.
        let row = nx.div_ceil(4) * 4;
        let mut bmp = b"BM".to_vec();
        for n in [
            0,
            0,
            1078,
            40,
            nx as i32,
            -(ny as i32),
            1 | 8 << 16,
            0,
            0,
            0,
            0,
            256,
            0,
        ] {
            bmp.extend(n.to_le_bytes());
        }
        bmp.extend((0..256_u32).flat_map(|i| (i * 0x01_01_01).to_le_bytes()));
        for pixels in page.chunks(nx) {
            bmp.extend(pixels);
            bmp.resize(bmp.len() + row - nx, 0);
        }
        write(&format!("slices/s{z}.bmp"), &[&bmp]).unwrap();
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
        &["a.mhd"],
        &["a.npy"],
        &["a.nii"],
        &["slices"],
    ] {
        assert!(made(stack) == expected, "{stack:?}");
    }
    // A page more than is declared was passed over.
    for name in ["a.nrrd", "a.npy", "a.nii", "a.raw"] {
        let longer = [
            fs::read(folder.path().join(name)).unwrap(),
            vec![0; nx * ny],
        ]
        .concat();
        fs::write(folder.path().join(name), longer).unwrap();
    }
    for stack in ["a.nrrd", "a.npy", "a.nii", "a.mhd"] {
        let wrong = run(folder.path(), &[stack, "--voxel", "2 um", "-o", "o.mpts"]);
        let said = String::from_utf8_lossy(&wrong.stderr);
        assert_eq!(wrong.status.code(), Some(3), "{stack}: {said}");
        assert!(said.contains("620 bytes stand behind"), "{stack}: {said}");
    }
    fs::remove_file(folder.path().join("slices/s3.bmp")).unwrap();
    let said = done(
        folder.path(),
        &[&["slices"], &size[..], &["-o", "o.mpts"]].concat(),
    );
    assert!(
        said.contains("s2.bmp' and 'slices/s4.bmp' it is 2"),
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
