//! How much memory this process may still have.

use std::fs;

use crate::control_group;

/// Memory that this process may still take, bytes, where the system tells: what the machine has
/// free or can free, its swap too, or less where a limit on the address space or the data of a process
/// (`ulimit -v`, `ulimit -d`) or a control group leaves less.
pub fn available_bytes() -> Option<u64> {
    let read = |path: &str| fs::read_to_string(path).unwrap_or_default();
    let (limits, status) = (read("/proc/self/limits"), read("/proc/self/status"));
    [
        free(&read("/proc/meminfo")),
        left(&limits, "Max address space", &status, "VmSize:"),
        left(&limits, "Max data size", &status, "VmData:"),
        control_group::left(&read("/proc/self/cgroup")),
    ]
    .into_iter()
    .flatten()
    .min()
}

/// What /proc/meminfo says can be given without taking it from another process.
fn free(meminfo: &str) -> Option<u64> {
    let swap = kilobytes(meminfo, "SwapFree:").unwrap_or(0);
    Some(kilobytes(meminfo, "MemAvailable:")?.saturating_add(swap))
}

/// What the soft limit `name` of /proc/self/limits leaves above what is in use by `used` of
/// /proc/self/status.
fn left(limits: &str, name: &str, status: &str, used: &str) -> Option<u64> {
    let line = limits.lines().find_map(|line| line.strip_prefix(name))?;
    // "unlimited" is no number and no limit.
    let limit: u64 = line.split_whitespace().next()?.parse().ok()?;
    Some(limit.saturating_sub(kilobytes(status, used).unwrap_or(0)))
}

/// The value in bytes of a line `NAME: 12 kB` as /proc writes it.
pub(crate) fn kilobytes(text: &str, name: &str) -> Option<u64> {
    let line = text.lines().find_map(|line| line.strip_prefix(name))?;
    let kilobytes: u64 = line.split_whitespace().next()?.parse().ok()?;
    Some(kilobytes.saturating_mul(1024))
}

#[cfg(test)]
mod tests {
    use super::*;

    const MEMINFO: &str = "MemTotal: 24684096 kB\nMemFree: 100 kB\nMemAvailable:   2000 kB\nSwapTotal: 40 kB\nSwapFree: 10 kB\n";
    const LIMITS: &str =
        "Limit                     Soft Limit           Hard Limit           Units     
Max data size             unlimited            unlimited            bytes     
Max address space         1024000              unlimited            bytes     
";

    #[test]
    fn what_is_free_or_can_be_freed_counts() {
        assert_eq!(free(MEMINFO), Some(2010 * 1024));
        assert_eq!(free("MemTotal: 1 kB\n"), None);
        assert_eq!(free(""), None);
    }

    #[test]
    fn a_limit_counts_above_what_is_in_use() {
        let status = "VmPeak: 9999 kB\nVmSize:\t     400 kB\n";
        let of = |name, used| left(LIMITS, name, status, used);
        assert_eq!(of("Max address space", "VmSize:"), Some(600 * 1024));
        assert_eq!(of("Max data size", "VmData:"), None, "unlimited");
        assert_eq!(of("Max of something else", "VmSize:"), None);
        let over = left(LIMITS, "Max address space", "VmSize: 2000 kB", "VmSize:");
        assert_eq!(over, Some(0), "a limit set below what is in use");
    }

    #[test]
    #[cfg(target_os = "linux")]
    fn linux_tells() {
        assert!(available_bytes().is_some_and(|bytes| bytes > 1 << 20));
    }
}
