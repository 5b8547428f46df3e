//! `burgeon check`: reports all problems of a script, including those that only occur in a run.

use burgeon::Result;
use clap::Args;
use serde_json::json;

use super::report;
use super::shared::ScriptFlags;

/// Checks a script and its required files as far as a run goes, and reports all problems
#[derive(Args)]
pub(crate) struct CheckCommand {
    /// Loads the script and compiles every rule, without deriving anything
    #[arg(long)]
    quick: bool,
    #[command(flatten)]
    script: ScriptFlags,
}

impl CheckCommand {
    pub(crate) fn json(&self) -> bool {
        self.script.json
    }

    pub(crate) fn run(&self) -> Result<()> {
        let path = &self.script.script;
        let options = || -> Result<_> {
            let mut options = self.script.options()?;
            options.limits.whole_program = true;
            Ok(options)
        };
        // The check finds all problems of calls at once, and the run finds the rest.
        let burgeon::ScriptCheck { params, mut warnings, .. } = burgeon::check(path, options()?)?;
        if !self.quick {
            let run = burgeon::run(path, options()?)?;
            warnings.retain(|known| !run.warnings.iter().any(|other| other.is_same(known)));
            warnings.extend(run.warnings);
        }
        if self.script.json {
            let params: Vec<_> = params
                .iter()
                .map(|param| json!({ "name": param.name, "package": param.package, "value": param.value.to_json(), "unit": param.unit, "text": param.doc }))
                .collect();
            let warnings = report::warnings_json(&warnings);
            report::print(&format!("{}\n", json!({ "ok": true, "params": params, "warnings": warnings })))?;
        } else {
            let script = self.script.script.display();
            report::eprint(&report::warnings(&warnings));
            report::eprint(&match warnings.len() {
                0 => format!("{script}: no problems\n"),
                1 => format!("{script} has 1 warning\n"),
                count => format!("{script} has {count} warnings\n"),
            });
            for param in params {
                let unit = if param.unit.is_empty() { String::new() } else { format!(" {}", param.unit) };
                let text = if param.doc.is_empty() { String::new() } else { format!("  {}", param.doc) };
                report::eprint(&format!("  {} = {}{unit}{text}\n", param.name, param.value));
            }
        }
        Ok(())
    }
}
