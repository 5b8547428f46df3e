//! The choice among several errors does not depend on threads, batches or addresses.

use crate::support::{Folder, HEAD, chain, without_columns};

/// Returns a folder with a script of a thousand modules, of which several fail, the first one by the last
/// rule.
fn big(body: &str) -> Folder {
    let script = format!(
        r#"{HEAD}local list = {{}}
for i = 1, 20000 do table.insert(list, if i % 3000 == 2999 then A(i) else B()) end
s:axiom(list)
s:rule("B", function() return B(), B() end)
{body}
s:derive(2)
"#
    );
    Folder::new().with("s.lua", script).with("model.glb", "old")
}

#[test]
fn an_error_in_any_thread_names_the_first_module_of_the_chain() {
    let bodies = [
        "s:rule(\"A(x)\", function(this, x) error(\"bad\") end)",
        "s:rule(\"A(x)\", { when = function(this, x) error(\"bad\") end }, function() return B() end)",
        "s:rule(\"A(x)\", function(this, x) if x > 8000 then return A(x + 1) end return x end)",
        "s:interpret(\"A(x)\", function(this, x) error(\"bad\") end)",
        "s:interpret(\"A(x)\", function(this, x) this:forward(0 / 0) end)",
        "s:interpret(\"A(x)\", function(this, x) this:forward(0 / 0) print(this:position()) end)",
    ];
    for body in bodies {
        let folder = big(body);
        let mut said = Vec::new();
        for (threads, batch) in [("1", "4096"), ("2", "100"), ("5", "1000")] {
            let flags = ["run", "s.lua", "-o", "model.glb", "--threads", threads, "--batch", batch];
            said.push(folder.burgeon(&flags).failed());
        }
        assert!(said.iter().all(|other| *other == said[0]), "{body}: {said:#?}");
        assert!(
            without_columns(&said[0]).starts_with("error: s.lua:7: rule A(x)")
                && said[0].contains("module: A(2999), step "),
            "{}",
            said[0]
        );
        assert_eq!(folder.read("model.glb"), "old");
    }
}

#[test]
fn of_two_rules_that_fail_the_one_whose_module_comes_first_is_told() {
    let rules = [
        "s:rule(\"A(x)\", function(this, x) error(\"first in the chain\") end)",
        "s:rule(\"C\", function(this) error(\"later in the chain\") end)",
    ];
    for order in [[0, 1], [1, 0]] {
        let script = format!(
            "{HEAD}local C = module(\"C\")\ns:axiom(B(), A(1), C(), A(2))\n{}\n{}\ns:derive(1)\n",
            rules[order[0]], rules[order[1]]
        );
        let said = Folder::new().with("s.lua", script).burgeon(&["run", "s.lua", "--batch", "1"]).failed();
        assert!(said.contains("first in the chain\n") && said.contains("module: A(1), step 1\n"), "{said}");
    }
}

#[test]
fn an_error_in_the_second_step_names_that_step() {
    let script = format!(
        "{HEAD}s:rule(\"A(x)\", function(this, x) if x == 3 then error(\"bad\") end return A(x + 1) end)\ns:derive()\n"
    );
    let said = Folder::new().with("s.lua", script).burgeon(&["run", "s.lua"]).failed();
    assert!(said.contains("rule A(x): bad\n") && said.contains("module: A(3), step 3\n"), "{said}");
}

#[test]
fn a_script_prints_once_however_many_threads_run_it() {
    let script = format!(
        "{HEAD}print(\"top\")\nlocal list = table.create(20000, A(1))\ns:axiom(list)\ns:rule(\"A(x)\", function(this, x) return A(x + 1) end)\ns:derive(2)\nprint(\"end\")\n"
    );
    let said =
        Folder::new().with("s.lua", script).burgeon(&["run", "s.lua", "--threads", "2", "--json"]).done();
    assert_eq!(said.stderr, "top\nend\n");
}

#[test]
fn addresses_are_not_seen_by_scripts() {
    for value in
        ["{}", "print", "turtle()", "function() end", "coroutine.create(function() end)", "buffer.create(1)"]
    {
        let script = format!(
            "{HEAD}s:axiom(A(tostring({value})), A(string.format(\"%s %*\", {value}, {value})))\ns:derive(0)\n"
        );
        let once = chain(&script, &[]);
        assert!(!once.contains("0x"), "{once}");
        assert_eq!(chain(&script, &[]), once);
    }
}

#[test]
fn keys_whose_order_depends_on_addresses_are_refused_in_loops() {
    let loops = [
        "for make in counts do local _ = make end",
        "for make, count in pairs(counts) do local _ = make end",
        "for make in next, counts do local _ = make end",
        "local iterate = pairs for make in iterate(counts) do local _ = make end",
        "local _ = next(counts)",
        "local function all() return counts end for make in all() do local _ = make end",
    ];
    for keys in ["[A] = 1, [B] = 2", "[{}] = 1, name = 2", "[turtle()] = 1, 2"] {
        for inner in loops {
            let script = format!(
                "{HEAD}local counts: any = {{ {keys} }}\ns:rule(\"A(x)\", function(this, x)\n{inner}\nend)\ns:derive(1)\n"
            );
            let said = Folder::new().with("s.lua", script).burgeon(&["run", "s.lua"]).failed();
            assert!(
                without_columns(&said).starts_with("error: s.lua:5: rule A(x): the order of a table with "),
                "{inner}: {said}"
            );
            assert!(
                said.contains(" for a key is not certain\n") && said.contains("go through a list"),
                "{said}"
            );
        }
    }
    let said =
        Folder::new().with("s.lua", "for key in pairs(nil) do end\n").burgeon(&["run", "s.lua"]).failed();
    insta::assert_snapshot!(said, @r"
error: s.lua:1:12: pairs takes a table, not nothing
  | for key in pairs(nil) do end
  |            ^^^^^
");
}

#[test]
fn weak_tables_are_refused() {
    for weak in ["{ __mode = \"k\" }", "{ [\"__mode\"] = \"v\" }"] {
        let script = format!("local kept = setmetatable({{}}, {weak})\nkept[1] = {{}}\n");
        let said = Folder::new().with("s.lua", script).burgeon(&["run", "s.lua"]).failed();
        assert!(
            without_columns(&said)
                .starts_with("error: s.lua:1: the content of a weak table is not deterministic\n"),
            "{said}"
        );
    }
    let script = "local meta: any = {}\nmeta.__mode = \"k\"\n";
    let said = Folder::new().with("s.lua", script).burgeon(&["check", "s.lua"]).failed();
    assert!(
        without_columns(&said)
            .starts_with("error: s.lua:2: the content of a weak table is not deterministic\n"),
        "{said}"
    );
}
