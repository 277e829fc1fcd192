//! The embedded font: the glyphs that a drawing has, as a font of their own.

use std::collections::BTreeMap;

use pdf_writer::types::{CidFontType, FontFlags, SystemInfo, UnicodeCmap};
use pdf_writer::{Filter, Finish, Name, Pdf, Rect, Str};
use skrifa::instance::{LocationRef, Size};
use skrifa::{FontRef, GlyphId, MetadataProvider};
use subsetter::GlyphRemapper;

use super::{CID_FONT, DESCRIPTOR, FONT_FILE, TYPE0, UNICODE, packed};
use crate::Error;
use crate::measure::EM;
use crate::replay::failed;

const FONT_NAME: Name = Name(b"BNDLNE+DejaVuSans");
const CID: SystemInfo = SystemInfo {
    registry: Str(b"Adobe"),
    ordering: Str(b"Identity"),
    supplement: 0,
};

/// The glyphs of the embedded font that the drawing's text has.
pub(super) struct Glyphs {
    font: FontRef<'static>,
    used: GlyphRemapper,
    /// Character and advance (em / 1000) of each glyph used, by its new number.
    named: BTreeMap<u16, (char, f32)>,
    /// Height of the capitals, em.
    pub(super) capitals: f64,
}

impl Glyphs {
    pub(super) fn new() -> Result<Self, Error> {
        let font = FontRef::new(dejavu::sans::regular()).map_err(failed)?;
        let metrics = font.metrics(Size::new(1.0), LocationRef::default());
        Ok(Self {
            used: GlyphRemapper::new(),
            named: BTreeMap::new(),
            capitals: f64::from(metrics.cap_height.unwrap_or(0.73)),
            font,
        })
    }

    /// The text as numbers of glyphs, and its width in the unit of `size`.
    pub(super) fn encode(&mut self, text: &str, size: f64) -> (Vec<u8>, f64) {
        let size_of_one = Size::new(1.0);
        let advances = (self.font).glyph_metrics(size_of_one, LocationRef::default());
        let (mut codes, mut width) = (Vec::new(), 0.0);
        for c in text.chars() {
            let glyph = self.font.charmap().map(c).unwrap_or(GlyphId::NOTDEF);
            let advance = advances.advance_width(glyph).unwrap_or(0.0);
            // The font has fewer than 2^16 glyphs.
            let new = self.used.remap(glyph.to_u32() as u16);
            self.named.entry(new).or_insert((c, 1000.0 * advance));
            codes.extend(new.to_be_bytes());
            width += EM * size * f64::from(advance);
        }
        (codes, width)
    }

    pub(super) fn write(&self, pdf: &mut Pdf) -> Result<(), Error> {
        let mut font = pdf.type0_font(TYPE0);
        font.base_font(FONT_NAME);
        font.encoding_predefined(Name(b"Identity-H"));
        font.descendant_font(CID_FONT).to_unicode(UNICODE);
        font.finish();
        let mut cid = pdf.cid_font(CID_FONT);
        cid.subtype(CidFontType::Type2).base_font(FONT_NAME);
        cid.system_info(CID);
        cid.font_descriptor(DESCRIPTOR).default_width(0.0);
        cid.cid_to_gid_map_predefined(Name(b"Identity"));
        let mut widths = cid.widths();
        for (glyph, (_, advance)) in &self.named {
            widths.consecutive(*glyph, [*advance]);
        }
        widths.finish();
        cid.finish();
        let metrics = self.font.metrics(Size::new(1000.0), LocationRef::default());
        let bounds = metrics.bounds.unwrap_or_default();
        let mut descriptor = pdf.font_descriptor(DESCRIPTOR);
        descriptor.name(FONT_NAME).flags(FontFlags::NON_SYMBOLIC);
        descriptor.italic_angle(0.0);
        let [left, low] = [bounds.x_min, bounds.y_min];
        descriptor.bbox(Rect::new(left, low, bounds.x_max, bounds.y_max));
        descriptor.ascent(metrics.ascent).descent(metrics.descent);
        descriptor.cap_height(1000.0 * self.capitals as f32);
        descriptor.stem_v(90.0).font_file2(FONT_FILE);
        descriptor.finish();
        let names = self.named.iter().filter(|(glyph, _)| **glyph > 0);
        let mut unicode = UnicodeCmap::<u16>::new(Name(b"Text"), CID);
        names.for_each(|(glyph, (c, _))| unicode.pair(*glyph, *c));
        pdf.cmap(UNICODE, &unicode.finish());
        let subset = subsetter::subset(dejavu::sans::regular(), 0, &self.used).map_err(failed)?;
        let data = packed(&subset)?;
        let mut file = pdf.stream(FONT_FILE, &data);
        file.filter(Filter::FlateDecode);
        file.pair(Name(b"Length1"), subset.len() as i32);
        Ok(())
    }
}
