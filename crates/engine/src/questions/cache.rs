//! Answers that are kept, so that the same question is asked once.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, OnceLock};

use rustc_hash::FxHashMap;

use super::{Question, RowSource, Rows};
use burgeon_base::error::Result;
use burgeon_base::locks::LockRecovery;

/// The values of answers that are kept from step to step.
const MOST: usize = 2_000_000;

/// The texts of SQL whose words are kept.
#[cfg(feature = "data")]
const MOST_TEXTS: usize = 10_000;

/// The rows of a question, once they are known. Whoever asks meanwhile waits for them.
type Slot = Arc<OnceLock<Result<Arc<Rows>>>>;

/// The answers of a run, by question. What the top level of the script asks is kept to its end, since every virtual
/// machine is to see the same.
#[derive(Default)]
pub(crate) struct RowCache {
    known: Mutex<FxHashMap<(Question, u64), CacheEntry>>,
    /// The words of texts of SQL that may name modules.
    #[cfg(feature = "data")]
    words: Mutex<FxHashMap<Arc<str>, Arc<[String]>>>,
    /// Set once a question was about a state of the chains.
    views: AtomicBool,
    /// The places of modules whose rules have asked data or geometries in the step at hand, and what; in words.
    noted: Mutex<Vec<(usize, String)>>,
    values: AtomicUsize,
}

struct CacheEntry {
    slot: Slot,
    stays: bool,
}

/// Who asks, and how.
pub(crate) struct AskedRows<'a> {
    /// Who answers what is not known yet.
    pub source: &'a dyn RowSource,
    /// The most rows of an answer.
    pub most: usize,
    /// The state of the chains that the question is about, if it names modules; otherwise 0.
    pub view: u64,
    /// Whether the answer is kept to the end of the run.
    pub stays: bool,
}

impl RowCache {
    /// The answer to `question`.
    pub(crate) fn ask(&self, question: &Question, asked: &AskedRows<'_>) -> Result<Arc<Rows>> {
        let slot = {
            let mut known = self.known.lock().recover();
            let kept = known
                .entry((question.clone(), asked.view))
                .or_insert_with(|| CacheEntry { slot: Slot::default(), stays: false });
            kept.stays |= asked.stays;
            Arc::clone(&kept.slot)
        };
        if asked.view != 0 {
            self.views.store(true, Ordering::Relaxed);
        }
        let rows = slot.get_or_init(|| {
            let rows = asked.source.rows(question, asked.most)?;
            self.values.fetch_add(rows.values.len() + 16, Ordering::Relaxed);
            Ok(Arc::new(rows))
        });
        rows.clone()
    }

    /// Notes for the step at hand what a rule has asked for the module at `place`, and how many rows it got.
    pub(crate) fn note(&self, place: usize, question: &Question, rows: usize) {
        self.note_answer(place, format!("{question}: {rows} row{}", if rows == 1 { "" } else { "s" }));
    }

    /// The same in words.
    pub(crate) fn note_answer(&self, place: usize, text: String) {
        self.noted.lock().recover().push((place, text));
    }

    /// What was noted in the step at hand, by place; of each in the order in which it was asked.
    pub(crate) fn take_noted(&self) -> Vec<(usize, String)> {
        let mut noted = std::mem::take(&mut *self.noted.lock().recover());
        noted.sort_by_key(|(place, _)| *place);
        // Several guards often ask the same.
        noted.dedup();
        noted
    }

    /// Returns the words of a text of SQL that may name modules, which `find` finds once.
    #[cfg(feature = "data")]
    pub(crate) fn words(&self, sql: &str, find: impl FnOnce(&str) -> Vec<String>) -> Arc<[String]> {
        let mut words = self.words.lock().recover();
        if let Some(known) = words.get(sql) {
            return Arc::clone(known);
        }
        if words.len() >= MOST_TEXTS {
            words.clear();
        }
        let found: Arc<[String]> = find(sql).into();
        words.insert(sql.into(), Arc::clone(&found));
        found
    }

    /// Forgets what was answered about states of the chains that are over. Nobody is asking.
    pub(crate) fn forget_views(&self) {
        if self.views.swap(false, Ordering::Relaxed) {
            self.known.lock().recover().retain(|(_, view), kept| *view == 0 || kept.stays);
        }
    }

    /// Forgets answers once they are many. Nobody is asking.
    pub(crate) fn forget_many(&self) {
        if self.values.load(Ordering::Relaxed) > MOST {
            self.known.lock().recover().retain(|_, kept| kept.stays);
            self.values.store(0, Ordering::Relaxed);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use burgeon_base::error::Error;

    #[derive(Default)]
    struct CountedSource(AtomicUsize);

    impl RowSource for CountedSource {
        fn rows(&self, question: &Question, _: usize) -> Result<Rows> {
            self.0.fetch_add(1, Ordering::Relaxed);
            match question.sql() {
                "wrong" => Err(Error::argument("it is wrong")),
                _ => Ok(Rows::default()),
            }
        }
    }

    #[test]
    fn the_same_question_is_asked_once_whatever_the_answer_and_by_any_number_of_threads() {
        let (kept, source) = (RowCache::default(), CountedSource::default());
        let ask = |sql: &str| {
            let asked = AskedRows { source: &source, most: 10, view: 0, stays: false };
            kept.ask(&Question::new(sql.into(), None), &asked)
        };
        std::thread::scope(|scope| {
            for _ in 0..8 {
                scope.spawn(|| {
                    assert!(ask("right").is_ok());
                    assert_eq!(ask("wrong").unwrap_err().message(), "it is wrong");
                });
            }
        });
        assert_eq!(source.0.load(Ordering::Relaxed), 2);
    }
}
