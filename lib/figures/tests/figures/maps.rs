//! Maps of penetration and clouds of points.

use std::fmt::Write as _;

use figures::{Clouds, WpMap};

use crate::{Folder, pixels, share, texts};

fn map(value: impl Fn(usize, usize) -> String) -> String {
    let mut text = String::from("x_um,z_um,wp_um,volume_um3\n");
    for z in 0..30 {
        for x in 0..20 {
            let _ = writeln!(
                text,
                "{},{},{}",
                1.45 * (x as f64 + 0.5),
                1.45 * (z as f64 + 0.5),
                value(x, z)
            );
        }
    }
    text
}

#[test]
fn maps_share_one_scale_and_show_holes() {
    let folder = Folder::new();
    let shallow = folder.labelled("shallow", map(|_, _| "0,10".into()));
    let deep = folder.labelled(
        "deep",
        map(|x, _| if x < 10 { "30,10" } else { ",0" }.into()),
    );
    let drawing = WpMap::read(&[shallow, deep]).unwrap().draw();
    let said = texts(&drawing);
    for text in [
        "shallow",
        "deep",
        "x (µm)",
        "z (µm)",
        "weighted penetration (µm)",
        "no adhesive",
    ] {
        assert!(said.iter().any(|t| t == text), "{text} is not in {said:?}");
    }
    let (_, pixels) = pixels(&drawing);
    let ends = [[68, 1, 84], [253, 231, 37], [208, 208, 208]].map(|c| share(&pixels, c));
    println!(
        "lowest {:.3}, highest {:.3}, none {:.3}",
        ends[0], ends[1], ends[2]
    );
    // The shallow panel is twice the deep half, which equals its empty half.
    assert!((ends[0] / ends[1] - 2.0).abs() < 0.05);
    assert!((ends[1] / ends[2] - 1.0).abs() < 0.05);
}

#[test]
fn maps_off_any_grid_are_refused() {
    let folder = Folder::new();
    let text = "x_um,z_um,wp_um,volume_um3\n0,0,1,1\n1,0,1,1\n2.5,0,1,1\n";
    let said = WpMap::read(&[folder.labelled("a", text)])
        .unwrap_err()
        .to_string();
    assert!(said.contains("grid"), "{said}");
}

#[test]
fn clouds_have_labels_and_colours_of_their_values() {
    let points = vec![([0.0, 0.0], 0.0), ([1.0, 2.0], 1.0)];
    let clouds = Clouds::new(["x", "y"], "v", [0.0, 1.0], 0.1).with("FLIP", points);
    let drawing = clouds.draw().unwrap();
    assert!(
        ["FLIP", "x", "y"]
            .iter()
            .all(|name| texts(&drawing).iter().any(|t| t == name))
    );
    let (_, pixels) = pixels(&drawing);
    // Both ends of the scale are there beside the colour bar's one line of each.
    for end in [[68, 1, 84], [253, 231, 37]] {
        assert!(share(&pixels, end) > 1e-4);
    }
    assert!(
        Clouds::new(["x", "y"], "v", [0.0, 1.0], 0.1)
            .draw()
            .is_err()
    );
}
