//! The figures as files: SVG parses and says what it should, PNG decodes and is not blank, and
//! what is drawn follows the data.

use std::fmt::Write as _;
use std::path::PathBuf;

use figures::{
    Case, Closing, Clouds, Cut, Drawing, Error, Labelled, Mark, Plot, Position, ShearRates, Slices,
    Table2, WpMap,
};
use particle_file::{BitGrid, Block, Draft, Header, Kind, Material};
use units::Axis;

struct Folder(tempfile::TempDir);

impl Folder {
    fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    fn file(&self, name: &str, content: impl AsRef<[u8]>) -> PathBuf {
        let path = self.0.path().join(name);
        std::fs::write(&path, content).unwrap();
        path
    }

    fn labelled(&self, label: &str, content: impl AsRef<[u8]>) -> Labelled {
        let name: String = label.chars().filter(char::is_ascii_alphanumeric).collect();
        Labelled {
            label: label.into(),
            path: self.file(&name, content),
        }
    }
}

/// All text of an SVG document, which must parse.
fn texts(drawing: &Drawing) -> Vec<String> {
    let svg = drawing.to_svg().unwrap();
    let document = roxmltree::Document::parse(&svg).unwrap();
    let texts = document.descendants().filter(|n| n.has_tag_name("text"));
    texts
        .map(|n| n.text().unwrap_or_default().trim().into())
        .collect()
}

/// Size and pixels of the PNG.
fn pixels(drawing: &Drawing) -> ([u32; 2], Vec<[u8; 3]>) {
    let bytes = drawing.to_png().unwrap();
    let mut reader = png::Decoder::new(std::io::Cursor::new(bytes))
        .read_info()
        .unwrap();
    let mut buffer = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut buffer).unwrap();
    let pixels = buffer.chunks(3).map(|p| [p[0], p[1], p[2]]).collect();
    ([info.width, info.height], pixels)
}

fn share(pixels: &[[u8; 3]], colour: [u8; 3]) -> f64 {
    pixels.iter().filter(|p| **p == colour).count() as f64 / pixels.len() as f64
}

const BLUE: [u8; 3] = [0, 114, 178];
const VERMILION: [u8; 3] = [213, 94, 0];

/// A history whose pressure rises to `peak` Pa at 40 us.
fn history(peak: f64) -> String {
    let mut text =
        String::from("step,time_s,closing_speed_m_s,pressure_bottom_Pa,pressure_top_Pa,extra\n");
    for i in 0..=400 {
        let (time, pressure) = (f64::from(i) * 1e-7, peak * f64::from(i) / 400.0);
        let _ = writeln!(text, "{i},{time},1.0,{pressure},{pressure},");
    }
    text
}

#[test]
fn pressure_and_speed_have_units_labels_and_both_lines() {
    let folder = Folder::new();
    let runs = [
        folder.labelled("XPIC(5)", history(2.4e6)),
        folder.labelled("frictionless", history(1.2e6)),
    ];
    let drawing = Closing::read(&runs, Some(2.5e6), "PF").unwrap().draw();
    let said = texts(&drawing);
    for text in [
        "pressure (MPa)",
        "closing speed (m/s)",
        "time (µs)",
        "XPIC(5)",
        "frictionless",
        "PF",
        "40",
        "2",
    ] {
        assert!(said.iter().any(|t| t == text), "{text} is not in {said:?}");
    }
    let ([width, height], pixels) = pixels(&drawing);
    assert_eq!(width, 1600);
    assert!(height > 1000);
    let (blue, red) = (share(&pixels, BLUE), share(&pixels, VERMILION));
    println!("{width} x {height}, blue {blue:.5}, vermilion {red:.5}");
    assert!(blue > 5e-4 && red > 5e-4);
}

/// The line of a run at twice the pressure must reach twice as high: measured on the pixels.
#[test]
fn lines_stand_at_the_height_of_their_data() {
    let folder = Folder::new();
    let highest = |peak: f64| {
        let runs = [
            folder.labelled("a", history(peak)),
            folder.labelled("b", history(2e6)),
        ];
        let drawing = Closing::read(&runs, None, "").unwrap().draw();
        let ([width, _], pixels) = pixels(&drawing);
        // Below the legend, above the speed panel.
        let rows = 120..680_usize;
        let blue = |row: &usize| {
            let start = row * width as usize;
            pixels[start..start + width as usize].contains(&BLUE)
        };
        let found: Vec<usize> = rows.filter(blue).collect();
        (found[0] as f64, found[found.len() - 1] as f64)
    };
    let (full, base) = highest(2e6);
    let (half, _) = highest(1e6);
    let ratio = (base - half) / (base - full);
    println!("rows: base {base}, half {half}, full {full}; ratio {ratio:.3}");
    assert!((ratio - 0.5).abs() < 0.02);
}

