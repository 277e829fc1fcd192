//! Every exported format says what the particle file says.

use std::fs;
use std::io::Read;

use particle_file::{BitGrid, Block, Draft, Header, Kind, Material};

use crate::workbench::Bench;
use crate::{DIMS, VOXEL, bench, is_wood};

fn export(bench: &Bench, input: &str, output: &str) -> Vec<u8> {
    bench.run(&format!("export {input} -o {output}")).done();
    bench.read(output)
}

/// Labels of the state of step 0 by the definition: adherends of 4 layers, a gap of 2 with
/// three points in it.
fn expected_label(x: usize, y: usize, z: usize) -> u8 {
    let points = [[1, 4, 0], [2, 4, 0], [69, 5, 2]];
    match y {
        0..4 if is_wood(x, y, z) => 128,
        6.. if is_wood(x, y - 6, z) => 128,
        _ if points.contains(&[x, y, z]) => 255,
        _ => 0,
    }
}

fn expected_labels() -> Vec<u8> {
    let [nx, _, nz] = DIMS;
    (0..nx * 10 * nz)
        .map(|i| expected_label(i % nx, i / nx % 10, i / nx / 10))
        .collect()
}

fn csv(bench: &Bench, input: &str) -> (String, Vec<Vec<f64>>) {
    let csv = String::from_utf8(export(bench, input, "a.csv")).unwrap();
    let mut lines = csv.lines();
    let header = lines.next().unwrap().to_owned();
    let rows = lines.map(|line| line.split(',').map(|v| v.parse().unwrap()).collect());
    (header, rows.collect())
}

#[test]
fn csv_has_a_line_per_point_with_units_in_the_names() {
    let bench = bench(&[0]);
    let (header, rows) = csv(&bench, "0000.mpts");
    assert_eq!(header, "x_m,y_m,z_m,volume_m3,pressure_Pa");
    assert_eq!(rows.len(), 3);
    assert!((rows[1][1] - 4.75 * VOXEL).abs() < 1e-12, "{}", rows[1][1]);
    assert_eq!((rows[1][3] as f32, rows[2][4]), (3.4e-18, 2.5e6));
    assert!(bench.path("a.csv.provenance.json").exists());
}

#[test]
fn adhesive_voxels_are_points_where_there_is_no_liquid() {
    let bench = bench(&[]);
    let bits = BitGrid::from_fn(DIMS, |x, y, z| x == 65 && y == z);
    let write = |name, material| {
        let header = Header::new(Kind::Specimen, VOXEL, 1, [0.0; 3], [1e-4; 3]);
        let block = Block::new("block", material, [1e-6; 3], VOXEL, &bits);
        bench.write_particles(name, &Draft::new(header).block(block, &bits));
    };
    write("glue.mpts", Material::Adhesive);
    let (header, rows) = csv(&bench, "glue.mpts");
    assert_eq!((rows.len(), &*header), (3, "x_m,y_m,z_m,volume_m3"));
    for (value, voxels) in rows[2].iter().zip([65.5, 2.5, 2.5]) {
        assert!((value - 1e-6 - voxels * VOXEL).abs() < 1e-11, "{value}");
    }
    assert!((rows[2][3] / VOXEL.powi(3) - 1.0).abs() < 1e-6);
    write("wood.mpts", Material::Rigid);
    let refused = bench.run("export wood.mpts -o w.csv");
    refused.refused(3, "has no adhesive");
}

fn stack(bench: &Bench) -> voxels::Stack {
    voxels::Stack::open(&[bench.path("a.tif")]).unwrap()
}

#[test]
fn tiff_is_the_label_stack_with_its_voxel_size() {
    let bench = bench(&[0]);
    export(&bench, "0000.mpts", "a.tif");
    let stack = stack(&bench);
    assert_eq!(stack.dims(), [DIMS[0], 10, DIMS[2]]);
    let edge = stack.voxel_size().unwrap().cube_edge().unwrap();
    assert!((edge / VOXEL - 1.0).abs() < 1e-9, "{edge}");
    let (mut all, mut page) = (Vec::new(), Vec::new());
    for z in 0..DIMS[2] {
        stack.read_page(z, &mut page).unwrap();
        all.extend_from_slice(&page);
    }
    assert!(all == expected_labels());
}

#[test]
fn a_block_between_voxels_goes_to_the_nearest() {
    let bench = bench(&[1, 2, 3, 5]);
    for (step, height) in [(1, 10), (2, 10), (3, 9), (5, 9)] {
        export(&bench, &format!("{step:04}.mpts"), "a.tif");
        let down = format!("top adherend down by {step} quarter voxels");
        assert_eq!(stack(&bench).dims()[1], height, "{down}");
    }
}

/// The appended array that is declared with `name`.
fn appended<'a>(file: &'a [u8], name: &str) -> &'a [u8] {
    let mark = b"<AppendedData encoding=\"raw\">\n_";
    let at = file.windows(mark.len()).position(|w| w == mark).unwrap();
    let xml = std::str::from_utf8(&file[..at]).unwrap();
    let named = format!("Name=\"{name}\"");
    let line = xml.lines().find(|line| line.contains(&named)).unwrap();
    let (_, offset) = line.split_once("offset=\"").unwrap();
    let (offset, _) = offset.split_once('"').unwrap();
    let data = &file[at + mark.len() + offset.parse::<usize>().unwrap()..];
    let len = u64::from_le_bytes(data[..8].try_into().unwrap()) as usize;
    &data[8..8 + len]
}

