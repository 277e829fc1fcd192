//! The command line of bond-figures: exit statuses, formats, what goes where.

use std::io::Write;

use std::process::{Command, Stdio};

const HISTORY: &str = "step,time_s,closing_speed_m_s,pressure_bottom_Pa,pressure_top_Pa
0,0,1,0,0
1,1e-5,1,1e6,1.1e6
2,2e-5,0.5,2.5e6,2.5e6
";

/// A folder of inputs.
struct Folder(tempfile::TempDir);

/// What a command left: its status, what it wrote and what it said.
struct Answer(Option<i32>, String, String);

impl Folder {
    fn new() -> Self {
        let folder = Self(tempfile::tempdir().unwrap());
        std::fs::create_dir(folder.path("run")).unwrap();
        folder.write("run/history.csv", HISTORY);
        let row = |side: &str| format!("a.mpts,{side},mid,9.5,6.7");
        let rows = ["bottom", "top", "total"].map(row).join("\n");
        let header = "file,side,reference,wp_um,slab_wp_um";
        folder.write("wp.csv", &format!("{header}\n{rows}\n"));
        folder
    }

    fn path(&self, name: &str) -> std::path::PathBuf {
        self.0.path().join(name)
    }

    fn write(&self, name: &str, text: &str) {
        std::fs::write(self.path(name), text).unwrap();
    }

    fn read(&self, name: &str) -> String {
        String::from_utf8_lossy(&std::fs::read(self.path(name)).unwrap()).into_owned()
    }

    fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_bond-figures"));
        command.args(arguments).current_dir(&self.0);
        command
    }

    fn run(&self, arguments: &[&str]) -> Answer {
        let output = self.command(arguments).output().unwrap();
        let text = |bytes| String::from_utf8_lossy(bytes).into_owned();
        Answer(
            output.status.code(),
            text(&output.stdout),
            text(&output.stderr),
        )
    }

    /// What it wrote, of words without blanks.
    fn done(&self, arguments: &str) -> String {
        let words: Vec<&str> = arguments.split(' ').collect();
        let Answer(status, written, said) = self.run(&words);
        assert_eq!(status, Some(0), "{arguments}: {said}");
        written
    }

    /// It ends with a status and these words.
    fn refused(&self, arguments: &str, status: i32, words: &str) {
        let split: Vec<&str> = arguments.split(' ').collect();
        let Answer(found, _, said) = self.run(&split);
        assert_eq!(found, Some(status), "{arguments}: {said}");
        assert!(said.contains(words), "{said}");
    }
}

fn texts(svg: &str) -> Vec<String> {
    let document = roxmltree::Document::parse(svg).unwrap();
    let texts = document.descendants().filter_map(|n| n.text());
    texts.map(|text| text.trim().to_owned()).collect()
}

/// 84 mm are 992 pixels of 300 to the inch and 238.11 points.
#[test]
fn a_run_folder_becomes_pictures_as_wide_in_print_as_asked_for_with_their_records() {
    let folder = Folder::new();
    folder.done("pressure --run XPIC(5)=run --limit 2.5MPa -o a.svg -o a.png");
    assert!(texts(&folder.read("a.svg")).contains(&"XPIC(5)".to_owned()));
    let png = |name: &str| {
        let file = std::fs::File::open(folder.path(name)).unwrap();
        let reader = png::Decoder::new(std::io::BufReader::new(file)).read_info();
        let info = reader.unwrap().info().clone();
        (info.width, info.pixel_dims.unwrap().xppu)
    };
    assert_eq!(png("a.png"), (1600, 9449));
    let record = folder.read("a.png.provenance.json");
    assert!(record.contains("history.csv"), "{record}");
    folder.done("pressure --run run --width 84mm --dpi 300 -o b.svg -o b.png -o b.pdf");
    assert!(folder.read("b.svg").starts_with("<svg width=\"84.00mm\""));
    assert_eq!(png("b.png"), (992, 11811));
    let pdf = folder.read("b.pdf");
    assert!(pdf.starts_with("%PDF-"));
    let (_, page) = pdf.split_once("/MediaBox [").unwrap();
    let corners = page.split(']').next().unwrap().split(' ');
    let corners: Vec<f64> = corners.map(|n| n.parse().unwrap()).collect();
    assert!((corners[2] - 238.11).abs() < 0.02, "{corners:?}");
    assert!(pdf.contains("/BNDLNE+DejaVuSans") && pdf.contains("/ToUnicode"));
}

#[test]
fn a_dash_is_standard_input_or_the_svg_alone() {
    let folder = Folder::new();
    let arguments = "pressure --run piped=- --run file=run -o -";
    let arguments: Vec<&str> = arguments.split(' ').collect();
    let mut command = folder.command(&arguments);
    command.stdin(Stdio::piped()).stdout(Stdio::piped());
    let mut child = command.spawn().unwrap();
    let mut pipe = child.stdin.take().unwrap();
    pipe.write_all(HISTORY.as_bytes()).unwrap();
    drop(pipe);
    let output = child.wait_with_output().unwrap();
    assert!(output.status.success());
    let texts = texts(&String::from_utf8(output.stdout).unwrap());
    assert!(texts.contains(&"piped".to_owned()), "{texts:?}");
    let mut command = folder.command(&["pressure", "--run", "-", "-o", "p.svg"]);
    let history = std::fs::File::open(folder.path("run/history.csv")).unwrap();
    assert!(command.stdin(history).status().unwrap().success());
    let record = folder.read("p.svg.provenance.json");
    assert!(record.contains("\"path\": \"-\""), "{record}");
    folder.refused("map --map - --map - -o m.svg", 2, "can be read once");
}

