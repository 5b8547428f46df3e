//! Rules that only divide a shape, which are applied without Lua.

use std::cell::{OnceCell, RefCell};
use std::sync::Arc;

use mlua::{Function, Lua, Table, Value as LuaValue};

use super::Machine;
use super::object_methods::values;
use burgeon_base::warning::take_deferred;
use burgeon_kit::{Call, IntoParts, Kind, Object, PartMaker, ReadCall, Value, Values};
use burgeon_rewriting::{ColumnValue, Successors, Symbol};

/// Maximum number of modules that one application makes.
const MOST_MODULES: usize = 1 << 24;
/// Number of applications between two checks for cancellation.
const STRETCH: usize = 64;
/// Number of parts that are stored together.
const MANY_PARTS: usize = 4096;

/// Rule that calls methods of one of its parameters, divides the result, and makes modules of the parts. Everything but the
/// parameters is constant.
pub(crate) struct DivisionRule {
    /// Number of parameters of the rule, and the index of the divided one.
    parameters: (usize, usize),
    /// Methods that are called before the division.
    calls: Vec<MethodCall>,
    method: String,
    arguments: Vec<Value>,
    /// Module of the parts of each entry; `None` for parts that are left out.
    modules: Vec<Option<PartModule>>,
    division: OnceCell<Option<PartMaker>>,
}

/// Call of a read method.
struct MethodCall {
    name: String,
    arguments: Vec<Value>,
    /// Type of the last object, and its method.
    known: RefCell<Option<(Arc<Kind>, ReadCall)>>,
}

/// Module of a part.
struct PartModule {
    symbol: Symbol,
    /// Parameters after the part.
    more: Vec<PartParameter>,
}

/// Parameter of the module of a part.
enum PartParameter {
    Constant(Value),
    /// Parameter of the rule with this index.
    OfRule(usize),
}

impl DivisionRule {
    /// Reads what `rule` divides; `None` unless that is known before it is applied.
    pub(super) fn read(machine: &Machine, rule: &Function, count: usize) -> mlua::Result<Option<Self>> {
        let Some(found) = machine.prelude().division.call::<Option<Table>>((rule, count))? else {
            return Ok(None);
        };
        let lua = machine.lua();
        let mut calls = Vec::new();
        for call in found.get::<Table>("calls")?.sequence_values::<Table>() {
            let call = call?;
            let given: Vec<LuaValue> = call.sequence_values().skip(1).collect::<mlua::Result<_>>()?;
            let arguments = values(lua, &given)?;
            calls.push(MethodCall { name: call.get(1)?, arguments, known: RefCell::default() });
        }
        let mut modules = Vec::new();
        for module in found.get::<Table>("modules")?.sequence_values::<Table>() {
            modules.push(PartModule::read(lua, &module?)?);
        }
        let method: String = found.get("method")?;
        let arguments: [LuaValue; 2] = [found.get("kind")?, found.get("firsts")?];
        let parameter: usize = found.get("parameter")?;
        Ok(Some(Self {
            parameters: (count, parameter - 1),
            calls,
            method: method.split_once(':').map_or_else(|| method.clone(), |(_, name)| name.to_owned()),
            arguments: values(lua, &arguments)?,
            modules,
            division: OnceCell::new(),
        }))
    }

    /// Applies the rule to rows of arguments. Returns false, with nothing made, if Lua has to apply it: to say what is
    /// wrong, and where.
    pub(crate) fn apply(&self, machine: &Machine, arguments: &[f64], made: &mut Successors) -> bool {
        let is_made = self.make_modules(machine, arguments, made).is_some();
        if !is_made {
            made.clear();
        }
        is_made
    }

