//! Reader of GPX: waypoints become points, routes and tracks become lines.
//!
//! Source: Topografix, GPX 1.1 Schema Documentation.

use glam::DVec3;
use std::borrow::Cow;

use crate::content::DataFile;
use crate::features::table::FeatureTable;
use crate::formats::typing::TextTypes;
use crate::formats::xml::{Element, Xml, XmlPiece};
use crate::layered_file::LayeredFile;
use crate::source_options::SourceOptions;
use burgeon_base::error::{Error, Result};
use burgeon_base::text::shown;
use burgeon_spatial::Crs;
use burgeon_spatial::Geometry;

/// Layers, with the element names of their features.
const LAYERS: [(&str, &str); 3] = [("waypoints", "wpt"), ("routes", "rte"), ("tracks", "trk")];

/// GPX file.
pub(crate) struct GpxFile {
    file: DataFile,
    layers: Vec<&'static str>,
}

impl GpxFile {
    /// Returns true if an XML file with the root element `root` is GPX.
    pub(crate) fn is_one(root: &str) -> bool {
        root == "gpx"
    }

    pub(crate) fn open(file: DataFile, wanted: &SourceOptions) -> Result<Self> {
        let mut found = Self { file, layers: Vec::new() };
        let mut seen = [false; LAYERS.len()];
        found.each(wanted, |xml, element| {
            for ((_, name), seen) in LAYERS.iter().zip(&mut seen) {
                *seen |= *name == element.name;
            }
            xml.leave(xml.depth - 1)?;
            Ok(true)
        })?;
        found.layers =
            LAYERS.iter().zip(seen).filter(|(_, seen)| *seen).map(|((layer, _), _)| *layer).collect();
        if found.layers.is_empty() {
            return Err(Error::data(format!(
                "{} is GPX without waypoints, routes and tracks",
                found.file.name
            ))
            .help("download it again"));
        }
        Ok(found)
    }

    /// Calls `each` with the elements of the file until it returns false.
    fn each(
        &self,
        wanted: &SourceOptions,
        mut each: impl FnMut(&mut Xml, &Element) -> Result<bool>,
    ) -> Result<()> {
        let mut xml = Xml::new(&self.file.content, &self.file.name, &wanted.budget)?;
        loop {
            match xml.next()? {
                XmlPiece::Start(element) if xml.depth == 2 => {
                    if !each(&mut xml, &element)? {
                        return Ok(());
                    }
                }
                XmlPiece::Start(_) | XmlPiece::End => {}
                XmlPiece::Eof => return Ok(()),
            }
        }
    }
}

impl LayeredFile for GpxFile {
    fn format(&self) -> &'static str {
        "GPX"
    }

    fn layers(&self) -> Vec<&str> {
        self.layers.to_vec()
    }

    fn read(&self, layer: &str, wanted: &SourceOptions) -> Result<FeatureTable> {
        let name = &self.file.name;
        let label = if self.layers.len() > 1 {
            format!("{name}:{layer}").into()
        } else {
            Cow::Borrowed(name.as_str())
        };
        let mut table = FeatureTable::new(layer, &label, Crs::epsg(4326), wanted);
        let mut types = TextTypes::default();
        let wanted_name = LAYERS.iter().find(|(known, _)| *known == layer).map_or("", |(_, name)| *name);
        let (mut number, mut single) = (0_usize, 0_usize);
        self.each(wanted, |xml, element| {
            if element.name != wanted_name {
                xml.leave(xml.depth - 1)?;
                return Ok(true);
            }
            number += 1;
            let mut found = GpxFeature::default();
            found.read(xml, element, wanted)?;
            if let Some(why) = found.wrong {
                let error = Error::data(format!("feature {number} of {label} {why}"));
                table.refuse(number.to_string(), error.help("correct it, or remove it"))?;
                return Ok(true);
            }
            let parts = match element.name.as_str() {
                "wpt" => found.segments.concat().into_iter().map(Geometry::point).collect(),
                _ => {
                    single += found.segments.iter().filter(|segment| segment.len() == 1).count();
                    found.segments.into_iter().filter_map(Geometry::line).collect()
                }
            };
            let attributes =
                found.values.iter().map(|(name, value)| types.attribute(&mut table, name, value)).collect();
            table.push_unnamed(parts, attributes)?;
            Ok(!table.is_full())
        })?;
        if single > 0 {
            let what = if single == 1 {
                "segment has one point and was"
            } else {
                "segments have one point and were"
            };
            table.notes.push(format!("{label}: {single} {what} skipped"));
        }
        types.finish(&mut table)?;
        Ok(table)
    }
}

/// Content of a waypoint, a route or a track.
#[derive(Default)]
struct GpxFeature {
    segments: Vec<Vec<DVec3>>,
    values: Vec<(String, String)>,
    wrong: Option<String>,
}

impl GpxFeature {
    fn read(&mut self, xml: &mut Xml, element: &Element, wanted: &SourceOptions) -> Result<()> {
        let depth = xml.depth;
        let is_place = element.name == "wpt";
        let mut place = is_place.then(|| self.place(element)).flatten();
        if !is_place {
            self.segments.push(Vec::new());
        }
        loop {
            match xml.next()? {
                XmlPiece::Start(inner) => match &*inner.name {
                    "trkseg" => self.segments.push(Vec::new()),
                    "rtept" | "trkpt" => {
                        wanted.budget.tick()?;
                        wanted.budget.take(24)?;
                        let within = xml.depth;
                        let mut place = self.place(&inner);
                        loop {
                            match xml.next()? {
                                XmlPiece::Start(inner) if inner.name == "ele" => {
                                    let height = xml.inner_text()?.parse().unwrap_or_default();
                                    place = place.map(|place| place.with_z(height));
                                }
                                XmlPiece::Start(_) => xml.leave(xml.depth - 1)?,
                                XmlPiece::End if xml.depth < within => break,
                                XmlPiece::End => {}
                                XmlPiece::Eof => break,
                            }
                        }
                        if let (Some(place), Some(segment)) = (place, self.segments.last_mut()) {
                            segment.push(place);
                        }
                    }
                    "extensions" => {}
                    "link" => {
                        let link = inner.attribute("href").unwrap_or_default().to_owned();
                        self.add("link", link);
                        xml.leave(xml.depth - 1)?;
                    }
                    name => {
                        let value = xml.inner_text()?;
                        if let (Some(place), "ele") = (&mut place, name) {
                            place.z = value.parse().unwrap_or_default();
                        }
                        self.add(name, value);
                    }
                },
                XmlPiece::End if xml.depth < depth => break,
                XmlPiece::End => {}
                XmlPiece::Eof => break,
            }
        }
        self.segments.extend(place.map(|place| vec![place]));
        Ok(())
    }

    fn place(&mut self, element: &Element) -> Option<DVec3> {
        let [x, y] = ["lon", "lat"].map(|name| element.attribute(name).unwrap_or_default());
        match (x.trim().parse(), y.trim().parse()) {
            (Ok(x), Ok(y)) => Some(DVec3::new(x, y, 0.0)),
            _ => {
                self.wrong.get_or_insert_with(|| {
                    format!("has an invalid position \"{}\", \"{}\"", shown(x), shown(y))
                });
                None
            }
        }
    }

    fn add(&mut self, name: &str, value: String) {
        if value.is_empty() {
            return;
        }
        match self.values.iter_mut().find(|(known, _)| known == name) {
            Some((_, known)) => {
                known.push(';');
                known.push_str(&value);
            }
            None => self.values.push((name.to_owned(), value)),
        }
    }
}
