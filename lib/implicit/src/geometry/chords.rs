//! Chord lengths: runs of open voxels along x, y and z through each voxel, which walls see as the width of their channel.

use physics::Boundary;

use super::Lattice;
use super::lattice::OPEN;

/// Longest chord that is told from longer ones, voxels: walls farther apart do not feel each other's friction.
pub(super) const LONGEST: u16 = 1000;

/// A chord along y in one part of the lattice: its voxels, whether it goes on through the gap, and whether it ends at
/// the far side of the domain.
#[derive(Clone, Copy, Default)]
struct UprightChord {
    voxels: u16,
    through_gap: bool,
    to_side: bool,
}

/// Chords of one part of the lattice, by layer and place in it: along x and z, and along y.
struct PartChords {
    across: [Vec<Vec<u16>>; 2],
    along: Vec<Vec<UprightChord>>,
}

/// Chord lengths of all voxels.
pub(crate) struct Chords {
    below: PartChords,
    above: PartChords,
    gap: [Vec<u16>; 2],
    /// Kind of the sides normal to y.
    side: Boundary,
}

/// Which voxel: part of the lattice, layer counted from the gap, place in the layer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Place {
    Below(usize, usize),
    Gap(usize),
    Above(usize, usize),
}

impl Chords {
    pub(crate) fn new(lattice: &Lattice) -> Self {
        let size = lattice.across();
        let part = |layers: &[Vec<u8>]| PartChords {
            across: [0, 1].map(|a| {
                let layers = layers.iter();
                layers.map(|layer| runs(layer, size, a, lattice)).collect()
            }),
            along: columns(layers, lattice),
        };
        Self {
            below: part(&lattice.below),
            above: part(&lattice.above),
            gap: [0, 1].map(|a| runs(&lattice.gap, size, a, lattice)),
            side: lattice.boundary[1],
        }
    }

    /// Length of the chord along an axis through an open voxel, voxels, with a gap of so many.
    pub(crate) fn length(&self, place: Place, axis: usize, gap: f64) -> f64 {
        let across = usize::from(axis != 0);
        let (part, layer, at) = match place {
            Place::Gap(at) if axis == 1 => return self.through(at, gap),
            Place::Gap(at) => return f64::from(self.gap[across][at]),
            Place::Below(layer, at) => (&self.below, layer, at),
            Place::Above(layer, at) => (&self.above, layer, at),
        };
        if axis != 1 {
            return f64::from(part.across[across][layer][at]);
        }
        let run = part.along[layer][at];
        if run.through_gap {
            self.through(at, gap)
        } else {
            self.ended(f64::from(run.voxels), usize::from(run.to_side))
        }
    }

    /// Whether the chord along y through a voxel goes through the gap.
    pub(crate) fn through_gap(&self, place: Place) -> bool {
        match place {
            Place::Gap(_) => true,
            Place::Below(layer, at) => self.below.along[layer][at].through_gap,
            Place::Above(layer, at) => self.above.along[layer][at].through_gap,
        }
    }

    /// Length of the chord along y through the gap at a place in the layer.
    fn through(&self, at: usize, gap: f64) -> f64 {
        let [low, high] = [&self.below, &self.above].map(|part| match part.along.first() {
            Some(layer) => layer[at],
            None => UprightChord {
                to_side: true,
                ..UprightChord::default()
            },
        });
        let voxels = f64::from(low.voxels) + gap + f64::from(high.voxels);
        self.ended(voxels, usize::from(low.to_side) + usize::from(high.to_side))
    }

    /// The length of a run of which so many ends are at sides of the domain.
    fn ended(&self, voxels: f64, at_sides: usize) -> f64 {
        match (at_sides, self.side) {
            (0, _) => voxels,
            (1, Boundary::Symmetry) => 2.0 * voxels,
            _ => f64::from(LONGEST),
        }
        .min(f64::from(LONGEST))
    }
}

/// Chords across a layer, along x (axis 0) or z (axis 1).
fn runs(layer: &[u8], size: [usize; 2], axis: usize, lattice: &Lattice) -> Vec<u16> {
    let mut lengths = vec![0; layer.len()];
    let (n, lines) = (size[axis], size[1 - axis]);
    let boundary = lattice.boundary[2 * axis];
    for line in 0..lines {
        let at = |i: usize| match axis {
            0 => line * size[0] + i,
            _ => i * size[0] + line,
        };
        chords(
            n,
            boundary,
            |i| layer[at(i)] == OPEN,
            |i, length| lengths[at(i)] = length,
        );
    }
    lengths
}

/// Chords of a line of `n` voxels with sides of a kind: doubled by a mirror, joined over periodic sides.
fn chords(
    n: usize,
    boundary: Boundary,
    open: impl Fn(usize) -> bool,
    mut set: impl FnMut(usize, u16),
) {
    let mut start = 0;
    let mut spans: Vec<(usize, usize)> = Vec::new();
    for i in 0..=n {
        if i == n || !open(i) {
            if i > start {
                spans.push((start, i));
            }
            start = i + 1;
        }
    }
    for (index, &(from, to)) in spans.iter().enumerate() {
        let (first, last) = (from == 0, to == n);
        let mut length = to - from;
        match boundary {
            Boundary::Symmetry if first && last => length = usize::from(LONGEST),
            Boundary::Symmetry if first || last => length *= 2,
            Boundary::Periodic if first && last => length = usize::from(LONGEST),
            Boundary::Periodic if first && spans[spans.len() - 1].1 == n => {
                let other = spans[spans.len() - 1];
                length += other.1 - other.0;
            }
            Boundary::Periodic if last && spans[0].0 == 0 && index > 0 => {
                length += spans[0].1 - spans[0].0;
            }
            Boundary::Open if first || last => length = usize::from(LONGEST),
            _ => {}
        }
        let length = length.min(usize::from(LONGEST)) as u16;
        (from..to).for_each(|i| set(i, length));
    }
}

/// Chords along y of the layers of a part, counted from the gap. Where nothing moves there is no gap, and one part.
fn columns(layers: &[Vec<u8>], lattice: &Lattice) -> Vec<Vec<UprightChord>> {
    let (n, size) = (layers.len(), lattice.across());
    let mut all = vec![vec![UprightChord::default(); size[0] * size[1]]; n];
    for at in 0..size[0] * size[1] {
        let open = |i: usize| layers[i][at] == OPEN;
        if lattice.moving.is_none() {
            chords(n, lattice.boundary[1], open, |i, voxels| {
                all[i][at].voxels = voxels;
            });
            continue;
        }
        let mut start = 0;
        for i in 0..=n {
            if i < n && open(i) {
                continue;
            }
            let run = UprightChord {
                voxels: (i - start).min(usize::from(LONGEST)) as u16,
                through_gap: start == 0,
                to_side: i == n,
            };
            all[start..i].iter_mut().for_each(|layer| layer[at] = run);
            start = i + 1;
        }
    }
    all
}
