//! Names of the alternatives of a choice, the same in case files, tables and messages.

use std::mem::discriminant;

/// A choice whose alternatives have names.
pub trait Choice: Copy + 'static {
    /// The alternatives by name, in the order of messages. The number of an alternative that carries one is 0 here.
    const NAMED: &'static [(&'static str, Self)];

    /// The name of this alternative.
    fn name(self) -> &'static str {
        let own = |(_, other): &&(&str, Self)| discriminant(other) == discriminant(&self);
        Self::NAMED.iter().find(own).map_or("", |(name, _)| name)
    }

    /// The alternative that `word` names.
    ///
    /// # Errors
    /// A sentence with the accepted names.
    fn named(word: &str) -> Result<Self, String> {
        let found = Self::NAMED.iter().find(|(name, _)| *name == word);
        found.map(|(_, choice)| *choice).ok_or_else(|| {
            let names = Self::NAMED.iter().map(|(name, _)| format!("\"{name}\""));
            let names = names.collect::<Vec<_>>().join(", ");
            let (others, last) = names.rsplit_once(", ").unwrap_or_default();
            format!("'{word}' is not accepted: {others} or {last} is needed")
        })
    }
}
