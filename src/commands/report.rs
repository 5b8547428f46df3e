//! Messages of commands: errors with the script's line, and the summary of a run.

use std::fmt::Write as _;
use std::io::{self, BufWriter, ErrorKind, IsTerminal as _, StdoutLock, Write as _};
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use burgeon::error::{Excerpt, SourcePlace};
use burgeon::results::{FeatureReport, ReportTotal};
use burgeon::script::Param;
use burgeon::sources::ReferenceFrame;
use burgeon::text::{escaped_lines, grouped, number, shown};
use burgeon::{Error, Result, Run, Warning};
use serde_json::json;

use super::shared::text_in_memory;
use super::style;

/// Axes of a run's coordinates.
const WORLD_AXES: &str = "x east, y north, z up (m)";

/// Prints an error to stderr, with the line of the script where it occurred. With `json`, prints JSON to stdout if
/// possible.
pub(crate) fn error(error: &Error, json: bool) {
    if json && print(&format!("{}\n", json!({ "ok": false, "errors": error_list(error) }))).is_ok() {
        return;
    }
    let mut text = String::new();
    for problem in error.problems() {
        // Writing into a string cannot fail.
        let _ = writeln!(
            text,
            "error: {}",
            problem.with_excerpt(error_excerpt(problem).as_ref(), style::width())
        );
    }
    eprint(&text);
}

/// Formats warnings as text, in the format of errors.
pub(crate) fn warnings<'a>(warnings: impl IntoIterator<Item = &'a Warning>) -> String {
    let mut text = String::new();
    for warning in warnings {
        let excerpt = warning_excerpt(warning);
        let _ = writeln!(text, "warning: {}", warning.with_excerpt(excerpt.as_ref(), style::width()));
    }
    text
}

/// Converts the problems of an error to JSON, with their columns.
pub(crate) fn error_list(error: &Error) -> Vec<serde_json::Value> {
    let problem = |problem: &Error| located_json(problem.to_json(), "error", error_excerpt(problem));
    error.problems().map(problem).collect()
}

/// Converts warnings to JSON, with their columns.
pub(crate) fn warnings_json(warnings: &[Warning]) -> serde_json::Value {
    let warning = |warning: &Warning| located_json(warning.to_json(), "warning", warning_excerpt(warning));
    warnings.iter().map(warning).collect()
}

/// Returns the line of the location of an error or a warning. `in_memory` reads it in the text of a script on standard input,
/// `on_disk` in its file.
fn excerpt_at(
    place: Option<&SourcePlace>,
    in_memory: impl FnOnce(&str) -> Option<Excerpt>,
    on_disk: impl FnOnce() -> Option<Excerpt>,
) -> Option<Excerpt> {
    match text_in_memory(&place?.file) {
        Some(text) => in_memory(&text),
        None => on_disk(),
    }
}

fn error_excerpt(error: &Error) -> Option<Excerpt> {
    excerpt_at(error.place(), |text| error.excerpt_of(text), || error.excerpt())
}

fn warning_excerpt(warning: &Warning) -> Option<Excerpt> {
    excerpt_at(warning.place(), |text| warning.excerpt_of(text), || warning.excerpt())
}

/// Adds the severity and the columns of an error or a warning to its JSON.
fn located_json(mut json: serde_json::Value, severity: &str, excerpt: Option<Excerpt>) -> serde_json::Value {
    json["severity"] = severity.into();
    excerpt.into_iter().for_each(|excerpt| excerpt.add_to(&mut json));
    json
}

