//! `burgeon fit`: fits a rule table for terrain to a height map.

use std::fs::File;
use std::io::{Read, Write as _};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::channel;
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use burgeon::locks::LockRecovery;
use burgeon::terrain::fit::{FitResult, Search, Target};
use burgeon::text::grouped;
use burgeon::{Budget, Error, Result, export, sources};
use clap::Args;
use serde_json::json;

use super::progress::ProgressDisplay;
use super::report;
use super::shared::{on_interrupt, seconds, threads, whole};

/// First lines of a file written by this command.
const MARK: &str = "--!strict\n-- A rule table for terrain";

/// Time limit for writing the best table after an interrupt.
const PATIENCE: Duration = Duration::from_secs(10);

/// Searches for a rule table whose terrain is like a height map
#[derive(Args)]
pub(crate) struct FitCommand {
    /// Height map: hill, ridge, crater, plain, mountains, or a file of heights
    target: String,

    /// Module of rules to write, a .lua file
    #[arg(short, long, value_name = "FILE", value_parser = output, required = true)]
    output: PathBuf,

    /// Seed of all random numbers
    #[arg(long, value_name = "N", value_parser = whole::<u64>, default_value_t = 0, allow_negative_numbers = true)]
    seed: u64,

    /// Stops after this time, with the best table so far [default: 60, or no such limit with --rounds]
    #[arg(long, value_name = "SECONDS", value_parser = seconds, allow_negative_numbers = true)]
    seconds: Option<f64>,

    /// Stops after N rounds, so that the result does not depend on the time [default: no such limit]
    #[arg(long, value_name = "N", value_parser = whole::<usize>, allow_negative_numbers = true)]
    rounds: Option<usize>,

    /// Maximum number of symbols of the table, 1 to 64
    #[arg(long, value_name = "N", default_value_t = 16, value_parser = clap::value_parser!(u8).range(1..=64),
          allow_negative_numbers = true)]
    symbols: u8,

    /// Number of threads; does not affect the result of a round [default: number of cores]
    #[arg(long, value_name = "N", value_parser = threads, allow_negative_numbers = true)]
    threads: Option<u16>,

    /// Prints machine-readable JSON instead of text
    #[arg(long)]
    json: bool,
}

/// Default duration of the search (s), if no limit is set.
const SECONDS: f64 = 60.0;

/// Progress of the search: the number of completed rounds, and the best error with the number of tables tried.
type Best = Arc<Mutex<(usize, Option<(f64, usize)>)>>;

impl FitCommand {
    pub(crate) fn json(&self) -> bool {
        self.json
    }

    pub(crate) fn run(&self) -> Result<()> {
        let begin = Instant::now();
        let target = target(&self.target)?;
        self.check_output()?;
        let over = Arc::new(AtomicBool::new(false));
        let (written, done) = channel::<()>();
        let interrupted = Arc::clone(&over);
        let done = Mutex::new(done);
        on_interrupt(move || {
            interrupted.store(true, Ordering::Release);
            // Wait until the table is written or the time limit is exceeded.
            let _ = done.lock().recover().recv_timeout(PATIENCE);
        })?;
        let (fitted, late) = self.search(&target, begin, &over)?;
        let text = fitted.module(&[
            format!("{}: fitted to {}.", MARK.trim_start_matches("--!strict\n-- "), self.target),
            format!(
                "Root mean square error {} of heights scaled to 0..1; seed {}.",
                fitted.error(),
                self.seed
            ),
        ]);
        export::write_file(&self.output, |out| out.write_all(text.as_bytes()))?;
        let told = self.tell(&fitted, begin.elapsed(), late);
        // An error means that there was no interrupt, so nothing waits.
        let _ = written.send(());
        told
    }

