//! Tests of queries of the modules of chains, which are tables.

use burgeon::Run;
use burgeon::script::RunOptions;

use super::scripts::{all_chains, lines, run_with, try_run};

fn chains(script: &str) -> Vec<String> {
    lines(&run_with(script, burgeon::options()))
}

fn warnings(run: &Run) -> Vec<String> {
    run.warnings.iter().map(ToString::to_string).collect()
}

#[test]
fn a_rule_sees_its_chain_as_it_stood_when_the_step_began() {
    // Each step doubles the modules, and each module stores the number of modules before the step.
    let script = r#"
        local A, B = module("A", "n"), module("B")
        local s = lsystem({})
        s:axiom(A(0), { B() })
        s:rule("A", function()
          local n = #query("A")
          return A(n), A(n)
        end)
        s:derive(3)
    "#;
    assert_eq!(chains(script), ["A(4) A(4) A(4) A(4) A(4) A(4) A(4) A(4) [ B ]"]);
}

#[test]
fn modules_that_a_query_makes_come_from_the_chain_before_the_step() {
    let script = r#"
        local A, Copy = module("A", "n"), module("Copy", "n")
        local s = lsystem({})
        s:axiom(A(1), A(2))
        s:rule("A(n)", function(this, n)
          return A(n + 10), query("select n from A where n <> $n", Copy)
        end)
        s:derive(2)
    "#;
    assert_eq!(chains(script), ["A(21) Copy(12) Copy(2) A(22) Copy(11) Copy(1)"]);
}

