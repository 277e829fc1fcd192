//! How much room text takes in the embedded font.

use std::collections::BTreeSet;

use skrifa::instance::{LocationRef, Size};
use skrifa::{FontRef, GlyphId, MetadataProvider};

/// The em of a font over the size by which plotters names it, so that text is as large in a
/// PNG as in an SVG.
pub(crate) const EM: f64 = 1.0 / 1.24;

/// What text reaches above and below the middle of its capitals, in sizes: brackets and
/// descenders of DejaVu Sans.
pub(crate) const ABOVE: f64 = 0.40 * EM;
pub(crate) const BELOW: f64 = 0.60 * EM;
/// From one line of text to the next, in sizes.
pub(crate) const LINE: f64 = 1.2;

/// The largest of lengths, or zero.
pub(crate) fn highest(lengths: impl IntoIterator<Item = f64>) -> f64 {
    lengths.into_iter().fold(0.0, f64::max)
}

/// The characters of texts that pictures of the embedded font do not show as they are written, each once: it lacks them, or they
/// belong to a script from right to left, whose letters would stand alone and in reverse.
pub fn undrawn<'a>(texts: impl IntoIterator<Item = &'a str>) -> String {
    let Ok(font) = FontRef::new(dejavu::sans::regular()) else {
        return String::new();
    };
    let glyphs = font.charmap();
    let leftwards =
        |c| matches!(c, '\u{590}'..='\u{8ff}' | '\u{fb1d}'..='\u{fdff}' | '\u{fe70}'..='\u{fefe}');
    let characters = texts.into_iter().flat_map(str::chars);
    let odd = characters.filter(|c| !c.is_control() && (glyphs.map(*c).is_none() || leftwards(*c)));
    odd.collect::<BTreeSet<char>>().into_iter().collect()
}

/// Width of a line of text of the embedded font, in the unit of `size`.
pub(crate) fn width(text: &str, size: f64) -> f64 {
    let Ok(font) = FontRef::new(dejavu::sans::regular()) else {
        return 0.0;
    };
    let em = Size::new((EM * size) as f32);
    let advances = font.glyph_metrics(em, LocationRef::default());
    let glyphs = font.charmap();
    let advance = |c| advances.advance_width(glyphs.map(c).unwrap_or(GlyphId::NOTDEF));
    let widths = text.chars().filter_map(advance);
    widths.map(f64::from).sum()
}

/// The text in one line of at most `room`, with an ellipsis in its middle where it is longer.
pub(crate) fn shortened(text: &str, size: f64, room: f64) -> String {
    if width(text, size) <= room {
        return text.into();
    }
    let letters: Vec<char> = text.chars().collect();
    let kept = |count: usize| -> String {
        let (head, tail) = letters.split_at(count.div_ceil(2));
        let tail = &tail[tail.len() - count / 2..];
        head.iter().chain(&['…']).chain(tail).collect()
    };
    let counts: Vec<usize> = (0..letters.len()).collect();
    let fit = counts.partition_point(|&count| width(&kept(count), size) <= room);
    kept(fit.saturating_sub(1))
}

/// The text in at most `most` lines of at most `room`, broken at blanks where it has some; an
/// ellipsis stands in the last line where it has more.
pub(crate) fn lines(text: &str, size: f64, room: f64, most: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    // A blank that does not break is part of a word.
    let blank = |c: char| c.is_whitespace() && c != '\u{a0}';
    let mut words = text.split(blank).filter(|word| !word.is_empty()).peekable();
    while words.peek().is_some() {
        if lines.len() + 1 == most {
            let rest: Vec<&str> = words.collect();
            lines.push(shortened(&rest.join(" "), size, room));
            break;
        }
        let mut line = String::new();
        while let Some(word) = words.peek() {
            let longer = match line.as_str() {
                "" => (*word).to_owned(),
                line => format!("{line} {word}"),
            };
            if !line.is_empty() && width(&longer, size) > room {
                break;
            }
            line = longer;
            words.next();
        }
        lines.push(shortened(&line, size, room));
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    /// DejaVu Sans: H advances by 0.752 em, a blank by 0.318 em.
    #[test]
    fn widths_are_those_of_the_font() {
        let em = EM * 20.0;
        assert!((width("HH H", 20.0) - (3.0 * 0.752 + 0.3179) * em).abs() < 0.1);
        assert_eq!(width("", 20.0), 0.0);
    }

    #[test]
    fn text_that_the_font_does_not_show_is_named() {
        let texts = ["WP, µm²: 10⁻³ Ωβ", "Fichte 木材 木", "سمغ a"];
        assert_eq!(undrawn(texts), "سغم木材");
        assert_eq!(undrawn(["Buche, Привет, ±…"]), "");
    }

    #[test]
    fn text_is_broken_at_blanks_and_shortened_where_nothing_else_helps() {
        let room = width("partial slip,", 15.0) + 0.1;
        let broken = lines("partial slip, XPIC(5)", 15.0, room, 3);
        assert_eq!(broken, ["partial slip,", "XPIC(5)"]);
        let word = lines(&"x".repeat(300), 15.0, room, 3);
        assert_eq!(word.len(), 1);
        assert!(word[0].contains('…') && width(&word[0], 15.0) <= room);
        let many = lines(&"word ".repeat(300), 15.0, room, 3);
        assert_eq!(many.len(), 3);
        assert!(many.iter().all(|line| width(line, 15.0) <= room));
        assert!(many[2].starts_with("wo") && many[2].contains('…'));
        assert!(lines("", 15.0, room, 3).is_empty());
        assert_eq!(shortened("abc", 15.0, 0.0), "…");
    }
}
