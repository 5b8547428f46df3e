//! Detection of heights that mark missing values although the file does not declare them.

use crate::heights::marks::MARKS;
use burgeon_base::error::{Error, Result};

/// Range of heights on Earth (m), with a margin: the deepest trench is at -10,935, the highest summit at 8,849.
const OF_EARTH: [f32; 2] = [-11_500.0, 9_000.0];
/// Maximum absolute height (m) on any planet.
const HIGHEST: f32 = 100_000.0;
/// Distance (m) to another height within which a marker value counts as a real height.
const NEAR: f32 = 500.0;
/// Absolute value from which a number is a marker of programs that use floats, such as -3.4e38.
const HUGE: f32 = 1e30;

/// Maximum number of distinct marker values that are recorded.
const MOST: usize = 3;

/// Heights that were treated as markers of missing values.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct UndeclaredMarks {
    /// Number of heights.
    pub count: usize,
    /// First distinct values.
    pub values: Vec<f32>,
}

impl UndeclaredMarks {
    fn add(&mut self, value: f32) {
        self.count += 1;
        // Bitwise comparison suffices, because no value is NaN.
        let is_new = !self.values.iter().any(|known| known.to_bits() == value.to_bits());
        if is_new && self.values.len() < MOST {
            self.values.push(value);
        }
    }

    /// Adds the markers of another file.
    pub(super) fn join(&mut self, other: Self) {
        let count = self.count + other.count;
        other.values.into_iter().for_each(|value| self.add(value));
        self.count = count;
    }

    /// Formats the values for messages.
    pub(super) fn text(&self) -> String {
        let text = |value: &f32| if value.abs() < HUGE { value.to_string() } else { format!("{value:e}") };
        let values: Vec<String> = self.values.iter().map(text).collect();
        values.join(" or ")
    }
}

/// Replaces marker values by NaN, in a file with `columns` columns. `is_of_earth` states that the file has a coordinate
/// system of the Earth, `is_told` that the lowest and highest heights were given.
///
/// Fails if no heights remain, or if most heights are outside the possible range.
pub(super) fn take_out(
    name: &str,
    columns: usize,
    heights: &mut [f32],
    is_of_earth: bool,
    is_told: bool,
) -> Result<UndeclaredMarks> {
    let [low, high] = if is_of_earth && !is_told { OF_EARTH } else { [-HIGHEST, HIGHEST] };
    let possible = |height: f32| (low..=high).contains(&height);
    // A marker value is a marker unless other heights are close to it.
    let mut is_mark = MARKS.map(|mark| possible(mark) && !is_told);
    for height in &*heights {
        for (mark, is_mark) in MARKS.iter().zip(&mut is_mark) {
            let distance = (height - mark).abs();
            *is_mark &= !(distance > 0.0 && distance <= NEAR);
        }
    }
    let marks_missing = |height: f32| {
        let mut marks = MARKS.iter().zip(&is_mark);
        marks.any(|(mark, is_mark)| *is_mark && mark.to_bits() == height.to_bits())
    };
    let (mut found, mut beyond, mut known) = (UndeclaredMarks::default(), None, 0);
    for (index, height) in heights.iter_mut().enumerate() {
        if height.is_nan() {
            continue;
        }
        if possible(*height) && !marks_missing(*height) {
            known += 1;
            continue;
        }
        if !possible(*height) && height.abs() < HUGE && !MARKS.contains(height) {
            beyond.get_or_insert((*height, index));
        }
        found.add(*height);
        *height = f32::NAN;
    }
    if let (Some((height, index)), true) = (beyond, found.count > known) {
        let (row, column) = (index / columns + 1, index % columns + 1);
        let most = format!(
            "{name} has a height of {height} m in row {row}, column {column}, and most of its heights"
        );
        return Err(Error::data(format!("{most} are outside {low} to {high} m"))
            .help("if they are in another unit, convert them to metres: gdal_calc.py --calc=A*0.001"));
    }
    if known == 0 {
        return Err(Error::data(format!("{name} contains no data: all its heights are missing"))
            .help("download another part, or open it in a map viewer"));
    }
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn taken(heights: &[f32], is_of_earth: bool) -> (usize, Vec<f32>) {
        let mut heights = heights.to_vec();
        let found = take_out("a", 3, &mut heights, is_of_earth, false).unwrap();
        assert_eq!(heights.iter().filter(|height| height.is_nan()).count(), found.count);
        (found.count, found.values)
    }

    #[test]
    fn marks_and_heights_beyond_the_earth_are_missing() {
        for mark in [
            32767.0,
            -9999.0,
            -32768.0,
            -32767.0,
            65535.0,
            -99999.0,
            9_500.0,
            -12_000.0,
            1e6,
            -3.4e38,
            f32::INFINITY,
        ] {
            assert_eq!(taken(&[100.0, mark, 300.0, mark, 8848.0], true), (2, vec![mark]), "{mark}");
        }
        // Such heights may occur on another planet.
        assert_eq!(taken(&[100.0, 9_500.0, 21_000.0], false), (0, vec![]));
        assert_eq!(taken(&[100.0, -9999.0, 200_000.0, 7.0], false), (2, vec![-9999.0, 200_000.0]));
    }

    #[test]
    fn what_other_heights_lead_up_to_is_no_mark() {
        assert_eq!(taken(&[-9990.0, -9999.0, -10_012.0, -9_600.0], true), (0, vec![]));
        assert_eq!(taken(&[-8000.0, -9999.0, -100.0], true), (1, vec![-9999.0]));
    }

    #[test]
    fn heights_in_another_unit_are_refused() {
        let mut heights = [125_000.0, 126_000.0, 90.0];
        let error = take_out("a.tif", 2, &mut heights, true, false).unwrap_err();
        assert!(error.message().starts_with("a.tif has a height of 125000 m in row 1, column 1"), "{error}");
        let error = take_out("a.tif", 2, &mut [-9999.0; 4], true, false).unwrap_err();
        assert_eq!(error.message(), "a.tif contains no data: all its heights are missing");
    }

    #[test]
    fn told_heights_stay() {
        let mut heights = [32767.0, 0.0, 65535.0];
        assert_eq!(take_out("a.png", 3, &mut heights, true, true).unwrap(), UndeclaredMarks::default());
    }
}
