//! Every text of every figure lies on the canvas and overlaps no other, whatever the names, the
//! number of panels and the width of the page.

use std::fmt::Write as _;

use figures::{
    Case, Closing, Clouds, Colouring, Cut, Direction, Drawing, Mark, Page, Plot, Position, Setup,
    ShearRates, Slices, Table2, Views, Wood, WpMap,
};
use particle_file::Kind;
use units::Axis;

use crate::Folder;
use crate::slices::{bond, layers};

const LONG: &str =
    "phenol formaldehyde of a very long name, partial slip with an influence length, XPIC(5)";
const WORD: &str = "a_folder_name_without_any_blank_in_it_that_no_line_of_a_figure_has_room_for";

/// Names as they come: short, of many words, of one word; so many of them.
fn names(count: usize) -> Vec<String> {
    let name = |i| match i % 3 {
        0 => format!("{i} {LONG}"),
        1 => format!("PF{i}"),
        _ => format!("{WORD}{i}"),
    };
    (0..count).map(name).collect()
}

/// No page, one column of a journal, a narrow one, a poster.
const WIDTHS: [Option<f64>; 4] = [None, Some(84.0), Some(Page::NARROWEST), Some(400.0)];

fn page(width_mm: Option<f64>) -> Page {
    Page {
        width_mm,
        ..Page::default()
    }
}

/// What is wrong with the texts of a drawing.
fn faults(drawing: &Drawing, what: &str) -> Vec<String> {
    let [width, height] = drawing.size();
    let boxes = drawing.text_boxes();
    assert!(!boxes.is_empty());
    let mut faults = Vec::new();
    for (i, one) in boxes.iter().enumerate() {
        let [left, top, right, bottom] = one.edges;
        if left < 0.0 || top < 0.0 || right > width || bottom > height {
            let edges = one.edges.map(f64::round);
            faults.push(format!(
                "{what}: '{}' at {edges:?} is not on {width} x {height}",
                one.text
            ));
        }
        for other in &boxes[i + 1..] {
            let apart = left >= other.edges[2]
                || other.edges[0] >= right
                || top >= other.edges[3]
                || other.edges[1] >= bottom;
            if !apart {
                faults.push(format!("{what}: '{}' lies on '{}'", one.text, other.text));
            }
        }
    }
    faults
}

/// Draws on every page and for one, two, three and six names.
fn check(kind: &str, draw: impl Fn(&[String], Page) -> Drawing) {
    let mut all = Vec::new();
    for count in [1, 2, 3, 6] {
        for width in WIDTHS {
            let drawing = draw(&names(count), page(width));
            if let Some(mm) = width {
                let found = drawing.size()[0] * 25.4 / 120.0;
                assert!((found - mm).abs() < 1e-9, "{kind}: {found} mm, not {mm}");
            }
            all.extend(faults(
                &drawing,
                &format!("{kind}, {count} names, {width:?}"),
            ));
        }
    }
    assert!(all.is_empty(), "{} faults:\n{}", all.len(), all.join("\n"));
}

fn labelled(folder: &Folder, names: &[String], content: &[u8]) -> Vec<figures::Labelled> {
    let one = |name: &String| folder.labelled(name, content);
    names.iter().map(one).collect()
}

#[test]
fn of_closing() {
    let folder = Folder::new();
    for (peak, limit) in [(2.4e6, Some(2.5e6)), (3.7e-3, None), (8e9, Some(8.9e9))] {
        let mut text = String::from("time_s,closing_speed_m_s,pressure_top_Pa\n");
        for i in 0..50 {
            let _ = writeln!(
                text,
                "{},1,{}",
                f64::from(i) * 1e-6,
                peak * f64::from(i) / 50.0
            );
        }
        check("closing", |names, page| {
            let runs = labelled(&folder, names, text.as_bytes());
            let figure = Closing::read(&runs, &[], limit, LONG).unwrap();
            figure.on(page).draw()
        });
    }
}

#[test]
fn of_shear_rates() {
    let folder = Folder::new();
    for most in [9.0, 4e5, 7e11] {
        let mut text = String::from("time_s,q05,q10,q25,q50,q75,q90,q95,max\n");
        for i in 0..20 {
            let q = most * f64::from(i) / 1e3;
            let _ = writeln!(
                text,
                "{},{q},{q},{q},{q},{q},{q},{q},{q}",
                f64::from(i) * 1e-3
            );
        }
        check("shear rates", |names, page| {
            let runs = labelled(&folder, names, text.as_bytes());
            ShearRates::read(&runs).unwrap().on(page).draw()
        });
    }
}

