//! Modules for the rows of queries.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Weak};

use rustc_hash::FxHashMap;

use crate::declare::Session;
use crate::derive::threads::{ThreadJob, ThreadPool};
use crate::machine::Machine;
use crate::queries::{SqlQuery, fit, listed};
use burgeon_base::error::{Error, Result};
use burgeon_kit::{Prefetch, Value};
use burgeon_kit::{QueryRows, Values};
use burgeon_rewriting::{Chain, ModuleKey, Signature, Symbol};

/// Number of queries from which running them takes longer than starting a helper.
const MANY: usize = 64;

/// Queries of a step, without duplicates.
#[derive(Default)]
pub(super) struct QuestionSet {
    questions: Vec<SqlQuery>,
    numbers: FxHashMap<SqlQuery, usize>,
}

impl QuestionSet {
    /// Adds a query and returns its number.
    pub(super) fn add(&mut self, question: SqlQuery) -> usize {
        *self.numbers.entry(question).or_insert_with_key(|question| {
            self.questions.push(question.clone());
            self.questions.len() - 1
        })
    }

    /// Runs all queries, with the help of other threads, and returns the results by number.
    pub(super) fn ask(self, machine: &Machine, threads: &ThreadPool) -> Result<Vec<Result<Arc<QueryRows>>>> {
        let session = &machine.session;
        let batch = Arc::new(QuestionBatch {
            session: Arc::clone(session),
            questions: self.questions,
            next: AtomicUsize::new(0),
        });
        let count = batch.questions.len();
        let job = || {
            let job: Weak<QuestionBatch> = Arc::downgrade(&batch);
            ThreadJob::Prefetch(job)
        };
        threads.hand_out(machine, count, MANY, job)?;
        batch.work();
        // Waits for queries that a helper is still running.
        Ok(batch.questions.iter().map(|question| session.ask(question)).collect())
    }
}

/// Queries that all threads run together.
struct QuestionBatch {
    session: Arc<Session>,
    questions: Vec<SqlQuery>,
    next: AtomicUsize,
}

impl Prefetch for QuestionBatch {
    fn work(&self) {
        while !self.session.stop.is_stopped()
            && let Some(question) = self.questions.get(self.next.fetch_add(1, Ordering::Relaxed))
        {
            // The session caches the result, also if it is an error.
            let _ = self.session.ask(question);
        }
    }

    fn end(&self) {
        self.next.store(self.questions.len(), Ordering::Relaxed);
    }
}

/// Modules of the rows of a result, without their random keys.
pub(super) struct RowModules {
    symbol: Symbol,
    params: Vec<f64>,
    /// Id of each row, and the number of earlier rows with the same id.
    ids: Vec<(String, usize)>,
    /// Feature of each row, if features are recorded.
    pub(super) owners: Vec<u32>,
    count: usize,
}

impl RowModules {
    /// Creates one module with `symbol`, which `target` declares, for each of the `rows`.
    pub(super) fn new(rows: &QueryRows, symbol: Symbol, target: &Signature, values: &Values) -> Result<Self> {
        let mut made =
            Self { symbol, params: Vec::new(), ids: Vec::new(), owners: Vec::new(), count: rows.len() };
        if rows.is_empty() {
            return Ok(made);
        }
        let names: Vec<&str> = rows.names.iter().map(|name| &**name).collect();
        let columns = fit(&names, &rows.geometries(), target).map_err(|missing| {
            let (missing, first) = (listed(&missing), missing[0]);
            Error::argument(format!("the rows have no column for parameter {missing} of {}", target.usage())).help(format!(
                "the columns are {}: rename a column, as in select ... as {first}, or make the parameter optional: module(\"{}\", ... \"{first}?\")",
                listed(&names),
                target.name
            ))
        })?;
        made.params.reserve(rows.len() * columns.len());
        for (number, row) in rows.iter().enumerate() {
            for (parameter, column) in columns.iter().enumerate() {
                let value = column.map_or(&Value::Nil, |column| &row[column]);
                if parameter < target.required && matches!(value, Value::Nil) {
                    let name = &target.parameters[parameter];
                    return Err(Error::argument(format!(
                        "{name} is NULL in row {}, but {} requires it",
                        number + 1,
                        target.name
                    ))
                    .help(format!(
                        "exclude such rows, where {name} is not null, or set a value: coalesce({name}, 0) as {name}"
                    ))
                    .of_data());
                }
                made.params.push(values.pack(value.clone()));
            }
        }
        if let Some(id) = rows.id() {
            let mut seen: FxHashMap<String, usize> = FxHashMap::default();
            for row in rows.iter() {
                let id = row[id].to_string();
                let times = seen.entry(id.clone()).or_default();
                made.ids.push((id, *times));
                *times += 1;
            }
        }
        Ok(made)
    }

    /// Returns the number of modules.
    pub(super) fn len(&self) -> usize {
        self.count
    }

    /// Appends the modules to `chain`, with random keys derived from `key` if there is one.
    pub(super) fn add_to(&self, chain: &mut Chain, key: Option<ModuleKey>) {
        chain.symbols.resize(chain.symbols.len() + self.count, self.symbol);
        chain.params.extend_from_slice(&self.params);
        let Some(key) = key else { return };
        if self.ids.is_empty() {
            chain.keys.extend((0..self.count).map(|ordinal| key.child(ordinal)));
        } else {
            chain.keys.extend(self.ids.iter().map(|(id, times)| match times {
                0 => key.feature(id),
                times => key.feature(id).child(*times),
            }));
        }
    }
}
