//! Results of successors: law 3 of the design.

use super::scripts::{chain, divided, error, lines, run, run_with};

const HEAD: &str = r#"
    local A = module("A"); local B = module("B", "x"); local C = module("C"); local D = module("D", "length?", "width?")
    local s = lsystem {}
"#;

/// Returns the chain after one step of a system with the axiom `C A C` and a rule for `A`.
fn after(rule: &str) -> String {
    chain(&script(rule))
}

/// Returns the chains for many rules, each in a block with its own system.
fn after_each(rules: &[String]) -> Vec<String> {
    let blocks: Vec<String> = rules
        .iter()
        .map(|rule| format!("do local s = lsystem {{}} s:axiom(C(), A(), C()) {rule}\n s:derive(1) end"))
        .collect();
    let run = run(&format!("{HEAD}\n{}", blocks.join("\n")));
    run.systems.iter().map(|system| system.chain_text().trim_end().to_owned()).collect()
}

/// Checks that each rule gives its chain, and reports all that do not.
fn check(table: &[(String, &str)]) {
    let rules: Vec<String> = table.iter().map(|(rule, _)| rule.clone()).collect();
    let found = after_each(&rules);
    assert_eq!(found.len(), table.len());
    let wrong: Vec<String> = table
        .iter()
        .zip(&found)
        .filter(|((_, expected), found)| expected != found)
        .map(|((rule, expected), found)| format!("{rule}\n    gives {found}, not {expected}"))
        .collect();
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
}

fn check_all(rules: &[&str], expected: &'static str) {
    let table: Vec<(String, &str)> = rules.iter().map(|rule| ((*rule).to_owned(), expected)).collect();
    check(&table);
}

fn script(rule: &str) -> String {
    format!("{HEAD}\n s:axiom(C(), A(), C())\n {rule}\n s:derive(1)")
}

/// Returns the body as an inline function, as a function in a variable, and as a string of Lua. A string without `return`
/// would be a string of modules.
fn bodies(body: &str) -> [String; 3] {
    let end = if body.contains("return") { "" } else { " return" };
    [
        format!("s:rule(\"A\", function(this) {body} end)"),
        format!("local function f(this) {body} end\n s:rule(\"A\", f)"),
        format!("s:rule(\"A\", [==[ {body}{end} ]==])"),
    ]
}

