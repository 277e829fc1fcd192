//! Lines over an axis: closing, shear rates, plots.

use std::slice::from_ref;

use figures::{Drawing, Error, Labelled, Mark, Page, Plot, closing, response, shear_rates};

use crate::{BLUE, Folder, VERMILION, csv, pixels, says, share};

/// A history whose pressure rises to `peak` Pa at 40 us.
fn history(peak: f64) -> String {
    let row = |i: i32| {
        let (time, part) = (f64::from(i) * 1e-7, f64::from(i) / 400.0);
        format!("{i},{time},1.0,{0},{0},", peak * part)
    };
    let header = "step,time_s,closing_speed_m_s,pressure_bottom_Pa,pressure_top_Pa,extra";
    csv(header, (0..=400).map(row))
}

fn closed(runs: &[Labelled]) -> Drawing {
    closing(runs, &[], None, "", Page::default()).unwrap()
}

#[test]
fn pressure_and_speed_have_units_labels_and_both_lines() {
    let folder = Folder::new();
    let runs = [("XPIC(5)", 2.4e6), ("frictionless", 1.2e6)]
        .map(|(label, peak)| folder.labelled(label, history(peak)));
    let drawing = closing(&runs, &[], Some(2.5e6), "PF", Page::default()).unwrap();
    let axes = ["pressure (MPa)", "closing speed (m/s)", "time (µs)"];
    says(&drawing, &axes);
    says(&drawing, &["XPIC(5)", "frictionless", "PF", "40", "2"]);
    says(&drawing, &["pressure limit, 2.5 MPa"]);
    let (width, pixels) = pixels(&drawing);
    let (blue, red) = (share(&pixels, BLUE), share(&pixels, VERMILION));
    println!("{width} wide, blue {blue:.5}, vermilion {red:.5}");
    assert!(width == 1600 && blue > 5e-4 && red > 5e-4);
}

/// A press at 1 MPa once had a line at the paper's 2.5 MPa.
#[test]
fn the_limit_is_that_of_the_runs_unless_one_is_given() {
    let folder = Folder::new();
    let run = folder.labelled("a", history(1e6));
    folder.file("bondline-run.toml", "");
    folder.file("resolved.toml", "[clamp]\nmax_pressure = \"1 MPa\"\n");
    says(&closed(from_ref(&run)), &["pressure limit, 1 MPa"]);
    let elsewhere = Folder::new();
    let other = elsewhere.labelled("b", history(1e6));
    let both = closed(&[run, other]);
    assert!(
        !both
            .text_boxes()
            .iter()
            .any(|one| one.text.contains("limit"))
    );
}

/// The line of a run at twice the pressure must reach twice as high: measured on the pixels.
#[test]
fn curves_are_drawn_at_the_height_of_their_values() {
    let folder = Folder::new();
    let highest = |peak: f64| {
        let runs = [("a", peak), ("b", 2e6)];
        let runs = runs.map(|(label, peak)| folder.labelled(label, history(peak)));
        let (width, pixels) = pixels(&closed(&runs));
        // Below the legend, above the speed panel.
        let rows = pixels.chunks(width).enumerate().take(680).skip(120);
        let blue = rows.filter(|(_, row)| row.contains(&BLUE));
        let found: Vec<usize> = blue.map(|(row, _)| row).collect();
        (found[0] as f64, found[found.len() - 1] as f64)
    };
    let ((full, base), (half, _)) = (highest(2e6), highest(1e6));
    let ratio = (base - half) / (base - full);
    println!("rows: base {base}, half {half}, full {full}; ratio {ratio:.3}");
    assert!((ratio - 0.5).abs() < 0.02);
}

/// Pressure is that of the end of a step, whatever its length, speed that of its middle.
#[test]
fn pressure_stands_at_the_end_of_a_step_and_speed_in_its_middle() {
    let folder = Folder::new();
    let drawn = |step: f64| {
        let rows = (1..6).map(|end| format!("{end}e-6,{step},{end},{end}e5"));
        let header = "time_s,dt_s,closing_speed_m_s,pressure_top_Pa";
        pixels(&closed(&[folder.labelled("a", csv(header, rows))])).1
    };
    let [still, moved] = [0.0, 1e-6].map(drawn);
    let half = still.len() / 2;
    assert!(still[..half] == moved[..half], "pressure");
    assert!(still[half..] != moved[half..], "speed");
}

