//! More memory asked for than there is, as a sentence says it.

use std::fmt;

use crate::available_bytes;

/// Memory that is needed and that this process may not have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shortage {
    /// Needed, bytes.
    pub need: u64,
    /// To be had, bytes.
    pub have: u64,
}

/// What is short where `need` more bytes are needed; `None` where they may be had or nobody knows.
///
/// An allocation that fails aborts the process, and one that succeeds may have it killed once it is
/// used: whoever makes much of an argument or an input asks here before.
pub fn shortage(need: u64) -> Option<Shortage> {
    let have = available_bytes()?;
    (need > have).then_some(Shortage { need, have })
}

impl fmt::Display for Shortage {
    /// `17.2 GB of memory, but this process may use 2.0 GB`, to stand behind "needs" or "would take".
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [need, have] = [self.need, self.have].map(bytes);
        write!(f, "{need} of memory, but this process may use {have}")
    }
}

/// A number of bytes in the unit that suits it.
pub fn bytes(bytes: u64) -> String {
    match bytes as f64 {
        n if n >= 1e9 => format!("{:.1} GB", n / 1e9),
        n if n >= 1e6 => format!("{:.0} MB", n / 1e6),
        n => format!("{:.0} kB", (n / 1e3).ceil()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_shortage_names_needed_and_available_memory() {
        let (need, have) = (17_240_000_000, 1_536_000);
        let said = Shortage { need, have }.to_string();
        assert_eq!(said, "17.2 GB of memory, but this process may use 2 MB");
        assert_eq!([400_000, 20, 0].map(bytes), ["400 kB", "1 kB", "0 kB"]);
        assert_eq!(shortage(0), None);
        if cfg!(target_os = "linux") {
            assert!(shortage(u64::MAX).is_some());
        }
    }
}
