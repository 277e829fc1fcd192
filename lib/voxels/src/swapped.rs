//! Whether two phases look exchanged.

use std::ops::Range;

use particle_file::{BitGrid, Material, ParticleFile};

use crate::lattice::pieces;
use crate::{Phase, Segmented};

const NAMES: [&str; 3] = ["x", "y", "z"];
/// Shares of an axis at which it is cut.
const CUTS: [f64; 3] = [0.25, 0.5, 0.75];
/// Fewest voxels of a piece in a cut: fewer are noise.
const PIECE: usize = 9;
/// Pieces of wood for each of void, and pieces of wood, from which the two look exchanged.
const TIMES: usize = 3;
const LEAST: usize = 20;
/// Least share of the pores of either outer quarter that adhesive fills where it and void look exchanged.
const FILLED: f64 = 0.95;
/// Fewest layers that are void by more than half there, as a bond line is adhesive: fewer may be a crack.
const LINE: usize = 6;
/// Least share of void beside them, as of adhesive in pores at the bond line.
const BESIDE: f64 = 0.1;

impl Segmented {
    /// A sentence where wood and void, or void and adhesive, look exchanged.
    pub fn swapped(&self) -> Option<String> {
        let across = (0..3).find(|&axis| self.holds_a_void_bond_line(axis));
        let adhesive = across.map(|axis| {
            format!(
                "void and adhesive look exchanged: along {} adhesive fills the pores in both outer quarters and void those between, the reverse of a bond",
                NAMES[axis]
            )
        });
        adhesive.or_else(|| self.is_void_wood())
    }

    /// Whether adhesive lies along an axis as void does in a bond, and void as adhesive.
    fn holds_a_void_bond_line(&self, axis: usize) -> bool {
        let layers = self.wood.dims()[axis];
        let voxels = (self.wood.dims().iter().product::<usize>() / layers) as u64;
        let adhesive = self.adhesive.view().counts_along(axis);
        let solid = self
            .wood
            .view()
            .counts_along(axis)
            .into_iter()
            .zip(&adhesive);
        let void: Vec<u64> = solid
            .map(|(wood, adhesive)| voxels - wood - adhesive)
            .collect();
        let sum = |counts: &[u64]| counts.iter().sum::<u64>() as f64;
        let filled = |end: Range<usize>| {
            let [filled, empty] = [&adhesive, &void].map(|counts| sum(&counts[end.clone()]));
            filled > 0.0 && filled >= FILLED * (filled + empty)
        };
        let line: Vec<u64> = void.iter().copied().filter(|n| 2 * n > voxels).collect();
        let quarter = layers / 4;
        line.len() >= LINE
            && sum(&line) <= (1.0 - BESIDE) * sum(&void)
            && filled(0..quarter)
            && filled(layers - quarter..layers)
    }

    /// A sentence where wood and void look exchanged: across its cells wood is one network with
    /// void in pieces (8 to 40 times as many in the wood measured), not pieces in a network of void.
    fn is_void_wood(&self) -> Option<String> {
        let pieces = [0, 1, 2].map(|axis| self.pieces(axis));
        let (axis, [void, wood]) = (pieces.into_iter().enumerate())
            .max_by_key(|(_, pieces)| pieces.iter().sum::<usize>())?;
        (wood >= LEAST && wood > TIMES * void).then(|| {
            format!(
                "wood and void look exchanged: in cuts normal to {} wood is {wood} pieces and void {void}, the reverse of a cell structure",
                NAMES[axis]
            )
        })
    }

    /// Pieces of void and of wood in cuts across an axis.
    fn pieces(&self, axis: usize) -> [usize; 2] {
        let dims = self.wood.dims();
        let [across, up] = [[1, 2], [0, 2], [0, 1]][axis];
        let size = [dims[across], dims[up]];
        let mut sum = [0; 2];
        for share in CUTS {
            let layer = (share * dims[axis] as f64) as usize;
            let phase = |i: usize| {
                let mut voxel = [layer; 3];
                (voxel[across], voxel[up]) = (i % size[0], i / size[0]);
                self.phase(voxel)
            };
            let section: Vec<Phase> = (0..size[0] * size[1]).map(phase).collect();
            for (phase, piece) in pieces(&section, size[0], false) {
                if let (Some(sum), PIECE..) = (sum.get_mut(phase as usize), piece.len()) {
                    *sum += 1;
                }
            }
        }
        sum
    }
}

/// [`Segmented::swapped`] of an adherend of a bond or state; nothing of a damaged file.
pub fn swapped_in_file(file: &ParticleFile) -> Option<String> {
    (0..file.header().blocks.len()).find_map(|index| {
        let (block, bits) = file.block(index).ok()?;
        if block.material != Material::Rigid {
            return None;
        }
        let wood = BitGrid::from_words(bits.dims(), bits.words().to_vec())?;
        let adhesive = BitGrid::new(bits.dims());
        let segmented = Segmented {
            wood,
            adhesive,
            guessed: None,
        };
        segmented.swapped()
    })
}
