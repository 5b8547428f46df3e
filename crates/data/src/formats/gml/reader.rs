//! Reads the features of a collection, one by one.

use std::fs::File;
use std::path::Path;
use std::rc::Rc;
use std::sync::Arc;

use rustc_hash::FxHashMap;

use super::geometry::{GeometryProblem, GeometryReader, GmlContext, is_geometry};
use super::system::NamedSystem;
use super::xml::{Element, Xml, XmlPiece};
use crate::{Attribute, FeatureTable, Geometry, SourceOptions};
use burgeon_base::budget::Budget;
use burgeon_base::error::{Error, Result};
use burgeon_base::text::shown;

/// An open file of GML.
pub struct GmlFile {
    file: File,
    name: String,
    /// The types of its features, in their order.
    types: Vec<String>,
}

/// What the elements around features are.
#[derive(Clone, Copy, PartialEq)]
enum Level {
    Collection,
    Member,
}

/// The most types of features.
const MOST_TYPES: usize = 1000;

impl GmlFile {
    /// Whether a file that begins so is XML.
    pub(crate) fn is_one(head: &[u8]) -> bool {
        let head = head.strip_prefix(b"\xef\xbb\xbf").unwrap_or(head).trim_ascii_start();
        head.starts_with(b"<")
    }

    pub(crate) fn open(file: File, _path: &Path, name: &str, wanted: &SourceOptions) -> Result<Self> {
        let mut found = Self { file, name: name.to_owned(), types: Vec::new() };
        let mut types: Vec<String> = Vec::new();
        found.walk(wanted, |xml, element, _| {
            if !types.contains(&element.name) && types.len() < MOST_TYPES {
                types.push(element.name.clone());
            }
            xml.leave(xml.depth - 1)?;
            Ok(true)
        })?;
        if types.is_empty() {
            return Err(Error::data(format!("{name} is XML, but has no features of GML")).help(
                "they stand in elements called featureMember, featureMembers, member or cityObjectMember",
            ));
        }
        found.types = types;
        Ok(found)
    }

    pub(crate) fn layers(&self) -> Vec<String> {
        self.types.clone()
    }

    pub(crate) fn read(&self, layer: &str, wanted: &SourceOptions) -> Result<FeatureTable> {
        let label =
            if self.types.len() > 1 { format!("{}:{}", self.name, shown(layer)) } else { self.name.clone() };
        let none = Error::data("the layer has no coordinate system")
            .help("name its EPSG code: source(file, { crs = 3067 })");
        let table = FeatureTable::new(layer, &label, Err(none), wanted);
        let budget = Arc::clone(&wanted.budget);
        let mut features =
            FeatureBuilder { table, label, system: None, kinds: Vec::new(), number: 0, budget };
        self.walk(wanted, |xml, element, around| {
            if element.name != layer {
                xml.leave(xml.depth - 1)?;
                return Ok(true);
            }
            features.feature(xml, &element, around)?;
            Ok(!features.table.is_full())
        })?;
        features.finish()
    }

    /// Has `each` read every feature, whose element has begun, until it says that it has enough.
    fn walk(
        &self,
        wanted: &SourceOptions,
        mut each: impl FnMut(&mut Xml, Element, &mut Surroundings) -> Result<bool>,
    ) -> Result<()> {
        let mut xml = Xml::new(&self.file, &self.name, &wanted.budget)?;
        let mut around =
            Surroundings { context: GmlContext::default(), names: FxHashMap::default(), forced: wanted.crs };
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
                Some(Level::Collection) if is_member => levels.push(Level::Member),
                Some(Level::Collection) if element.name == "boundedBy" => around.bounds(&mut xml)?,
                Some(Level::Collection) => xml.leave(xml.depth - 1)?,
                Some(Level::Member) if element.name == "FeatureCollection" => levels.push(Level::Collection),
                Some(Level::Member) => {
                    if !each(&mut xml, element, &mut around)? {
                        return Ok(());
                    }
                }
            }
        }
    }
}

