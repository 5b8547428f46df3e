//! Layers that are read piece by piece, so that memory does not grow with their size.

use std::ops::ControlFlow;
use std::path::Path;

use super::features::table::FeatureTable;
use super::frame::{PointBounds, refuse_odd_degrees};
use super::source::Source;
use super::source_options::{RecordChoice, SourceOptions};
use burgeon_base::error::{Error, Result};
use burgeon_spatial::{Crs, ReferenceFrame};

/// Number of records of a piece.
const PIECE: usize = 16_384;

/// Calls `visit` with the features of a layer in file order, a piece at a time, until it breaks.
///
/// A GeoPackage is read in pieces of at most 16,384 records, each with its own ids: a repeated id is numbered only within
/// a piece, and a piece can be empty. Files of other formats, and layers with a `limit`, are one piece. Returns true if
/// pieces are used. Fails if the layer cannot be read.
///
/// ```
/// use std::ops::ControlFlow;
///
/// use burgeon_data::{SourceOptions, each_piece};
///
/// let folder = tempfile::tempdir()?;
/// let path = folder.path().join("trees.csv");
/// std::fs::write(&path, "id,longitude,latitude\n7,24.9,60.2\n8,24.9,60.3\n")?;
/// let mut count = 0;
/// each_piece(&path, "trees.csv", &SourceOptions::default(), |table| {
///     count += table.features.len();
///     Ok(ControlFlow::Continue(()))
/// })?;
/// assert_eq!(count, 2);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn each_piece(
    path: &Path,
    name: &str,
    wanted: &SourceOptions,
    mut visit: impl FnMut(FeatureTable) -> Result<ControlFlow<()>>,
) -> Result<bool> {
    let budget = &wanted.budget;
    let mut last = i64::MIN;
    loop {
        let before = budget.used_bytes();
        let source = Source::open_within(path, name, wanted)?;
        let in_pieces = matches!(source, Source::GeoPackage(_)) && wanted.limit.is_none();
        let records = in_pieces.then_some(RecordChoice::After { key: last, most: PIECE });
        let table = source.read(name, &SourceOptions { records, ..wanted.clone() })?;
        let key = table.last_key.filter(|_| in_pieces);
        let flow = visit(table)?;
        budget.settle(before, 0);
        match key {
            Some(key) if flow.is_continue() && key < i64::MAX => last = key,
            _ => return Ok(in_pieces),
        }
    }
}

/// Extent of a layer that is read in pieces, from which the frame follows.
#[derive(Debug, Clone)]
pub struct FrameExtent {
    bounds: PointBounds,
    crs: Option<Crs>,
}

impl Default for FrameExtent {
    fn default() -> Self {
        Self { bounds: PointBounds::new(), crs: None }
    }
}

impl FrameExtent {
    /// Adds the features of a piece. Features with impossible positions are removed from it.
    pub fn add(&mut self, table: &mut FeatureTable) -> Result<()> {
        let crs = table.crs.clone()?;
        refuse_odd_degrees(&crs, table)?;
        table.features.iter().for_each(|feature| self.bounds.add(crs.is_geographic(), feature));
        self.crs = Some(crs);
        Ok(())
    }

    /// Returns the coordinate system and the centre of the layer `shown`, around which [`ReferenceFrame::around`] makes the
    /// frame that the whole layer has.
    ///
    /// Fails without features, or if the layer may be larger than a frame.
    pub fn centre(&self, shown: &str) -> Result<(Crs, [f64; 2])> {
        let centre = self.crs.as_ref().zip(self.bounds.centre());
        let Some((crs, (place, half))) = centre else {
            return Err(Error::data(format!("{shown} has no features")));
        };
        if half * crs.metres() >= ReferenceFrame::FARTHEST / 2.0 {
            return Err(Error::data(format!("{shown} is larger than 2,000 km")).help(
                "divide it into regions, each with a plan of its own: source(file, { within = { west, south, east, north } })",
            ));
        }
        Ok((crs.clone(), place))
    }

    /// Returns the frame of the layer `shown`; fails as [`centre`](Self::centre) does.
    pub fn frame(&self, shown: &str) -> Result<ReferenceFrame> {
        let (crs, place) = self.centre(shown)?;
        ReferenceFrame::around(&crs, place, shown)
    }
}
