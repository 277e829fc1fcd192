//! Lines over an axis: closing, shear rates, plots.

use std::fmt::Write as _;
use std::slice::from_ref;

use figures::{Closing, Error, Mark, Plot, Response, ShearRates};

use crate::{BLUE, Folder, VERMILION, pixels, share, texts};

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
    let drawing = Closing::read(&runs, &[], Some(2.5e6), "PF").unwrap().draw();
    let said = texts(&drawing);
    for text in [
        "pressure (MPa)",
        "closing speed (m/s)",
        "time (µs)",
        "XPIC(5)",
        "frictionless",
        "PF",
        "pressure limit, 2.5 MPa",
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
        let drawing = Closing::read(&runs, &[], None, "").unwrap().draw();
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

/// Pressure and speed are those of the middle of a step, whatever its length.
#[test]
fn rows_stand_in_the_middle_of_their_steps() {
    let folder = Folder::new();
    let drawn = |step: f64| {
        let mut text = String::from("time_s,dt_s,closing_speed_m_s,pressure_top_Pa\n");
        for middle in 1..6 {
            let end = f64::from(middle) * 1e-6 + 0.5 * step;
            let _ = writeln!(text, "{end},{step},1,{middle}e5");
        }
        let run = folder.labelled("a", text);
        pixels(&Closing::read(&[run], &[], None, "").unwrap().draw())
    };
    assert!(drawn(0.0) == drawn(1e-6), "a step is drawn at its end");
}

/// A run at 1 MPa and its finer one at 1.2, which goes as far in half the time: in cells of no size 1.4 +- 0.2
/// by first order, as long as the first one takes.
#[test]
fn the_band_of_a_finer_run_reaches_from_the_line_beyond_the_extrapolation() {
    let folder = Folder::new();
    let flat = |peak: f64, speed: f64| {
        let mut text =
            String::from("time_s,dt_s,closing_speed_m_s,displacement_m,pressure_top_Pa\n");
        for travel in [0.0, 1e-5, 2e-5, 1e-5] {
            let _ = writeln!(text, "{},0,{speed},{travel},{peak}", travel / speed);
        }
        text
    };
    let run = folder.labelled("a", flat(1e6, 1.0));
    let mut fine = folder.labelled("fine", flat(1.2e6, 2.0));
    let unknown = Closing::read(from_ref(&run), from_ref(&fine), None, "");
    assert!(matches!(unknown, Err(Error::Request(said)) if said.contains("the label of no run")));
    fine.label = "a".into();
    let drawing = Closing::read(&[run], &[fine], None, "").unwrap().draw();
    let ([width, _], pixels) = pixels(&drawing);
    let column = |row: usize| pixels[row * width as usize + width as usize / 2 + 30];
    let [r, g, b] = BLUE.map(u32::from);
    // A quarter of the blue over white, which no line has.
    let faded = [r, g, b].map(|c| (c + 3 * 255) / 4);
    let near = |row: &usize| {
        let found = column(*row).map(u32::from);
        found
            .iter()
            .zip(faded)
            .all(|(f, wanted)| f.abs_diff(wanted) <= 2)
    };
    let band: Vec<usize> = (60..680).filter(near).collect();
    let line: Vec<usize> = (60..680).filter(|row| column(*row) == BLUE).collect();
    let (top, bottom, line) = (band[0], band[band.len() - 1], line[line.len() / 2]);
    println!("rows: band {top} to {bottom}, line {line}");
    // The line stands at 1.0, the band from there to 1.6, of an axis to 1.12 times that in 600 rows.
    let height = (line - top) as f64 / 600.0 * 1.12 * 1.6;
    assert!(line - bottom < 8 && (height - 0.6).abs() < 0.01, "{height}");
}

#[test]
fn gaps_and_single_rows_are_drawn_and_nothing_else() {
    let folder = Folder::new();
    let header = "time_s,closing_speed_m_s,pressure_bottom_Pa,pressure_top_Pa\n";
    let one = folder.labelled("one", format!("{header}1e-6,1,1e6,1e6\n"));
    let (_, dot) = pixels(&Closing::read(&[one], &[], None, "").unwrap().draw());
    let blue = share(&dot, BLUE);
    println!("one row: {blue:.6} of the picture is its mark and legend");
    assert!(blue > 1e-4 && blue < 3e-3);
    let gap = format!("{header}0,1,1e6,1e6\n1e-6,1,NaN,NaN\n2e-6,1,,\n3e-6,1,1e6,1e6\n");
    let gap = Closing::read(&[folder.labelled("gap", gap)], &[], None, "")
        .unwrap()
        .draw();
    let ([width, _], with_gap) = pixels(&gap);
    // The pressure of 1 MPa is shown at both ends and not bridged in the middle.
    let middle = width as usize / 2 + 30;
    let column = (120..680).map(|row| with_gap[row * width as usize + middle]);
    assert!(column.into_iter().all(|pixel| pixel != BLUE));
    let all_nan = folder.labelled("nan", format!("{header}0,1,NaN,NaN\n"));
    assert!(matches!(
        Closing::read(&[all_nan], &[], None, ""),
        Err(Error::Data(_))
    ));
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
        "maximum",
        "5 to 95 %",
        "10⁵",
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

/// What stands beside the result asked for is left out where no run has it.
#[test]
fn a_sweep_without_pressures_has_a_response() {
    let folder = Folder::new();
    let rows = |pressure: &str| {
        format!("row,mu,status,wp_um,pressure_pa\n1,1,sound,10,{pressure}\n2,2,sound,12,\n")
    };
    let panels = |pressure| {
        let sweep = folder.labelled("sweep", rows(pressure));
        let drawing = Response::read(&sweep, "wp_um", None).unwrap().draw();
        drawing.to_svg().unwrap().matches("(MPa)").count()
    };
    assert_eq!((panels(""), panels("1e5")), (0, 1));
}
