//! Which cell of a row a refusal is about.

/// The column of the change that keeps a row from being accepted: the one that is refused alone,
/// or without which the rest is accepted. None where it is no single one, or the case itself.
///
/// `changes` are columns and what they change, `accepts` tells whether a case so changed is.
pub fn column(
    changes: &[(usize, String)],
    accepts: impl Fn(&[&(usize, String)]) -> bool,
) -> Option<usize> {
    let alone = || {
        let refused = |change: &&(usize, String)| !accepts(&[*change]);
        accepts(&[]).then(|| changes.iter().find(refused)).flatten()
    };
    let needless = |change: &&(usize, String)| {
        let rest: Vec<_> = changes.iter().filter(|other| other != change).collect();
        accepts(&rest)
    };
    let found = alone().or_else(|| changes.iter().find(needless));
    found.map(|(column, _)| *column)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_change_refused_alone_or_in_company_is_found() {
        let changes: Vec<_> = [(3, "a"), (5, "b"), (7, "c")]
            .map(|(i, what)| (i, what.to_owned()))
            .to_vec();
        let has = |given: &[&(usize, String)], what: &str| given.iter().any(|c| c.1 == what);
        assert_eq!(column(&changes, |given| !has(given, "b")), Some(5));
        // Each is accepted alone, two of them together are not.
        let pair = |given: &[&(usize, String)]| !(has(given, "a") && has(given, "c"));
        assert_eq!(column(&changes, pair), Some(3));
        // A case that needs a change is not refused for it.
        let needs = |given: &[&(usize, String)]| has(given, "a") && !has(given, "c");
        assert_eq!(column(&changes, needs), Some(7));
        assert_eq!(column(&changes, |_| false), None);
    }
}