    fn make_modules(&self, machine: &Machine, arguments: &[f64], made: &mut Successors) -> Option<()> {
        made.clear();
        let session = &machine.session;
        let (count, divided) = self.parameters;
        let rows = || arguments.chunks_exact(count);
        let objects = session.values.objects(rows().map(|row| row[divided]))?;
        let constants: Vec<Option<Vec<f64>>> = self.pack_constants(machine);
        let mut pending = PendingParts::default();
        take_deferred();
        for (number, (object, row)) in objects.into_iter().zip(rows()).enumerate() {
            if number.is_multiple_of(STRETCH) {
                session.stop.check().ok()?;
            }
            let object = self.calls.iter().try_fold(object, |object, call| call.answer(&object))?;
            let division = self.division.get_or_init(|| {
                object.capability::<dyn IntoParts>()?.prepare_parts(&self.method, &self.arguments)
            });
            let divided = division.as_ref()?(&*object).ok()?;
            if divided.len() > MOST_MODULES {
                return None;
            }
            for (entry, part) in divided {
                let entry = entry as usize;
                let Some(module) = self.modules.get(entry)? else { continue };
                made.symbols.push(module.symbol);
                pending.add(part, made.params.len());
                made.params.push(0.0);
                made.params.extend(constants[entry].iter().flatten());
                let start = made.params.len() - module.more.len();
                for (place, parameter) in (start..).zip(&module.more) {
                    if let PartParameter::OfRule(index) = parameter {
                        // An explicit nil can be an error.
                        let given =
                            Some(row[*index]).filter(|it| ColumnValue::unpack(*it) != ColumnValue::Nil);
                        made.params[place] = given?;
                    }
                }
            }
            pending.store_if_many(&session.values, &mut made.params);
            if made.symbols.len() > session.options.limits.modules {
                return None;
            }
            made.ends.push(u32::try_from(made.symbols.len()).ok()?);
        }
        // A warning needs the line of the rule.
        if !take_deferred().is_empty() {
            return None;
        }
        pending.store(&session.values, &mut made.params);
        Some(())
    }

    /// Returns the numbers for a column of the constant parameters of each entry's module, with 0 in place of the others.
    fn pack_constants(&self, machine: &Machine) -> Vec<Option<Vec<f64>>> {
        let pack = |parameter: &PartParameter| match parameter {
            PartParameter::Constant(value) => machine.session.values.pack(value.clone()),
            PartParameter::OfRule(_) => 0.0,
        };
        let of = |module: &PartModule| module.more.iter().map(pack).collect();
        self.modules.iter().map(|module| module.as_ref().map(of)).collect()
    }
}

/// Parts that are not stored yet, and their places among the parameters of the modules that are made.
#[derive(Default)]
struct PendingParts {
    parts: Vec<Arc<dyn Object>>,
    places: Vec<usize>,
}

impl PendingParts {
    fn add(&mut self, part: Arc<dyn Object>, place: usize) {
        self.parts.push(part);
        self.places.push(place);
    }

    /// Stores the parts if there are so many that the next ones should reuse their memory.
    fn store_if_many(&mut self, values: &Values, params: &mut [f64]) {
        if self.parts.len() >= MANY_PARTS {
            self.store(values, params);
        }
    }

    /// Stores the parts, and writes their handles to `params`.
    fn store(&mut self, values: &Values, params: &mut [f64]) {
        for (place, handle) in self.places.drain(..).zip(values.store_objects(self.parts.drain(..))) {
            params[place] = ColumnValue::Handle(handle).pack();
        }
    }
}

impl MethodCall {
    /// Returns the object that the method of `object` returns; `None` if it returns or is something else.
    fn answer(&self, object: &Arc<dyn Object>) -> Option<Arc<dyn Object>> {
        let mut known = self.known.borrow_mut();
        let kind = object.kind();
        let (_, read) = match &mut *known {
            Some(known) if Arc::ptr_eq(&known.0, kind) => known,
            other => {
                let Call::Read(read) = &kind.method(&self.name)?.call else { return None };
                other.insert((Arc::clone(kind), Arc::clone(read)))
            }
        };
        match read(&**object, &self.arguments).ok()? {
            Value::Object(answer) => Some(answer),
            _ => None,
        }
    }
}

impl PartModule {
    /// Reads the module of an entry; `None` for parts that are left out.
    fn read(lua: &Lua, table: &Table) -> mlua::Result<Option<Self>> {
        let Some(symbol) = table.get::<LuaValue>("symbol")?.as_u32().and_then(|it| Symbol::try_from(it).ok())
        else {
            return Ok(None);
        };
        let mut more = Vec::new();
        for value in table.get::<Table>("values")?.sequence_values::<LuaValue>() {
            more.push(match value? {
                LuaValue::Table(parameter) => match parameter.get::<Option<usize>>(1)? {
                    Some(number) => PartParameter::OfRule(number - 1),
                    None => PartParameter::Constant(Value::Nil),
                },
                value => PartParameter::Constant(values(lua, [&value])?.pop().unwrap_or(Value::Nil)),
            });
        }
        Ok(Some(Self { symbol, more }))
    }
}
