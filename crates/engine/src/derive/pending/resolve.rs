//! Replaces the placeholder modules of a chain.

use std::cell::RefCell;
use std::sync::Arc;

use rustc_hash::FxHashMap;

use super::fragment::Fragmentation;
use super::query::{QuestionSet, RowModules};
use super::sites::{PendingSite, sites};
use crate::derive::plan::DerivationPlan;
use crate::derive::threads::{LeadingMachine, ThreadPool};
use crate::machine::Machine;
use crate::placeholders::{FRAGMENT, QUERY};
use crate::queries::SqlQuery;
use crate::results::{PendingAnswer, RESOLVED, RowFeatures};
use burgeon_base::error::{Error, Limit, Result, SourcePlace};
use burgeon_base::text::grouped;
use burgeon_base::warning::{Warning, WarningKind};
use burgeon_kit::Values;
use burgeon_kit::{QueryRows, Value};
use burgeon_rewriting::{Chain, Mark, NO_RULE, Symbol, module_brief};

/// Number of sites between two checks for cancellation.
const OFTEN: usize = 1024;

/// Chain without placeholders.
#[derive(Default)]
pub(in crate::derive) struct Resolution {
    pub chain: Chain,
    /// For each symbol of the chain before, the number of its successors; empty unless the steps are traced.
    pub applied: Vec<(u16, u32)>,
    /// Descriptions of the replaced placeholders, if the steps are traced.
    pub answers: Vec<PendingAnswer>,
    /// Features of the symbols, if they are recorded.
    owners: Vec<u32>,
}

/// Replaces the placeholder modules of `chain` after `step` steps. `None` if it contains none.
pub(in crate::derive) fn resolve(
    LeadingMachine { machine, threads }: LeadingMachine<'_>,
    plan: &DerivationPlan,
    chain: &Chain,
    step: usize,
    features: Option<&RefCell<RowFeatures>>,
) -> Result<Option<Resolution>> {
    // Most scripts make no placeholders, so their chains are not searched.
    let is_pending = |symbol: &Symbol| *symbol == QUERY || *symbol == FRAGMENT;
    if !machine.session.has_pending() || !chain.symbols.iter().any(is_pending) {
        return Ok(None);
    }
    let resolver = Resolver { machine, plan, chain, step, features };
    let sites =
        sites(chain, plan.steps.grammar.arities()).map_err(|(at, error)| resolver.blame(at, error))?;
    let (answers, asked) = resolver.ask(threads, &sites)?;
    let mut resolution = resolver.put_in(&sites, &answers, &asked)?;
    machine.session.rows.forget_many();
    resolution.chain.mark(plan.steps.batch, plan.steps.grammar.arities());
    if let Some(features) = features {
        features.borrow_mut().replace(std::mem::take(&mut resolution.owners));
    }
    Ok(Some(resolution))
}

/// Query results by number.
type Answers = Vec<Result<Arc<QueryRows>>>;

/// Chain whose placeholders are being replaced.
struct Resolver<'a> {
    machine: &'a Machine,
    plan: &'a DerivationPlan,
    chain: &'a Chain,
    step: usize,
    /// Features of the chain's symbols, if they are recorded.
    features: Option<&'a RefCell<RowFeatures>>,
}

/// Modules that replace a site.
struct SiteModules {
    chain: Chain,
    /// Features of the modules, if they are recorded.
    owners: Vec<u32>,
    /// Number of rows of a query.
    rows: Option<usize>,
}

/// Summary of a replaced site, for the lineage.
struct SiteReport {
    modules: usize,
    rows: Option<usize>,
}

