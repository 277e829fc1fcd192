//! Pictures as `bond-figures` draws them, put into the page as they are.

use crate::html::{base64, escape};
use crate::{Error, Labelled, read};

/// What one picture may have: a page of many would no longer open.
const MOST_BYTES: u64 = 16 << 20;

/// An SVG or PNG picture.
pub struct Picture {
    caption: String,
    kind: &'static str,
    bytes: Vec<u8>,
}

impl Picture {
    /// Reads a picture.
    ///
    /// # Errors
    /// An unreadable file, or one that is neither SVG nor PNG.
    pub fn read(file: &Labelled) -> Result<Self, Error> {
        let bytes = read(&file.path, MOST_BYTES)?;
        let begins = |with: &[u8]| bytes.trim_ascii_start().starts_with(with);
        let kind = match () {
            () if bytes.starts_with(b"\x89PNG\r\n\x1a\n") => "image/png",
            () if begins(b"<svg") || begins(b"<?xml") => "image/svg+xml",
            () => {
                return Err(Error(format!(
                    "'{}' is neither an SVG nor a PNG picture",
                    file.path.display()
                )));
            }
        };
        Ok(Self {
            caption: file.label.clone(),
            kind,
            bytes,
        })
    }

    /// The picture as HTML. As an image an SVG runs no script and loads nothing.
    pub(crate) fn to_html(&self) -> String {
        let caption = escape(&self.caption);
        format!(
            "<figure><img alt=\"{caption}\" src=\"data:{};base64,{}\">\n<figcaption>{caption}</figcaption></figure>\n",
            self.kind,
            base64(&self.bytes)
        )
    }
}
