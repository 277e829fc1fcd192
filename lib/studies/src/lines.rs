//! Tables of scenes and settings as text: a line has a name and `key=value,value`, of which all combinations are meant.

/// The lines of a table but for empty ones and remarks, each read by `of_line`.
///
/// # Panics
/// At a line that it cannot read: tables are part of the program.
pub(crate) fn read<T>(
    table: &'static str,
    of_line: impl Fn(&'static str) -> Option<Vec<T>>,
) -> Vec<T> {
    let lines = table
        .lines()
        .filter(|line| !line.is_empty() && !line.starts_with('#'));
    lines
        .flat_map(|line| of_line(line).unwrap_or_else(|| panic!("not a line of its table: {line}")))
        .collect()
}

/// The name of a line and one value of each of its lists.
#[derive(Clone)]
pub(crate) struct Values {
    pub(crate) name: &'static str,
    values: Vec<(&'static str, &'static str)>,
}

impl Values {
    /// All combinations, the last list's values next to one another.
    pub(crate) fn all(line: &'static str) -> Vec<Self> {
        let mut words = line.split(' ');
        let mut all = vec![Self {
            name: words.next().unwrap_or_default(),
            values: Vec::new(),
        }];
        for (key, list) in words.filter_map(|word| word.split_once('=')) {
            let with = |before: &Self, value| {
                let mut of = before.clone();
                of.values.push((key, value));
                of
            };
            let each = |before| list.split(',').map(move |value| with(before, value));
            all = all.iter().flat_map(each).collect();
        }
        all
    }

    pub(crate) fn word(&self, key: &str) -> Option<&'static str> {
        let of = |(name, value): &(&str, &'static str)| (*name == key).then_some(*value);
        self.values.iter().find_map(of)
    }

    pub(crate) fn number(&self, key: &str) -> Option<f64> {
        self.word(key)?.parse().ok()
    }

    /// A text with the values in the places of their `{keys}`.
    pub(crate) fn within(&self, text: &str) -> String {
        crate::study::filled(text, &self.values)
    }
}