#[test]
fn gaps_and_single_rows_are_drawn_and_nothing_else() {
    let folder = Folder::new();
    let header = "time_s,closing_speed_m_s,pressure_bottom_Pa,pressure_top_Pa\n";
    let one = folder.labelled("one", format!("{header}1e-6,1,1e6,1e6\n"));
    let (_, dot) = pixels(&Closing::read(&[one], None, "").unwrap().draw());
    let blue = share(&dot, BLUE);
    println!("one row: {blue:.6} of the picture is its mark and legend");
    assert!(blue > 1e-4 && blue < 3e-3);
    let gap = format!("{header}0,1,1e6,1e6\n1e-6,1,NaN,NaN\n2e-6,1,,\n3e-6,1,1e6,1e6\n");
    let gap = Closing::read(&[folder.labelled("gap", gap)], None, "")
        .unwrap()
        .draw();
    let ([width, _], with_gap) = pixels(&gap);
    // The pressure of 1 MPa is shown at both ends and not bridged in the middle.
    let middle = width as usize / 2 + 30;
    let column = (120..680).map(|row| with_gap[row * width as usize + middle]);
    assert!(column.into_iter().all(|pixel| pixel != BLUE));
    let all_nan = folder.labelled("nan", format!("{header}0,1,NaN,NaN\n"));
    assert!(matches!(
        Closing::read(&[all_nan], None, ""),
        Err(Error::Data(_))
    ));
}

fn map(value: impl Fn(usize, usize) -> String) -> String {
    let mut text = String::from("x_um,z_um,wp_um,volume_um3\n");
    for z in 0..30 {
        for x in 0..20 {
            let _ = writeln!(
                text,
                "{},{},{}",
                1.45 * (x as f64 + 0.5),
                1.45 * (z as f64 + 0.5),
                value(x, z)
            );
        }
    }
    text
}

#[test]
fn maps_share_one_scale_and_show_holes() {
    let folder = Folder::new();
    let shallow = folder.labelled("shallow", map(|_, _| "0,10".into()));
    let deep = folder.labelled(
        "deep",
        map(|x, _| if x < 10 { "30,10" } else { ",0" }.into()),
    );
    let drawing = WpMap::read(&[shallow, deep]).unwrap().draw();
    let said = texts(&drawing);
    for text in [
        "shallow",
        "deep",
        "x (µm)",
        "z (µm)",
        "weighted penetration (µm)",
        "none",
    ] {
        assert!(said.iter().any(|t| t == text), "{text} is not in {said:?}");
    }
    let (_, pixels) = pixels(&drawing);
    let ends = [[68, 1, 84], [253, 231, 37], [208, 208, 208]].map(|c| share(&pixels, c));
    println!(
        "lowest {:.3}, highest {:.3}, none {:.3}",
        ends[0], ends[1], ends[2]
    );
    // The shallow panel is twice the deep half, which equals its empty half.
    assert!((ends[0] / ends[1] - 2.0).abs() < 0.05);
    assert!((ends[1] / ends[2] - 1.0).abs() < 0.05);
}

#[test]
fn maps_off_any_grid_are_refused() {
    let folder = Folder::new();
    let text = "x_um,z_um,wp_um,volume_um3\n0,0,1,1\n1,0,1,1\n2.5,0,1,1\n";
    let said = WpMap::read(&[folder.labelled("a", text)])
        .unwrap_err()
        .to_string();
    assert!(said.contains("grid"), "{said}");
}

