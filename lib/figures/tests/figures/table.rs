//! Table 2.

use std::fmt::Write as _;

use figures::{Case, CellErrors, Table2};

use crate::Folder;

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
    assert!(!text.contains("56.41") && !text.contains("paper"), "{text}");
    let text = table.with_paper(true).to_text();
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

/// The table of `wp-metrics --finer` with WP 7.15 +- 0.25 in total, of a run with `wp` as run.
fn finer(wp: f64) -> String {
    let mut text = String::from("file,side,reference,wp_um,slab_wp_um,ep_um,pressure_pa");
    text += ",wp_extrapolated_um,wp_error_um,ep_extrapolated_um,ep_error_um,pressure_extrapolated_pa,pressure_error_pa\n";
    for side in ["bottom", "top", "total"] {
        let _ = writeln!(
            text,
            "a.mpts,{side},mid,{wp},4.2,5,2.4e6,7.15,0.25,4.5,0.5,2.1e6,3e5"
        );
    }
    text
}

#[test]
fn implicit_runs_have_errors_and_the_others_their_difference() {
    let folder = Folder::new();
    let case = |name: &str, text: String| Case {
        adhesive: "pf".into(),
        name: name.into(),
        path: folder.file(name, text),
    };
    let plain = wp(8.0, 9.0, 8.5);
    let pressed = finer(8.5)
        .lines()
        .map(|line| line.split(',').take(7).collect::<Vec<_>>().join(",") + "\n")
        .collect();
    let runs = [
        case("flip", pressed),
        case("frictionless", plain.clone()),
        case("implicit", finer(7.65)),
        case("implicit-frictionless", finer(6.0).replace("7.15", "6.5")),
    ];
    let errors = CellErrors::read(&runs).unwrap().unwrap();
    let mut csv = Vec::new();
    errors.write_csv(&mut csv).unwrap();
    let csv = String::from_utf8(csv).unwrap();
    println!("{csv}{}", errors.to_text());
    for row in [
        "pf,flip,wp,total,um,8.5000,,0.2500,implicit,1.3500",
        "pf,flip,pressure,total,MPa,2.4000,,0.3000,implicit,0.3000",
        "pf,frictionless,wp,total,um,8.5000,,0.2500,implicit-frictionless,2.0000",
        "pf,implicit,wp,total,um,7.6500,7.1500,0.2500,,",
        "pf,implicit,ep,top,um,5.0000,4.5000,0.5000,,",
    ] {
        assert!(
            csv.lines().any(|line| line == row),
            "{row} is not in\n{csv}"
        );
    }
    let table = Table2::read(&runs).unwrap();
    let shown = table.to_text();
    assert!(shown.contains("7.15 +- 0.25"), "{shown}");
    let picture =
        crate::texts(&table.draw(&std::collections::BTreeMap::new(), figures::Page::default()));
    assert!(picture.iter().any(|text| text == "± 0.25"), "{picture:?}");
    let text = errors.to_text();
    let line = |name: &str| text.lines().rfind(|l| l.contains(name)).unwrap().to_owned();
    assert!(line(" flip").contains("+0.300"), "{text}");
    assert!(
        line(" implicit ").contains("4.50 +- 0.50")
            && line(" implicit ").contains("2.100 +- 0.300"),
        "{text}"
    );
    // A pressure that the table does not have is not made up.
    assert!(line(" frictionless").trim_end().ends_with('-'), "{text}");
    assert!(CellErrors::read(&[case("alone", plain)]).unwrap().is_none());
}

/// A press that was made again, and closed, once stood in Table 2 with the WP of the one that had not.
#[test]
fn a_table_of_a_run_that_was_made_again_is_refused() {
    use particle_file::{Draft, Header, Kind, ParticleFile};
    let folder = Folder::new();
    folder.file("bondline-run.toml", "");
    folder.file(
        "summary.json",
        r#"{"end": "closed", "verdict": {"sound": true}}"#,
    );
    let state = folder.file("final.mpts", "");
    let header = Header::new(Kind::State, 1.0, 1, [0.0; 3], [1.0; 3]);
    let mut bytes = Vec::new();
    Draft::new(header).write_to(&mut bytes).unwrap();
    std::fs::write(&state, bytes).unwrap();
    let hash = ParticleFile::open(&state).unwrap().content_hash();
    let table = wp(1.0, 2.0, 1.5).replace("a.mpts", "run/final.mpts");
    let path = folder.file("wp.csv", table);
    let read = |hash: u64| {
        let inputs = format!(r#"[{{"path": "run/final.mpts", "xxh3": "{hash:016x}"}}]"#);
        folder.file(
            "wp.csv.provenance.json",
            format!(r#"{{"inputs": {inputs}}}"#),
        );
        let (adhesive, name, path) = ("pf".into(), "flip".into(), path.clone());
        Table2::read(&[Case {
            adhesive,
            name,
            path,
        }])
    };
    assert!(read(hash).is_ok());
    let said = read(hash ^ 1).unwrap_err().to_string();
    assert!(
        said.contains("as it is now: run wp-metrics again"),
        "{said}"
    );
}

/// A press with 42 % of its gap left once stood in Table 2 as a result.
#[test]
fn a_press_that_did_not_close_is_marked() {
    let folder = Folder::new();
    folder.file("bondline-run.toml", "");
    folder.file(
        "summary.json",
        r#"{"end": "time-limit", "verdict": {"sound": true, "reasons": []}, "gap_m": 4.2e-6, "travel_m": 5.8e-6, "time_s": 1e-5}"#,
    );
    let path = folder.file(
        "wp.csv",
        wp(1.0, 2.0, 1.5).replace("a.mpts", "run/final.mpts"),
    );
    let (adhesive, name) = ("pf".into(), "flip".into());
    let table = Table2::read(&[Case {
        adhesive,
        name,
        path,
    }])
    .unwrap();
    let text = table.to_text();
    assert!(
        text.contains("  not closed, 42 % of the gap left\n"),
        "{text}"
    );
    assert!(text.contains("--set \"clamp.time_limit=30 us\""), "{text}");
    let mut csv = Vec::new();
    table.write_csv(&mut csv).unwrap();
    let csv = String::from_utf8(csv).unwrap();
    let cells = ",time-limit,true,4.2000,\"not closed, 42 % of the gap left\"\n";
    assert!(csv.ends_with(cells), "{csv}");
    let picture = table.draw(&std::collections::BTreeMap::new(), figures::Page::default());
    assert!(
        crate::texts(&picture)
            .iter()
            .any(|t| t.starts_with("not closed"))
    );
}
