//! Heights and bends of roofs from their storeys.

use burgeon_geometry::roof::Rise;

use super::options::Roof;

/// Maximum number of storeys in a roof.
pub(super) const MOST_LEVELS: f64 = 20.0;
/// Height (m) of a storey in a roof.
const STOREY: f64 = 3.0;
/// Slope (degrees) of a roof without height, slope and storeys.
const SLOPE: f64 = 35.0;

/// Bends at floors: a width and a height, as fractions, for each number of storeys.
type FloorBends = [[(f64, f64); 1]; 21];

static MANSARD: FloorBends = floor_bends(0.25, 0.7);
static GAMBREL: FloorBends = floor_bends(0.36, 0.64);

/// Returns the tangent of the slope of a roof.
pub(super) fn slope(options: &Roof) -> f64 {
    options.slope.unwrap_or(SLOPE).to_radians().tan()
}

/// Returns the height of a roof: as given, or from its slope, or from its storeys.
pub(super) fn rise(options: &Roof) -> Rise {
    match (options.height, options.slope, options.levels) {
        (Some(height), ..) => Rise::Height(height),
        (None, None, Some(levels)) => Rise::Height(levels * STOREY),
        _ => Rise::Slope(slope(options)),
    }
}

/// Returns the bend of a mansard or gambrel roof with two or more storeys: at the floor that is nearest to its usual height.
pub(super) fn bends_at_floors(kind: &str, levels: f64) -> Option<&'static [(f64, f64)]> {
    let table = match kind {
        "mansard" => &MANSARD,
        "gambrel" => &GAMBREL,
        _ => return None,
    };
    // Zip instead of an index, which would need a conversion.
    let storeys = (0..u32::MAX).zip(table).find(|(storeys, _)| f64::from(*storeys) > levels - 1.0)?;
    (storeys.0 >= 2).then_some(storeys.1.as_slice())
}

/// Returns the bends at the floor nearest to a height for each number of storeys, with the usual width.
const fn floor_bends(width: f64, height: f64) -> FloorBends {
    let mut bends = [[(width, height)]; 21];
    let (mut storeys, mut count) = (2, 2.0);
    while storeys < bends.len() {
        let (mut floor, mut nearest) = (1.0, 1.0);
        while floor < count {
            let (off, least) = (floor / count - height, nearest / count - height);
            if off * off < least * least {
                nearest = floor;
            }
            floor += 1.0;
        }
        bends[storeys] = [(width, nearest / count)];
        storeys += 1;
        count += 1.0;
    }
    bends
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bends_of_two_or_more_storeys_are_at_the_floor_nearest_to_the_usual_height() {
        let at = |kind: &str, levels: f64| bends_at_floors(kind, levels).map(|bends| bends[0].1);
        assert_eq!([0.5, 1.0, 1.9].map(|levels| at("mansard", levels)), [None; 3]);
        assert_eq!(
            [2.0, 2.5, 3.0, 4.0].map(|levels| at("mansard", levels)),
            [0.5, 0.5, 2.0 / 3.0, 0.75].map(Some)
        );
        assert_eq!(at("gambrel", 4.0), Some(0.75));
        assert_eq!(at("hip", 3.0), None);
    }

    #[test]
    fn storeys_give_the_height_unless_a_height_or_a_slope_does() {
        let roof = |height, slope, levels| rise(&Roof { height, slope, levels, ..Roof::default() });
        assert_eq!(roof(None, None, Some(2.0)), Rise::Height(6.0));
        assert_eq!(roof(Some(4.0), None, Some(2.0)), Rise::Height(4.0));
        assert_eq!(roof(None, Some(45.0), Some(2.0)), Rise::Slope(45f64.to_radians().tan()));
        assert_eq!(roof(None, None, None), Rise::Slope(35f64.to_radians().tan()));
    }
}
