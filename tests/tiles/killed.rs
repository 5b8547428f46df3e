//! Processes that are killed at any moment, and go on.

use std::process::Stdio;
use std::time::Duration;

use crate::city::City;

#[test]
fn a_worker_that_is_killed_again_and_again_leaves_the_bytes_of_one_that_is_not() {
    let city = City::new(300);
    city.plan("whole");
    city.json(&["make", "whole"]);
    city.json(&["join", "whole"]);
    city.plan("killed");
    let (mut kills, mut rounds, mut stream) = (0, 0, 7_u64);
    loop {
        rounds += 1;
        assert!(rounds < 400, "the tiles are never complete");
        let mut worker = city
            .command(&["make", "killed", "--stale-after", "0"])
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        stream = stream.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        std::thread::sleep(Duration::from_millis(5 + (stream >> 40) % 140));
        if worker.try_wait().unwrap().is_some_and(|status| status.success()) {
            break;
        }
        worker.kill().unwrap();
        worker.wait().unwrap();
        kills += 1;
        // Later rounds need not start from the beginning.
        if kills >= 40 {
            city.json(&["make", "killed", "--stale-after", "0"]);
            break;
        }
    }
    assert!(kills > 3, "{kills}");
    city.json(&["join", "killed"]);
    city.json(&["check", "killed"]);
    city.assert_same("whole", "killed");
}

#[test]
fn a_join_of_half_of_the_tiles_is_valid_and_lists_the_others() {
    let city = City::new(200);
    city.plan("out");
    city.json(&["make", "out", "--share", "1/2"]);
    let joined = city.json(&["join", "out"]);
    let (features, missing) = (joined["features"].as_u64().unwrap(), joined["missing"].as_u64().unwrap());
    assert!(features > 50 && missing > 50 && features + missing == 200, "{joined}");
    let checked = city.json(&["check", "out"]);
    assert_eq!((checked["features"].as_u64(), checked["missing"].as_u64()), (Some(features), Some(missing)));
    let csv = std::fs::read_to_string(city.path("out/missing.csv")).unwrap();
    assert_eq!(csv.lines().count() as u64, joined["open"].as_u64().unwrap() + 1);
    assert!(csv.contains("has not been made"), "{csv}");
}
