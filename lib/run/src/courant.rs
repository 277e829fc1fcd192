//! The Courant number: the one key of a case that may change when a stopped run goes on.

use serde::Serialize;

/// Courant number of a run from a step on.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Courant {
    /// Steps taken before.
    pub after_step: u64,
    /// `[integrator] cfl`.
    pub cfl: f64,
}

/// The `record` of a run that continues after `step` with Courant number `cfl`.
pub(crate) fn continue_record(mut record: Vec<Courant>, step: u64, cfl: f64) -> Vec<Courant> {
    record.retain(|past| past.after_step < step);
    if record.last().is_none_or(|last| last.cfl != cfl) {
        record.push(Courant {
            after_step: step,
            cfl,
        });
    }
    record
}

/// The case text without its Courant number: equal for two runs if one may continue the other. A text that is no TOML is
/// returned as it is.
pub(crate) fn without_cfl(text: &str) -> String {
    let Ok(mut root) = toml::from_str::<toml::Table>(text) else {
        return text.into();
    };
    if let Some(toml::Value::Table(integrator)) = root.get_mut("integrator") {
        integrator.remove("cfl");
    }
    toml::to_string(&root).unwrap_or_else(|_| text.into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_record_holds_a_change_once_and_not_those_that_took_no_step() {
        let at = |after_step, cfl| Courant { after_step, cfl };
        let begun = continue_record(Vec::new(), 0, 1.0);
        assert_eq!(begun, [at(0, 1.0)]);
        assert_eq!(continue_record(begun.clone(), 7, 1.0), begun);
        let changed = continue_record(begun.clone(), 7, 0.5);
        assert_eq!(changed, [at(0, 1.0), at(7, 0.5)]);
        assert_eq!(
            continue_record(changed.clone(), 7, 0.25),
            [at(0, 1.0), at(7, 0.25)]
        );
        assert_eq!(continue_record(changed, 7, 1.0), begun);
    }
}
