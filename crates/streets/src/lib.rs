//! Street networks, independent of rules and scripts: growth by proposals, faces, dead ends, and measures for
//! comparison with real networks.
//!
//! Input: proposed streets, obstacles, [`Constraints`]. Output: a planar [`StreetNetwork`] whose streets meet only at
//! junctions, and the outcome of each proposal. The crate never draws random numbers: the caller decides. A straight
//! segment of a street between two junctions is a "piece" in names.
//!
//! ```
//! use burgeon_streets::{Constraints, Fate, Obstacles, StreetAttributes, StreetNetwork};
//! use glam::DVec2;
//!
//! let mut network = StreetNetwork::new(Constraints::default(), Obstacles::default())?;
//! let street = StreetAttributes { width: 12.0, ..StreetAttributes::default() };
//! let start = network.begin(DVec2::ZERO)?;
//! network.grow(start, DVec2::new(200.0, 0.0), street)?;
//! let aside = network.begin(DVec2::new(80.0, -120.0))?;
//! let growth = network.grow(aside, DVec2::new(80.0, -10.0), street)?;
//! assert_eq!(growth.fate, Fate::Joined);
//! assert_eq!(network.at(growth.end), DVec2::new(80.0, 0.0));
//! assert_eq!((network.size(), network.dead_ends().count()), (3, 3));
//! # Ok::<(), burgeon_base::error::Error>(())
//! ```

#[cfg(test)]
mod bend_tests;
mod existing;
mod fit;
#[cfg(test)]
mod fit_tests;
mod forms;
#[cfg(test)]
mod growth_tests;
mod kinds;
mod lots;
mod marks;
mod measures;
mod placement;
mod plan;
mod shape;
#[cfg(test)]
mod sliver_tests;
mod surface;
#[cfg(test)]
mod surface_tests;
mod survey;
#[cfg(test)]
mod tests;
mod verge;

pub use existing::{ExistingLoss, ExistingLossReason, ExistingReport, ExistingStreet};
pub use fit::{SlopeOptions, StreetFit};
pub use kinds::StreetKind;
pub use lots::{BlockSide, Lot, LotOptions, LotPattern, LotUse, StreetBlock};
pub use marks::Marking;
pub use measures::Measures;
pub use placement::{SiteOptions, StreetSite, StreetSites};
pub use plan::constraints::{Constraints, Fate, Refusal};
pub use plan::dead_ends::DeadEndOptions;
pub use plan::faces::{Course, StreetFace};
pub use plan::grid::{FARTHEST, GridPlace};
pub use plan::grow::{StreetGrowth, StreetProspect};
pub use plan::network::{Junction, JunctionId, PieceId, StreetAttributes, StreetNetwork, StreetPiece};
pub use plan::obstacles::{Obstacle, Obstacles};
pub use plan::stretches::StreetStretch;
pub use shape::profile::StreetProfiles;
pub use surface::areas::StreetArea;
pub use surface::parts::{
    Median, MergedSurfaces, Sidewalk, StreetDeck, StreetFooting, StreetSurface, StreetSurfaces,
    SurfaceOptions,
};
pub use surface::spans::StreetSpan;
pub use verge::{VergeKind, VergePlace};
