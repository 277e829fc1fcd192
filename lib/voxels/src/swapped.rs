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

    /// A sentence where wood and void look exchanged: across its cells wood is more pieces than void, as lumens are, and the
    /// wider of the two, as walls are not. Thin walls that the resolution broke are many pieces too, but narrow. Where
    /// adhesive left hardly a void there is nothing to compare.
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
            if piece.len() >= PIECE {
                self.pieces[phase as usize] += 1;
            }
        }
        for (phase, depth) in section.iter().zip(depths(section, width)) {
            self.pixels[*phase as usize] += 1;
            self.depth[*phase as usize] += depth;
        }
        let rows = section.chunks(width);
        let along = rows.flat_map(|row| row.windows(2).map(|pair| [pair[0], pair[1]]));
        let across = section.iter().zip(section.iter().skip(width));
        for pair in along.chain(across.map(|(a, b)| [*a, *b])) {
            match pair {
                [Phase::Void, other] | [other, Phase::Void] => {
                    self.beside_void[other as usize] += 1
                }
                _ => {}
            }
        }
    }
}

/// How far the pixels of a section of rows of `width` are from the next of another phase, in steps by edges and corners; the
/// sides of the section are none.
fn depths(section: &[Phase], width: usize) -> Vec<usize> {
    let height = section.len() / width;
    let mut depths = vec![width + height; section.len()];
    // Once from the first pixel on and once back, each by the four neighbours that were before it.
    for back in [false, true] {
        for step in 0..section.len() {
            let i = if back { section.len() - 1 - step } else { step };
            for (u, v) in [(-1, -1), (0, -1), (1, -1), (-1, 0)] {
                let (u, v) = if back { (-u, -v) } else { (u, v) };
                let beside = [
                    (i % width).checked_add_signed(u),
                    (i / width).checked_add_signed(v),
                ];
                if let [Some(x), Some(y)] = beside
                    && x < width
                    && y < height
                {
                    let at = y * width + x;
                    let through = if section[at] == section[i] {
                        depths[at] + 1
                    } else {
                        1
                    };
                    depths[i] = depths[i].min(through);
                }
            }
        }
    }
    depths
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
