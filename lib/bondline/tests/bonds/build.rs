//! A bond from synthetic specimens whose answer is known, along each axis.

use bondline::{Bond, Error, Opening, PlacedVoxels, Specimen, build};
use particle_file::BitGrid;
use units::Axis;

use crate::{VOXEL, near, opening, placed, refused};

/// Material by layer along the normal: comb-shaped wood below 20 and from 31 on, adhesive in the gap and in the grooves of
/// the bottom comb down to 14, and a speck at 38.
fn material(layer: usize, u: usize) -> char {
    let groove = u % 4 == 1;
    match layer {
        0..20 if !groove => 'w',
        31.. if !groove => 'w',
        14..31 => 'a',
        38 if u == 5 => 'a',
        _ => ' ',
    }
}

struct Stack {
    wood: BitGrid,
    adhesive: BitGrid,
}

impl Stack {
    /// 50 layers along `normal`; `u` of [`material`] is the first of the other two axes.
    fn new(normal: Axis, lateral: [usize; 2]) -> Self {
        let n = normal.index();
        let across: Vec<usize> = (0..3).filter(|&a| a != n).collect();
        let mut dims = [50; 3];
        (dims[across[0]], dims[across[1]]) = (lateral[0], lateral[1]);
        let grid = |wanted: char| {
            BitGrid::from_fn(dims, |x, y, z| {
                let index = [x, y, z];
                material(index[n], index[across[0]]) == wanted
            })
        };
        Self {
            wood: grid('w'),
            adhesive: grid('a'),
        }
    }

    fn build(&self, opening: &Opening) -> Result<Bond, Error> {
        self.cut(None, opening)
    }

    /// Builds the bond with the wood split this many voxels above its low face.
    fn cut(&self, layers: Option<f64>, opening: &Opening) -> Result<Bond, Error> {
        let specimen = Specimen::new(placed(&self.wood), placed(&self.adhesive))?;
        build(&specimen, layers.map(|n| n * VOXEL), opening)
    }

    #[track_caller]
    fn refuses(&self, opening: &Opening, said: &str) {
        refused(self.build(opening), said);
    }
}

#[test]
fn every_axis_gives_the_same_bond() {
    for normal in Axis::ALL {
        let stack = Stack::new(normal, [80, 12]);
        let bond = stack.build(&opening(normal)).unwrap();
        let n = normal.index();
        // Midway between the faces at 20 and 31 is 25.5, rounded down to a face.
        assert!(near(bond.plane_m, 25.0 * VOXEL), "{normal}");
        // 11 full layers, 6 layers of a quarter and a speck of 12 voxels: 12.5125 voxels,
        // hence 6 cells.
        assert_eq!(bond.adhesive_in, 12_012.0);
        assert_eq!((bond.slab_cells, bond.adhesive_out), (6, 80 * 12 * 12));
        assert!((bond.rounding() - (12.0 / 12.5125 - 1.0)).abs() < 1e-12);
        assert!(near(bond.gap_m, 12.0 * VOXEL));
        // The adherends keep every voxel and return to their place when closed by the gap.
        let (bottom, top) = (bond.bottom.bits.count(), bond.top.bits.count());
        assert_eq!((bottom, bottom + top), (20 * 60 * 12, stack.wood.count()));
        assert!(near(bond.top.origin_m[n] - bond.gap_m, bond.plane_m));
        assert_eq!(bond.top.bits.dims()[n], 25);
        // The full slab lies between plane and moved adherend, on cell faces of the box, which begins 13 cells below.
        assert!(near(bond.slab.origin_m[n], bond.plane_m));
        assert_eq!(bond.slab.bits.count(), bond.adhesive_out);
        let cells = (bond.slab.origin_m[n] - bond.box_min_m[n]) / bond.cell_m;
        assert!((cells - 13.0).abs() < 1e-9, "{cells}");
        assert!(near(bond.box_max_m[n], 62.0 * VOXEL));
        assert_eq!(bond.severed, 0);
    }
}

#[test]
fn odd_widths_are_trimmed_to_whole_cells_and_counted_again() {
    let bond = |lateral| {
        Stack::new(Axis::Y, lateral)
            .build(&opening(Axis::Y))
            .unwrap()
    };
    let odd = bond([81, 13]);
    assert_eq!((odd.trimmed, odd.adhesive_in), ([1, 0, 1], 12_012.0));
    assert_eq!(odd.bottom.bits.dims(), [80, 25, 12]);
    assert!(near(odd.box_max_m[0], 80.0 * VOXEL));
    // One layer deep, as in plane strain, is kept.
    let plane_strain = bond([80, 1]);
    assert_eq!(plane_strain.trimmed, [0; 3]);
    assert_eq!(plane_strain.slab.bits.dims(), [80, 12, 1]);
}