/// Stages of milliseconds stand beside a hold of minutes.
#[test]
fn a_press_programme_has_a_logarithmic_time_and_named_stages() {
    let folder = Folder::new();
    let rows = [(1e-3, 0), (1.0, 2), (1.02, 3), (300.0, 4)];
    let rows = rows.map(|(t, stage)| format!("{t},1e-3,1,1e6,{stage}"));
    let header = "time_s,dt_s,closing_speed_m_s,pressure_top_Pa,stage";
    let run = [folder.labelled("a", csv(header, rows))];
    says(
        &closed(&run),
        &["time (s)", "10⁻²", "10²", "stage 0", "stage 2"],
    );
    folder.file("bondline-run.toml", "");
    let stages =
        ["approach", "ramp", "hold"].map(|kind| format!("[[clamp.stage]]\nkind = \"{kind}\"\n"));
    folder.file("resolved.toml", stages.concat());
    let drawing = closed(&run);
    says(&drawing, &["ramp", "stage 4"]);
    // There is no room for a second name at the same place.
    assert!(!drawing.text_boxes().iter().any(|one| one.text == "hold"));
}

/// A run at 1 MPa and its finer one at 1.2, which goes as far in half the time: in cells of no size 1.4 +- 0.2
/// by first order, as long as the first one takes.
#[test]
fn the_band_of_a_finer_run_reaches_from_the_line_beyond_the_extrapolation() {
    let folder = Folder::new();
    let flat = |peak: f64, speed: f64| {
        let row = |travel: f64| format!("{},0,{speed},{travel},{peak}", travel / speed);
        let header = "time_s,dt_s,closing_speed_m_s,displacement_m,pressure_top_Pa";
        csv(header, [0.0, 1e-5, 2e-5, 1e-5].map(row))
    };
    let run = folder.labelled("a", flat(1e6, 1.0));
    let mut fine = folder.labelled("fine", flat(1.2e6, 2.0));
    let draw = |fine: &Labelled| closing(from_ref(&run), from_ref(fine), None, "", Page::default());
    let unknown = draw(&fine).unwrap_err();
    assert!(
        matches!(unknown, Error::Request(said) if said.contains("that of no run or of several"))
    );
    fine.label = "a".into();
    let (width, drawn) = pixels(&draw(&fine).unwrap());
    let column = |row: usize| drawn[row * width + width / 2 + 30];
    // A quarter of a series over white, which no line has.
    let shaded = |pixel: [u8; 3], series: [u8; 3]| {
        let mut channels = pixel.into_iter().zip(series);
        channels.all(|(found, c)| u32::from(found).abs_diff((u32::from(c) + 3 * 255) / 4) <= 2)
    };
    let near = |row: &usize| shaded(column(*row), BLUE);
    let band: Vec<usize> = (60..680).filter(near).collect();
    let line: Vec<usize> = (60..680).filter(|row| column(*row) == BLUE).collect();
    let (top, bottom, line) = (band[0], band[band.len() - 1], line[line.len() / 2]);
    println!("rows: band {top} to {bottom}, line {line}");
    // The line stands at 1.0, the band from there to 1.6, of an axis to 1.12 times that in 600 rows.
    let height = (line - top) as f64 / 600.0 * 1.12 * 1.6;
    assert!(line - bottom < 8 && (height - 0.6).abs() < 0.01, "{height}");
    // The shades of all bands stand in the key, which is 24 high.
    let other = |of: &Labelled| {
        let (label, path) = ("b".to_owned(), of.path.clone());
        [of.clone(), Labelled { label, path }]
    };
    let both = closing(&other(&run), &other(&fine), None, "", Page::default());
    let (width, drawn) = pixels(&both.unwrap());
    for series in [BLUE, VERMILION] {
        let key = drawn[..2 * 34 * width].iter();
        let found = key.filter(|pixel| shaded(**pixel, series)).count();
        assert!(found > 300, "{series:?}: {found} pixels");
    }
}

#[test]
fn a_single_row_is_a_dot() {
    let folder = Folder::new();
    let run = |rows: &str| {
        let header = "time_s,closing_speed_m_s,pressure_bottom_Pa,pressure_top_Pa\n";
        folder.labelled("a", header.to_owned() + rows)
    };
    let (_, dot) = pixels(&closed(&[run("1e-6,1,1e6,1e6\n")]));
    let blue = share(&dot, BLUE);
    println!("one row: {blue:.6} of the picture is its mark and legend");
    assert!(blue > 1e-4 && blue < 3e-3);
}

