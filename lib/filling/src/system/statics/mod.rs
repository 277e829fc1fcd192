//! Steady flows against closed forms; run with `--nocapture` to see the errors.

mod bodies;
mod channels;
mod flow;
mod menisci;
#[path = "../../../tests/common/staircase.rs"]
mod staircase;
