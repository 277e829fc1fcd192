//! Wood that a bond plane cuts through.

use particle_file::BitsRef;
use units::Axis;

use crate::placed::layers;

/// Fraction of the bond area above which a plane that cuts through wood is doubted. Planes cut no wood in 67 real and
/// synthetic bonds, and 13 % at most in synthetic bonds with rough touching faces, tilted by 17 degrees.
const MOST_SEVERED: f64 = 0.15;

/// Pairs of wood voxels that touch across the plane below layer `plane`; 0 at the ends of the wood.
pub fn severed(wood: BitsRef, normal: Axis, plane: usize) -> u64 {
    let n = normal.index();
    if !(1..wood.dims()[n]).contains(&plane) {
        return 0;
    }
    let [below, above] = [plane - 1, plane].map(|layer| layers(wood, n, layer..layer + 1));
    let pairs = below.words().iter().zip(above.words());
    pairs.map(|(a, b)| u64::from((a & b).count_ones())).sum()
}

/// A sentence if the plane cuts so many pairs, over `area` voxels, that it is hardly a bond plane.
pub fn severed_doubt(severed: u64, area: u64) -> Option<String> {
    let share = severed as f64 / area.max(1) as f64;
    (share > MOST_SEVERED).then(|| {
        format!(
            "the bond plane cuts through wood on {:.1} % of the bond area, where a bond has adhesive: check that the specimen is a bond, its labels, and the axis across the bond",
            100.0 * share
        )
    })
}