#[test]
fn shear_rates_have_bands_median_and_decades() {
    let folder = Folder::new();
    let mut text = String::from("time_s,q05,q10,q25,q50,q75,q90,q95,max,mean,volume_um3\n");
    for i in 0..20 {
        let median = f64::from(i) * 1e3;
        let _ = write!(text, "{}", f64::from(i) * 2e-6);
        for factor in [0.1, 0.2, 0.5, 1.0, 2.0, 4.0, 6.0, 20.0, 1.0] {
            let _ = write!(text, ",{}", median * factor);
        }
        text += ",1000\n";
    }
    let source = folder.labelled("PF", &text);
    let drawing = ShearRates::read(&[source]).unwrap().draw();
    let said = texts(&drawing);
    for label in [
        "shear rate (1/s)",
        "time (µs)",
        "PF",
        "median",
        "max",
        "5 to 95 %",
        "1e5",
    ] {
        assert!(
            said.iter().any(|t| t == label),
            "{label} is not in {said:?}"
        );
    }
    let (_, pixels) = pixels(&drawing);
    let bluish = pixels
        .iter()
        .filter(|p| p[2] > p[0] && p[2] - p[0] > 20)
        .count();
    let band = bluish as f64 / pixels.len() as f64;
    println!("bands cover {band:.3}");
    assert!(band > 0.08 && band < 0.4);
    let still = "time_s,q05,q10,q25,q50,q75,q90,q95,max,mean,volume_um3\n0,0,0,0,0,0,0,0,0,0,1\n";
    let said = ShearRates::read(&[folder.labelled("still", still)]).unwrap_err();
    assert!(said.to_string().contains("nothing flows"));
}

/// A bond of 40 x 60 x 20 voxels: wood in the lowest and highest thirds, adhesive in a slab
/// of 6 voxels at y = 27.
fn bond() -> Vec<u8> {
    let voxel = 1e-6;
    let edges = [40e-6, 60e-6, 20e-6];
    let header = Header::new(Kind::Bond, voxel, 1, [0.0; 3], edges);
    let wood = BitGrid::from_fn([40, 60, 20], |_, y, _| !(20..40).contains(&y));
    let slab = BitGrid::from_fn([40, 6, 20], |_, _, _| true);
    let origin = [0.0, 27e-6, 0.0];
    let blocks = [
        (
            Block::new("wood-bottom", Material::Rigid, [0.0; 3], voxel, &wood),
            &wood,
        ),
        (
            Block::new("adhesive", Material::Adhesive, origin, voxel, &slab),
            &slab,
        ),
    ];
    let mut bytes = Vec::new();
    let draft = blocks
        .into_iter()
        .fold(Draft::new(header), |d, (block, bits)| d.block(block, bits));
    draft.write_to(&mut bytes).unwrap();
    bytes
}

#[test]
fn slices_show_each_phase_by_its_area() {
    let folder = Folder::new();
    let state = folder.labelled("bond", bond());
    let cut = |axis, position| Cut { axis, position };
    let read = |cut| Slices::read(std::slice::from_ref(&state), cut, figures::Colouring::Plain);
    let areas = |cut| {
        let (_, pixels) = pixels(&read(cut).unwrap().draw());
        [[150, 150, 150], [230, 159, 0]].map(|c| pixels.iter().filter(|p| **p == c).count() as f64)
    };
    let [wood, adhesive] = areas(cut(Axis::Z, Position::Share(0.5)));
    println!(
        "wood over adhesive: {:.3} (40 rows over 6)",
        wood / adhesive
    );
    assert!((wood / adhesive - 40.0 / 6.0).abs() < 0.1);
    let [wood, adhesive] = areas(cut(Axis::Y, Position::At(30e-6)));
    // Some of the smoothed text is grey too.
    println!("slice in the slab: wood {wood}, adhesive {adhesive} pixels");
    assert!(wood < 1e-3 * adhesive && adhesive > 1e4);
    let said = texts(&read(cut(Axis::X, Position::At(10e-6))).unwrap().draw());
    assert!(
        said.contains(&"x = 10.0 µm".into()) && said.contains(&"5 µm".into()),
        "{said:?}"
    );
    let beside = read(cut(Axis::Z, Position::At(1e-3))).unwrap_err();
    assert!(matches!(beside, Error::Request(_)), "{beside}");
    let nothing = folder.labelled("foreign", "not a particle file");
    let middle = cut(Axis::Z, Position::Share(0.5));
    let foreign = Slices::read(&[nothing], middle, figures::Colouring::Plain).unwrap_err();
    assert!(matches!(foreign, Error::Data(_)), "{foreign}");
}