    /// Returns the best table, and the number of completed rounds if the time limit ended the search before `--rounds`.
    fn search(
        &self,
        target: &Target,
        begin: Instant,
        over: &AtomicBool,
    ) -> Result<(FitResult, Option<usize>)> {
        // With a number of rounds and no time limit, the result is the same on every machine.
        let limit = self.seconds.or(self.rounds.is_none().then_some(SECONDS)).map(Duration::from_secs_f64);
        let best = Best::default();
        let shown = Arc::clone(&best);
        let rounds = self.rounds;
        let message = move || {
            let left = limit.map(|limit| limit.saturating_sub(begin.elapsed()));
            message(*shown.lock().recover(), left, rounds)
        };
        let _progress = ProgressDisplay::saying(message, !self.json);
        let late = AtomicBool::new(false);
        let stop = || {
            let ended = limit.is_some_and(|limit| begin.elapsed() >= limit);
            late.fetch_or(ended, Ordering::AcqRel);
            ended || over.load(Ordering::Acquire)
        };
        let mut tell = |fitted: &FitResult| {
            let mut best = best.lock().recover();
            *best = (best.0 + 1, Some((fitted.error(), fitted.tried)));
        };
        let search = Search {
            seed: self.seed,
            symbols: usize::from(self.symbols),
            rounds: self.rounds.unwrap_or(usize::MAX),
            ..Search::default()
        };
        let pool = rayon::ThreadPoolBuilder::new().num_threads(self.threads.map_or(0, usize::from)).build();
        let pool = pool.map_err(|error| {
            Error::system(format!("cannot start threads: {error}")).help("use fewer: --threads 1")
        })?;
        let fitted = pool.install(|| search.run(target, &stop, &mut tell));
        // The round in which the time limit was reached is incomplete.
        let whole = best.lock().recover().0.saturating_sub(1);
        let late = late.into_inner() && self.rounds.is_some();
        Ok((fitted, late.then_some(whole)))
    }

    /// Fails, before any work, if the output file could not be written, or if it was not written by this command.
    fn check_output(&self) -> Result<()> {
        let path = &self.output;
        let shown = path.display();
        if path.is_dir() {
            return Err(Error::file(path, format!("cannot write {shown}: it is a folder"))
                .help(format!("specify a file in it, such as {}", path.join("rules.lua").display())));
        }
        export::check_files([path.as_path()])?;
        if !path.is_file() {
            return Ok(());
        }
        let mut first = Vec::new();
        let read = File::open(path).and_then(|file| file.take(MARK.len() as u64).read_to_end(&mut first));
        if read.is_err() || !(first.is_empty() || first == MARK.as_bytes()) {
            return Err(Error::file(
                path,
                format!("{} already exists and is not a fitted rule table", path.display()),
            )
            .help("specify another file, or move that file away"));
        }
        Ok(())
    }

    fn tell(&self, fitted: &FitResult, elapsed: Duration, late: Option<usize>) -> Result<()> {
        let warning = late.map(|whole| {
            let asked = self.rounds.unwrap_or_default();
            format!(
                "--seconds ended the search after {whole} of {asked} rounds, so the result depends on the machine"
            )
        });
        if self.json {
            let document = json!({
                "ok": true,
                "target": self.target,
                "file": self.output,
                "error": fitted.error(),
                "symbols": fitted.symbols(),
                "tried": fitted.tried,
                "seconds": elapsed.as_secs_f64(),
                "warnings": warning.into_iter().collect::<Vec<_>>(),
            });
            return report::print(&format!("{document}\n"));
        }
        report::eprint(&format!(
            "{}: root mean square error {:.4} with {} symbols, of {} tables tried; {} in all\n",
            self.output.display(),
            fitted.error(),
            fitted.symbols(),
            grouped(fitted.tried),
            report::time(elapsed)
        ));
        if let Some(warning) = warning {
            report::eprint(&format!("warning: {warning}\n  help: remove --seconds\n"));
        }
        Ok(())
    }
}

/// Number of cells along a side of a height map from a file.
const ACROSS: usize = 128;

/// Returns the height map that the command line names: a formula, or a file of heights.
fn target(name: &str) -> Result<Target> {
    let path = Path::new(name);
    if !path.exists() {
        return Target::named(name);
    }
    // Only the shape of the terrain matters: both maps are scaled, so any position and any height range are suitable.
    let raster = sources::read_height_shape(path, name, &Budget::default())?;
    let heights: Vec<f64> = raster.heights.iter().map(|height| f64::from(*height)).collect();
    Target::resample(raster.columns, raster.rows, &heights, ACROSS)
}

fn message(
    (round, best): (usize, Option<(f64, usize)>),
    left: Option<Duration>,
    rounds: Option<usize>,
) -> String {
    let round = rounds.map(|rounds| format!("round {} of {rounds}", (round + 1).min(rounds)));
    let left = left.map(|left| format!("{} s left", left.as_secs()));
    let left = round.into_iter().chain(left).collect::<Vec<_>>().join(", ");
    match best {
        Some((error, tried)) => format!("error {error:.4}, {} tables tried, {left}", grouped(tried)),
        None => format!("the first tables, {left}"),
    }
}

fn output(text: &str) -> Result<PathBuf, &'static str> {
    let path = PathBuf::from(text);
    if Path::new(text).extension().is_some_and(|extension| extension == "lua") {
        Ok(path)
    } else {
        Err("a rule table is a Lua file: specify a .lua file")
    }
}
