//! CityGML objects, whose geometries are in space.

use std::borrow::Cow;
use std::rc::Rc;

use super::geometry::{GeometryReader, GmlPiece, is_geometry};
use super::reader::{FeatureBuilder, Surroundings, note_problem, text_or_link};
use super::system::NamedSystem;
use crate::formats::city::{CityRecord, CitySurface, SurfaceRole};
use crate::formats::xml::{Element, Xml, XmlPiece};
use burgeon_base::error::{Error, Result};
use burgeon_base::text::shown;

/// Object that is being read.
#[derive(Default)]
struct OpenObject {
    object: CityRecord,
    system: Option<Rc<Result<NamedSystem>>>,
    /// Reason why a geometry cannot be read.
    wrong: Option<String>,
}

/// Context of a geometry.
#[derive(Clone, Copy)]
struct GeometryPlace {
    role: Option<SurfaceRole>,
    /// Level of detail, in tenths.
    level: u32,
    is_solid: bool,
}

/// Returns true if a property is irrelevant for the footprint of an object: its interior, its installations, and
/// references of other programs.
fn is_beside(name: &str) -> bool {
    const NAMES: [&str; 10] = [
        "externalReference",
        "appearance",
        "appearanceMember",
        "opening",
        "fillingSurface",
        "generalizesTo",
        "relatedTo",
        "consistsOfBuildingUnit",
        "buildingSubdivision",
        "adeOfAbstractBuilding",
    ];
    NAMES.contains(&name)
        || name.starts_with("interior")
        || name.contains("Installation")
        || name.contains("Furniture")
        || name.contains("Room")
        || name.contains("TerrainIntersection")
}

