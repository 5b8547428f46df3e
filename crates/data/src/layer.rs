//! Layer in metres, as used by scripts.

use rayon::prelude::*;

use super::features::feature::Feature;
use super::features::table::FeatureTable;
use super::frame::{bring_into, frame_for};
use burgeon_base::error::{Error, Result};
use burgeon_base::text::shown;
use burgeon_base::warning::{Warning, WarningKind};
use burgeon_spatial::ReferenceFrame;

/// Features of a data file, in metres relative to the run's origin.
#[derive(Debug)]
pub struct Layer {
    /// Name of the layer.
    pub name: String,
    /// File and layer, for messages.
    pub shown: String,
    /// Projection of the coordinates.
    pub crs: String,
    /// Origin in that projection (m).
    pub origin: [f64; 2],
    /// Attribute names, in file order.
    pub names: Vec<String>,
    /// Features in file order; outer rings are counter-clockwise, holes clockwise.
    pub features: Vec<Feature>,
    /// Minimum and maximum coordinates (m).
    pub bounds: [[f64; 3]; 2],
    /// Number of skipped features without a geometry, or with one without extent.
    pub empty: usize,
    /// Number of these features that have points, but too few distinct ones for a line or an area.
    pub collapsed: usize,
    /// Ids of skipped features whose geometry cannot be read or has no position, with the reasons.
    pub refused: Vec<(String, Error)>,
    /// Other messages about reading the layer.
    pub notes: Vec<String>,
    /// Number of features without an id, which received an id derived from their content.
    pub derived: usize,
}

impl Layer {
    /// Returns the warnings about reading the layer.
    pub fn warnings(&self) -> Vec<Warning> {
        let features = |count: usize| if count == 1 { "feature" } else { "features" };
        let shown = &self.shown;
        let mut warnings = Vec::new();
        let (bare, collapsed) = (self.empty.saturating_sub(self.collapsed), self.collapsed);
        let why = "with too few different points for a line or an area";
        for (count, why) in [(bare, "without a geometry"), (collapsed, why)] {
            if count > 0 {
                let text = format!("{shown}: skipped {count} {} {why}", features(count));
                warnings.push(Warning::new(WarningKind::Data, text).help("remove them from the file"));
            }
        }
        if let Some((_, error)) = self.refused.first() {
            let (count, such) =
                (self.refused.len(), if self.refused.len() == 1 { ":" } else { ", e.g. this one:" });
            let what = features(count);
            let text = format!("skipped {count} unusable {what}{such} {}", error.message());
            let warning = Warning::new(WarningKind::Data, text);
            warnings.push(warning.help(error.remedy().unwrap_or("repair the file, or remove them")));
        }
        warnings.extend(self.notes.iter().map(|note| Warning::new(WarningKind::Data, note)));
        warnings
    }

    /// Returns a message that features had no ids, if there were any.
    pub fn derived_note(&self) -> Option<String> {
        let features =
            if self.derived == 1 { "feature has no id and gets" } else { "features have no ids and get" };
        let count = burgeon_base::text::grouped(self.derived);
        (self.derived > 0).then(|| {
            format!(
                "{}: {count} {features} one from the feature's content: it changes with the feature; specify an attribute with {{ id = \"name\" }}",
                self.shown
            )
        })
    }

    /// Returns the approximate memory use (bytes).
    pub fn size(&self) -> usize {
        let of = |feature: &Feature| {
            300 + feature.id.len() + feature.geometry.points().count() * 24 + feature.attributes.len() * 40
        };
        self.features.iter().map(of).sum()
    }

