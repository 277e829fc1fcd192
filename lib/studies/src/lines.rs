//! Tables of scenes and settings as text: a line has a name and `key=value,value`, of which all combinations are meant.

use std::cell::RefCell;

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
    /// Keys that were asked for.
    asked: RefCell<Vec<&'static str>>,
}

impl Values {
    /// All combinations, the last list's values next to one another.
    pub(crate) fn all(line: &'static str) -> Vec<Self> {
        let mut words = line.split(' ');
        let mut all = vec![Self {
            name: words.next().unwrap_or_default(),
            values: Vec::new(),
            asked: RefCell::default(),
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

    /// The first key that nothing has asked for: a slip, where a key has a default.
    pub(crate) fn stray(&self) -> Option<&'static str> {
        let asked = self.asked.borrow();
        let mut keys = self.values.iter().map(|(key, _)| *key);
        keys.find(|key| !asked.contains(key))
    }

    pub(crate) fn word(&self, key: &'static str) -> Option<&'static str> {
        self.asked.borrow_mut().push(key);
        let of = |(name, value): &(&str, &'static str)| (*name == key).then_some(*value);
        self.values.iter().find_map(of)
    }

    /// The number of a key; `none` is none.
    ///
    /// # Panics
    /// At another word.
    pub(crate) fn number(&self, key: &'static str) -> Option<f64> {
        let word = self.word(key).filter(|word| *word != "none")?;
        let number = word.parse();
        Some(number.unwrap_or_else(|_| panic!("{}: {key}={word} is no number", self.name)))
    }

    /// A text with the values in the places of their `{keys}`.
    pub(crate) fn within(&self, text: &str) -> String {
        let named = self.values.iter().map(|(key, _)| *key);
        let named = named.filter(|key| text.contains(&format!("{{{key}}}")));
        self.asked.borrow_mut().extend(named);
        crate::study::filled(text, &self.values)
    }
}
