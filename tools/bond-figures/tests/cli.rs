//! The command line of bond-figures: exit statuses, formats, what goes where.

use std::io::Write;
use std::path::Path;
use std::process::{Command, Output, Stdio};

fn figures(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_bond-figures"))
        .args(arguments)
        .current_dir(folder)
        .output()
        .unwrap()
}

fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

const HISTORY: &str = "step,time_s,closing_speed_m_s,pressure_bottom_Pa,pressure_top_Pa
0,0,1,0,0
1,1e-5,1,1e6,1.1e6
2,2e-5,0.5,2.5e6,2.5e6
";

fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    std::fs::create_dir(folder.path().join("run")).unwrap();
    write("run/history.csv", HISTORY);
    write("empty.csv", "");
    write("header.csv", HISTORY.lines().next().unwrap());
    write("other.csv", "time_s,speed\n0,1\n");
    write("words.csv", &HISTORY.replace("1.1e6", "much"));
    let row = |side: &str| format!("a.mpts,{side},mid,9.5,6.7\n");
    let rows = ["bottom", "top", "total"].map(row).concat();
    write(
        "wp.csv",
        &format!("file,side,reference,wp_um,slab_wp_um\n{rows}"),
    );
    folder
}

#[test]
fn a_run_folder_becomes_svg_and_png_with_their_records() {
    let folder = folder();
    let run = "XPIC(5)=run";
    let arguments = [
        "pressure", "--run", run, "--limit", "2.5 MPa", "-o", "a.svg", "-o", "a.png",
    ];
    let output = figures(folder.path(), &arguments);
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    let svg = std::fs::read_to_string(folder.path().join("a.svg")).unwrap();
    let document = roxmltree::Document::parse(&svg).unwrap();
    let mut texts = document.descendants().filter_map(|n| n.text());
    assert!(texts.any(|t| t.trim() == "XPIC(5)"));
    let png = std::fs::File::open(folder.path().join("a.png")).unwrap();
    let reader = png::Decoder::new(std::io::BufReader::new(png))
        .read_info()
        .unwrap();
    assert_eq!(reader.info().width, 1600);
    let record = folder.path().join("a.png.provenance.json");
    let record = std::fs::read_to_string(record).unwrap();
    assert!(record.contains("history.csv"), "{record}");
}

/// 84 mm are 992 pixels of 300 to the inch and 238.11 points.
#[test]
fn a_picture_is_as_wide_in_print_as_asked_for() {
    let folder = folder();
    let arguments = [
        "pressure", "--run", "run", "--width", "84 mm", "--dpi", "300", "-o", "a.svg", "-o",
        "a.png", "-o", "a.pdf",
    ];
    let output = figures(folder.path(), &arguments);
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    let read = |name: &str| std::fs::read(folder.path().join(name)).unwrap();
    let svg = String::from_utf8(read("a.svg")).unwrap();
    assert!(svg.starts_with("<svg width=\"84.00mm\""), "{}", &svg[..80]);
    let png = read("a.png");
    let reader = png::Decoder::new(std::io::Cursor::new(png))
        .read_info()
        .unwrap();
    let dots = reader.info().pixel_dims.unwrap();
    assert_eq!((reader.info().width, dots.xppu), (992, 11811));
    let pdf = read("a.pdf");
    assert!(pdf.starts_with(b"%PDF-"));
    let text = String::from_utf8_lossy(&pdf);
    let box_of_page = text
        .split("/MediaBox [")
        .nth(1)
        .and_then(|t| t.split(']').next())
        .unwrap();
    let corners: Vec<f64> = box_of_page.split(' ').map(|n| n.parse().unwrap()).collect();
    assert!((corners[2] - 238.11).abs() < 0.02, "{corners:?}");
    assert!(text.contains("/BNDLNE+DejaVuSans") && text.contains("/ToUnicode"));
}

#[test]
fn standard_output_gets_the_svg_alone() {
    let folder = folder();
    let output = figures(folder.path(), &["pressure", "--run", "run", "-o", "-"]);
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    let svg = String::from_utf8(output.stdout).unwrap();
    roxmltree::Document::parse(&svg).unwrap();
}

