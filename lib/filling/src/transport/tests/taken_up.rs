//! What particles carry on of the flow.

use super::*;

/// In a lumen of two cells the profile is half above its mean. Where inertia counts, particles take no
/// more than an eighth of the range of the velocities around, walls at rest included.
#[test]
fn particles_carry_an_eighth_more_than_the_range_around() {
    let channel = Channel::new(2, 2.0, [0.0; 2]);
    let flow = channel.flow(0.0, |[y, _]| 1.5 * y * (2.0 - y));
    let means = [1.0, 0.0, 0.0].map(|v| vec![v; channel.lattice.window.len()]);
    let fastest = |limit| {
        let middle = [2.5, channel.low[0] + 1.0, 0.5];
        let mut particles = at(vec![middle], 0.1);
        set_velocities(&mut particles, &flow, limit);
        particles.velocity[0][0]
    };
    assert!((fastest(None) - 1.5).abs() < 1e-3, "{}", fastest(None));
    assert_eq!(fastest(Some(&means)), 1.125);
}
