//! Table 2.

use std::collections::BTreeMap;
use std::path::PathBuf;

use figures::{Case, Page, Table2};
use particle_file::{Draft, Header, Kind, ParticleFile};

use crate::{Folder, csv, says, texts};

fn case(adhesive: &str, name: &str, path: PathBuf) -> Case {
    let (adhesive, name) = (adhesive.into(), name.into());
    Case {
        adhesive,
        name,
        path,
    }
}

/// The table of `file` with WP of the bottom, the top and in total.
fn wp(file: &str, wp: [f64; 3]) -> String {
    let rows = ["bottom", "top", "total"].into_iter().zip(wp);
    let rows = rows.map(|(side, wp)| format!("{file},{side},mid,7e-5,{wp},6.697,23.2"));
    csv("file,side,reference,plane_m,wp_um,slab_wp_um,ep_um", rows)
}

/// What a table writes, by lines.
fn written(write: impl Fn(&mut Vec<u8>) -> std::io::Result<()>) -> Vec<String> {
    let mut bytes = Vec::new();
    write(&mut bytes).unwrap();
    let text = String::from_utf8(bytes).unwrap();
    text.lines().map(String::from).collect()
}

#[test]
fn table_2_has_ours_the_slab_and_the_papers_numbers_labelled() {
    let folder = Folder::new();
    let cases = [
        ("pf", "experiment", [8.5, 8.6, 8.55]),
        ("pva-pf", "xpic", [1.0, 2.0, 1.5]),
        ("pf", "implicit", [3.0, 4.0, 3.5]),
    ];
    let cases = cases.map(|(adhesive, name, of)| {
        let path = folder.file(&format!("{adhesive}{name}"), wp("a.mpts", of));
        case(adhesive, name, path)
    });
    let table = Table2::read(&cases).unwrap();
    let rows = written(|out| table.write_csv(out));
    for (row, begins) in rows[1..].iter().zip([
        "pf,experiment,mid,8.5000,8.6000,8.5500,6.6970,Experimental,68.5700,31.6200,56.4100,\"paper: the paper's own specimen, not this one\"",
        "pf,implicit,mid,3.0000,4.0000,3.5000,6.6970,,,,,",
        "pva-pf,xpic,mid,1.0000,2.0000,1.5000,6.6970,XPIC(5),25.2100,23.3200,24.3500,",
    ]) {
        assert!(row.starts_with(begins), "{row}");
    }
    let text = table.to_text();
    assert!(!text.contains("56.41") && !text.contains("paper"), "{text}");
    let text = table.with_paper(true).to_text();
    let told = ["another specimen", "56.41"];
    assert!(told.iter().all(|told| text.contains(told)), "{text}");
    let two = wp("a.mpts", [1.0; 3]).replacen("a.mpts", "b.mpts", 1);
    let said = Table2::read(&[case("pf", "flip", folder.file("two", two))]).unwrap_err();
    assert!(said.to_string().contains("several states"), "{said}");
}

/// The table of `wp-metrics --finer` with WP 7.15 +- 0.25 in total, of a run with `wp` as run.
fn finer(wp: f64) -> String {
    let header = "file,side,reference,wp_um,slab_wp_um,ep_um,pressure_pa,wp_extrapolated_um,wp_error_um,\
                  ep_extrapolated_um,ep_error_um,pressure_extrapolated_pa,pressure_error_pa";
    let rows = ["bottom", "top", "total"]
        .map(|side| format!("a.mpts,{side},mid,{wp},4.2,5,2.4e6,7.15,0.25,4.5,0.5,2.1e6,3e5"));
    csv(header, rows)
}

