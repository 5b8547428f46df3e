//! Search for a rule table: several tables change in parallel, and the best is kept.
//!
//! Each table begins with one symbol for all cells. Symbols are split where the error is largest until their
//! number is sufficient, as a codebook of vector quantization grows (Linde, Buzo and Gray, "An algorithm for
//! vector quantizer design", 1980). Then symbols are eliminated, split and exchanged at random. Slightly
//! worse tables are accepted at first, only better ones at the end of a cycle. After each change the numbers
//! are optimized.

use rayon::prelude::*;

use super::code::{Code, SymbolRule, z_order_index};
use super::moves::Problem;
use super::result::FitResult;
use super::targets::{Target, number};
use burgeon_base::random::Stream;

/// Maximum number of cells per side in the search; its results are improved and measured on the whole target.
const COARSE: usize = 64;

/// Number of tables that change in parallel.
const CHAINS: u64 = 8;

/// Number of changes of each table per round.
const CHANGES: usize = 12;

/// Number of rounds per cycle, from large to small accepted errors.
const CYCLE: usize = 40;

/// Parameters of a search.
#[derive(Debug, Clone, PartialEq)]
pub struct Search {
    /// Random seed.
    pub seed: u64,
    /// Maximum number of symbols of the table, at least 1.
    pub symbols: usize,
    /// Maximum number of rounds.
    pub rounds: usize,
    /// Error that ends the search, as a fraction of the target's height range.
    pub enough: f64,
    /// Number of rounds without improvement that ends the search.
    pub patience: usize,
}

impl Default for Search {
    fn default() -> Self {
        Self { seed: 0, symbols: 16, rounds: usize::MAX, enough: 0.01, patience: 2 * CYCLE }
    }
}

/// State of one table.
struct SearchState {
    code: Code,
    error: f64,
    best: Code,
    least: f64,
    stream: Stream,
    tried: usize,
}

impl Search {
    /// Searches for the best rule table for `target`, until `stop` returns true or a limit is reached.
    ///
    /// Calls `tell` with the best table after each round. The result depends only on the search and the
    /// target, not on the number of threads, unless `stop` ends the search.
    ///
    /// ```
    /// use burgeon_terrain::fit::{Search, Target};
    ///
    /// // Each quadrant is like the whole, half as high: one symbol makes all of it.
    /// let target = Target::new(4, vec![
    ///     0.0, 1.0, 2.0, 3.0, //
    ///     2.0, 3.0, 4.0, 5.0, //
    ///     4.0, 5.0, 6.0, 7.0, //
    ///     6.0, 7.0, 8.0, 9.0,
    /// ])?;
    /// let search = Search { symbols: 1, rounds: 200, ..Search::default() };
    /// let found = search.run(&target, &|| false, &mut |_| {});
    /// assert_eq!(found.symbols(), 1);
    /// assert!(found.error() < 0.01 && target.error(&found.map()?) == found.error());
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    pub fn run(
        &self,
        target: &Target,
        stop: &(dyn Fn() -> bool + Sync),
        tell: &mut (dyn FnMut(&FitResult) + Send),
    ) -> FitResult {
        let (low, high) = target.range();
        let blank = SymbolRule { symbols: [0; 4], change: [0.0; 4], factor: [0.5; 4] };
        let begin = Code { rules: vec![blank], height: 0.5 };
        if low >= high {
            return FitResult::new(Code { height: 0.0, ..begin }, target);
        }
        let fine = problem(target, target.across());
        let coarse = problem(target, target.across().min(COARSE));
        let chain = |count| SearchState {
            code: begin.clone(),
            error: f64::INFINITY,
            best: begin.clone(),
            least: f64::INFINITY,
            stream: Stream::new(self.seed.wrapping_mul(CHAINS).wrapping_add(count)),
            tried: 0,
        };
        let mut chains: Vec<SearchState> = (0..CHAINS).map(chain).collect();
        let mut best = FitResult::new(begin, target);
        let (mut least, mut since) = (f64::INFINITY, 0);
        for round in 0..self.rounds {
            let boldness = 0.04 * (1.0 - number(round % CYCLE) / number(CYCLE)).powi(2);
            chains.par_iter_mut().for_each(|chain| chain.round(&coarse, self.symbols, boldness, stop));
            chains.sort_by(|a, b| a.least.total_cmp(&b.least));
            since += 1;
            if chains[0].least < least {
                if chains[0].least < 0.995 * least {
                    since = 0;
                }
                least = chains[0].least;
                let mut code = chains[0].best.tidy();
                if coarse.levels < fine.levels && !stop() {
                    fine.improve(&mut code, 6);
                }
                let found = FitResult::new(code, target);
                if found.error() < best.error() {
                    best = found;
                }
            }
            best.tried = chains.iter().map(|chain| chain.tried).sum();
            tell(&best);
            if stop() || best.error() <= self.enough || since >= self.patience {
                break;
            }
            if round % CYCLE == CYCLE - 1 {
                // Each cycle continues with the better half.
                let (good, bad) = chains.split_at_mut(usize::try_from(CHAINS / 2).unwrap_or(1));
                for (good, bad) in good.iter_mut().zip(bad) {
                    good.code.clone_from(&good.best);
                    bad.code.clone_from(&good.best);
                    bad.best.clone_from(&good.best);
                    (good.error, bad.error, bad.least) = (good.least, good.least, good.least);
                }
            }
        }
        best
    }
}

impl SearchState {
    /// Makes several changes; accepts those that increase the error by up to the fraction `boldness`.
    fn round(&mut self, problem: &Problem, symbols: usize, boldness: f64, stop: &(dyn Fn() -> bool + Sync)) {
        for _ in 0..CHANGES {
            if stop() {
                return;
            }
            let mut code = self.code.clone();
            let unused = code.uses().iter().position(|uses| *uses == 0);
            let spare = unused.or((code.rules.len() < symbols).then_some(code.rules.len()));
            if !self.error.is_finite() {
                problem.refit(&mut code, 0);
            } else if let Some(spare) = spare {
                problem.split(&mut code, spare, &mut self.stream);
            } else if symbols > 1 && self.stream.uniform() < 0.5 {
                if let Some(spare) = problem.retire(&mut code, &mut self.stream) {
                    problem.split(&mut code, spare, &mut self.stream);
                }
            } else {
                problem.turn(&mut code, &mut self.stream);
            }
            problem.improve(&mut code, 3);
            self.tried += 1;
            let error = problem.error(&code);
            if error < self.error * (1.0 + boldness) || spare.is_some() {
                (self.code, self.error) = (code, error);
                if self.error < self.least {
                    self.best.clone_from(&self.code);
                    self.least = self.error;
                }
            }
        }
    }
}

/// Creates the problem of `target`, reduced to `across` cells per side.
fn problem(target: &Target, across: usize) -> Problem {
    let (low, high) = target.range();
    let part = target.across() / across;
    let mut wanted = vec![0.0; across * across];
    let share = 1.0 / number(part * part);
    for (at, height) in target.heights().iter().enumerate() {
        let (x, y) = (at % target.across() / part, at / target.across() / part);
        wanted[z_order_index(x, y)] += share * (height - low) / (high - low);
    }
    Problem::new(wanted, across.trailing_zeros() as usize)
}
