//! One clear series of slices, in the order of the numbers in their names.

use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;

use crate::names::{self, Name, ONE};
use crate::source::quoted;

/// Slices in order.
#[derive(Debug)]
pub(crate) struct Series {
    pub(crate) slices: Vec<PathBuf>,
    /// A sentence about slices that seem to be missing.
    pub(crate) gap: Option<String>,
}

/// Slices in the order of a number in their names.
struct Order {
    slices: Vec<usize>,
    /// In units of the ninth decimal.
    numbers: Vec<i128>,
    /// The unit of the last decimal that is written.
    unit: i128,
    /// No other number in the names differs.
    alone: bool,
}

/// Two slices that are not of one series.
struct Odd {
    slices: [usize; 2],
    why: &'static str,
}

impl Series {
    /// Puts slices in the order of the one number in which their names differ, or of several that grow together in
    /// even steps. A dot between digits is a decimal point where the numbers come in even steps only then.
    /// Where all are not one clear series, the sentence names two slices that are not.
    pub(crate) fn of(slices: Vec<PathBuf>) -> Result<Self, String> {
        if slices.len() < 2 {
            return Ok(Self { slices, gap: None });
        }
        let [plain, pointed] = [false, true].map(|points| names::read(&slices, points));
        let fewer = names::texts(&pointed).len() < names::texts(&plain).len();
        let odd = match [plain, pointed].map(|names| Order::of(&names)) {
            [Ok(order), _] | [_, Ok(order)] if order.is_even() => return Ok(order.sort(&slices)),
            [Ok(plain), Ok(pointed)] if plain.slices != pointed.slices => plain.turned(&pointed),
            [Ok(order), _] if order.alone && order.numbers[0] >= 0 => match order.parted() {
                Some(odd) => odd,
                None => return Ok(order.sort(&slices)),
            },
            [Ok(order), _] | [Err(_), Ok(order)] => order.uneven(),
            [Err(_), Err(pointed)] if fewer => pointed,
            [Err(odd), Err(_)] => odd,
        };
        let [a, b] = odd.slices.map(|i| quoted(&slices[i]));
        Err(format!(
            "{a} and {b} are not of one clear series of slices: {}; accepted are names that differ in one number: move away what is no slice, or rename the slices",
            odd.why
        ))
    }
}

impl Order {
    /// The order by the number that tells most slices apart, in even steps if there is a choice.
    fn of(names: &[Name]) -> Result<Self, Odd> {
        let texts = names::texts(names);
        if texts.len() > 1 {
            return Err(Odd::of_texts(names, &texts));
        }
        let differs = |k: &usize| names.iter().any(|n| n.numbers[*k] != names[0].numbers[*k]);
        let columns: Vec<usize> = (0..names[0].numbers.len()).filter(differs).collect();
        let decimals = names.iter().map(|n| n.decimals).max().unwrap_or(0);
        let by = |&key: &usize| {
            let mut slices: Vec<usize> = (0..names.len()).collect();
            slices.sort_by_key(|&i| (names[i].numbers[key], &names[i].numbers));
            let order = Self {
                numbers: slices.iter().map(|&i| names[i].numbers[key]).collect(),
                slices,
                unit: ONE / 10_i128.pow(decimals as u32),
                alone: columns.len() == 1,
            };
            let distinct: BTreeSet<_> = order.numbers.iter().collect();
            ((distinct.len(), order.is_even()), key, order)
        };
        let best = columns.iter().map(by).max_by_key(|(rank, ..)| *rank);
        let same = |slices| {
            let why = "they have the same number";
            Odd { slices, why }
        };
        let (_, key, order) = best.ok_or(same([0, 1]))?;
        // The others may be a date, whose parts grow one after the other.
        let others = |numbers: &[i128]| [&numbers[..key], &numbers[key + 1..]].concat();
        for pair in order.slices.windows(2) {
            let slices = [pair[0], pair[1]];
            let [a, b] = slices.map(|i| &names[i].numbers);
            if a == b {
                return Err(same(slices));
            }
            if a[key] == b[key] || others(a) > others(b) {
                let why = "more than one number in their names counts";
                return Err(Odd { slices, why });
            }
        }
        Ok(order)
    }

    fn steps(&self) -> impl Iterator<Item = i128> {
        self.numbers.windows(2).map(|pair| pair[1] - pair[0])
    }

    /// Whether the numbers come in even steps, but for the rounding of long decimals.
    fn is_even(&self) -> bool {
        let least = self.steps().min().unwrap_or(0);
        let most = self.steps().max().unwrap_or(0);
        let long = self.unit < ONE && least >= 10 * self.unit;
        least > 0 && most - least <= if long { self.unit } else { 0 }
    }

    fn sort(&self, slices: &[PathBuf]) -> Series {
        let slices: Vec<_> = self.slices.iter().map(|&i| slices[i].clone()).collect();
        let gap = self.gap(&slices);
        Series { slices, gap }
    }

