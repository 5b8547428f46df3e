//! Chains of derived systems as lists, which scripts read and change between derivations.

use super::scripts::{chain, chain_of_each, chains, error, run};

const PLANT: &str = "local Leaf, Stem, Fruit = module('Leaf', 'age', 'kind?'), module('Stem'), module('Fruit', 'size')
    local plant = lsystem()
    plant:axiom(Leaf(0))
    plant:rule('Leaf(age, _)', function(this, age) return Stem(), { Leaf(age + 1, if age > 1 then 'old' else nil) }, Leaf(age + 1) end)\n";

#[test]
fn a_list_has_the_modules_and_branches_of_the_chain() {
    run(&format!(
        "{PLANT}
         local derived = plant:derive(2)
         local list = derived:chain()
         expect(derived.chains[1], 'Stem [ Stem [ Leaf(2) ] Leaf(2) ] Stem [ Leaf(2) ] Leaf(2)')
         expect(#list, 5)
         expect(list[1].name, 'Stem')
         expect(list[2].name == nil and #list[2], 3)
         expect(list[2][2][1].age, 2)
         expect(list[5].kind == nil and list[5].size == nil, true)
         expect(tostring(list[5]), 'Leaf(2)')
         expect(plant:derive(3):chain()[2][1].name, 'Stem')"
    ));
}

#[test]
fn a_changed_list_is_an_axiom() {
    let script = format!(
        "{PLANT}
         local function pruned(list)
           local kept = {{}}
           for _, item in list do
             if item.name == nil then
               table.insert(kept, pruned(item))
             elseif item.name == 'Leaf' and item.kind == 'old' then
               table.insert(kept, Fruit(item.age * 2))
             else
               table.insert(kept, item)
             end
           end
           return kept
         end
         local first = plant:derive(3)
         plant:axiom(sequence(pruned(first:chain())))
         plant:derive(0)
         plant:axiom(sequence(first:chain()))
         plant:derive(0)"
    );
    let chains = chain_of_each(&script);
    assert_eq!(chains[1], chains[0].replace("Leaf(3,\"old\")", "Fruit(6)"));
    assert_eq!(chains[2], chains[0]);
    assert!(chains[1].contains("Fruit(6)"), "{}", chains[1]);
}

#[test]
fn each_chain_of_a_source_has_a_list() {
    let script = "local A = module('A', 'n') local s = lsystem()
        s:axiom(source({ { n = 1 }, { n = 2 }, { n = 3 } }), function(feature) return A(feature.n), { A(-feature.n) } end)
        local derived = s:derive(0)
        local t = lsystem()
        t:axiom(sequence(derived:chain(3)), A(#derived:chain(2)))
        t:derive(0)";
    assert_eq!(chains(script), ["A(3) [ A(-3) ] A(2)"]);
    let told = error(&script.replace("chain(3)", "chain(4)"));
    assert!(
        told.contains("no chain number 4") && told.contains("derived:chain(1) to derived:chain(3)"),
        "{told}"
    );
    assert!(error(&script.replace("chain(3)", "chain('x')")).contains("takes the number of a chain"));
    assert!(error(&script.replace("chain(3)", "chain(0)")).contains("takes the number of a chain"));
}

#[test]
fn long_and_deep_chains_are_read_within_the_limits() {
    run("local A, B = module('A'), module('B', 'x') local s = lsystem()
         s:axiom(A())
         s:rule('A', function() return B(1), { A() } end)
         local depth, list = 0, s:derive(3000):chain()
         while list do
           depth += 1
           list = list[2] or (list[1] and list[1].name == nil and list[1])
         end
         expect(depth, 3001)");
    let deep = error(
        "local A = module('A') local s = lsystem() s:axiom(A())
         s:rule('A', function() return { A() } end)
         s:axiom(sequence(s:derive(300):chain())) s:derive(0)",
    );
    assert!(deep.contains("nested more than 200 deep"), "{deep}");
}

#[test]
fn modules_that_scripts_keep_are_read_by_name() {
    assert_eq!(
        chain(
            "local A = module('A', 'x', 'y?') local kept = A(3, 4) local s = lsystem()
             s:axiom(A(kept.x + kept.y), A(if kept.name == 'A' and kept.z == nil then 1 else 0)) s:derive(0)"
        ),
        "A(7) A(1)"
    );
    assert!(error("local A = module('A', 'x') A(1).x = 2").contains("readonly"));
}
