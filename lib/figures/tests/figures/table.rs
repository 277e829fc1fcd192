//! Table 2.

use std::fmt::Write as _;

use figures::{Case, Table2};

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