impl FeatureBuilder<'_> {
    /// Reads the object that `element` begins, and adds its features.
    pub(super) fn city_object(
        &mut self,
        xml: &mut Xml,
        element: &Element,
        around: &mut Surroundings,
    ) -> Result<()> {
        self.number += 1;
        let before = around.context.clone();
        // Positions have heights unless the file declares otherwise.
        around.context.dimension.get_or_insert(3);
        let read = self.object(xml, element, around);
        around.context = before;
        let OpenObject { object, system, wrong } = read?;
        let has_shape = !object.shape.is_empty() || object.parts.iter().any(|part| !part.shape.is_empty());
        let refuse = |builder: &mut Self, id: Option<String>, why: &str| {
            let id = id.unwrap_or_else(|| builder.number.to_string());
            let error = Error::data(format!("feature {} of {} {why}", shown(&id), builder.table.shown)).help(
                "supported types are points, curves, polygons, surfaces, solids and collections of these",
            );
            builder.table.refuse(id, error)
        };
        if let (false, Some(why)) = (has_shape, &wrong) {
            return refuse(self, object.id, why);
        }
        if let Some(why) = self.join_system(system.as_ref(), has_shape) {
            return refuse(self, object.id, &why);
        }
        object.add_to(&mut self.table, &mut self.types, self.budget)
    }

    fn object(&mut self, xml: &mut Xml, element: &Element, around: &mut Surroundings) -> Result<OpenObject> {
        let id = element.attribute("id").filter(|id| !id.is_empty()).map(str::to_owned);
        let mut open =
            OpenObject { object: CityRecord { id, ..CityRecord::default() }, ..OpenObject::default() };
        let depth = xml.depth;
        loop {
            match xml.next()? {
                XmlPiece::Start(property) => self.property(xml, &property, &mut open, around)?,
                XmlPiece::End if xml.depth < depth => break,
                XmlPiece::End => {}
                XmlPiece::Eof => break,
            }
        }
        Ok(open)
    }

    /// Reads a property of an object.
    fn property(
        &mut self,
        xml: &mut Xml,
        property: &Element,
        open: &mut OpenObject,
        around: &mut Surroundings,
    ) -> Result<()> {
        let name = property.name.as_str();
        if is_beside(name) {
            return xml.leave(xml.depth - 1);
        }
        if name.ends_with("Part") && name.starts_with(|letter: char| letter.is_ascii_lowercase()) {
            let depth = xml.depth;
            while let Some(part) = xml.next_child(depth)? {
                let read = self.object(xml, &part, around)?;
                open.system = open.system.take().or(read.system);
                open.wrong = open.wrong.take().or(read.wrong);
                open.object.parts.push(read.object);
            }
            return Ok(());
        }
        if matches!(name, "boundedBy" | "boundary") {
            return self.boundary(xml, open, around);
        }
        if name.ends_with("Attribute") || name == "genericAttributeSet" {
            return generic(xml, property, &mut open.object);
        }
        let place = GeometryPlace::of_property(name);
        self.value(xml, property, (name, place), open, around)
    }

    /// Reads a boundary of an object: a box, or a surface with a role.
    fn boundary(&mut self, xml: &mut Xml, open: &mut OpenObject, around: &mut Surroundings) -> Result<()> {
        let depth = xml.depth;
        while let Some(inner) = xml.next_child(depth)? {
            if matches!(&*inner.name, "Envelope" | "Box" | "Null" | "null") {
                around.context = around.context.within(&inner, |name| around.systems.named(name));
                xml.leave(xml.depth - 1)?;
                continue;
            }
            let role = SurfaceRole::of_name(&inner.name);
            let own = xml.depth;
            while let Some(property) = xml.next_child(own)? {
                let mut place = GeometryPlace::of_property(&property.name);
                place.role = Some(role);
                if !property.name.starts_with("lod") || is_beside(&property.name) {
                    xml.leave(xml.depth - 1)?;
                    continue;
                }
                let within = xml.depth;
                while let Some(geometry) = xml.next_child(within)? {
                    self.geometry(xml, &geometry, place, open, around)?;
                }
            }
        }
        Ok(())
    }

    /// Reads a property that contains text, nested properties, or geometries.
    fn value(
        &mut self,
        xml: &mut Xml,
        element: &Element,
        (name, place): (&str, GeometryPlace),
        open: &mut OpenObject,
        around: &mut Surroundings,
    ) -> Result<()> {
        let depth = xml.depth;
        let mut is_simple = true;
        loop {
            match xml.next()? {
                XmlPiece::Start(inner) => {
                    is_simple = false;
                    if is_geometry(&inner.name) {
                        self.geometry(xml, &inner, place, open, around)?;
                        continue;
                    }
                    // Capitalised elements are objects, whose names add no information.
                    let is_object = inner.name.starts_with(|letter: char| letter.is_ascii_uppercase());
                    let name = match (is_object, &*inner.name) {
                        (true, _) | (false, "value") => Cow::Borrowed(name),
                        (false, inner) => format!("{name}.{inner}").into(),
                    };
                    self.value(xml, &inner, (&name, place), open, around)?;
                }
                XmlPiece::End if xml.depth < depth => break,
                XmlPiece::End => {}
                XmlPiece::Eof => return Ok(()),
            }
        }
        if is_simple {
            let value = text_or_link(xml, element);
            self.budget.take(name.len() + value.len())?;
            open.object.add_text(name, value);
        }
        Ok(())
    }

    /// Reads a geometry into the shape of an object.
    fn geometry(
        &mut self,
        xml: &mut Xml,
        element: &Element,
        place: GeometryPlace,
        open: &mut OpenObject,
        around: &mut Surroundings,
    ) -> Result<()> {
        let depth = xml.depth;
        let Surroundings { context, systems } = around;
        let is_solid = place.is_solid || element.name.ends_with("Solid");
        let role = match place.role {
            Some(role) => role,
            None if place.level < 10 && !is_solid => SurfaceRole::Footprint,
            None => SurfaceRole::Other,
        };
        let shape = &mut open.object.shape;
        let mut add = |piece: GmlPiece| match piece {
            GmlPiece::Surface(rings) => {
                shape.surfaces.push(CitySurface { rings, role, level: place.level, is_solid });
            }
            GmlPiece::Line(line) => shape.lines.push(line),
            GmlPiece::Point(point) => shape.points.push(point),
        };
        let mut named = |name: &str| systems.named(name);
        let mut reader = GeometryReader { xml, named: &mut named, system: None, budget: self.budget };
        let read = reader.surfaces(element, context, &mut add);
        let system = reader.system.take().or_else(|| context.system.clone());
        xml.leave(depth - 1)?;
        if open.system.is_none() {
            open.system = system;
        }
        note_problem(read, &mut open.wrong)
    }
}

impl GeometryPlace {
    /// Returns the context of geometries in a property such as `lod2Solid` or `lod0FootPrint`.
    fn of_property(name: &str) -> Self {
        let digits = name
            .strip_prefix("lod")
            .and_then(|rest| rest.chars().next())
            .and_then(|digit| digit.to_digit(10));
        let role = name.contains("FootPrint").then_some(SurfaceRole::Footprint);
        let role = role.or(name.contains("RoofEdge").then_some(SurfaceRole::Other));
        Self { role, level: digits.map_or(10, |digit| digit * 10), is_solid: name.ends_with("Solid") }
    }
}

/// Reads a generic attribute or a set of them. The name is an attribute of the element, or a child element.
fn generic(xml: &mut Xml, element: &Element, object: &mut CityRecord) -> Result<()> {
    let depth = xml.depth;
    let (mut name, mut value) = (element.attribute("name").map(str::to_owned), None);
    while let Some(inner) = xml.next_child(depth)? {
        match &*inner.name {
            "name" => name = Some(xml.inner_text()?),
            "value" => value = Some(xml.inner_text()?),
            other if other.ends_with("Attribute") || other.ends_with("AttributeSet") => {
                generic(xml, &inner, object)?
            }
            _ => {}
        }
    }
    if let (Some(name), Some(value)) = (name, value) {
        object.add_text(&name, &value);
    }
    Ok(())
}
