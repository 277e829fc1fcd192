//! Slices of a specimen.

use std::slice::from_ref;

use figures::{Colouring, Cut, Drawing, Error, Page, Position, Slices};
use particle_file::{BitGrid, Block, Draft, Header, Kind, Material, ParticleFile};
use units::Axis;

use crate::{Folder, pixels, says};

/// 40 x 60 x 20 voxels as a file of a kind: wood in the lowest and highest thirds, adhesive in a slab
/// of 6 voxels at y = 27.
pub(crate) fn layers(kind: Kind) -> Vec<u8> {
    let voxel = 1e-6;
    let header = Header::new(kind, voxel, 1, [0.0; 3], [40e-6, 60e-6, 20e-6]);
    let wood = BitGrid::from_fn([40, 60, 20], |_, y, _| !(20..40).contains(&y));
    let slab = BitGrid::from_fn([40, 6, 20], |_, _, _| true);
    let bottom = Block::new("wood-bottom", Material::Rigid, [0.0; 3], voxel, &wood);
    let origin = [0.0, 27e-6, 0.0];
    let adhesive = Block::new("adhesive", Material::Adhesive, origin, voxel, &slab);
    let draft = Draft::new(header)
        .block(bottom, &wood)
        .block(adhesive, &slab);
    let mut bytes = Vec::new();
    draft.write_to(&mut bytes).unwrap();
    bytes
}

/// Pixels of wood over those of adhesive, less the patches of the key, of 20 x 12 logical pixels within their edges.
fn areas(drawing: &Drawing) -> [f64; 2] {
    let (_, pixels) = pixels(drawing);
    let count = |c| pixels.iter().filter(|p| **p == c).count() as f64;
    [[150, 150, 150], [230, 159, 0]].map(|c| count(c) - 42.0 * 26.0)
}

#[test]
fn slices_show_each_phase_by_its_area() {
    let folder = Folder::new();
    let state = folder.labelled("bond", layers(Kind::Bond));
    let read = |state, axis, position| {
        let cut = Cut { axis, position };
        Slices::read(from_ref(state), cut, Colouring::Plain)
    };
    let drawn = |axis, position| read(&state, axis, position).unwrap().draw(Page::default());
    let [wood, adhesive] = areas(&drawn(Axis::Z, Position::Share(0.5)));
    let ratio = wood / adhesive;
    println!("wood over adhesive: {ratio:.3} (40 rows over 6)");
    assert!((ratio - 40.0 / 6.0).abs() < 0.1);
    let [wood, adhesive] = areas(&drawn(Axis::Y, Position::At(30e-6)));
    // Some of the smoothed text is grey too.
    println!("slice in the slab: wood {wood}, adhesive {adhesive} pixels");
    assert!(wood < 1e-3 * adhesive && adhesive > 1e4);
    let across = drawn(Axis::X, Position::At(10e-6));
    says(&across, &["x\u{a0}=\u{a0}10.0\u{a0}µm", "wood", "void"]);
    says(&across, &["z (µm)", "y, across the bond (µm)"]);
    let beside = read(&state, Axis::Z, Position::At(1e-3));
    assert!(matches!(beside, Err(Error::Request(_))));
    let nothing = folder.labelled("foreign", "not a particle file");
    let foreign = read(&nothing, Axis::Z, Position::Share(0.5));
    assert!(matches!(foreign, Err(Error::Data(_))));
}

/// The slab's grey, a fifth of the way from the darkest to the brightest, has the place and size of its adhesive.
#[test]
fn grey_values_are_drawn_beside_their_phases() {
    let file = ParticleFile::from_bytes(&layers(Kind::Specimen)).unwrap();
    let grey = |i: usize| [1e4, 1.1e4, 1.5e4][(i % 60 / 27).min(1) + usize::from(i % 60 > 32)];
    let greys: Vec<f64> = (0..60 * 20).map(grey).collect();
    let (axis, position) = (Axis::X, Position::Share(0.5));
    let cut = (Cut { axis, position }, Some(&greys[..]));
    // A cut of one grey has the scale of the other.
    let slab = [1.1e4; 30 * 20];
    let within = (
        Cut {
            axis: Axis::Y,
            ..cut.0
        },
        Some(&slab[..]),
    );
    let drawn = |cuts: &[_]| {
        let slices = Slices::through(&file, "a", cuts).unwrap();
        slices.draw(Page::default())
    };
    says(
        &drawn(&[cut, within]),
        &["y\u{a0}=\u{a0}30.0\u{a0}µm, grey 10000 to 15000"],
    );
    let (width, pixels) = pixels(&drawn(&[cut]));
    // Smoothed text has a few such pixels, too.
    let rows = |colour| -> Vec<bool> {
        let row = |row: &[[u8; 3]]| row.iter().filter(|p| **p == colour).count() > 100;
        pixels.chunks(width).skip(80).map(row).collect()
    };
    let adhesive = rows([230, 159, 0]);
    assert!(adhesive.contains(&true) && rows([51; 3]) == adhesive);
}

/// Lines of a grid of 5 um over voxels of 1 um, and a part of 10 x 12 of them.
#[test]
fn a_part_is_cut_to_voxels_and_the_grid_begins_at_the_box() {
    let folder = Folder::new();
    let state = folder.labelled("bond", layers(Kind::Bond));
    let cut = Cut {
        axis: Axis::Z,
        position: Position::Share(0.5),
    };
    let slices = Slices::read(&[state], cut, Colouring::Plain).unwrap();
    assert!(slices.clone().grid(1e-8).is_err());
    let beside = slices.clone().part([[50e-6, 60e-6], [0.0, 1e-6]]);
    assert!(matches!(beside, Err(Error::Request(_))));
    // Wood up to y = 20, the slab from 27: 10 rows of wood, 7 of void, 3 of adhesive.
    let part = slices.part([[3e-6, 13e-6], [10e-6, 30e-6]]).unwrap();
    let [wood, adhesive] = areas(&part.draw(Page::default()));
    println!("wood over adhesive {:.3} (10 rows over 3)", wood / adhesive);
    assert!((wood / adhesive - 10.0 / 3.0).abs() < 0.05);
    let svg = part.grid(5e-6).unwrap().draw(Page::default()).to_svg();
    // x = 5 and 10, y = 10 to 30 by 5, and a cell of the key.
    let lines = svg.unwrap().matches("stroke=\"#003C8C\"").count();
    assert_eq!(lines, 2 + 5 + 7);
}
