//! What the server says.

use std::collections::BTreeMap;

use super::{AroundMessage, HighlightMessage, ModelMessage, ParamMessage, PickMessage, bounded};
use burgeon_base::error::Error;
use serde::Serialize;
use serde_json::Value;

/// What the server says.
#[derive(Debug, Clone, Serialize)]
#[serde(tag = "type", rename_all = "lowercase")]
pub enum Event {
    /// First on every connection; the present state follows.
    Hello(Hello),
    /// The script does not exist (yet).
    Waiting {
        /// What is waited for.
        text: String,
    },
    /// A run has begun.
    Working {
        /// The run's number, from 1.
        run: u64,
        /// Why it runs.
        cause: Cause,
        /// The files that changed.
        files: Vec<String>,
    },
    /// How far a run has come, ten times a second.
    Progress {
        /// The run's number.
        run: u64,
        /// It in words.
        message: String,
        /// The last step that is done.
        step: usize,
        /// The greatest number of steps, if there is one.
        steps: Option<usize>,
        /// Modules in the chains.
        modules: usize,
    },
    /// A run has ended well; the page shows its model.
    Model(Box<ModelMessage>),
    /// A run has failed; the last model stays, stale.
    Error {
        /// The run's number.
        run: u64,
        /// Why it ran.
        cause: Cause,
        /// All problems as text.
        text: String,
        /// Each problem: `{ code, message, file, line, excerpt, rule, module, step, help }`, absent where unknown; the excerpt is
        /// of lines `{ line, text }`. Of very many problems only the first ones.
        errors: Vec<Value>,
        /// How many problems there are.
        number: usize,
        /// The parameters of the model that is shown, with the values that led to the error; none without a model.
        params: Vec<ParamMessage>,
        /// The seed that led to it.
        seed: String,
    },
    /// A run was stopped, by a page or by a newer run.
    Cancelled {
        /// The run's number.
        run: u64,
        /// Whether nothing newer is on its way, and yet the model that is shown is not the present one.
        stale: bool,
    },
    /// The module that made a triangle.
    Picked(Box<PickMessage>),
    /// What a line of a script has made.
    Highlighted(Box<HighlightMessage>),
    /// A part of a chain.
    Chain {
        /// The question's id.
        id: u64,
        /// The system's place in the script, from 0.
        system: usize,
        /// The chain.
        chain: usize,
        /// The module in the middle.
        module: usize,
        /// Modules and brackets of the chain.
        of: usize,
        /// The text.
        #[serde(flatten)]
        text: AroundMessage,
    },
    /// The names of the presets have changed.
    Presets {
        /// All names, in the order of their file.
        names: Vec<String>,
        /// The one whose values and seed are the present ones, if there is one.
        chosen: Option<String>,
    },
    /// How many of the small pictures' scripts have run: all of them have one camera, which is known at the end.
    Variations {
        /// The question's id.
        id: u64,
        /// How many have run.
        ran: usize,
        /// How many there will be.
        of: usize,
    },
    /// A small picture of other values.
    Variation {
        /// The question's id.
        id: u64,
        /// Its number, from 0.
        index: usize,
        /// How many there will be.
        of: usize,
        /// What it is, for people.
        label: String,
        /// Its seed.
        seed: String,
        /// All values.
        params: BTreeMap<String, Value>,
        /// Where the picture is; nowhere if the script failed.
        url: Option<String>,
        /// Why it failed.
        error: Option<String>,
    },
    /// Something that is worth knowing, once.
    Note {
        /// What it is.
        text: String,
    },
    /// A message that could not be done.
    Refused {
        /// The message's id, if it had one.
        id: Option<u64>,
        /// The [code](burgeon_base::error::ErrorKind::code) of the error.
        code: &'static str,
        /// Why, and what can be done.
        text: String,
    },
}

/// Who the server is.
#[derive(Debug, Clone, Serialize)]
pub struct Hello {
    /// Burgeon's version.
    pub version: &'static str,
    /// The script's file name.
    pub script: String,
    /// The script as it was named on the command line.
    pub path: String,
    /// Whether `open` opens an editor.
    pub editor: bool,
    /// The extensions of the formats of `export/`.
    pub formats: Vec<&'static str>,
    /// The names of the presets.
    pub presets: Vec<String>,
    /// How long (s) the model that is shown has not been the present one, if it is not.
    pub stale: Option<f64>,
}

/// Why a run was begun.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Cause {
    /// The server has started.
    Start,
    /// A file changed.
    Save,
    /// A parameter was set.
    Parameters,
    /// The seed was set.
    Seed,
    /// The limit of steps was set.
    Steps,
    /// A preset was loaded.
    Preset,
}

impl Event {
    /// What is said of a message that led to `error`.
    pub fn refused(id: Option<u64>, error: &Error) -> Self {
        Self::Refused { id, code: error.kind().code(), text: error.to_string() }
    }

    /// The text for people that it consists of, if it does.
    pub fn text_mut(&mut self) -> Option<&mut String> {
        match self {
            Self::Waiting { text }
            | Self::Note { text }
            | Self::Error { text, .. }
            | Self::Refused { text, .. } => Some(text),
            Self::Variation { error, .. } => error.as_mut(),
            _ => None,
        }
    }

    /// The message as it travels. Texts that no page could show are cut.
    pub fn to_text(&self) -> String {
        bounded::to_text(self)
    }
}
