//! Constants read at run time, put into a copy of a crate by constants.sh: the variable
//! CONSTANT="crate/file/NAME=VALUE" changes one, VALUE being a factor, "x0.5", or numbers, "3,8".

use std::ops::Range;

/// The constant `key` of `value`, changed where CONSTANT names it.
pub(crate) fn of<T: Tuned>(key: &str, value: T) -> T {
    let all = std::env::var("CONSTANT").unwrap_or_default();
    match all.split_once('=') {
        Some((name, change)) if name == key => match change.strip_prefix('x') {
            Some(factor) => value.with(&mut |old| old * factor.parse::<f64>().unwrap()),
            None => {
                let mut numbers = change.split(',').map(|x| x.parse().unwrap());
                value.with(&mut |_| numbers.next().unwrap())
            }
        },
        _ => value,
    }
}

/// What constants are.
pub(crate) trait Tuned: Sized {
    /// The same with `change` made to each number.
    fn with(self, change: &mut dyn FnMut(f64) -> f64) -> Self;
}

macro_rules! numbers {
    ($($kind:ty, $least:expr;)*) => {$(
        impl Tuned for $kind {
            fn with(self, change: &mut dyn FnMut(f64) -> f64) -> Self {
                let value = change(self as f64);
                match $least {
                    Some(least) => value.round().max(least) as $kind,
                    None => value as $kind,
                }
            }
        }
    )*};
}
numbers! { f32, None::<f64>; f64, None::<f64>; u32, Some(1.0); u64, Some(1.0); usize, Some(1.0); }

impl<T: Tuned, const N: usize> Tuned for [T; N] {
    fn with(self, change: &mut dyn FnMut(f64) -> f64) -> Self {
        self.map(|value| value.with(change))
    }
}

impl<T: Tuned> Tuned for Range<T> {
    fn with(self, change: &mut dyn FnMut(f64) -> f64) -> Self {
        self.start.with(change)..self.end.with(change)
    }
}
