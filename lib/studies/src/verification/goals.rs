//! Goals of the verification, for the page to say whether it reaches them.

use crate::lines;

/// A largest error for some of the runs.
pub(super) struct Goal {
    /// Beginnings of names of scenes, in words for the page.
    pub cases: &'static str,
    /// Whole words at the beginnings of names of scenes.
    prefixes: Vec<&'static str>,
    /// Label of the method, or "explicit" for every update.
    pub method: &'static str,
    /// Beginning of the quantity's name.
    pub quantity: &'static str,
    /// Largest error.
    pub limit: f64,
    /// Why it is out of reach, where it is.
    pub why: Option<&'static str>,
}

impl Goal {
    /// Whether a run of `scene` by the method of this label counts.
    pub(super) fn is_about(&self, scene: &str, label: &str) -> bool {
        let method = match self.method {
            "explicit" => !label.starts_with("implicit"),
            "implicit" => label.starts_with("implicit"),
            method => label == method,
        };
        // Whole words of the name: "off0" is not the beginning of "off0.25".
        let begins = |p: &str| {
            let rest = scene.strip_prefix(p);
            rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('-'))
        };
        method && self.prefixes.iter().any(|p| begins(p))
    }
}

/// The numbers the project set out to reach; a line has cases, beginnings of scenes, method, quantity, limit and, where it is
/// out of reach, why.
pub(super) fn goals() -> Vec<Goal> {
    lines::read(include_str!("goals.txt"), |line| {
        let mut parts = line.split(" | ");
        Some(vec![Goal {
            cases: parts.next()?,
            prefixes: parts.next()?.split(' ').collect(),
            method: parts.next()?,
            quantity: parts.next()?,
            limit: parts.next()?.parse().ok()?,
            why: parts.next(),
        }])
    })
}
