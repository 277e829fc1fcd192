//! Instructions of a run by valgrind's callgrind, which do not depend on what else the machine does.

use std::collections::HashMap;
use std::process::Command;

use crate::Result;
use crate::study::printed;

/// Instructions of a run of `command`, and of each of its functions with all that it calls.
pub(super) fn profile(command: &Command) -> Result<(f64, HashMap<String, f64>)> {
    let file = tempfile::NamedTempFile::new()?;
    let mut counted = Command::new("valgrind");
    counted.arg("--tool=callgrind");
    counted.arg(format!("--callgrind-out-file={}", file.path().display()));
    counted.arg(command.get_program()).args(command.get_args());
    printed(&mut counted)?;
    Ok(read(&std::fs::read_to_string(file.path())?))
}

/// Reads callgrind's format: the costs of lines of the function `fn=`, and after `calls=` one line with
/// the cost of all calls of `cfn=` there.
fn read(text: &str) -> (f64, HashMap<String, f64>) {
    let mut names: HashMap<&str, &str> = HashMap::new();
    let mut inclusive: HashMap<&str, f64> = HashMap::new();
    let (mut total, mut called, mut is_call) = (0.0, "", false);
    for line in text.lines() {
        let function = line.strip_prefix("cfn=").or(line.strip_prefix("fn="));
        if let Some((id, name)) = function.and_then(|f| f.split_once(')')) {
            if !name.is_empty() {
                names.insert(id, name.trim());
            }
            if line.starts_with('c') {
                called = id;
            }
        } else if line.starts_with("calls=") {
            is_call = true;
        } else if line.starts_with(|c: char| c.is_ascii_digit() || "+-*".contains(c)) {
            let cost = line.split(' ').next_back().and_then(|n| n.parse().ok());
            let cost: f64 = cost.unwrap_or(0.0);
            if std::mem::take(&mut is_call) {
                *inclusive.entry(called).or_default() += cost;
            } else {
                total += cost;
            }
        }
    }
    let mut functions = HashMap::new();
    for (id, cost) in inclusive {
        let name = names.get(id).copied().unwrap_or_default();
        // Methods of `impl` blocks elsewhere: `<impl a::B>::c` is `a::B::c`.
        *functions.entry(name.replace('>', "")).or_default() += cost;
    }
    (total, functions)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn costs_of_calls_belong_to_the_function_called() {
        let text = "events: Ir\n\nfn=(1) main\n10 5\ncfn=(2) a::<impl b::C>::d\ncalls=2 20\n+1 70\n\nfn=(2)\n20 60\n* 10\n\nfn=(1)\ncfn=(2)\ncalls=1 20\n12 3\n";
        let (total, functions) = read(text);
        assert_eq!(total, 75.0);
        assert_eq!(functions["a::<impl b::C::d"], 73.0);
        assert_eq!(functions.len(), 1);
    }
}
