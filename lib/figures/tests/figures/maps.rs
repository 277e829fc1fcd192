//! Maps of penetration and clouds of points.

use figures::{Clouds, Page, wp_maps};

use crate::{Folder, csv, pixels, says, share};

const HEADER: &str = "x_um,z_um,wp_um,volume_um3";
/// Both ends of the colour scale, and places without data.
const ENDS: [[u8; 3]; 3] = [[68, 1, 84], [253, 231, 37], [208, 208, 208]];

fn map(value: impl Fn(usize) -> &'static str) -> String {
    let place = |i: usize| 1.45 * (i as f64 + 0.5);
    let cells = (0..30).flat_map(|z| (0..20).map(move |x| (x, z)));
    let row = |(x, z)| format!("{},{},{}", place(x), place(z), value(x));
    csv(HEADER, cells.map(row))
}

#[test]
fn maps_share_one_scale_and_show_holes() {
    let folder = Folder::new();
    let shallow = folder.labelled("shallow", map(|_| "0,10"));
    let deep = folder.labelled("deep", map(|x| if x < 10 { "30,10" } else { ",0" }));
    let drawing = wp_maps(&[shallow, deep], Page::default()).unwrap();
    says(&drawing, &["shallow", "deep", "x (µm)", "z (µm)"]);
    says(&drawing, &["weighted penetration (µm)", "no adhesive"]);
    let (_, pixels) = pixels(&drawing);
    let [lowest, highest, none] = ENDS.map(|c| share(&pixels, c));
    println!("lowest {lowest:.3}, highest {highest:.3}, none {none:.3}");
    // The shallow panel is twice the deep half, which equals its empty half.
    assert!((lowest / highest - 2.0).abs() < 0.05);
    assert!((highest / none - 1.0).abs() < 0.05);
}

#[test]
fn maps_off_any_grid_are_refused() {
    let folder = Folder::new();
    let rows = ["0,0,1,1", "1,0,1,1", "2.5,0,1,1"].map(String::from);
    let map = folder.labelled("a", csv(HEADER, rows));
    let said = wp_maps(&[map], Page::default()).unwrap_err().to_string();
    assert!(said.contains("grid"), "{said}");
}

#[test]
fn clouds_have_labels_and_colours_of_their_values() {
    let none = Clouds::new(["x", "y"], "v", [0.0, 1.0], 0.1);
    assert!(none.draw(Page::default()).is_err());
    let points = vec![([0.0, 0.0], 0.0), ([1.0, 2.0], 1.0)];
    let drawing = none.with("FLIP", points).draw(Page::default()).unwrap();
    says(&drawing, &["FLIP", "x", "y"]);
    let (_, pixels) = pixels(&drawing);
    // Both ends of the scale are there beside the colour bar's one line of each.
    assert!(ENDS[..2].iter().all(|end| share(&pixels, *end) > 1e-4));
}
