//! Street types: cross-sections in metres.

use burgeon_base::error::{Error, Result};

use crate::plan::network::StreetAttributes;

/// Minimum width (m) of a lane.
const LEAST_LANE: f64 = 2.0;
/// Maximum width (m) of a carriageway that has one lane by default.
const ONE_LANE: f64 = 4.6;
/// Width (m) of a lane when the number of lanes is chosen automatically.
const USUAL_LANE: f64 = 3.2;
/// Minimum width (m) of a sidewalk with trees or lamps.
const LEAST_VERGE: f64 = 1.0;

/// Street type: a cross-section and the objects along it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StreetKind {
    /// Width (m) between the outer edges of the sidewalks.
    pub width: f64,
    /// Width (m) of the sidewalk on each side.
    pub sidewalk: f64,
    /// Number of lanes in both directions; by default, as many as fit.
    pub lanes: Option<u32>,
    /// Width (m) of the raised median; 0 for none.
    pub median: f64,
    /// Width (m) of the parking strip on each side; 0 for none.
    pub parking: f64,
    /// Distance (m) between trees along each side; 0 for none.
    pub trees: f64,
    /// Distance (m) between lamps along each side; 0 for none.
    pub lamps: f64,
}

impl Default for StreetKind {
    fn default() -> Self {
        Self { width: 12.0, sidewalk: 2.5, lanes: None, median: 0.0, parking: 0.0, trees: 0.0, lamps: 0.0 }
    }
}

impl StreetKind {
    /// Returns the type for streets of a depth; the last type also applies to all greater depths.
    ///
    /// ```
    /// use burgeon_streets::StreetKind;
    ///
    /// let kinds = [30.0, 12.0].map(|width| StreetKind { width, ..StreetKind::default() });
    /// assert_eq!([0, 1, 5].map(|depth| StreetKind::of(&kinds, depth).width), [30.0, 12.0, 12.0]);
    /// ```
    pub fn of(kinds: &[Self], depth: u32) -> Self {
        let last = kinds.len().saturating_sub(1);
        kinds.get((depth as usize).min(last)).copied().unwrap_or_default()
    }

    /// Returns the attributes of streets of this type.
    pub fn attributes(&self, depth: u32) -> StreetAttributes {
        let Self { width, sidewalk, median, .. } = *self;
        StreetAttributes { width, sidewalk, median, lanes: 0, depth, level: 0 }
    }

    /// Returns the type adapted to a street's attributes: the attributes of the street take precedence, and parts that
    /// then do not fit are removed.
    #[must_use]
    pub fn adapt_to(self, attributes: StreetAttributes) -> Self {
        let StreetAttributes { width, sidewalk, median, lanes, .. } = attributes;
        if (self.width, self.sidewalk, self.median, 0) == (width, sidewalk, median, lanes) {
            return self;
        }
        let lanes = if lanes > 0 { Some(lanes) } else { self.lanes };
        let has_room = |kind: &Self| kind.check().is_ok();
        let set = Self { width, sidewalk, median, lanes, ..self };
        let mut choices = [
            set,
            Self { parking: 0.0, ..set },
            Self { trees: 0.0, lamps: 0.0, ..set },
            Self { parking: 0.0, trees: 0.0, lamps: 0.0, ..set },
            Self { parking: 0.0, trees: 0.0, lamps: 0.0, lanes: None, ..set },
            Self { parking: 0.0, trees: 0.0, lamps: 0.0, lanes: None, median: 0.0, ..set },
        ]
        .into_iter();
        choices.find(has_room).unwrap_or(Self {
            width,
            sidewalk,
            parking: 0.0,
            median: 0.0,
            lanes: Some(1),
            trees: 0.0,
            lamps: 0.0,
        })
    }

    /// Returns the width (m) between the kerbs.
    pub fn carriageway(&self) -> f64 {
        self.width - 2.0 * self.sidewalk
    }

    /// Returns the total width (m) of the lanes.
    fn driven_width(&self) -> f64 {
        self.carriageway() - self.median - 2.0 * self.parking
    }

    /// Returns the number of lanes in both directions.
    ///
    /// ```
    /// use burgeon_streets::StreetKind;
    ///
    /// let street = StreetKind { width: 20.0, sidewalk: 3.0, parking: 0.0, ..StreetKind::default() };
    /// assert_eq!((street.carriageway(), street.lanes()), (14.0, 4));
    /// let with_parking = StreetKind { parking: 2.0, ..street };
    /// assert_eq!(with_parking.lanes(), 2);
    /// ```
    pub fn lanes(&self) -> u32 {
        self.lanes.unwrap_or_else(|| {
            let driven = self.driven_width();
            if driven < ONE_LANE && self.median == 0.0 {
                return 1;
            }
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most some dozens")]
            let pairs = (driven / 2.0 / USUAL_LANE).floor() as u32;
            2 * pairs.max(1)
        })
    }

