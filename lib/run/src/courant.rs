//! The Courant number: the one key of a case that may change when a stopped run goes on.

use serde::Serialize;

/// From which step on a run was taken at which Courant number.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Courant {
    /// Steps taken before.
    pub after_step: u64,
    /// `[integrator] cfl`.
    pub cfl: f64,
}

/// The record of a run that goes on after `step` at `cfl`.
pub(crate) fn continued(mut record: Vec<Courant>, step: u64, cfl: f64) -> Vec<Courant> {
    record.retain(|past| past.after_step < step);
    if record.last().is_none_or(|last| last.cfl != cfl) {
        record.push(Courant {
            after_step: step,
            cfl,
        });
    }
    record
}

/// The case text without its Courant number: the same for two runs of which one may continue
/// the other. What is no TOML stays as it is.
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
        let begun = continued(Vec::new(), 0, 1.0);
        assert_eq!(begun, [at(0, 1.0)]);
        assert_eq!(continued(begun.clone(), 7, 1.0), begun);
        let changed = continued(begun.clone(), 7, 0.5);
        assert_eq!(changed, [at(0, 1.0), at(7, 0.5)]);
        assert_eq!(
            continued(changed.clone(), 7, 0.25),
            [at(0, 1.0), at(7, 0.25)]
        );
        assert_eq!(continued(changed, 7, 1.0), begun);
    }
}
