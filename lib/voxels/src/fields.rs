//! The fields of headers that are lines of text: MetaImage's and NRRD's.

/// Keys in lower case, values and numbers of lines.
pub(crate) struct Fields {
    fields: Vec<(String, String, usize)>,
    /// The byte behind the header.
    pub(crate) end: usize,
    /// Whether a line ended it, not the file.
    pub(crate) ended: bool,
}

impl Fields {
    /// The lines of `head`, a key and a value with a `sign` between them, up to the one that `ends` them; an empty line has
    /// neither. Comments, pairs with `:=` and NRRD's first line are passed over.
    pub(crate) fn read(
        head: &[u8],
        sign: char,
        ends: impl Fn(&str, &str) -> bool,
    ) -> Result<Self, String> {
        let (mut fields, mut end, mut ended) = (Vec::new(), 0, false);
        for (i, line) in head.split_inclusive(|b| *b == b'\n').enumerate() {
            end += line.len();
            let (text, line) = (String::from_utf8_lossy(line), i + 1);
            let text = text.trim();
            let passed = text.starts_with('#') || text.starts_with("NRRD000");
            if passed || text.contains(":=") {
                continue;
            }
            let (key, value) = match text.split_once(sign) {
                Some((key, value)) => (key.trim().to_lowercase(), value.trim().to_owned()),
                None if text.is_empty() => Default::default(),
                None => {
                    return Err(format!(
                        "line {line} of its header has no '{sign}' between a key and a value"
                    ));
                }
            };
            ended = ends(&key, &value);
            fields.push((key, value, line));
            if ended {
                break;
            }
        }
        Ok(Self { fields, end, ended })
    }

    /// The value of the first field with one of these names, and its line.
    pub(crate) fn get(&self, names: &[&str]) -> Option<(&str, usize)> {
        let is = |key: &str| names.iter().any(|name| key == name.to_lowercase());
        let found = self.fields.iter().find(|(key, ..)| is(key));
        found.map(|(_, value, line)| (value.as_str(), *line))
    }

    pub(crate) fn needed(&self, name: &str) -> Result<(&str, usize), String> {
        self.get(&[name])
            .ok_or_else(|| format!("its header has no {name}"))
    }
}

/// Whole numbers with blanks between them.
pub(crate) fn whole_numbers(text: &str) -> Option<Vec<usize>> {
    text.split_whitespace().map(|n| n.parse().ok()).collect()
}
