//! Reader of the features in a collection.

use std::borrow::Cow;
use std::rc::Rc;

use rustc_hash::FxHashMap;

use super::geometry::{GeometryProblem, GeometryReader, GmlContext, is_geometry};
use super::system::NamedSystem;
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
use burgeon_spatial::Geometry;

/// Open GML file.
pub(crate) struct GmlFile {
    file: DataFile,
    /// Feature types in order of appearance.
    types: Vec<String>,
}

/// Type of an element around features.
#[derive(Clone, Copy, PartialEq)]
enum Level {
    Collection,
    /// Member, which may be part of a city model.
    Member {
        is_city: bool,
    },
}

/// Maximum number of feature types.
const MOST_TYPES: usize = 1000;

impl GmlFile {
    pub(crate) fn open(file: DataFile, wanted: &SourceOptions) -> Result<Self> {
        let mut found = Self { file, types: Vec::new() };
        let mut types: Vec<String> = Vec::new();
        found.walk(wanted, |xml, element, _| {
            if !types.contains(&element.name) && types.len() < MOST_TYPES {
                types.push(element.name);
            }
            xml.leave(xml.depth - 1)?;
            Ok(true)
        })?;
        if types.is_empty() {
            let (name, what) = (&found.file.name, found.root(wanted)?);
            return Err(Error::data(format!("{name} is XML ({what}), but contains no GML features")).help(
                "features are in elements named featureMember, featureMembers, member or cityObjectMember; convert another format: ogr2ogr out.gpkg FILE",
            ));
        }
        found.types = types;
        Ok(found)
    }

    /// Returns the name of the root element.
    fn root(&self, wanted: &SourceOptions) -> Result<Cow<'static, str>> {
        let mut xml = Xml::new(&self.file.content, &self.file.name, &wanted.budget)?;
        Ok(match xml.next()? {
            XmlPiece::Start(element) => shown(&element.name).into_owned().into(),
            XmlPiece::End | XmlPiece::Eof => "empty".into(),
        })
    }

    /// Calls `each` at the start of every feature until it returns false.
    fn walk(
        &self,
        wanted: &SourceOptions,
        mut each: impl FnMut(&mut Xml, Element, (&mut Surroundings, bool)) -> Result<bool>,
    ) -> Result<()> {
        let mut xml = Xml::new(&self.file.content, &self.file.name, &wanted.budget)?;
        let systems = KnownSystems { names: FxHashMap::default(), forced: wanted.crs };
        let mut around = Surroundings { context: GmlContext::default(), systems };
        let mut levels: Vec<Level> = Vec::new();
        loop {
            let element = match xml.next()? {
                XmlPiece::Eof => return Ok(()),
                XmlPiece::End => {
                    levels.truncate(xml.depth);
                    continue;
                }
                XmlPiece::Start(element) => element,
            };
            let is_member = matches!(
                &*element.name,
                "featureMember" | "featureMembers" | "member" | "cityObjectMember" | "appearanceMember"
            );
            match levels.last() {
                None => levels.push(Level::Collection),
                Some(Level::Collection) if is_member => {
                    levels.push(Level::Member { is_city: element.name == "cityObjectMember" });
                }
                Some(Level::Collection) if element.name == "boundedBy" => around.bounds(&mut xml)?,
                Some(Level::Collection) => xml.leave(xml.depth - 1)?,
                Some(Level::Member { .. }) if element.name == "FeatureCollection" => {
                    levels.push(Level::Collection)
                }
                Some(Level::Member { is_city }) => {
                    if !each(&mut xml, element, (&mut around, *is_city))? {
                        return Ok(());
                    }
                }
            }
        }
    }
}

impl LayeredFile for GmlFile {
    fn format(&self) -> &'static str {
        "GML"
    }

    fn layers(&self) -> Vec<&str> {
        self.types.iter().map(String::as_str).collect()
    }

    fn read(&self, layer: &str, wanted: &SourceOptions) -> Result<FeatureTable> {
        let name = &self.file.name;
        let label = match self.types.len() {
            0 | 1 => Cow::Borrowed(name.as_str()),
            _ => format!("{name}:{}", shown(layer)).into(),
        };
        let none = Error::data("the layer has no coordinate system")
            .help("specify its EPSG code: source(file, { crs = 3067 })");
        let table = FeatureTable::new(layer, &label, Err(none), wanted);
        let types = TextTypes::default();
        let mut features = FeatureBuilder { table, system: None, types, number: 0, budget: &wanted.budget };
        self.walk(wanted, |xml, element, (around, is_city)| {
            if element.name != layer {
                xml.leave(xml.depth - 1)?;
                return Ok(true);
            }
            match is_city {
                true => features.city_object(xml, &element, around)?,
                false => features.feature(xml, &element, around)?,
            }
            Ok(!features.table.is_full())
        })?;
        features.finish()
    }
}

