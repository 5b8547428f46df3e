use burgeon_rewriting::ClosureSystem;
fn main() {
    let mut s = ClosureSystem::new(0);
    let a = s.module("A", &[]).unwrap();
    s.rule_with_propensity(
        "A",
        |_| 1.0,
        move |_, out| {
            out.push(a, &[]);
            out.push(a, &[]);
        },
    )
    .unwrap();
    for n in [10_000, 20_000, 40_000, 80_000] {
        let chain = s.chain(|out| out.push(a, &[])).unwrap();
        let t = std::time::Instant::now();
        let chain = s.derive(chain, n).unwrap();
        println!("{n}: {:?} {}", t.elapsed() / n as u32, chain.modules());
    }
}