/// Formats the summary of a run as text.
///
/// `listed` is the file that lists skipped and simplified features, if there is one.
pub(crate) fn summary(run: &Run, writing: Duration, total: Duration, listed: Option<&Path>) -> String {
    let modules: usize = run.systems.iter().map(|system| system.modules()).sum();
    let chains: usize = run.systems.iter().map(|system| system.features.len()).sum();
    let steps = run.systems.iter().map(|system| system.steps).max().unwrap_or(0);
    let times = &run.times;
    let mut text = String::new();
    let _ = writeln!(
        text,
        "{} in {}, {}",
        plural(modules, "module"),
        plural(chains, "chain"),
        plural(steps, "step")
    );
    let _ = writeln!(
        text,
        "{} triangles, {}, {}",
        grouped(run.scene.triangles()),
        plural(run.scene.instances.len(), "instance"),
        plural(run.scene.materials.len(), "material")
    );
    let _ = writeln!(
        text,
        "{} in all: script {}, rewriting {}, interpretation {}, scene {}, writing {}",
        time(total),
        time(times.script),
        time(times.derivation.rewriting),
        time(times.derivation.interpretation),
        time(times.scene),
        time(writing)
    );
    if let Some(frame) = run.service::<ReferenceFrame>() {
        let _ = writeln!(text, "origin at {}; {WORLD_AXES}", frame.world_place());
    }
    for (name, ReportTotal { sum, count, chains }) in totals(run).iter().take(MOST_TOTALS) {
        #[allow(clippy::cast_precision_loss, reason = "fewer than 2^52 reports")]
        let mean = if count > chains {
            format!(", {} on average of {count}", number(sum / *count as f64))
        } else {
            String::new()
        };
        let (sum, chains) = (number(*sum), plural(*chains, "chain"));
        let _ = writeln!(text, "reported {}: {sum} in {chains}{mean}", shown(name));
    }
    text += &memory_text();
    for note in &run.notes {
        let _ = writeln!(text, "note: {note}");
    }
    text += &warnings(&run.warnings);
    let report = run.report();
    if !report.is_clean() {
        let _ = match listed {
            Some(path) if path != Path::new("-") => writeln!(text, "{report}: {} lists them", path.display()),
            Some(_) => writeln!(text, "{report}"),
            None => writeln!(text, "{report}: --report FILE lists them{}", frequent_remarks(&report)),
        };
    }
    text
}

/// Returns a line for each of the most frequent remarks on features.
fn frequent_remarks(report: &FeatureReport) -> String {
    const MOST: usize = 3;
    let mut counts: Vec<(&String, &usize)> = report.counts.iter().collect();
    counts.sort_by_key(|(_, count)| std::cmp::Reverse(**count));
    counts.iter().take(MOST).fold(String::new(), |mut text, (what, count)| {
        let _ = write!(text, "\n  {} x {}", grouped(**count), shown(what));
        text
    })
}

/// Maximum number of reported numbers in a summary.
const MOST_TOTALS: usize = 20;

/// Returns the totals of the reported numbers of all systems by name. A name with dots also counts for the names above it:
/// "cost.windows" for "cost".
fn totals(run: &Run) -> Vec<(String, ReportTotal)> {
    let mut totals: Vec<(String, ReportTotal)> = Vec::new();
    for (name, own) in run.systems.iter().flat_map(|system| system.report_totals()) {
        let ends = name.match_indices('.').map(|(end, _)| end).chain([name.len()]);
        for name in ends.map(|end| &name[..end]).filter(|name| !name.is_empty()) {
            let index = totals.iter().position(|(known, _)| known == name).unwrap_or_else(|| {
                totals.push((name.to_owned(), ReportTotal::default()));
                totals.len() - 1
            });
            let total = &mut totals[index].1;
            total.sum += own.sum;
            total.count += own.count;
            // Names below another one are mostly reported by the same chains.
            total.chains = total.chains.max(own.chains);
        }
    }
    totals
}

/// Returns the totals of the reported numbers as JSON.
fn totals_json(run: &Run) -> serde_json::Value {
    let total = |(name, total): (String, ReportTotal)| {
        (name, json!({ "sum": total.sum, "count": total.count, "chains": total.chains }))
    };
    totals(run).into_iter().map(total).collect()
}

/// Returns the summary of a run as JSON.
pub(crate) fn summary_json(run: &Run, writing: Duration, total: Duration) -> serde_json::Value {
    let seconds = |duration: Duration| duration.as_secs_f64();
    json!({
        "ok": true,
        "modules": run.systems.iter().map(|system| system.modules()).sum::<usize>(),
        "chains": run.systems.iter().map(|system| system.features.len()).sum::<usize>(),
        "steps": run.systems.iter().map(|system| system.steps).collect::<Vec<_>>(),
        "triangles": run.scene.triangles(),
        "instances": run.scene.instances.len(),
        "materials": run.scene.materials.len(),
        "features": run.report().counts_json(),
        "place": run.service::<ReferenceFrame>().map(|frame| {
            let mut place = frame.world_place().to_json();
            place["axes"] = WORLD_AXES.into();
            place
        }),
        "notes": run.notes,
        "warnings": warnings_json(&run.warnings),
        "params": params_json(&run.params),
        "reports": totals_json(run),
        "packages": packages_json(&run.scene.packages),
        "seconds": {
            "total": seconds(total),
            "script": seconds(run.times.script),
            "rewriting": seconds(run.times.derivation.rewriting),
            "interpretation": seconds(run.times.derivation.interpretation),
            "scene": seconds(run.times.scene),
            "writing": seconds(writing),
        },
        "peak_memory_mb": peak_memory(),
    })
}

