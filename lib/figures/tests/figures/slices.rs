//! Slices of a specimen.

use figures::{Cut, Error, Position, Slices};
use particle_file::{BitGrid, Block, Draft, Header, Kind, Material};
use units::Axis;

use crate::{Folder, pixels, texts};

/// A bond of 40 x 60 x 20 voxels: wood in the lowest and highest thirds, adhesive in a slab
/// of 6 voxels at y = 27.
pub(crate) fn bond() -> Vec<u8> {
    layers(Kind::Bond)
}

/// The same layers as a file of a kind.
pub(crate) fn layers(kind: Kind) -> Vec<u8> {
    let voxel = 1e-6;
    let edges = [40e-6, 60e-6, 20e-6];
    let header = Header::new(kind, voxel, 1, [0.0; 3], edges);
    let wood = BitGrid::from_fn([40, 60, 20], |_, y, _| !(20..40).contains(&y));
    let slab = BitGrid::from_fn([40, 6, 20], |_, _, _| true);
    let origin = [0.0, 27e-6, 0.0];
    let blocks = [
        (
            Block::new("wood-bottom", Material::Rigid, [0.0; 3], voxel, &wood),
            &wood,
        ),
        (
            Block::new("adhesive", Material::Adhesive, origin, voxel, &slab),
            &slab,
        ),
    ];
    let mut bytes = Vec::new();
    let draft = blocks
        .into_iter()
        .fold(Draft::new(header), |d, (block, bits)| d.block(block, bits));
    draft.write_to(&mut bytes).unwrap();
    bytes
}

#[test]
fn slices_show_each_phase_by_its_area() {
    let folder = Folder::new();
    let state = folder.labelled("bond", bond());
    let cut = |axis, position| Cut { axis, position };
    let read = |cut| Slices::read(std::slice::from_ref(&state), cut, figures::Colouring::Plain);
    let areas = |cut| {
        let (_, pixels) = pixels(&read(cut).unwrap().draw());
        let count = |c| pixels.iter().filter(|p| **p == c).count() as f64;
        // Less the patch of the key, of 20 x 12 logical pixels within its edge.
        [[150, 150, 150], [230, 159, 0]].map(|c| count(c) - 42.0 * 26.0)
    };
    let [wood, adhesive] = areas(cut(Axis::Z, Position::Share(0.5)));
    println!(
        "wood over adhesive: {:.3} (40 rows over 6)",
        wood / adhesive
    );
    assert!((wood / adhesive - 40.0 / 6.0).abs() < 0.1);
    let [wood, adhesive] = areas(cut(Axis::Y, Position::At(30e-6)));
    // Some of the smoothed text is grey too.
    println!("slice in the slab: wood {wood}, adhesive {adhesive} pixels");
    assert!(wood < 1e-3 * adhesive && adhesive > 1e4);
    let said = texts(&read(cut(Axis::X, Position::At(10e-6))).unwrap().draw());
    for text in [
        "x\u{a0}=\u{a0}10.0\u{a0}µm",
        "z (µm)",
        "y, across the bond (µm)",
        "wood",
        "void",
    ] {
        assert!(said.iter().any(|t| t == text), "{text} is not in {said:?}");
    }
    let beside = read(cut(Axis::Z, Position::At(1e-3))).unwrap_err();
    assert!(matches!(beside, Error::Request(_)), "{beside}");
    let nothing = folder.labelled("foreign", "not a particle file");
    let middle = cut(Axis::Z, Position::Share(0.5));
    let foreign = Slices::read(&[nothing], middle, figures::Colouring::Plain).unwrap_err();
    assert!(matches!(foreign, Error::Data(_)), "{foreign}");
}

/// Lines of a grid of 5 um over voxels of 1 um, and a part of 10 x 12 of them.
#[test]
fn a_part_is_cut_to_voxels_and_the_grid_begins_at_the_box() {
    let folder = Folder::new();
    let state = folder.labelled("bond", bond());
    let cut = Cut {
        axis: Axis::Z,
        position: Position::Share(0.5),
    };
    let slices = Slices::read(&[state], cut, figures::Colouring::Plain).unwrap();
    assert!(slices.clone().grid(1e-8).is_err());
    let beside = [[50e-6, 60e-6], [0.0, 1e-6]];
    assert!(matches!(
        slices.clone().part(beside),
        Err(Error::Request(_))
    ));
    // Wood up to y = 20, the slab from 27: 10 rows of wood, 7 of void, 3 of adhesive.
    let part = slices.part([[3e-6, 13e-6], [10e-6, 30e-6]]).unwrap();
    let (_, found) = pixels(&part.clone().draw());
    let count = |c| found.iter().filter(|p| **p == c).count() as f64 - 42.0 * 26.0;
    let ratio = count([150, 150, 150]) / count([230, 159, 0]);
    println!("wood over adhesive {ratio:.3} (10 rows over 3)");
    assert!((ratio - 10.0 / 3.0).abs() < 0.05);
    let svg = part.grid(5e-6).unwrap().draw().to_svg().unwrap();
    let document = roxmltree::Document::parse(&svg).unwrap();
    let lines = document
        .descendants()
        .filter(|n| n.attribute("stroke") == Some("#003C8C"));
    // x = 5 and 10, y = 10 to 30 by 5, and a cell of the key.
    assert_eq!(lines.count(), 2 + 5 + 7);
}
