//! Scan of the features of a source, piece by piece.

use std::ops::ControlFlow;
use std::path::Path;

use burgeon_base::error::{Error, Result};
use burgeon_data::{Feature, FeatureTable, Layer, Source, SourceOptions, each_piece};
use burgeon_export::layers::{ColumnKind, TableColumn};
use burgeon_spatial::ReferenceFrame;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::digest::FeatureDigest;
use super::{PlannedTile, TallRule, TileDivision, feature_digest, id_digest};

/// Feature that no tile contains.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct OmittedFeature {
    /// Layer.
    pub layer: String,
    /// Id of the feature.
    pub feature: String,
    /// Cause.
    pub cause: String,
}

/// Result of a scan.
#[derive(Debug, Clone, PartialEq)]
pub struct ScanResult {
    /// File and layer.
    pub label: String,
    /// Number of features in tiles.
    pub features: u64,
    /// Minimum and maximum coordinates (m) of the features.
    pub bounds: [[f64; 3]; 2],
    /// Set if a part of the file has the same ids as the whole file.
    pub in_parts: bool,
    /// Attributes, and the types of their values.
    pub columns: Vec<TableColumn>,
    /// Features that cannot be in a tile.
    pub left_out: Vec<OmittedFeature>,
    /// Remarks on features that are in tiles, or that are too many to be listed.
    pub notes: Vec<String>,
}

/// Adds the features of a source to `division`, in the coordinates of `frame`. `tall` tells the tall ones.
///
/// A GeoPackage is read in pieces, so memory does not grow with it, unless records have the same id: then ids depend on all
/// records, and the file is read again as a whole, like files of other formats. Fails if the file cannot be read.
pub fn scan_source(
    (path, name, options): (&Path, &str, &SourceOptions),
    frame: &ReferenceFrame,
    tall: Option<&TallRule>,
    division: &mut TileDivision,
) -> Result<ScanResult> {
    let mut scan = SourceScan::new(frame, tall);
    let in_pieces = each_piece(path, name, options, |table| {
        scan.add(table)?;
        Ok(if scan.is_repeated { ControlFlow::Break(()) } else { ControlFlow::Continue(()) })
    })?;
    scan.is_repeated |= repeats(&mut scan.known);
    let in_parts = in_pieces && !scan.is_repeated && options.within.is_none();
    if in_pieces && scan.is_repeated {
        let whole = Source::open_within(path, name, options)?.read(name, options)?;
        scan = SourceScan::new(frame, tall);
        scan.add(whole)?;
    }
    let SourceScan { label, bounds, left_out, notes, division: own, columns, .. } = scan;
    let column = |(name, kind): (String, Option<ColumnKind>)| TableColumn {
        name,
        kind: kind.unwrap_or(ColumnKind::Text),
    };
    let columns = columns.into_iter().map(column).collect();
    let features = own.features();
    let bounds = if features == 0 { [[0.0; 3]; 2] } else { bounds };
    division.merge(own);
    Ok(ScanResult { label, features, bounds, in_parts, columns, left_out, notes })
}

/// Returns true if a number is repeated, and sorts the numbers.
fn repeats(numbers: &mut [u64]) -> bool {
    numbers.par_sort_unstable();
    numbers.windows(2).any(|pair| pair[0] == pair[1])
}

/// Maximum number of listed features.
const LISTED: usize = 100_000;

/// State of a scan.
struct SourceScan<'a> {
    frame: &'a ReferenceFrame,
    tall: Option<&'a TallRule>,
    label: String,
    /// Name of the layer.
    layer: String,
    bounds: [[f64; 3]; 2],
    division: TileDivision,
    /// Attributes, and the types of their values so far.
    columns: Vec<(String, Option<ColumnKind>)>,
    /// Hashes of the ids so far.
    known: Vec<u64>,
    /// Set if pieces have the same id.
    is_repeated: bool,
    left_out: Vec<OmittedFeature>,
    notes: Vec<String>,
}

