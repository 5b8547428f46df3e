//! Reader of KML, and of KMZ, which is zipped KML: the placemarks of all folders form one layer.
//!
//! Source: OGC 12-007r2, KML 2.3.

use std::borrow::Cow;

use glam::DVec3;

use crate::content::DataFile;
use crate::features::table::FeatureTable;
use crate::formats::typing::TextTypes;
use crate::formats::xml::{Element, Xml, XmlPiece};
use crate::layered_file::LayeredFile;
use crate::source_options::SourceOptions;
use burgeon_base::budget::Budget;
use burgeon_base::error::{Error, Result};
use burgeon_base::text::shown;
use burgeon_kit::Attribute;
use burgeon_spatial::Crs;
use burgeon_spatial::Geometry;

/// KML file.
pub(crate) struct KmlFile {
    file: DataFile,
    layer: String,
}

/// Elements of a placemark that define its appearance; they yield no attributes.
const ASIDE: [&str; 14] = [
    "Style",
    "StyleMap",
    "styleUrl",
    "LookAt",
    "Camera",
    "Region",
    "Snippet",
    "snippet",
    "open",
    "AbstractView",
    "Metadata",
    "balloonVisibility",
    "atom",
    "link",
];

impl KmlFile {
    /// Returns true if an XML file with the root element `root` is KML.
    pub(crate) fn is_one(root: &str) -> bool {
        root == "kml"
    }

    pub(crate) fn open(file: DataFile) -> Self {
        let layer = file.stem().into_owned();
        Self { file, layer }
    }
}

impl LayeredFile for KmlFile {
    fn format(&self) -> &'static str {
        "KML"
    }

    fn layers(&self) -> Vec<&str> {
        vec![&self.layer]
    }

    fn read(&self, layer: &str, wanted: &SourceOptions) -> Result<FeatureTable> {
        let name = &self.file.name;
        let mut xml = Xml::new(&self.file.content, name, &wanted.budget)?;
        let table = FeatureTable::new(layer, name, Crs::epsg(4326), wanted);
        let mut reader =
            PlacemarkReader { table, types: TextTypes::default(), number: 0, budget: &wanted.budget };
        // Names of the open folders, each with the depth of its element.
        let mut folders: Vec<(usize, String)> = Vec::new();
        let mut links = 0;
        loop {
            let element = match xml.next()? {
                XmlPiece::Start(element) => element,
                XmlPiece::End => {
                    folders.retain(|(depth, _)| *depth <= xml.depth);
                    continue;
                }
                XmlPiece::Eof => break,
            };
            match &*element.name {
                "kml" | "Document" => {}
                "Folder" => folders.push((xml.depth, String::new())),
                "name" => {
                    let depth = xml.depth;
                    let text = xml.inner_text()?;
                    if let Some((_, name)) = folders.last_mut().filter(|(folder, _)| *folder + 1 == depth) {
                        *name = text;
                    }
                }
                "Placemark" => {
                    let names: Vec<&str> = folders
                        .iter()
                        .map(|(_, name)| name.as_str())
                        .filter(|name| !name.is_empty())
                        .collect();
                    reader.placemark(&mut xml, &element, &names.join("/"))?;
                    if reader.table.is_full() {
                        break;
                    }
                }
                "NetworkLink" => {
                    links += 1;
                    xml.leave(xml.depth - 1)?;
                }
                _ => xml.leave(xml.depth - 1)?,
            }
        }
        let PlacemarkReader { mut table, types, .. } = reader;
        if links > 0 {
            let what = if links == 1 { "link to another file is" } else { "links to other files are" };
            table
                .notes
                .push(format!("{name}: {links} {what} not followed; download these files, and specify them"));
        }
        types.finish(&mut table)?;
        Ok(table)
    }
}

/// Content of a placemark.
#[derive(Default)]
struct Placemark {
    parts: Vec<Geometry>,
    values: Vec<(String, String)>,
    wrong: Option<String>,
}

struct PlacemarkReader<'b> {
    table: FeatureTable,
    types: TextTypes,
    number: usize,
    budget: &'b Budget,
}

