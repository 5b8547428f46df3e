//! Script values for sources: a list of the script, or a layer of a data file.

use std::sync::Arc;

use mlua::{
    AnyUserData, Function, Lua, MetaMethod, Table, UserData, UserDataFields, UserDataMethods,
    Value as LuaValue,
};

use super::lazy;
use crate::machine::Machine;
use burgeon_base::error::{Error, Result};
use burgeon_kit::{Attribute, FeatureSource, Prefetch, Table as ValueTable, Value};
use burgeon_language::LAYER;

/// Script value for a source of features.
pub(crate) enum SourceHandle {
    /// List of tables.
    List(Table),
    /// Layer whose tables are created when the script reads them.
    Layer(Arc<dyn FeatureSource>),
}

impl SourceHandle {
    /// Creates the result of `source(what, options)`.
    pub(crate) fn new(machine: &Machine, what: &LuaValue, options: &LuaValue) -> Result<Self> {
        let options = crate::machine::convert::to_value(options, false)?;
        match (what, &options) {
            (LuaValue::Table(features), options) => {
                let none = ValueTable::default();
                let is_bare = matches!(options, Value::Nil);
                let options = if let Value::Table(options) = options { options } else { &none };
                let (leads, data) = (machine.driver.leads(), &machine.session.data);
                if !is_bare {
                    let list =
                        if leads { crate::machine::convert::to_value(what, false)? } else { Value::Nil };
                    data.list(&list, options, leads)?;
                }
                Ok(Self::List(features.clone()))
            }
            (LuaValue::String(text), Value::Nil) => Self::load(machine, &text.to_string_lossy(), None),
            (LuaValue::String(text), Value::Table(options)) => {
                Self::load(machine, &text.to_string_lossy(), Some(options))
            }
            (LuaValue::String(_), other) => {
                Err(Error::argument(format!("source takes a table of options, not {}", other.describe()))
                    .help("write source(\"town.gpkg:buildings\", { limit = 100 })"))
            }
            _ => Err(Error::argument("source takes the name of a data file or a list of features")
                .help("write source(\"village.geojson\") or source({ { id = \"a\", ... }, ... })")),
        }
    }

    fn load(machine: &Machine, text: &str, options: Option<&ValueTable>) -> Result<Self> {
        let asker = Machine::asker(machine.lua(), &machine.session);
        let layer = machine.session.data.load(&machine.session, asker, text, options)?;
        layer.warnings().into_iter().for_each(|warning| machine.warn(warning));
        layer.note().into_iter().for_each(|note| machine.session.add_note(note));
        Ok(Self::Layer(layer))
    }

    /// Returns the source as an argument for constructors.
    pub(crate) fn value(&self) -> Result<Value> {
        match self {
            Self::List(features) => {
                crate::machine::convert::to_value(&LuaValue::Table(features.clone()), false)
            }
            Self::Layer(layer) => Ok(Value::Object(Arc::clone(layer).object())),
        }
    }

    fn field(&self, lua: &Lua, name: &str) -> mlua::Result<LuaValue> {
        let frozen = |table: Table| {
            table.set_readonly(true);
            Ok(LuaValue::Table(table))
        };
        match (self, name) {
            (Self::List(features), "features") => Ok(LuaValue::Table(features.clone())),
            (Self::List(_), name) if LAYER.part_names().contains(&name) => Ok(LuaValue::Nil),
            (Self::Layer(layer), "features") => {
                let table = lua.create_table_with_capacity(layer.count(), 0)?;
                let names = AttributeNames::new(lua, layer, None)?;
                // The complete table stays alive, so a collection would free nothing of it.
                let collects = lua.gc_is_running();
                lua.gc_stop();
                let made = (0..layer.count()).map(|index| table.raw_push(names.feature(lua, index)?));
                let made: mlua::Result<()> = made.collect();
                if collects {
                    lua.gc_restart();
                }
                made?;
                frozen(table)
            }
            (Self::Layer(layer), "bounds") => {
                let table = lua.create_table()?;
                for (name, corner) in ["min", "max"].into_iter().zip(layer.bounds()) {
                    table.raw_set(name, frozen(lua.create_sequence_from(corner)?)?)?;
                }
                frozen(table)
            }
            (Self::Layer(layer), "layer") => Ok(LuaValue::String(lua.create_string(layer.name())?)),
            (Self::Layer(layer), "crs") => Ok(LuaValue::String(lua.create_string(layer.crs())?)),
            (Self::Layer(layer), "origin") => frozen(lua.create_sequence_from(layer.origin())?),
            _ => {
                let message = format!("a source has no field called {name}");
                let known = LAYER.part_names();
                let error = Error::not_found("field", name, known.iter().copied(), message);
                Err(mlua::Error::external(error.help(format!("it has {}", known.join(", ")))))
            }
        }
    }
}

