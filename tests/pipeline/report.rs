//! The page of `bond-report`: what is in it, and what a browser makes of it.

use std::process::{Command, Output};

use crate::workbench::{IMPLICIT, Workbench, said};

/// A page about a small run.
fn reported() -> Workbench {
    let bench = Workbench::with_bond();
    bench.press("run", &[IMPLICIT], "");
    bench.done(
        "wp-metrics -q run/final.mpts -o wp.csv
         bond-figures table2 -q --run 'pf:<i>implicit=wp.csv' -o table2.csv
         bond-figures pressure -q --run run -o pressure.svg
         cp wp.csv run
         bond-figures slice -q run/final.mpts -o slice.png
         bond-report -q --title 'A <script>alert(1)</script> & \"b\"' --run '<b>implicit=run' --experiment '<b>measured=wp.csv' \
             --table 'Table 2=table2.csv' --picture Pressure=pressure.svg --picture Slice=slice.png \
             --state end=run/final.mpts -o report.html",
    );
    bench
}

#[test]
fn the_page_holds_all_that_was_given_and_asks_no_network() {
    let bench = reported();
    let page = bench.text("report.html");
    // Nothing that asks another host, no markup of others, no JSON of runs or of the page.
    for absent in [
        "src=\"http",
        "href=\"http",
        "url(http",
        "src=\"//",
        "@import",
        "<link",
        "<iframe",
        "<script>alert",
        "<b>",
        "<i>",
        "&quot;verdict&quot;",
        "&quot;xxh3&quot;",
    ] {
        assert!(!page.contains(absent), "{absent}");
    }
    assert!(page.contains("default-src 'none'"));
    let resolved = bench.text("run/resolved.toml").replace('&', "&amp;");
    let resolved = resolved.replace('<', "&lt;").replace('>', "&gt;");
    let resolved = resolved.replace('"', "&quot;").replace('\'', "&#39;");
    assert!(page.contains(&resolved));
    // WP of the table, rounded; the summary has it once more.
    let wp: f64 = bench.table("table2.csv").rows[0][5].parse().unwrap();
    for number in [format!(">{wp:.2}</td>"), format!(">{wp:.3}</td>")] {
        assert!(page.contains(&number), "{number}");
    }
    let (head, rest) = page.split_at(page.find("<h3>Limitations").unwrap());
    for told in [
        "<h2>Summary</h2>",
        "specimen",
        "voxels of ",
        "<td>closed</td>",
        "Weighted penetration (um)",
        "<th scope=\"row\">&lt;b&gt;measured</th>",
    ] {
        assert!(head.contains(told), "{told}");
    }
    assert!(rest.contains("The error due to the cell size is not known"));
    let count = |tag: &str| page.matches(tag).count();
    assert_eq!((count("<h1>"), count("<h2>")), (1, 5));
    assert_eq!(count("<img alt=\""), count("<img "));
    assert_eq!(count("<table>"), count("<caption>"));
    assert!(page.len() < 1_000_000, "{} bytes", page.len());
    bench.ends(2, "bond-report --run run -o run/summary.json", "");
}

/// A run in cells of its case beside one of the same press that is extrapolated.
#[test]
fn runs_without_an_error_are_held_against_the_extrapolated_one() {
    let bench = Workbench::with_bond();
    bench.press("run", &[IMPLICIT], "");
    bench.done("cp -r run plain");
    let wp = bench.measured("run/final.mpts").column("wp_um");
    let rows = ["bottom", "top", "total"].iter().zip(&wp);
    let rows = rows.map(|(side, wp)| format!("{side},{wp},{},0.1\n", 0.8 * wp));
    let header = "side,wp_um,wp_extrapolated_um,wp_error_um\n";
    bench.write("run/wp.csv", header.to_owned() + &rows.collect::<String>());
    bench.done("bond-report --run best=run --run plain -o page.html");
    let page = bench.text("page.html");
    let off = format!("plain by +{:.2} um (+25 %) from best.", 0.2 * wp[2]);
    assert!(page.contains(&off), "{off}");
    assert!(!page.contains("is not known (wp-metrics"));
    assert!(page.contains("sqrt(bottom^2 + top^2)/2"));
    assert!(page.contains("no measurement of the specimen is on this page"));
    // The specimen, measured: 0.8 times what its run says would be -20 %.
    bench.done(
        "wp-metrics -q specimen.mpts -o measured.csv
         bond-report --run plain --experiment scan=measured.csv -o page.html",
    );
    let page = bench.text("page.html");
    let scan = bench.measured("specimen.mpts").column("wp_um")[2];
    let off = (wp[2] - scan).abs();
    let off = format!(
        "{off:.2} um ({:+.0} %) from scan.",
        100.0 * (wp[2] / scan - 1.0)
    );
    assert!(page.contains(&off), "{off}");
    assert!(!page.contains("no measurement") && !page.contains("no scan"));
    assert_eq!(page.matches("pressure at the end (MPa)").count(), 1);
}

