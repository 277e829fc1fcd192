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
    /// The colours of 0, 1, ...
    Palette(Vec<Colour>),
    /// Anything else, by its code in TIFF's tag 262.
    Other(u64),
}

impl Shown {
    /// Greys of more than 8 bits, from black.
    pub(crate) const GREY: Self = Self::Other(1);
    pub(crate) const RGB: Self = Self::Other(2);

    /// Greys, of values of at most 8 bits; where it is `inverted` 0 is white.
    pub(crate) fn grey(bits: u16, inverted: bool) -> Self {
        let level = |value: usize| (255 * value / ((1 << bits) - 1)) as u8;
        let levels = (0..1 << bits).map(level);
        Self::opaque(levels.map(|level| [if inverted { 255 - level } else { level }; 3]))
    }

    pub(crate) fn opaque(colours: impl Iterator<Item = [u8; 3]>) -> Self {
        Self::Palette(colours.map(|[r, g, b]| [r, g, b, OPAQUE]).collect())
    }

    /// The colours of 0, 1, ..., as far as they are known.
    fn colours(&self) -> &[Colour] {
        match self {
            Self::Palette(colours) => colours,
            Self::Other(_) => &[],
        }
    }

    /// Whether every value that both know shows the same: unused ends of palettes may be left out.
    fn agrees(&self, other: &Self) -> bool {
        let pairs = || self.colours().iter().zip(other.colours());
        self == other || pairs().len() > 0 && pairs().all(|(own, other)| own == other)
    }

    /// The first colours, as labels.
    pub(crate) fn first(&self) -> String {
        const MOST: usize = 4;
        let first = self.colours().iter().take(MOST);
        let mut labels: Vec<String> = first.map(|[r, g, b, _]| format!("{r}:{g}:{b}")).collect();
        if self.colours().len() > MOST {
            labels.push("...".into());
        }
        labels.join(", ")
    }

    /// The colours, as red, green and blue, in place of the stored values of a page.
    pub(crate) fn in_place_of(&self, page: &[u8]) -> Result<Vec<u8>, String> {
        let mut rgb = Vec::with_capacity(3 * page.len());
        for &value in page {
            match self.colours().get(usize::from(value)) {
                Some(&[r, g, b, OPAQUE]) => rgb.extend([r, g, b]),
                Some(_) => {
                    return Err(format!(
                        "the colour of its value {value} is transparent, which is no label: save it without transparency"
                    ));
                }
                None => {
                    return Err(format!(
                        "it holds {value}, but its palette has {} colours",
                        self.colours().len()
                    ));
                }
            }
        }
        Ok(rgb)
    }
}

/// Two pages on which a stored value, of type `sample`, shows two colours, so that their colours
/// are the labels; none where each value shows the same on all pages. Where there are no colours to go by
/// such pages are an error.
pub(crate) fn unlike(
    shown: &[Arc<Shown>],
    sample: Sample,
) -> Result<Option<[usize; 2]>, [usize; 2]> {
    let mut longest = 0;
    let odd = (0..shown.len()).find(|&i| {
        let agrees = shown[i].agrees(&shown[longest]);
        if agrees && shown[i].colours().len() > shown[longest].colours().len() {
            longest = i;
        }
        !agrees
    });
    let coloured = sample == Sample::U8 && shown.iter().all(|shown| !shown.colours().is_empty());
    match odd.map(|odd| [longest, odd]) {
        Some(unlike) if !coloured => Err(unlike),
        unlike => Ok(unlike),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn palettes_without_their_unused_ends_agree() {
        let p = |greys: &[u8]| Arc::new(Shown::opaque(greys.iter().map(|&g| [g; 3])));
        let grey = |bits, inverted| Arc::new(Shown::grey(bits, inverted));
        let other = |code| Arc::new(Shown::Other(code));
        for (shown, right) in [
            (vec![p(&[0, 9]), p(&[0, 9, 7]), p(&[0])], None),
            (vec![p(&[0, 1, 2]), grey(8, false)], None),
            (vec![p(&[255, 0]), grey(1, true)], None),
            // The first two pages do not tell which of the others is odd.
            (vec![p(&[0]), p(&[0, 9]), p(&[0]), p(&[0, 7])], Some([1, 3])),
            (vec![grey(1, false), grey(8, false)], Some([0, 1])),
            (vec![grey(8, false), grey(8, true)], Some([0, 1])),
        ] {
            assert_eq!(unlike(&shown, Sample::U8), Ok(right), "{shown:?}");
        }
        // What has no colours cannot be told by them.
        assert_eq!(unlike(&[other(0), other(0)], Sample::U16), Ok(None));
        assert_eq!(unlike(&[other(1), other(0)], Sample::F32), Err([0, 1]));
        let turned = [p(&[0, 1]), p(&[1, 0])];
        assert_eq!(unlike(&turned, Sample::U16), Err([0, 1]));
    }

    #[test]
    fn colours_stand_for_values() {
        let shown = Shown::Palette(vec![[9, 9, 9, OPAQUE], [0, 0, 0, OPAQUE], [1, 2, 3, 0]]);
        assert_eq!(shown.first(), "9:9:9, 0:0:0, 1:2:3");
        assert_eq!(shown.in_place_of(&[1, 0]), Ok(vec![0, 0, 0, 9, 9, 9]));
        for (value, said) in [(3, "3 colours"), (2, "transparent")] {
            assert!(shown.in_place_of(&[value]).unwrap_err().contains(said));
        }
    }
}
