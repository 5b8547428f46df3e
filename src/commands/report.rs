//! What commands say: errors with the script's line, and the summary of a run.

use std::borrow::Cow;
use std::fmt::Write as _;
use std::io::IsTerminal as _;
use std::path::Path;
use std::time::Duration;

use burgeon::derive::grouped;
use burgeon::script::{Param, Setting};
use burgeon::text::escaped_lines;
use burgeon::{Error, Run, Warning};
use serde_json::json;

/// Prints an error to stderr, with the line of the script that it is about; as JSON to stdout for machines.
pub(crate) fn error(error: &Error, json: bool) {
    if json {
        let problems: Vec<_> = error.problems().map(Error::to_json).collect();
        print(&format!("{}\n", json!({ "ok": false, "errors": problems })));
        return;
    }
    let mut text = String::new();
    for problem in error.problems() {
        let line = problem.place().and_then(line);
        // Writing into a string cannot fail.
        let _ = writeln!(text, "error: {}", problem.with_line(line.as_deref()));
    }
    eprint(&text);
}

/// Warnings for a person, as errors are told.
pub(crate) fn warnings<'a>(warnings: impl IntoIterator<Item = &'a Warning>) -> String {
    let mut text = String::new();
    for warning in warnings {
        let line = warning.place().and_then(line);
        let _ = writeln!(text, "warning: {}", warning.with_line(line.as_deref()));
    }
    text
}

/// Warnings for machines.
pub(crate) fn warnings_json(warnings: &[Warning]) -> serde_json::Value {
    warnings.iter().map(Warning::to_json).collect()
}

/// The text of a line of a script.
fn line(place: &burgeon::error::Place) -> Option<String> {
    let (_, line) = place.excerpt(0, 0).pop()?;
    Some(line.trim().to_owned())
}

/// The summary of a run for a person.
///
/// `listed` is the file that lists what was skipped or simplified, if there is one.
pub(crate) fn summary(run: &Run, writing: Duration, total: Duration, listed: Option<&Path>) -> String {
    let modules: usize = run.systems.iter().map(|system| system.modules()).sum();
    let chains: usize = run.systems.iter().map(|system| system.features.len()).sum();
    let steps = run.systems.iter().map(|system| system.steps).max().unwrap_or(0);
    let times = &run.times;
    let mut text = String::new();
    let _ = writeln!(
        text,
        "{} modules in {}, {}",
        grouped(modules),
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
    if let Some(memory) = peak_memory() {
        let _ = writeln!(text, "{memory} MB of memory at the peak");
    }
    text += &warnings(&run.warnings);
    let report = run.report();
    if !report.is_clean() {
        let _ = match listed {
            Some(path) if path != Path::new("-") => writeln!(text, "{report}: {} lists them", path.display()),
            Some(_) => writeln!(text, "{report}"),
            None => writeln!(text, "{report}: --report FILE lists them"),
        };
    }
    text
}

/// The summary of a run for machines.
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
        "warnings": warnings_json(&run.warnings),
        "params": params_json(&run.params),
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

/// The parameters' values by their names, for machines.
pub(crate) fn params_json(params: &[Param]) -> serde_json::Value {
    params.iter().map(|param| (param.name.clone(), setting_json(&param.value))).collect()
}

/// A parameter's value for machines.
pub(crate) fn setting_json(setting: &Setting) -> serde_json::Value {
    match setting {
        Setting::Number(number) => json!(number),
        Setting::Boolean(value) => json!(value),
        Setting::Text(text) => json!(text),
    }
}

/// The largest resident memory of this process (MB), where the system tells it.
fn peak_memory() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    Some(line.split_whitespace().next()?.parse::<u64>().ok()? / 1024)
}

fn plural(number: usize, noun: &str) -> String {
    format!("{} {noun}{}", grouped(number), if number == 1 { "" } else { "s" })
}

/// A time in milliseconds or seconds.
pub(crate) fn time(duration: Duration) -> String {
    let seconds = duration.as_secs_f64();
    if seconds < 1.0 { format!("{:.1} ms", seconds * 1e3) } else { format!("{seconds:.2} s") }
}

/// Writes to standard output; a reader that has gone away is no error.
pub(crate) fn print(text: &str) {
    use std::io::Write as _;
    // A program gets everything as it is.
    let text = if std::io::stdout().is_terminal() { escaped_lines(text) } else { Cow::Borrowed(text) };
    let _ = std::io::stdout().write_all(text.as_bytes());
}

/// Writes to standard error.
pub(crate) fn eprint(text: &str) {
    use std::io::Write as _;
    let _ = std::io::stderr().write_all(escaped_lines(text).as_bytes());
}
