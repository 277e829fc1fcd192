//! Sizes of pores against closed forms.

mod specimens;

use metrics::{PoreSize, pore_sizes};
use particle_file::BitGrid;
use specimens::{VOXEL, placed};

/// Pore sizes (voxels) in wood that is solid except where `open` holds.
fn sizes(dims: [usize; 3], open: impl Fn([usize; 3]) -> bool + Sync) -> Vec<PoreSize> {
    let wood = BitGrid::from_fn(dims, |x, y, z| !open([x, y, z]));
    let mut found = pore_sizes(placed(&wood), |_| ());
    found.iter_mut().for_each(|size| size.diameter_m /= VOXEL);
    found
}

fn mean(sizes: &[PoreSize]) -> f64 {
    sizes.iter().map(|size| size.share * size.diameter_m).sum()
}

/// The same, also checked with exchanged axes and mirrored.
fn alike(dims: [usize; 3], open: impl Fn([usize; 3]) -> bool + Sync) -> Vec<PoreSize> {
    let found = sizes(dims, &open);
    for turn in 1..3 {
        let turned = std::array::from_fn(|i| dims[(i + turn) % 3]);
        let back = |index: [usize; 3]| std::array::from_fn(|i| index[(i + 3 - turn) % 3]);
        assert_eq!(sizes(turned, |index| open(back(index))), found);
    }
    let mirror = |index: [usize; 3]| std::array::from_fn(|i| dims[i] - 1 - index[i]);
    assert_eq!(sizes(dims, |index| open(mirror(index))), found);
    let all: f64 = found.iter().map(|size| size.share).sum();
    assert!((all - 1.0).abs() < 1e-12 && found.last().unwrap().up_to == 1.0);
    found
}

#[test]
fn a_slit_is_as_wide_as_it_is() {
    for width in [1, 2, 3, 8, 13, 30, 61] {
        let found = alike([9, width + 7, 12], |[_, y, _]| (3..3 + width).contains(&y));
        let wide = found.last().unwrap();
        let off = wide.diameter_m - 0.5 - width as f64;
        // From twenty voxels on sizes are resolved to a fortieth.
        let step = (width as f64 - 20.0).max(0.0) / 40.0;
        assert!(off.abs() <= 1e-9 + 0.5 * step, "{width}: {off}");
        assert_eq!(wide.share, 1.0, "{width}");
    }
}

#[test]
fn a_round_tube_has_one_diameter() {
    let tubes = [
        (5.0, 0.0),
        (8.0, 0.2),
        (8.0, 0.5),
        (15.0, 0.3),
        (32.0, 0.25),
        (60.0, 0.2),
    ];
    for (diameter, shift) in tubes {
        let edge = diameter as usize + 6;
        let middle = 0.5 * edge as f64 + shift;
        let from_middle = |i: usize| i as f64 + 0.5 - middle;
        let found = alike([edge, edge, 5], |[x, y, _]| {
            from_middle(x).hypot(from_middle(y)) < 0.5 * diameter
        });
        let (mean, widest) = (mean(&found), found.last().unwrap().diameter_m);
        println!("tube of {diameter}: {mean:.2}, widest {widest:.2}");
        assert!((-1.1 - diameter / 80.0..0.5).contains(&(mean - diameter)));
    }
}

/// In a duct of edge a the largest ball does not fill the corners, (1 - pi/4) a^2; a smaller ball of diameter d leaves
/// (1 - pi/4) d^2.
#[test]
fn a_square_duct_has_small_corners() {
    for edge in [12_usize, 31] {
        let found = alike([edge + 5, edge + 4, 6], |[x, y, _]| {
            (2..2 + edge).contains(&x) && (2..2 + edge).contains(&y)
        });
        let widest = found.last().unwrap();
        let (wide, share) = (widest.diameter_m, widest.share);
        println!("duct of {edge}: {wide} for {share:.3}");
        assert!((wide - edge as f64).abs() <= 1.0);
        let corners = |d: f64| (1.0 - std::f64::consts::FRAC_PI_4) * (d / edge as f64).powi(2);
        for size in &found {
            // Half a voxel too many along four quarter circles takes off pi/2 d of the corners.
            let off = size.up_to - size.share - corners(size.diameter_m);
            assert!(off < 0.01 && off >= -1.6 / edge as f64, "{size:?}");
        }
    }
}

#[test]
fn wood_without_pores_has_no_pore_sizes() {
    assert!(sizes([4, 4, 4], |_| false).is_empty());
    assert!(sizes([4, 4, 4], |_| true).is_empty());
}
