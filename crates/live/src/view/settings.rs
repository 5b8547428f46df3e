//! Settings of the live view's server, and its events for the process that started it.

use std::path::PathBuf;
use std::time::Duration;

use super::open::Editor;
use super::token::Token;
use burgeon_base::error::Error;
use burgeon_base::warning::Warning;
use burgeon_engine::script::RunOptions;

/// Port that is used if it is free and none was specified.
pub const PORT: u16 = 4747;

/// Receiver of events of a server.
pub type EventReceiver = Box<dyn Fn(&LiveEvent) + Send + Sync>;

/// Settings of a server.
pub struct Settings {
    /// Path of the script, which need not exist yet.
    pub script: PathBuf,
    /// Initial run options. Pages change the parameters, the seed and the step limit.
    pub options: RunOptions,
    /// Port; if `None`, [`PORT`] or one of the next ports.
    pub port: Option<u16>,
    /// Secret part of the address. If `None`, the token stored for the port is used, so that an open page reconnects to
    /// the next server there; if the port may be any free one, a new token.
    pub token: Option<Token>,
    /// Editor that opens lines of the script.
    pub editor: Option<Editor>,
    /// Names of the scripting API for the page's editor as JSON: a list of `{ name, owner, usage, doc }`.
    pub names: String,
    /// Receiver of events. It is called from several threads.
    pub tell: EventReceiver,
}

/// Event for the process that started the server.
#[derive(Debug, Clone)]
pub enum LiveEvent {
    /// Completion of a new model.
    Model {
        /// Number of visible triangles.
        triangles: usize,
        /// Number of modules of all systems.
        modules: usize,
        /// Time from the cause to the model's bytes.
        total: Duration,
    },
    /// Failure of the script.
    Failed(Error),
    /// Warning of the new model that the previous model did not have.
    Warning(Warning),
    /// Absence of the script file.
    Waiting(String),
    /// Other information.
    Text(String),
}