impl<'a> SourceScan<'a> {
    fn new(frame: &'a ReferenceFrame, tall: Option<&'a TallRule>) -> Self {
        Self {
            frame,
            tall,
            label: String::new(),
            layer: String::new(),
            bounds: [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]],
            division: TileDivision::default(),
            columns: Vec::new(),
            known: Vec::new(),
            is_repeated: false,
            left_out: Vec::new(),
            notes: Vec::new(),
        }
    }

    /// Adds the features of a piece.
    fn add(&mut self, mut table: FeatureTable) -> Result<()> {
        self.label.clone_from(&table.shown);
        self.layer.clone_from(&table.layer);
        let bare = table.empty - table.empty_ids.len().min(table.empty);
        for id in std::mem::take(&mut table.empty_ids) {
            self.leave_out(id, "the feature has no geometry, or too few points for one");
        }
        if bare > 0 {
            self.notes
                .push(format!("{}: {bare} features have no geometry, or too few points for one", self.label));
        }
        self.is_repeated |= !table.repeated_ids.is_empty();
        for id in &table.repeated_ids {
            self.notes.push(format!(
                "{}: several features have the id {id}; further ones are numbered {id}.2 and so on",
                self.label
            ));
        }
        if table.features.is_empty() {
            self.refuse(std::mem::take(&mut table.refused));
            return Ok(());
        }
        let layer = Layer::new(table, &mut Some(self.frame.clone()))?;
        let [low, high] = layer.bounds;
        for axis in 0..3 {
            self.bounds[0][axis] = self.bounds[0][axis].min(low[axis]);
            self.bounds[1][axis] = self.bounds[1][axis].max(high[axis]);
        }
        let (name, names) = (&layer.name, &layer.names);
        let measured: Vec<_> = layer
            .features
            .par_iter()
            .filter_map(|feature| {
                let (id, points) = (feature.id.as_str(), feature.geometry.points().count());
                let ids = id_digest(name, id);
                let is_tall = self.tall.is_some_and(|rule| rule.holds(names, feature));
                Some((feature.geometry.bounds()?, points, ids, feature_digest(name, names, feature), is_tall))
            })
            .collect();
        self.add_columns(&layer);
        for (bounds, points, ids, data, is_tall) in measured {
            self.known.push(ids.short());
            match is_tall {
                true => self.division.add_tall(bounds, points, ids, data)?,
                false => self.division.add(bounds, points, ids, data)?,
            }
        }
        self.refuse(layer.refused);
        Ok(())
    }

    /// Adds the types of the attributes of a layer.
    fn add_columns(&mut self, layer: &Layer) {
        let none = || vec![None; layer.names.len()];
        let add = |mut kinds: Vec<Option<ColumnKind>>, feature: &Feature| {
            for (number, value) in &*feature.attributes {
                if let Some(kind) = kinds.get_mut(*number) {
                    *kind = ColumnKind::join(*kind, ColumnKind::of(value));
                }
            }
            kinds
        };
        let join = |a: Vec<Option<ColumnKind>>, b: Vec<Option<ColumnKind>>| {
            a.into_iter().zip(b).map(|(a, b)| ColumnKind::join(a, b)).collect()
        };
        let kinds = layer.features.par_iter().fold(none, add).reduce(none, join);
        for (name, kind) in layer.names.iter().zip(kinds) {
            match self.columns.iter_mut().find(|(known, _)| known == name) {
                Some((_, known)) => *known = ColumnKind::join(*known, kind),
                None => self.columns.push((name.clone(), kind)),
            }
        }
    }

    fn refuse(&mut self, refused: Vec<(String, Error)>) {
        for (id, error) in refused {
            self.leave_out(id, error.into_message());
        }
    }

    fn leave_out(&mut self, feature: String, cause: impl Into<String>) {
        if self.left_out.len() < LISTED {
            let cause = cause.into();
            self.left_out.push(OmittedFeature { layer: self.layer.clone(), feature, cause });
        }
    }
}

/// Returns the digests of the ids and of the content of the features of `layer` in a tile, and their number. `tall` is the rule of
/// the plan.
pub fn cell_digest(
    layer: &Layer,
    tile: &PlannedTile,
    tall: Option<&TallRule>,
) -> (FeatureDigest, FeatureDigest, u64) {
    let (mut ids, mut data, mut count) = (FeatureDigest::default(), FeatureDigest::default(), 0);
    for feature in tile.own_features(layer, tall) {
        ids.add(id_digest(&layer.name, feature.id.as_str()));
        data.add(feature_digest(&layer.name, &layer.names, feature));
        count += 1;
    }
    (ids, data, count)
}
