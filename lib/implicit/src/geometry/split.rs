//! Splits the open voxels of a cell into connected sets, one a pore.

/// The sets of voxels of the mask `open` (x fastest, `k` voxels an edge) that are connected by voxel faces, each as a mask.
pub(super) fn connected(open: u8, k: usize) -> impl Iterator<Item = u8> {
    let mut left = open;
    std::iter::from_fn(move || {
        if left == 0 {
            return None;
        }
        let mut part = left & left.wrapping_neg();
        loop {
            let grown = part | (neighbours(part, k) & open);
            if grown == part {
                break;
            }
            part = grown;
        }
        left &= !part;
        Some(part)
    })
}

/// Mask of the voxels that share a face with one of `part`.
fn neighbours(part: u8, k: usize) -> u8 {
    if k == 1 {
        return part;
    }
    let mut beside = 0;
    for axis in 0..3 {
        let step = 1 << axis;
        // Voxels on the low side of the axis.
        let low = [0x55_u8, 0x33, 0x0f][axis];
        beside |= (part & low) << step | (part & !low) >> step;
    }
    beside
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_touch_by_faces_alone() {
        let parts = |open, k| connected(open, k).collect::<Vec<u8>>();
        assert_eq!(parts(1, 1), [1]);
        assert_eq!(parts(0xff, 2), [0xff]);
        // Opposite corners.
        assert_eq!(parts(0b1000_0001, 2), [1, 0b1000_0000]);
        // Two columns along z that share an edge.
        assert_eq!(parts(0b1001_1001, 2), [0b0001_0001, 0b1000_1000]);
        assert_eq!(parts(0, 2), [0_u8; 0]);
    }
}