impl PlacemarkReader<'_> {
    fn placemark(&mut self, xml: &mut Xml, element: &Element, folder: &str) -> Result<()> {
        self.number += 1;
        let id = element.attribute("id").filter(|id| !id.is_empty()).map(str::to_owned);
        let mut found = Placemark::default();
        let depth = xml.depth;
        loop {
            match xml.next()? {
                XmlPiece::Start(property) => self.property(xml, &property, &mut found)?,
                XmlPiece::End if xml.depth < depth => break,
                XmlPiece::End => {}
                XmlPiece::Eof => break,
            }
        }
        if let (true, Some(why)) = (found.parts.is_empty(), &found.wrong) {
            let id = id.unwrap_or_else(|| self.number.to_string());
            let error = Error::data(format!("placemark {} of {} {why}", shown(&id), self.table.shown));
            return self.table.refuse(
                id,
                error.help("supported types are points, lines, polygons, tracks and collections of these"),
            );
        }
        let mut attributes: Vec<(usize, Attribute)> = Vec::with_capacity(found.values.len() + 1);
        if !folder.is_empty() {
            attributes.push(self.types.text(&mut self.table, "folder", folder));
        }
        for (name, value) in &found.values {
            attributes.push(self.types.attribute(&mut self.table, name, value));
        }
        match id {
            Some(id) => self.table.push(&id, found.parts, attributes),
            None => self.table.push_unnamed(found.parts, attributes),
        }
    }

    /// Reads an element of a placemark.
    fn property(&mut self, xml: &mut Xml, element: &Element, found: &mut Placemark) -> Result<()> {
        let name = element.name.as_str();
        if ASIDE.contains(&name) {
            return xml.leave(xml.depth - 1);
        }
        if is_geometry(name) {
            let depth = xml.depth;
            let read = self.geometry(xml, element, &mut found.parts)?;
            xml.leave(depth - 1)?;
            if let Err(why) = read {
                found.wrong.get_or_insert(why);
            }
            return Ok(());
        }
        match name {
            "ExtendedData" | "SchemaData" | "TimeStamp" | "TimeSpan" | "Data" | "SimpleArrayData"
            | "AddressDetails" => {
                let depth = xml.depth;
                let own = element.attribute("name").map(str::to_owned);
                loop {
                    match xml.next()? {
                        XmlPiece::Start(inner) if inner.name == "displayName" => drop(xml.inner_text()?),
                        XmlPiece::Start(inner) if inner.name == "value" && own.is_some() => {
                            let value = xml.inner_text()?;
                            found.add(own.as_deref().unwrap_or_default(), value, self.budget)?;
                        }
                        XmlPiece::Start(inner) => self.property(xml, &inner, found)?,
                        XmlPiece::End if xml.depth < depth => return Ok(()),
                        XmlPiece::End => {}
                        XmlPiece::Eof => return Ok(()),
                    }
                }
            }
            // A schema value is named by an attribute of its element.
            "SimpleData" => {
                let name = element.attribute("name").unwrap_or_default();
                found.add(name, xml.inner_text()?, self.budget)
            }
            name => found.add(name, xml.inner_text()?, self.budget),
        }
    }

    /// Adds the parts of the geometry that `element` begins; returns the reason if it cannot be read.
    fn geometry(
        &mut self,
        xml: &mut Xml,
        element: &Element,
        parts: &mut Vec<Geometry>,
    ) -> Result<std::result::Result<(), String>> {
        self.budget.tick()?;
        match &*element.name {
            "MultiGeometry" | "MultiTrack" => {
                let depth = xml.depth;
                loop {
                    match xml.next()? {
                        XmlPiece::Start(inner) if is_geometry(&inner.name) => {
                            let within = xml.depth;
                            let read = self.geometry(xml, &inner, parts)?;
                            xml.leave(within - 1)?;
                            if read.is_err() {
                                return Ok(read);
                            }
                        }
                        XmlPiece::Start(_) => xml.leave(xml.depth - 1)?,
                        XmlPiece::End if xml.depth < depth => return Ok(Ok(())),
                        XmlPiece::End => {}
                        XmlPiece::Eof => return Ok(Ok(())),
                    }
                }
            }
            "Polygon" => {
                let (mut outer, mut holes) = (Vec::new(), Vec::new());
                let mut is_outer = true;
                let depth = xml.depth;
                loop {
                    match xml.next()? {
                        XmlPiece::Start(inner) => match &*inner.name {
                            "outerBoundaryIs" => is_outer = true,
                            "innerBoundaryIs" => is_outer = false,
                            "coordinates" => {
                                let text = xml.inner_text()?;
                                match places(&text, self.budget)? {
                                    Ok(ring) if is_outer => outer.push(ring),
                                    Ok(ring) => holes.push(ring),
                                    Err(why) => return Ok(Err(why)),
                                }
                            }
                            _ => {}
                        },
                        XmlPiece::End if xml.depth < depth => break,
                        XmlPiece::End => {}
                        XmlPiece::Eof => break,
                    }
                }
                if outer.len() > 1 {
                    return Ok(Err("has a polygon with more than one outer ring".into()));
                }
                if !outer.is_empty() {
                    outer.append(&mut holes);
                    parts.extend(Geometry::polygon(outer));
                }
                Ok(Ok(()))
            }
            kind => {
                let mut found = Vec::new();
                let depth = xml.depth;
                loop {
                    match xml.next()? {
                        XmlPiece::Start(inner) if inner.name == "coordinates" => {
                            let text = xml.inner_text()?;
                            match places(&text, self.budget)? {
                                Ok(places) => found.extend(places),
                                Err(why) => return Ok(Err(why)),
                            }
                        }
                        // A track has one position per element, with numbers separated by white space.
                        XmlPiece::Start(inner) if inner.name == "coord" => {
                            let text = xml.inner_text()?.split_whitespace().collect::<Vec<_>>().join(",");
                            match places(&text, self.budget)? {
                                Ok(places) => found.extend(places),
                                Err(why) => return Ok(Err(why)),
                            }
                        }
                        XmlPiece::Start(_) => {}
                        XmlPiece::End if xml.depth < depth => break,
                        XmlPiece::End => {}
                        XmlPiece::Eof => break,
                    }
                }
                match kind {
                    "Point" => parts.extend(found.into_iter().take(1).map(Geometry::point)),
                    _ => parts.extend(Geometry::line(found)),
                }
                Ok(Ok(()))
            }
        }
    }
}

