//! The network object: its state.

use std::sync::{Arc, OnceLock};

use glam::DVec2;
use rustc_hash::FxHashMap;

use super::areas::NetworkAreas;
use super::cache::AnswerCache;
use super::existing;
use super::kinds::StreetOptions;
use super::options::NetworkOptions;
use super::proposals::ProposalTally;
use super::walk::NetworkWalk;
use burgeon_base::error::{Error, Result};
use burgeon_base::warning::Warning;
use burgeon_geometry::Polygon;
use burgeon_kit::{HasLayers, Show, Warn, object};
use burgeon_streets::{
    Constraints, ExistingLoss, JunctionId, Obstacles, StreetAttributes, StreetFit, StreetGrowth, StreetKind,
    StreetNetwork, SurfaceOptions,
};

/// A street network, grown by interpretation rules.
///
/// A proposed street is built, shortened, bent, joined to a street or junction near its end, or refused. In the next
/// step, rules read the outcome. Streets never cross without a junction, and keep their minimum distance. Streets that
/// are built remain in all later steps.
///
/// ```
/// use burgeon_kit::{Object, Vector};
/// use burgeon_objects::Network;
/// use glam::DVec3;
///
/// let mut network = Network::new(Default::default())?;
/// network.begin();
/// // A street 120 m long to the east, from junction 1 at the origin.
/// network.grow(1, 0.0, 120.0, 0)?;
/// network.end()?;
/// assert_eq!((network.outcome(1, 0.0), network.size()), ("built".to_owned(), 1));
/// assert_eq!(network.distance(Vector(DVec3::new(60.0, 9.0, 0.0))), 9.0);
/// # Ok::<(), burgeon_base::Error>(())
/// ```
#[object(
    "network",
    can(Show, HasLayers, Warn),
    options = NetworkOptions,
    example = include_str!("../../scripts/network.lua"),
    renames("lead", "1.1", "grow_to"),
    renames("stand", "1.1", "move_to"),
    renames("fate", "1.1", "outcome"),
    renames("reached", "1.1", "open_end"),
    renames("arrived", "1.1", "end_junction"),
    renames("most", "1.1", "max_segments"),
    renames("ground", "1.1", "block_color"),
    begin = restart,
    push = open_branch,
    pop = close_branch,
    end = finish,
)]
pub struct Network {
    pub(super) options: NetworkOptions,
    /// Street types, by depth.
    pub(super) kinds: Vec<StreetKind>,
    pub(super) network: StreetNetwork,
    /// Areas that bridges may cross.
    pub(super) water: Arc<[Polygon]>,
    /// Heights of the streets, with the version of the network for which they were computed.
    pub(super) fit: OnceLock<(u64, Arc<StreetFit>)>,
    /// Outcomes of the streets proposed in the last pass, by junction and heading.
    pub(super) growths: FxHashMap<(u32, u64), StreetGrowth>,
    pub(super) walk: NetworkWalk,
    /// Missing parts of existing streets.
    pub(super) omitted: Vec<ExistingLoss>,
    /// Cached results about blocks and lots.
    pub(super) answers: AnswerCache,
    pub(super) warnings: Vec<Warning>,
    /// Outcomes of all proposed streets.
    pub(super) proposals: ProposalTally,
    /// Set once a warning has reported refused streets.
    pub(super) has_warned_of_refusals: bool,
    /// Set once a warning has reported streets hidden by the ground.
    pub(super) has_warned_of_hiding: bool,
}