    /// Checks that the parts fit into the width; the error names the field.
    pub fn check(&self) -> Result<()> {
        let named = [
            ("width", self.width, 2.0, 200.0),
            ("sidewalk", self.sidewalk, 0.0, 50.0),
            ("median", self.median, 0.0, 100.0),
            ("parking", self.parking, 0.0, 20.0),
        ];
        for (name, value, least, most) in named {
            if !(least..=most).contains(&value) {
                return Err(Error::argument(format!("{name} must be from {least} to {most} m, not {value}")));
            }
        }
        for (name, value) in [("trees", self.trees), ("lamps", self.lamps)] {
            if value != 0.0 && !(1.0..=1000.0).contains(&value) {
                return Err(Error::argument(format!("{name} must be from 1 to 1000 m, not {value}"))
                    .help("it is the distance between them along the street; 0 for none"));
            }
            if value > 0.0 && self.sidewalk < LEAST_VERGE {
                return Err(Error::argument(format!(
                    "{name} need a sidewalk of {LEAST_VERGE} m, not {} m",
                    self.sidewalk
                ))
                .help("use a wider sidewalk, or set them to 0"));
            }
        }
        let Self { width, sidewalk, median, parking, .. } = *self;
        let carriageway = self.carriageway();
        if carriageway < LEAST_LANE {
            return Err(Error::argument(format!(
                "sidewalk = {sidewalk} on both sides leaves {carriageway:.2} m of width = {width} for the carriageway"
            ))
            .help(format!("leave at least {LEAST_LANE} m between the sidewalks")));
        }
        if self.median > 0.0 && self.median > carriageway - 2.0 * LEAST_LANE {
            return Err(Error::argument(format!(
                "median = {median} does not fit into a carriageway of {carriageway:.2} m"
            ))
            .help(format!("leave at least {LEAST_LANE} m for a lane on each side of it")));
        }
        let driven = self.driven_width();
        if driven < LEAST_LANE {
            return Err(Error::argument(format!(
                "parking = {parking} on both sides leaves {driven:.2} m of a carriageway of {carriageway:.2} m"
            ))
            .help(format!("leave at least {LEAST_LANE} m between the parking strips")));
        }
        if self.lanes == Some(0) || self.lanes.is_some_and(|lanes| lanes > 24) {
            return Err(Error::argument(format!("lanes must be from 1 to 24, not {}", self.lanes())));
        }
        if self.median > 0.0 && self.lanes() % 2 == 1 {
            return Err(Error::argument(format!(
                "with a median, lanes = {} cannot be divided into two directions",
                self.lanes()
            ))
            .help("use an even number of lanes, or remove the median"));
        }
        let lane = driven / f64::from(self.lanes());
        if lane < LEAST_LANE - 1e-9 {
            let most = (driven / LEAST_LANE + 1e-9).floor();
            return Err(Error::argument(format!(
                "lanes = {} does not fit: {driven:.2} m remains for the lanes, {lane:.2} m for each",
                self.lanes()
            ))
            .help(format!("{most} fit, each at least {LEAST_LANE} m wide")));
        }
        Ok(())
    }

    /// Returns the painted lines along a street.
    pub(crate) fn lines(&self) -> Vec<LaneLine> {
        let mut lines = Vec::new();
        let mut line =
            |aside: f64, width: f64, dash: Option<[f64; 2]>| lines.push(LaneLine { aside, width, dash });
        let curb = self.carriageway() / 2.0 - self.parking;
        let lanes = self.lanes();
        let wide = self.driven_width() / f64::from(lanes);
        let middle = lanes.div_ceil(2);
        for boundary in 1..lanes {
            let at = -curb + wide * f64::from(boundary) + if boundary > middle { self.median } else { 0.0 };
            match boundary {
                _ if boundary != middle => line(at, 0.12, Some([3.0, 6.0])),
                _ if self.median > 0.0 => {}
                _ if lanes == 2 => line(at, 0.12, Some([3.0, 3.0])),
                _ => [-0.13, 0.13].into_iter().for_each(|aside| line(at + aside, 0.12, None)),
            }
        }
        for side in [-1.0, 1.0] {
            if self.median > 0.0 {
                line(side * (self.median / 2.0 + 0.3), 0.12, None);
            }
            if self.parking > 0.0 {
                line(side * curb, 0.1, None);
            } else if lanes > 2 {
                line(side * (curb - 0.35), 0.12, None);
            }
        }
        lines
    }

    /// Returns the distances (m) to the left of the centreline at which the lanes of oncoming traffic begin and end.
    pub(crate) fn left_lanes(&self) -> [f64; 2] {
        let curb = self.carriageway() / 2.0 - self.parking;
        let lanes = self.lanes();
        let wide = self.driven_width() / f64::from(lanes);
        // With an odd number of lanes, the larger part is on the right, in the outgoing direction.
        let begin = if self.median > 0.0 { self.median / 2.0 } else { curb - wide * f64::from(lanes / 2) };
        [begin, curb]
    }
}

/// Painted line along a street.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct LaneLine {
    /// Distance (m) to the left of the centreline.
    pub(crate) aside: f64,
    /// Width (m).
    pub(crate) width: f64,
    /// Lengths (m) of dashes and gaps; `None` for a solid line.
    pub(crate) dash: Option<[f64; 2]>,
}
