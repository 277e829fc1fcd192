//! The command line of bond-figures: exit statuses, formats, what goes where.

mod movie;
mod origin;
#[path = "../../../workbench.rs"]
mod workbench;

use std::fs::{self, File};
use std::io::BufReader;

use workbench::Bench;

const HISTORY: &str = "step,time_s,closing_speed_m_s,pressure_bottom_Pa,pressure_top_Pa
0,0,1,0,0
1,1e-5,1,1e6,1.1e6
2,2e-5,0.5,2.5e6,2.5e6
";

/// A folder of inputs.
fn bench() -> Bench {
    let bench = Bench::new(env!("CARGO_BIN_EXE_bond-figures"));
    fs::create_dir(bench.path("run")).unwrap();
    bench.write("run/history.csv", HISTORY);
    let row = |side: &str| format!("a.mpts,{side},mid,9.5,6.7");
    let rows = ["bottom", "top", "total"].map(row).join("\n");
    let header = "file,side,reference,wp_um,slab_wp_um";
    bench.write("wp.csv", format!("{header}\n{rows}\n"));
    bench
}

fn texts(svg: &str) -> Vec<String> {
    let document = roxmltree::Document::parse(svg).unwrap();
    let texts = document.descendants().filter_map(|n| n.text());
    texts.map(|text| text.trim().to_owned()).collect()
}

/// 84 mm are 992 pixels of 300 to the inch and 238.11 points.
#[test]
fn a_run_folder_becomes_pictures_as_wide_in_print_as_asked_for_with_their_records() {
    let bench = bench();
    bench
        .run("pressure --run XPIC(5)=run --limit 2.5MPa -o a.svg -o a.png")
        .done();
    assert!(texts(&bench.text("a.svg")).contains(&"XPIC(5)".to_owned()));
    let png = |name: &str| {
        let file = File::open(bench.path(name)).unwrap();
        let reader = png::Decoder::new(BufReader::new(file)).read_info();
        let info = reader.unwrap().info().clone();
        (info.width, info.pixel_dims.unwrap().xppu)
    };
    assert_eq!(png("a.png"), (1600, 9449));
    let record = bench.text("a.png.provenance.json");
    assert!(record.contains("history.csv"), "{record}");
    bench
        .run("pressure --run run --width 84mm --dpi 300 -o b.svg -o b.png -o b.pdf")
        .done();
    assert!(bench.text("b.svg").starts_with("<svg width=\"84.00mm\""));
    assert_eq!(png("b.png"), (992, 11811));
    let pdf = bench.read("b.pdf");
    let pdf = String::from_utf8_lossy(&pdf);
    assert!(pdf.starts_with("%PDF-"));
    let (_, page) = pdf.split_once("/MediaBox [").unwrap();
    let corners = page.split(']').next().unwrap().split(' ');
    let corners: Vec<f64> = corners.map(|n| n.parse().unwrap()).collect();
    assert!((corners[2] - 238.11).abs() < 0.02, "{corners:?}");
    assert!(pdf.contains("/BNDLNE+DejaVuSans") && pdf.contains("/ToUnicode"));
}

#[test]
fn a_dash_is_standard_input_or_the_svg_alone() {
    let bench = bench();
    bench.write("piped.csv", HISTORY);
    let line = "cat piped.csv | $TOOL pressure --run piped=- --run file=run -o -";
    let texts = texts(&bench.shell(line).output());
    assert!(texts.contains(&"piped".to_owned()), "{texts:?}");
    (bench.shell("$TOOL pressure --run - -o p.svg <run/history.csv")).output();
    let record = bench.text("p.svg.provenance.json");
    assert!(record.contains("\"path\": \"-\""), "{record}");
    bench
        .run("map --map - --map - -o m.svg")
        .refused(2, "can be read only once");
}

