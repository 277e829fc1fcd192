//! Memory limits of the control groups of this process: batch systems and containers set them.

use std::fs;
use std::path::Path;

/// The files of a version of control groups: limit and use in bytes, and the line of `memory.stat` with
/// the file cache that the system takes back before it ends a process.
struct Version {
    /// Where the tree of groups is mounted.
    root: &'static str,
    limit: &'static str,
    used: &'static str,
    cache: &'static str,
}

const ONE: Version = Version {
    root: "/sys/fs/cgroup/memory",
    limit: "memory.limit_in_bytes",
    used: "memory.usage_in_bytes",
    cache: "total_inactive_file",
};
const TWO: Version = Version {
    root: "/sys/fs/cgroup",
    limit: "memory.max",
    used: "memory.current",
    cache: "inactive_file",
};

/// The least that the groups in `own`, which is /proc/self/cgroup, and those above them leave.
pub(crate) fn left(own: &str) -> Option<u64> {
    let groups = own.lines().filter_map(group).flat_map(|(version, path)| {
        // In a container the path may be the host's: its root, which is there in any case, comes last.
        let groups = Path::new(path).ancestors();
        groups.map(move |group| (version, group))
    });
    let left = groups.filter_map(|(version, group)| {
        let below = group.strip_prefix("/").unwrap_or(group);
        version.left(&Path::new(version.root).join(below))
    });
    left.min()
}

/// Version and path of a line `NUMBER:CONTROLLERS:PATH` that limits memory.
fn group(line: &str) -> Option<(&'static Version, &str)> {
    let mut parts = line.splitn(3, ':');
    let (number, controllers, path) = (parts.next()?, parts.next()?, parts.next()?);
    let version = match controllers {
        "" if number == "0" => &TWO,
        of if of.split(',').any(|name| name == "memory") => &ONE,
        _ => return None,
    };
    Some((version, path))
}

impl Version {
    /// What the group in `folder` leaves; `None` where it is not there or has no limit.
    fn left(&self, folder: &Path) -> Option<u64> {
        let number = |name: &str| -> Option<u64> {
            let text = fs::read_to_string(folder.join(name)).ok()?;
            // "max" is no number and no limit.
            text.trim().parse().ok()
        };
        let limit = number(self.limit)?;
        let stat = fs::read_to_string(folder.join("memory.stat")).unwrap_or_default();
        let cache = |line: &str| line.strip_prefix(self.cache)?.trim().parse().ok();
        let cache = stat.lines().find_map(cache);
        let used = number(self.used).unwrap_or(0);
        Some(limit.saturating_sub(used.saturating_sub(cache.unwrap_or(0))))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_that_limit_memory_are_told_from_others() {
        let found = |line| group(line).map(|(version, path)| (version.limit, path));
        assert_eq!(found("0::/a/b"), Some(("memory.max", "/a/b")));
        let one = Some(("memory.limit_in_bytes", "/job:7"));
        assert_eq!(found("4:cpu,memory:/job:7"), one);
        for other in ["5:devices:/", "1:name=systemd:/", ""] {
            assert_eq!(found(other), None);
        }
    }

    #[test]
    fn a_group_leaves_its_limit_less_what_cannot_be_taken_back() {
        let folder = std::env::temp_dir().join(format!("bondline-group-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let write = |name: &str, text: &str| fs::write(folder.join(name), text).unwrap();
        assert_eq!(TWO.left(&folder), None, "no such files");
        write("memory.max", "max\n");
        write("memory.current", "700\n");
        assert_eq!(TWO.left(&folder), None, "no limit");
        write("memory.max", "1000\n");
        assert_eq!(TWO.left(&folder), Some(300));
        write("memory.stat", "anon 500\ninactive_file 200\n");
        assert_eq!(TWO.left(&folder), Some(500));
        fs::remove_dir_all(&folder).unwrap();
    }
}