#[test]
fn runs_that_failed_or_have_not_ended_are_shown_with_their_sentence() {
    let bench = Workbench::new();
    for folder in ["failed", "killed", "wood", "elsewhere"] {
        std::fs::create_dir(bench.path(folder)).unwrap();
        let case = "[grid]\ncell = \"2 um\"\n";
        bench.write(&format!("{folder}/resolved.toml"), case);
    }
    let summary = r#"{"end": "failed", "verdict": {"sound": false, "reasons": ["step 7: too <fast>"]}, "steps": 6, "liquid_points": 12288, "points_left": 2393,
        "expected_error": {"cells_per_lumen": 6.0, "measured_with_cells": 6.0, "errors": []},
        "lumens": [{"what": "lumens at the bond", "why": "3.5 cells"}],
        "left_out": [{"what": "beyond the sides", "why": "air is closed off"}]}"#;
    bench.write("failed/summary.json", summary);
    // Of the run before, in the same folder.
    let table = "side,wp_um\nbottom,7.77\ntop,7.77\ntotal,7.77\n";
    bench.write("killed/wp.csv", table);
    bench.done(
        "synth-xct -q --adhesive pf -o a.tif
         xct2particles -q a.tif --labels void=128,wood=0,adhesive=255 --yes-really -o failed/final.mpts
         xct2particles -q a.tif -o killed/final.mpts
         synth-xct -q --adhesive none --size 24x24x24 -o w.tif
         xct2particles -q w.tif --labels void=0,wood=128 --yes-really -o wood/final.mpts
         cd elsewhere
         bond-report --run failed=../failed --run killed=../killed --run wood=../wood -o ../page.html",
    );
    let page = bench.text("page.html");
    assert!(!page.contains("7.77") && !page.contains("killed: wood and void"));
    for told in [
        "failed: failed: step 7: too &lt;fast&gt;",
        "killed: not ended: mpm-run --resume continues it",
        "<td>not ended</td>",
        "failed: wood and void look exchanged",
        "lumens at the bond: 3.5 cells",
        "failed: 19 % of the adhesive left through open sides",
        "Beyond the sides: air is closed off: failed.",
        "<td>w.tif (synthetic)</td>",
        "of the \u{201c}experiment\u{201d}: failed, killed.",
        "Synthetic specimens: wood generated by a program: wood.",
    ] {
        assert!(page.contains(told), "{told}");
    }
}

/// A browser of this machine.
fn browser() -> Option<&'static str> {
    let found = |name: &&str| {
        let answer = Command::new(name).arg("--version").output();
        answer.is_ok_and(|answer| answer.status.success())
    };
    ["chromium", "chromium-browser", "google-chrome"]
        .into_iter()
        .find(found)
}

/// Opens the page of `bench` without a screen or a host to reach; what the browser makes of it.
fn opened(bench: &Workbench, browser: &str) -> Output {
    let page = format!("file://{}", bench.path("report.html").display());
    let profile = format!("--user-data-dir={}", bench.path("profile").display());
    let common = [
        "--headless=new",
        "--no-sandbox",
        "--disable-dev-shm-usage",
        "--use-angle=swiftshader",
        "--enable-unsafe-swiftshader",
        "--host-resolver-rules=MAP * ~NOTFOUND",
        "--enable-logging=stderr",
        "--window-size=1100,900",
        "--virtual-time-budget=20000",
        "--dump-dom",
    ];
    let mut command = Command::new(browser);
    command.args(common).arg(profile).arg(page);
    command.output().unwrap()
}

#[test]
fn a_browser_shows_the_page_and_turns_its_pictures_into_views() {
    let Some(browser) = browser() else {
        println!("skipped: no chromium or google-chrome is installed");
        return;
    };
    let bench = reported();
    let shown = opened(&bench, browser);
    let page = String::from_utf8_lossy(&shown.stdout);
    // Paper has the picture of a view.
    let picture = "<img alt=\"end: ";
    for wanted in ["data-view=\"ready\"", "<canvas", "cut wood", picture] {
        assert!(page.contains(wanted), "no {wanted}: {}", said(&shown));
    }
    let told = said(&shown);
    let complains = |line: &&str| line.contains("CONSOLE") && !line.contains("GPU stall");
    assert_eq!(told.lines().find(complains), None);
    // Where scripts do not run the pictures stay.
    let text = bench.text("report.html");
    bench.write(
        "report.html",
        text.replace("; script-src 'unsafe-inline'", ""),
    );
    let plain = opened(&bench, browser);
    let page = String::from_utf8_lossy(&plain.stdout);
    assert!(page.contains("<h2>Summary</h2>") && page.contains(picture));
    assert!(!page.contains("<canvas"), "{}", said(&plain));
}