/// What holds for all features.
struct Surroundings {
    context: GmlContext,
    names: FxHashMap<String, Rc<Result<NamedSystem>>>,
    forced: Option<u32>,
}

impl Surroundings {
    /// The coordinate system of a name.
    fn named(&mut self, name: &str) -> Rc<Result<NamedSystem>> {
        if let Some(known) = self.names.get(name) {
            return Rc::clone(known);
        }
        let system = Rc::new(NamedSystem::named(name, self.forced));
        self.names.insert(name.to_owned(), Rc::clone(&system));
        system
    }

    /// Looks for the coordinate system in the bounds of what is around features.
    fn bounds(&mut self, xml: &mut Xml) -> Result<()> {
        let depth = xml.depth;
        while xml.depth >= depth {
            match xml.next()? {
                XmlPiece::Start(element) => {
                    let context = self.context.clone();
                    self.context = context.within(&element, |name| self.named(name));
                }
                XmlPiece::End => {}
                XmlPiece::Eof => break,
            }
        }
        Ok(())
    }
}

/// What all values of an attribute have been so far.
#[derive(Clone, Copy)]
struct ValueKinds {
    numbers: bool,
    booleans: bool,
}

/// The features that have been read.
struct FeatureBuilder {
    table: FeatureTable,
    label: String,
    system: Option<Rc<Result<NamedSystem>>>,
    kinds: Vec<ValueKinds>,
    number: usize,
    budget: Arc<Budget>,
}

impl FeatureBuilder {
    /// Reads the feature that `element` begins.
    fn feature(&mut self, xml: &mut Xml, element: &Element, around: &mut Surroundings) -> Result<()> {
        self.number += 1;
        let id = element.attribute("id").or_else(|| element.attribute("fid")).filter(|id| !id.is_empty());
        let id = id.map_or_else(|| self.number.to_string(), str::to_owned);
        let depth = xml.depth;
        let mut found = FeatureContent { parts: Vec::new(), values: Vec::new(), system: None, wrong: None };
        let mut context = around.context.clone();
        loop {
            match xml.next()? {
                XmlPiece::Start(property) if property.name == "boundedBy" => {
                    let before = std::mem::replace(&mut around.context, context);
                    around.bounds(xml)?;
                    context = std::mem::replace(&mut around.context, before);
                }
                XmlPiece::Start(property) => {
                    let name = property.name.clone();
                    found.property(xml, &property, name, (&context, around, &self.budget))?;
                }
                XmlPiece::End if xml.depth < depth => break,
                XmlPiece::End => {}
                XmlPiece::Eof => break,
            }
        }
        self.add(&id, found)
    }

    fn add(&mut self, id: &str, found: FeatureContent) -> Result<()> {
        let refuse = |table: &mut FeatureTable, why: &str| {
            let error = Error::data(format!("feature {} of {} {why}", shown(id), self.label))
                .help("points, curves, polygons, surfaces and collections of these are read");
            table.refuse(id.to_owned(), error)
        };
        if let (true, Some(why)) = (found.parts.is_empty(), &found.wrong) {
            return refuse(&mut self.table, why);
        }
        if self.system.is_none() && !found.parts.is_empty() {
            self.system.clone_from(&found.system);
        }
        if let (Some(Ok(own)), Some(Ok(all))) = (found.system.as_deref(), self.system.as_deref())
            && own.crs != all.crs
        {
            let why = format!("is in {}, and others are in {}", own.crs.name(), all.crs.name());
            return refuse(&mut self.table, &why);
        }
        let mut attributes: Vec<(usize, Attribute)> = Vec::with_capacity(found.values.len());
        for (name, value) in found.values {
            let number = self.table.name(&name);
            if self.kinds.len() <= number {
                self.kinds.resize(number + 1, ValueKinds { numbers: true, booleans: true });
            }
            let kind = &mut self.kinds[number];
            kind.numbers &= as_number(&value).is_some();
            kind.booleans &= matches!(&*value, "true" | "false");
            attributes.push((number, self.table.text(&value)));
        }
        self.table.push(id, found.parts, attributes)
    }

