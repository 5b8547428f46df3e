//! `burgeon check`: tells all problems of a script at once, without deriving.

use burgeon::Result;
use clap::Args;
use serde_json::json;

use super::report;
use super::shared::ScriptFlags;

/// Loads a script and everything it requires, compiles every rule, and reports all problems at once
#[derive(Args)]
pub(crate) struct CheckCommand {
    #[command(flatten)]
    script: ScriptFlags,
}

impl CheckCommand {
    pub(crate) fn json(&self) -> bool {
        self.script.json
    }

    pub(crate) fn run(&self) -> Result<()> {
        let burgeon::ScriptCheck { params, warnings, .. } =
            burgeon::check(&self.script.script, self.script.options()?)?;
        if self.script.json {
            let params: Vec<_> = params
                .iter()
                .map(|param| json!({ "name": param.name, "package": param.package, "value": report::setting_json(&param.value), "unit": param.unit, "text": param.text }))
                .collect();
            let warnings = report::warnings_json(&warnings);
            report::print(&format!("{}\n", json!({ "ok": true, "params": params, "warnings": warnings })))?;
        } else {
            let script = self.script.script.display();
            report::eprint(&report::warnings(&warnings));
            report::eprint(&match warnings.len() {
                0 => format!("{script} is fine\n"),
                1 => format!("{script} has 1 warning\n"),
                count => format!("{script} has {count} warnings\n"),
            });
            for param in params {
                let unit = if param.unit.is_empty() { String::new() } else { format!(" {}", param.unit) };
                let text = if param.text.is_empty() { String::new() } else { format!("  {}", param.text) };
                report::eprint(&format!("  {} = {}{unit}{text}\n", param.name, param.value));
            }
        }
        Ok(())
    }
}
