//! Values of scripts as `print` shows them: tables with their entries, constructors with their modules.

use mlua::{Function, Lua, LuaString, Table, Value as LuaValue};

use super::library::Library;
use super::messages::any_bytes;
use burgeon_base::MemoryOwner;

/// Maximum depth of shown tables.
const DEEPEST: usize = 6;
/// Maximum number of shown entries of a table.
const MOST_ENTRIES: usize = 200;
/// Maximum number of entries of a table whose names are sorted.
const MOST_SORTED: usize = 10_000;
/// Length (bytes) at which the text of a value ends, except for a string.
const LONGEST: usize = 20_000;

/// Writer of the text of one value.
struct ValueWriter<'a> {
    library: &'a Library,
    tostring: Function,
    text: String,
    /// Tables that contain the present one, from the outermost.
    around: Vec<Table>,
}

/// Returns the text of a value. A string is shown as it is; strings in tables have quotes.
pub(super) fn shown_value(lua: &Lua, library: &Library, value: &LuaValue) -> mlua::Result<String> {
    let tostring: Function = lua.globals().get("tostring")?;
    let mut writer = ValueWriter { library, tostring, text: String::new(), around: Vec::new() };
    match value {
        LuaValue::String(text) => {
            // The receiver copies the text again.
            MemoryOwner::ensure_room(3 * text.as_bytes().len()).map_err(mlua::Error::external)?;
            writer.text = any_bytes(&text.as_bytes());
        }
        value => writer.write(value)?,
    }
    Ok(writer.text)
}

impl ValueWriter<'_> {
    fn write(&mut self, value: &LuaValue) -> mlua::Result<()> {
        match value {
            LuaValue::String(text) => {
                let bytes = text.as_bytes();
                let some = &bytes[..bytes.len().min(LONGEST)];
                let quoted = any_bytes(some).replace('\\', "\\\\").replace('"', "\\\"").replace('\n', "\\n");
                let end = if some.len() < bytes.len() { "..." } else { "" };
                self.text.push_str(&format!("\"{quoted}{end}\""));
            }
            LuaValue::Table(table) if is_plain(table) => self.write_table(table)?,
            LuaValue::Function(function) => match self.module_of(function) {
                Some(usage) => self.text.push_str(&format!("module {usage}")),
                None => self.text.push_str("function"),
            },
            value => {
                let text = self.tostring.call::<LuaString>(value)?;
                MemoryOwner::ensure_room(3 * text.as_bytes().len()).map_err(mlua::Error::external)?;
                self.text.push_str(&any_bytes(&text.as_bytes()));
            }
        }
        Ok(())
    }

    /// Writes the list part, and then the other entries in the order of their keys.
    fn write_table(&mut self, table: &Table) -> mlua::Result<()> {
        if table.raw_len() == 0 && table.is_empty() {
            self.text.push_str("{}");
            return Ok(());
        }
        if self.around.len() >= DEEPEST || self.around.contains(table) {
            self.text.push_str("{ ... }");
            return Ok(());
        }
        self.around.push(table.clone());
        self.text.push_str("{ ");
        let length = table.raw_len();
        let mut count = 0;
        for index in 1..=length.min(MOST_ENTRIES) {
            if !self.begin_entry(&mut count) {
                break;
            }
            self.write(&table.raw_get(index)?)?;
        }
        let mut left_out = length.saturating_sub(count);
        let mut named = Vec::new();
        for pair in table.pairs::<LuaValue, LuaValue>().take(length + MOST_SORTED) {
            let (key, value) = pair?;
            if !is_index(&key, length) {
                named.push((self.key(&key)?, value));
            }
        }
        named.sort_by(|(one, _), (other, _)| one.cmp(other));
        for (key, value) in named {
            if count >= MOST_ENTRIES || left_out > 0 || !self.begin_entry(&mut count) {
                left_out += 1;
                continue;
            }
            self.text.push_str(&key);
            self.text.push_str(" = ");
            self.write(&value)?;
        }
        if left_out > 0 {
            self.text.push_str(&format!(", and {left_out} more"));
        }
        self.text.push_str(" }");
        self.around.pop();
        Ok(())
    }

    /// Begins the next entry, unless the text is too long.
    fn begin_entry(&mut self, count: &mut usize) -> bool {
        if self.text.len() > LONGEST {
            return false;
        }
        if *count > 0 {
            self.text.push_str(", ");
        }
        *count += 1;
        true
    }

    /// Returns a key as a table constructor has it.
    fn key(&self, key: &LuaValue) -> mlua::Result<String> {
        if let LuaValue::String(text) = key {
            let text = any_bytes(&text.as_bytes());
            let is_name = text.starts_with(|letter: char| letter.is_ascii_alphabetic() || letter == '_')
                && text.chars().all(|letter| letter.is_ascii_alphanumeric() || letter == '_');
            return Ok(if is_name { text } else { format!("[{text:?}]") });
        }
        // A table as a key is shown by its type alone.
        let text = self.tostring.call::<LuaString>(key)?;
        Ok(format!("[{}]", any_bytes(&text.as_bytes())))
    }

    /// Returns name and parameters of the module that a function makes, if it is a constructor.
    fn module_of(&self, function: &Function) -> Option<String> {
        let constructors = self.library.constructors.borrow();
        let (symbol, _) = constructors.iter().find(|(_, constructor)| *constructor == function)?;
        Some(self.library.symbols.borrow().signature(*symbol).usage().into_owned())
    }
}

/// Returns true if a table has no text of its own, such as that of a module or a vector.
fn is_plain(table: &Table) -> bool {
    table
        .metatable()
        .is_none_or(|metatable| metatable.raw_get::<LuaValue>("__tostring").is_ok_and(|text| text.is_nil()))
}

/// Returns true if a key is an index of a list with `length` items.
fn is_index(key: &LuaValue, length: usize) -> bool {
    match key {
        LuaValue::Integer(index) => usize::try_from(*index).is_ok_and(|index| (1..=length).contains(&index)),
        #[allow(clippy::cast_precision_loss, reason = "lengths of lists are far below 2^53")]
        LuaValue::Number(number) => number.fract() == 0.0 && *number >= 1.0 && *number <= length as f64,
        _ => false,
    }
}
