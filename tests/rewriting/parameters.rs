//! Parameters of every type (law 7): rules read the values that they were given.

use super::scripts::{chain, chain_of_each, divided, error, lines, run, run_with};

/// Returns the text of each `P(value)` in the chain after `passes` rewritings.
fn travelled(values: &[String], passes: usize) -> Vec<String> {
    let axioms: Vec<String> = values.iter().map(|value| format!("P({value})")).collect();
    let found = chain_of_each(&format!(
        r#"
        local P = module("P", "x"); local Q = module("Q", "x")
        for _, axiom in {{ {} }} do
          local s = lsystem {{}}
          s:axiom(axiom)
          s:rule("P(x)", function(this, x) return Q(x) end)
          s:rule("Q(x)", function(this, x) local y = x return P(y) end)
          s:derive({passes})
        end
        "#,
        axioms.join(", ")
    ));
    assert_eq!(found.len(), values.len());
    found.iter().map(|text| text[2..text.len() - 1].to_owned()).collect()
}

#[test]
fn every_kind_of_parameter_travels_and_is_shown() {
    let table = [
        ("1", "1"),
        ("-0", "-0"),
        ("0/0", "nan"),
        ("1/0", "inf"),
        ("-1/0", "-inf"),
        ("2^53", "9007199254740992"),
        ("true", "true"),
        ("false", "false"),
        ("\"a b\"", "\"a b\""),
        ("\"\"", "\"\""),
        ("\"caf\\u{e9}\"", "\"café\""),
        ("\"a\\\"b\\n\"", "\"a\\\"b\\n\""),
        ("{ 1, 2, 3 }", "{1,2,3}"),
        ("{}", "{}"),
        ("{ x = 1, a = \"b\" }", "{a=\"b\",x=1}"),
        ("{ { 1 }, { y = { true } } }", "{{1},{y={true}}}"),
        ("turtle {}", "turtle"),
        ("{ turtle {}, extruder {} }", "{turtle,extruder}"),
    ];
    let (values, shown): (Vec<String>, Vec<&str>) =
        table.iter().map(|(value, shown)| ((*value).to_owned(), *shown)).unzip();
    for passes in [0, 2, 3] {
        assert_eq!(travelled(&values, passes), shown, "after {passes} steps");
    }
}

#[test]
fn numbers_are_shown_as_the_shortest_decimal_that_reads_back() {
    let numbers = [
        0.1,
        1.0 / 3.0,
        0.1 + 0.2,
        1e21,
        1e300,
        5e-324,
        f64::MAX,
        f64::MIN_POSITIVE,
        123_456_789.123_456_79,
        -2.5e-9,
        1e-7,
        9e-8,
        4_503_599_627_370_497.5,
        123_456_789_012_345_680_000.0,
    ];
    let written: Vec<String> = numbers.iter().map(|value| format!("{value:e}")).collect();
    for (value, shown) in numbers.into_iter().zip(travelled(&written, 1)) {
        assert!(shown.parse::<f64>() == Ok(value), "{value} is shown as {shown}");
        let digits = |text: &str| {
            let mantissa = text.split('e').next().unwrap_or("").replace(['.', '-'], "");
            mantissa.trim_start_matches('0').trim_end_matches('0').len()
        };
        assert_eq!(digits(&shown), digits(&format!("{value:e}")), "{value} is shown as {shown}");
    }
}

#[test]
fn rules_read_back_what_was_written() {
    let text = chain(
        r#"
        local In = module("In", "kind", "x"); local Out = module("Out", "kind", "answer")
        local pen = turtle { position = { 1, 2, 3 } }
        local s = lsystem {}
        s:axiom(In("nan", 0/0), In("inf", 1/0), In("zero", -0), In("bool", false), In("text", "abc"),
          In("table", { 1, { a = { "deep" } }, n = false }), In("object", pen), In("holds", { pen }))
        s:rule("In(kind, x)", function(this, kind, x)
          local answer
          if kind == "nan" then answer = x ~= x and type(x) == "number"
          elseif kind == "inf" then answer = x == math.huge
          elseif kind == "zero" then answer = 1 / x == -math.huge
          elseif kind == "bool" then answer = x == false and type(x) == "boolean"
          elseif kind == "text" then answer = x == "abc" and #x == 3
          elseif kind == "table" then answer = #x == 2 and x[1] == 1 and x[2].a[1] == "deep" and x.n == false and table.isfrozen(x) and table.isfrozen(x[2].a)
          elseif kind == "object" then answer = x:position().y == 2
          else answer = x[1]:position().z == 3 end
          return Out(kind, answer)
        end)
        s:derive(1)
        "#,
    );
    let kinds = ["nan", "inf", "zero", "bool", "text", "table", "object", "holds"];
    let expected: Vec<String> = kinds.iter().map(|kind| format!("Out(\"{kind}\",true)")).collect();
    assert_eq!(text, expected.join(" "));
}

