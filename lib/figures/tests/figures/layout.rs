//! Every text of every figure lies on the canvas and overlaps no other, whatever the names, the
//! number of panels and the width of the page.

use figures::{
    Case, Clouds, Colouring, Cut, Direction, Drawing, Labelled, Mark, Page, Plot, Position, Slices,
    Table2, Views, Wood, closing, setup, shear_rates, wp_maps,
};
use particle_file::Kind;
use units::Axis;

use crate::slices::layers;
use crate::{Folder, csv};

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
            let page = Page {
                width_mm: width,
                ..Page::default()
            };
            let drawing = draw(&names(count), page);
            if let Some(mm) = width {
                let found = drawing.size()[0] * 25.4 / 120.0;
                assert!((found - mm).abs() < 1e-9, "{kind}: {found} mm, not {mm}");
            }
            let what = format!("{kind}, {count} names, {width:?}");
            all.extend(faults(&drawing, &what));
        }
    }
    assert!(all.is_empty(), "{} faults:\n{}", all.len(), all.join("\n"));
}

fn labelled(folder: &Folder, names: &[String], content: impl AsRef<[u8]>) -> Vec<Labelled> {
    let one = |name: &String| folder.labelled(name, content.as_ref());
    names.iter().map(one).collect()
}

/// Pixels as few as can be: texts do not depend on them.
fn coarse(page: Page) -> Page {
    let dpi = Page::DPI[0];
    Page { dpi, ..page }
}

#[test]
fn of_closing() {
    let folder = Folder::new();
    for (peak, limit) in [(2.4e6, Some(2.5e6)), (3.7e-3, None), (8e9, Some(8.9e9))] {
        let row = |i: i32| format!("{}e-6,1,{}", i, peak * f64::from(i) / 50.0);
        let text = csv("time_s,closing_speed_m_s,pressure_top_Pa", (0..50).map(row));
        check("closing", |names, page| {
            let runs = labelled(&folder, names, &text);
            closing(&runs, &[], limit, LONG, page).unwrap()
        });
    }
}

#[test]
fn of_shear_rates() {
    let folder = Folder::new();
    for most in [9.0, 4e5, 7e11] {
        let row = |i: i32| {
            let q = most * f64::from(i) / 1e3;
            format!("{i}e-3,{q},{q},{q},{q},{q},{q},{q},{q}")
        };
        let text = csv("time_s,q05,q10,q25,q50,q75,q90,q95,max", (0..20).map(row));
        check("shear rates", |names, page| {
            shear_rates(&labelled(&folder, names, &text), page).unwrap()
        });
    }
}

/// The ticks of maps with longer numbers than the first have room too.
#[test]
fn of_maps() {
    let folder = Folder::new();
    for [columns, rows] in [[20, 30], [90, 9], [9, 90]] {
        let text = |origin: f64| {
            let row = |i: usize| {
                let (x, z) = (i % columns, i / columns);
                let [left, low] = [x, z].map(|i| origin + 1.45 * i as f64);
                format!("{left},{low},{},{}", x * z, i % 7)
            };
            csv("x_um,z_um,wp_um,volume_um3", (0..columns * rows).map(row))
        };
        check("maps", |names, page| {
            let mut maps = labelled(&folder, names, text(0.0));
            maps.push(folder.labelled("far", text(1e6)));
            wp_maps(&maps, page).unwrap()
        });
    }
}

#[test]
fn of_slices() {
    let folder = Folder::new();
    let slices = |names: &[String], axis| {
        let states = labelled(&folder, names, layers(Kind::Bond));
        let position = Position::Share(0.5);
        Slices::read(&states, Cut { axis, position }, Colouring::Plain).unwrap()
    };
    for axis in Axis::ALL {
        check("slices", |names, page| slices(names, axis).draw(page));
    }
    check("slices with a grid", |names, page| {
        let part = slices(names, Axis::Z).part([[0.0, 9e-6], [20.4e-6, 31e-6]]);
        part.unwrap().grid(2e-6).unwrap().draw(page)
    });
}

#[test]
fn setups_and_tables_have_no_overlapping_text() {
    let folder = Folder::new();
    let bond = folder.labelled("bond", layers(Kind::Bond));
    let specimen = folder.labelled("specimen", layers(Kind::Specimen));
    check("setup", |_, page| {
        let drawing = setup(&specimen, &bond, coarse(page)).unwrap();
        let whole = page.width_mm.is_none_or(|mm| mm >= 84.0);
        let boxes = drawing.text_boxes();
        let cut = boxes.iter().find(|one| whole && one.text.contains('…'));
        assert!(cut.is_none(), "{:?} on {page:?}", cut.map(|one| &one.text));
        drawing
    });
    let refused = setup(&bond, &bond, Page::default())
        .unwrap_err()
        .to_string();
    let said = "holds a bond before pressing, where a specimen is needed";
    assert!(refused.contains(said), "{refused}");
    let rows = ["a,bottom,mid,1,2", "a,top,mid,,2", "a,total,mid,111.1,2"].map(String::from);
    let wp = csv("file,side,reference,wp_um,slab_wp_um", rows);
    let wp = folder.file("wp.csv", wp);
    check("table", |names, page| {
        let case = |adhesive: &str, name: &str| Case {
            adhesive: adhesive.into(),
            name: name.into(),
            path: wp.clone(),
        };
        let known = ["xpic", "flip"].map(|name| case("pf", name));
        let cases = names.iter().map(|name| case(&names[0], name)).chain(known);
        let cases: Vec<Case> = cases.collect();
        let called = [("pf".to_owned(), WORD.to_owned())].into();
        Table2::read(&cases).unwrap().draw(&called, page)
    });
}

#[test]
fn of_views() {
    let folder = Folder::new();
    for [turn, tilt] in [[35.0, 25.0], [-60.0, 90.0]] {
        check("views", |names, page| {
            let states = labelled(&folder, names, layers(Kind::Bond));
            let views = Views::read(&states, Wood::Cut, Direction { turn, tilt });
            views.unwrap().draw(coarse(page))
        });
    }
}

#[test]
fn plots_and_clouds_have_no_overlapping_text() {
    check("plot", |names, page| {
        let plot = Plot::new(LONG, WORD, LONG).logarithmic([true, false]);
        let curve = vec![[1e-3, -1e6], [1e9, 2e6]];
        let with = |plot: Plot, name: &String| plot.with(name, Mark::LineAndDots, curve.clone());
        names.iter().fold(plot, with).draw(page).unwrap()
    });
    check("clouds", |names, page| {
        let mut clouds = Clouds::new([LONG, LONG], LONG, [0.0, 1.0], 0.1);
        for name in names {
            clouds = clouds.with(name, vec![([0.0, 0.0], 0.0), ([1.0, 2.0], 1.0)]);
        }
        clouds.draw(page).unwrap()
    });
}
