//! Cache of query results.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, OnceLock};

use rustc_hash::FxHashMap;

use super::{RowSource, SqlQuery};
use burgeon_base::error::Result;
use burgeon_base::locks::LockRecovery;
use burgeon_kit::QueryRows;

/// Maximum number of values that are cached from step to step.
const MOST: usize = 2_000_000;

/// Maximum number of SQL texts whose words are cached.
const MOST_TEXTS: usize = 10_000;

/// Result of a query. Other threads wait while one thread computes it.
type Slot = Arc<OnceLock<Result<Arc<QueryRows>>>>;

/// Query results of a run. Results for the top level of the script are kept until the end of the run, because
/// every virtual machine must see the same rows.
#[derive(Default)]
pub(crate) struct RowCache {
    known: Mutex<FxHashMap<(SqlQuery, u64), CacheEntry>>,
    /// Words of SQL texts that may name modules.
    words: Mutex<FxHashMap<Arc<str>, Arc<[String]>>>,
    /// Set once a query has named modules of the chains.
    views: AtomicBool,
    /// Queries of rules in the current step, by the index of the module, as text.
    noted: Mutex<Vec<(usize, String)>>,
    values: AtomicUsize,
}

struct CacheEntry {
    slot: Slot,
    stays: bool,
}

/// Parameters of a query.
pub(crate) struct AskedRows<'a> {
    /// Source that computes missing results.
    pub source: &'a dyn RowSource,
    /// Maximum number of rows.
    pub most: usize,
    /// State of the chains that the query reads, if it names modules; otherwise 0.
    pub view: u64,
    /// Set to keep the result until the end of the run.
    pub stays: bool,
}

impl RowCache {
    /// Returns the result of `question`.
    pub(crate) fn ask(&self, question: &SqlQuery, asked: &AskedRows<'_>) -> Result<Arc<QueryRows>> {
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

    /// Records a query of a rule for the module at `place` in the current step, with its number of rows.
    pub(crate) fn note(&self, place: usize, question: &SqlQuery, rows: usize) {
        self.note_answer(place, format!("{question}: {rows} row{}", if rows == 1 { "" } else { "s" }));
    }

    /// Records a query or another result as text.
    pub(crate) fn note_answer(&self, place: usize, text: String) {
        self.noted.lock().recover().push((place, text));
    }

    /// Takes the records of the current step, sorted by place, and in query order for each place.
    pub(crate) fn take_noted(&self) -> Vec<(usize, String)> {
        let mut noted = std::mem::take(&mut *self.noted.lock().recover());
        noted.sort_by_key(|(place, _)| *place);
        // Several guards often run the same query.
        noted.dedup();
        noted
    }

    /// Returns the words of an SQL text that may name modules. Calls `find` once per text.
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

    /// Drops results about earlier states of the chains. No query may be running.
    pub(crate) fn forget_views(&self) {
        if self.views.swap(false, Ordering::Relaxed) {
            self.known.lock().recover().retain(|(_, view), kept| *view == 0 || kept.stays);
        }
    }

    /// Drops results if there are many. No query may be running.
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
        fn rows(&self, question: &SqlQuery, _: usize) -> Result<QueryRows> {
            self.0.fetch_add(1, Ordering::Relaxed);
            match question.sql() {
                "wrong" => Err(Error::argument("it is wrong")),
                _ => Ok(QueryRows::default()),
            }
        }
    }

    #[test]
    fn the_same_question_is_asked_once_whatever_the_answer_and_by_any_number_of_threads() {
        let (kept, source) = (RowCache::default(), CountedSource::default());
        let ask = |sql: &str| {
            let asked = AskedRows { source: &source, most: 10, view: 0, stays: false };
            kept.ask(&SqlQuery::new(sql.into(), None), &asked)
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
