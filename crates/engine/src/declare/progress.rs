//! Progress of a run.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

use burgeon_base::text::grouped;

/// Progress of a run, for display.
#[derive(Debug, Default)]
pub struct RunProgress {
    step: AtomicUsize,
    steps: AtomicUsize,
    modules: AtomicUsize,
    total: AtomicUsize,
}

impl RunProgress {
    /// Records that `step` of at most `steps` has made a chain of `modules` modules.
    pub(crate) fn note(&self, step: usize, steps: usize, modules: usize) {
        self.step.store(step, Ordering::Relaxed);
        self.steps.store(steps, Ordering::Relaxed);
        self.modules.store(modules, Ordering::Relaxed);
        self.total.fetch_add(modules, Ordering::Relaxed);
    }

    /// Returns the last completed step, the maximum number of steps if there is one, and the number of
    /// modules.
    pub fn counts(&self) -> (usize, Option<usize>, usize) {
        let load = |count: &AtomicUsize| count.load(Ordering::Relaxed);
        let steps = load(&self.steps);
        (load(&self.step), (steps != usize::MAX && steps > 0).then_some(steps), load(&self.modules))
    }

    /// Returns a progress message with the rate and an estimate of the remaining time.
    pub fn message(&self, elapsed: Duration) -> String {
        let load = |count: &AtomicUsize| count.load(Ordering::Relaxed);
        let (step, steps) = (load(&self.step), load(&self.steps));
        if steps == 0 {
            return "running the script".to_owned();
        }
        #[allow(clippy::cast_precision_loss, reason = "shown with three digits")]
        let rate = load(&self.total) as f64 / elapsed.as_secs_f64().max(1e-3) / 1e6;
        let modules = load(&self.modules);
        let of = if steps == usize::MAX { String::new() } else { format!(" of {steps}") };
        // Chains grow, so the remaining steps take at least as long as the completed steps.
        let left = match (step, steps) {
            (1.., steps) if steps != usize::MAX && steps > step => {
                #[allow(clippy::cast_precision_loss, reason = "an estimate")]
                let seconds = elapsed.as_secs_f64() * (steps - step) as f64 / step as f64;
                if seconds < 1.0 { String::new() } else { format!(", at least {seconds:.0} s left") }
            }
            _ => String::new(),
        };
        format!("step {step}{of}, {} modules, {rate:.1} M modules/s{left}", grouped(modules))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn progress_tells_the_time_left_once_there_is_some() {
        let progress = RunProgress::default();
        let after = |seconds: f64| progress.message(Duration::from_secs_f64(seconds));
        assert_eq!(after(0.2), "running the script");
        progress.note(5, 20, 1_000_000);
        assert_eq!(after(0.2), "step 5 of 20, 1,000,000 modules, 5.0 M modules/s");
        assert_eq!(after(4.0), "step 5 of 20, 1,000,000 modules, 0.2 M modules/s, at least 12 s left");
    }
}