impl Placemark {
    /// Adds a value unless it is empty.
    fn add(&mut self, name: &str, value: String, budget: &Budget) -> Result<()> {
        if value.is_empty() || name.is_empty() {
            return Ok(());
        }
        budget.take(100 + name.len() + value.len())?;
        match self.values.iter_mut().find(|(known, _)| known == name) {
            Some((_, known)) => {
                known.push(';');
                known.push_str(&value);
            }
            None => self.values.push((name.to_owned(), value)),
        }
        budget.give(100);
        Ok(())
    }
}

fn is_geometry(name: &str) -> bool {
    matches!(
        name,
        "Point" | "LineString" | "LinearRing" | "Polygon" | "MultiGeometry" | "Track" | "MultiTrack"
    )
}

/// Returns a list of positions without white space beside the commas in a position. A comma after two numbers ends the
/// position, unless a single number follows, which is its height.
fn without_space_beside_commas(text: &str) -> Cow<'_, str> {
    let bytes = text.as_bytes();
    let is_space = |at: Option<usize>| at.and_then(|at| bytes.get(at)).is_some_and(u8::is_ascii_whitespace);
    let has_space = |at: usize| is_space(at.checked_sub(1)) || is_space(Some(at + 1));
    if !bytes.iter().enumerate().any(|(at, byte)| *byte == b',' && has_space(at)) {
        return text.into();
    }
    let (mut joined, mut start) = (String::with_capacity(text.len()), 0);
    for word in text.split_whitespace() {
        let last = &joined[start..];
        let commas = last.matches(',').count();
        let is_open = last.ends_with(',') && (commas == 1 || commas == 2 && !word.contains(','));
        if !joined.is_empty() && !is_open && !word.starts_with(',') {
            joined.push(' ');
            start = joined.len();
        }
        joined.push_str(word);
    }
    joined.into()
}

/// Parses a list of positions: commas separate numbers, white space separates positions. White space beside a comma
/// separates nothing.
fn places(text: &str, budget: &Budget) -> Result<std::result::Result<Vec<DVec3>, String>> {
    budget.take(text.len())?;
    let mut places = Vec::new();
    let joined = without_space_beside_commas(text);
    for place in joined.split_whitespace() {
        budget.tick()?;
        let mut numbers = place.split(',').map(|text| text.trim().parse::<f64>());
        let (Some(Ok(x)), Some(Ok(y))) = (numbers.next(), numbers.next()) else {
            return Ok(Err(format!("has \"{}\" instead of coordinates", shown(place))));
        };
        let z = numbers.next().and_then(std::result::Result::ok).unwrap_or_default();
        places.push(DVec3::new(x, y, z));
    }
    budget.give(text.len());
    Ok(Ok(places))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn white_space_beside_commas_does_not_end_a_position() {
        for (text, expected) in [
            ("24.9,60.2,5 25,61,6", vec![[24.9, 60.2, 5.0], [25.0, 61.0, 6.0]]),
            ("24.9, 60.2, 5", vec![[24.9, 60.2, 5.0]]),
            ("24.9, 60.2, 5\n25 ,61 , 6", vec![[24.9, 60.2, 5.0], [25.0, 61.0, 6.0]]),
            ("24.9, 60.2 25, 61", vec![[24.9, 60.2, 0.0], [25.0, 61.0, 0.0]]),
            ("24.9,60.2, 25,61,", vec![[24.9, 60.2, 0.0], [25.0, 61.0, 0.0]]),
        ] {
            let found = places(text, &Budget::default()).unwrap().unwrap();
            assert_eq!(found, expected.into_iter().map(DVec3::from).collect::<Vec<_>>(), "{text}");
        }
    }
}
