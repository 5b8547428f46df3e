//! Messages from the server.

use std::collections::BTreeMap;

use super::cause::Cause;
use super::{AroundMessage, HighlightMessage, ModelMessage, ParamMessage, PickMessage, Range, bounded};
use burgeon_base::error::Error;
use serde::Serialize;
use serde_json::Value;

/// Message from the server.
#[derive(Debug, Clone, Serialize)]
#[serde(tag = "type", rename_all = "lowercase")]
pub enum Event {
    /// First message on every connection; the present state follows.
    Hello(Hello),
    /// Absence of the script file.
    Waiting {
        /// Description of the missing file.
        text: String,
    },
    /// Start of a run.
    Working {
        /// Number of the run, from 1.
        run: u64,
        /// Cause of the run.
        cause: Cause,
        /// Changed files.
        files: Vec<String>,
    },
    /// Progress of a run, ten times a second.
    Progress {
        /// Number of the run.
        run: u64,
        /// Progress as human-readable text.
        message: String,
        /// Last completed step.
        step: usize,
        /// Maximum number of steps, if limited.
        steps: Option<usize>,
        /// Number of modules in the chains.
        modules: usize,
    },
    /// Successful end of a run; the page shows its model.
    Model(Box<ModelMessage>),
    /// Failure of a run; the last model remains and is stale.
    Error {
        /// Number of the run.
        run: u64,
        /// Cause of the run.
        cause: Cause,
        /// Text of all problems.
        text: String,
        /// Problems: `{ code, message, file, line, excerpt, rule, module, step, help }`, with unknown fields absent;
        /// the excerpt consists of lines `{ line, text }`. If there are very many problems, only the first ones are
        /// sent.
        errors: Vec<Value>,
        /// Total number of problems.
        number: usize,
        /// Parameters of the shown model, with the values that caused the error; empty if there is no model.
        params: Vec<ParamMessage>,
        /// Seed that caused the error.
        seed: String,
    },
    /// Texts that the scripts of a run have printed so far.
    Printed {
        /// Number of the run.
        run: u64,
        /// First texts, and then the last ones.
        lines: Vec<PrintMessage>,
        /// Index in `lines` of the first text after those that are left out.
        gap: usize,
        /// Number of texts that are left out.
        left_out: u64,
    },
    /// Cancellation of a run, by a page or by a newer run.
    Cancelled {
        /// Number of the run.
        run: u64,
        /// Set if no newer run is scheduled although the shown model is out of date.
        stale: bool,
    },
    /// Module that made a triangle.
    Picked(Box<PickMessage>),
    /// Modules and triangles that a line of a script has made.
    Highlighted(Box<HighlightMessage>),
    /// Part of a chain.
    Chain {
        /// Id of the query.
        id: u64,
        /// Index of the system in the script, from 0.
        system: usize,
        /// Index of the chain.
        chain: usize,
        /// Index of the module in the centre.
        module: usize,
        /// Number of modules and brackets of the chain.
        of: usize,
        /// Part of the chain as text.
        #[serde(flatten)]
        text: AroundMessage,
    },
    /// Place of a camera.
    Camera {
        /// Id of the query.
        id: u64,
        /// Position (m, z up).
        eye: [f64; 3],
        /// Point in the middle of the picture (m, z up).
        target: [f64; 3],
        /// Set for a parallel projection.
        parallel: bool,
        /// Vertical field of view (degrees), or the height (m) that a parallel projection shows.
        shown: f64,
    },
    /// Chains of the systems with drawn features, as far as they match a search.
    Parts {
        /// Id of the query.
        id: u64,
        /// First matching chains.
        parts: Vec<PartMessage>,
        /// Number of matching chains.
        matching: usize,
    },
    /// Triangles of a part of the model.
    Part {
        /// Id of the query.
        id: u64,
        /// Number of modules of the part, if a symbol selects it.
        modules: usize,
        /// Triangles of the part.
        ranges: Vec<Range>,
    },
    /// Change of the names of presets.
    Presets {
        /// Names of all presets, in the order of their file.
        names: Vec<String>,
        /// Name of the preset with the present values and seed, if any.
        chosen: Option<String>,
    },
    /// Outline of a drawn function, curve or surface.
    Outline {
        /// Id of the query.
        id: u64,
        /// Cubic Bezier pieces, each of four points x, y, z.
        pieces: Vec<[[f64; 3]; 4]>,
    },
    /// Completed save of a drawn function, curve or surface.
    Stored {
        /// Id of the command.
        id: u64,
        /// Name of the file.
        file: String,
    },
    /// Content of a file of the script.
    Source {
        /// Id of the query.
        id: u64,
        /// Name of the file.
        file: String,
        /// Lines without their line feeds.
        lines: Vec<String>,
        /// Hash of the content.
        hash: String,
        /// Set if the file has changed since the page read it, so that it was not overwritten.
        changed: bool,
    },
    /// Completed write of a file of the script.
    Written {
        /// Id of the command.
        id: u64,
        /// Name of the file.
        file: String,
        /// Hash of the new content.
        hash: String,
    },
    /// Progress of the runs for small renders. All renders share one camera, which is known when all scripts have run.
    Variations {
        /// Id of the query.
        id: u64,
        /// Number of scripts that have run.
        ran: usize,
        /// Total number of renders.
        of: usize,
    },
    /// Small render with other values.
    Variation {
        /// Id of the query.
        id: u64,
        /// Index of the render, from 0.
        index: usize,
        /// Total number of renders.
        of: usize,
        /// Human-readable description of the render.
        label: String,
        /// Seed of the run.
        seed: String,
        /// Values of all parameters.
        params: BTreeMap<String, Value>,
        /// URL of the image; `None` if the script failed.
        url: Option<String>,
        /// Error message of the script.
        error: Option<String>,
    },
    /// Information that is sent once.
    Note {
        /// Text of the information.
        text: String,
    },
    /// Rejection of a message.
    Refused {
        /// Id of the message, if it had one.
        id: Option<u64>,
        /// [Code](burgeon_base::error::ErrorKind::code) of the error.
        code: &'static str,
        /// Reason and remedy.
        text: String,
    },
}

