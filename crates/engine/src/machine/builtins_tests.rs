//! Functions and operators of Luau give the same bits in native code and in bytecode.

use std::fmt::Write;
use std::path::Path;

use mlua::{Function, LuaString};

use super::native;
use super::native::as_bytecode;
use crate::declare::{RunOptions, Session};
use crate::run::leading_machine;

/// Expressions in the numbers `a`, `b` and `c`, and in the integer `i` from 0 to 40.
const EXPRESSIONS: &[&str] = &[
    "a + b",
    "a - b",
    "a * b",
    "a / b",
    "a % b",
    "a // b",
    "a ^ b",
    "-a",
    "a * b + c",
    "a - b * c",
    "a * b - c * a",
    "a < b",
    "a <= b",
    "a == b",
    "a ~= a",
    "a ^ 2",
    "a ^ 0.5",
    "a ^ 3",
    "a ^ -1",
    "2 ^ a",
    "a % 3",
    "a // 7",
    "10 ^ i",
    "math.abs(a)",
    "math.acos(a)",
    "math.asin(a)",
    "math.atan(a)",
    "math.atan2(a, b)",
    "math.ceil(a)",
    "math.clamp(a, b, c)",
    "math.cos(a)",
    "math.cosh(a)",
    "math.deg(a)",
    "math.exp(a)",
    "math.floor(a)",
    "math.fmod(a, b)",
    "math.frexp(a)",
    "select(2, math.frexp(a))",
    "math.isfinite(a)",
    "math.isinf(a)",
    "math.isnan(a)",
    "math.ldexp(a, i)",
    "math.lerp(a, b, c)",
    "math.lerp(a, b, i / 40)",
    "math.log(a)",
    "math.log(a, 2)",
    "math.log(a, 10)",
    "math.log(a, b)",
    "math.log10(a)",
    "math.map(a, b, c, a, i)",
    "math.map(i, 0, 40, a, b)",
    "math.max(a, b, c)",
    "math.min(a, b, c)",
    "math.max(a, b)",
    "math.min(a, b)",
    "math.modf(a)",
    "select(2, math.modf(a))",
    "math.pow(a, b)",
    "math.rad(a)",
    "math.round(a)",
    "math.sign(a)",
    "math.sin(a)",
    "math.sinh(a)",
    "math.sqrt(a)",
    "math.tan(a)",
    "math.tanh(a)",
    "bit32.arshift(a, i)",
    "bit32.band(a, b, c)",
    "bit32.bnot(a)",
    "bit32.bor(a, b)",
    "bit32.btest(a, b)",
    "bit32.bxor(a, b)",
    "bit32.byteswap(a)",
    "bit32.countlz(a)",
    "bit32.countrz(a)",
    "bit32.extract(a, i)",
    "bit32.extract(a, i // 2, 5)",
    "bit32.lrotate(a, i)",
    "bit32.lshift(a, i)",
    "bit32.replace(a, b, i)",
    "bit32.replace(a, b, i // 2, 7)",
    "bit32.rrotate(a, i)",
    "bit32.rshift(a, i)",
    "bit32.band(i, 7)",
    "bit32.lshift(i, i)",
    "bit32.rshift(a, 3)",
    "bit32.bor(i, 64)",
    "kept(function(at) buffer.writei8(at, i, a) end)",
    "kept(function(at) buffer.writeu8(at, i, a) end)",
    "kept(function(at) buffer.writei16(at, i, a) end)",
    "kept(function(at) buffer.writeu16(at, i, a) end)",
    "kept(function(at) buffer.writei32(at, i, a) end)",
    "kept(function(at) buffer.writeu32(at, i, a) end)",
    "kept(function(at) buffer.writef32(at, i, if a ~= a then 0 else a) end)",
    "kept(function(at) buffer.writef64(at, i, if a ~= a then 0 else a) end)",
    "kept(function(at) buffer.writebits(at, i, 23, a) end)",
    "read(function(at) return buffer.readi8(at, i) end)",
    "read(function(at) return buffer.readu8(at, i) end)",
    "read(function(at) return buffer.readi16(at, i) end)",
    "read(function(at) return buffer.readu16(at, i) end)",
    "read(function(at) return buffer.readi32(at, i) end)",
    "read(function(at) return buffer.readu32(at, i) end)",
    "read(function(at) return buffer.readf32(at, i) end)",
    "read(function(at) return buffer.readf64(at, i) end)",
    "read(function(at) return buffer.readbits(at, i, 29) end)",
    "read(function(at) return buffer.readi32(at, a) end)",
    "string.format(\"%d\", a)",
    "string.format(\"%.14g\", a)",
    "string.format(\"%5.2f|%e|%g\", a, b, c)",
    "string.format(\"%x\", math.abs(i))",
    "string.format(\"%*\", a)",
    "tostring(a)",
    "a .. \"\"",
    "`{a}`",
    "tonumber(tostring(a))",
    "string.char(i)",
    "string.byte(\"abcdef\", i)",
    "string.sub(\"abcdef\", a, b)",
    "string.rep(\"ab\", i)",
    "#table.create(i, a)",
    "table.unpack({ a, b, c }, 2)",
    "select(i, a, b, c)",
    "total(a, b, c)",
    "count(a, b, c)",
];