#[test]
fn implicit_runs_have_errors_and_the_others_their_difference() {
    let folder = Folder::new();
    let case = |name: &str, text: &str| case("pf", name, folder.file(name, text));
    let plain = wp("a.mpts", [8.0, 9.0, 8.5]);
    let pressed_to = |state: &str, pressure: &str| {
        let finer = finer(6.0).replace("2.1e6,3e5", pressure);
        finer.replace("a.mpts", state)
    };
    let whole = finer(8.5);
    let pressed = whole.lines().map(|line| {
        let cells: Vec<&str> = line.split(',').take(7).collect();
        cells.join(",") + "\n"
    });
    let pressed: String = pressed.collect();
    let runs = [
        case("flip", &pressed),
        case("frictionless", &plain),
        case("implicit", &finer(7.65)),
        case("implicit-frictionless", &finer(6.0).replace("7.15", "6.5")),
        case("held", &pressed_to("final.mpts", "2.5e6,4e0")),
        case("at its limit", &pressed_to("a.mpts", "2.5e6,4e0")),
        case("let go", &pressed_to("final.mpts", "0,0")),
    ];
    folder.file("bondline-run.toml", "");
    folder.file(
        "summary.json",
        r#"{"end": "closed", "verdict": {"sound": true}, "programme": [{"kind": "hold", "wp_m": 7e-6}, {"kind": "release"}]}"#,
    );
    folder.file("resolved.toml", "[clamp]\nmax_pressure = \"2.5 MPa\"\n");
    let table = Table2::read(&runs).unwrap();
    assert!(table.has_cell_errors());
    let rows = written(|out| table.write_cell_errors(out));
    for row in [
        "pf,flip,wp,total,um,8.5000,,0.2500,implicit,1.3500",
        "pf,flip,pressure,total,MPa,2.4000,,0.3000,implicit,0.3000",
        "pf,frictionless,wp,total,um,8.5000,,0.2500,implicit-frictionless,2.0000",
        "pf,implicit,wp,total,um,7.6500,7.1500,0.2500,,",
        "pf,implicit,ep,top,um,5.0000,4.5000,0.5000,,",
    ] {
        assert!(
            rows.iter().any(|line| line == row),
            "{row} is not in {rows:#?}"
        );
    }
    let shown = table.to_text();
    let released = "pf let go: WP is after the release, in total 7.00 um before it";
    for told in [released, "7.15 +- 0.25", "sqrt(bottom^2 + top^2)/2"] {
        assert!(shown.contains(told), "{shown}");
    }
    says(&table.draw(&BTreeMap::new(), Page::default()), &["± 0.25"]);
    let width_mm = Some(Page::NARROWEST);
    let dpi = 240.0;
    let narrow = texts(&table.draw(&BTreeMap::new(), Page { width_mm, dpi }));
    let mut notes = narrow.iter().filter(|text| text.contains(' '));
    assert!(!notes.any(|note| note.contains('…')), "{narrow:?}");
    let text = table.cell_errors_to_text();
    for (name, told) in [
        (" flip", "+0.300"),
        (" implicit ", "4.50 +- 0.50"),
        (" implicit ", "2.100 +- 0.300"),
        (" held ", " 2.500 at the limit"),
        // Where no case tells the limit, and where two pressures of nothing agree.
        (" at its limit ", " 2.500 +- 4e-6"),
        (" let go ", "                  0"),
        // A pressure that the table does not have is not made up.
        (" frictionless", " -"),
    ] {
        let line = text.lines().rfind(|line| line.contains(name)).unwrap();
        assert!(line.contains(told), "{line}");
    }
    // Beside a run that closed, one that stood still with half of the gap left.
    let open = Folder::new();
    for (place, gap_m) in [(&open, 5e-6), (&folder, 0.0)] {
        place.file("bondline-run.toml", "");
        let summary =
            r#"{"end": "closed", "verdict": {"sound": true}, "travel_m": 5e-6, "gap_m": "#;
        place.file("summary.json", format!("{summary}{gap_m}}}"));
    }
    let flip = Case {
        path: open.file("wp.csv", pressed.replace("a.mpts", "final.mpts")),
        ..case("flip", "")
    };
    let apart = [
        flip,
        case("implicit", &pressed_to("final.mpts", "2.1e6,3e5")),
    ];
    let rows = written(|out| Table2::read(&apart).unwrap().write_cell_errors(out));
    let row = "pf,flip,pressure,total,MPa,2.4000,,,,";
    assert!(rows.iter().any(|line| line == row), "{rows:#?}");
    let alone = Table2::read(&[case("alone", &plain)]).unwrap();
    assert!(!alone.has_cell_errors());
}

/// A press that was made again, and closed, once stood in Table 2 with the WP of the one that had not.
#[test]
fn a_table_of_a_run_that_was_made_again_is_refused() {
    let folder = Folder::new();
    folder.file("bondline-run.toml", "");
    let summary = r#"{"end": "closed", "verdict": {"sound": true}}"#;
    folder.file("summary.json", summary);
    let header = Header::new(Kind::State, 1.0, 1, [0.0; 3], [1.0; 3]);
    let mut bytes = Vec::new();
    Draft::new(header).write_to(&mut bytes).unwrap();
    let state = folder.file("final.mpts", bytes);
    let hash = ParticleFile::open(&state).unwrap().content_hash();
    let path = folder.file("wp.csv", wp("run/final.mpts", [1.0, 2.0, 1.5]));
    let read = |hash: u64| {
        let record =
            format!(r#"{{"inputs": [{{"path": "run/final.mpts", "xxh3": "{hash:016x}"}}]}}"#);
        folder.file("wp.csv.provenance.json", record);
        Table2::read(&[case("pf", "flip", path.clone())])
    };
    assert!(read(hash).is_ok());
    let said = read(hash ^ 1).unwrap_err().to_string();
    let expected = "does not belong to the present";
    assert!(said.contains(expected), "{said}");
}

/// A press with 42 % of its gap left once stood in Table 2 as a result.
#[test]
fn a_press_that_did_not_close_is_marked() {
    let folder = Folder::new();
    folder.file("bondline-run.toml", "");
    let summary = r#"{"end": "time-limit", "verdict": {"sound": true, "reasons": []}, "gap_m": 4.2e-6, "travel_m": 5.8e-6, "time_s": 1e-5, "outlook": {"said": "it slows", "time_limit_s": 2.9e-5}}"#;
    folder.file("summary.json", summary);
    let path = folder.file("wp.csv", wp("run/final.mpts", [1.0, 2.0, 1.5]));
    let table = Table2::read(&[case("pf", "flip", path)]).unwrap();
    let text = table.to_text();
    for told in [
        "  not closed, 42 % of the gap left\n",
        "unfinished press; it slows. For a longer press: --set \"clamp.time_limit=30 us\"",
    ] {
        assert!(text.contains(told), "{text}");
    }
    let rows = written(|out| table.write_csv(out));
    let cells = ",time-limit,true,4.2000,\"not closed, 42 % of the gap left\",";
    assert!(rows[1].ends_with(cells));
    let picture = texts(&table.draw(&BTreeMap::new(), Page::default()));
    assert!(picture.iter().any(|t| t.starts_with("not closed")));
}
