//! The colours that stored values show.
//!
//! A stored value is a label only where it shows the same on every page. Optimisers and quantisers order the palette
//! of each slice anew, and some programs store some slices inverted: there the colours are the labels.

use std::sync::Arc;

use crate::sample::Sample;

/// Red, green, blue and opacity.
type Colour = [u8; 4];
pub(crate) const OPAQUE: u8 = 255;

/// What the stored values of a page show.
#[derive(Debug, PartialEq, Eq)]
pub(crate) enum Shown {
    /// Greys, of values of at most 8 bits.
    Grey {
        bits: u16,
        /// 0 is white.
        inverted: bool,
    },
    /// The colours of 0, 1, ...
    Palette(Vec<Colour>),
    /// Anything else, by its code in TIFF's tag 262.
    Other(u64),
}

impl Shown {
    /// Greys of more than 8 bits, from black.
    pub(crate) const GREY: Self = Self::Other(1);
    /// Red, green and blue.
    pub(crate) const RGB: Self = Self::Other(2);

    /// A palette of the colours of 0, 1, ..., as red, green and blue.
    pub(crate) fn opaque(colours: impl Iterator<Item = [u8; 3]>) -> Self {
        Self::Palette(colours.map(|[r, g, b]| [r, g, b, OPAQUE]).collect())
    }

    /// How many values show a known colour.
    fn len(&self) -> usize {
        match self {
            Self::Grey { bits, .. } => 1 << bits,
            Self::Palette(colours) => colours.len(),
            Self::Other(_) => 0,
        }
    }

    fn colour(&self, value: usize) -> Option<Colour> {
        match self {
            Self::Grey { inverted, .. } => {
                let level = (255 * value / (self.len() - 1)) as u8;
                let level = if *inverted { 255 - level } else { level };
                (value < self.len()).then_some([level, level, level, OPAQUE])
            }
            Self::Palette(colours) => colours.get(value).copied(),
            Self::Other(_) => None,
        }
    }

    /// Whether every value that both know shows the same: unused ends of palettes may be left out.
    fn agrees(&self, other: &Self) -> bool {
        let shared = self.len().min(other.len());
        self == other || shared > 0 && (0..shared).all(|v| self.colour(v) == other.colour(v))
    }
}

/// The colours of pages on which the stored values do not show the same.
#[derive(Debug)]
pub(crate) struct Colours {
    shown: Vec<Arc<Shown>>,
    /// Two pages on which a value shows two colours.
    pub(crate) unlike: [usize; 2],
}

impl Colours {
    /// None where each stored value, of type `sample`, shows the same on all pages.
    ///
    /// # Errors
    /// Two pages that differ, where the pages have no colours to go by.
    pub(crate) fn of(shown: Vec<Arc<Shown>>, sample: Sample) -> Result<Option<Self>, [usize; 2]> {
        let mut longest = 0;
        let odd = (0..shown.len()).find(|&i| {
            let agrees = shown[i].agrees(&shown[longest]);
            if agrees && shown[i].len() > shown[longest].len() {
                longest = i;
            }
            !agrees
        });
        let Some(odd) = odd else { return Ok(None) };
        let unlike = [longest, odd];
        if sample == Sample::U8 && shown.iter().all(|shown| shown.len() > 0) {
            return Ok(Some(Self { shown, unlike }));
        }
        Err(unlike)
    }

    /// The first colours of page `z`, as labels.
    pub(crate) fn first(&self, z: usize) -> String {
        const MOST: usize = 4;
        let shown = &self.shown[z];
        let mut labels: Vec<String> = (0..shown.len().min(MOST))
            .filter_map(|value| shown.colour(value))
            .map(|[r, g, b, _]| format!("{r}:{g}:{b}"))
            .collect();
        if shown.len() > MOST {
            labels.push("...".into());
        }
        labels.join(", ")
    }

    /// The colours, as red, green and blue, in place of the stored values of page `z`.
    pub(crate) fn show(&self, z: usize, page: &mut Vec<u8>) -> Result<(), String> {
        let shown = &self.shown[z];
        let colours: Vec<_> = (0..=255).map(|value| shown.colour(value)).collect();
        let mut rgb = Vec::with_capacity(3 * page.len());
        for &value in page.iter() {
            match colours[usize::from(value)] {
                Some([r, g, b, OPAQUE]) => rgb.extend([r, g, b]),
                Some(_) => {
                    return Err(format!(
                        "the colour of its value {value} is transparent, which is no label: save it without transparency"
                    ));
                }
                None => {
                    return Err(format!(
                        "it holds {value}, but its palette has {} colours",
                        shown.len()
                    ));
                }
            }
        }
        *page = rgb;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn palette(greys: &[u8]) -> Arc<Shown> {
        Arc::new(Shown::opaque(greys.iter().map(|&g| [g; 3])))
    }

    fn grey(bits: u16, inverted: bool) -> Arc<Shown> {
        Arc::new(Shown::Grey { bits, inverted })
    }

    fn unlike(shown: Vec<Arc<Shown>>) -> Option<[usize; 2]> {
        Colours::of(shown, Sample::U8).unwrap().map(|c| c.unlike)
    }

    #[test]
    fn palettes_without_their_unused_ends_agree() {
        assert_eq!(
            unlike(vec![palette(&[0, 9]), palette(&[0, 9, 7]), palette(&[0])]),
            None
        );
        assert_eq!(unlike(vec![palette(&[0, 1, 2]), grey(8, false)]), None);
        assert_eq!(unlike(vec![palette(&[255, 0]), grey(1, true)]), None);
        // The first two pages do not tell which of the others is odd.
        let shown = vec![
            palette(&[0]),
            palette(&[0, 9]),
            palette(&[0]),
            palette(&[0, 7]),
        ];
        assert_eq!(unlike(shown), Some([1, 3]));
        assert_eq!(unlike(vec![grey(1, false), grey(8, false)]), Some([0, 1]));
        assert_eq!(
            unlike(vec![grey(8, false), grey(8, false), grey(8, true)]),
            Some([0, 2])
        );
    }

    #[test]
    fn what_has_no_colours_cannot_be_told_by_them() {
        let other = |code| Arc::new(Shown::Other(code));
        assert!(
            Colours::of(vec![other(0), other(0)], Sample::U16)
                .unwrap()
                .is_none()
        );
        assert_eq!(
            Colours::of(vec![other(1), other(0)], Sample::F32).unwrap_err(),
            [0, 1]
        );
        let shown = vec![palette(&[0, 1]), palette(&[1, 0])];
        assert_eq!(Colours::of(shown, Sample::U16).unwrap_err(), [0, 1]);
    }

    #[test]
    fn colours_stand_for_values() {
        let shown = vec![
            palette(&[0, 9]),
            Arc::new(Shown::Palette(vec![[9, 9, 9, 255], [1, 2, 3, 0]])),
        ];
        let colours = Colours::of(shown, Sample::U8).unwrap().unwrap();
        assert_eq!(colours.first(0), "0:0:0, 9:9:9");
        let mut page = vec![1, 0];
        colours.show(0, &mut page).unwrap();
        assert_eq!(page, [9, 9, 9, 0, 0, 0]);
        assert!(
            colours
                .show(0, &mut vec![2])
                .unwrap_err()
                .contains("2 colours")
        );
        assert!(
            colours
                .show(1, &mut vec![1])
                .unwrap_err()
                .contains("transparent")
        );
    }
}
