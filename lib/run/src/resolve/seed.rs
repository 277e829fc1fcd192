//! Material points of the liquid at the start.

use physics::Points;

/// Largest number of material points a run accepts: beyond it the request is a mistake.
pub(super) const MOST_POINTS: u64 = 2_000_000_000;

/// Adds points on a regular lattice that fills the box `min`..`max` (m) with a spacing as near
/// to `spacing` as divides it; in plane strain one layer at `depth / 2`.
pub(super) fn fill_box(
    points: &mut Points,
    min: [f64; 3],
    max: [f64; 3],
    spacing: f64,
    plane_strain_depth: Option<f64>,
    velocity: [f64; 3],
) -> Result<(), String> {
    let mut n = [0_u64; 3];
    let mut step = [0.0; 3];
    for a in 0..3 {
        let length = max[a] - min[a];
        n[a] = ((length / spacing).round() as u64).max(1);
        step[a] = length / n[a] as f64;
    }
    let mut low = min;
    if let Some(depth) = plane_strain_depth {
        (n[2], step[2], low[2]) = (1, depth, 0.0);
    }
    let total = n
        .iter()
        .try_fold(1_u64, |t, &n| t.checked_mul(n))
        .unwrap_or(u64::MAX);
    if total.saturating_add(points.position.len() as u64) > MOST_POINTS {
        return Err(format!(
            "the adhesive would need {total} material points, more than {MOST_POINTS}"
        ));
    }
    let volume = step[0] * step[1] * step[2];
    for k in 0..n[2] {
        for j in 0..n[1] {
            for i in 0..n[0] {
                let at = |a: usize, i: u64| low[a] + (i as f64 + 0.5) * step[a];
                points.position.push([at(0, i), at(1, j), at(2, k)]);
                points.velocity.push(velocity);
                points.volume.push(volume);
            }
        }
    }
    Ok(())
}