    /// The table; attributes of which all values are numbers, or true and false, become these.
    fn finish(mut self) -> Result<FeatureTable> {
        match self.system.as_deref() {
            Some(Ok(system)) => self.table.crs = Ok(system.crs.clone()),
            Some(Err(error)) => self.table.crs = Err(error.clone()),
            None => {}
        }
        if !self.kinds.iter().any(|kind| kind.numbers || kind.booleans) {
            return Ok(self.table);
        }
        for feature in &mut self.table.features {
            self.budget.tick()?;
            for (number, value) in Arc::make_mut(&mut feature.attributes) {
                let Attribute::Text(text) = value else { continue };
                let kind = self.kinds[*number];
                if kind.booleans {
                    *value = Attribute::Boolean(&**text == "true");
                } else if let (true, Some(number)) = (kind.numbers, as_number(text)) {
                    *value = Attribute::Number(number);
                }
            }
        }
        Ok(self.table)
    }
}

/// The number that a text is, if it means nothing else: with a zero before it, it is a code.
fn as_number(text: &str) -> Option<f64> {
    let digits = text.strip_prefix('-').unwrap_or(text);
    let is_code = digits.starts_with('0') && digits[1..].starts_with(|letter: char| letter.is_ascii_digit());
    let begins = digits.starts_with(|letter: char| letter.is_ascii_digit() || letter == '.');
    if is_code || !begins || digits.len() > 25 {
        return None;
    }
    text.parse().ok().filter(|number: &f64| number.is_finite())
}

/// What was found of a feature.
struct FeatureContent {
    parts: Vec<Geometry>,
    values: Vec<(String, String)>,
    system: Option<Rc<Result<NamedSystem>>>,
    wrong: Option<String>,
}

impl FeatureContent {
    /// Reads the property that `element` begins, whose attribute is called `name`.
    fn property(
        &mut self,
        xml: &mut Xml,
        element: &Element,
        name: String,
        all: (&GmlContext, &mut Surroundings, &Arc<Budget>),
    ) -> Result<()> {
        let (context, around, budget) = all;
        let depth = xml.depth;
        let mut is_simple = true;
        loop {
            match xml.next()? {
                XmlPiece::Start(inner) => {
                    is_simple = false;
                    if is_geometry(&inner.name) {
                        self.geometry(xml, &inner, (context, around, budget))?;
                    } else {
                        let name = format!("{name}.{}", inner.name);
                        self.property(xml, &inner, name, (context, around, budget))?;
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
        let value = match xml.text() {
            "" => element.attribute("href").unwrap_or_default(),
            text => text,
        };
        if value.is_empty() {
            return Ok(());
        }
        budget.take(100 + name.len() + value.len())?;
        match self.values.iter_mut().find(|(known, _)| *known == name) {
            // What stands there again is listed.
            Some((_, known)) => {
                known.push(';');
                known.push_str(value);
            }
            None => self.values.push((name, value.to_owned())),
        }
        budget.give(100);
        Ok(())
    }

    /// Reads a geometry; of several of a feature, the one of the greatest extent counts.
    fn geometry(
        &mut self,
        xml: &mut Xml,
        element: &Element,
        (context, around, budget): (&GmlContext, &mut Surroundings, &Arc<Budget>),
    ) -> Result<()> {
        let depth = xml.depth;
        let mut parts = Vec::new();
        let mut named = |name: &str| around.named(name);
        let mut reader = GeometryReader { xml, named: &mut named, system: None, budget: Arc::clone(budget) };
        let read = reader.geometry(element, context, &mut parts);
        let system = reader.system.take().or_else(|| context.system.clone());
        xml.leave(depth - 1)?;
        match read {
            Ok(()) => {
                let kind = |parts: &[Geometry]| parts.iter().map(Geometry::kind).max();
                if kind(&parts) > kind(&self.parts) {
                    (self.parts, self.system) = (parts, system);
                }
            }
            Err(GeometryProblem::Stop(error)) => return Err(error),
            Err(GeometryProblem::Wrong(why)) => {
                self.wrong.get_or_insert(why);
            }
        }
        Ok(())
    }
}
