//! Equal results for any number of threads and any division into batches: laws 8 and 9 of the design.

use burgeon::Run;
use burgeon::script::RunOptions;

use super::scripts::{all_chains, divided, lines, run_with, words};

/// Stochastic, contextual and branching system, with strings, tables and an object that rules read.
const TREE: &str = r##"
    local Apex = module("Apex", "age", "kind"); local Stem = module("Stem", "l", "w"); local Leaf = module("Leaf", "shade")
    local Turn = module("Turn", "a"); local Roll = module("Roll", "a"); local Signal = module("Signal", "tag")
    local kinds = { "oak", "ash", "elm" }
    local tree = lsystem { object = turtle { width = 0.05, sides = 5 } }
    tree:ignore("Turn Roll")
    tree:axiom(source { { id = "a", n = 2 }, { id = "b", n = 1 }, { id = "c", n = 3 } }, function(feature)
      local list = { Signal({ feature.id, { depth = 0 } }), Stem(2, 0.2) }
      for i = 1, feature.n do table.insert(list, { Turn(30 * i), Stem(1, 0.1), Apex(0, kinds[i]) }) end
      return turtle { position = { feature.n * 10, 0, 0 }, width = 0.05, sides = 5 }, table.unpack(list)
    end)
    tree:rule("Apex(age, kind)", { weight = 3, when = function(this, age) return age < 6 end }, function(this, age, kind)
      local a = random(20, 40)
      return Stem(random(), 0.1), { Turn(a), Apex(age + 1, kind .. age) }, Roll(137.5), Apex(age + 1, kind)
    end)
    tree:rule("Apex(age, kind)", { weight = 1 }, function(this, age, kind)
      if random() < 0.2 then return Leaf(random()) end
      if random() < 0.2 then return nil end
    end)
    tree:rule("Signal(tag) < Stem(l, w)", function(this, tag, l, w)
      return Stem(l * 1.01, w), Signal({ tag[1], { depth = tag[2].depth + 1 } })
    end)
    tree:rule("Signal", function() return nil end)
    tree:rule("Stem(l, w) > [Apex(a, first)] Apex(b, second)", { weight = 1 }, function(this, l, w, a, first, b, second)
      return Stem(l + a / 10, w), Leaf(`{first}:{second}`)
    end)
    tree:rule("Stem(l, w) > [Apex(a, _)]", { weight = 2 }, function(this, l, w, a) return Stem(l + a / 100, w) end)
    tree:rule("Leaf(shade)", { when = function(this, shade) return this:position().z > 0 end }, function(this, shade)
      return Leaf({ shade, math.floor(this:position().z * 100) })
    end)
    tree:interpret("Stem(l, w)", function(this, l, w) this:width(w):forward(l) end)
    tree:interpret("Turn(a)", function(this, a) this:turn(a + random()) end)
    tree:interpret("Roll(a)", function(this, a) this:roll(a) end)
    tree:interpret("Leaf(shade)", function(this, shade)
      if type(shade) == "string" then this:color("#336633") end
      this:sphere(0.1)
    end)
    tree:derive(8)
"##;

fn bytes(run: &Run) -> (String, Vec<u8>) {
    let file = burgeon::export::gltf::glb(&run.scene).expect("a glTF file");
    (all_chains(run), file)
}

#[test]
fn threads_and_batches_change_no_byte() {
    let (chains, file) = bytes(&run_with(TREE, divided(1, 4096)));
    assert_eq!(chains.lines().count(), 3);
    assert!(chains.contains("[") && chains.contains("Leaf({\"") && chains.contains("oak0"), "{chains}");
    assert!(words(&chains).len() > 500, "{} modules", words(&chains).len());
    for threads in [1, 2, 7] {
        for batch in [1, 2, 7, 4096] {
            let (others, other) = bytes(&run_with(TREE, divided(threads, batch)));
            assert!(chains == others, "other chains with {threads} threads and batches of {batch}");
            assert!(file == other, "another file with {threads} threads and batches of {batch}");
        }
    }
}

#[test]
fn seeds_give_different_trees() {
    let of = |seed| bytes(&run_with(TREE, RunOptions { seed, ..burgeon::options() }));
    assert!(of(1) == of(1));
    assert_ne!(of(1).0, of(2).0);
    assert!(of(1).1 != of(2).1);
}

/// Returns a street of houses, one per id.
fn street(ids: &[&str]) -> Vec<(String, String)> {
    let features: Vec<String> = ids.iter().map(|id| format!("{{ id = \"{id}\" }}")).collect();
    let script = format!(
        r#"
        local House = module("House", "n"); local Window = module("Window", "u"); local Door = module("Door", "u")
        local s = lsystem {{}}
        s:axiom(source {{ {} }}, function(feature) return House(3), Door(0) end)
        s:rule("House(n)", {{ weight = 1 }}, function(this, n) return Window(random()), {{ House(n - 1) }} end)
        s:rule("House(n)", {{ weight = 1 }}, function(this, n) return House(n - 1), Window(random()) end)
        s:rule("Door(u)", function() return Door(random()) end)
        s:derive(3)
        "#,
        features.join(", ")
    );
    let run = run_with(&script, divided(2, 3));
    let system = run.systems.last().expect("a system");
    let ids = system.features.iter().map(|id| id.clone().expect("an id"));
    ids.zip(lines(&run)).collect()
}

