//! The states of a run as a moving picture.

use std::slice::from_ref;

use particle_file::ParticleFile;

use crate::bitmap::encoder;
use crate::page::Page;
use crate::replay::failed;
use crate::{Direction, Error, Labelled, Views, Wood};

/// How long the last frame stands, s.
const LAST: f64 = 2.0;

/// The states of a run in three dimensions as an animated PNG that repeats itself, at `rate` frames a second: one
/// frame each, all of one box, seen from one place, with the time of each. Says `on_frame` how many are drawn.
///
/// # Errors
/// What [`Views::read`] and [`crate::Drawing::to_png`] say; [`Error::Draw`] where frames come out of different sizes.
pub fn movie(
    states: &[Labelled],
    wood: Wood,
    from: Direction,
    page: Page,
    rate: f64,
    mut on_frame: impl FnMut(usize),
) -> Result<Vec<u8>, Error> {
    let corners_m = box_of(states)?;
    let frame = |state| {
        let views = Views::read(from_ref(state), wood, from)?.within(corners_m);
        views.draw(page).pixels()
    };
    let mut bytes = Vec::new();
    let (first, size) = frame(&states[0])?;
    let mut encoder = encoder(&mut bytes, size, Some(page.dpi));
    let count = states.len();
    encoder.set_animated(count as u32, 0).map_err(failed)?;
    let milliseconds = |seconds: f64| (1e3 * seconds).round() as u16;
    let each = milliseconds(rate.recip());
    encoder.set_frame_delay(each, 1000).map_err(failed)?;
    let mut writer = encoder.write_header().map_err(failed)?;
    writer.write_image_data(&first).map_err(failed)?;
    for (i, state) in states.iter().enumerate().skip(1) {
        on_frame(i);
        let (pixels, of) = frame(state)?;
        if of != size {
            return Err(Error::Draw("the frames differ in size".into()));
        }
        if i + 1 == count {
            let last = milliseconds(LAST.max(rate.recip()));
            writer.set_frame_delay(last, 1000).map_err(failed)?;
        }
        writer.write_image_data(&pixels).map_err(failed)?;
    }
    writer.finish().map_err(failed)?;
    Ok(bytes)
}

/// Low and high corner of all that states show, m.
fn box_of(states: &[Labelled]) -> Result<[[f64; 3]; 2], Error> {
    let [mut low, mut high] = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
    for state in states {
        let file = ParticleFile::open(&state.path)?;
        let header = file.header();
        // Voxels of a state lie on a lattice of their own, off the box by less than one.
        let voxel_m = header.voxel_m;
        low = std::array::from_fn(|i| low[i].min(header.box_min_m[i] - voxel_m));
        high = std::array::from_fn(|i| high[i].max(header.box_max_m[i] + voxel_m));
    }
    Ok([low, high])
}