#[test]
fn shear_rates_have_bands_median_and_decades() {
    let folder = Folder::new();
    let header = "time_s,q05,q10,q25,q50,q75,q90,q95,max";
    let row = |i: i32| {
        let rates = [0.1, 0.2, 0.5, 1.0, 2.0, 4.0, 6.0, 20.0].map(|q| q * f64::from(i) * 1e3);
        let rates = rates.map(|rate| format!(",{rate}")).concat();
        format!("{}{rates}", f64::from(i) * 2e-6)
    };
    let source = folder.labelled("PF", csv(header, (0..20).map(row)));
    let drawing = shear_rates(&[source], Page::default()).unwrap();
    says(&drawing, &["shear rate (1/s)", "time (µs)", "PF", "10⁵"]);
    says(&drawing, &["median", "maximum", "5 to 95 %"]);
    // Nothing flows at the start: eight rates.
    says(&drawing, &["left out: 8 not above zero"]);
    let (_, pixels) = pixels(&drawing);
    let bluish = |p: &&[u8; 3]| p[2] > p[0] && p[2] - p[0] > 20;
    let band = pixels.iter().filter(bluish).count() as f64 / pixels.len() as f64;
    println!("bands cover {band:.3}");
    assert!(band > 0.08 && band < 0.4);
    let slow = folder.labelled("slow", csv(header, [row(1), row(1000)]));
    says(&shear_rates(&[slow], Page::default()).unwrap(), &["10⁻³"]);
    let still = folder.labelled("still", csv(header, [row(0)]));
    let said = shear_rates(&[still], Page::default()).unwrap_err();
    assert!(said.to_string().contains("nothing flows"));
}

#[test]
fn a_plot_has_titles_labels_and_marks() {
    let plot = Plot::new("errors", "CPU (s)", "error (%)")
        .logarithmic([true, true])
        .with("ours", Mark::LineAndDots, vec![[1.0, 10.0], [10.0, 1.0]])
        .with("theirs", Mark::Dots, vec![[3.0, 30.0], [f64::NAN, 1.0]]);
    let drawing = plot.draw(Page::default()).unwrap();
    says(&drawing, &["errors", "CPU (s)", "error (%)"]);
    says(&drawing, &["ours", "theirs", "10"]);
    let (_, pixels) = pixels(&drawing);
    // The second series has dots and no line: its colour covers little, but something.
    let colours = [BLUE, VERMILION].map(|c| share(&pixels, c));
    assert!(colours[0] > colours[1] && colours[1] > 1e-5, "{colours:?}");
    // The deepest of six decades once stood at the edge, as what is zero did.
    let wide = Plot::new("", "speed (m/s)", "y")
        .logarithmic([true, false])
        .with("a", Mark::Dots, vec![[1e-6, 1.0], [1.0, 2.0], [0.0, 3.0]]);
    let wide = wide.draw(Page::default()).unwrap();
    says(&wide, &["10⁻⁶", "10⁰", "left out: 1 not above zero"]);
    let empty = Plot::new("none", "", "").with("a", Mark::Line, vec![[f64::NAN, 0.0]]);
    assert!(matches!(empty.draw(Page::default()), Err(Error::Data(_))));
}

/// A run that failed has no results, and no other may lack one.
#[test]
fn a_sweep_is_drawn_without_the_runs_that_failed() {
    let folder = Folder::new();
    let drawn = |status: &str, result: &str| {
        let rows = ["1,1,sound,10,1e5".to_owned(), format!("2,2,{status},,")];
        let sweep = folder.labelled("sweep", csv("row,mu,status,wp_um,pressure_pa", rows));
        response(&sweep, result, None, Page::default())
    };
    let lacks = drawn("failed", "wp").unwrap_err();
    assert!(matches!(lacks, Error::Request(said) if said.contains("no column wp: it has")));
    let drawing = drawn("failed", "wp_um").unwrap();
    assert_eq!(drawing.to_svg().unwrap().matches("(MPa)").count(), 1);
    let said = drawn("sound", "wp_um").unwrap_err().to_string();
    assert!(said.contains("line 3, column wp_um: ''"), "{said}");
}
