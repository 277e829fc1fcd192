//! The stages of an implicit step: which a run has, and which it does without.

use physics::{Scene, Stages};

const PID: &str = "PID";

/// The stages of a run of `scene`.
pub(crate) fn stages(scene: &Scene) -> Stages {
    let list = Stages::of(scene);
    let gains = scene.clamp.and_then(|clamp| clamp.pid);
    let no_pid = match (list.has(Stages::LOAD), gains) {
        (true, Some(_)) => None,
        (true, None) => Some("no pid: the limit is an equation of the solve"),
        (false, _) => Some("no pressure limit"),
    };
    list.and(PID, no_pid.map(str::to_owned))
        .and("density projection", None)
        .and(
            "shear rate of points between snapshots",
            Some("known where a state is written".into()),
        )
}

/// The list resolved for the step. The rest of it is what the geometry is made of (bodies, axes, sides)
/// or a term of a row (gravity): where a scene has none there is nothing to go through.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Present {
    pub(crate) friction: bool,
    pub(crate) table: bool,
    pub(crate) load: bool,
    pub(crate) pid: bool,
}

impl From<&Stages> for Present {
    fn from(list: &Stages) -> Self {
        Self {
            friction: list.has(Stages::FRICTION),
            table: list.has(Stages::TABLE),
            load: list.has(Stages::LOAD),
            pid: list.has(PID),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_the_list_says_is_absent_the_step_does_not_have() {
        let all = [Stages::FRICTION, Stages::TABLE, Stages::LOAD, PID];
        for left_out in all {
            let list = (all.iter()).fold(Stages::default(), |list, &name| {
                list.and(name, (name == left_out).then(|| "not asked for".into()))
            });
            let has = Present::from(&list);
            let found = [has.friction, has.table, has.load, has.pid];
            assert_eq!(found, all.map(|name| name != left_out), "{left_out}");
        }
    }
}
