//! Bonds of undamaged wood, against results counted by hand.

use bondline::{Bond, Error, Layup, Pieces, PlacedVoxels, lay_up};
use particle_file::BitGrid;
use units::Axis;

use crate::{VOXEL, near, opening, placed, refused};

fn layup() -> Layup {
    Layup {
        opening: opening(Axis::Y),
        slab_m: 4.0 * VOXEL,
        quarters: 0,
        crop: false,
        drop_islands: false,
    }
}

fn two(bottom: &BitGrid, top: &BitGrid, layup: &Layup) -> Result<Bond, Error> {
    let (bottom, top) = (placed(bottom), placed(top));
    lay_up(&Pieces::Two { bottom, top }, layup)
}

/// Pieces of 20 layers with grooves along z, and with air above the bottom piece and below the top one.
fn grooved(air_above: bool) -> BitGrid {
    BitGrid::from_fn([16, 20, 12], |x, y, _| {
        let inside = if air_above { y < 17 } else { y >= 3 };
        inside && x % 4 != 1
    })
}

#[test]
fn two_pieces_lie_apart_by_the_slab_and_close_where_they_touch() {
    let (bottom, top) = (grooved(true), grooved(false));
    let bond = two(&bottom, &top, &layup()).unwrap();
    assert_eq!((bond.slab_cells, bond.adhesive_out), (2, 4 * 16 * 12));
    assert!(near(bond.plane_m, 17.0 * VOXEL) && near(bond.gap_m, 4.0 * VOXEL));
    assert_eq!(bond.bottom.bits.dims(), [16, 17, 12], "without its air");
    assert_eq!(bond.top.bits.dims(), [16, 17, 12]);
    assert!(near(bond.slab.origin_m[1], 17.0 * VOXEL));
    assert!(near(bond.top.origin_m[1], 21.0 * VOXEL));
    assert!(near(bond.box_max_m[1], 38.0 * VOXEL));
    assert_eq!(bond.bottom.bits.count(), bottom.count());
    assert_eq!(bond.top.bits.count(), top.count());
    assert_eq!(bond.severed, 12 * 12);
    let [low, high] = bond.faces.unwrap();
    assert_eq!((low.level, low.mean, low.covered), (0, 0.0, 0.75));
    assert_eq!(low, high);
}

/// The ribs of the top piece fit between those of the bottom one, so the pieces close by the height of the ribs.
#[test]
fn faces_that_fit_into_one_another_close_further() {
    let ribs = |odd: usize, solid: std::ops::Range<usize>, hollow: std::ops::Range<usize>| {
        BitGrid::from_fn([16, 10, 4], move |x, y, z| {
            (solid.contains(&y) || x / 2 % 2 == odd) && (x, z) != (15, 3) && !hollow.contains(&y)
        })
    };
    let (bottom, top) = (ribs(0, 0..7, 2..4), ribs(1, 3..10, 6..8));
    let bond = two(&bottom, &top, &layup()).unwrap();
    // The top piece rests at layer 7, 10 less 3 of ribs; the gap is 3 + 4.
    assert!(near(bond.gap_m, 7.0 * VOXEL));
    assert!(near(bond.slab.origin_m[1], 10.0 * VOXEL));
    assert!(near(bond.top.origin_m[1], 14.0 * VOXEL));
    assert!(near(bond.top.origin_m[1] - bond.gap_m, 7.0 * VOXEL));
    assert_eq!(bond.severed, 63);
    let mut tighter = layup();
    tighter.opening.gap_m = Some(6.5 * VOXEL);
    refused(two(&bottom, &top, &tighter), "leaves no room");
}

#[test]
fn a_cut_piece_keeps_every_voxel_and_comes_back_to_its_place() {
    let wood = BitGrid::from_fn([16, 40, 12], |x, y, z| (x + y * 3 + z * 5) % 7 < 4);
    let cut = Pieces::Cut(placed(&wood), 19.2 * VOXEL);
    let bond = lay_up(&cut, &layup()).unwrap();
    assert!(near(bond.plane_m, 19.0 * VOXEL));
    let kept = bond.bottom.bits.count() + bond.top.bits.count();
    assert_eq!(kept, wood.count());
    assert!(near(bond.top.origin_m[1] - bond.gap_m, 19.0 * VOXEL));
    for outside in [0.0, 40.0, 80.0, f64::NAN] {
        let cut = Pieces::Cut(placed(&wood), outside * VOXEL);
        refused(lay_up(&cut, &layup()), "is outside the specimen");
    }
}

