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

    /// The first colours, as labels.
    pub(crate) fn first(&self) -> String {
        const MOST: usize = 4;
        let mut labels: Vec<String> = (0..self.len().min(MOST))
            .filter_map(|value| self.colour(value))
            .map(|[r, g, b, _]| format!("{r}:{g}:{b}"))
            .collect();
        if self.len() > MOST {
            labels.push("...".into());
        }
        labels.join(", ")
    }

    /// The colours, as red, green and blue, in place of the stored values of a page.
    pub(crate) fn in_place_of(&self, page: &[u8]) -> Result<Vec<u8>, String> {
        let colours: Vec<_> = (0..=255).map(|value| self.colour(value)).collect();
        let mut rgb = Vec::with_capacity(3 * page.len());
        for &value in page {
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
                        self.len()
                    ));
                }
            }
        }
        Ok(rgb)
    }
}

/// Two pages on which a stored value, of type `sample`, shows two colours, so that their colours
/// are the labels; none where each value shows the same on all pages.
///
/// # Errors
/// Two such pages, where the pages have no colours to go by.
pub(crate) fn unlike(
    shown: &[Arc<Shown>],
    sample: Sample,
) -> Result<Option<[usize; 2]>, [usize; 2]> {
    let mut longest = 0;
    let odd = (0..shown.len()).find(|&i| {
        let agrees = shown[i].agrees(&shown[longest]);
        if agrees && shown[i].len() > shown[longest].len() {
            longest = i;
        }
        !agrees
    });
    let coloured = sample == Sample::U8 && shown.iter().all(|shown| shown.len() > 0);
    match odd.map(|odd| [longest, odd]) {
        Some(unlike) if !coloured => Err(unlike),
        unlike => Ok(unlike),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn palette(greys: &[u8]) -> Arc<Shown> {
        Arc::new(Shown::opaque(greys.iter().map(|&g| [g; 3])))
    }

    #[test]
    fn palettes_without_their_unused_ends_agree() {
        let grey = |bits, inverted| Arc::new(Shown::Grey { bits, inverted });
        let other = |code| Arc::new(Shown::Other(code));
        for (shown, sample, right) in [
            (
                vec![palette(&[0, 9]), palette(&[0, 9, 7]), palette(&[0])],
                Sample::U8,
                Ok(None),
            ),
            (
                vec![palette(&[0, 1, 2]), grey(8, false)],
                Sample::U8,
                Ok(None),
            ),
            (
                vec![palette(&[255, 0]), grey(1, true)],
                Sample::U8,
                Ok(None),
            ),
            // The first two pages do not tell which of the others is odd.
            (
                [&[0][..], &[0, 9], &[0], &[0, 7]].map(palette).to_vec(),
                Sample::U8,
                Ok(Some([1, 3])),
            ),
            (
                vec![grey(1, false), grey(8, false)],
                Sample::U8,
                Ok(Some([0, 1])),
            ),
            (
                vec![grey(8, false), grey(8, false), grey(8, true)],
                Sample::U8,
                Ok(Some([0, 2])),
            ),
            // What has no colours cannot be told by them.
            (vec![other(0), other(0)], Sample::U16, Ok(None)),
            (vec![other(1), other(0)], Sample::F32, Err([0, 1])),
            (
                vec![palette(&[0, 1]), palette(&[1, 0])],
                Sample::U16,
                Err([0, 1]),
            ),
        ] {
            assert_eq!(unlike(&shown, sample), right, "{shown:?}");
        }
    }

    #[test]
    fn colours_stand_for_values() {
        let shown = palette(&[0, 9]);
        assert_eq!(shown.first(), "0:0:0, 9:9:9");
        assert_eq!(shown.in_place_of(&[1, 0]), Ok(vec![9, 9, 9, 0, 0, 0]));
        let clear = Shown::Palette(vec![[9, 9, 9, 255], [1, 2, 3, 0]]);
        for (shown, value, said) in [(&*shown, 2, "2 colours"), (&clear, 1, "transparent")] {
            assert!(shown.in_place_of(&[value]).unwrap_err().contains(said));
        }
    }
}
