//! Templates: the choice of a wall for each frontage.

use std::any::Any;
use std::sync::Arc;

use super::wall::Wall;
use crate::MaterialOptions;
use burgeon_base::error::{Error, Result};
use burgeon_kit::{Expectation, Parameter, Table, Value, fields, methods, object};
use burgeon_scene::Material;

/// Fields of `template { ... }`.
#[fields("template")]
pub struct TemplateOptions {
    /// Primary wall, which covers the whole frontage.
    pub wall: Option<Wall>,
    /// Keywords of the frontages that the template is for, such as "entry door" or "blind".
    pub keywords: Vec<String>,
    /// Default material of the walls. If omitted, the material or colour of `walls`, or the colour of the building.
    pub material: Option<MaterialOptions>,
    /// Relative frequency among templates that suit equally well.
    #[default(1.0)]
    pub weight: f64,
}

/// Fields of `facade { ... }`.
#[fields("facade")]
pub struct FacadeOptions {
    /// Templates to choose from.
    pub templates: Vec<Template>,
}

/// A wall for a whole frontage, with the keywords of suitable frontages.
///
/// A template is immutable.
#[object(
    "template",
    options = TemplateOptions,
    make = from_table,
    first = "wall",
    example = include_str!("../../scripts/template.lua")
)]
pub struct Template(Arc<TemplateData>);

struct TemplateData {
    wall: Wall,
    keywords: Vec<String>,
    material: Option<Material>,
    weight: f64,
}

#[methods("template")]
impl Template {
    /// Returns true if a frontage can be exactly `width` (m) wide and `height` (m) high.
    pub fn fits(&self, width: f64, height: f64) -> bool {
        self.0.wall.fits(width, height)
    }
}

impl Template {
    fn from_table(table: &Table) -> Result<Self> {
        let options = TemplateOptions::from_table(table)?;
        let Some(wall) = options.wall else {
            return Err(Error::argument("template: missing wall").help("write template { wall = panel { } }"));
        };
        if !(0.0..=1e9).contains(&options.weight) {
            return Err(Error::argument(format!("template: weight is {}", options.weight))
                .help("use a number of at least 0"));
        }
        let material = options.material.as_ref().map(MaterialOptions::material).transpose()?;
        let inner = TemplateData { wall, keywords: options.keywords, material, weight: options.weight };
        Ok(Self(Arc::new(inner)))
    }

    /// Returns the wall that covers the frontage.
    pub fn wall(&self) -> &Wall {
        &self.0.wall
    }

    /// Returns the default material of the walls, if the template has one of its own.
    pub fn material(&self) -> Option<&Material> {
        self.0.material.as_ref()
    }
}

/// Templates for the frontages of a building.
///
/// A facade is immutable.
#[object(
    "facade",
    options = FacadeOptions,
    first = "templates",
    example = include_str!("../../scripts/facade.lua")
)]
pub struct Facade(Templates);

#[methods("facade")]
impl Facade {
    /// Returns true if a template fits a frontage that is exactly `width` (m) wide and `height` (m) high.
    pub fn fits(&self, width: f64, height: f64) -> bool {
        self.0.0.iter().any(|template| template.fits(width, height))
    }
}

impl Facade {
    fn new(options: FacadeOptions) -> Result<Self> {
        if options.templates.is_empty() {
            return Err(Error::argument("facade: missing templates")
                .help("write facade({ template { wall = panel { } } })"));
        }
        Ok(Self(Templates(options.templates.into())))
    }
}

/// Keyword of a frontage that a neighbour covers.
pub const BLIND: &str = "blind";

/// The templates of walls: a facade, a template, or a list of templates.
#[derive(Debug, Clone)]
pub struct Templates(Arc<[Template]>);

impl Templates {
    /// Chooses the template for a frontage with these keywords and this width and height (m); `chance` is a random
    /// number in [0, 1).
    ///
    /// Among the templates that fit, prefers the one with the most shared keywords, then the one with the fewest other
    /// keywords, and finally chooses by weight. A frontage that is "blind" only takes a template with that keyword.
    pub fn choose(&self, keywords: &[&str], width: f64, height: f64, chance: f64) -> Option<&Template> {
        let blind = keywords.contains(&BLIND);
        let suits = |template: &Template| {
            let shared = template.0.keywords.iter().filter(|word| keywords.contains(&word.as_str())).count();
            (shared, std::cmp::Reverse(template.0.keywords.len() - shared))
        };
        let fitting = || {
            self.0.iter().filter(|template| {
                (!blind || template.0.keywords.iter().any(|word| word == BLIND))
                    && template.fits(width, height)
            })
        };
        let best = fitting().map(suits).max()?;
        let equal = || fitting().filter(|template| suits(template) == best);
        let mut drawn = chance * equal().map(|template| template.0.weight).sum::<f64>();
        for template in equal() {
            if drawn < template.0.weight {
                return Some(template);
            }
            drawn -= template.0.weight;
        }
        equal().next_back()
    }

    /// Returns the first template, whose material plain walls have.
    pub fn first(&self) -> Option<&Template> {
        self.0.first()
    }
}

impl Parameter for Template {
    fn luau() -> String {
        "Template".into()
    }

    fn from_value(value: Value) -> Result<Self, Expectation> {
        let what = || Expectation::new("a template: template { wall = ... }");
        let Value::Object(object) = value else { return Err(what()) };
        let any: &dyn Any = &*object;
        any.downcast_ref::<Self>().cloned().ok_or_else(what)
    }

    fn into_value(self) -> Value {
        Value::Object(Arc::new(self))
    }
}

impl Parameter for Templates {
    fn luau() -> String {
        "Facade | Template | { Template }".into()
    }

    fn from_value(value: Value) -> Result<Self, Expectation> {
        let what = || Expectation::new("a facade, a template or a list of templates");
        if let Value::Object(object) = &value {
            let any: &dyn Any = &**object;
            if let Some(facade) = any.downcast_ref::<Facade>() {
                return Ok(facade.0.clone());
            }
            return Template::from_value(value).map(|one| Self([one].into())).map_err(|_| what());
        }
        let list = Vec::<Template>::from_value(value).map_err(|_| what())?;
        if list.is_empty() { Err(what()) } else { Ok(Self(list.into())) }
    }

    fn into_value(self) -> Value {
        Value::Object(Arc::new(Facade(self)))
    }
}

impl std::fmt::Debug for Template {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_tuple("Template").field(&self.0.keywords).finish()
    }
}