/// A turn is a rotation: about y, z goes to x and x to -z.
#[test]
fn turning_moves_each_voxel_where_a_right_handed_turn_takes_it() {
    let bottom = BitGrid::from_fn([8, 4, 8], |x, _, _| x % 2 == 0);
    let all_but = |x, z| BitGrid::from_fn([8, 4, 8], move |i, _, k| (i, k) != (x, z));
    for (quarters, (x, z)) in [(0, (1, 2)), (1, (2, 6)), (2, (6, 5)), (3, (5, 1))] {
        let layup = Layup {
            quarters,
            slab_m: 2.0 * VOXEL,
            ..layup()
        };
        let bond = two(&bottom, &all_but(1, 2), &layup).unwrap();
        assert_eq!(bond.top.bits, all_but(x, z), "{quarters}");
    }
    // Four quarter turns about any axis change nothing.
    for normal in Axis::ALL {
        let top = BitGrid::from_fn([6, 6, 6], |x, y, z| (x + 2 * y + 3 * z) % 5 < 3);
        let bottom = BitGrid::from_fn([6, 6, 6], |x, y, z| (x * y + z) % 3 < 2);
        let whole = Layup {
            opening: opening(normal),
            quarters: 4,
            slab_m: 2.0 * VOXEL,
            ..layup()
        };
        let turned = two(&bottom, &top, &whole).unwrap().top.bits;
        assert_eq!(turned, top, "{normal}");
    }
}

#[test]
fn unequal_widths_are_refused_or_cropped() {
    let bottom = BitGrid::from_fn([16, 12, 8], |x, _, _| x % 2 == 0);
    let top = bottom.clone();
    assert!(two(&bottom, &top, &layup()).is_ok());
    let plywood = Layup {
        quarters: 1,
        ..layup()
    };
    let said = "8 x 16 voxels wide along z and x and the top piece, as it lies, 16 x 8";
    refused(two(&bottom, &top, &plywood), said);
    let cropped = Layup {
        crop: true,
        ..plywood
    };
    let bond = two(&bottom, &top, &cropped).unwrap();
    assert_eq!(bond.bottom.bits.dims(), [8, 12, 8]);
    assert_eq!(bond.top.bits.dims(), [8, 12, 8]);
}

#[test]
fn islands_hold_the_pieces_apart_unless_they_are_left_out() {
    let (mut bottom, top) = (grooved(true), grooved(false));
    bottom.set(6, 19, 5, true);
    let bond = two(&bottom, &top, &layup()).unwrap();
    assert_eq!(bond.faces.unwrap()[0].islands, 1);
    assert!(near(bond.gap_m, 4.0 * VOXEL) && bond.severed == 1);
    assert!(near(bond.top.origin_m[1] - bond.gap_m, 20.0 * VOXEL));
    let clean = Layup {
        drop_islands: true,
        ..layup()
    };
    let bond = two(&bottom, &top, &clean).unwrap();
    assert_eq!(bond.faces.unwrap()[0].islands, 0);
    assert!(near(bond.top.origin_m[1] - bond.gap_m, 17.0 * VOXEL));
}

#[test]
fn pieces_that_do_not_fit_are_refused() {
    let (bottom, top) = (grooved(true), grooved(false));
    let with = |slab: f64| {
        let slab_m = slab * VOXEL;
        two(&bottom, &top, &Layup { slab_m, ..layup() })
    };
    // Grooves hold a quarter of 17 layers on each side.
    assert!(with(8.0).is_ok());
    refused(with(10.0), "could never close");
    refused(with(1e30), "could never close");
    refused(with(0.0), "rounding to 0");
    refused(with(0.4), "rounding to 0");
    let solid = BitGrid::from_fn([16, 20, 12], |_, _, _| true);
    refused(two(&solid, &solid, &layup()), "could never close");
    let empty = BitGrid::new([16, 20, 12]);
    refused(
        two(&bottom, &empty, &layup()),
        "the top piece holds no wood",
    );
    let coarser = Pieces::Two {
        bottom: placed(&bottom),
        top: PlacedVoxels {
            voxel_m: 1.01 * VOXEL,
            ..placed(&top)
        },
    };
    refused(lay_up(&coarser, &layup()), "scale one stack");
    // Ribs that pass one another without contact.
    let left = BitGrid::from_fn([4, 9, 4], |x, _, _| x < 2);
    let right = BitGrid::from_fn([4, 9, 4], |x, _, _| x >= 2);
    refused(two(&left, &right, &layup()), "nowhere along the normal");
    // A piece may be a single layer of voxels.
    let sheet = BitGrid::from_fn([16, 1, 12], |x, _, _| x % 4 != 1);
    assert!(two(&sheet, &bottom, &layup()).is_ok());
}
