//! Options for reading a data file.

use std::borrow::Cow;
use std::fmt;
use std::sync::Arc;

use super::tags::TagFilter;
use burgeon_base::budget::Budget;
use burgeon_spatial::GeometryKind;

/// Records of a GeoPackage to read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RecordChoice {
    /// At most `most` records whose keys are greater than `key`, by key.
    After {
        /// Key before the first record.
        key: i64,
        /// Maximum number of records.
        most: usize,
    },
    /// Records that the spatial index of the file finds in the box of [`SourceOptions::within`]; all records if the file has
    /// no index.
    Indexed,
}

/// Options for reading a data file.
#[derive(Clone, Default)]
pub struct SourceOptions {
    /// Name of the layer; the only layer if `None`.
    pub layer: Option<String>,
    /// SQL condition on features.
    pub condition: Option<String>,
    /// Filter of OpenStreetMap tags.
    pub tags: Option<TagFilter>,
    /// West, south, east and north of a box that features must touch, in the coordinates of the file. A feature on the
    /// boundary touches the box; one around the box whose bounding box alone intersects the box does not.
    pub within: Option<[f64; 4]>,
    /// Maximum number of features to read.
    pub limit: Option<usize>,
    /// Name of the id attribute.
    pub id: Option<String>,
    /// Type of the geometries to read.
    pub kind: Option<GeometryKind>,
    /// EPSG code that overrides the file's coordinate system.
    pub crs: Option<u32>,
    /// Records of a GeoPackage to read; other formats ignore it.
    pub records: Option<RecordChoice>,
    /// Limits on the resources for reading.
    pub budget: Arc<Budget>,
}

impl fmt::Debug for SourceOptions {
    /// Writes all options that affect the content that is read.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { layer, condition, tags, within, limit, id, kind, crs, records, budget: _ } = self;
        write!(f, "{layer:?} {condition:?} {tags:?} {within:?} {limit:?} {id:?} {kind:?} {crs:?}")?;
        records.map_or(Ok(()), |records| write!(f, " {records:?}"))
    }
}

impl SourceOptions {
    /// Returns the options for a file that does not evaluate conditions itself. The condition and the limit are then
    /// applied after reading.
    pub(super) fn without_condition(&self) -> Cow<'_, Self> {
        match &self.condition {
            Some(_) => Cow::Owned(Self { condition: None, limit: None, ..self.clone() }),
            None => Cow::Borrowed(self),
        }
    }
}
