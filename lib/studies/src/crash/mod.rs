//! The kill campaign: runs that are killed, stopped, or denied the disk at every call by which
//! they change their folder must, continued, end byte for byte as the run in one piece.

pub mod campaign;
pub mod chains;
pub mod faults;
pub mod full_disk;
pub mod report;
pub mod scene;
pub mod together;

/// What came of one series of trials.
#[derive(Clone, Debug)]
pub struct Row {
    /// What was done.
    pub series: &'static str,
    /// Scheme of the run.
    pub scheme: &'static str,
    /// What went wrong at each point.
    pub fault: &'static str,
    /// How many trials.
    pub trials: usize,
    /// Those that did not end as they must, each in a sentence.
    pub wrong: Vec<String>,
}

impl Row {
    /// A line for the terminal.
    pub fn line(&self) -> String {
        let (right, trials) = (self.trials - self.wrong.len(), self.trials);
        let first = (self.wrong.first()).map_or(String::new(), |said| format!("; first: {said}"));
        format!(
            "{:<44} {:<9} {:<12} {right} of {trials} as they must{first}",
            self.series, self.scheme, self.fault
        )
    }
}

/// Does trials side by side on all processors; the sentences of those that failed.
fn all_wrong<T: Sync>(
    trials: &[T],
    trial: impl Fn(&T) -> Result<(), String> + Sync,
) -> Vec<String> {
    let next = std::sync::atomic::AtomicUsize::new(0);
    let wrong = std::sync::Mutex::new(Vec::new());
    let workers = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| {
        for _ in 0..workers {
            scope.spawn(|| {
                while let Some(one) =
                    trials.get(next.fetch_add(1, std::sync::atomic::Ordering::Relaxed))
                {
                    if let (Err(said), Ok(mut wrong)) = (trial(one), wrong.lock()) {
                        wrong.push(said);
                    }
                }
            });
        }
    });
    wrong.into_inner().unwrap_or_default()
}