fn wp(bottom: f64, top: f64, total: f64) -> String {
    let mut text = String::from(
        "file,side,reference,plane_m,wp_um,slab_wp_um,ep_um,max_depth_um,p99_depth_um,volume_um3,voxels\n",
    );
    for (side, wp) in [("bottom", bottom), ("top", top), ("total", total)] {
        let _ = writeln!(
            text,
            "a.mpts,{side},mid,7e-5,{wp},6.697,23.2,18,16,1000,300"
        );
    }
    text
}

#[test]
fn table_2_has_ours_the_slab_and_the_papers_numbers_labelled() {
    let folder = Folder::new();
    let case = |adhesive: &str, name: &str, wp: String| Case {
        adhesive: adhesive.into(),
        name: name.into(),
        path: folder.file(&format!("{adhesive}{name}"), wp),
    };
    let cases = [
        case("pf", "experiment", wp(8.5, 8.6, 8.55)),
        case("pva-pf", "xpic", wp(1.0, 2.0, 1.5)),
        case("pf", "implicit", wp(3.0, 4.0, 3.5)),
    ];
    let table = Table2::read(&cases).unwrap();
    let mut csv = Vec::new();
    table.write_csv(&mut csv).unwrap();
    let csv = String::from_utf8(csv).unwrap();
    println!("{csv}");
    let rows: Vec<Vec<&str>> = csv.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!(
        rows[1][..7],
        [
            "pf",
            "experiment",
            "mid",
            "8.5000",
            "8.6000",
            "8.5500",
            "6.6970"
        ]
    );
    assert_eq!(
        rows[1][7..11],
        ["Experimental", "68.5700", "31.6200", "56.4100"]
    );
    assert_eq!(rows[2][..2], ["pf", "implicit"]);
    assert_eq!(rows[2][7..11], ["", "", "", ""]);
    assert_eq!(rows[3][7..11], ["XPIC(5)", "25.2100", "23.3200", "24.3500"]);
    assert!(csv.contains("the paper's specimen, not this one"));
    let text = table.to_text();
    assert!(
        text.contains("another specimen") && text.contains("56.41"),
        "{text}"
    );
    let two = wp(1.0, 1.0, 1.0).replacen("a.mpts", "b.mpts", 1);
    let said = Table2::read(&[case("pf", "flip", two)])
        .unwrap_err()
        .to_string();
    assert!(said.contains("several states"), "{said}");
}

#[test]
fn a_plot_has_titles_labels_and_marks() {
    let plot = Plot::new("errors", "CPU (s)", "error (%)")
        .logarithmic([true, true])
        .with("ours", Mark::LineAndDots, vec![[1.0, 10.0], [10.0, 1.0]])
        .with("theirs", Mark::Dots, vec![[3.0, 30.0], [f64::NAN, 1.0]]);
    let drawing = plot.draw().unwrap();
    let texts = texts(&drawing);
    for text in ["errors", "CPU (s)", "error (%)", "ours", "theirs", "10"] {
        assert!(texts.iter().any(|t| t == text), "{text}: {texts:?}");
    }
    let (_, pixels) = pixels(&drawing);
    // The second series has dots and no line: its colour covers little, but something.
    let colours = [[0, 114, 178], [213, 94, 0]].map(|c| share(&pixels, c));
    assert!(colours[0] > colours[1] && colours[1] > 1e-5, "{colours:?}");
    let empty = Plot::new("none", "", "").with("a", Mark::Line, vec![[f64::NAN, 0.0]]);
    assert!(matches!(empty.draw(), Err(Error::Data(_))));
}

#[test]
fn clouds_have_labels_and_colours_of_their_values() {
    let points = vec![([0.0, 0.0], 0.0), ([1.0, 2.0], 1.0)];
    let clouds = Clouds::new("v", [0.0, 1.0], 0.1).with("FLIP", points);
    let drawing = clouds.draw().unwrap();
    assert!(texts(&drawing).iter().any(|t| t == "FLIP"));
    let (_, pixels) = pixels(&drawing);
    // Both ends of the scale are there beside the colour bar's one line of each.
    for end in [[68, 1, 84], [253, 231, 37]] {
        assert!(share(&pixels, end) > 1e-4);
    }
    assert!(Clouds::new("v", [0.0, 1.0], 0.1).draw().is_err());
}