/// Text that a script printed.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct PrintMessage {
    /// Text as printed; the end of a long text is cut.
    pub text: String,
    /// File of the line that printed it; empty if unknown.
    pub file: String,
    /// Line that printed it; 0 if unknown.
    pub line: usize,
    /// Number of times in a row that the line printed this text.
    pub count: u64,
}

/// Chain of a system, for the list of the model's parts.
#[derive(Debug, Clone, Serialize)]
pub struct PartMessage {
    /// Index of the system in the script, from 0.
    pub system: usize,
    /// Index of the chain.
    pub chain: usize,
    /// Id of the chain's feature.
    pub feature: Option<String>,
}

/// Properties of the server.
#[derive(Debug, Clone, Serialize)]
pub struct Hello {
    /// Version of Burgeon.
    pub version: &'static str,
    /// File name of the script.
    pub script: String,
    /// Path of the script as named on the command line.
    pub path: String,
    /// Set if `open` opens an editor.
    pub editor: bool,
    /// Formats of `export/`.
    pub formats: Vec<FormatMessage>,
    /// Names of the presets.
    pub presets: Vec<String>,
    /// Time (s) for which the shown model has been out of date, if it is.
    pub stale: Option<f64>,
}

/// Format of a download.
#[derive(Debug, Clone, Serialize)]
pub struct FormatMessage {
    /// Extension without a dot.
    pub extension: &'static str,
    /// Title for users.
    pub title: &'static str,
    /// Set if the camera and the size of the view belong to the request.
    pub picture: bool,
}

impl Event {
    /// Creates the rejection of a message that led to `error`.
    pub fn rejection(id: Option<u64>, error: &Error) -> Self {
        Self::Refused { id, code: error.kind().code(), text: error.to_string() }
    }

    /// Returns the human-readable text of the message, if it has one.
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

    /// Serialises the message. Strings that are too long for a page are cut.
    pub fn to_text(&self) -> String {
        bounded::to_text(self)
    }
}