#[test]
fn interpretations_see_the_chain_that_they_draw() {
    let script = r#"
        local A, Seen = module("A"), {}
        local s = lsystem({ object = turtle(), interpret = "last" })
        s:axiom(A())
        s:rule("A", function() return A(), A() end)
        s:interpret("A", function(this)
          assert(#query("A") == 4)
          this:forward(1)
        end)
        s:derive(2)
        local rows = query("A")
        assert(#rows == 4 and rows[1].present == true)
    "#;
    let run = run_with(script, burgeon::options());
    assert_eq!(lines(&run), ["A A A A"]);
}

#[test]
fn systems_derived_before_are_seen_by_rules_axioms_and_the_top_level() {
    let script = r#"
        local Path, Tree, Far = module("Path", "line", "width"), module("Tree", "place"), module("Far", "place")
        local paths = lsystem({})
        paths:axiom(Path(line({ 0, 0 }, { 0, 100 }), 2), Path(line({ 50, 0 }, { 50, 100 }), 4))
        paths:derive(0)
        assert(#query("Path") == 2 and #query("Tree") == 0)
        local trees = lsystem({})
        trees:axiom(query("select ST_Centroid(line) as place from Path", Tree), Tree(point(20, 50)), Tree(point(48.5, 9)))
        trees:rule("Tree(place)", function(this, place)
          local near = query("select width from Path where ST_DWithin(line, $place, width / 2)")
          return if #near > 0 then nil else Far(place)
        end)
        trees:derive(1)
        assert(query("select count(*) as n from Far, Path where ST_DWithin(place, line, 21)")[1].n == 1)
    "#;
    assert_eq!(chains(script), ["Far(POINT (20 50))"]);
}

#[test]
fn modules_join_sources_and_each_other_by_any_geometry() {
    let script = r#"
        source({
          { id = "a", geometry = polygon({ 0, 0 }, { 10, 0 }, { 10, 10 }, { 0, 10 }), kind = "lawn" },
          { id = "b", geometry = polygon({ 20, 0 }, { 30, 0 }, { 30, 10 }, { 20, 10 }), kind = "bed" },
        }, { table = "areas" })
        local Tree = module("Tree", "place", "crown", "tags?", "name?")
        local Note = module("Note", "kind", "pairs")
        local s = lsystem({})
        local function tree(x, y, name)
          return Tree(point(x, y), point(x, y):buffer(3), { 1 }, name)
        end
        s:axiom(tree(5, 5, "first"), tree(6, 6), tree(25, 5))
        s:rule("Tree(place, crown, tags, name)", function(this, place, crown, tags, name)
          local area = query("select kind from areas where ST_Contains(geom, $place)")[1]
          local pairs = query([[select a.name from Tree a, Tree b
            where ST_Intersects(a.crown, b.crown) and not ST_Equals(a.place, b.place)]])
          assert(#query("select 1 as x from Tree where tags is null") == 3)
          return Note(area.kind, #pairs)
        end)
        s:derive(1)
    "#;
    assert_eq!(chains(script), [r#"Note("lawn",2) Note("lawn",2) Note("bed",2)"#]);
}

#[test]
fn neighbors_are_those_that_every_pair_gives_for_any_threads_and_pieces() {
    let script = r#"
        local Tree, Sum = module("Tree", "place", "id"), module("Sum", "id", "near")
        local chain = {}
        for id = 1, 400 do
          chain[id] = Tree(point(random(0, 300), random(0, 300)), id)
        end
        local s = lsystem({})
        s:axiom(table.unpack(chain))
        s:rule("Tree(place, id)", function(this, place, id)
          local all, near = query("select place, id from Tree"), 0
          for _, other in all do
            if other.id ~= id and other.place:distance(place) <= 25 then
              near += 1
            end
          end
          local found = #query("select id from Tree where id <> $id and ST_DWithin(place, $place, 25)")
          assert(found == near, `{id}: {found}, not {near}`)
          return Sum(id, near)
        end)
        s:derive(1)
    "#;
    let with = |threads, batch| {
        let options = RunOptions { threads: Some(threads), batch, seed: 7, ..burgeon::options() };
        all_chains(&run_with(script, options))
    };
    let one = with(1, 4096);
    assert!(one.contains("Sum(400,"));
    assert_eq!(one, with(3, 16));
    assert_eq!(one, with(2, 61));
}

#[test]
fn a_derivation_again_hides_the_modules_of_the_first() {
    let script = r#"
        local A = module("A")
        local s = lsystem({})
        s:axiom(A())
        s:rule("A", function() return A(), A() end)
        s:derive(3)
        assert(#query("A") == 8)
        s:derive(1)
        assert(#query("A") == 2)
    "#;
    run_with(script, burgeon::options());
}

#[test]
fn a_module_that_only_queries_look_at_is_not_undrawn() {
    let script = |use_it: &str| {
        format!(
            r#"
            local A, Mark = module("A"), module("Mark")
            local s = lsystem({{ object = turtle() }})
            s:axiom(A(), Mark())
            s:rule("A", function() {use_it} return F(1) end)
            s:derive(1)
            "#
        )
    };
    let run = run_with(&script("assert(#query(\"Mark\") == 1)"), burgeon::options());
    assert_eq!(warnings(&run), [""; 0]);
    let run = run_with(&script(""), burgeon::options());
    assert!(
        warnings(&run)[0].contains("Mark has neither a rule nor an interpretation"),
        "{:?}",
        warnings(&run)
    );
}

#[test]
fn a_source_of_the_same_name_is_read_with_a_warning() {
    let script = r#"
        source({ { id = 1, geometry = point(3, 4), height = 5 } }, { table = "tree" })
        local Tree = module("Tree", "place")
        local s = lsystem({})
        s:axiom(Tree(point(0, 0)), Tree(point(1, 0)))
        s:rule("Tree", function()
          assert(query("Tree")[1].height == 5)
          return nil
        end)
        s:derive(1)
    "#;
    let run = run_with(script, burgeon::options());
    let warning = &warnings(&run)[0];
    assert!(warning.contains("Tree in a query is the source tree, not the modules Tree"), "{warning}");
}

#[test]
fn a_table_that_is_not_there_is_refused_with_the_nearest_module() {
    let script = r#"
        local Building, A = module("Building", "geom"), module("A")
        local s = lsystem({})
        s:axiom(A())
        s:rule("A", function()
          query("Bilding")
          return nil
        end)
        s:derive(1)
    "#;
    let Err(error) = try_run(script, burgeon::options()) else { panic!("this should fail") };
    assert!(error.message().contains("no table called Bilding"), "{error}");
    assert_eq!(error.remedy(), Some("did you mean Building?"));
}

#[test]
fn chains_that_are_left_out_for_their_data_are_no_longer_seen() {
    // The interpretation of the second module fails: rules observe it before the failure, but neither rules
    // nor systems do afterwards.
    let script = r#"
        local A, Count = module("A", "height", "seen"), module("Count", "n")
        local function square(x, height)
          return { geometry = polygon({ x, 0 }, { x + 9, 0 }, { x + 9, 9 }, { x, 9 }), height = height }
        end
        local s = lsystem({})
        s:axiom(source({ square(0, 3), square(20, -1), square(40, 5) }), function(feature)
          return footprint(feature), A(feature.height, 0)
        end)
        s:rule("A(height, seen)", function(this, height, seen)
          return A(height, #query("select * from A"))
        end)
        s:interpret("A(height, seen)", function(this, height, seen)
          if seen == 3 then
            this:walls({ height = height })
          end
        end)
        s:derive(3)
        local later = lsystem({})
        later:axiom(Count(#query("A")))
        later:derive(0)
    "#;
    let run = run_with(script, burgeon::options());
    assert_eq!(all_chains(&run), "A(3,2)\nA(5,2)\nCount(2)\n");
}