/// Context shared by all features.
pub(super) struct Surroundings {
    pub(super) context: GmlContext,
    pub(super) systems: KnownSystems,
}

/// Coordinate systems of a file by their names.
pub(super) struct KnownSystems {
    names: FxHashMap<String, Rc<Result<NamedSystem>>>,
    /// EPSG code that replaces all systems.
    forced: Option<u32>,
}

impl KnownSystems {
    /// Returns the coordinate system with a name.
    pub(super) fn named(&mut self, name: &str) -> Rc<Result<NamedSystem>> {
        if let Some(known) = self.names.get(name) {
            return Rc::clone(known);
        }
        let system = Rc::new(NamedSystem::of_name(name, self.forced));
        self.names.insert(name.to_owned(), Rc::clone(&system));
        system
    }
}

impl Surroundings {
    /// Reads the coordinate system in a `boundedBy` element around features.
    pub(super) fn bounds(&mut self, xml: &mut Xml) -> Result<()> {
        let depth = xml.depth;
        while xml.depth >= depth {
            match xml.next()? {
                XmlPiece::Start(element) => {
                    self.context = self.context.within(&element, |name| self.systems.named(name));
                }
                XmlPiece::End => {}
                XmlPiece::Eof => break,
            }
        }
        Ok(())
    }
}

/// Builder of the feature table.
pub(super) struct FeatureBuilder<'b> {
    pub(super) table: FeatureTable,
    pub(super) system: Option<Rc<Result<NamedSystem>>>,
    pub(super) types: TextTypes,
    pub(super) number: usize,
    pub(super) budget: &'b Budget,
}

impl FeatureBuilder<'_> {
    /// Reads the feature that `element` begins.
    fn feature(&mut self, xml: &mut Xml, element: &Element, around: &mut Surroundings) -> Result<()> {
        self.number += 1;
        let id = element.attribute("id").or_else(|| element.attribute("fid")).filter(|id| !id.is_empty());
        let id = id.map(str::to_owned);
        let depth = xml.depth;
        let mut found = FeatureContent { parts: Vec::new(), values: Vec::new(), system: None, wrong: None };
        let before = around.context.clone();
        loop {
            match xml.next()? {
                XmlPiece::Start(property) if property.name == "boundedBy" => around.bounds(xml)?,
                XmlPiece::Start(property) => {
                    found.property(xml, &property, &property.name, (around, self.budget))?;
                }
                XmlPiece::End if xml.depth < depth => break,
                XmlPiece::End => {}
                XmlPiece::Eof => break,
            }
        }
        around.context = before;
        self.add(id, found)
    }

    fn add(&mut self, id: Option<String>, found: FeatureContent) -> Result<()> {
        let refuse = |builder: &mut Self, id: Option<String>, why: &str| {
            let id = id.unwrap_or_else(|| builder.number.to_string());
            let error = Error::data(format!("feature {} of {} {why}", shown(&id), builder.table.shown))
                .help("supported types are points, curves, polygons, surfaces and collections of these");
            builder.table.refuse(id, error)
        };
        if let (true, Some(why)) = (found.parts.is_empty(), &found.wrong) {
            return refuse(self, id, why);
        }
        if let Some(why) = self.join_system(found.system.as_ref(), !found.parts.is_empty()) {
            return refuse(self, id, &why);
        }
        let mut attributes: Vec<(usize, Attribute)> = Vec::with_capacity(found.values.len());
        for (name, value) in found.values {
            attributes.push(self.types.attribute(&mut self.table, &name, &value));
        }
        match id {
            Some(id) => self.table.push(&id, found.parts, attributes),
            None => self.table.push_unnamed(found.parts, attributes),
        }
    }

    /// Takes the coordinate system of the first feature with a geometry for all. Returns the reason why a feature in
    /// another system cannot be read.
    pub(super) fn join_system(
        &mut self,
        own: Option<&Rc<Result<NamedSystem>>>,
        has_geometry: bool,
    ) -> Option<String> {
        if self.system.is_none() && has_geometry {
            self.system = own.cloned();
        }
        let (Some(Ok(own)), Some(Ok(all))) = (own.map(|system| &**system), self.system.as_deref()) else {
            return None;
        };
        (own.crs != all.crs)
            .then(|| format!("is in {}, and others are in {}", own.crs.name(), all.crs.name()))
    }

    /// Returns the table, with attributes converted to numbers or booleans if all of their values permit it.
    fn finish(mut self) -> Result<FeatureTable> {
        match self.system.as_deref() {
            Some(Ok(system)) => self.table.crs = Ok(system.crs.clone()),
            Some(Err(error)) => self.table.crs = Err(error.clone()),
            None => {}
        }
        self.types.finish(&mut self.table)?;
        Ok(self.table)
    }
}

