//! `burgeon live`: runs the live view of a script, or of a tileset, until it is interrupted.

use std::path::Path;
use std::sync::mpsc::{Receiver, channel};

use burgeon::live::{
    Editor, Live, LiveEvent, LiveTileset, PORT, Settings, TilesetProgress, TilesetSettings, Token, browse,
    has_display,
};
use burgeon::tiles::{TileFolder, TilePlan, TileStatus};
use burgeon::{Error, Result};
use clap::Args;
use serde_json::{Value, json};

use super::api::names_json;
use super::report;
use super::shared::{ScriptFlags, on_interrupt};

/// Flags of the page.
#[derive(Args)]
pub(super) struct PageFlags {
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

/// Shows the model of a script in the browser, and updates it on every save; also shows a folder of tiles
#[derive(Args)]
pub(crate) struct LiveCommand {
    #[command(flatten)]
    script: ScriptFlags,

    #[command(flatten)]
    page: PageFlags,
}

impl LiveCommand {
    pub(crate) fn json(&self) -> bool {
        self.script.json
    }

    pub(crate) fn run(mut self) -> Result<()> {
        if !self.script.script.is_dir() {
            return self.page.serve_script(self.script, &json!({}));
        }
        let interrupted = interrupt()?;
        let live = self.start_tileset()?;
        let why = "it shows the files of the tileset";
        self.page.announce(&self.script, (live.port(), &live.address(), live.token()), why, &json!({}))?;
        // Only an interrupt ends the command; a closed channel counts as one.
        let _ = interrupted.recv();
        drop(live);
        Ok(())
    }

    /// Starts the server of a tileset. Fails if a flag of scripts was given.
    fn start_tileset(&mut self) -> Result<LiveTileset> {
        let mut flags = self.script.given_flags();
        flags.extend(self.page.editor.is_some().then_some("--editor"));
        if !flags.is_empty() {
            return Err(Error::usage(format!("{} is for scripts, but this is a folder", flags.join(", ")))
                .help("leave it out to show the tileset, or name a script"));
        }
        let folder = TileFolder(std::mem::take(&mut self.script.script));
        LiveTileset::start(TilesetSettings {
            folder: folder.path().to_owned(),
            port: self.page.port,
            token: self.page.token.take(),
            progress: Box::new(move || progress(&folder)),
            tell: Box::new(tell),
        })
    }
}

/// Returns the receiver of the first interrupt.
fn interrupt() -> Result<Receiver<()>> {
    let (interrupt, interrupted) = channel();
    on_interrupt(move || {
        // The receiver waits for only one interrupt.
        let _ = interrupt.send(());
    })?;
    Ok(interrupted)
}

impl PageFlags {
    /// Serves the page of a script until an interrupt. The JSON document has the members of `facts` too.
    pub(super) fn serve_script(mut self, mut script: ScriptFlags, facts: &Value) -> Result<()> {
        let interrupted = interrupt()?;
        let live = Live::start(Settings {
            options: script.options()?,
            script: std::mem::take(&mut script.script),
            port: self.port,
            token: self.token.take(),
            editor: self.editor.take(),
            names: names_json(),
            tell: Box::new(tell),
        })?;
        let why = "it allows changing the script and its parameters";
        self.announce(&script, (live.port(), &live.address(), live.token()), why, facts)?;
        let _ = interrupted.recv();
        drop(live);
        Ok(())
    }

    /// Prints the address, and opens the browser if it is wanted. `why` the address is secret is printed too.
    fn announce(
        &self,
        script: &ScriptFlags,
        (port, address, token): (u16, &str, &Token),
        why: &str,
        facts: &Value,
    ) -> Result<()> {
        if script.json {
            let mut document = json!({ "address": address, "port": port, "token": token.as_str() });
            for (name, value) in facts.as_object().into_iter().flatten() {
                document[name] = value.clone();
            }
            report::print(&format!("{document}\n"))?;
        } else {
            report::print(&format!("{address}\n"))?;
            report::eprint(&format!("keep the address secret: {why}; Ctrl-C ends\n"));
        }
        if self.port.is_none() && port != PORT {
            report::eprint(&format!("port {PORT} is in use; using port {port}\n"));
        }
        let opens = self.open || (!self.no_open && !script.json && has_display());
        if let Some(Err(error)) = opens.then(|| browse(address)) {
            report::eprint(&format!("{error}\n"));
        }
        Ok(())
    }
}

/// Reads the progress of the processes that make the tiles; `None` if the folder has no plan.
fn progress(folder: &TileFolder) -> Result<Option<TilesetProgress>> {
    if !Path::exists(&folder.plan()) {
        return Ok(None);
    }
    let status = TileStatus::read(folder, &TilePlan::read(&folder.plan())?)?;
    Ok(Some(TilesetProgress {
        done: status.done,
        failed: status.failed.len(),
        open: status.open,
        part: status.part,
        rate: status.rate,
    }))
}

/// Prints notices to standard error.
fn tell(told: &LiveEvent) {
    match told {
        LiveEvent::Model { triangles, modules, total } => {
            report::eprint(&format!("{} in {}\n", report::sizes(*modules, *triangles), report::time(*total)));
        }
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
