//! Tests of searches with a few rounds, which do not depend on time.

use super::*;

fn search(rounds: usize) -> Search {
    Search { rounds, seed: 3, ..Search::default() }
}

fn run(search: &Search, target: &Target) -> FitResult {
    search.run(target, &|| false, &mut |_| {})
}

#[test]
fn round_targets_are_fitted_in_a_few_rounds() {
    let mut errors = Vec::new();
    for name in ["hill", "ridge", "crater"] {
        let target = Target::named(name).unwrap();
        let fitted = run(&search(10), &target);
        assert!(fitted.symbols() <= 16);
        assert!((target.error(&fitted.map().unwrap()) - fitted.error()).abs() < 1e-12);
        errors.push((name, fitted.error()));
    }
    assert!(errors.iter().all(|(_, error)| *error < 0.06), "{errors:?}");
}

#[test]
fn the_seed_decides_and_threads_do_not() {
    let target = Target::named("plain").unwrap();
    let module = |threads: usize, seed: u64| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let search = Search { seed, symbols: 6, ..search(3) };
        pool.install(|| run(&search, &target)).module(&[])
    };
    let one = module(1, 5);
    assert_eq!(one, module(2, 5));
    assert_eq!(one, module(5, 5));
    assert_ne!(one, module(2, 6));
}

#[test]
fn what_a_table_can_make_is_found() {
    // A slope needs one symbol: each quadrant is the whole at half its height.
    let heights = (0..64 * 64).map(|at| f64::from(at % 64) * 2.0 - f64::from(at / 64) + 7.0).collect();
    let fitted = run(&Search { symbols: 1, ..search(2) }, &Target::new(64, heights).unwrap());
    assert!(fitted.error() < 1e-3 && fitted.symbols() == 1, "{}", fitted.error());
    let flat = Target::new(4, vec![3.0; 16]).unwrap();
    let fitted = run(&search(1), &flat);
    assert!(fitted.error() == 0.0 && fitted.map().unwrap() == flat.heights());
}

#[test]
fn a_search_that_is_stopped_gives_what_it_has() {
    let target = Target::named("hill").unwrap();
    let fitted = search(9).run(&target, &|| true, &mut |_| {});
    assert!(fitted.error() < 1.0 && fitted.tried == 0);
}

#[test]
fn maps_of_another_size_are_averaged_or_stretched() {
    let heights: Vec<f64> = (0..6 * 4).map(|at| f64::from(at % 6)).collect();
    let small = Target::resample(6, 4, &heights, 2).unwrap();
    assert!(small.heights().iter().zip([1.0, 4.0, 1.0, 4.0]).all(|(a, b)| (a - b).abs() < 1e-12));
    let large = Target::resample(2, 2, &[0.0, 4.0, 0.0, 4.0], 4).unwrap();
    assert_eq!(large.heights()[..4], [0.0, 1.0, 3.0, 4.0]);
    let same: Vec<f64> = (0..16).map(f64::from).collect();
    assert_eq!(Target::resample(4, 4, &same, 4).unwrap().heights(), same);
}

#[test]
fn what_is_no_height_map_is_refused() {
    let told = |target: burgeon_base::error::Result<Target>| {
        let error = target.unwrap_err();
        assert!(error.remedy().is_some());
        error.message().to_owned()
    };
    assert_eq!(
        told(Target::new(3, vec![0.0; 9])),
        "a target of 3 cells across cannot be divided into quadrants"
    );
    assert_eq!(told(Target::new(2, vec![0.0; 3])), "3 heights do not fill a target of 2 cells across");
    assert_eq!(told(Target::new(2, vec![f64::NAN; 4])), "a target has a height that is not finite");
    assert_eq!(told(Target::resample(2, 3, &[0.0; 5], 2)), "5 heights are not 2 columns and 3 rows");
    assert_eq!(told(Target::named("hil")), "unknown target `hil`");
    assert_eq!(
        told(Target::resample(1, 1, &[0.0], 0)),
        "a target of 0 cells across cannot be divided into quadrants"
    );
}