/// Content of a feature.
struct FeatureContent {
    parts: Vec<Geometry>,
    values: Vec<(String, String)>,
    system: Option<Rc<Result<NamedSystem>>>,
    wrong: Option<String>,
}

impl FeatureContent {
    /// Reads the property that `element` begins; the attribute is called `name`.
    fn property(
        &mut self,
        xml: &mut Xml,
        element: &Element,
        name: &str,
        (around, budget): (&mut Surroundings, &Budget),
    ) -> Result<()> {
        let depth = xml.depth;
        let mut is_simple = true;
        loop {
            match xml.next()? {
                XmlPiece::Start(inner) => {
                    is_simple = false;
                    if is_geometry(&inner.name) {
                        self.geometry(xml, &inner, (around, budget))?;
                    } else {
                        let name = format!("{name}.{}", inner.name);
                        self.property(xml, &inner, &name, (around, budget))?;
                    }
                }
                XmlPiece::End if xml.depth < depth => break,
                XmlPiece::End => {}
                XmlPiece::Eof => return Ok(()),
            }
        }
        if !is_simple {
            return Ok(());
        }
        let value = text_or_link(xml, element);
        if value.is_empty() {
            return Ok(());
        }
        budget.take(100 + name.len() + value.len())?;
        match self.values.iter_mut().find(|(known, _)| known == name) {
            // Repeated values are joined in a list.
            Some((_, known)) => {
                known.push(';');
                known.push_str(value);
            }
            None => self.values.push((name.to_owned(), value.to_owned())),
        }
        budget.give(100);
        Ok(())
    }

    /// Reads a geometry; of several geometries of a feature, the one of the highest dimension is used.
    fn geometry(
        &mut self,
        xml: &mut Xml,
        element: &Element,
        (Surroundings { context, systems }, budget): (&mut Surroundings, &Budget),
    ) -> Result<()> {
        let depth = xml.depth;
        let mut parts = Vec::new();
        let mut named = |name: &str| systems.named(name);
        let mut reader = GeometryReader { xml, named: &mut named, system: None, budget };
        let read = reader.geometry(element, context, &mut parts);
        let system = reader.system.take().or_else(|| context.system.clone());
        xml.leave(depth - 1)?;
        if read.is_ok() {
            let kind = |parts: &[Geometry]| parts.iter().map(Geometry::kind).max();
            if kind(&parts) > kind(&self.parts) {
                (self.parts, self.system) = (parts, system);
            }
        }
        note_problem(read, &mut self.wrong)
    }
}

/// Returns the text of an element that has just ended, or its link if it has no text.
pub(super) fn text_or_link<'a>(xml: &'a Xml, element: &'a Element) -> &'a str {
    match xml.text() {
        "" => element.attribute("href").unwrap_or_default(),
        text => text,
    }
}

/// Stores the reason why a geometry cannot be read, unless there already is one. Fails if reading must end.
pub(super) fn note_problem(
    read: std::result::Result<(), GeometryProblem>,
    wrong: &mut Option<String>,
) -> Result<()> {
    match read {
        Ok(()) => Ok(()),
        Err(GeometryProblem::Stop(error)) => Err(error),
        Err(GeometryProblem::Wrong(why)) => {
            wrong.get_or_insert(why);
            Ok(())
        }
    }
}
