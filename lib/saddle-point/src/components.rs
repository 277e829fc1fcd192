//! Connected components of a graph.

/// The connected components of a graph with `n` nodes.
pub(crate) fn components<I: Iterator<Item = u32>>(
    n: usize,
    neighbours: impl Fn(u32) -> I,
) -> impl Iterator<Item = Vec<u32>> {
    let mut reached = vec![false; n];
    (0..n as u32).filter_map(move |first| {
        if std::mem::replace(&mut reached[first as usize], true) {
            return None;
        }
        let (mut found, mut next) = (vec![first], 0);
        while let Some(&row) = found.get(next) {
            next += 1;
            for row in neighbours(row) {
                if !std::mem::replace(&mut reached[row as usize], true) {
                    found.push(row);
                }
            }
        }
        Some(found)
    })
}
