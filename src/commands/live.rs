//! `burgeon live`: runs the live view until it is interrupted.

use std::sync::mpsc::channel;

use burgeon::Result;
use burgeon::live::{Editor, Live, LiveEvent, PORT, Settings, Token, browse, has_display};
use burgeon::text::grouped;
use clap::Args;
use serde_json::json;

use super::report;
use super::shared::{ScriptFlags, on_interrupt};

/// Shows what a script makes in the browser, and shows it anew on every save
#[derive(Args)]
pub(crate) struct LiveCommand {
    #[command(flatten)]
    script: ScriptFlags,

    /// Port to listen on; 0 selects a free port [default: 4747 or the next free port]
    #[arg(long, value_name = "N", help_heading = "Page")]
    port: Option<u16>,

    /// Opens the browser [default: if run from a terminal with a display]
    #[arg(long, conflicts_with = "no_open", help_heading = "Page")]
    open: bool,

    /// Does not open the browser
    #[arg(long, help_heading = "Page")]
    no_open: bool,

    /// Command that opens lines clicked in the page, such as 'code -g {file}:{line}'
    #[arg(long, value_name = "COMMAND", value_parser = editor, help_heading = "Page")]
    editor: Option<Editor>,

    /// Secret part of the address, instead of the one stored for the port
    #[arg(long, value_name = "HEX", value_parser = token, hide = true)]
    token: Option<Token>,
}

impl LiveCommand {
    pub(crate) fn json(&self) -> bool {
        self.script.json
    }

    pub(crate) fn run(self) -> Result<()> {
        let (interrupt, interrupted) = channel();
        on_interrupt(move || {
            // The receiver waits for only one interrupt.
            let _ = interrupt.send(());
        })?;
        let options = self.script.options()?;
        let live = Live::start(Settings {
            script: self.script.script,
            options,
            port: self.port,
            token: self.token,
            editor: self.editor,
            tell: Box::new(tell),
        })?;
        let (port, address) = (live.port(), live.address());
        if self.script.json {
            report::print(&format!(
                "{}\n",
                json!({ "address": address, "port": port, "token": live.token().as_str() })
            ))?;
        } else {
            report::print(&format!("{address}\n"))?;
            report::eprint("keep the address secret: it allows setting parameters; Ctrl-C ends\n");
        }
        if self.port.is_none() && port != PORT {
            report::eprint(&format!("port {PORT} is in use; using port {port}\n"));
        }
        let opens = self.open || (!self.no_open && !self.script.json && has_display());
        if let Some(Err(error)) = opens.then(|| browse(&address)) {
            report::eprint(&format!("{error}\n"));
        }
        // Only an interrupt ends the command; a closed channel counts as one.
        let _ = interrupted.recv();
        drop(live);
        Ok(())
    }
}

/// Prints notices to standard error.
fn tell(told: &LiveEvent) {
    match told {
        LiveEvent::Model { triangles, modules, total } => report::eprint(&format!(
            "{} triangles, {} modules in {}\n",
            grouped(*triangles),
            grouped(*modules),
            report::time(*total)
        )),
        LiveEvent::Failed(error) => report::error(error, false),
        LiveEvent::Warning(warning) => report::eprint(&report::warnings([warning])),
        LiveEvent::Waiting(text) | LiveEvent::Text(text) => report::eprint(&format!("{text}\n")),
    }
}

fn editor(text: &str) -> Result<Editor, String> {
    Editor::from_text(text).map_err(|error| error.to_string())
}

fn token(text: &str) -> Result<Token, String> {
    Token::from_text(text).map_err(|error| error.to_string())
}