#[test]
fn table_2_prints_for_reading_and_writes_csv() {
    let bench = bench();
    let cases = "table2 --experiment pf=wp.csv --run pf:flip=wp.csv --paper -o";
    let text = bench.run(&format!("{cases} t.csv")).output();
    let told = ["another specimen", "27.74"];
    assert!(told.iter().all(|told| text.contains(told)), "{text}");
    assert!(!text.contains("With errors"), "{text}");
    let csv = bench.text("t.csv");
    assert!(csv.starts_with("adhesive,case,reference,bottom_wp_um"));
    assert_eq!(csv.lines().count(), 3);
    let asked = bench.run(&format!("{cases} u.csv --errors e.csv"));
    asked.refused(2, "wp-metrics --finer");
    assert!(!bench.path("u.csv").exists());
    let written = bench.run(&format!("{cases} -")).done();
    assert!(written.said.contains("another specimen"));
    assert_eq!(written.output(), csv);
}

/// From series, histories and profiles, over times of any length.
#[test]
fn penetration_is_drawn_from_all_that_tells_of_it() {
    let bench = bench();
    let table = |name: &str, rows: &[&str]| bench.write(name, rows.join("\n") + "\n");
    fs::create_dir(bench.path("press")).unwrap();
    let history = "time_s,wp_bottom_um,wp_top_um,wp_total_um,p95_depth_bottom_um,p95_depth_top_um,\
p95_depth_total_um,wetted_area_bottom_um2,wetted_area_top_um2,bond_line";
    let rows = [
        "1e-5,1,2,1.5,3,4,3.5,100,200,filled",
        "2e-5,2,3,2.5,5,6,5.5,300,400,starved",
    ];
    table("press/history.csv", &[&[history][..], &rows].concat());
    let profile = "time_s,depth_um,adhesive_fraction,filled_void_fraction,filled_open_fraction";
    let layers = ["1e-5,-1,0.5,0.5,0.7", "300,1,0.5,0.5,1.01", "300,3,0,0,NaN"];
    table("depth.csv", &[&[profile][..], &layers].concat());
    let mut series = "file,side,reference,wp_um,time_s,p95_depth_um,bond_line\n".to_owned();
    for (time, wp, state) in [
        (1e-6, 2, "filled"),
        (1e-3, 5, "filled"),
        (300.0, 9, "starved"),
    ] {
        for side in ["bottom", "top", "total"] {
            series += &format!("a.mpts,{side},mid,{wp},{time},{},{state}\n", 2 * wp);
        }
    }
    bench.write("series.csv", &series);
    bench.write("one.csv", series.replace("top,mid", "total,mid"));
    table("none.csv", &["time_s,bond_line", "1,filled"]);
    for (arguments, words) in [
        (
            "press",
            &["Penetration, press", "WP, bottom", "starved", "time (µs)"][..],
        ),
        ("a=press b=press", &["a: WP, total", "b: starved"]),
        ("--show wetted press", &["wood wetted (µm²)", "top"]),
        (
            "--show filled depth.csv",
            &[
                "Filled share of the open lumens, depth",
                "10.000 µs",
                "300.000 s",
                "filled share",
                "1.0",
            ],
        ),
        (
            "series.csv",
            &["WP, bottom", "95 %, top", "starved", "time (s)", "10⁻⁶"],
        ),
    ] {
        let said = texts(&bench.run(&format!("penetration {arguments} -o -")).output());
        for word in words {
            assert!(said.contains(&(*word).to_owned()), "{word}: {said:?}");
        }
    }
    for (name, status, said) in [
        ("one.csv", 3, "no row of the side top"),
        ("none.csv", 2, "[output] penetration = true"),
    ] {
        let run = bench.run(&format!("penetration {name} -o a.svg"));
        run.refused(status, said);
    }
}

/// A line for each specimen of a table of several, by its name; of a table of one, by the label.
#[test]
fn pores_are_drawn_of_each_specimen() {
    let bench = bench();
    let beech = "file,diameter_um,volume_fraction,up_to_fraction
a/beech.mpts,10,0.4,0.4
a/beech.mpts,60,0.6,1
";
    bench.write("one.csv", beech);
    bench.write("two.csv", format!("{beech}birch.mpts,80,1,1\n"));
    let said = texts(&bench.run("pores two.csv own=one.csv -o -").output());
    for label in ["beech", "birch", "own"] {
        assert!(said.contains(&label.to_owned()), "{label}");
    }
}
