//! The colours of series and scales.

use plotters::style::RGBAColor;

/// Categorical colours that people with any colour vision tell apart: Okabe and Ito, "Color
/// universal design" (2008), without the yellow that is faint on white.
const SERIES: [[u8; 3]; 7] = [
    [0, 114, 178],
    [213, 94, 0],
    [0, 158, 115],
    [0, 0, 0],
    [204, 121, 167],
    [86, 180, 233],
    [230, 159, 0],
];

/// Colour of the i-th series.
pub(crate) fn series(i: usize) -> RGBAColor {
    opaque(SERIES[i % SERIES.len()])
}

/// How many series have a colour of their own.
pub(crate) const DISTINCT: usize = SERIES.len();

pub(crate) const BLACK: RGBAColor = RGBAColor(0, 0, 0, 1.0);
/// Grid lines.
pub(crate) const FAINT: RGBAColor = RGBAColor(0, 0, 0, 0.12);
/// Places without data in a map.
pub(crate) const NO_DATA: [u8; 3] = [208, 208, 208];

pub(crate) fn opaque([r, g, b]: [u8; 3]) -> RGBAColor {
    RGBAColor(r, g, b, 1.0)
}

pub(crate) fn faded(colour: RGBAColor, opacity: f64) -> RGBAColor {
    RGBAColor(colour.0, colour.1, colour.2, opacity)
}

/// Viridis, a perceptually uniform scale that also reads in grey: 17 samples of the map of
/// S. van der Walt and N. Smith (matplotlib, CC0), interpolated; `share` from 0 to 1.
pub(crate) fn viridis(share: f64) -> [u8; 3] {
    let position = share.clamp(0.0, 1.0) * (VIRIDIS.len() - 1) as f64;
    let low = (position as usize).min(VIRIDIS.len() - 2);
    let part = position - low as f64;
    [0, 1, 2].map(|c| {
        let [a, b] = [VIRIDIS[low][c], VIRIDIS[low + 1][c]].map(f64::from);
        (a + part * (b - a)).round() as u8
    })
}

const VIRIDIS: [[u8; 3]; 17] = [
    [68, 1, 84],
    [72, 24, 106],
    [71, 45, 123],
    [66, 64, 134],
    [59, 82, 139],
    [51, 99, 141],
    [44, 114, 142],
    [38, 130, 142],
    [33, 145, 140],
    [31, 159, 136],
    [39, 173, 129],
    [61, 188, 116],
    [92, 200, 99],
    [129, 211, 77],
    [170, 220, 50],
    [213, 226, 26],
    [253, 231, 37],
];
