//! Time and memory that this process has taken, its allocator, and the signals that it was told to ignore.

use std::fs;

/// User plus system CPU seconds of this process so far, where /proc tells.
pub fn cpu_seconds() -> Option<f64> {
    let stat = fs::read_to_string("/proc/self/stat").ok()?;
    // The second field is the name in parentheses and may hold spaces.
    let fields: Vec<_> = stat.rsplit(')').next()?.split_whitespace().collect();
    let ticks = |i: usize| fields.get(i)?.parse::<f64>().ok();
    // Fields 14 and 15 of proc(5); Linux counts them in 1/100 s on every port.
    Some((ticks(11)? + ticks(12)?) / 100.0)
}

/// Largest resident memory of this process so far in bytes, where /proc tells.
pub fn peak_memory_bytes() -> Option<u64> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    crate::memory::kilobytes(&status, "VmHWM:")
}

/// Has every array of a megabyte and more given back to the system as it is dropped. A step's arrays differ in size and go in
/// another order than they came: the GNU allocator, which raises this bound to 32 MB by itself, then keeps a third more than is
/// in use. Of smaller ones 64 MB are kept, which would be asked for again at once. To be called before a process has other threads.
#[allow(unsafe_code)]
pub fn give_back_large_arrays() {
    #[cfg(all(target_os = "linux", target_env = "gnu"))]
    // SAFETY: each takes two numbers and sets one; no other thread allocates meanwhile (mallopt(3)).
    unsafe {
        libc::mallopt(libc::M_MMAP_THRESHOLD, 1 << 20);
        libc::mallopt(libc::M_TRIM_THRESHOLD, 1 << 26);
    }
}

/// Whether this process ignores `signal`, as `nohup` or a shell's `trap '' HUP` had it begin.
#[allow(unsafe_code)]
pub fn ignores(signal: i32) -> bool {
    let mut now = std::mem::MaybeUninit::<libc::sigaction>::zeroed();
    // SAFETY: no action is set, and the one in force is written to a place of its size (sigaction(2)).
    let told = unsafe { libc::sigaction(signal, std::ptr::null(), now.as_mut_ptr()) };
    // SAFETY: all of it was zero before, which is an action.
    told == 0 && unsafe { now.assume_init() }.sa_sigaction == libc::SIG_IGN
}

#[cfg(test)]
mod tests {
    #[test]
    #[cfg(target_os = "linux")]
    fn linux_tells() {
        assert!(super::cpu_seconds().is_some());
        assert!(super::peak_memory_bytes().is_some_and(|b| b > 100_000));
    }
}