    /// Transforms `table` into `frame`; creates the frame if there is none.
    ///
    /// ```
    /// use burgeon_data::{Geometry, Layer, Source, SourceOptions};
    ///
    /// let folder = tempfile::tempdir()?;
    /// let path = folder.path().join("trees.csv");
    /// std::fs::write(&path, "longitude,latitude\n27.0,60.0\n27.001,60.0\n")?;
    /// let table = Source::open(&path, "trees.csv")?.read("trees.csv", &SourceOptions::default())?;
    /// let mut frame = None;
    /// let layer = Layer::new(table, &mut frame)?;
    /// assert!(frame.is_some());
    /// // 0.001 degrees of longitude are 56 m here.
    /// let [[west, ..], [east, ..]] = layer.bounds;
    /// assert!((55.0..57.0).contains(&(east - west)));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn new(mut table: FeatureTable, frame: &mut Option<ReferenceFrame>) -> Result<Self> {
        table.refuse_endless()?;
        let left = |table: &FeatureTable| match table.refused.first() {
            Some((_, error)) if table.features.is_empty() => Err(error.clone()),
            _ => Ok(()),
        };
        left(&table)?;
        let found = match frame {
            Some(frame) => frame.clone(),
            None => frame_for(&mut table).or_else(|error| left(&table).and(Err(error)))?,
        };
        if let Ok(crs) = &table.crs
            && (frame.is_none() || !found.passage(crs)?.stays)
        {
            let note = crs.shift_note(&table.shown);
            table.notes.extend(note.map(|[text, remedy]| format!("{text}; {remedy}")));
        }
        bring_into(&found, &mut table)?;
        // A feature that determines the frame must have a position in it.
        left(&table)?;
        let frame = frame.insert(found);
        let nothing = || [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
        let turned = table.features.par_iter_mut().map(|feature| {
            if let super::Geometry::Polygon(rings) = &mut feature.geometry {
                rings.turn();
            }
            feature.geometry.points().fold(nothing(), |bounds, point| around(bounds, [point.to_array(); 2]))
        });
        let bounds = turned.reduce(nothing, around);
        let invalid = invalid(&table)?;
        table.notes.extend(invalid);
        Ok(Self {
            name: table.layer,
            shown: table.shown,
            crs: frame.name.clone(),
            origin: frame.origin,
            names: table.names,
            features: table.features,
            bounds,
            empty: table.empty,
            collapsed: table.collapsed,
            refused: table.refused,
            notes: table.notes,
            derived: table.derived,
        })
    }
}

/// Returns a message about features with invalid lines or areas, because computations with them may give unexpected
/// results.
fn invalid(table: &FeatureTable) -> Result<Option<String>> {
    let reason = |feature: &Feature| feature.geometry.validity_reason_within(&table.budget);
    let wrong = table.features.par_iter().enumerate().filter_map(|(number, feature)| match reason(feature) {
        Ok(why) => why.map(|_| Ok(number)),
        Err(error) => Some(Err(error)),
    });
    let wrong: Vec<usize> = wrong.collect::<Result<_>>()?;
    let Some(first) = wrong.first().map(|number| &table.features[*number]) else { return Ok(None) };
    let (file, id) = (&table.shown, shown(&first.id));
    let why = reason(first)?.unwrap_or_default();
    let remedy = "geometry:make_valid() and ST_MakeValid repair it; footprints repair it automatically";
    Ok(Some(match wrong.len() {
        1 => format!("{file}: feature {id} is not valid: {why}; {remedy}"),
        count => format!("{file}: {count} features are not valid, such as {id}: {why}; {remedy}"),
    }))
}