#[test]
fn the_three_kinds_of_result_hold_however_the_successor_is_written() {
    let table = [
        // No value keeps the module.
        ("", "C A C"),
        ("return", "C A C"),
        ("local x = 1", "C A C"),
        ("if 1 > 2 then return B(1) end", "C A C"),
        ("local function nothing() end return nothing()", "C A C"),
        ("return table.unpack({})", "C A C"),
        // Nil erases the module.
        ("return nil", "C C"),
        ("local x = nil return x", "C C"),
        ("return (nil)", "C C"),
        ("local function nothing() end return (nothing())", "C C"),
        ("if true then return nil end return C()", "C C"),
        // A list replaces the module.
        ("return B(1)", "C B(1) C"),
        ("return (B(1))", "C B(1) C"),
        ("return A(), A()", "C A A C"),
        ("return B(1), C(), B(2)", "C B(1) C B(2) C"),
        ("return table.unpack({ B(1), B(2) })", "C B(1) B(2) C"),
        ("return C(), table.unpack({ B(1), { B(2) } })", "C C B(1) [ B(2) ] C"),
        ("return if 1 > 2 then B(1) else C()", "C C C"),
        ("return 1 > 2 and B(1) or C()", "C C C"),
        ("do return B(1) end", "C B(1) C"),
        ("for i = 1, 3 do if i == 2 then return B(i) end end", "C B(2) C"),
        ("while true do return B(1) end", "C B(1) C"),
        ("repeat local x = 3 until x == 3 return B(1);", "C B(1) C"),
        // A nested table is a branch.
        ("return { B(1) }", "C [ B(1) ] C"),
        ("local t = { B(1), { B(2) } } return t[1], t[2]", "C B(1) [ B(2) ] C"),
        ("local t = { { B(1) } } return t[1][1]", "C B(1) C"),
        ("local t = { b = B(1) } return t.b", "C B(1) C"),
        ("local t = { B(1) } return { t[1] }", "C [ B(1) ] C"),
        ("local t = { B(1) } return (t[1])", "C B(1) C"),
        ("local t = { 1 } return B(t[1])", "C B(1) C"),
        ("local t = { 1 } return { B(t[1]) }", "C [ B(1) ] C"),
        (
            "return --[[ why ]] B(1) --[[ not ]], --[[ so ]] { C() --[[ here ]] } --[[ there ]]",
            "C B(1) [ C ] C",
        ),
        ("return {}", "C [ ] C"),
        ("return {}, {}", "C [ ] [ ] C"),
        ("return { {} }", "C [ [ ] ] C"),
        ("return B(1), { B(2), { B(3) }, B(4), }, B(5)", "C B(1) [ B(2) [ B(3) ] B(4) ] B(5) C"),
        ("return { { { B(1) }; C() } }", "C [ [ [ B(1) ] C ] ] C"),
        ("local inner = { B(1) } return { inner, inner }", "C [ [ B(1) ] [ B(1) ] ] C"),
        ("return { table.unpack({ B(1), B(2) }) }", "C [ B(1) B(2) ] C"),
        ("return { A(), nil }", "C [ A ] C"),
    ];
    let rules = table.iter().flat_map(|(body, expected)| bodies(body).map(|rule| (rule, *expected)));
    check(&rules.collect::<Vec<_>>());
}

#[test]
fn anything_else_is_an_error_that_names_the_rule() {
    let table = [
        ("return 1", "the number 1"),
        ("return true", "the boolean true"),
        ("return false", "the boolean false"),
        ("return \"B\"", "the string \"B\""),
        ("return B", "a function"),
        ("return B(1), nil", "nothing"),
        ("return nil, B(1)", "nothing"),
        ("return nil, nil", "nothing"),
        ("return B(1), 2", "the number 2"),
        ("return { 3 }", "the number 3"),
        ("return { B(1), { false } }", "the boolean false"),
        ("return { x = B(1) }", "field x"),
        ("return { B(1), x = 2 }", "field x"),
    ];
    for (index, (body, what)) in table.into_iter().enumerate() {
        // The first body in every form, the others in one form each.
        for rule in bodies(body).into_iter().enumerate().filter(|(form, _)| index == 0 || index % 3 == *form)
        {
            let rule = rule.1;
            let told = error(&script(&rule));
            assert!(told.contains("rule A: "), "{rule}: {told}");
            assert!(told.contains(what), "{rule}: {told} does not tell of {what}");
            assert!(told.contains("main.lua:") && told.contains("module: A, step 1"), "{rule}: {told}");
            assert!(told.contains("help: "), "{rule}: {told}");
        }
    }
}

