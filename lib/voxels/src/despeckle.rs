//! Specks: pieces of a phase so small that they are noise.

use std::ops::Range;

use particle_file::BitGrid;

use crate::lattice::{Voxel, around, voxels};
use crate::{Phase, Segmented};

/// Voxels that are looked at for noise.
const LOOKED: usize = 1 << 24;

/// What became of the specks of a specimen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Despeckled {
    /// How many there were.
    pub pieces: u64,
    /// Their voxels of void, wood and adhesive.
    pub voxels: [u64; 3],
}

impl Segmented {
    /// Gives every piece of at most `most` voxels the phase that most faces around it have. A piece
    /// is what hangs together by faces, edges or corners, so that thin walls stay.
    pub fn despeckle(&mut self, most: usize) -> Despeckled {
        let mut told = Despeckled::default();
        let (specks, found) = self.specks(most, 0..usize::MAX);
        let around = specks.iter().map(|piece| self.around(piece, &found));
        let around: Vec<Option<Phase>> = around.collect();
        for (piece, phase) in specks.iter().zip(around) {
            let Some(phase) = phase else { continue };
            told.pieces += 1;
            told.voxels[self.phase(piece[0]) as usize] += piece.len() as u64;
            for &[x, y, z] in piece {
                self.wood.set(x, y, z, phase == Phase::Wood);
                self.adhesive.set(x, y, z, phase == Phase::Adhesive);
            }
        }
        told
    }

    /// The phase of most voxels at the faces of a piece, other specks aside; none where there are
    /// no others.
    fn around(&self, piece: &[Voxel], specks: &BitGrid) -> Option<Phase> {
        let mut faces = [0_usize; 3];
        for &voxel in piece {
            let shares_face =
                |beside: &Voxel| (0..3).map(|a| voxel[a].abs_diff(beside[a])).sum::<usize>() == 1;
            for beside in around(voxel, self.wood.dims()).filter(shares_face) {
                let [x, y, z] = beside;
                if !specks.get(x, y, z) {
                    faces[self.phase(beside) as usize] += 1;
                }
            }
        }
        let most = faces.into_iter().max().filter(|n| *n > 0)?;
        let phase = faces.iter().position(|n| *n == most)?;
        Some(Phase::ALL[phase])
    }

    /// How many pieces of at most `most` voxels begin among the middle voxels, and how many of these were looked at: a whole
    /// large stack takes minutes.
    pub fn small_pieces(&self, most: usize) -> [usize; 2] {
        let all = self.wood.dims().iter().product();
        let looked = LOOKED.min(all);
        let first = (all - looked) / 2;
        [self.specks(most, first..first + looked).0.len(), looked]
    }

    /// Pieces of at most `most` voxels that hold one of the voxels in `part`, and their voxels.
    fn specks(&self, most: usize, part: Range<usize>) -> (Vec<Vec<Voxel>>, BitGrid) {
        let dims = self.wood.dims();
        let mut specks = Vec::new();
        let [mut found, mut large] = [BitGrid::new(dims), BitGrid::new(dims)];
        for voxel in voxels(dims).skip(part.start).take(part.len()) {
            let [x, y, z] = voxel;
            if large.get(x, y, z) || found.get(x, y, z) {
                continue;
            }
            // The piece of its neighbour, which most voxels share.
            if x > 0 && large.get(x - 1, y, z) && self.phase([x - 1, y, z]) == self.phase(voxel) {
                large.set(x, y, z, true);
                continue;
            }
            let (piece, is_large) = self.piece(voxel, most, &large);
            let seen = if is_large { &mut large } else { &mut found };
            piece.iter().for_each(|&[x, y, z]| seen.set(x, y, z, true));
            if !is_large {
                specks.push(piece);
            }
        }
        (specks, found)
    }

    /// The piece that a voxel belongs to, as far as it takes to tell whether it has more than `most`
    /// voxels, as those of `large` have; and whether it has.
    fn piece(&self, from: Voxel, most: usize, large: &BitGrid) -> (Vec<Voxel>, bool) {
        let phase = self.phase(from);
        let mut piece = vec![from];
        let mut next = 0;
        while let Some(&voxel) = piece.get(next) {
            next += 1;
            for voxel in around(voxel, self.wood.dims()) {
                if self.phase(voxel) != phase {
                    continue;
                }
                if !piece.contains(&voxel) {
                    piece.push(voxel);
                }
                let [x, y, z] = voxel;
                if piece.len() > most || large.get(x, y, z) {
                    return (piece, true);
                }
            }
        }
        (piece, false)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn specimen(wood: &[Voxel], adhesive: &[Voxel]) -> Segmented {
        let grid =
            |voxels: &[Voxel]| BitGrid::from_fn([9, 8, 7], |x, y, z| voxels.contains(&[x, y, z]));
        Segmented {
            wood: grid(wood),
            adhesive: grid(adhesive),
            guessed: None,
        }
    }

    #[test]
    fn pieces_up_to_the_size_go_and_larger_stay() {
        let pair = [[1, 1, 1], [2, 2, 2]];
        let mut found = specimen(&pair, &[[6, 6, 1], [6, 6, 2], [6, 6, 3], [8, 0, 0]]);
        for (most, pieces, voxels) in [
            (1, 1, [0, 0, 1]),
            (2, 1, [0, 2, 0]),
            (2, 0, [0, 0, 0]),
            (3, 1, [0, 0, 3]),
        ] {
            assert_eq!(found.despeckle(most), Despeckled { pieces, voxels });
        }
        assert_eq!((found.wood.count(), found.adhesive.count()), (0, 0));
    }

    #[test]
    fn a_speck_takes_the_phase_around_it() {
        let mut wood: Vec<Voxel> = voxels([4, 8, 7]).collect();
        wood.retain(|v| ![[1, 4, 3], [2, 2, 2]].contains(v));
        // In wood, at its face to void, and a void in wood.
        let mut found = specimen(&wood, &[[1, 4, 3], [4, 6, 5]]);
        let told = found.despeckle(1);
        assert_eq!((told.pieces, told.voxels), (3, [1, 0, 2]));
        assert_eq!(found.wood.count(), 4 * 8 * 7);
        assert_eq!(found.adhesive.count(), 0);
    }

    /// Nothing is around what is nothing but a speck; and a wall of one voxel, whose voxels meet at edges and corners alone,
    /// is one piece.
    #[test]
    fn a_specimen_of_specks_alone_and_thin_walls_stay() {
        let wall = voxels([7, 7, 7]).filter(|[x, y, z]| x == y && (x + z) % 2 == 0);
        for (wood, most) in [(vec![[0, 0, 0]], 9 * 8 * 7), (wall.collect(), 10)] {
            let mut found = specimen(&wood, &[]);
            assert_eq!(found.despeckle(most), Despeckled::default());
            assert_eq!(found.wood.count(), wood.len() as u64);
        }
    }
}
