//! Loops that apply functions with many parameters to a batch, made when a rule needs them.
//!
//! The prelude contains the loops for functions with few parameters, which most rules are.

use mlua::chunk::ChunkMode;
use mlua::{Function, Lua, Table};

use super::native::{as_bytecode, native};
use crate::declare::bytecode::compile;

/// Maximum number of parameters: a function of Luau has 255 registers, and a loop takes two for each parameter.
const MOST: usize = 110;

/// Adds the function that makes loops to `host`.
pub(super) fn add_batch_loops(lua: &Lua, host: &Table) -> mlua::Result<()> {
    host.set(
        "batch_loop",
        lua.create_function(|lua, (parameters, is_guard, reads): (usize, bool, Option<Vec<usize>>)| {
            batch_loop(lua, parameters, is_guard, reads.as_deref())
        })?,
    )
}

/// Returns the loop for functions with this number of `parameters`, of which they read those with the numbers in `reads`, or
/// all; `None` if there are too many.
fn batch_loop(
    lua: &Lua,
    parameters: usize,
    is_guard: bool,
    reads: Option<&[usize]>,
) -> mlua::Result<Option<Function>> {
    if parameters > MOST {
        return Ok(None);
    }
    let Some(code) = compile(&loop_text(parameters, is_guard, reads)) else { return Ok(None) };
    // Named as the prelude, because errors must not name its lines.
    let chunk = lua.load(code).set_name("=burgeon").set_mode(ChunkMode::Binary);
    let made: Function = as_bytecode(lua, || chunk.into_function())?;
    native(lua, &made)?;
    Ok(Some(made))
}

/// Returns the text of a loop. It takes the number of applications, the function, its `this`, the columns of arguments and
/// of results, and functions of the prelude.
fn loop_text(parameters: usize, is_guard: bool, reads: Option<&[usize]>) -> String {
    let mut text = String::from(
        "local count, rule, this, input, counts, advance, unpack_value, settle = ...\nfor i = 0, count - 1 do\nadvance(i)\n",
    );
    text.push_str(&format!("local o = i * {}\n", 8 * parameters));
    let mut arguments = String::new();
    for index in 0..parameters {
        if reads.is_some_and(|reads| !reads.contains(&(index + 1))) {
            arguments.push_str(", nil");
            continue;
        }
        let (name, offset) = (format!("a{index}"), 8 * index);
        text.push_str(&format!(
            "local {name} = buffer.readf64(input, o + {offset})\nif {name} ~= {name} then {name} = unpack_value(input, o + {offset}) end\n"
        ));
        arguments.push_str(&format!(", {name}"));
    }
    text.push_str(&match is_guard {
        true => format!("buffer.writeu32(counts, i * 4, if rule(this{arguments}) then 1 else 0)\nend\n"),
        false => format!(
            "local result = rule(this{arguments})\nbuffer.writeu32(counts, i * 4, if type(result) == \"number\" then result else settle(result))\nend\n"
        ),
    });
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_loop_passes_each_application_its_arguments() {
        let lua = Lua::new();
        let host = lua.create_table().unwrap();
        add_batch_loops(&lua, &host).unwrap();
        for (parameters, is_guard) in [(0, false), (7, true), (18, false), (MOST, false), (MOST, true)] {
            let make: Function = host.get("batch_loop").unwrap();
            let made: Function = make.call((parameters, is_guard)).unwrap();
            let run: Function = lua
                .load(
                    "local loop, parameters, is_guard = ...
                    local input, counts = buffer.create(3 * 8 * parameters), buffer.create(12)
                    for i = 0, 3 * parameters - 1 do buffer.writef64(input, i * 8, i) end
                    if parameters > 0 then buffer.writef64(input, 8 * parameters, 0 / 0) end
                    local at, sums = -1, {}
                    loop(3, function(this, ...)
                      local sum = this
                      for _, value in { ... } do sum += value end
                      sums[at + 1] = sum
                      return if is_guard then at == 1 elseif at == 2 then nil else sum
                    end, 1000, input, counts, function(i) at = i end, function() return 5000 end, function() return 9 end)
                    local results = { buffer.readu32(counts, 0), buffer.readu32(counts, 4), buffer.readu32(counts, 8) }
                    return table.concat(sums, ' ') .. ' ' .. table.concat(results, ' ')",
                )
                .into_function()
                .unwrap();
            let found: String = run.call((made, parameters, is_guard)).unwrap();
            let sum = |application: usize| -> usize {
                (0..parameters).map(|index| application * parameters + index).sum::<usize>() + 1000
            };
            let second = if parameters == 0 { 1000 } else { sum(1) + 5000 - parameters };
            let results = if is_guard { "0 1 0".to_owned() } else { format!("{} {second} 9", sum(0)) };
            assert_eq!(found, format!("{} {second} {} {results}", sum(0), sum(2)));
        }
        assert!(loop_text(3, true, Some(&[2])).contains("rule(this, nil, a1, nil)"));
        let make: Function = host.get("batch_loop").unwrap();
        assert!(make.call::<Option<Function>>((MOST + 1, false)).unwrap().is_none());
    }
}
