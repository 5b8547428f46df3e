//! `burgeon check`: reports all problems of scripts, including those that only occur in a run.

use std::path::{Path, PathBuf};

use burgeon::script::{Control, Param, Setting};
use burgeon::{Error, Result, ScriptCheck};
use clap::Args;
use serde_json::{Value, json};

use super::report;
use super::shared::ScriptFlags;

/// Checks a script and its required files as far as a run goes, and reports all problems
///
/// Of the types that a script declares, only literals are checked; for complete checks of types, set up an editor: burgeon setup.
#[derive(Args)]
pub(crate) struct CheckCommand {
    /// Loads the script and compiles every rule, without deriving anything
    #[arg(long)]
    quick: bool,
    #[command(flatten)]
    script: ScriptFlags,

    /// Further scripts to check
    #[arg(value_name = "SCRIPTS")]
    more: Vec<PathBuf>,
}

impl CheckCommand {
    pub(crate) fn json(&self) -> bool {
        self.script.json
    }

    /// Checks the scripts. Returns false if one of several has errors, which are then reported.
    pub(crate) fn run(&self) -> Result<bool> {
        if self.more.is_empty() {
            let checked = self.check(&self.script.script)?;
            if self.script.json {
                report::print(&format!("{}\n", checked_json(&checked)))?;
            } else {
                tell(&self.script.script, &checked);
            }
            return Ok(true);
        }
        let scripts = std::iter::once(&self.script.script).chain(&self.more);
        let (mut failed, mut documents) = (0, Vec::new());
        for script in scripts {
            let checked = self.check(script);
            failed += usize::from(checked.is_err());
            if self.script.json {
                let mut document = match &checked {
                    Ok(checked) => checked_json(checked),
                    Err(error) => json!({ "ok": false, "errors": report::error_list(error) }),
                };
                document["script"] = script.display().to_string().into();
                documents.push(document);
                continue;
            }
            match checked {
                Ok(checked) => tell(script, &checked),
                Err(error) => tell_errors(script, &error),
            }
        }
        if self.script.json {
            report::print(&format!("{}\n", json!({ "ok": failed == 0, "scripts": documents })))?;
        } else if failed > 0 {
            report::eprint(&format!("{failed} of {} scripts have errors\n", self.more.len() + 1));
        }
        Ok(failed == 0)
    }

    /// Checks one script.
    fn check(&self, path: &Path) -> Result<ScriptCheck> {
        let mut flags = self.script.clone();
        flags.script = path.to_owned();
        let options = || -> Result<_> {
            let mut options = flags.options()?;
            options.limits.whole_program = true;
            Ok(options)
        };
        // The check finds all problems of calls at once, and the run finds the rest.
        let mut checked = burgeon::check(path, options()?)?;
        if !self.quick {
            let run = burgeon::run(path, options()?)?;
            checked.warnings.retain(|known| !run.warnings.iter().any(|other| other.is_same(known)));
            checked.warnings.extend(run.warnings);
        }
        Ok(checked)
    }
}

/// Prints the warnings and parameters of a script without errors.
fn tell(script: &Path, checked: &ScriptCheck) {
    let script = script.display();
    report::eprint(&report::warnings(&checked.warnings));
    report::eprint(&match checked.warnings.len() {
        0 => format!("{script}: no problems\n"),
        1 => format!("{script} has 1 warning\n"),
        count => format!("{script} has {count} warnings\n"),
    });
    for param in &checked.params {
        let unit = if param.unit.is_empty() { String::new() } else { format!(" {}", param.unit) };
        let text = if param.doc.is_empty() { String::new() } else { format!("  {}", param.doc) };
        report::eprint(&format!("  {} = {}{unit}{text}\n", param.name, param.value));
    }
}

/// Prints the errors of one of several scripts.
fn tell_errors(script: &Path, error: &Error) {
    report::error(error, false);
    let script = script.display();
    report::eprint(&match error.problems().count() {
        1 => format!("{script} has 1 error\n"),
        count => format!("{script} has {count} errors\n"),
    });
}

/// Returns the parameters and warnings of a script without errors as JSON.
fn checked_json(checked: &ScriptCheck) -> Value {
    let params: Vec<Value> = checked.params.iter().map(param_json).collect();
    json!({ "ok": true, "params": params, "warnings": report::warnings_json(&checked.warnings) })
}

/// Returns a parameter with its allowed values as JSON.
fn param_json(param: &Param) -> Value {
    let mut object = json!({
        "name": param.name,
        "package": param.package,
        "value": param.value.to_json(),
        "default": param.default.to_json(),
        "group": param.group,
        "unit": param.unit,
        "text": param.doc,
    });
    let kind = match &param.control {
        Control::Number { min, max, step } => {
            for (key, bound) in [("min", min), ("max", max), ("step", step)] {
                if let Some(bound) = bound {
                    object[key] = Setting::Number(*bound).to_json();
                }
            }
            "number"
        }
        Control::Switch => "boolean",
        Control::Choice(choices) => {
            object["choices"] = choices.iter().map(String::as_str).collect();
            "choice"
        }
        Control::Color => "color",
        Control::Text => "text",
        Control::Points(_) => "points",
    };
    object["type"] = kind.into();
    object
}
