//! Pictures as `bond-figures` draws them, put into the page as they are.

use figures::{base64, check_origin};

use crate::html::escape;
use crate::{Error, Labelled, read};

/// What one picture may have: a page of many would no longer open.
const MOST_BYTES: u64 = 16 << 20;

/// An SVG or PNG picture as HTML. As an image an SVG runs no script and loads nothing.
///
/// # Errors
/// An unreadable file, or one that is neither SVG nor PNG; those of [`check_origin`].
pub fn picture(file: &Labelled) -> Result<String, Error> {
    check_origin(&file.path)?;
    let bytes = read(&file.path, MOST_BYTES)?;
    let begins = |with: &[u8]| bytes.trim_ascii_start().starts_with(with);
    let kind = match () {
        () if bytes.starts_with(b"\x89PNG\r\n\x1a\n") => "image/png",
        () if begins(b"<svg") || begins(b"<?xml") => "image/svg+xml",
        () => {
            return Err(Error::Data(format!(
                "'{}' is neither an SVG nor a PNG picture",
                file.path.display()
            )));
        }
    };
    let (caption, data) = (escape(&file.label), base64(&bytes));
    Ok(format!(
        "<figure><img alt=\"{caption}\" src=\"data:{kind};base64,{data}\">\n<figcaption>{caption}</figcaption></figure>\n"
    ))
}
