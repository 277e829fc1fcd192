//! Whether two phases look exchanged.

use std::ops::Range;

use particle_file::{BitGrid, BitsRef, Material, ParticleFile};

use crate::lattice::pieces;
use crate::{Phase, Segmented};

const NAMES: [&str; 3] = ["x", "y", "z"];
/// Shares of an axis at which it is cut.
const CUTS: [f64; 3] = [0.25, 0.5, 0.75];
/// Fewest voxels of a piece in a cut: fewer are noise.
const PIECE: usize = 9;
/// Pieces from which a phase may be lumens.
const LEAST: usize = 20;
/// Pixels of wood for one of void from which there is hardly a void.
const SCARCE: usize = 10;
/// Faces of void at adhesive for each at wood, from which adhesive and wood look exchanged.
const TIMES: usize = 3;
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

    /// A sentence where wood and void look exchanged: across its cells wood is more pieces than void, and the wider of the two,
    /// as lumens are. Thin walls that the resolution broke are many pieces too, but narrow.
    fn is_void_wood(&self) -> Option<String> {
        let (axis, cells) = self.cross_section()?;
        let ([void, wood, _], pixels) = (cells.pieces, cells.pixels);
        let is_wider = cells.width(Phase::Wood) > cells.width(Phase::Void);
        let has_void = SCARCE * pixels[Phase::Void as usize] >= pixels[Phase::Wood as usize];
        (wood >= LEAST && wood > void && is_wider && has_void).then(|| {
            format!(
                "wood and void look exchanged: in cuts normal to {} wood is {wood} pieces and void {void}, and wood is the wider, the reverse of a cell structure",
                NAMES[axis]
            )
        })
    }

    /// A sentence where adhesive, not wood, has the lumens: the phase that voids border on is that of the cell walls.
    pub fn walls_of_adhesive(&self) -> Option<String> {
        let (_, cells) = self.cross_section()?;
        let [_, wood, adhesive] = cells.beside_void;
        (cells.pieces[Phase::Void as usize] >= LEAST && adhesive > TIMES * wood).then(|| {
            format!(
                "voids border on adhesive at {adhesive} faces and on wood at {wood}, and lumens border on wood: are the labels exchanged?"
            )
        })
    }

    /// The cuts normal to the axis along which void and wood have most pieces, and that axis.
    fn cross_section(&self) -> Option<(usize, Cells)> {
        let all = [0, 1, 2].map(|axis| self.cells(axis));
        (all.into_iter().enumerate()).max_by_key(|(_, cells)| cells.pieces[0] + cells.pieces[1])
    }

    /// What cuts normal to an axis show.
    fn cells(&self, axis: usize) -> Cells {
        let dims = self.wood.dims();
        let [across, up] = [[1, 2], [0, 2], [0, 1]][axis];
        let size = [dims[across], dims[up]];
        let mut cells = Cells::default();
        for share in CUTS {
            let layer = (share * dims[axis] as f64) as usize;
            let phase = |i: usize| {
                let mut voxel = [layer; 3];
                (voxel[across], voxel[up]) = (i % size[0], i / size[0]);
                self.phase(voxel)
            };
            let section: Vec<Phase> = (0..size[0] * size[1]).map(phase).collect();
            cells.add(&section, size[0]);
        }
        cells
    }
}

/// What cuts show of each phase: void, wood, adhesive.
#[derive(Default)]
struct Cells {
    pieces: [usize; 3],
    pixels: [usize; 3],
    /// Sum of the distances of the pixels from other phases, in pixels.
    depth: [usize; 3],
    /// Faces of void.
    beside_void: [usize; 3],
}

impl Cells {
    /// Mean distance of a phase from others, a quarter of the width of a wall.
    fn width(&self, phase: Phase) -> f64 {
        self.depth[phase as usize] as f64 / self.pixels[phase as usize] as f64
    }

    /// Adds a section of rows of `width`.
    fn add(&mut self, section: &[Phase], width: usize) {
        for (phase, piece) in pieces(section, width, false) {
            self.pieces[phase as usize] += usize::from(piece.len() >= PIECE);
        }
        let n = section.len();
        let mut depths = vec![n; n];
        // From the first pixel on and back again, each by the two neighbours that were before it.
        for step in 0..2 * n {
            let (i, [before, above]) = if step < n {
                let i = step;
                (i, [(i % width > 0).then(|| i - 1), i.checked_sub(width)])
            } else {
                let i = 2 * n - 1 - step;
                (
                    i,
                    [(i % width + 1 < width).then_some(i + 1), Some(i + width)],
                )
            };
            for at in before.into_iter().chain(above).filter(|at| *at < n) {
                let is_alike = section[at] == section[i];
                depths[i] = depths[i].min(1 + depths[at] * usize::from(is_alike));
                if section[i] == Phase::Void {
                    self.beside_void[section[at] as usize] += 1;
                }
            }
        }
        for (phase, depth) in section.iter().zip(depths) {
            self.pixels[*phase as usize] += 1;
            self.depth[*phase as usize] += depth;
        }
    }
}

/// [`Segmented::swapped`] of an adherend of a bond or state; nothing of a damaged file.
pub fn swapped_in_file(file: &ParticleFile) -> Option<String> {
    (0..file.header().blocks.len()).find_map(|index| {
        let (block, bits) = file.block(index).ok()?;
        if block.material != Material::Rigid {
            return None;
        }
        let grid = |bits: BitsRef| BitGrid::from_words(bits.dims(), bits.words().to_vec());
        let wood = grid(bits)?;
        // Beside the wood of a specimen, in the same box; that of a bond is between its adherends.
        let adhesive = file.block_named("adhesive").ok().map(|(_, bits)| bits);
        let adhesive = adhesive.filter(|bits| bits.dims() == wood.dims());
        let adhesive = adhesive.map_or_else(|| Some(BitGrid::new(wood.dims())), grid)?;
        let segmented = Segmented {
            wood,
            adhesive,
            guessed: None,
        };
        segmented.swapped()
    })
}