/// Functions that the expressions call, and the output format: numbers as bits, and NaN by name, because its
/// sign depends on the processor.
const HELPERS: &str = r#"
local function kept(write)
    local at = buffer.create(48)
    write(at)
    return buffer.tostring(at)
end
local function read(get)
    local at = buffer.create(48)
    for place = 0, 47 do buffer.writeu8(at, place, place * 37 % 120) end
    return get(at)
end
local function total(a, b, c)
    local sum = 0
    for step = 1, 9 do sum = sum * a + math.sin(b * step) - c / step end
    return sum
end
local function count(a, b, c)
    local steps = 0
    for step = a, b, c do
        steps += 1
        if steps > 20 then break end
    end
    return steps
end
local bits = buffer.create(8)
local function written(done, value)
    if not done then return "error " .. string.gsub(tostring(value), "^.-:%d+: ", "")
    elseif type(value) ~= "number" then return type(value) .. " " .. tostring(value)
    elseif value ~= value then return "nan" end
    buffer.writef64(bits, 0, value)
    return string.format("%08x%08x", buffer.readu32(bits, 4), buffer.readu32(bits, 0))
end
"#;

/// Returns a chunk that returns a list of functions, one per expression.
fn chunk() -> String {
    let mut text = format!(
        "{HELPERS}return function(compute, a, b, c, i) return written(pcall(compute, a, b, c, i)) end, {{\n"
    );
    for expression in EXPRESSIONS {
        let _ =
            writeln!(text, "function(a: number, b: number, c: number, i: number) return {expression} end,");
    }
    text + "}"
}

/// Returns special values, followed by random bits and random numbers of common sizes.
fn numbers(count: usize) -> Vec<f64> {
    let mut all = vec![
        0.0,
        -0.0,
        1.0,
        -1.0,
        0.5,
        2.0,
        3.0,
        10.0,
        1e-310,
        -5e-324,
        f64::MIN_POSITIVE,
        f64::MAX,
        f64::MIN,
        f64::INFINITY,
        f64::NEG_INFINITY,
        f64::NAN,
        f64::EPSILON,
        1e16,
        9_007_199_254_740_993.0,
        4_294_967_295.0,
        4_294_967_296.0,
        -2_147_483_648.0,
        2_147_483_647.5,
        1e19,
        -1e19,
        0.1,
        1.0 / 3.0,
        359.999,
        90.0,
        255.5,
        -128.5,
        0.499_999_999_999_999_94,
        4_503_599_627_370_497.5,
        2.5,
        -2.5,
        1e300,
        1e-300,
    ];
    let mut state: u64 = 0x9E37_79B9_7F4A_7C15;
    while all.len() < count {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let chance = state ^ (state >> 29);
        #[allow(clippy::cast_precision_loss, reason = "any number will do")]
        let small = (chance >> 11) as f64 / (1u64 << 53) as f64 - 0.5;
        all.push(match chance % 4 {
            0 => f64::from_bits(chance.rotate_left(17)),
            1 => small * 4.0,
            2 => (small * 2000.0).round() / 8.0,
            _ => small * 1e5,
        });
    }
    all
}

#[test]
fn native_code_gives_the_bits_of_bytecode() {
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scripts/herb.lua");
    let registry = burgeon_objects::registry();
    let session = Session::new(&script, RunOptions { registry, ..RunOptions::default() }).unwrap();
    let (machine, _threads) = leading_machine(&session).unwrap();
    let lua = machine.lua();
    let load = || lua.load(chunk()).set_name("@all").into_function().unwrap();
    let of = |chunk: Function| chunk.call::<(Function, Vec<Function>)>(()).unwrap();
    let (ask, slow) = of(as_bytecode(lua, load));
    let fast = load();
    native(lua, &fast).unwrap();
    let (ask_fast, fast) = of(fast);
    assert_eq!((slow.len(), fast.len()), (EXPRESSIONS.len(), EXPRESSIONS.len()));
    let numbers = numbers(700);
    let mut different = String::new();
    for (index, expression) in EXPRESSIONS.iter().enumerate() {
        let mut wrong = 0;
        for place in 0..numbers.len() {
            let [a, b, c] = [1, 7, 31].map(|step| numbers[place * step % numbers.len()]);
            let given = (a, b, c, place % 41);
            // Results can contain arbitrary bytes.
            let written = |ask: &Function, compute: &Function| {
                let text: LuaString = ask.call((compute.clone(), given)).unwrap();
                text.as_bytes().escape_ascii().to_string()
            };
            let expected = written(&ask, &slow[index]);
            let found = written(&ask_fast, &fast[index]);
            if found != expected {
                wrong += 1;
                if wrong == 1 {
                    let _ = write!(different, "\n{expression} of {given:?}: {found}, not {expected}");
                }
            }
        }
        if wrong > 1 {
            let _ = write!(different, ", and {} more", wrong - 1);
        }
    }
    assert!(different.is_empty(), "native code differs from bytecode:{different}");
}