/// Returns the union of two bounds; the sign of a zero does not depend on their order.
fn around([a, b]: [[f64; 3]; 2], [c, d]: [[f64; 3]; 2]) -> [[f64; 3]; 2] {
    let each = |choose: fn(f64, f64) -> f64, a: [f64; 3], b: [f64; 3]| {
        std::array::from_fn(|axis| choose(a[axis], b[axis]) + 0.0)
    };
    [each(f64::min, a, c), each(f64::max, b, d)]
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::super::Geometry;
    use super::*;
    use burgeon_geometry::Rings;
    use burgeon_spatial::Crs;

    #[test]
    fn outer_rings_turn_left_and_holes_turn_right() {
        let square = |size: f64| {
            [[0.0, 0.0], [0.0, size], [size, size], [size, 0.0]].map(|[x, y]| DVec3::new(x, y, 0.0)).to_vec()
        };
        let hole: Vec<DVec3> = square(1.0).into_iter().rev().collect();
        let mut table = FeatureTable::new("a", "a", Crs::epsg(3067), &crate::SourceOptions::default());
        table.push("1", vec![Geometry::Polygon(Rings(vec![square(4.0), hole.clone()]))], Vec::new()).unwrap();
        let layer = Layer::new(table, &mut None).unwrap();
        let outer = square(4.0).into_iter().rev().collect();
        let hole = hole.into_iter().rev().collect();
        assert_eq!(layer.features[0].geometry, Geometry::Polygon(Rings(vec![outer, hole])));
        assert_eq!(layer.bounds, [[0.0; 3], [4.0, 4.0, 0.0]]);
    }

    #[test]
    fn what_has_points_but_no_extent_is_not_without_a_geometry() {
        let feature =
            |geometry: &str| format!(r#"{{"type":"Feature","properties":{{}},"geometry":{geometry}}}"#);
        let text = [
            r#"{"type":"Point","coordinates":[7,43]}"#,
            r#"{"type":"Polygon","coordinates":[[[7,43],[7,43],[7,43],[7,43]]]}"#,
            r#"{"type":"LineString","coordinates":[[7,43]]}"#,
            r#"{"type":"Polygon","coordinates":[]}"#,
            "null",
        ];
        let features = text.map(feature).join(",");
        let text = format!(r#"{{"type":"FeatureCollection","features":[{features}]}}"#);
        let table = crate::geojson::read(
            text.as_bytes(),
            std::path::Path::new("a.geojson"),
            "a.geojson",
            &crate::SourceOptions::default(),
        );
        let table = table.unwrap();
        let warnings = Layer::new(table, &mut None).unwrap().warnings();
        let told: Vec<&str> = warnings.iter().map(Warning::message).collect();
        assert_eq!(
            told,
            [
                "a.geojson: skipped 2 features without a geometry",
                "a.geojson: skipped 2 features with too few different points for a line or an area"
            ]
        );
    }

    #[test]
    fn areas_that_cross_themselves_are_told_with_the_reason() {
        let ring = |points: [[f64; 2]; 4]| {
            vec![Geometry::Polygon(Rings(vec![points.map(|[x, y]| DVec3::new(x, y, 0.0)).to_vec()]))]
        };
        let [square, bow_tie] = [
            [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]],
            [[0.0, 0.0], [4.0, 4.0], [4.0, 0.0], [0.0, 4.0]],
        ];
        let told = |shapes: &[[[f64; 2]; 4]]| {
            let mut table = FeatureTable::new("a", "a", Crs::epsg(3067), &crate::SourceOptions::default());
            for (number, shape) in shapes.iter().enumerate() {
                table.push(&number.to_string(), ring(*shape), Vec::new()).unwrap();
            }
            Layer::new(table, &mut None).unwrap().notes
        };
        assert!(told(&[square, square]).is_empty());
        let why = "exterior ring has a self-intersection; geometry:make_valid()";
        assert!(told(&[square, bow_tie])[0].starts_with(&format!("a: feature 1 is not valid: {why}")));
        let several = told(&[bow_tie, square, bow_tie]);
        assert!(
            several[0].starts_with(&format!("a: 2 features are not valid, such as 0: {why}")),
            "{several:?}"
        );
    }

    #[test]
    fn whether_areas_are_valid_is_asked_for_no_longer_than_there_is_time() {
        use std::sync::atomic::{AtomicBool, Ordering};

        static IS_OVER: AtomicBool = AtomicBool::new(false);
        let budget =
            burgeon_base::budget::Budget::new(usize::MAX, || match IS_OVER.load(Ordering::Relaxed) {
                true => Err(Error::cancellation("over")),
                false => Ok(()),
            });
        let ring = |x: f64, y: f64, size: f64| {
            [[x, y], [x + size, y], [x + size, y + size], [x, y + size]]
                .map(|[x, y]| DVec3::new(x, y, 0.0))
                .to_vec()
        };
        let holes =
            (0..1600u32).map(|index| ring(1.0 + f64::from(index % 40), 1.0 + f64::from(index / 40), 0.5));
        let rings = std::iter::once(ring(0.0, 0.0, 42.0)).chain(holes).collect();
        let wanted = crate::SourceOptions { budget, ..crate::SourceOptions::default() };
        let mut table = FeatureTable::new("a", "a", Crs::epsg(3067), &wanted);
        table.push("1", vec![Geometry::Polygon(rings)], Vec::new()).unwrap();
        IS_OVER.store(true, Ordering::Relaxed);
        assert_eq!(Layer::new(table, &mut None).unwrap_err().message(), "over");
    }
}
