//! Runs: points of a tile that follow one another and share their nearest node, and with it their window. What
//! kernels do once for a window they do once for a run.

use crate::lattice::HALO;

/// The end of the run that begins at point `start`, by the window bases of all points.
#[inline(always)]
pub(crate) fn run_end(bases: &[u16], start: usize) -> usize {
    let mut end = start + 1;
    while end < bases.len() && bases[end] == bases[start] {
        end += 1;
    }
    end
}

/// The order that makes one run of the points of each node, where moves have left more than one and a half
/// runs a node. By what the tile holds alone, so that a run which is continued sorts alike.
pub(crate) fn run_order(bases: &[u16]) -> Option<Vec<u32>> {
    let mut counts = [0_u32; HALO * HALO * HALO];
    let (mut runs, mut start) = (0, 0);
    while start < bases.len() {
        let end = run_end(bases, start);
        counts[usize::from(bases[start])] += (end - start) as u32;
        (runs, start) = (runs + 1, end);
    }
    let nodes = counts.iter().filter(|&&n| n > 0).count();
    if runs <= nodes + nodes / 2 {
        return None;
    }
    let mut next = 0;
    for count in &mut counts {
        (*count, next) = (next, next + *count);
    }
    let mut order = vec![0; bases.len()];
    for (p, &base) in bases.iter().enumerate() {
        let place = &mut counts[usize::from(base)];
        order[*place as usize] = p as u32;
        *place += 1;
    }
    Some(order)
}

/// `list` in the order `order`.
pub(crate) fn reorder<T: Copy>(list: &mut Vec<T>, order: &[u32]) {
    *list = order.iter().map(|&p| list[p as usize]).collect();
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scattered_points_come_to_one_run_a_node() {
        let mut bases = vec![7, 7, 0, 3, 7, 3, 3, 0, 7];
        assert_eq!(run_end(&bases, 0), 2);
        assert_eq!(run_end(&bases, 8), 9);
        let order = run_order(&bases).unwrap();
        assert_eq!(order, [2, 7, 3, 5, 6, 0, 1, 4, 8]);
        reorder(&mut bases, &order);
        assert_eq!(bases, [0, 0, 3, 3, 3, 7, 7, 7, 7]);
        assert_eq!(run_order(&bases), None);
        assert_eq!(run_order(&[7, 7, 0, 7]), None, "three runs of two nodes");
        assert_eq!(run_order(&[]), None);
    }
}