/// Returns the packages that a model was made with, as JSON.
fn packages_json(packages: &[burgeon::scene::ScenePackage]) -> serde_json::Value {
    let list = packages.iter().map(|it| json!({ "name": it.name, "version": it.version, "hash": it.hash }));
    list.collect()
}

/// Returns the parameters' values by name, as JSON.
pub(crate) fn params_json(params: &[Param]) -> serde_json::Value {
    params.iter().map(|param| (param.name.as_str(), param.value.to_json())).collect()
}

/// Returns the peak resident memory of this process (MB), if the system reports it.
pub(crate) fn peak_memory() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    Some(line.split_whitespace().next()?.parse::<u64>().ok()? / 1024)
}

/// Formats the peak memory of this process as a line; empty if the system does not report it.
pub(crate) fn memory_text() -> String {
    peak_memory().map(|memory| format!("{memory} MB of memory at the peak\n")).unwrap_or_default()
}

/// Formats numbers of modules and triangles.
pub(crate) fn sizes(modules: usize, triangles: usize) -> String {
    format!("{}, {}", plural(modules, "module"), plural(triangles, "triangle"))
}

fn plural(number: usize, noun: &str) -> String {
    format!("{} {noun}{}", grouped(number), if number == 1 { "" } else { "s" })
}

/// Formats a time in milliseconds or seconds.
pub(crate) fn time(duration: Duration) -> String {
    let seconds = duration.as_secs_f64();
    if seconds < 1.0 { format!("{:.1} ms", seconds * 1e3) } else { format!("{seconds:.2} s") }
}

/// Set if the reader of standard output has closed the pipe before the end.
static CLOSED: AtomicBool = AtomicBool::new(false);

/// Returns true if output was lost because the reader of standard output has closed the pipe.
pub(crate) fn is_closed() -> bool {
    CLOSED.load(Ordering::Relaxed)
}

/// Standard output. A pipe or file receives the output unchanged; a terminal receives it at once, with control
/// characters escaped.
pub(crate) enum StandardOutput {
    Program(StdoutLock<'static>),
    Terminal(Vec<u8>),
}

impl io::Write for StandardOutput {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match self {
            Self::Program(out) => out.write(bytes),
            Self::Terminal(text) => text.write(bytes),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match self {
            Self::Program(out) => out.flush(),
            Self::Terminal(text) => {
                let text = std::mem::take(text);
                let mut out = io::stdout().lock();
                out.write_all(escaped_lines(&String::from_utf8_lossy(&text)).as_bytes())?;
                out.flush()
            }
        }
    }
}

/// Writes to standard output. A reader that closes the pipe, as `head` does, causes no error.
pub(crate) fn print(text: &str) -> Result<()> {
    print_all(|out| out.write_all(text.as_bytes()))
}

/// Writes to standard output as [`print`] does, for content that need not be in memory at once.
pub(crate) fn print_all(
    content: impl FnOnce(&mut BufWriter<StandardOutput>) -> io::Result<()>,
) -> Result<()> {
    let standard = match io::stdout().is_terminal() {
        true => StandardOutput::Terminal(Vec::new()),
        false => StandardOutput::Program(io::stdout().lock()),
    };
    let mut out = BufWriter::new(standard);
    match content(&mut out).and_then(|()| out.flush()) {
        Ok(()) => Ok(()),
        Err(error) if error.kind() == ErrorKind::BrokenPipe => {
            CLOSED.store(true, Ordering::Relaxed);
            Ok(())
        }
        Err(error) => Err(Error::system(format!("cannot write to standard output: {error}"))
            .help("check whether the disk is full and the file can be written")),
    }
}

/// Writes the output of a script's `print` after the place that prints it, as [`printed`] does.
pub(crate) fn printed_at(text: &str, place: Option<&SourcePlace>) {
    match place {
        Some(place) => printed(&format!("{place}: {text}")),
        None => printed(text),
    }
}

/// Writes the output of a script's `print`, with control characters escaped. On a terminal, it replaces the progress
/// line.
pub(crate) fn printed(text: &str) {
    let text = escaped_lines(text);
    let line = match io::stderr().is_terminal() {
        true => format!("\r\u{1b}[2K{text}\n"),
        false => format!("{text}\n"),
    };
    let _ = io::stderr().write_all(line.as_bytes());
}

/// Writes to standard error, in colours if it is a terminal.
pub(crate) fn eprint(text: &str) {
    let _ = io::stderr().write_all(style::with_colors(&escaped_lines(text)).as_bytes());
}