impl UserData for SourceHandle {
    fn add_fields<F: UserDataFields<Self>>(fields: &mut F) {
        fields.add_meta_field(MetaMethod::Type, "source");
    }

    fn add_methods<M: UserDataMethods<Self>>(methods: &mut M) {
        methods.add_meta_function(MetaMethod::Index, |lua, (this, name): (AnyUserData, String)| {
            field(lua, &this, &name)
        });
        methods.add_meta_function(MetaMethod::Len, |_, this: AnyUserData| {
            Ok(match &*this.borrow::<Self>()? {
                Self::List(features) => features.raw_len(),
                Self::Layer(layer) => layer.count(),
            })
        });
        methods.add_meta_function(MetaMethod::Iter, |lua, this: AnyUserData| {
            let next: Function = lua.globals().get("next")?;
            Ok((next, field(lua, &this, "features")?))
        });
        methods.add_meta_method(MetaMethod::ToString, |_, this, ()| {
            Ok(match this {
                Self::List(features) => format!("a source of {} features", features.raw_len()),
                Self::Layer(layer) => format!("a source of {} features", layer.count()),
            })
        });
        methods.add_meta_function(
            MetaMethod::NewIndex,
            |_, (_, name): (LuaValue, String)| -> mlua::Result<()> {
                Err(mlua::Error::external(
                    Error::script(format!("{name} of a source cannot be assigned"))
                        .help("make a list of what you need, and a source of it: source(list)"),
                ))
            },
        );
    }
}

/// Returns a field of a source, and caches its value.
fn field(lua: &Lua, this: &AnyUserData, name: &str) -> mlua::Result<LuaValue> {
    if let LuaValue::Table(kept) = this.user_value::<LuaValue>()?
        && let value @ (LuaValue::Table(_) | LuaValue::String(_)) = kept.raw_get::<LuaValue>(name)?
    {
        return Ok(value);
    }
    let value = this.borrow::<SourceHandle>()?.field(lua, name)?;
    let kept = match this.user_value::<LuaValue>()? {
        LuaValue::Table(kept) => kept,
        _ => lua.create_table()?,
    };
    kept.raw_set(name, &value)?;
    this.set_user_value(kept)?;
    Ok(value)
}

/// Returns file and layer of a source for messages; empty for a list of the script.
pub(super) fn shown(source: &AnyUserData) -> String {
    match source.borrow::<SourceHandle>().as_deref() {
        Ok(SourceHandle::Layer(layer)) => layer.label().to_owned(),
        _ => String::new(),
    }
}

/// Returns the layer of a source; `None` for a list of the script.
pub(super) fn layer_of(source: &AnyUserData) -> Option<Arc<dyn FeatureSource>> {
    match source.borrow::<SourceHandle>().as_deref() {
        Ok(SourceHandle::Layer(layer)) => Some(Arc::clone(layer)),
        _ => None,
    }
}

/// Returns the features that a source skipped, with the errors.
pub(super) fn refused_of(source: &AnyUserData) -> Vec<(String, Error)> {
    match source.borrow::<SourceHandle>().as_deref() {
        Ok(SourceHandle::Layer(layer)) => layer.refused().to_vec(),
        _ => Vec::new(),
    }
}