impl Resolver<'_> {
    fn values(&self) -> &Values {
        &self.machine.session.values
    }

    /// Returns parameter `index` of the module at `at`.
    fn value(&self, at: Mark, index: usize) -> Value {
        self.values().unpack(self.chain.params[at.param + index])
    }

    fn text(&self, at: Mark, index: usize) -> Result<Arc<str>> {
        match self.value(at, index) {
            Value::Text(text) => Ok(text),
            _ => Err(Error::internal("a placeholder module has no value")),
        }
    }

    /// Returns true if the chain at `at` is skipped because its data is at fault.
    fn is_left_out(&self, at: Mark) -> bool {
        self.plan.objects.as_ref().is_some_and(|objects| objects.failed().contains(at.chain))
    }

    /// Adds the module at `at`, and the line that made it, to an error.
    fn blame(&self, at: Mark, error: Error) -> Error {
        error.at(self.place(at)).module(self.shown(at), self.step)
    }

    /// Returns the line of the script that made the placeholder at `at`.
    fn place(&self, at: Mark) -> Option<SourcePlace> {
        let symbol = self.chain.symbols[at.module];
        let arity = usize::from(self.plan.steps.grammar.arities()[usize::from(symbol)]);
        let Value::Text(line) = self.value(at, arity - 1) else { return None };
        let (file, line) = line.rsplit_once(':')?;
        Some(SourcePlace::new(file, line.parse().ok()?))
    }

    /// Returns the module at `at` as a script writes it, with the values of its parameters.
    fn shown(&self, at: Mark) -> String {
        let text = |index| self.text(at, index).unwrap_or_default();
        match self.chain.symbols[at.module] {
            FRAGMENT => format!("fragment({})", text(0)),
            QUERY => {
                let question = self.question(at).map(|it| it.to_string()).unwrap_or_default();
                let values = question.strip_prefix(&*text(0)).unwrap_or_default();
                format!("query(\"{}\", {}){values}", text(0), text(1))
            }
            symbol => {
                let grammar = &self.plan.steps.grammar;
                let arity = usize::from(grammar.arities()[usize::from(symbol)]);
                let params = &self.chain.params[at.param..][..arity];
                module_brief(grammar.symbols(), self.values(), symbol, params)
            }
        }
    }

    /// Skips the chain of the module at `at` if `error` is a fault of its data; otherwise returns the error.
    fn forgive(&self, at: Mark, error: Error) -> Result<()> {
        let error = self.blame(at, error);
        match &self.plan.objects {
            Some(objects) => objects.failed().forgive(at.chain, error),
            None => Err(error),
        }
    }

    fn question(&self, at: Mark) -> Result<SqlQuery> {
        let values = match self.value(at, 2) {
            Value::Table(values) => Some(values),
            _ => None,
        };
        let scope = self
            .machine
            .library
            .question_scope(&self.machine.session, |session| session.package_of(&self.place(at)?.file));
        Ok(SqlQuery::new(self.text(at, 0)?, values).asked_in(scope))
    }

    /// Returns the symbol that the placeholder at `at` names in parameter `index`.
    fn target(&self, at: Mark, index: usize) -> Result<Symbol> {
        self.plan.steps.grammar.symbols().find(&self.text(at, index)?)
    }

    /// Runs the queries among `sites`. Returns the results, and for each site the number of its result.
    fn ask(&self, threads: &ThreadPool, sites: &[PendingSite]) -> Result<(Answers, Vec<Option<usize>>)> {
        let mut set = QuestionSet::default();
        let mut asked = Vec::with_capacity(sites.len());
        for site in sites {
            let is_asked = self.chain.symbols[site.at.module] == QUERY && !self.is_left_out(site.at);
            asked.push(if is_asked { Some(set.add(self.question(site.at)?)) } else { None });
        }
        Ok((set.ask(self.machine, threads)?, asked))
    }

    /// Returns the chain with all `sites` replaced.
    fn put_in(
        &self,
        sites: &[PendingSite],
        answers: &[Result<Arc<QueryRows>>],
        asked: &[Option<usize>],
    ) -> Result<Resolution> {
        let (arities, session) = (self.plan.steps.grammar.arities(), &self.machine.session);
        let limit = session.options.limits.modules;
        let mut made = Resolution::default();
        if self.plan.steps.traced {
            made.applied = vec![(NO_RULE, 1); self.chain.symbols.len()];
        }
        let mut rows: FxHashMap<(usize, Symbol), RowModules> = FxHashMap::default();
        let mut fragmentation = Fragmentation::default();
        let mut done = Mark::default();
        // Fragment modules are located after the site that they belong to, and are removed.
        let mut gone: Vec<Mark> = sites.iter().flat_map(|site| site.fragments.iter().copied()).collect();
        gone.sort_by_key(|at| at.module);
        let mut gone = gone.into_iter().peekable();
        for (number, (site, asked)) in sites.iter().zip(asked).enumerate() {
            if number % OFTEN == 0 {
                session.stop.check()?;
            }
            while let Some(at) = gone.next_if(|at| at.module < site.at.module) {
                self.keep(&mut made, &mut done, at);
            }
            self.keep(&mut made, &mut done, site.at);
            let before = made.chain.symbols.len();
            let group =
                self.group(site, asked.map(|asked| (asked, &answers[asked])), &mut rows, &mut fragmentation);
            let report = match group {
                Ok(SiteModules { chain: group, owners, rows }) => {
                    made.owners.extend(owners);
                    made.chain.symbols.extend_from_slice(&group.symbols);
                    made.chain.params.extend_from_slice(&group.params);
                    made.chain.keys.extend_from_slice(&group.keys);
                    SiteReport { modules: group.symbols.len(), rows }
                }
                Err((at, error)) => {
                    self.forgive(at, error)?;
                    SiteReport { modules: 0, rows: None }
                }
            };
            if self.plan.steps.traced {
                let count = made.chain.symbols.len() - before;
                made.applied[site.at.module] = (RESOLVED, u32::try_from(count).unwrap_or(u32::MAX));
                site.fragments.iter().for_each(|at| made.applied[at.module] = (RESOLVED, 0));
                made.answers.push(self.answer(site, &report));
            }
            if made.chain.symbols.len() > limit {
                let error = Error::limit(
                    Limit::Modules,
                    format!("the chain exceeds {} modules in step {}", grouped(limit), self.step),
                );
                let error = error.help(
                    "select fewer rows: where ..., or limit 1000; or raise the limit: --module-limit N",
                );
                return Err(self.blame(*site.fragments.last().unwrap_or(&site.at), error));
            }
        }
        for at in gone {
            self.keep(&mut made, &mut done, at);
        }
        let end = Mark { module: self.chain.symbols.len(), param: self.chain.params.len(), chain: 0 };
        self.keep(&mut made, &mut done, end);
        for (at, warning) in fragmentation.warnings() {
            session.warn(self.told(at, warning));
        }
        debug_assert_eq!(
            made.chain.params.len(),
            made.chain.symbols.iter().map(|symbol| usize::from(arities[usize::from(*symbol)])).sum::<usize>()
        );
        Ok(made)
    }

    /// Creates a warning about the module at `at`, with the line that made it.
    fn told(&self, at: Mark, text: &str) -> Warning {
        let placed = self.blame(at, Error::internal(""));
        Warning::new(WarningKind::NoEffect, text).at_place(placed.place())
    }

    /// Copies the symbols from `done` up to the symbol at `at`, and skips that symbol.
    fn keep(&self, made: &mut Resolution, done: &mut Mark, at: Mark) {
        if let Some(features) = self.features {
            let features = features.borrow();
            made.owners.extend((done.module..at.module).map(|symbol| features.owner(symbol)));
        }
        let to = &mut made.chain;
        to.symbols.extend_from_slice(&self.chain.symbols[done.module..at.module]);
        to.params.extend_from_slice(&self.chain.params[done.param..at.param]);
        if !self.chain.keys.is_empty() {
            to.keys.extend_from_slice(&self.chain.keys[done.module..at.module]);
        }
        let arity = self
            .chain
            .symbols
            .get(at.module)
            .map_or(0, |symbol| self.plan.steps.grammar.arities()[usize::from(*symbol)]);
        *done = Mark {
            module: (at.module + 1).min(self.chain.symbols.len()),
            param: at.param + usize::from(arity),
            chain: 0,
        };
    }

    /// Returns the modules that replace `site`, and the number of rows of its query.
    fn group(
        &self,
        site: &PendingSite,
        asked: Option<(usize, &Result<Arc<QueryRows>>)>,
        known: &mut FxHashMap<(usize, Symbol), RowModules>,
        fragmentation: &mut Fragmentation,
    ) -> Result<SiteModules, (Mark, Error)> {
        let mut group = Chain::default();
        let (mut rows, mut owners) = (None, Vec::new());
        let at = |error| (site.at, error);
        let key = self.chain.keys.get(site.at.module).copied();
        match (asked, self.chain.symbols[site.at.module]) {
            (Some((question, answer)), _) => {
                let symbol = self.target(site.at, 1).map_err(at)?;
                let modules = match known.entry((question, symbol)) {
                    std::collections::hash_map::Entry::Occupied(entry) => entry.into_mut(),
                    std::collections::hash_map::Entry::Vacant(entry) => {
                        let answer = answer.as_ref().map_err(|error| at(error.clone()))?;
                        let target = self.plan.steps.grammar.symbols().signature(symbol);
                        let mut modules =
                            RowModules::new(answer, symbol, target, self.values()).map_err(at)?;
                        if let Some(features) = self.features {
                            modules.owners = features.borrow_mut().of_rows(answer, &target.name);
                        }
                        entry.insert(modules)
                    }
                };
                modules.add_to(&mut group, key);
                owners.extend_from_slice(&modules.owners);
                rows = Some(modules.len());
            }
            // The query belongs to a skipped chain.
            (None, QUERY) => {}
            (None, symbol) => {
                let arity = usize::from(self.plan.steps.grammar.arities()[usize::from(symbol)]);
                group.symbols.push(symbol);
                group.params.extend_from_slice(&self.chain.params[site.at.param..][..arity]);
                group.keys.extend(key);
                owners.extend(self.features.map(|features| features.borrow().owner(site.at.module)));
            }
        }
        for fragment in &site.fragments {
            let at = |error| (*fragment, error);
            let symbol = self.target(*fragment, 0).map_err(at)?;
            let symbols = self.plan.steps.grammar.symbols();
            (group, owners) = fragmentation
                .apply((&group, &owners), symbol, symbols, (*fragment, self.values()))
                .map_err(at)?;
        }
        Ok(SiteModules { chain: group, owners, rows })
    }

    /// Describes the replacement of `site`, for the lineage.
    fn answer(&self, site: &PendingSite, report: &SiteReport) -> PendingAnswer {
        let count = |count: usize, of: &str| format!("{count} {of}{}", if count == 1 { "" } else { "s" });
        let mut text = self.shown(site.at);
        if let Some(rows) = report.rows {
            text.push_str(&format!(": {}", count(rows, "row")));
        }
        for fragment in &site.fragments {
            text.push_str(&format!(", {}", self.shown(*fragment)));
        }
        if !site.fragments.is_empty() {
            text.push_str(&format!(": {}", count(report.modules, "part")));
        }
        let at = *site.fragments.last().unwrap_or(&site.at);
        PendingAnswer { symbol: site.at.module, text, place: self.place(at) }
    }
}
