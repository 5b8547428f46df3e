//! Steps that change little of a long chain: the results are the same as if each step rewrote the whole chain.

use burgeon::Run;
use burgeon::export::gltf;
use proptest::collection::vec;
use proptest::prelude::*;

use super::scripts::{all_chains, divided, run_with};

/// Comment that names a function through which rules could observe each step, so that each step rewrites the whole chain.
const OBSERVED: &str = "-- print\n";

const HEAD: &str = r#"local F, G, A, B, S = module("F", "x"), module("G"), module("A", "n"), module("B", "n"), module("S", "text")
local s = lsystem({ object = turtle({ sides = 3 }), seed = 4 })
s:interpret("F(x)", function(this, x) this:turn(x * 7):forward(0.1) end)
s:interpret("S(text)", function(this, text) this:roll(#text):forward(0.2) end)
"#;

fn item() -> impl Strategy<Value = String> {
    let module = || {
        prop_oneof![
            4 => Just("F(n % 5)"),
            1 => Just("F(random())"),
            1 => Just("G()"),
            3 => Just("A(n + 1)"),
            1 => Just("B(n + 1)"),
            1 => Just("S(`{n % 3}`)"),
            1 => Just("S({ n, 2 })"),
            1 => Just("Cut()"),
        ]
    };
    prop_oneof![
        5 => module().prop_map(str::to_owned),
        1 => vec(module(), 1..3).prop_map(|inner| format!("{{ {} }}", inner.join(", ")))
    ]
}

fn rule() -> impl Strategy<Value = String> {
    let pattern = prop_oneof![
        4 => Just("A(n)"),
        2 => Just("B(n)"),
        1 => Just("F(x) < A(n)"),
        1 => Just("G < B(n)"),
        1 => Just("A(n) > G"),
        1 => Just("B(n) > F(x) $"),
        1 => Just("G < F(n) > A(x)"),
    ];
    let options = prop_oneof![
        4 => Just(""),
        1 => Just("{ weight = 2 }, "),
        2 => Just("{ when = function(_, n) return n % 3 ~= 1 end }, "),
        1 => Just("{ when = function(_, n) return n < 4 end }, "),
    ];
    (pattern, options, vec(item(), 0..3)).prop_map(|(pattern, options, items)| {
        let formals = if pattern.starts_with("F(x) <") { "_, x, n" } else { "_, n" };
        let options = options.replace("_, n", formals);
        let made = if items.is_empty() { "nil".to_owned() } else { items.join(", ") };
        format!("s:rule(\"{pattern}\", {options}function({formals}) return {made} end)\n")
    })
}

fn axiom() -> impl Strategy<Value = String> {
    let item = prop_oneof![
        12 => Just("F(1)"),
        2 => Just("G()"),
        1 => Just("A(0)"),
        1 => Just("B(2)"),
        1 => Just("{ F(2), A(1) }"),
        1 => Just("{ G(), { F(2), F(3), F(4) }, F(5) }"),
    ];
    vec(item, 20..60).prop_map(|items| items.join(", "))
}

fn derive(script: &str, batch: usize) -> Run {
    run_with(script, divided(1, batch))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn long_chains_that_change_little_derive_as_all_chains_do(
        axioms in vec(axiom(), 1..3),
        rules in vec(rule(), 1..4),
        of_regions in vec(rule(), 0..3),
        steps in 3_usize..12,
        batch in 1_usize..4,
    ) {
        let regions = if of_regions.is_empty() { String::new() } else {
            let rules = of_regions.concat().replace("s:rule", "r:rule");
            format!("local r = lsystem({{ object = turtle() }})\ns:subsystem(\"G\", r)\n{rules}")
        };
        let axiom = match axioms.as_slice() {
            [axiom] => format!("s:axiom({axiom})\n"),
            several => format!(
                "local axioms = {{ function() return {} end }}\n\
                 s:axiom(source({{ 1, 2 }}), function(number) return axioms[number]() end)\n",
                several.join(" end, function() return ")
            ),
        };
        let script = format!("{HEAD}{axiom}{}{regions}s:derive({steps})\n", rules.concat());
        let (sparse, whole) = (derive(&script, batch), derive(&(OBSERVED.to_owned() + &script), 4096));
        prop_assert_eq!(all_chains(&sparse), all_chains(&whole), "{}", script);
        prop_assert_eq!(sparse.systems[0].steps, whole.systems[0].steps);
        prop_assert_eq!(gltf::glb(&sparse.scene).unwrap(), gltf::glb(&whole.scene).unwrap());
        let applied = |run: &Run| -> Vec<_> {
            run.systems[0].rules.iter().map(|rule| (rule.done.applied, rule.done.made)).collect()
        };
        prop_assert_eq!(applied(&sparse), applied(&whole));
        prop_assert_eq!(sparse.systems[0].times.read, whole.systems[0].times.read);
    }
}

#[test]
fn texts_and_tables_of_many_steps_do_not_accumulate() {
    let script = |head: &str| {
        format!(
            "{head}local F, A = module('F'), module('A', 'list')
            local s = lsystem({{}})
            local begin = {{}}
            for i = 1, 5000 do begin[i] = F() end
            begin[2500] = A({{ 1 }})
            s:axiom(sequence(begin))
            s:rule('A(list)', function(_, list) return A({{ list[1] + 1 }}) end)
            s:derive(40000)\n"
        )
    };
    let run = run_with(&script(""), divided(1, 4096));
    let text = all_chains(&run);
    assert!(text.contains("A({40001})"), "{}", &text[5000..5100.min(text.len())]);
}