fn f32s(bytes: &[u8]) -> Vec<f32> {
    let word = |b: &[u8]| f32::from_le_bytes(b.try_into().unwrap());
    bytes.chunks(4).map(word).collect()
}

#[test]
fn vtp_holds_points_vertices_and_columns() {
    let bench = bench(&[3]);
    let vtp = export(&bench, "0003.mpts", "a.vtp");
    let text = String::from_utf8_lossy(&vtp);
    assert!(text.contains("NumberOfPoints=\"3\" NumberOfVerts=\"3\""));
    assert!(text.contains("Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">3e-6<"));
    let position = f32s(appended(&vtp, "position"));
    assert_eq!(position[3], (2.25 * VOXEL) as f32);
    assert_eq!(f32s(appended(&vtp, "pressure")), [0.0, -1.5, 2.5e6]);
    let u64s = |first: u64| -> Vec<u8> { (first..first + 3).flat_map(u64::to_le_bytes).collect() };
    assert_eq!(appended(&vtp, "connectivity"), u64s(0));
    assert_eq!(appended(&vtp, "offsets"), u64s(1));
    assert!(vtp.ends_with(b"\n</AppendedData>\n</VTKFile>\n"));
}

#[test]
fn vti_holds_the_labels_as_cells() {
    let bench = bench(&[0]);
    let vti = export(&bench, "0000.mpts", "a.vti");
    let text = String::from_utf8_lossy(&vti);
    assert!(text.contains("WholeExtent=\"0 70 0 10 0 3\" Origin=\"0e0 0e0 0e0\""));
    assert!(text.contains("Spacing=\"1.5e-6 1.5e-6 1.5e-6\""));
    assert!(appended(&vti, "label") == expected_labels());
}

#[test]
fn npz_holds_every_array_for_numpy() {
    let bench = bench(&[0]);
    export(&bench, "0000.mpts", "a.npz");
    let file = fs::File::open(bench.path("a.npz")).unwrap();
    let mut archive = zip::ZipArchive::new(file).unwrap();
    let mut array = |name: &str| {
        let mut bytes = Vec::new();
        let mut entry = archive.by_name(&format!("{name}.npy")).unwrap();
        entry.read_to_end(&mut bytes).unwrap();
        assert_eq!(&bytes[..8], b"\x93NUMPY\x01\0");
        let end = 10 + usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
        assert_eq!((end % 64, bytes[end - 1]), (0, b'\n'));
        let header = String::from_utf8(bytes[10..end].to_vec()).unwrap();
        (header, bytes.split_off(end))
    };
    let (header, position) = array("position");
    assert!(header.starts_with("{'descr': '<f4', 'fortran_order': False, 'shape': (3, 3), }"));
    assert_eq!(f32s(&position)[4], (4.75 * VOXEL) as f32);
    let (header, wood) = array("wood-top");
    assert!(header.contains("'|b1'") && header.contains("(3, 4, 70)"));
    let [nx, ny, _] = DIMS;
    let voxel = |(i, &v): (usize, &u8)| (v == 1) == is_wood(i % nx, i / nx % ny, i / nx / ny);
    assert!(wood.len() == 840 && wood.iter().enumerate().all(voxel));
    let (header, origin) = array("wood-top_origin_m");
    assert!(header.contains("(3,)"), "{header}");
    assert_eq!(origin[8..16], (6.0 * VOXEL).to_le_bytes());
}

#[test]
fn pvd_is_a_series_that_writes_a_block_at_rest_once() {
    let bench = bench(&[0, 4, 8]);
    bench
        .run("export 0000.mpts 0004.mpts 0008.mpts -o press.pvd")
        .done();
    let pvd = bench.text("press.pvd");
    let expected = [
        ("0e0", 0, "0000.vtp"),
        ("0e0", 1, "0000-wood-bottom.vti"),
        ("0e0", 2, "0000-wood-top.vti"),
        ("4e-6", 0, "0001.vtp"),
        ("4e-6", 1, "0000-wood-bottom.vti"),
        ("4e-6", 2, "0001-wood-top.vti"),
        ("8e-6", 0, "0002.vtp"),
        ("8e-6", 1, "0000-wood-bottom.vti"),
        ("8e-6", 2, "0002-wood-top.vti"),
    ]
    .map(|(time, part, name)| {
        assert!(bench.path("press.parts").join(name).exists(), "{name}");
        format!("<DataSet timestep=\"{time}\" part=\"{part}\" file=\"press.parts/{name}\"/>")
    });
    let found: Vec<&str> = pvd.lines().filter(|l| l.starts_with("<DataSet")).collect();
    assert_eq!(found, expected);
    assert_eq!(fs::read_dir(bench.path("press.parts")).unwrap().count(), 7);
    let top = bench.read("press.parts/0002-wood-top.vti");
    assert!(String::from_utf8_lossy(&top).contains("Origin=\"0e0 6e-6 0e0\""));
}

#[test]
fn exports_go_to_standard_output_too() {
    let bench = bench(&[0]);
    for format in ["csv", "npz", "vtp", "vti", "tiff"] {
        let file = export(&bench, "0000.mpts", &format!("a.{format}"));
        let piped = bench.run(&format!("export 0000.mpts -o - -f {format}"));
        assert!(piped.done().stdout == file, "{format}");
    }
}
