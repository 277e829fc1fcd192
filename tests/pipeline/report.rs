//! The page of `bond-report`: what is in it, and what a browser makes of it.

use std::process::{Command, Output};

use crate::workbench::{Workbench, said};

/// A page about a small run.
fn reported() -> Workbench {
    let bench = Workbench::with_bond();
    bench.pressed("run", &["integrator.scheme=implicit"], &[]);
    let made = bench.shell(
        "wp-metrics -q run/final.mpts -o wp.csv
         bond-figures table2 -q --run 'pf:<i>implicit=wp.csv' -o table2.csv
         bond-figures pressure -q --run run -o pressure.svg
         cp wp.csv run
         bond-figures slice -q run/final.mpts -o slice.png
         bond-report -q --title 'A <script>alert(1)</script> & \"b\"' --run '<b>implicit=run' \
             --table 'Table 2=table2.csv' --picture Pressure=pressure.svg --picture Slice=slice.png \
             --state end=run/final.mpts -o report.html",
    );
    assert!(made.status.success(), "{}", said(&made));
    bench
}

/// Markup between quotes aside, what would make a browser ask another host.
fn asks_a_network(page: &str) -> bool {
    let sources = [
        "src=\"http",
        "href=\"http",
        "url(http",
        "src=\"//",
        "@import",
        "<link",
        "<iframe",
    ];
    sources.iter().any(|source| page.contains(source))
}

#[test]
fn the_page_holds_all_that_was_given_and_asks_no_network() {
    let bench = reported();
    let page = String::from_utf8(bench.read("report.html")).unwrap();
    assert!(!asks_a_network(&page));
    assert!(page.contains("default-src 'none'"));
    assert!(
        !page.contains("<script>alert") && !page.contains("<b>implicit") && !page.contains("<i>")
    );
    let text = |file: &str| String::from_utf8(bench.read(file)).unwrap();
    let escaped = |text: &str| {
        let text = text
            .replace('&', "&amp;")
            .replace('<', "&lt;")
            .replace('>', "&gt;");
        text.replace('"', "&quot;").replace('\'', "&#39;")
    };
    assert!(page.contains(&escaped(&text("run/resolved.toml"))));
    // WP of the table, rounded; the summary has it once more.
    let table = text("table2.csv");
    let row = table.lines().nth(1).unwrap();
    let wp: f64 = row.split(',').nth(5).unwrap().parse().unwrap();
    for number in [format!(">{wp:.2}</td>"), format!(">{wp:.3}</td>")] {
        assert!(page.contains(&number), "{number}");
    }
    let (head, rest) = page.split_at(page.find("What to doubt").unwrap());
    for told in [
        "<h2>Summary</h2>",
        "specimen",
        "voxels of ",
        "<td>closed</td>",
        "Weighted penetration (um)",
    ] {
        assert!(head.contains(told), "{told}");
    }
    assert!(rest.contains("The error by the size of the cells is not known"));
    // No JSON: neither of runs nor of the page.
    assert!(!page.contains("&quot;verdict&quot;") && !page.contains("&quot;xxh3&quot;"));
    assert_eq!(page.matches("<h1>").count(), 1);
    assert_eq!(page.matches("<h2>").count(), 5);
    assert_eq!(
        page.matches("<img alt=\"").count(),
        page.matches("<img ").count()
    );
    assert_eq!(
        page.matches("<table>").count(),
        page.matches("<caption>").count()
    );
    assert!(page.len() < 1_000_000, "{} bytes", page.len());
    let again = bench.run("bond-report", &["--run", "run", "-o", "run/summary.json"]);
    assert_eq!(again.status.code(), Some(2), "{}", said(&again));
}

#[test]
fn runs_that_failed_or_have_not_ended_are_shown_with_their_sentence() {
    let bench = Workbench::new();
    for folder in ["failed", "killed"] {
        std::fs::create_dir(bench.path(folder)).unwrap();
        bench.write(
            &format!("{folder}/resolved.toml"),
            "[grid]\ncell = \"2 um\"\n",
        );
    }
    let summary = r#"{"end": "failed", "verdict": {"sound": false, "reasons": ["step 7: too <fast>"]}, "steps": 6}"#;
    bench.write("failed/summary.json", summary);
    bench.done(
        "bond-report",
        &["--run", "failed", "--run", "killed", "-o", "page.html"],
    );
    let page = String::from_utf8(bench.read("page.html")).unwrap();
    for told in [
        "failed: failed: step 7: too &lt;fast&gt;",
        "killed: not ended: mpm-run with --resume goes on",
        "<td>not ended</td>",
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

/// Opens the page of `bench` without a screen or a host to reach.
fn opened(bench: &Workbench, browser: &str, more: &[&str]) -> Output {
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
    ];
    let mut command = Command::new(browser);
    command.args(common).arg(profile).args(more).arg(page);
    command.output().unwrap()
}

#[test]
fn a_browser_shows_the_page_and_turns_its_pictures_into_views() {
    let Some(browser) = browser() else {
        println!("skipped: no chromium or google-chrome is installed");
        return;
    };
    let bench = reported();
    let shown = opened(&bench, browser, &["--dump-dom"]);
    let page = String::from_utf8_lossy(&shown.stdout);
    assert!(page.contains("data-view=\"ready\""), "{}", said(&shown));
    assert!(
        page.contains("<canvas") && page.contains("cut wood"),
        "no view"
    );
    let complaints: Vec<String> = (said(&shown).lines())
        .filter(|line| line.contains("CONSOLE") && !line.contains("GPU stall"))
        .map(str::to_owned)
        .collect();
    assert!(complaints.is_empty(), "{complaints:?}");
    // Where scripts do not run the pictures stay.
    let text = String::from_utf8(bench.read("report.html")).unwrap();
    bench.write(
        "report.html",
        text.replace("; script-src 'unsafe-inline'", ""),
    );
    let plain = opened(&bench, browser, &["--dump-dom"]);
    let page = String::from_utf8_lossy(&plain.stdout);
    assert!(
        page.contains("<h2>Summary</h2>") && !page.contains("<canvas"),
        "{}",
        said(&plain)
    );
    assert!(page.contains("<img alt=\"end: "));
}
