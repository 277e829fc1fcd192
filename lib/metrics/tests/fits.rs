//! The fitted plane of a bond, wherever the bond is.

mod specimens;

use metrics::{Datum, Reference, Side};
use specimens::{Stack, VOXEL};
use units::Axis;

/// A gap of six voxels that begins at layer `low` in half of the columns, one layer higher in the others.
fn stepped(low: usize, layers: usize) -> Stack {
    Stack::new([24, layers, 24], move |x, y, z| {
        let bottom = low + (x + z) % 2;
        match y {
            y if (bottom..bottom + 6).contains(&y) => 'a',
            _ if x % 4 == 3 => ' ',
            _ => 'w',
        }
    })
}

/// Widths of gaps as wide were told apart by their rounding, which took one half of the columns or the other.
#[test]
fn gaps_that_are_as_wide_count_alike_wherever_they_are() {
    for low in 15..40 {
        let stack = stepped(low, 60);
        let datum = Datum::find(Reference::Fit, &stack.state(Axis::Y)).unwrap();
        let layer = datum.plane_m(Side::Total) / VOXEL;
        assert!((layer - (low as f64 + 3.5)).abs() < 1e-6, "{low}: {layer}");
    }
}
