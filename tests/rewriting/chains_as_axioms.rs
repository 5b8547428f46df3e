//! Chains of a derived system as the axiom of another system, which continues the derivation.

use super::scripts::{chain, divided, error, lines, run, run_with};

#[test]
fn a_system_continues_the_chain_of_another_with_its_own_rules() {
    let text = chain(
        "local A, B, C = module('A', 'n'), module('B'), module('C', 'text')
        local grow = lsystem {}
        grow:axiom(A(1), { C('x') })
        grow:rule('A(n)', function(_, n) return B(), A(n + 1) end)
        local grown = grow:derive(3)
        local prune = lsystem {}
        prune:axiom(grown)
        prune:rule('B', function() return nil end)
        prune:rule('C(text)', function(_, text) return C(text .. 'y') end)
        prune:derive(2)",
    );
    assert_eq!(text, "A(4) [ C(\"xyy\") ]");
}

#[test]
fn phases_alternate_as_often_as_the_script_wants() {
    let script = "local A, F = module('A'), module('F')
        local function system(axiom)
            local s = lsystem {}
            s:axiom(axiom)
            return s
        end
        local chain = system(A()):derive(0)
        for _ = 1, 3 do
            local grow = system(chain)
            grow:rule('A', function() return F(), A(), A() end)
            local prune = system(grow:derive(1))
            prune:rule('A < A', function() return nil end)
            chain = prune:derive(1)
        end
        expect(chain.counts, { A = 1, F = 3 })";
    assert!(run(script).warnings.is_empty());
}

#[test]
fn only_the_last_system_is_shown() {
    let made = run("local s = lsystem { object = turtle() }
        s:axiom(F(1))
        s:rule('F(l)', function(_, l) return F(l), F(l) end)
        local t = lsystem { object = turtle() }
        t:axiom(s:derive(2))
        t:rule('F(l)', function(_, l) return F(2 * l) end)
        expect(t:derive(1).objects[1]:position().z, 8, 1e-9)");
    assert!(made.warnings.is_empty(), "{:?}", made.warnings);
    let alone = run("local s = lsystem { object = turtle() } s:axiom(F(2), F(2), F(2), F(2)) s:derive(0)");
    assert_eq!(made.scene.triangles(), alone.scene.triangles());
}

#[test]
fn chains_of_features_keep_their_features_objects_and_random_numbers() {
    let script = "local A = module('A', 'x')
        local s = lsystem { object = turtle }
        s:axiom(source { { id = 'a', z = 1 }, { id = 'b', z = 2 } }, function(feature)
            return turtle { position = { 0, 0, feature.z } }, A(0)
        end)
        s:rule('A(x)', function(_, x) return A(random()) end)
        local t = lsystem { object = turtle }
        t:axiom(s:derive(1))
        t:rule('A(x)', function(this, x) return F(x), A(this:position().z), A(random()) end)
        t:derive(1)";
    let made = run(script);
    let chains = lines(&made);
    assert!(chains[0].contains("A(1)") && chains[1].contains("A(2)"), "{chains:?}");
    let system = made.systems.last().expect("a system");
    assert_eq!(system.features, [Some("a".to_owned()), Some("b".to_owned())]);
    for (threads, batch) in [(1, 1), (2, 1)] {
        assert_eq!(lines(&run_with(script, divided(threads, batch))), chains);
    }
}

#[test]
fn random_numbers_begin_where_no_rule_has_used_them() {
    let text = |head: &str| {
        chain(&format!(
            "local A, B = module('A'), module('B', 'x')
            {head}
            t:rule('A', function() return B(random()) end)
            t:derive(1)"
        ))
    };
    let continued = text("local s, t = lsystem {}, lsystem {} s:axiom(A(), A()) t:axiom(s:derive(0))");
    assert_eq!(continued, text("local t = lsystem {} t:axiom(A(), A())"));
}

#[test]
fn a_derived_system_is_the_whole_axiom() {
    let told = error(
        "local A = module('A') local s = lsystem {} s:axiom(A()) local t = lsystem {} t:axiom(s:derive(0), A())",
    );
    assert!(told.contains("an axiom of a derived system takes nothing else"), "{told}");
}
