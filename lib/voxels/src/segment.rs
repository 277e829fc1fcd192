//! Stacks sorted into wood and adhesive.

use particle_file::{BitGrid, limits};
use rayon::prelude::*;

use crate::coder::{Coder, UNKNOWN, found, guessed};
use crate::label::Label;
use crate::phases::{Phase, Phases};
use crate::{Crop, Error, Stack};

/// Phases that have a bit of each voxel: wood and adhesive.
const PHASES: u64 = 2;

/// A stack as sets of voxels; void is what is in neither.
#[derive(Clone, Debug)]
pub struct Segmented {
    /// Voxels of wood.
    pub wood: BitGrid,
    /// Voxels of adhesive.
    pub adhesive: BitGrid,
    /// The labels of void, wood and, unless it is undamaged wood, adhesive when they were guessed.
    pub guessed: Option<&'static [f64]>,
}

impl Segmented {
    /// What a voxel holds.
    pub(crate) fn phase(&self, [x, y, z]: [usize; 3]) -> Phase {
        match (self.wood.get(x, y, z), self.adhesive.get(x, y, z)) {
            (true, _) => Phase::Wood,
            (_, true) => Phase::Adhesive,
            _ => Phase::Void,
        }
    }
}

/// Reads the voxels of `crop` page by page on all threads and sorts them into phases.
///
/// Memory: the result (one bit per voxel and phase) and two pages per thread. `on_page` is
/// called after each page, from any thread.
///
/// # Errors
/// A page that cannot be read, the first pixel without a phase, or a crop that reaches out
/// of the stack; and as [`check`].
pub fn segment(
    stack: &Stack,
    phases: &Phases,
    crop: &Crop,
    on_page: impl Fn() + Sync,
) -> Result<Segmented, Error> {
    check(stack, phases, crop)?;
    let [nx, ny, nz] = crop.dims();
    let words_per_row = nx.div_ceil(u64::BITS as usize);
    let words_per_page = words_per_row * ny;
    let mut wood = vec![0; words_per_page * nz];
    let mut adhesive = vec![0; words_per_page * nz];

    let coder = Coder::new(phases, stack.format());
    let unions: Vec<Result<u8, Error>> = (wood.par_chunks_mut(words_per_page))
        .zip(adhesive.par_chunks_mut(words_per_page))
        .enumerate()
        .map_init(Vec::new, |page, (k, (wood, adhesive))| {
            let z = crop.ranges()[2].start + k;
            stack.read_page(z, page)?;
            let rows = wood
                .chunks_mut(words_per_row)
                .zip(adhesive.chunks_mut(words_per_row));
            let union = (crop.rows(stack.format(), page).zip(rows))
                .map(|(pixels, (wood, adhesive))| coder.row(pixels, wood, adhesive))
                .fold(0, |union, row| union | row);
            on_page();
            match union & UNKNOWN {
                0 => Ok(union),
                _ => Err(unknown_label(stack, phases, crop, page, z, &coder)),
            }
        })
        .collect();
    let mut union = 0;
    for page in unions {
        union |= page?;
    }
    let guessed = match phases {
        Phases::Guess => Some(guessed(union).ok_or_else(|| not_guessed(stack, union))?),
        _ => None,
    };
    let [wood, adhesive] = [wood, adhesive].map(|words| {
        let grid = BitGrid::from_words(crop.dims(), words);
        grid.ok_or_else(|| Error::file(stack.name(), "it has more voxels than can be counted"))
    });
    Ok(Segmented {
        wood: wood?,
        adhesive: adhesive?,
        guessed,
    })
}

/// What [`segment`] refuses before it reads a page: it takes no time.
///
/// # Errors
/// A crop that reaches out of the stack, phases that its pages cannot have, or more memory than
/// this process may have.
pub fn check(stack: &Stack, phases: &Phases, crop: &Crop) -> Result<(), Error> {
    crop.check(stack.dims())?;
    match phases {
        Phases::Grey(_) => stack.check_grey()?,
        Phases::Labels(labels) if labels.are_colours() => {}
        _ => stack.check_numbers()?,
    }
    if !matches!(phases, Phases::Grey(_)) && stack.is_lossy() {
        return Err(Error::Usage(format!(
            "{}: the compression of JPEG changes values, so that no labels survive it; give grey values by --grey",
            stack.name()
        )));
    }
    let [nx, ny, nz] = crop.dims().map(|n| n as u64);
    let words = limits::volume([nx.div_ceil(u64::BITS.into()), ny, nz]);
    let grids = words.saturating_mul(PHASES * (u64::BITS / u8::BITS) as u64);
    stack.fits(grids.saturating_add(stack.reading_bytes()))
}

/// The error for a stack that holds known labels, but not all of a set.
fn not_guessed(stack: &Stack, union: u8) -> Error {
    let found = found(union);
    let names = ["void=", "wood=", "adhesive="];
    let listed: Vec<String> = found.iter().map(f64::to_string).collect();
    let example = (names.iter().zip(&listed)).map(|(name, label)| name.to_string() + label);
    let example: Vec<String> = example.collect();
    Error::Usage(format!(
        "{}: it holds {} alone{}; labels are guessed only from exactly 0, 1, 2 or 0, 128, 255, or, for wood alone, the first two of either: say which is which, as in --labels {}",
        stack.name(),
        listed.join(" and "),
        match found[..] {
            [0.0, 255.0] => ", a mask as ImageJ makes it, whose 255 may be wood, adhesive or void",
            _ => "",
        },
        match found.len() {
            1 => "void=0,wood=1,adhesive=2".to_owned(),
            _ => example.join(","),
        },
    ))
}

/// The error for the first pixel of a page that has no phase.
fn unknown_label(
    stack: &Stack,
    phases: &Phases,
    crop: &Crop,
    page: &[u8],
    z: usize,
    coder: &Coder,
) -> Error {
    let [x0, y0] = [0, 1].map(|axis| crop.ranges()[axis].start);
    let mut rows = crop.rows(stack.format(), page).enumerate();
    let found = rows.find_map(|(y, row)| {
        let (x, label) = coder.first_unknown(row)?;
        Some((label, x + x0, y + y0))
    });
    let (label, x, y) = found.unwrap_or((Label::Value(f64::NAN), x0, y0));
    let cure = match phases {
        Phases::Labels(_) | Phases::Guess if !label.is_whole() => {
            "labels are whole numbers; grey values are given by --grey"
        }
        Phases::Labels(_) => "no phase has that label; name it in --labels",
        Phases::Grey(_) => {
            "that is no grey value: leave it out by --crop, or save the stack with a number there"
        }
        Phases::Guess => {
            "labels are guessed only from exactly 0, 1, 2 or 0, 128, 255; say which is which with --labels or --grey"
        }
    };
    Error::Usage(format!(
        "{}: the pixel at column {x}, row {y} holds {label}, and {cure}",
        stack.page_name(z)
    ))
}