#[test]
fn a_plane_through_the_wood_severs_it_and_says_so() {
    let stack = Stack::new(Axis::Y, [80, 12]);
    let at = |layers: f64| stack.cut(Some(layers), &opening(Axis::Y));
    let bond = at(10.2).unwrap();
    assert!(near(bond.plane_m, 10.0 * VOXEL));
    assert_eq!(bond.severed, 60 * 12);
    let doubt = bondline::severed_doubt(bond.severed, bond.area).unwrap();
    assert!(doubt.contains("75.0 % of the bond area"), "{doubt}");
    let sound = stack.build(&opening(Axis::Y)).unwrap();
    assert_eq!(bondline::severed_doubt(sound.severed, sound.area), None);
    let wood = bond.bottom.bits.count() + bond.top.bits.count();
    assert_eq!(wood, stack.wood.count());
    for outside in [50.0, f64::NAN] {
        refused(at(outside), "is outside the specimen");
    }
}

/// Across the other axis, adhesive covers up to 34 % of a layer more than wood, in the grooves.
#[test]
fn a_bond_across_another_axis_is_refused_by_its_name() {
    for across in Axis::ALL {
        let stack = Stack::new(across, [80, 12]);
        for normal in Axis::ALL.into_iter().filter(|axis| *axis != across) {
            let said = format!("lies across {across}, not across {normal}");
            stack.refuses(&opening(normal), &said);
        }
        let by_hand = Opening {
            tolerance: 1.0,
            ..opening(Axis::ALL[(across.index() + 1) % 3])
        };
        assert!(stack.cut(Some(7.0), &by_hand).is_ok());
    }
}

/// Faces that touch leave little adhesive in any layer: as long as no other axis is plainly better, that is the bond.
#[test]
fn a_starved_bond_is_found_all_the_same() {
    // `open`: whether layer 20 has less wood and more adhesive than the others.
    let stack = |open: bool| {
        let letter = move |x: usize, y: usize, z: usize| match (y, (x + z) % 4) {
            (20, 1) if open => 'a',
            (_, 0 | 1) => 'w',
            (17..=23, _) => 'a',
            _ => ' ',
        };
        let grid = |wanted| BitGrid::from_fn([16, 41, 16], |x, y, z| letter(x, y, z) == wanted);
        Stack {
            wood: grid('w'),
            adhesive: grid('a'),
        }
    };
    let rough = Opening {
        tolerance: 1.0,
        ..opening(Axis::Y)
    };
    let found = stack(true).build(&rough).unwrap().found.unwrap();
    assert_eq!((found.seed, found.contrast), (20, 0.5));
    for normal in Axis::ALL {
        stack(false).refuses(&opening(normal), "looks like a bond line");
    }
}

#[test]
fn slabs_and_specimens_that_do_not_fit_are_refused() {
    let stack = Stack::new(Axis::Y, [80, 12]);
    let strict = Opening {
        tolerance: 0.01,
        ..opening(Axis::Y)
    };
    stack.refuses(&strict, "rounding to 6 changes its volume by -4.10 %");
    // The opening of 11 voxels leaves 1 voxel to make for the slab of 12.
    let gap = |voxels: f64| Opening {
        gap_m: Some(voxels * VOXEL),
        ..opening(Axis::Y)
    };
    stack.refuses(&gap(0.5), "leaves no room");
    let tight = stack.build(&gap(1.0)).unwrap();
    assert!(near(tight.slab.origin_m[1], 20.0 * VOXEL));
    let (wood, adhesive) = (stack.wood, BitGrid::new([80, 50, 12]));
    Stack { wood, adhesive }.refuses(&opening(Axis::Y), "no adhesive voxel");
    let [a, b] = [BitGrid::new([2, 3, 4]), BitGrid::new([2, 3, 5])];
    let coarse = PlacedVoxels {
        voxel_m: 1.0,
        ..placed(&a)
    };
    assert!(Specimen::new(placed(&a), placed(&a)).is_ok());
    for other in [placed(&b), coarse] {
        let error = Specimen::new(placed(&a), other).unwrap_err();
        assert!(error.is_unfit_data(), "{error}");
    }
}
