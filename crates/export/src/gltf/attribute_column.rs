//! Attributes of instances that share a node.

use super::coordinates::short;
use rustc_hash::FxHashMap;

/// Maximum error (radians, 0.0036 degrees) of a rotation whose quaternion is stored as multiples of 1/32767.
const ROUNDING: f64 = 6.2e-5;

/// Maximum displacement (m) of a point by rounding a rotation.
const UNSEEN: f64 = 1e-3;

/// Values of an instance attribute, for one instance after another.
pub(super) enum AttributeColumn {
    Floats(Vec<f32>),
    /// Integers; if the flag is set, multiples of 1/32767.
    Shorts(Vec<i16>, bool),
}

impl AttributeColumn {
    /// Stores rotations of an object with the radius `reach` (m): as multiples of 1/32767 unless the error would be
    /// visible.
    pub(super) fn rotations(floats: Vec<f32>, reach: f64) -> Self {
        if reach * ROUNDING > UNSEEN {
            return Self::Floats(floats);
        }
        Self::Shorts(floats.into_iter().map(short).collect(), true)
    }

    /// Stores integers in the smallest type that fits.
    #[allow(clippy::cast_possible_truncation, reason = "bounded before")]
    pub(super) fn whole(floats: Vec<f32>) -> Self {
        if floats.iter().any(|number| *number > f32::from(i16::MAX)) {
            return Self::Floats(floats);
        }
        Self::Shorts(floats.into_iter().map(|number| number as i16).collect(), false)
    }
}

/// Features that are referred to by number.
#[derive(Default)]
pub(super) struct FeatureNumbers<'a> {
    /// Features, each once.
    pub(super) list: Vec<&'a str>,
    numbers: FxHashMap<&'a str, usize>,
}

impl<'a> FeatureNumbers<'a> {
    /// Returns the number of a feature; -1 for `None`.
    pub(super) fn number(&mut self, feature: Option<&'a str>) -> f32 {
        let Some(feature) = feature else { return -1.0 };
        let number = *self.numbers.entry(feature).or_insert_with(|| {
            self.list.push(feature);
            self.list.len() - 1
        });
        number as f32
    }
}

#[cfg(test)]
mod tests {
    use super::super::place::quaternion;
    use super::*;
    use glam::DQuat;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn a_turn_in_short_numbers_is_off_by_less_than_five_thousandths_of_a_degree(
            numbers in proptest::array::uniform4(-1.0_f64..1.0)
        ) {
            prop_assume!(DQuat::from_array(numbers).length() > 0.1);
            let meant = DQuat::from_array(numbers).normalize();
            let AttributeColumn::Shorts(shorts, true) = AttributeColumn::rotations(quaternion(meant).to_vec(), 1.0) else {
                panic!("short numbers")
            };
            let read: Vec<f64> = shorts.iter().map(|number| f64::from(*number) / 32767.0).collect();
            let off = (meant.inverse() * DQuat::from_slice(&read).normalize()).to_scaled_axis().length();
            let off = off.min(std::f64::consts::TAU - off);
            prop_assert!(off <= ROUNDING && off.to_degrees() < 0.005, "{off}");
        }
    }

    #[test]
    fn what_reaches_far_keeps_its_turn_and_what_has_a_high_number_keeps_it() {
        let turn = quaternion(DQuat::from_rotation_y(0.7)).to_vec();
        assert!(matches!(AttributeColumn::rotations(turn.clone(), 16.0), AttributeColumn::Shorts(..)));
        assert!(matches!(AttributeColumn::rotations(turn, 17.0), AttributeColumn::Floats(_)));
        assert!(
            matches!(AttributeColumn::whole(vec![-1.0, 32767.0]), AttributeColumn::Shorts(shorts, false) if shorts == [-1, 32767])
        );
        assert!(matches!(AttributeColumn::whole(vec![-1.0, 32768.0]), AttributeColumn::Floats(_)));
    }
}