impl Network {
    /// Creates the network that a script specifies. Fails if its fields contradict each other.
    pub fn new(options: NetworkOptions) -> Result<Self> {
        let kinds: Vec<StreetKind> = options.streets.iter().map(StreetOptions::kind).collect();
        if kinds.is_empty() {
            return Err(Error::argument("network: streets contains no street type")
                .help("write streets = { { width = 20 }, { width = 14 } }"));
        }
        for (number, kind) in (1..).zip(&kinds) {
            kind.check().map_err(|error| error.about(&format!("network: streets: kind {number}")))?;
        }
        let named = [
            ("kerb", options.kerb, 0.0, 2.0),
            ("turning", options.turning, 0.0, 100.0),
            ("max_slope", options.max_slope, 0.1, 100.0),
        ];
        for (name, value, least, most) in named {
            if !(least..=most).contains(&value) {
                return Err(Error::argument(format!(
                    "network: {name} must be from {least} to {most}, not {value}"
                )));
            }
        }
        let constraints = Constraints {
            snap: options.snap,
            min_angle: options.min_angle,
            min_length: options.min_length,
            clearance: options.clearance,
            corner: options.corner,
            bend: options.bend,
            bridge: options.bridge,
            shorten: options.shorten,
            square_ends: options.square_ends,
            max_segments: options.max_segments as usize,
        };
        let NetworkAreas { areas, waters, mut warnings } = NetworkAreas::new(&options);
        let mut network =
            StreetNetwork::new(constraints, Obstacles::new(areas)).map_err(|error| error.about("network"))?;
        match &options.starts {
            Some(starts) => {
                for start in starts {
                    network.begin(start.0.truncate()).map_err(|error| error.about("network: starts"))?;
                }
            }
            // With existing streets, the origin is only a default start, so an obstacle there is not an error.
            None if !options.existing.is_empty() => {
                let _ = network.begin(DVec2::ZERO);
            }
            None => {
                network.begin(DVec2::ZERO).map_err(|error| error.about("network: starts"))?;
            }
        }
        let (existing, said) = existing::add(&mut network, &options.existing, &kinds)?;
        warnings.extend(said);
        Ok(Self {
            options,
            kinds,
            network,
            fit: OnceLock::new(),
            water: waters.into(),
            omitted: existing.losses,
            growths: FxHashMap::default(),
            walk: NetworkWalk::default(),
            answers: AnswerCache::default(),
            warnings,
            proposals: ProposalTally::default(),
            has_warned_of_refusals: false,
            has_warned_of_hiding: false,
        })
    }

    /// Returns the street network.
    pub fn network(&self) -> &StreetNetwork {
        &self.network
    }

    /// Converts the number of a junction, from 1, to its id. Fails if there is no such junction.
    pub(super) fn junction_id(&self, junction: u32) -> Result<JunctionId> {
        let count = self.network.junctions().len();
        match junction.checked_sub(1) {
            Some(id) if (id as usize) < count => Ok(id),
            _ => Err(Error::argument(format!("unknown junction {junction}")).help(format!(
                "junctions are numbered from 1 to {count}: network:open_end returns the junction at the end of a street"
            ))),
        }
    }

    pub(super) fn attributes(&self, depth: u32) -> StreetAttributes {
        StreetKind::of(&self.kinds, depth).attributes(depth)
    }

    pub(super) fn surface_options(&self) -> SurfaceOptions {
        SurfaceOptions { turning: self.options.turning }
    }

    /// Returns the start and the end of a street that a script proposes with `method`. Fails if the length is not above
    /// 0.
    pub(super) fn proposed_line(
        &self,
        method: &str,
        junction: u32,
        heading: f64,
        length: f64,
    ) -> Result<(JunctionId, DVec2)> {
        let from = self.junction_id(junction)?;
        if length <= 0.0 {
            return Err(Error::argument(format!(
                "network:{method}: invalid street of {length} m with the heading {heading} degrees"
            ))
            .help("use a finite heading, and a length above 0"));
        }
        Ok((from, self.network.at(from) + DVec2::from_angle(heading.to_radians()) * length))
    }
}

/// Allows other objects to take a script's network as a parameter.
impl burgeon_kit::ObjectParameter for Network {
    const LUAU: &str = "Network";
    const EXPECTED: &str = "a derived network: roads:derive().objects[1]";
}

impl std::fmt::Debug for Network {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "network of {} segments", self.network.size())
    }
}