#[test]
fn modules_may_come_from_helper_functions() {
    check_all(&[
        // One module, two, a branch, and a list that a helper function made.
        "local function make(x) return B(x) end
         s:rule(\"A\", function() return make(1), make(2) end)",
        "local function pair(x) return B(x), B(x + 1) end
         s:rule(\"A\", function() return pair(1) end)",
        "local function list(n) local t = {} for i = 1, n do table.insert(t, B(i)) end return t end
         s:rule(\"A\", function() return table.unpack(list(2)) end)",
        "local make make = function(n) if n == 0 then return end return B(3 - n), make(n - 1) end
         s:rule(\"A\", function() return make(2) end)",
        "local helpers = { make = function(x) return B(x) end }
         s:rule(\"A\", function() return helpers.make(1), helpers.make(2) end)",
        "local make = B
         s:rule(\"A\", function() return make(1), make(2) end)",
        "local makers = { B }
         s:rule(\"A\", function() return makers[1](1), B(2) end)",
        "local function twice(make, x) return make(x), make(x + 1) end
         s:rule(\"A\", function() return twice(B, 1) end)",
        "local function both(a, b) return a, b end
         s:rule(\"A\", function() return both(B(1), B(2)) end)",
        "s:rule(\"A\", function() local ok, a = pcall(B, 1) return a, B(2) end)",
        "s:rule(\"A\", function() local make = coroutine.wrap(function() coroutine.yield(B(1)) coroutine.yield(B(2)) end)
           local a = make() return a, make() end)",
    ], "C B(1) B(2) C");
}

#[test]
fn modules_may_be_kept_and_used_more_than_once() {
    check_all(
        &[
            "s:rule(\"A\", function() local b = B(1) return b, C(), b end)",
            "local b = B(1) s:rule(\"A\", function() return b, C(), b end)",
            "local list = { B(1), C(), B(1) } s:rule(\"A\", function() return table.unpack(list) end)",
            "local b = B(1) s:rule(\"A\", function() local c = C() return b, c, B(1) end)",
            "local kept = { [1] = B(1), c = C() } s:rule(\"A\", function() return kept[1], kept.c, kept[1] end)",
        ],
        "C B(1) C B(1) C",
    );
    assert_eq!(
        after("local twig = { B(1), { C() } } s:rule(\"A\", function() return twig, twig end)"),
        "C [ B(1) [ C ] ] [ B(1) [ C ] ] C"
    );
}

#[test]
fn modules_stand_as_they_were_returned_not_as_they_were_made() {
    check_all(
        &[
            "s:rule(\"A\", function() local one, two = B(1), B(2) return two, one end)",
            "s:rule(\"A\", function() local one = B(1) local two = B(2) local three = B(3) return two, one end)",
            "s:rule(\"A\", function() B(7) local one = B(1) B(8) return B(2), one end)",
            "local one = B(1) s:rule(\"A\", function() return B(2), one end)",
            "s:rule(\"A\", function() local t = { B(1), B(2) } return t[2], t[1] end)",
        ],
        "C B(2) B(1) C",
    );
    assert_eq!(
        after("s:rule(\"A\", function() local a, b, c = D(1), B(2), D(3, 4) return { c, { a } }, b end)"),
        "C [ D(3,4) [ D(1) ] ] B(2) C"
    );
}

#[test]
fn modules_that_were_made_but_not_returned_do_not_appear() {
    check_all(
        &[
            "s:rule(\"A\", function() B(7) return B(1) end)",
            "s:rule(\"A\", function() local waste = { B(7), B(8) } return B(1) end)",
            "local function waste() B(7) return 1 end s:rule(\"A\", function() return B(waste()) end)",
            "local function waste() B(7) return 1 end s:rule(\"A\", function() waste() return B(1) end)",
            "local waste waste = function() B(7) return 1 end s:rule(\"A\", function() return B(waste()) end)",
            "local t = { waste = function() B(7) return 1 end } s:rule(\"A\", function() return B(t.waste()) end)",
            "local t = setmetatable({}, { __index = function() B(7) return 1 end })
         s:rule(\"A\", function() return B(t.x) end)",
            "local t = setmetatable({}, { __add = function() B(7) return 1 end })
         s:rule(\"A\", function() return B(t + 1) end)",
            "local t = setmetatable({}, { __len = function() B(7) return 1 end })
         s:rule(\"A\", function() return B(#t) end)",
            "local t = setmetatable({}, { __concat = function() B(7) return \"1\" end })
         s:rule(\"A\", function() return B(tonumber(t .. \"1\")) end)",
            "local t = setmetatable({}, { __lt = function() B(7) return true end })
         s:rule(\"A\", function() if t < t then return B(1) end return C() end)",
            "local function once(_, i) if not i then B(7) return 1 end end
         s:rule(\"A\", function() for i in once do local x = i end return B(1) end)",
            "local function once(_, i) if not i then B(7) return 1 end end
         s:rule(\"A\", function() for i in once do return B(i) end end)",
            "local t = setmetatable({}, { __iter = function() B(7) return next, { 1 } end })
         s:rule(\"A\", function() for i in t do return B(i) end end)",
            "s:rule(\"A\", function() pcall(function() B(7) error(\"no\") end) return B(1) end)",
            "s:rule(\"A\", function() return B((function() B(7) return 1 end)()) end)",
            "s:rule(\"A\", function() return B(#{ B(7) }) end)",
            "s:rule(\"A\", function() return B(if B(7) then 1 else 2) end)",
            "s:rule(\"A\", function() return B(tonumber(`{if B(7) then 1 else 2}`)) end)",
            "s:rule(\"A\", function() local x = string.gsub(\"a\", \"a\", function() B(7) return \"1\" end) return B(tonumber(x)) end)",
            "s:rule(\"A\", function() local x = (\"a\"):gsub(\"a\", function() B(7) return \"1\" end) return B(tonumber(x)) end)",
            "s:rule(\"A\", function() local t = { 2, 1 } table.sort(t, function(a, b) B(7) return a < b end) return B(t[1]) end)",
            "local first = function(a, b) B(7) return a < b end
         s:rule(\"A\", function() local t = { 2, 1 } table.sort(t, first) return B(t[1]) end)",
            "s:rule(\"A\", { when = function() B(7) return true end }, function() return B(1) end)",
        ],
        "C B(1) C",
    );
    assert_eq!(after("s:rule(\"A\", function() B(7) end)"), "C A C");
    assert_eq!(after("s:rule(\"A\", function() B(7) return nil end)"), "C C");
    assert_eq!(after("s:rule(\"A\", function() B(7) return {} end)"), "C [ ] C");
}

#[test]
fn a_module_of_another_application_is_refused() {
    // The table is made at the top level and frozen while rules run, so only a coroutine can keep one.
    let told = error(&format!(
        "{HEAD}
        local keep = coroutine.wrap(function() local b = B(1) while true do coroutine.yield(b) end end)
        s:axiom(A(), A())
        s:rule(\"A\", function() return keep() end)
        s:derive(1)"
    ));
    assert!(told.contains("main.lua:"), "{told}");
}

#[test]
fn a_module_may_have_more_than_eight_parameters() {
    for count in [7, 8, 9, 12, 32] {
        let names: Vec<String> = (1..=count).map(|i| format!("p{i}")).collect();
        let quoted: Vec<String> = names.iter().map(|name| format!("\"{name}\"")).collect();
        let values: Vec<String> = (1..=count).map(|i| i.to_string()).collect();
        let reversed: Vec<String> = names.iter().rev().cloned().collect();
        let (names, quoted, values) = (names.join(", "), quoted.join(", "), values.join(", "));
        let text = chain(&format!(
            r#"
            local W = module("W", {quoted}); local V = module("V", {quoted})
            local s = lsystem {{}}
            s:axiom(W({values}), W({values}))
            s:rule("W({names})", {{ when = function(this, {names}) return p{count} == {count} and p1 == 1 end }},
              function(this, {names}) return V({0}), {{ V({names}) }} end)
            s:derive(1)
            "#,
            reversed.join(", ")
        ));
        let forward = values.replace(' ', "");
        let backward: Vec<&str> = forward.split(',').rev().collect();
        let one = format!("V({}) [ V({forward}) ]", backward.join(","));
        assert_eq!(text, format!("{one} {one}"));
    }
}

#[test]
fn a_rule_with_contexts_may_take_more_than_eight_parameters() {
    let text = chain(
        r#"
        local P = module("P", "a", "b", "c", "d"); local Sum = module("Sum", "x", "text")
        local s = lsystem {}
        s:axiom(P(1, 2, 3, 4), P(5, 6, 7, "eight"), P(9, 10, 11, 12))
        s:rule("P(a, b, c, d) < P(e, f, g, h) > P(i, j, k, l)", function(this, a, b, c, d, e, f, g, h, i, j, k, l)
          return Sum(a + b + c + d + e + f + g + i + j + k + l, h)
        end)
        s:derive(1)
        "#,
    );
    assert_eq!(text, "P(1,2,3,4) Sum(70,\"eight\") P(9,10,11,12)");
}

#[test]
fn optional_parameters_may_be_left_out_and_read_as_nil() {
    let text = after(
        "s:axiom(D(), D(1), D(1, 2), D(nil, 3)) s:rule(\"D(l, w)\", function(this, l, w) return D(w, l) end)",
    );
    assert_eq!(text, "D D(nil,1) D(2,1) D(3)");
    let text = after(
        "s:axiom(D(), D(0)) s:rule(\"D(l, w)\", function(this, l, w) return B(if l == nil then -1 else l), D() end)",
    );
    assert_eq!(text, "B(-1) D B(0) D");
}

#[test]
fn a_wrong_number_of_parameters_is_refused_wherever_the_module_is_made() {
    for make in ["B()", "B(1, 2)", "A(1)", "D(1, 2, 3)"] {
        for rule in bodies(&format!("return {make}")).into_iter().chain([
            format!("s:axiom({make})"),
            format!("s:rule(\"A\", function() local make = {} return make{} end)", &make[..1], &make[1..]),
        ]) {
            let told = error(&script(&rule));
            assert!(told.contains("it was declared as") && told.contains("main.lua:"), "{rule}: {told}");
        }
    }
}

#[test]
fn large_successors_come_out_whole() {
    let text = after(
        "s:rule(\"A\", function() local t = {} for i = 1, 5000 do table.insert(t, { B(i) }) end return t, C() end)",
    );
    let inner: Vec<String> = (1..=5000).map(|i| format!("[ B({i}) ]")).collect();
    assert_eq!(text, format!("C [ {} ] C C", inner.join(" ")));
    // A batch makes more modules than the columns can initially store.
    let text = chain(
        r#"
        local A = module("A", "n"); local B = module("B", "a", "b", "c", "d")
        local s = lsystem {}
        s:axiom(A(12))
        s:rule("A(n)", function(this, n)
          if n == 0 then return B(1, 2, 3, 4), { B(5, 6, 7, 8) }, B(9, 10, 11, 12) end
          return A(n - 1), A(n - 1)
        end)
        s:derive(13)
        "#,
    );
    assert_eq!(text, vec!["B(1,2,3,4) [ B(5,6,7,8) ] B(9,10,11,12)"; 4096].join(" "));
}

#[test]
fn a_branch_that_contains_itself_is_refused() {
    let told = error(&script("s:rule(\"A\", function() local t = {} t[1] = t return t end)"));
    assert!(told.contains("nested") && told.contains("rule A"), "{told}");
}

#[test]
fn modules_of_one_application_keep_their_order_whatever_others_of_its_batch_make() {
    // Each application returns its modules in another order than it made them.
    let script = r#"
        local A = module("A", "n"); local B = module("B", "n", "i")
        local s = lsystem {}
        local row = {}
        for n = 1, 50 do row[n] = A(n) end
        s:axiom(table.unpack(row))
        s:rule("A(n)", function(this, n)
          local first, second = B(n, 1), B(n, 2)
          local rest = {}
          for i = 3, n do rest[i - 2] = B(n, i) end
          return second, rest, first
        end)
        s:derive(1)
    "#;
    let expected: Vec<String> = (1..=50)
        .map(|n| {
            let rest: String = (3..=n).map(|i| format!("B({n},{i}) ")).collect();
            format!("B({n},2) [ {rest}] B({n},1)")
        })
        .collect();
    for batch in [1, 7, 4096] {
        assert_eq!(lines(&run_with(script, divided(2, batch))), [expected.join(" ")]);
    }
}
