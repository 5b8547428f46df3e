//! Sites next to streets as features for scripts, which can be the source of a system.

use burgeon_base::ModuleKey;
use burgeon_base::error::{Error, Result};
use burgeon_base::warning::{Warning, WarningKind, defer_warning};
use burgeon_geometry::Rings;
use burgeon_kit::{Answer, Parameter, Seed, Value, Vector, fields};
use burgeon_spatial::Geometry;
use burgeon_streets::{SiteOptions, StreetSite};
use glam::DVec3;

use super::lots::record;
use super::object::Network;

/// Options of `network:sites`.
#[fields("network:sites")]
pub struct SiteSettings {
    /// Width along the street and depth (m) of sites, by the depth of the street from 0. The last size also applies to
    /// greater depths.
    #[default(vec![Vector(DVec3::new(24.0, 20.0, 0.0)), Vector(DVec3::new(16.0, 14.0, 0.0)), Vector(DVec3::new(10.0, 10.0, 0.0))])]
    pub sizes: Vec<Vector>,
    /// Distance between candidate positions along a street (m).
    #[default(6.0)]
    pub along: f64,
    /// Distance between rows of candidate positions behind the street (m).
    #[default(18.0)]
    pub away: f64,
    /// Minimum distance from the edge of the street to a front (m).
    #[default(2.0)]
    pub setback: f64,
    /// Maximum distance from the edge of the street to a front (m).
    #[default(24.0)]
    pub distance: f64,
    /// Minimum distance (m) between sites.
    #[default(3.0)]
    pub gap: f64,
    /// Minimum remaining fraction of one side, which is shortened at random. The smallest of the sizes is not
    /// shortened.
    #[default(0.5)]
    pub shrink: f64,
    /// Seed of the random numbers, combined with the position of each street.
    #[default(Seed(0))]
    pub seed: Seed,
}

/// Sites, as records for scripts.
pub struct SiteRecords(Vec<Value>);

impl Answer for SiteRecords {
    fn luau() -> String {
        "{ { id: string, geometry: Geometry, area: number, width: number, depth: number, front: Geometry, access: Vector, \
         facing: number, row: number, street_depth: number, street_width: number } }"
            .into()
    }

    fn answer(self) -> Result<Value> {
        Ok(self.0.into_value())
    }
}

impl Network {
    pub(super) fn site_records(&self, settings: &SiteSettings) -> Result<SiteRecords> {
        let options = SiteOptions {
            sizes: settings.sizes.iter().map(|size| size.0.truncate()).collect(),
            along: settings.along,
            away: settings.away,
            distance: settings.distance,
            setback: settings.setback,
            gap: settings.gap,
            shrink: settings.shrink,
        };
        let seed = ModuleKey::seed(settings.seed.0);
        let mut stream = |name: &str| -> Box<dyn FnMut() -> f64> {
            let mut stream = seed.feature(name).stream();
            Box::new(move || stream.uniform())
        };
        let found = self.network.sites(self.surface_options(), &options, &mut stream);
        let found = found.map_err(|error| error.about("network:sites"))?;
        if found.tried == 0 {
            let text = "network:sites: the network has no streets";
            let help = "call sites after the streets have grown: system:derive(steps).objects[1]:sites()";
            defer_warning(Warning::new(WarningKind::Doubtful, text).help(help));
        } else if found.sites.is_empty() {
            let why = ["overlap a street", "are too near another site", "overlap an obstacle"];
            let why = found.refused.iter().zip(why).filter(|(count, _)| **count > 0);
            let why: Vec<String> = why.map(|(count, why)| format!("{count} {why}")).collect();
            let text = format!(
                "network:sites: no room for a site at any of {} positions: {}",
                found.tried,
                why.join(", ")
            );
            return Err(Error::argument(text).help("use smaller sizes, or a smaller setback"));
        }
        Ok(SiteRecords(found.sites.iter().map(|site| self.site_record(site)).collect()))
    }

    fn site_record(&self, site: &StreetSite) -> Value {
        let street = self.network.attributes(site.piece);
        let [a, b, ..] = site.corners.map(|corner| corner.extend(0.0));
        let ring: Vec<DVec3> = site.corners.iter().map(|corner| corner.extend(0.0)).collect();
        record([
            ("id", Value::Text(site.id.as_str().into())),
            ("geometry", Geometry::Polygon(Rings(vec![ring])).into_value()),
            ("area", Value::Number(site.size.element_product())),
            ("width", Value::Number(site.size.x)),
            ("depth", Value::Number(site.size.y)),
            ("front", Geometry::Line(vec![a, b]).into_value()),
            ("access", ((a + b) / 2.0).into_value()),
            ("facing", Value::Number(site.facing.to_angle().to_degrees())),
            ("row", Value::Number(f64::from(site.row))),
            ("street_depth", Value::Number(f64::from(street.depth))),
            ("street_width", Value::Number(street.width)),
        ])
    }
}