#[test]
fn contexts_and_guards_read_every_kind() {
    let text = chain(
        r#"
        local P = module("P", "x"); local R = module("R", "x", "y")
        local s = lsystem {}
        s:axiom(P("a"), P({ 1, 2 }), P(true), P(0/0), P("a"))
        s:rule("P(x) < P(y)", { when = function(this, x, y) return x == "a" or y == "a" end }, function(this, x, y)
          return R(x, y)
        end)
        s:derive(1)
        "#,
    );
    assert_eq!(text, "P(\"a\") R(\"a\",{1,2}) P(true) P(nan) R(nan,\"a\")");
}

#[test]
fn a_table_that_travels_is_frozen_and_can_be_copied() {
    let head = r#"
        local P = module("P", "x"); local s = lsystem {}
        s:axiom(P({ 1, { 2 } }))
    "#;
    for write in ["x[1] = 5", "x[2][1] = 5", "table.insert(x, 5)", "x.new = 1"] {
        let told =
            error(&format!("{head} s:rule(\"P(x)\", function(this, x) {write} return P(x) end) s:derive(1)"));
        assert!(
            told.contains("readonly") && told.contains("main.lua:") && told.contains("P({1,{2}})"),
            "{write}: {told}"
        );
    }
    let copied = chain(&format!(
        "{head} s:rule(\"P(x)\", function(this, x) local y = table.clone(x) y[1] += 4 return P(y) end) s:derive(2)"
    ));
    assert_eq!(copied, "P({9,{2}})");
}

#[test]
fn a_table_is_frozen_from_the_moment_it_is_in_a_module() {
    let told = error(
        r#"
        local P = module("P", "x"); local s = lsystem {}
        s:axiom(P(1))
        s:rule("P(x)", function(this, x) local t = { 1 } local p = P(t) t[1] = 2 return p end)
        s:derive(1)
        "#,
    );
    assert!(told.contains("readonly"), "{told}");
}