#[test]
fn table_2_prints_for_reading_and_writes_csv() {
    let folder = Folder::new();
    let cases = "table2 --experiment pf=wp.csv --run pf:flip=wp.csv --paper -o";
    let text = folder.done(&format!("{cases} t.csv"));
    let told = ["another specimen", "27.74"];
    assert!(told.iter().all(|told| text.contains(told)), "{text}");
    assert!(!text.contains("With errors"), "{text}");
    let csv = folder.read("t.csv");
    assert!(csv.starts_with("adhesive,case,reference,bottom_wp_um"));
    assert_eq!(csv.lines().count(), 3);
    let asked = format!("{cases} u.csv --errors e.csv");
    folder.refused(&asked, 2, "wp-metrics --finer");
    assert!(!folder.path("u.csv").exists());
    let arguments: Vec<&str> = cases.split(' ').chain(["-"]).collect();
    let Answer(_, written, said) = folder.run(&arguments);
    assert_eq!(written, csv);
    assert!(said.contains("another specimen"));
}

#[test]
fn unfit_data_are_exit_3_with_file_and_column_and_leave_no_picture() {
    let folder = Folder::new();
    folder.write("empty.csv", "");
    folder.write("header.csv", HISTORY.lines().next().unwrap());
    folder.write("other.csv", "time_s,speed\n0,1\n");
    folder.write("words.csv", &HISTORY.replace("1.1e6", "much"));
    for (arguments, words) in [
        ("pressure --run missing.csv", "cannot read 'missing.csv'"),
        ("pressure --run empty.csv", "at least one row"),
        ("pressure --run header.csv", "at least one row"),
        (
            "pressure --run other.csv",
            "no column pressure_top_Pa: it has time_s, speed",
        ),
        (
            "pressure --run words.csv",
            "row 2 below the header, column pressure_top_Pa: 'much'",
        ),
        ("map --map wp.csv", "no column x_um"),
        ("shear wp.csv", "no column"),
        ("pores wp.csv", "diameter_um"),
        ("slice wp.csv", "wp.csv"),
        ("view wp.csv", "wp.csv"),
        ("setup wp.csv wp.csv", "wp.csv"),
    ] {
        folder.refused(&format!("{arguments} -o bad.svg"), 3, words);
        assert!(!folder.path("bad.svg").exists());
    }
}

/// From series, histories and profiles, over times of any length.
#[test]
fn penetration_is_drawn_from_all_that_tells_of_it() {
    let folder = Folder::new();
    let table = |name: &str, rows: &[&str]| folder.write(name, &(rows.join("\n") + "\n"));
    std::fs::create_dir(folder.path("press")).unwrap();
    let history = "time_s,wp_bottom_um,wp_top_um,wp_total_um,p95_depth_bottom_um,p95_depth_top_um,\
p95_depth_total_um,wetted_area_bottom_um2,wetted_area_top_um2,bond_line";
    let rows = [
        "1e-5,1,2,1.5,3,4,3.5,100,200,filled",
        "2e-5,2,3,2.5,5,6,5.5,300,400,starved",
    ];
    table("press/history.csv", &[&[history][..], &rows].concat());
    let profile = "time_s,depth_um,adhesive_fraction,filled_void_fraction,filled_open_fraction";
    let layers = ["1e-5,-1,0.5,0.5,0.7", "1e-5,1,0.5,0.5,1", "1e-5,3,0,0,NaN"];
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
    folder.write("series.csv", &series);
    folder.write("one.csv", &series.replace("top,mid", "total,mid"));
    table("none.csv", &["time_s,bond_line", "1,filled"]);
    for (arguments, words) in [
        ("press", &["WP, bottom", "starved", "time (µs)"][..]),
        ("a=press b=press", &["a: WP, total", "b: starved"]),
        ("--show wetted press", &["wood wetted (µm²)", "top"]),
        ("--show filled depth.csv", &["10.000 µs", "filled share"]),
        (
            "series.csv",
            &["WP, bottom", "95 %, top", "starved", "time (s)", "10⁻⁶"],
        ),
    ] {
        let said = texts(&folder.done(&format!("penetration {arguments} -o -")));
        for word in words {
            assert!(said.contains(&(*word).to_owned()), "{word}: {said:?}");
        }
    }
    let missing = "no row of the side top";
    folder.refused("penetration one.csv -o a.svg", 3, missing);
    let option = "[output] penetration = true";
    folder.refused("penetration none.csv -o a.svg", 3, option);
}

/// A line for each specimen of a table of several, by its name; of a table of one, by the label.
#[test]
fn pores_are_drawn_of_each_specimen() {
    let folder = Folder::new();
    let beech = "file,diameter_um,volume_fraction,up_to_fraction
a/beech.mpts,10,0.4,0.4
a/beech.mpts,60,0.6,1
";
    folder.write("one.csv", beech);
    folder.write("two.csv", &format!("{beech}birch.mpts,80,1,1\n"));
    let said = texts(&folder.done("pores two.csv own=one.csv -o -"));
    for label in ["beech", "birch", "own"] {
        assert!(said.contains(&label.to_owned()), "{label}");
    }
}
