//! Known results that scripts check with `expect`.

use burgeon::script::RunOptions;

use super::scripts::{error, run, try_run};

const ALGAE: &str = "local A, B = module('A'), module('B')
    local size = param('size', { default = 7 })
    local s = lsystem {}
    s:axiom(B())
    s:rule('A', function() return A(), B() end)
    s:rule('B', function() return A() end)
    local derived = s:derive(size)
    ";

#[test]
fn a_result_equals_its_expectation() {
    for expectation in [
        "expect(derived.counts.A, 13)",
        "expect(derived.counts, { A = 13, B = 8 })",
        "expect(derived.counts.F, 0)",
        "expect(0.1 + 0.2, 0.3, 1e-12)",
        "expect({ 1, { 2.01, 'a' } }, { 1, { 2, 'a' } }, 0.1)",
    ] {
        run(&format!("{ALGAE}{expectation}"));
    }
}

#[test]
fn a_difference_from_the_expectation_is_an_error_with_its_path() {
    let said = |expectation: &str| error(&format!("{ALGAE}{expectation}"));
    assert!(said("expect(derived.counts.A, 12)").contains("expected 12, but the result is 13"));
    assert!(said("expect(derived.counts, { A = 13, B = 9 })").contains("B: expected 9, but the result is 8"));
    assert!(said("expect({ 1, { 2.2, 'a' } }, { 1, { 2, 'a' } }, 0.1)").contains("[2].[1]: expected 2"));
    assert!(said("expect({ 1, 2, 3 }, { 1, 2 })").contains("a list of 2 values"));
    assert!(said("expect(nil, 1)").contains("the result is nil"));
    assert!(said("expect(1)").contains("the expected value is missing"));
    assert!(said("expect(1, 1, -1)").contains("tolerance must be a number of at least 0"));
    assert!(said("expect(1, 1, 'a')").contains("tolerance"));
}

#[test]
fn a_run_with_other_values_checks_no_expectation() {
    let script = format!("{ALGAE}expect(derived.counts.A, 0)");
    assert!(try_run(&script, burgeon::options()).is_err());
    let mut with_size = burgeon::options();
    with_size.params = vec![("size".to_owned(), "3".to_owned())].into();
    for options in [
        with_size,
        RunOptions { seed: 1, ..burgeon::options() },
        RunOptions { steps: Some(3), ..burgeon::options() },
        RunOptions { check: true, ..burgeon::options() },
    ] {
        assert!(try_run(&script, options).is_ok());
    }
}
