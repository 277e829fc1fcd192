//! Bandwidth of the machine's memory.

use std::time::Instant;

/// Numbers per array: three of 256 MiB are in no cache.
const LENGTH: usize = 1 << 25;
/// Sweeps, of which the fastest counts.
const SWEEPS: usize = 5;

/// Bytes per second of a_i = b_i + s c_i on 1, 2, 4 ... threads up to the number of processors; the
/// write counts once.
pub(super) fn triad() -> Vec<(usize, f64)> {
    let processors = std::thread::available_parallelism().map_or(1, usize::from);
    let b: Vec<f64> = (0..LENGTH).map(|i| i as f64).collect();
    let c = b.clone();
    let mut a = vec![0.0; LENGTH];
    let threads = std::iter::successors(Some(1), |n| Some(2 * n));
    (threads.take_while(|&n| n <= processors))
        .map(|n| {
            let best = (0..SWEEPS).map(|_| sweep(&mut a, &b, &c, n));
            (n, (24 * LENGTH) as f64 / best.fold(f64::INFINITY, f64::min))
        })
        .collect()
}

/// Wall time of one sweep, s.
fn sweep(a: &mut [f64], b: &[f64], c: &[f64], threads: usize) -> f64 {
    let part = LENGTH.div_ceil(threads);
    let start = Instant::now();
    std::thread::scope(|scope| {
        for ((a, b), c) in a.chunks_mut(part).zip(b.chunks(part)).zip(c.chunks(part)) {
            scope.spawn(move || {
                for ((a, b), c) in a.iter_mut().zip(b).zip(c) {
                    *a = b + 3.0 * c;
                }
            });
        }
    });
    start.elapsed().as_secs_f64()
}
