//! Whether wood and void look exchanged.

use particle_file::{BitGrid, Material, ParticleFile};

use crate::{Phase, Segmented};

/// Shares of an axis at which it is cut.
const CUTS: [f64; 3] = [0.25, 0.5, 0.75];
/// Fewest voxels of a piece in a cut: fewer are noise.
const PIECE: usize = 9;
/// Pieces of wood for each of void, and pieces of wood, from which the two look exchanged.
const TIMES: usize = 3;
const LEAST: usize = 20;

impl Segmented {
    /// A sentence where wood and void look exchanged: across its cells wood is one network with
    /// void in pieces (8 to 40 times as many in the wood measured), not pieces in a network of void.
    pub fn swapped(&self) -> Option<String> {
        let pieces = [0, 1, 2].map(|axis| self.pieces(axis));
        let (axis, [void, wood]) = (pieces.into_iter().enumerate())
            .max_by_key(|(_, pieces)| pieces.iter().sum::<usize>())?;
        (wood >= LEAST && wood > TIMES * void).then(|| {
            format!(
                "wood and void look exchanged: in cuts across {} wood is {wood} pieces and void {void}, and cells make it the other way round",
                ["x", "y", "z"][axis]
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
            let found = pieces_of(&section, size[0]);
            sum = [sum[0] + found[0], sum[1] + found[1]];
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

/// Pieces of void and of wood in a section of rows of `width`.
fn pieces_of(section: &[Phase], width: usize) -> [usize; 2] {
    let mut seen = vec![false; section.len()];
    let mut pieces = [0; 2];
    let mut waiting = Vec::new();
    for start in 0..section.len() {
        let phase = section[start];
        let Some(pieces) = pieces.get_mut(phase as usize).filter(|_| !seen[start]) else {
            continue;
        };
        seen[start] = true;
        waiting.push(start);
        let mut size = 0;
        while let Some(i) = waiting.pop() {
            size += 1;
            let x = i % width;
            let beside = [
                (x > 0).then(|| i - 1),
                (x + 1 < width).then(|| i + 1),
                i.checked_sub(width),
                Some(i + width).filter(|i| *i < section.len()),
            ];
            for next in beside.into_iter().flatten() {
                if !seen[next] && section[next] == phase {
                    seen[next] = true;
                    waiting.push(next);
                }
            }
        }
        *pieces += usize::from(size >= PIECE);
    }
    pieces
}