/// Calls `each` with every feature of a source, its number from 1, and its id if it comes from a file.
///
/// The tables of a layer's features are temporary, unless the script has read the complete list. `prefetch`
/// can prepare data that the features need.
pub(super) fn each_feature(
    lua: &Lua,
    source: &AnyUserData,
    prefetch: Option<&Arc<dyn Prefetch>>,
    mut each: impl FnMut(usize, LuaValue, Option<&str>) -> Result<()>,
    failed: impl Fn(mlua::Error) -> Error,
) -> Result<()> {
    let kept = match source.user_value::<LuaValue>().map_err(&failed)? {
        LuaValue::Table(kept) => kept.raw_get::<LuaValue>("features").map_err(&failed)?,
        _ => LuaValue::Nil,
    };
    let layer = match &*source.borrow::<SourceHandle>().map_err(&failed)? {
        SourceHandle::List(features) => {
            for (index, feature) in features.sequence_values::<LuaValue>().enumerate() {
                each(index + 1, feature.map_err(&failed)?, None)?;
            }
            return Ok(());
        }
        SourceHandle::Layer(layer) => Arc::clone(layer),
    };
    let names = AttributeNames::new(lua, &layer, prefetch).map_err(&failed)?;
    for index in 0..layer.count() {
        let made = match &kept {
            LuaValue::Table(kept) => kept.raw_get(index + 1),
            _ => names.feature(lua, index).map(LuaValue::Table),
        };
        each(index + 1, made.map_err(&failed)?, Some(layer.id(index)))?;
    }
    Ok(())
}

/// Attribute names of a layer, and names of the fixed fields, as Lua strings.
struct AttributeNames {
    of: Arc<dyn FeatureSource>,
    prefetch: Option<Arc<dyn Prefetch>>,
    attributes: Vec<mlua::LuaString>,
    layer: mlua::LuaString,
    fixed: [mlua::LuaString; 3],
    /// Factory of lazy features; `None` if the script could detect them.
    unread: Option<lazy::LazyLayer>,
}

impl AttributeNames {
    fn new(
        lua: &Lua,
        layer: &Arc<dyn FeatureSource>,
        prefetch: Option<&Arc<dyn Prefetch>>,
    ) -> mlua::Result<Self> {
        let text = |text: &str| lua.create_string(text);
        Ok(Self {
            of: Arc::clone(layer),
            prefetch: prefetch.cloned(),
            attributes: layer.attribute_names().iter().map(|name| text(name)).collect::<mlua::Result<_>>()?,
            layer: text(layer.name())?,
            fixed: [text("id")?, text("geometry")?, text("layer")?],
            unread: lazy::unread(lua, layer, prefetch)?,
        })
    }
}

impl AttributeNames {
    /// Returns the table of the feature with this number, from 0.
    fn feature(&self, lua: &Lua, index: usize) -> mlua::Result<Table> {
        if let Some(unread) = &self.unread {
            return unread.feature(index);
        }
        let attributes = self.of.attributes(index);
        let table = lua.create_table_with_capacity(0, attributes.len() + 3)?;
        for (column, value) in attributes {
            let name = &self.attributes[*column];
            match value {
                Attribute::Boolean(value) => table.raw_set(name, *value)?,
                Attribute::Number(value) => table.raw_set(name, *value)?,
                Attribute::Text(text) => table.raw_set(name, &**text)?,
                Attribute::Nested(value) => table.raw_set(name, nested(lua, value)?)?,
            }
        }
        let [id, geometry, layer] = &self.fixed;
        table.raw_set(id, self.of.id(index))?;
        table.raw_set(geometry, lazy::geometry(lua, &self.of, index, self.prefetch.as_ref())?)?;
        table.raw_set(layer, &self.layer)?;
        table.set_readonly(true);
        Ok(table)
    }
}

/// Converts a GeoJSON value to a frozen table. Nulls are omitted from objects, and become false in lists.
pub(super) fn nested(lua: &Lua, value: &serde_json::Value) -> mlua::Result<LuaValue> {
    use serde_json::Value as Json;
    Ok(match value {
        Json::Null => LuaValue::Nil,
        Json::Bool(value) => LuaValue::Boolean(*value),
        Json::Number(number) => LuaValue::Number(number.as_f64().unwrap_or(f64::NAN)),
        Json::String(text) => LuaValue::String(lua.create_string(text)?),
        Json::Array(items) => {
            let table = lua.create_table_with_capacity(items.len(), 0)?;
            for item in items {
                match nested(lua, item)? {
                    LuaValue::Nil => table.raw_push(false)?,
                    item => table.raw_push(item)?,
                }
            }
            table.set_readonly(true);
            LuaValue::Table(table)
        }
        Json::Object(fields) => {
            let table = lua.create_table()?;
            for (name, value) in fields {
                table.raw_set(name.as_str(), nested(lua, value)?)?;
            }
            table.set_readonly(true);
            LuaValue::Table(table)
        }
    })
}
