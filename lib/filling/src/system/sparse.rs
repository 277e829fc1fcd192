//! Values of many places of which most have none or the same one.

use rayon::prelude::*;

use super::CHUNK;

/// In [`Sparse::number`]: no value.
const NONE: u32 = u32::MAX;
/// In [`Sparse::number`]: the common value.
const COMMON: u32 = NONE - 1;

/// A value, the common one or none for each place.
pub(super) struct Sparse<T> {
    /// Of each place: the number of its value among those of its chunk, [`COMMON`] or [`NONE`].
    number: Vec<u32>,
    chunks: Vec<Vec<T>>,
    common: T,
}

impl<T: Copy + PartialEq + Send + Sync> Sparse<T> {
    /// The values of the places `0..len` as `find` gives them.
    pub(super) fn new(len: usize, common: T, find: impl Fn(usize) -> Option<T> + Sync) -> Self {
        let mut number = vec![NONE; len];
        let chunks = (number.par_chunks_mut(CHUNK).enumerate())
            .map(|(chunk, numbers)| {
                let mut values = Vec::new();
                for (n, number) in numbers.iter_mut().enumerate() {
                    match find(chunk * CHUNK + n) {
                        None => {}
                        Some(value) if value == common => *number = COMMON,
                        Some(value) => {
                            *number = values.len() as u32;
                            values.push(value);
                        }
                    }
                }
                values
            })
            .collect();
        Self {
            number,
            chunks,
            common,
        }
    }

    /// The value of a place.
    #[inline]
    pub(super) fn at(&self, place: usize) -> Option<&T> {
        match self.number[place] {
            NONE => None,
            COMMON => Some(&self.common),
            number => Some(&self.chunks[place / CHUNK][number as usize]),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_place_has_the_value_found_for_it() {
        let find =
            |n: usize| (!n.is_multiple_of(3)).then_some(if n.is_multiple_of(2) { 7 } else { n });
        let places = 0..3 * CHUNK + 5;
        let sparse = Sparse::new(places.len(), 7, find);
        for place in places.clone() {
            assert_eq!(sparse.at(place).copied(), find(place));
        }
        let own = places.filter(|&n| find(n).is_some_and(|value| value != 7));
        assert_eq!(sparse.chunks.concat(), own.collect::<Vec<_>>());
    }
}
