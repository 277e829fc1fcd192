//! Specks: pieces of a phase so small that they are noise.

use particle_file::BitGrid;

use crate::{Phase, Segmented};

/// What became of the specks of a specimen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Despeckled {
    /// How many there were.
    pub pieces: u64,
    /// Their voxels of void, wood and adhesive.
    pub voxels: [u64; 3],
}

type Voxel = [usize; 3];

impl Segmented {
    /// What a voxel holds.
    pub(crate) fn phase(&self, [x, y, z]: Voxel) -> Phase {
        match (self.wood.get(x, y, z), self.adhesive.get(x, y, z)) {
            (true, _) => Phase::Wood,
            (_, true) => Phase::Adhesive,
            _ => Phase::Void,
        }
    }

    /// Gives every piece of at most `most` voxels the phase that most faces around it have. A piece
    /// is what hangs together by faces, edges or corners, so that thin walls stay.
    pub fn despeckle(&mut self, most: usize) -> Despeckled {
        let mut told = Despeckled::default();
        let specks = Specks::of(self, most);
        let around: Vec<Option<Phase>> = (specks.pieces.iter())
            .map(|piece| self.around(piece, &specks))
            .collect();
        for (piece, phase) in specks.pieces.iter().zip(around) {
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
    fn around(&self, piece: &[Voxel], specks: &Specks) -> Option<Phase> {
        let mut faces = [0_usize; 3];
        let dims = self.wood.dims();
        for &voxel in piece {
            for [x, y, z] in neighbours(voxel, dims, 1) {
                if !specks.found.get(x, y, z) {
                    faces[self.phase([x, y, z]) as usize] += 1;
                }
            }
        }
        let most = faces.into_iter().max().filter(|n| *n > 0)?;
        Phase::ALL
            .into_iter()
            .find(|&phase| faces[phase as usize] == most)
    }
}

/// The specks of a specimen.
struct Specks {
    pieces: Vec<Vec<Voxel>>,
    /// All their voxels.
    found: BitGrid,
}

impl Specks {
    fn of(specimen: &Segmented, most: usize) -> Self {
        let dims = specimen.wood.dims();
        let mut specks = Self {
            pieces: Vec::new(),
            found: BitGrid::new(dims),
        };
        // Voxels of larger pieces.
        let mut large = BitGrid::new(dims);
        let [nx, ny, nz] = dims;
        for [z, y, x] in
            (0..nz).flat_map(|z| (0..ny).flat_map(move |y| (0..nx).map(move |x| [z, y, x])))
        {
            if large.get(x, y, z) || specks.found.get(x, y, z) {
                continue;
            }
            let (piece, is_large) = piece(specimen, [x, y, z], most, &large);
            let seen = if is_large {
                &mut large
            } else {
                &mut specks.found
            };
            piece.iter().for_each(|&[x, y, z]| seen.set(x, y, z, true));
            if !is_large {
                specks.pieces.push(piece);
            }
        }
        specks
    }
}

/// The piece that a voxel belongs to, as far as it takes to tell whether it has more than `most`
/// voxels; and whether it has.
fn piece(specimen: &Segmented, from: Voxel, most: usize, large: &BitGrid) -> (Vec<Voxel>, bool) {
    let phase = specimen.phase(from);
    let mut piece = vec![from];
    let mut next = 0;
    while let Some(&voxel) = piece.get(next) {
        next += 1;
        for voxel in neighbours(voxel, specimen.wood.dims(), 3) {
            if specimen.phase(voxel) != phase {
                continue;
            }
            if large.get(voxel[0], voxel[1], voxel[2]) {
                return (piece, true);
            }
            if !piece.contains(&voxel) {
                piece.push(voxel);
            }
            if piece.len() > most {
                return (piece, true);
            }
        }
    }
    (piece, false)
}

/// The voxels that meet one at faces (`shared` 1), also at edges (2) or corners (3).
fn neighbours(at: Voxel, dims: Voxel, shared: usize) -> impl Iterator<Item = Voxel> {
    const STEPS: [isize; 3] = [-1, 0, 1];
    let steps = STEPS.into_iter().flat_map(|z| {
        STEPS
            .into_iter()
            .flat_map(move |y| STEPS.into_iter().map(move |x| [x, y, z]))
    });
    steps.filter_map(move |step: [isize; 3]| {
        let differs = step.iter().filter(|s| **s != 0).count();
        if differs == 0 || differs > shared {
            return None;
        }
        let mut voxel = at;
        for (a, by) in step.into_iter().enumerate() {
            voxel[a] = at[a].checked_add_signed(by).filter(|n| *n < dims[a])?;
        }
        Some(voxel)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const DIMS: Voxel = [9, 8, 7];

    /// Void with the voxels of `wood` and `adhesive`.
    fn specimen(wood: &[Voxel], adhesive: &[Voxel]) -> Segmented {
        let grid = |voxels: &[Voxel]| {
            let mut grid = BitGrid::new(DIMS);
            voxels.iter().for_each(|&[x, y, z]| grid.set(x, y, z, true));
            grid
        };
        Segmented {
            wood: grid(wood),
            adhesive: grid(adhesive),
            guessed: None,
        }
    }

    #[test]
    fn pieces_up_to_the_size_go_and_larger_stay() {
        let pair = [[1, 1, 1], [2, 2, 2]];
        let three = [[6, 6, 1], [6, 6, 2], [6, 6, 3]];
        let mut found = specimen(&pair, &[&three[..], &[[8, 0, 0]]].concat());
        let told = found.despeckle(1);
        assert_eq!((told.pieces, told.voxels), (1, [0, 0, 1]));
        let told = found.despeckle(2);
        assert_eq!((told.pieces, told.voxels), (1, [0, 2, 0]));
        assert_eq!((found.wood.count(), found.adhesive.count()), (0, 3));
        assert_eq!(found.despeckle(2), Despeckled::default());
        assert_eq!(found.despeckle(3).voxels, [0, 0, 3]);
    }

    #[test]
    fn a_speck_takes_the_phase_around_it() {
        let all = |x: usize| (0..8).flat_map(move |y| (0..7).map(move |z| [x, y, z]));
        let mut wood: Vec<Voxel> = (0..4).flat_map(all).collect();
        wood.retain(|v| ![[1, 4, 3], [2, 2, 2]].contains(v));
        // In wood, at its face to void, and a void in wood.
        let mut found = specimen(&wood, &[[1, 4, 3], [4, 6, 5]]);
        let told = found.despeckle(1);
        assert_eq!((told.pieces, told.voxels), (3, [1, 0, 2]));
        assert_eq!(found.wood.count(), 4 * 8 * 7);
        assert_eq!(found.adhesive.count(), 0);
    }

    /// A wall of one voxel, whose voxels meet at edges and corners alone, is one piece.
    #[test]
    fn thin_walls_stay() {
        let wall: Vec<Voxel> = (0..7)
            .flat_map(|i| (0..7).map(move |z| [i, i, z]))
            .filter(|[i, _, z]| (i + z) % 2 == 0)
            .collect();
        let mut found = specimen(&wall, &[]);
        assert_eq!(found.despeckle(10), Despeckled::default());
        assert_eq!(found.wood.count(), wall.len() as u64);
    }

    /// What is nothing but a speck keeps its phase: nothing is around it.
    #[test]
    fn a_specimen_of_specks_alone_stays() {
        let mut found = specimen(&[[0, 0, 0]], &[]);
        assert_eq!(found.despeckle(9 * 8 * 7), Despeckled::default());
        assert_eq!(found.wood.count(), 1);
    }
}