#[test]
fn standard_input_is_read_where_a_file_is_a_dash() {
    let folder = folder();
    let mut child = Command::new(env!("CARGO_BIN_EXE_bond-figures"))
        .args([
            "pressure", "--run", "piped=-", "--run", "file=run", "-o", "p.svg",
        ])
        .current_dir(folder.path())
        .stdin(Stdio::piped())
        .spawn()
        .unwrap();
    let mut pipe = child.stdin.take().unwrap();
    pipe.write_all(HISTORY.as_bytes()).unwrap();
    drop(pipe);
    assert_eq!(child.wait().unwrap().code(), Some(0));
    let record = folder.path().join("p.svg.provenance.json");
    let record = std::fs::read_to_string(record).unwrap();
    assert!(record.contains("\"path\": \"-\""), "{record}");
    let twice = figures(
        folder.path(),
        &["map", "--map", "-", "--map", "-", "-o", "m.svg"],
    );
    assert_eq!(twice.status.code(), Some(2), "{}", said(&twice));
}

#[test]
fn table_2_prints_for_reading_and_writes_csv() {
    let folder = folder();
    let cases = [
        "table2",
        "--experiment",
        "pf=wp.csv",
        "--run",
        "pf:flip=wp.csv",
        "--paper",
        "-o",
    ];
    let output = figures(folder.path(), &[&cases[..], &["t.csv"]].concat());
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(
        text.contains("another specimen") && text.contains("27.74"),
        "{text}"
    );
    let csv = std::fs::read_to_string(folder.path().join("t.csv")).unwrap();
    assert!(
        csv.starts_with("adhesive,case,reference,bottom_wp_um"),
        "{csv}"
    );
    assert_eq!(csv.lines().count(), 3);
    assert!(!text.contains("With errors"), "{text}");
    let asked = figures(
        folder.path(),
        &[&cases[..], &["u.csv", "--errors", "e.csv"]].concat(),
    );
    assert_eq!(asked.status.code(), Some(2), "{}", said(&asked));
    assert!(
        said(&asked).contains("wp-metrics --finer"),
        "{}",
        said(&asked)
    );
    assert!(!folder.path().join("u.csv").exists());
    let piped = figures(folder.path(), &[&cases[..], &["-"]].concat());
    assert_eq!(piped.stdout, csv.as_bytes());
    assert!(said(&piped).contains("another specimen"));
}

#[test]
fn unfit_data_are_exit_3_with_file_and_column_and_leave_no_picture() {
    let folder = folder();
    for (file, sentence) in [
        ("missing.csv", "cannot read 'missing.csv'"),
        ("empty.csv", "at least one row"),
        ("header.csv", "at least one row"),
        (
            "other.csv",
            "no column pressure_top_Pa: it has time_s, speed",
        ),
        (
            "words.csv",
            "row 2 below the header, column pressure_top_Pa: 'much'",
        ),
    ] {
        let output = figures(folder.path(), &["pressure", "--run", file, "-o", "bad.svg"]);
        assert_eq!(output.status.code(), Some(3), "{file}: {}", said(&output));
        assert!(said(&output).contains(sentence), "{}", said(&output));
        assert!(!folder.path().join("bad.svg").exists());
    }
    for arguments in [
        ["map", "--map", "wp.csv", "-o", "bad.svg"],
        ["shear", "wp.csv", "-q", "-o", "bad.svg"],
        ["slice", "wp.csv", "-q", "-o", "bad.svg"],
        ["view", "wp.csv", "-q", "-o", "bad.svg"],
        ["setup", "wp.csv", "wp.csv", "-o", "bad.svg"],
    ] {
        let output = figures(folder.path(), &arguments);
        assert_eq!(
            output.status.code(),
            Some(3),
            "{arguments:?}: {}",
            said(&output)
        );
    }
}

/// A table of `rows` below their header.
fn table(folder: &Path, name: &str, header: &str, rows: &[&str]) {
    let text = [&[header], rows].concat().join("\n") + "\n";
    std::fs::write(folder.join(name), text).unwrap();
}