    /// The least step, how many differ from it, and the place of the first that does.
    fn gaps(&self) -> Option<(i128, usize, usize)> {
        let even = self.steps().min()?;
        let mut gaps = (self.steps().enumerate()).filter(|(_, step)| *step != even);
        let (first, _) = gaps.next()?;
        Some((even, 1 + gaps.count(), first))
    }

    /// The first gap in what is else counted evenly. What is not in at least half of its steps, such as times, has no
    /// gaps.
    fn gap(&self, slices: &[PathBuf]) -> Option<String> {
        if self.is_even() {
            return None;
        }
        let (even, gaps, at) = self.gaps()?;
        let [before, behind] = [at, at + 1].map(|i| quoted(&slices[i]));
        (2 * gaps < slices.len()).then(|| {
            format!(
                "the slices are numbered in steps of {}, but between {before} and {behind} it is {}{}: the stack is read as if nothing were missing",
                even / ONE,
                (self.numbers[at + 1] - self.numbers[at]) / ONE,
                match gaps {
                    1 => String::new(),
                    n => format!(", and at {} more places", n - 1),
                }
            )
        })
    }

    /// The slices about a gap in what is else counted evenly in which more would be missing than there are: those behind it are
    /// another series, or a copy.
    fn parted(&self) -> Option<Odd> {
        let (even, gaps, _) = self.gaps().filter(|(even, ..)| *even > 0)?;
        let (at, widest) = self.steps().enumerate().max_by_key(|step| step.1)?;
        let missing = widest / even - 1;
        let slices = self.slices.len();
        let why = "more would be missing between them than there are";
        (2 * gaps < slices && missing > slices as i128).then(|| self.about(at, why))
    }

    /// The slices about the first step that is unlike the shortest.
    fn uneven(&self) -> Odd {
        let at = self.gaps().map_or(0, |(.., first)| first);
        self.about(at, "the numbers do not go on there in even steps")
    }

    fn about(&self, at: usize, why: &'static str) -> Odd {
        let slices = [self.slices[at], self.slices[at + 1]];
        Odd { slices, why }
    }

    /// The slices whose places depend on what a dot is.
    fn turned(&self, pointed: &Self) -> Odd {
        let places = self.slices.iter().zip(&pointed.slices);
        let turned = places.map(|(a, b)| [*a, *b]).find(|[a, b]| a != b);
        Odd {
            slices: turned.unwrap_or([0, 1]),
            why: "which comes first depends on whether a dot is a decimal point",
        }
    }
}

impl Odd {
    /// A slice of the rarest text and the one of the most frequent text that is most alike.
    fn of_texts(names: &[Name], texts: &BTreeMap<&str, Vec<usize>>) -> Self {
        let size = |slices: &&Vec<usize>| slices.len();
        let few = texts.values().min_by_key(size).map_or(0, |few| few[0]);
        let alike = |&i: &usize| {
            let numbers = names[i].numbers.iter().zip(&names[few].numbers);
            numbers.take_while(|(a, b)| a == b).count()
        };
        let many = texts.values().max_by_key(size);
        let many = many.and_then(|slices| slices.iter().copied().rev().max_by_key(alike));
        Self {
            slices: [few, many.unwrap_or(0)],
            why: "their names differ in more than a number",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(names: &[&str]) -> Result<Series, String> {
        Series::of(names.iter().map(PathBuf::from).collect())
    }

    /// Names given in their right order are put in it, whatever order they came in; what is missing among them.
    fn assert_order(right: &[&str]) -> Option<String> {
        let mut given = right.to_vec();
        given.sort_unstable();
        let series = of(&given).unwrap();
        let found: Vec<_> = series.slices.iter().map(|p| p.to_str().unwrap()).collect();
        assert_eq!(found, right);
        series.gap
    }

    /// In any order, slices are put in the right one, or two that are of no clear series are told.
    #[test]
    fn names_are_a_series_or_not() {
        let rows = include_str!("series.txt").lines();
        for row in rows.filter(|row| !row.is_empty() && !row.starts_with('#')) {
            let (names, odd) = row.split_once(" > ").unwrap_or((row, ""));
            let names: Vec<&str> = names.split(", ").collect();
            let Some((a, b)) = odd.split_once(", ") else {
                assert_eq!(assert_order(&names), None, "{row}");
                continue;
            };
            let said = of(&names).unwrap_err();
            let either = [format!("'{a}' and '{b}'"), format!("'{b}' and '{a}'")];
            assert!(either.iter().any(|pair| said.starts_with(pair)), "{said}");
        }
    }

    #[test]
    fn a_slice_that_is_missing_is_missed() {
        let said = assert_order(&["s_08.tif", "s_09.tif", "s_12.tif", "s_13.tif"]).unwrap();
        assert!(
            said.contains("'s_09.tif' and 's_12.tif' it is 3:"),
            "{said}"
        );
        let said = assert_order(&["s1", "s3", "s5", "s9", "s11", "s15", "s17"]).unwrap();
        for part in ["steps of 2", "1 more places"] {
            assert!(said.contains(part), "{said}");
        }
        assert_order(&["scan-1", "scan-2", "scan-4", "scan-5"]).unwrap();
    }
}
