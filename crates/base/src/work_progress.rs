//! Progress of one kind of work at a time, such as the parts of a render.

use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use crate::locks::LockRecovery;
use crate::text::grouped;

/// Count of the items of a work that are done, for a message with a rate and the time left.
///
/// ```
/// use burgeon_base::work_progress::WorkProgress;
///
/// let progress = WorkProgress::new();
/// assert_eq!(progress.message(), None);
/// progress.begin("shading", "pixels", 2000);
/// progress.add(500);
/// assert!(progress.message().is_some_and(|text| text.starts_with("shading: 25 % of 2,000 pixels")));
/// progress.add(1500);
/// assert_eq!(progress.message(), None);
/// ```
#[derive(Debug, Default)]
pub struct WorkProgress {
    work: Mutex<Option<Work>>,
    done: AtomicUsize,
}

/// Work that has begun.
#[derive(Debug, Clone, Copy)]
struct Work {
    name: &'static str,
    items: &'static str,
    count: usize,
    begin: Instant,
}

impl WorkProgress {
    /// Creates the progress of no work.
    pub const fn new() -> Self {
        Self { work: Mutex::new(None), done: AtomicUsize::new(0) }
    }

    /// Begins the work `name` on a number of items, in place of any earlier work.
    pub fn begin(&self, name: &'static str, items: &'static str, count: usize) {
        let mut work = self.work.lock().recover();
        self.done.store(0, Ordering::Relaxed);
        *work = Some(Work { name, items, count, begin: Instant::now() });
    }

    /// Records that further items are done, from any thread.
    pub fn add(&self, items: usize) {
        self.done.fetch_add(items, Ordering::Relaxed);
    }

    /// Returns a message with the rate and an estimate of the time left; `None` without work, and when all items are done.
    pub fn message(&self) -> Option<String> {
        let work = (*self.work.lock().recover())?;
        let done = self.done.load(Ordering::Relaxed);
        (done < work.count).then(|| work.message(done, work.begin.elapsed()))
    }
}

impl Work {
    fn message(&self, done: usize, elapsed: Duration) -> String {
        let Self { name, items, count, .. } = self;
        let percent = done * 100 / (*count).max(1);
        let begun = format!("{name}: {percent} % of {} {items}", grouped(*count));
        if done == 0 {
            return begun;
        }
        let seconds = elapsed.as_secs_f64().max(1e-3);
        let rate = done as f64 / seconds;
        let shown = if rate < 10.0 { format!("{rate:.1}") } else { grouped(rate.round() as usize) };
        let left = seconds * (count - done) as f64 / done as f64;
        let left = if left < 1.0 { String::new() } else { format!(", {left:.0} s left") };
        format!("{begun}, {shown} {items}/s{left}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_message_has_the_rate_and_the_time_left() {
        let work = Work { name: "shading", items: "pixels", count: 1_228_800, begin: Instant::now() };
        let after = |done: usize, seconds: f64| work.message(done, Duration::from_secs_f64(seconds));
        assert_eq!(after(0, 1.0), "shading: 0 % of 1,228,800 pixels");
        assert_eq!(after(307_200, 2.0), "shading: 25 % of 1,228,800 pixels, 153,600 pixels/s, 6 s left");
        assert_eq!(after(1_228_000, 9.0), "shading: 99 % of 1,228,800 pixels, 136,444 pixels/s");
        let maps = Work { name: "light", items: "maps", count: 200, begin: Instant::now() };
        assert_eq!(maps.message(10, Duration::from_secs(4)), "light: 5 % of 200 maps, 2.5 maps/s, 76 s left");
    }
}
