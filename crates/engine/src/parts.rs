//! Runs over all parts of the features, one after another.

use std::path::Path;
use std::sync::Arc;

use crate::declare::{FeaturePart, RunOptions, Session};
use burgeon_base::error::Result;

/// Calls `act` with a session for each of `count` parts of the features, one after another.
///
/// Only one part is in memory at a time: memory grows with the size of a part and of the data files, which are read once,
/// and not with the model. Features within `reach` (m) of a part are derived with it; see [`FeaturePart`]. Stops at the
/// first error.
///
/// ```no_run
/// use burgeon_engine::{each_part, run_session, script::RunOptions};
///
/// let mut triangles = 0;
/// each_part("town.lua".as_ref(), &RunOptions::default(), 8, 30.0, |session| {
///     triangles += run_session(session)?.scene.triangles();
///     Ok(())
/// })?;
/// # Ok::<(), burgeon_base::error::Error>(())
/// ```
pub fn each_part(
    script: &Path,
    options: &RunOptions,
    count: usize,
    reach: f64,
    mut act: impl FnMut(&Arc<Session>) -> Result<()>,
) -> Result<()> {
    let mut options = options.clone();
    if let Some(sources) = options.registry.sources().map(|sources| sources.with_cache()) {
        options.registry.set_sources(sources);
    }
    for number in 1..=count {
        let part = Some(FeaturePart { number, count, reach, cell: None });
        act(&Session::new(script, RunOptions { part, ..options.clone() })?)?;
    }
    Ok(())
}
