//! The states of a run as a moving picture.

use particle_file::ParticleFile;

use crate::bitmap::encoder;
use crate::page::Page;
use crate::replay::failed;
use crate::view::data;
use crate::{Direction, Error, Labelled, Views, Wood};

/// How long the last frame stands, s.
const LAST: f64 = 2.0;

/// The states of a run in three dimensions, one frame each: all of one box, seen from one place, with the time of each.
pub struct Movie<'a> {
    states: &'a [Labelled],
    wood: Wood,
    from: Direction,
    /// Low and high corner of all that is shown, m.
    corners_m: [[f64; 3]; 2],
    page: Page,
}

impl<'a> Movie<'a> {
    /// Of these states, in this order.
    ///
    /// # Errors
    /// [`Error::Data`] for an unreadable file.
    pub fn read(states: &'a [Labelled], wood: Wood, from: Direction) -> Result<Self, Error> {
        let [mut low, mut high] = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
        for state in states {
            let file = ParticleFile::open(&state.path).map_err(data)?;
            let header = file.header();
            // Voxels of a state lie on a lattice of their own, off the box by less than one.
            let voxel_m = header.voxel_m;
            low = std::array::from_fn(|i| low[i].min(header.box_min_m[i] - voxel_m));
            high = std::array::from_fn(|i| high[i].max(header.box_max_m[i] + voxel_m));
        }
        Ok(Self {
            states,
            wood,
            from,
            corners_m: [low, high],
            page: Page::default(),
        })
    }

    /// The same for a page.
    pub fn on(self, page: Page) -> Self {
        Self { page, ..self }
    }

    /// An animated PNG that repeats itself, at so many frames a second.
    ///
    /// # Errors
    /// What [`Views::read`] and [`crate::Drawing::to_png`] say; [`Error::Draw`] where frames come out of different sizes.
    pub fn to_png(&self, rate: f64) -> Result<Vec<u8>, Error> {
        let mut bytes = Vec::new();
        let (first, size) = self.frame(&self.states[0])?;
        let mut encoder = encoder(&mut bytes, size, Some(self.page.dpi));
        let count = self.states.len();
        encoder.set_animated(count as u32, 0).map_err(failed)?;
        let milliseconds = |seconds: f64| (1e3 * seconds).round() as u16;
        let each = milliseconds(rate.recip());
        encoder.set_frame_delay(each, 1000).map_err(failed)?;
        let mut writer = encoder.write_header().map_err(failed)?;
        writer.write_image_data(&first).map_err(failed)?;
        for (i, state) in self.states.iter().enumerate().skip(1) {
            let (pixels, of) = self.frame(state)?;
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

    /// Pixels of a state, and their numbers along x and y.
    fn frame(&self, state: &Labelled) -> Result<(Vec<u8>, [usize; 2]), Error> {
        let views = Views::read(std::slice::from_ref(state), self.wood, self.from)?;
        views.within(self.corners_m).on(self.page).draw().pixels()
    }
}