#[test]
fn of_maps() {
    let folder = Folder::new();
    for [columns, rows] in [[20, 30], [90, 9], [9, 90]] {
        let mut text = String::from("x_um,z_um,wp_um,volume_um3\n");
        for i in 0..columns * rows {
            let (x, z) = (i % columns, i / columns);
            let _ = writeln!(
                text,
                "{},{},{},{}",
                1.45 * x as f64,
                1.45 * z as f64,
                x * z,
                i % 7
            );
        }
        check("maps", |names, page| {
            let maps = labelled(&folder, names, text.as_bytes());
            WpMap::read(&maps).unwrap().on(page).draw()
        });
    }
}

#[test]
fn of_slices() {
    let folder = Folder::new();
    for axis in [Axis::X, Axis::Y, Axis::Z] {
        check("slices", |names, page| {
            let states = labelled(&folder, names, &bond());
            let cut = Cut {
                axis,
                position: Position::Share(0.5),
            };
            let slices = Slices::read(&states, cut, Colouring::Plain).unwrap();
            slices.on(page).draw()
        });
    }
    check("slices with a grid", |names, page| {
        let states = labelled(&folder, names, &bond());
        let cut = Cut {
            axis: Axis::Z,
            position: Position::Share(0.5),
        };
        let slices = Slices::read(&states, cut, Colouring::Plain).unwrap();
        let part = slices.part([[0.0, 9e-6], [20.4e-6, 31e-6]]).unwrap();
        part.grid(2e-6).unwrap().on(page).draw()
    });
}

#[test]
fn of_setups_and_tables() {
    let folder = Folder::new();
    let bond = folder.labelled("bond", bond());
    let specimen = folder.labelled("specimen", layers(Kind::Specimen));
    check("setup", |_, page| {
        let dpi = Page::DPI[0];
        let page = Page { dpi, ..page };
        let drawing = Setup::read(&specimen, &bond).unwrap().on(page).draw();
        let whole = page.width_mm.is_none_or(|mm| mm >= 84.0);
        let boxes = drawing.text_boxes();
        let cut = boxes.iter().find(|one| whole && one.text.contains('…'));
        assert!(cut.is_none(), "{:?} on {page:?}", cut.map(|one| &one.text));
        drawing
    });
    let refused = Setup::read(&bond, &bond).err().unwrap().to_string();
    let said = "holds a bond before pressing, where a specimen is needed";
    assert!(refused.contains(said), "{refused}");
    let wp = folder.file(
        "wp.csv",
        "file,side,reference,wp_um,slab_wp_um\na,bottom,mid,1,2\na,top,mid,111.1,2\na,total,mid,,2\n",
    );
    check("table", |names, page| {
        let case = |name: &String| Case {
            adhesive: names[0].clone(),
            name: name.clone(),
            path: wp.clone(),
        };
        let known = ["xpic", "flip"].map(|name| Case {
            adhesive: "pf".into(),
            ..case(&name.to_owned())
        });
        let cases: Vec<Case> = names.iter().map(case).chain(known).collect();
        let called = [("pf".to_owned(), WORD.to_owned())].into();
        Table2::read(&cases).unwrap().draw(&called, page)
    });
}

#[test]
fn of_views() {
    let folder = Folder::new();
    for [turn, tilt] in [[35.0, 25.0], [-60.0, 90.0]] {
        check("views", |names, page| {
            let states = labelled(&folder, names, &bond());
            let views = Views::read(&states, Wood::Cut, Direction { turn, tilt }).unwrap();
            let dpi = Page::DPI[0];
            views.on(Page { dpi, ..page }).draw()
        });
    }
}

#[test]
fn of_plots_and_clouds() {
    check("plot", |names, page| {
        let plot = Plot::new(LONG, WORD, LONG).logarithmic([true, false]);
        let curve = vec![[1e-3, -1e6], [1e9, 2e6]];
        let with = |plot: Plot, name: &String| plot.with(name, Mark::LineAndDots, curve.clone());
        names.iter().fold(plot.on(page), with).draw().unwrap()
    });
    check("clouds", |names, page| {
        let clouds = Clouds::new([LONG, LONG], LONG, [0.0, 1.0], 0.1).on(page);
        let spots = vec![([0.0, 0.0], 0.0), ([1.0, 2.0], 1.0)];
        let with = |clouds: Clouds, name: &String| clouds.with(name, spots.clone());
        names.iter().fold(clouds, with).draw().unwrap()
    });
}