#[test]
fn what_is_no_parameter_is_refused() {
    let mut wrong = Vec::new();
    for (value, what) in [
        ("function() end", "a function"),
        ("print", "a function"),
        ("P(1)", "a module"),
        ("{ function() end }", "function"),
        ("{ P(1) }", "module"),
        ("coroutine.create(function() end)", "a thread"),
        ("buffer.create(8)", "a buffer"),
        ("nil", "x is missing"),
    ] {
        for place in [
            format!("s:axiom(P({value}))"),
            format!("s:axiom(P(1)) s:rule(\"P\", function() return P({value}) end)"),
        ] {
            let told = error(&format!(
                "local P = module(\"P\", \"x\"); local s = lsystem {{}}\n {place} s:derive(1)"
            ));
            let refused = told.contains(what) || told.contains("P has 1 parameter, not 0");
            if !refused || !told.contains("main.lua:2") {
                wrong.push(format!("{place}: {told}"));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn a_nan_with_any_payload_stays_a_number() {
    // Boxed values are stored in columns as NaNs; a script must not be able to forge one.
    let text = chain(
        r#"
        local P = module("P", "x"); local Q = module("Q", "kind"); local R = module("R", "x")
        local forged = buffer.create(8)
        buffer.writeu32(forged, 0, 1); buffer.writeu32(forged, 4, 0xFFFC0001)
        local bits = "\1\0\0\0\1\0\252\255"
        local s = lsystem {}
        s:axiom(P(buffer.readf64(forged, 0)), R(0), P("text"))
        s:rule("P(x)", function(this, x) return Q(type(x)) end)
        s:rule("R", function() return P((string.unpack("<d", bits))) end)
        s:derive(2)
        "#,
    );
    assert_eq!(text, "Q(\"number\") Q(\"number\") Q(\"string\")");
}

#[test]
fn equal_strings_are_equal_whoever_made_them() {
    let text = chain(
        r#"
        local P = module("P", "x"); local Q = module("Q", "x")
        local s = lsystem {}
        s:axiom(P("ab"), P("a"))
        s:rule("P(x) < P(y)", function(this, x, y) return Q(x == y .. "b") end)
        s:derive(1)
        "#,
    );
    assert_eq!(text, "P(\"ab\") Q(true)");
}

#[test]
fn strings_survive_while_thousands_of_others_come_and_go() {
    let script = r#"
        local Old = module("Old", "x"); local New = module("New", "n", "x"); local Made = module("Made", "x")
        local kept = "captured"
        local s = lsystem {}
        local list = { Old("axiom"), Made("") }
        for i = 1, 3000 do table.insert(list, New(i, "")) end
        s:axiom(table.unpack(list))
        s:rule("Old(x)", function(this, x) return Old(x) end)
        s:rule("Made(x)", function() return Made(kept) end)
        s:rule("New(n, x)", function(this, n, x)
          if x ~= "" and not string.find(x, `^{n} `) then return Old(`{n} read {x}`) end
          return New(n, `{n} {random()}`)
        end)
        s:derive(16)
    "#;
    for (threads, batch) in [(1, 4096), (2, 500)] {
        let text = lines(&run_with(script, divided(threads, batch))).concat();
        assert!(!text.contains(" read "), "a string was read as another with {threads} threads");
        assert!(text.starts_with("Old(\"axiom\") Made(\"captured\") New(1,\"1 0."), "{:.60}", text);
    }
}

#[test]
fn a_derived_system_is_an_object_that_travels() {
    let run = run(r#"
        local Leaf = module("Leaf"); local Place = module("Place", "what")
        local leaf = lsystem { object = extruder {} }
        leaf:axiom(Leaf())
        leaf:interpret("Leaf", function(this) this:extrude(2) end)
        local model = leaf:derive()
        local tree = lsystem { object = turtle {} }
        tree:axiom(Place(model), Place(model))
        tree:rule("Place(what)", { when = function(this, what) return what:high().z == 2 end }, function(this, what)
          return Place({ what })
        end)
        tree:interpret("Place(what)", function(this, what)
          if type(what) == "table" then this:advance(3):place(what[1]) end
        end)
        tree:derive(1)
        "#);
    assert_eq!(lines(&run), ["Place({model}) Place({model})"]);
    assert_eq!(run.scene.instances.len(), 2);
    let (low, high) = run.scene.bounds().expect("something is drawn");
    assert!((low.z - 3.0).abs() < 1e-9 && (high.z - 8.0).abs() < 1e-9, "{low} {high}");
}

#[test]
fn a_parameter_with_a_default_is_left_out_but_never_nil() {
    let script = |axiom: &str, successor: &str| {
        format!(
            "local L = module('L', 'a', 'b?')\nlocal list, s = {{ 1 }}, lsystem {{}}\ns:axiom({axiom})\n\
             s:rule('L(a, b)', function(_, a, b) {successor} end)\ns:derive(1)\n"
        )
    };
    assert_eq!(
        chain(&script("L(1), L(1, 2), F()", "return L(a, b), F(a), F()")),
        "L(1) F(1) F L(1,2) F(1) F F"
    );
    for (axiom, successor, line) in [
        ("F(list[5])", "return", 3),
        ("L(1)", "return F(b)", 4),
        ("L(1)", "local made = { F(b), L(a) } return table.unpack(made)", 4),
        ("L(1)", "return sequence({ F(list[5]) })", 4),
    ] {
        let made = error(&script(axiom, successor));
        assert!(
            made.contains(&format!("main.lua:{line}: ")) && made.contains("length of F is nil"),
            "{made}"
        );
        assert!(made.contains("leave it out, or give a value; it was declared as F(length?)"), "{made}");
    }
    assert!(error(&script("L(list[5])", "return")).contains("L has 1 to 2 parameters; a is missing"));
}
