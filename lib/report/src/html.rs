//! Pieces of HTML.

use figures::fixed;

/// Text as HTML, inside of elements and of quoted attributes.
pub(crate) fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            // No page may hold others.
            c if c.is_control() && !matches!(c, '\n' | '\t') => out.push('\u{fffd}'),
            c => out.push(c),
        }
    }
    out
}

/// A table whose first column names its rows. Cells that are numbers are set to the right, and so are heads of nothing else.
pub(crate) fn table(caption: &str, headers: &[impl AsRef<str>], rows: &[Vec<String>]) -> String {
    let mut out = format!(
        "<div class=\"wide\" tabindex=\"0\" role=\"region\" aria-label=\"{0}\"><table><caption>{0}</caption>\n<thead><tr>",
        escape(caption)
    );
    let class = |right| if right { " class=\"number\"" } else { "" };
    for (i, header) in headers.iter().enumerate() {
        let mut column = rows.iter().filter_map(|row| row.get(i));
        let right = class(i > 0 && column.all(|cell| is_number(cell) || cell == "-"));
        out += &format!("<th scope=\"col\"{right}>{}</th>", escape(header.as_ref()));
    }
    out += "</tr></thead>\n<tbody>\n";
    for row in rows {
        out += "<tr>";
        for (i, cell) in row.iter().enumerate() {
            let text = escape(cell);
            out += &match i {
                0 => format!("<th scope=\"row\">{text}</th>"),
                _ => format!("<td{}>{text}</td>", class(is_number(cell))),
            };
        }
        out += "</tr>\n";
    }
    out + "</tbody></table></div>\n"
}

/// `7.8`, `7.8 um`, `7.8 ± 0.2`, `7.8 at the limit`, `2026-11-26`.
fn is_number(text: &str) -> bool {
    let words: Vec<&str> = text.split_whitespace().collect();
    let first = words.first().copied().unwrap_or_default();
    first.contains(|c: char| c.is_ascii_digit())
        && first
            .chars()
            .all(|c| c.is_ascii_digit() || "+-.e".contains(c))
        && (words.len() <= 2 || matches!(words[1], "\u{b1}" | "at"))
}

/// A number to four digits; a whole one whole.
pub(crate) fn rounded(number: f64) -> String {
    let size = number.abs();
    match () {
        () if number.fract() == 0.0 && size < 1e9 => fixed(number, 0),
        () if (1e-3..1e6).contains(&size) => {
            let decimals = (3.0 - size.log10().floor()).max(0.0) as usize;
            format!("{number:.decimals$}")
        }
        () => format!("{number:.3e}"),
    }
}

/// What opens at a click.
pub(crate) fn details(summary: &str, inside: &str) -> String {
    format!(
        "<details><summary>{}</summary>\n{inside}</details>\n",
        escape(summary)
    )
}

/// Text as it is.
pub(crate) fn verbatim(text: &str) -> String {
    format!("<pre tabindex=\"0\">{}</pre>\n", escape(text))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_given_cannot_leave_its_place() {
        let hostile = "<script>alert('1')</script>&\"\u{1b}";
        let harmless = "&lt;script&gt;alert(&#39;1&#39;)&lt;/script&gt;&amp;&quot;\u{fffd}";
        assert_eq!(escape(hostile), harmless);
        let table = table(hostile, &[hostile], &[vec![hostile.into()]]);
        assert!(!table.contains("<script") && table.matches("&lt;script").count() == 4);
    }

    #[test]
    fn numbers_stand_right_and_are_rounded() {
        for number in ["14.57 us", "5.78 ± 0.35", "2.50 at the limit", "2026-11-26"] {
            assert!(is_number(number), "{number}");
        }
        assert!(!is_number("1 m/s, at most 2.5 MPa") && !is_number(""));
        for (number, text) in [
            (7.801234, "7.801"),
            (-0.012345, "-0.01235"),
            (12288.0, "12288"),
            (-0.0, "0"),
            (9.2154e-5, "9.215e-5"),
        ] {
            assert_eq!(rounded(number), text);
        }
    }
}
