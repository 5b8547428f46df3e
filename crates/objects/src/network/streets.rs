//! Streets and junctions as features for scripts and layer files.

use burgeon_kit::{Answer, HasLayers, Parameter, Value};
use burgeon_spatial::Geometry;
use burgeon_streets::{JunctionId, StreetKind, StreetStretch};
use glam::{DVec2, DVec3};

use super::lots::record;
use super::object::Network;

/// Streets, as records for scripts.
pub struct StreetRecords(Vec<Value>);

impl Answer for StreetRecords {
    fn luau() -> String {
        "{ { id: string, geometry: Geometry, depth: number, kind: string, width: number, sidewalk: number, lanes: number, \
         median: number, parking: number, level: number, length: number, bridge: boolean, from: number, to: number } }"
            .into()
    }

    fn answer(self) -> burgeon_base::error::Result<Value> {
        Ok(self.0.into_value())
    }
}

/// Junctions, as records for scripts.
pub struct JunctionRecords(Vec<Value>);

impl Answer for JunctionRecords {
    fn luau() -> String {
        "{ { id: string, geometry: Geometry, junction: number, degree: number, depth: number, width: number } }"
            .into()
    }

    fn answer(self) -> burgeon_base::error::Result<Value> {
        Ok(self.0.into_value())
    }
}

impl Network {
    pub(super) fn street_records(&self) -> StreetRecords {
        let streets = self.network.stretches();
        let mut known = rustc_hash::FxHashMap::<String, u32>::default();
        let records = streets.iter().map(|street| {
            // The id depends on the position, so that adding a street does not change other ids.
            let id = place_name(middle(&street.line));
            let count = known.entry(id.clone()).or_default();
            *count += 1;
            self.street_record(street, if *count > 1 { format!("{id}#{count}") } else { id })
        });
        StreetRecords(records.collect())
    }

    pub(super) fn junction_records(&self) -> JunctionRecords {
        let junctions = (0..).zip(self.network.junctions());
        let there = junctions.filter(|(_, junction)| ![0, 2].contains(&junction.degree()));
        let record = |(id, _)| self.junction_record(id);
        JunctionRecords(there.map(record).collect())
    }

    fn street_record(&self, street: &StreetStretch, id: String) -> Value {
        let depth = street.attributes.depth;
        let kind = StreetKind::of(&self.kinds, depth).adapt_to(street.attributes);
        let points: Vec<DVec3> = street.line.iter().map(|at| at.extend(0.0)).collect();
        let [from, to] = street.junctions.map(number);
        let metres = Value::Number;
        record([
            ("id", Value::Text(id.into())),
            ("geometry", Geometry::Line(points).into_value()),
            ("depth", depth.into_value()),
            ("kind", Value::Text(self.kind_name(depth).into())),
            ("width", metres(kind.width)),
            ("sidewalk", metres(kind.sidewalk)),
            ("lanes", kind.lanes().into_value()),
            ("median", metres(kind.median)),
            ("parking", metres(kind.parking)),
            ("level", Value::Number(f64::from(street.attributes.level))),
            ("length", metres(street.length())),
            ("bridge", Value::Boolean(street.is_bridge)),
            ("from", from),
            ("to", to),
        ])
    }

    fn junction_record(&self, id: JunctionId) -> Value {
        let at = self.network.at(id);
        let streets: Vec<_> =
            self.network.arms(id).iter().map(|(piece, _)| self.network.attributes(*piece)).collect();
        let depth = streets.iter().map(|street| street.depth).min().unwrap_or_default();
        let width = streets.iter().map(|street| street.width).fold(0.0, f64::max);
        record([
            ("id", Value::Text(place_name(at).into())),
            ("geometry", Geometry::Point(Some(at.extend(0.0))).into_value()),
            ("junction", number(id)),
            ("degree", u32::try_from(streets.len()).unwrap_or(u32::MAX).into_value()),
            ("depth", depth.into_value()),
            ("width", Value::Number(width)),
        ])
    }

    /// Returns the name of the street type of a depth: the name given by the script, or the number of the type.
    fn kind_name(&self, depth: u32) -> String {
        let last = self.options.streets.len() - 1;
        let number = (depth as usize).min(last);
        let name = self.options.streets.get(number).and_then(|kind| kind.name.clone());
        name.unwrap_or_else(|| format!("kind {}", number + 1))
    }
}

impl HasLayers for Network {
    fn layers(&self) -> Vec<(&'static str, Vec<Value>)> {
        vec![
            ("streets", self.street_records().0),
            ("junctions", self.junction_records().0),
            ("blocks", self.block_list()),
        ]
    }
}

/// Returns the number of a junction in scripts.
fn number(junction: JunctionId) -> Value {
    Value::Number(f64::from(junction) + 1.0)
}

/// Returns the id for a position.
fn place_name(at: DVec2) -> String {
    // Adding zero turns -0 into 0.
    format!("{:.0}:{:.0}", at.x.round() + 0.0, at.y.round() + 0.0)
}

/// Returns the point halfway along a line.
fn middle(line: &[DVec2]) -> DVec2 {
    let length: f64 = line.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
    let mut rest = length / 2.0;
    for pair in line.windows(2) {
        let piece = pair[0].distance(pair[1]);
        if piece >= rest && piece > 0.0 {
            return pair[0].lerp(pair[1], rest / piece);
        }
        rest -= piece;
    }
    line.last().copied().unwrap_or_default()
}
