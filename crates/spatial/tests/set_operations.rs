//! Tests hundreds of cases of each family; `cargo bench -p burgeon-sources --bench overlay` tests a hundred
//! thousand.

mod families;

use families::{Dice, FAMILIES, PLACES};

#[test]
fn set_operations_give_valid_areas_of_the_right_size() {
    for (number, (name, check)) in FAMILIES.into_iter().enumerate() {
        let cases = if name == "nearly equal polygons" { 3 } else { 200 };
        for (place, origin) in PLACES {
            let mut dice = Dice(number as u64);
            let wrong: Vec<String> = (0..cases).filter_map(|_| check(&mut dice, origin)).collect();
            assert!(wrong.is_empty(), "{name}, {place}: {} of {cases}: {}", wrong.len(), wrong[0]);
        }
    }
}
