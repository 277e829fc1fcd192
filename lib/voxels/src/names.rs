//! The numbers in the names of slices.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// A decimal that ends in the ninth place, and the digits before it: longer numbers are text.
const DECIMALS: usize = 9;
const DIGITS: usize = 24;
/// One, in units of the ninth decimal.
pub(crate) const ONE: i128 = 10_i128.pow(DECIMALS as u32);
/// Stands for a number in the text of a name.
const MARK: char = '\0';

/// A name without its ending: its text, with a mark for each number, and the numbers.
#[derive(Debug)]
pub(crate) struct Name {
    pub(crate) text: String,
    /// In units of the ninth decimal.
    pub(crate) numbers: Vec<i128>,
    /// Most decimals of a number.
    pub(crate) decimals: usize,
}

/// The names of `slices`, in which a dot between digits may be a decimal point. A hyphen that no digit precedes is a
/// sign where fewer texts then differ, as in z-1, z0, z1.
pub(crate) fn read(slices: &[PathBuf], decimals: bool) -> Vec<Name> {
    let read = |signs| -> Vec<Name> {
        let names = slices.iter().map(|path| Name::read(path, signs, decimals));
        names.collect()
    };
    let [plain, signed] = [false, true].map(read);
    match texts(&signed).len() < texts(&plain).len() {
        true => signed,
        false => plain,
    }
}

/// The slices of each text.
pub(crate) fn texts(names: &[Name]) -> BTreeMap<&str, Vec<usize>> {
    let mut texts: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
    for (i, name) in names.iter().enumerate() {
        texts.entry(&name.text).or_default().push(i);
    }
    texts
}

impl Name {
    fn read(path: &Path, signs: bool, decimals: bool) -> Self {
        let ending = path.extension().unwrap_or_default().to_string_lossy();
        let stem = match ending.chars().all(|c| c.is_ascii_digit()) {
            true => path,
            false => &path.with_extension(""),
        };
        let stem = stem.to_string_lossy().to_lowercase();
        let mut name = Self {
            text: String::new(),
            numbers: Vec::new(),
            decimals: 0,
        };
        let mut rest = stem.as_str();
        while let Some(start) = rest.find(|c: char| c.is_ascii_digit()) {
            let (before, number) = rest.split_at(start);
            let (digits, behind) = split_digits(number);
            let point = behind.strip_prefix('.').filter(|_| decimals);
            let (fraction, behind) = match point.map(split_digits) {
                Some((fraction, behind)) if !fraction.is_empty() => (fraction, behind),
                _ => ("", behind),
            };
            let sign = before.strip_suffix('-');
            let sign =
                sign.filter(|text| signs && (!text.is_empty() || !name.text.ends_with(MARK)));
            // Numbers may be padded by blanks, too.
            name.text.push_str(sign.unwrap_or(before).trim_end());
            let digits = digits.trim_start_matches('0');
            match format!("0{digits}{fraction:0<DECIMALS$}").parse::<i128>() {
                Ok(units) if digits.len() <= DIGITS && fraction.len() <= DECIMALS => {
                    name.text.push(MARK);
                    name.numbers
                        .push(if sign.is_some() { -units } else { units });
                    name.decimals = name.decimals.max(fraction.len());
                }
                _ => name.text.push_str(&number[..number.len() - behind.len()]),
            }
            rest = behind;
        }
        name.text.push_str(rest);
        name
    }
}

/// The digits at the beginning of `text`, and what is behind them.
fn split_digits(text: &str) -> (&str, &str) {
    let end = text.find(|c: char| !c.is_ascii_digit());
    text.split_at(end.unwrap_or(text.len()))
}
