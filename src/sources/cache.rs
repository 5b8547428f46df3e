//! Layers as they were read last, for runs that follow one another.

use std::fmt;
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};

use super::{Frame, Layer, Wanted};

/// How many layers are kept.
const MOST: usize = 16;

/// Layers by the content of their files: one that is saved anew is read anew, and only then.
#[derive(Default)]
pub struct Cache {
    kept: Mutex<Vec<(String, Arc<Layer>, Frame)>>,
}

impl fmt::Debug for Cache {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Cache")
    }
}

impl Cache {
    /// What tells a layer from all others; `None` if that cannot be told.
    ///
    /// `frame` is that of the run so far, into which the layer is brought.
    pub(crate) fn key(path: &Path, wanted: &Wanted, frame: Option<&Frame>) -> Option<String> {
        let mut log = path.as_os_str().to_owned();
        log.push("-wal");
        // Changes that another program makes stand elsewhere.
        if std::fs::metadata(&log).is_ok_and(|meta| meta.len() > 0) {
            return None;
        }
        let content = blake3::hash(&std::fs::read(path).ok()?);
        let frame = frame.map(|frame| (&frame.name, frame.origin));
        Some(format!("{} {} {wanted:?} {frame:?}", content.to_hex(), path.display()))
    }

    /// The layer with this key, and the frame that it is in.
    pub(crate) fn get(&self, key: &str) -> Option<(Arc<Layer>, Frame)> {
        let kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        let found = kept.iter().find(|(known, ..)| known == key);
        found.map(|(_, layer, frame)| (Arc::clone(layer), frame.clone()))
    }

    /// Keeps a layer; the oldest goes when there are many.
    pub(crate) fn keep(&self, key: String, layer: &Arc<Layer>, frame: &Frame) {
        let mut kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        if kept.len() >= MOST {
            kept.remove(0);
        }
        kept.push((key, Arc::clone(layer), frame.clone()));
    }
}