#[test]
fn a_feature_more_changes_no_other_features_chain() {
    let before = street(&["a", "b", "c"]);
    assert_eq!(before.len(), 3);
    assert!(before[0].1 != before[1].1 && before[1].1 != before[2].1, "features differ: {before:?}");
    for ids in [&["a", "b", "c", "d"][..], &["d", "a", "b", "c"], &["c", "x", "b", "y", "a"], &["b"]] {
        let after = street(ids);
        assert_eq!(after.len(), ids.len());
        for (id, chain) in &after {
            if let Some((_, old)) = before.iter().find(|(known, _)| known == id) {
                assert_eq!(chain, old, "the chain of {id} among {ids:?}");
            }
        }
    }
}

#[test]
fn a_random_number_of_the_top_level_is_the_same_every_time() {
    let script = r#"
        local A = module("A", "u"); local s = lsystem {}
        s:axiom(A(random()), A(random(5, 6)))
        s:derive(0)
    "#;
    let first = lines(&run_with(script, divided(1, 1)));
    assert_eq!(first, lines(&run_with(script, divided(7, 1))));
    let words = words(&first[0]);
    assert_ne!(words[0], words[1]);
    assert!(words[1].starts_with("A(5."), "{first:?}");
    assert_ne!(first, lines(&run_with(script, RunOptions { seed: 1, ..burgeon::options() })));
}

#[test]
fn what_the_functions_of_axioms_draw_is_drawn_for_all_threads() {
    // The first function is pure, so other threads do not run it; the second one counts its calls.
    let script = r#"
        local A = module("A", "u"); local B = module("B", "u")
        local features, count = {}, 0
        for i = 1, 100 do features[i] = { id = i } end
        local function derive(axiom)
          local s = lsystem { object = turtle {} }
          local before = random()
          s:axiom(source(features), axiom)
          s:rule("A(u)", function(this, u) return B(u + before), B(random()) end)
          s:interpret("B(u)", function(this, u) this:jump({ u, before, random() }) end)
          s:derive(1)
        end
        derive(function(feature) return A(random()) end)
        derive(function(feature) count += 1 return A(random() + count) end)
        derive(function(feature) return A(random(5, 6)), A(random()) end)
    "#;
    let first = all_chains(&run_with(script, divided(1, 7)));
    assert_eq!(first.lines().count(), 300);
    for threads in [2, 7] {
        assert!(first == all_chains(&run_with(script, divided(threads, 7))), "with {threads} threads");
    }
}

#[test]
fn many_small_chains_are_put_together_in_their_order() {
    let script = r#"
        local A = module("A", "n"); local B = module("B", "n")
        local features = {}
        for i = 1, 300 do features[i] = { id = i } end
        local s = lsystem { object = turtle {} }
        s:axiom(source(features), function(feature) return turtle { position = { feature.id, 0, 0 } }, A(feature.id % 5) end)
        s:rule("A(n)", function(this, n)
          if n == 0 then return B(this:position().x) end
          return A(n - 1), { B(this:position().x) }
        end)
        s:interpret("B(n)", function(this, n) this:forward(n) end)
        s:derive(6)
    "#;
    let expected: Vec<String> =
        (1..=300).map(|id| format!("B({id}){}", format!(" [ B({id}) ]").repeat(id % 5))).collect();
    for (threads, batch) in [(1, 4096), (1, 1), (2, 7), (7, 50)] {
        assert_eq!(lines(&run_with(script, divided(threads, batch))), expected, "{threads} threads");
    }
}

#[test]
fn what_the_function_of_an_axiom_changes_is_seen_by_every_machine() {
    // The first function changes a count, the second has no side effects; rules read the count.
    let script = r#"local A, B = module("A", "x"), module("B", "x", "y")
local count, features = 0, {}
for i = 1, 300 do
  features[i] = { id = i }
end
local s = lsystem()
s:axiom(source(features), function(feature)
  count += 1
  return A(feature.id)
end)
s:rule("A(x)", function(this, x)
  return B(x, count)
end)
local first = s:derive(1)
local t = lsystem()
t:axiom(source(features), function(feature)
  return A(feature.id + count)
end)
t:rule("A(x)", function(this, x)
  return B(x, count)
end)
t:derive(1)
"#;
    let chains = |threads: usize| all_chains(&run_with(script, divided(threads, 7)));
    let one = chains(1);
    assert!(one.contains("B(300,300)") && one.contains("B(600,300)"), "{one}");
    assert_eq!(chains(3), one);
}

#[test]
fn loops_go_through_names_numbers_and_single_keys_in_one_order() {
    let script = r#"
        local A, L = module("A"), module("L", "n")
        local s = lsystem {}
        s:axiom(table.unpack(table.create(100, A())))
        local mixed: any = { a = 1, b = 2, c = 3, 4, 5, [true] = 6, [0.5] = 7 }
        local single: any = { [L] = 8 }
        s:rule("A", function()
          local out = {}
          for _, n in mixed do table.insert(out, L(n)) end
          for _, n in pairs(mixed) do table.insert(out, L(n)) end
          for _, n in next, mixed do table.insert(out, L(n)) end
          for make, n in single do table.insert(out, make(n)) end
          for make, n in pairs(single) do table.insert(out, make(n)) end
          return table.unpack(out)
        end)
        s:derive(1)
    "#;
    let first = lines(&run_with(script, divided(1, 4096)));
    let words = words(&first[0]);
    let mut each = words[..7].to_vec();
    each.sort_unstable();
    assert_eq!(each, ["L(1)", "L(2)", "L(3)", "L(4)", "L(5)", "L(6)", "L(7)"]);
    assert!(words[7..14] == words[..7] && words[14..21] == words[..7] && words[21..23] == ["L(8)", "L(8)"]);
    assert!(words.len() == 2300 && words.chunks(23).all(|chunk| chunk == &words[..23]));
    assert_eq!(first, lines(&run_with(script, divided(7, 3))));
}
