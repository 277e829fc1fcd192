//! The settings of the trade-off study: settings.txt.

use std::path::Path;

use crate::lines::{self, Values};
use crate::method::Method;

/// A method at a cell size.
#[derive(Clone, Debug)]
pub(super) struct Setting {
    pub(super) method: Method,
    /// Cells across the lumen.
    pub(super) cells: u32,
    /// What differs from the base.
    pub(super) varied: &'static str,
    /// Whether it also runs in the bond line, which takes longer.
    pub(super) bond: bool,
}

/// All settings; `double` is the `mpm-run` built in double precision.
pub(super) fn all(double: &Path) -> Vec<Setting> {
    lines::read(include_str!("settings.txt"), |line| {
        let mut parts = line.split(" | ");
        let (varied, words) = (parts.next()?, parts.next()?);
        let (name, keys) = (parts.next(), parts.next());
        let setting = |of: Values| {
            let mut method = Method::named(of.word("method")?);
            if let Some(name) = name {
                method = method.with(&of.within(name), &[]);
            }
            let keys = keys.iter().flat_map(|keys| keys.split(" ; "));
            method = keys.fold(method, |method, key| method.setting(of.within(key)));
            if of.word("build") == Some("double") {
                method = method.by(double);
            }
            Some(Setting {
                method,
                cells: of.word("cells").unwrap_or("6").parse().ok()?,
                varied,
                bond: of.word("bond").is_some(),
            })
        };
        Values::all(words).into_iter().map(setting).collect()
    })
}

#[test]
fn no_setting_is_there_twice() {
    let all = all(Path::new("double"));
    let name = |s: &Setting| (s.method.label.clone(), s.cells);
    let names: std::collections::HashSet<_> = all.iter().map(name).collect();
    assert_eq!(names.len(), all.len());
}
