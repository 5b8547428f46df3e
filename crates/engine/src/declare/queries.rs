//! SQL queries of a run: the chains that they see, and their rows.

use std::collections::BTreeSet;
use std::path::Path;
use std::sync::Arc;

use super::data::ModuleRows;
use super::session::Session;
use crate::queries::{AskedRows, ChainView, RowSource, SqlQuery};
use burgeon_base::error::Result;
use burgeon_base::locks::LockRecovery;
use burgeon_kit::QueryRows;
use burgeon_rewriting::Symbol;

impl Session {
    /// Sets the chains that queries of rules and interpretations see. No query may be running.
    pub(crate) fn show_chains(&self, view: ChainView) {
        *self.chains.lock().recover() = Arc::new(view);
        self.rows.forget_views();
    }

    /// Returns the rows of a query of a rule or an interpretation; equal while they are cached.
    pub(crate) fn ask(&self, question: &SqlQuery) -> Result<Arc<QueryRows>> {
        let view = Arc::clone(&self.chains.lock().recover());
        self.ask_about(question, &view, false)
    }

    /// Returns the rows of a query about a state of the chains. The rows are cached, until the end of the run
    /// if `stays` is set.
    pub(crate) fn ask_about(
        &self,
        question: &SqlQuery,
        view: &ChainView,
        stays: bool,
    ) -> Result<Arc<QueryRows>> {
        let words = self.rows.words(&question.statement(), |sql| self.table_words(sql));
        let modules = view.find_modules(&words, question.scope());
        if !modules.is_empty() {
            self.asked.lock().recover().extend(modules.iter().map(|module| module.symbol));
        }
        let own = ModuleRows { session: self, view, modules: &modules };
        let source: &dyn RowSource = self.options.inputs.rows.as_deref().unwrap_or(&own);
        let asked = AskedRows {
            source,
            most: self.options.limits.modules,
            view: if modules.is_empty() { 0 } else { view.number() },
            stays,
        };
        let rows = self.rows.ask(question, &asked);
        self.stop.check()?;
        rows
    }

    /// Reports whether a query has named modules with a symbol.
    pub(crate) fn has_asked(&self, symbol: Symbol) -> bool {
        self.asked.lock().recover().contains(&symbol)
    }

    /// Returns the words that may name tables in the queries of all rules, as far as static analysis finds
    /// the SQL texts.
    pub(crate) fn queried_words(&self) -> BTreeSet<String> {
        let scripts = self.script_files();
        let queries = scripts.read.values().flat_map(|source| source.analysis.queries.values().flatten());
        let words = queries.flat_map(|query| self.table_words(&query.sql));
        // The last part of a qualified name is the module.
        words.filter_map(|word| Some(word.rsplit('.').next()?.to_owned())).collect()
    }

    /// Returns the words of an SQL text that may name tables.
    fn table_words(&self, sql: &str) -> Vec<String> {
        self.options.registry.sources().map(|sources| sources.table_words(sql)).unwrap_or_default()
    }

    /// Returns the data file in `folder` whose name is most similar to `wanted`.
    pub(crate) fn nearest_file(&self, folder: &Path, wanted: &str) -> Option<String> {
        self.options.registry.sources()?.nearest_file(folder, wanted)
    }
}