#[test]
fn penetration_is_drawn_from_histories_and_profiles_too() {
    let folder = folder();
    let history = "time_s,wp_bottom_um,wp_top_um,wp_total_um,p95_depth_bottom_um,p95_depth_top_um,\
p95_depth_total_um,wetted_area_bottom_um2,wetted_area_top_um2,bond_line";
    let rows = [
        "1e-5,1,2,1.5,3,4,3.5,100,200,filled",
        "2e-5,2,3,2.5,5,6,5.5,300,400,starved",
    ];
    std::fs::create_dir(folder.path().join("press")).unwrap();
    table(folder.path(), "press/history.csv", history, &rows);
    let profile = "time_s,depth_um,adhesive_fraction,filled_void_fraction,filled_open_fraction";
    let layers = ["1e-5,-1,0.5,0.5,0.7", "1e-5,1,0.5,0.5,1", "1e-5,3,0,0,NaN"];
    table(folder.path(), "depth.csv", profile, &layers);
    for (arguments, words) in [
        (&["press"][..], &["WP, bottom", "starved", "time (µs)"][..]),
        (&["a=press", "b=press"], &["a: WP, total", "b: starved"]),
        (
            &["--show", "wetted", "press"],
            &["wood wetted (µm²)", "top"],
        ),
        (
            &["--show", "filled", "depth.csv"],
            &["10.000 µs", "filled share"],
        ),
    ] {
        let arguments = [&["penetration"], arguments, &["-o", "figure.svg"]].concat();
        let output = figures(folder.path(), &arguments);
        assert!(output.status.success(), "{}", said(&output));
        let picture = std::fs::read_to_string(folder.path().join("figure.svg")).unwrap();
        for word in words {
            assert!(picture.contains(word), "{word}");
        }
    }
    table(
        folder.path(),
        "press/history.csv",
        "time_s,bond_line",
        &["1,filled"],
    );
    let output = figures(folder.path(), &["penetration", "press", "-o", "figure.svg"]);
    assert_eq!(output.status.code(), Some(3), "{}", said(&output));
    assert!(
        said(&output).contains("[output] penetration = true"),
        "{}",
        said(&output)
    );
}

/// A line for each specimen of a table of several, by its name; of a table of one, by the label.
#[test]
fn pores_are_drawn_of_each_specimen() {
    let folder = folder();
    let header = "file,diameter_um,volume_fraction,up_to_fraction";
    let two = [
        "a/beech.mpts,10,0.4,0.4",
        "a/beech.mpts,60,0.6,1",
        "birch.mpts,80,1,1",
    ];
    table(folder.path(), "two.csv", header, &two);
    table(folder.path(), "one.csv", header, &two[..2]);
    let output = figures(
        folder.path(),
        &["pores", "two.csv", "own=one.csv", "-o", "-"],
    );
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    let svg = String::from_utf8_lossy(&output.stdout).into_owned();
    let document = roxmltree::Document::parse(&svg).unwrap();
    let texts: Vec<&str> = document.descendants().filter_map(|n| n.text()).collect();
    for label in ["beech", "birch", "own"] {
        assert!(texts.iter().any(|text| text.trim() == label), "{label}");
    }
    let other = figures(folder.path(), &["pores", "wp.csv", "-o", "a.svg"]);
    assert_eq!(other.status.code(), Some(3), "{}", said(&other));
    assert!(said(&other).contains("diameter_um"), "{}", said(&other));
}

#[test]
fn penetration_is_drawn_over_times_of_any_length() {
    let folder = folder();
    let row = |side: &str, time: f64, wp: f64, state: &str| {
        format!("a.mpts,{side},mid,{wp},{time},{},{state}\n", 2.0 * wp)
    };
    let mut table = "file,side,reference,wp_um,time_s,p95_depth_um,bond_line\n".to_owned();
    for (time, wp, state) in [
        (1e-6, 2.0, "filled"),
        (1e-3, 5.0, "filled"),
        (300.0, 9.0, "starved"),
    ] {
        for side in ["bottom", "top", "total"] {
            table += &row(side, time, wp, state);
        }
    }
    std::fs::write(folder.path().join("series.csv"), &table).unwrap();
    let output = figures(
        folder.path(),
        &["penetration", "series.csv", "-o", "depth.svg"],
    );
    assert!(output.status.success(), "{}", said(&output));
    let picture = std::fs::read_to_string(folder.path().join("depth.svg")).unwrap();
    for word in ["WP, bottom", "95 %, top", "starved", "time (s)", "10⁻⁶"] {
        assert!(picture.contains(word), "{word}");
    }
    let one_sided = table.replace("top,mid", "total,mid");
    std::fs::write(folder.path().join("series.csv"), one_sided).unwrap();
    let output = figures(
        folder.path(),
        &["penetration", "series.csv", "-o", "depth.svg"],
    );
    assert_eq!(output.status.code(), Some(3), "{}", said(&output));
    assert!(
        said(&output).contains("no row of the side top"),
        "{}",
        said(&output)
    );
}
