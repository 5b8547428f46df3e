//! Blocks and lots as features for scripts, which can be the source of a system.

use std::sync::Arc;

use burgeon_base::MemoryOwner;
use burgeon_base::ModuleKey;
use burgeon_base::Stop;
use burgeon_base::error::{Error, Result};
use burgeon_base::text::listed;
use burgeon_base::warning::{Warning, WarningKind};
use burgeon_geometry::Rings;
use burgeon_geometry::planar::twice_area;
use burgeon_kit::{Answer, Expectation, Parameter, Seed, Table, TableKey, Value, fields};
use burgeon_spatial::{Geometry, PolygonArgument};
use burgeon_streets::{FARTHEST, Lot, LotOptions, LotPattern, LotUse, PieceId, StreetBlock, StreetNetwork};
use glam::DVec2;
use rayon::prelude::*;

use super::cache::AnswerKey;
use super::object::Network;
use super::overlaps::overlapping;

/// Distance (m) of terraces inside the borders of their lots.
const JOINT: f64 = 0.02;

/// Options of `network:lots`.
#[fields("network:lots")]
pub struct LotSettings {
    /// Method of division: "boxes", by repeated cuts across the block; "strips", along the streets around a court; or
    /// "skeleton", along the streets without a court.
    #[default("boxes".into())]
    pub kind: String,
    /// Typical width (m) of lots along the street.
    #[default(18.0)]
    pub width: f64,
    /// Typical depth (m) of lots behind the street.
    #[default(28.0)]
    pub depth: f64,
    /// Minimum front (m) of a lot. If omitted, half of the width.
    pub min_width: Option<f64>,
    /// Area (m²) above which a lot is divided. If omitted, 1.4 times the width times the depth.
    pub area: Option<f64>,
    /// Minimum area (m²). If omitted, 0.3 times the width times the depth.
    pub min_area: Option<f64>,
    /// Maximum ratio of a lot's length to its width.
    #[default(4.0)]
    pub elongation: f64,
    /// Variation of sizes, from 0 (none) to 1.
    #[default(0.3)]
    pub jitter: f64,
    /// Fraction of the blocks that are parks, from 0 to 1.
    #[default(0.0)]
    pub parks: f64,
    /// Areas to divide: blocks of network:blocks(), features or polygons. If omitted, all blocks of the network.
    pub blocks: Option<Vec<BlockArea>>,
    /// Maximum distance (m) from a street at which an edge of such an area is on the street. Without streets, all edges
    /// are on a street.
    #[default(6.0)]
    pub reach: f64,
    /// Depth (m) of a terrace of adjoining buildings behind its fronts. If given, each building lot has a list of
    /// polygons, terrace: the parts of the lot up to this depth, 2 cm inside its border.
    pub terrace: Option<f64>,
    /// Include parks, courts and areas that are too small for a building.
    #[default(false)]
    pub all: bool,
    /// Seed of the random numbers, combined with the id of each block.
    #[default(Seed(0))]
    pub seed: Seed,
}

/// An area to divide: a polygon, and its id if it is a feature.
#[derive(Debug, Clone)]
pub struct BlockArea {
    id: Option<String>,
    rings: Rings,
}

impl Parameter for BlockArea {
    fn luau() -> String {
        "Geometry | { [string]: any }".into()
    }

    fn from_value(value: Value) -> Result<Self, Expectation> {
        if let Value::Table(table) = &value
            && let Some(geometry) = table.get("geometry")
        {
            let id = match table.get("id") {
                Some(Value::Text(id)) => Some(id.to_string()),
                Some(Value::Number(id)) => Some(Value::Number(*id).to_string()),
                _ => None,
            };
            return Ok(Self { id, rings: PolygonArgument::read_value(geometry)?.0 });
        }
        Ok(Self { id: None, rings: PolygonArgument::from_value(value)?.0 })
    }

    fn into_value(self) -> Value {
        let id = self.id.map_or(Value::Nil, |id| Value::Text(id.into()));
        record([("id", id), ("geometry", polygon(&self.rings.flat()))])
    }
}

/// Blocks, as records for scripts.
pub struct BlockRecords(Value);

impl Answer for BlockRecords {
    fn luau() -> String {
        "{ { id: string, geometry: Geometry, area: number, street_depth: number? } }".into()
    }

    fn answer(self) -> Result<Value> {
        Ok(self.0)
    }
}

/// Lots, as records for scripts.
pub struct LotRecords(Value);

impl Answer for LotRecords {
    fn luau() -> String {
        "{ { id: string, geometry: Geometry, use: string, area: number, width: number, depth: number, front: Geometry, \
         fronts: { Geometry }, front_length: number, corner: boolean, access: Vector, facing: number, block: string, \
         street_depth: number?, street_width: number?, terrace: { Geometry }? } }"
            .into()
    }

    fn answer(self) -> Result<Value> {
        Ok(self.0)
    }
}

/// The lots and blocks that are left out for other reasons than lack of room.
#[derive(Default)]
struct Omissions {
    /// Number of lots that are not building lots only because their ratio of length to width is too large.
    long: usize,
    longest: f64,
    /// Number of lots that are not building lots only because an obstacle reaches into them.
    blocked: usize,
    /// Number of blocks that cannot be divided.
    undivided: usize,
    /// Number of blocks that are parks.
    parks: usize,
}

impl Omissions {
    fn count(&mut self, lot: &Lot, options: &LotOptions) {
        let is_wide = lot.front_length >= options.min_width && lot.area >= options.min_area;
        match lot.purpose {
            LotUse::Rest if is_wide && lot.elongation > options.elongation => {
                self.long += 1;
                self.longest = self.longest.max(lot.elongation);
            }
            LotUse::Blocked => self.blocked += 1,
            LotUse::Park => self.parks += 1,
            _ => {}
        }
    }

    fn add(&mut self, other: &Self) {
        self.long += other.long;
        self.longest = self.longest.max(other.longest);
        self.blocked += other.blocked;
        self.undivided += other.undivided;
        self.parks += other.parks;
    }

    /// Returns the warnings about lots that are only returned if the script sets `all`.
    fn lots(&self, options: &LotOptions) -> Vec<Warning> {
        let lots = |count: usize| format!("{count} lot{}", if count == 1 { "" } else { "s" });
        let mut told = Vec::new();
        if self.long > 0 {
            let text = format!(
                "network:lots: skipped {} more than {} times as long as wide, up to {:.1} times",
                lots(self.long),
                options.elongation,
                self.longest
            );
            let help = "set a greater elongation, or all = true to return them as lots with the use \"rest\"";
            told.push(Warning::new(WarningKind::Doubtful, text).help(help));
        }
        if self.blocked > 0 {
            let text =
                format!("network:lots: skipped {} that overlap an obstacle or water", lots(self.blocked));
            let help = "set all = true to return them as lots with the use \"blocked\", or cut the obstacle out of the blocks: block.geometry:difference(water:buffer(0.1))";
            told.push(Warning::new(WarningKind::Doubtful, text).help(help));
        }
        told
    }

    /// Returns the warning about blocks, `count` in total, that never give any lots.
    fn blocks(&self, count: usize) -> Option<Warning> {
        (self.undivided > 0).then(|| {
            let text = format!(
                "network:lots: skipped {} of {count} block{}: they have no area inside their borders, or are more than {:.0} km from the origin",
                self.undivided,
                if count == 1 { "" } else { "s" },
                FARTHEST / 1000.0
            );
            Warning::new(WarningKind::Doubtful, text).help("give polygons with an area, near the origin")
        })
    }
}

impl LotSettings {
    /// Returns the cache key: all values that the lots depend on, as numbers.
    fn key(&self, version: u64, options: &LotOptions) -> AnswerKey {
        let LotOptions { pattern, width, min_width, depth, area, min_area, elongation, jitter, parks } =
            *options;
        let kind = LotPattern::ALL.iter().position(|(_, known)| *known == pattern).unwrap_or_default();
        let mut key =
            vec![version, kind as u64, u64::from(self.all), self.seed.0, self.blocks.is_some().into()];
        let terrace = self.terrace.unwrap_or(-1.0);
        let sizes = [width, min_width, depth, area, min_area, elongation, jitter, parks, self.reach, terrace];
        key.extend(sizes.map(f64::to_bits));
        for area in self.blocks.iter().flatten() {
            let id = area.id.as_deref().unwrap_or_default();
            key.push(id.len() as u64 + u64::from(area.id.is_some()));
            key.extend(id.bytes().map(u64::from));
            for ring in area.rings.iter() {
                key.push(ring.len() as u64);
                key.extend(ring.iter().flat_map(|at| [at.x.to_bits(), at.y.to_bits()]));
            }
        }
        key
    }

    fn options(&self) -> Result<LotOptions> {
        let known = LotPattern::ALL.iter().find(|(name, _)| *name == self.kind);
        let Some((_, pattern)) = known else {
            let names = || LotPattern::ALL.iter().map(|(name, _)| *name);
            let message = format!("unknown kind of lots {:?}", self.kind);
            return Err(Error::not_found("kind", &self.kind, names(), message)
                .help(format!("use one of {}", listed(names()))));
        };
        let usual = LotOptions::new(self.width, self.depth);
        let options = LotOptions {
            pattern: *pattern,
            min_width: self.min_width.unwrap_or(usual.min_width),
            area: self.area.unwrap_or(usual.area),
            min_area: self.min_area.unwrap_or(usual.min_area),
            elongation: self.elongation,
            jitter: self.jitter,
            parks: self.parks,
            ..usual
        };
        options.check()?;
        if let Some(depth) = self.terrace.filter(|depth| !(0.5..=1000.0).contains(depth)) {
            return Err(Error::argument(format!("terrace must be from 0.5 to 1000 m, not {depth}")));
        }
        Ok(options)
    }
}

impl Network {
    pub(super) fn block_list(&self) -> Vec<Value> {
        let blocks = self.network.lot_blocks(self.surface_options());
        blocks.iter().map(|block| self.block_record(block)).collect()
    }

    pub(super) fn block_records(&self) -> Result<BlockRecords> {
        let find = || Ok((self.block_list().into_value(), Vec::new()));
        self.answers.once(|| vec![self.network.version()], find).map(BlockRecords)
    }

    pub(super) fn lot_records(&self, settings: &LotSettings) -> Result<LotRecords> {
        let options = settings.options().map_err(|error| error.about("network:lots"))?;
        let key = || settings.key(self.network.version(), &options);
        self.answers.once(key, || self.divide_blocks(settings, &options)).map(LotRecords)
    }

    fn divide_blocks(&self, settings: &LotSettings, options: &LotOptions) -> Result<(Value, Vec<Warning>)> {
        let mut omissions = Omissions::default();
        let blocks: Vec<StreetBlock> = match &settings.blocks {
            None => self.network.lot_blocks(self.surface_options()),
            Some(areas) => {
                let owner = MemoryOwner::current();
                let block = |area: &BlockArea| {
                    let _charged = owner.enter();
                    self.network.block(area.id.as_deref(), &area.rings.flat(), settings.reach)
                };
                let blocks: Vec<StreetBlock> = areas.par_iter().filter_map(block).collect();
                omissions.undivided = areas.len() - blocks.len();
                blocks
            }
        };
        let count = blocks.len() + omissions.undivided;
        let (stop, owner) = (Stop::current(), MemoryOwner::current());
        let goes_on = || stop.as_ref().is_none_or(|stop| !stop.is_stopped());
        let divided: Option<Vec<(Vec<Value>, Omissions)>> = blocks
            .par_iter()
            .map(|block| {
                let _charged = owner.enter();
                let mut stream = ModuleKey::seed(settings.seed.0).feature(&block.id).stream();
                let mut lots = block.divide_while(options, &mut || stream.uniform(), &goes_on)?;
                let mut omissions =
                    Omissions { undivided: usize::from(lots.is_empty()), ..Omissions::default() };
                for lot in &mut lots {
                    let is_free = || !self.network.obstacles().reach_into(&lot.rings[0]);
                    if lot.purpose == LotUse::Building && !is_free() {
                        lot.purpose = LotUse::Blocked;
                    }
                    omissions.count(lot, options);
                }
                lots.retain(|lot| settings.all || lot.purpose == LotUse::Building);
                let record = |lot| goes_on().then(|| self.lot_record(block, lot, settings.terrace));
                Some((lots.iter().map(record).collect::<Option<_>>()?, omissions))
            })
            .collect();
        if let Some(stop) = &stop {
            stop.check()?;
        }
        let (mut records, mut giving) = (Vec::new(), Vec::new());
        for (block, (of_block, omissions_of_block)) in blocks.iter().zip(divided.unwrap_or_default()) {
            if !of_block.is_empty() {
                giving.push(block);
            }
            records.extend(of_block);
            omissions.add(&omissions_of_block);
        }
        let mut told = if settings.all { Vec::new() } else { omissions.lots(options) };
        told.extend(omissions.blocks(count));
        if settings.blocks.is_some() {
            told.extend(overlapping(&giving));
        }
        if records.is_empty() {
            let help = "use a smaller width and depth, or fewer parks";
            match settings.blocks {
                None if omissions.blocked > 0 => {
                    let text =
                        format!("network:lots: all {} lots overlap an obstacle or water", omissions.blocked);
                    return Err(
                        Error::argument(text).help("use a smaller width and depth, or fewer obstacles")
                    );
                }
                None if !blocks.is_empty() => {
                    return Err(Error::argument(without_room(&blocks, options)).help(help));
                }
                None => {
                    let text = "network:lots: the streets enclose no block to divide";
                    let help = "connect the streets, or specify the areas to divide: blocks = { polygon }";
                    told.push(Warning::new(WarningKind::Doubtful, text).help(help));
                }
                // A fraction of the blocks becomes parks; among few blocks, these may be all blocks.
                Some(_) if told.is_empty() && omissions.parks < blocks.len() => {
                    told.push(Warning::new(WarningKind::Doubtful, without_room(&blocks, options)).help(help));
                }
                Some(_) => {}
            }
        }
        Ok((records.into_value(), told))
    }

    fn block_record(&self, block: &StreetBlock) -> Value {
        let pieces = block.sides.iter().filter_map(|side| side.piece);
        let depth = pieces.map(|piece| depth_of(&self.network, piece)).min();
        record([
            ("id", Value::Text(block.id.as_str().into())),
            ("geometry", polygon(&block.rings)),
            ("area", Value::Number(area_of(block))),
            ("street_depth", depth.map_or(Value::Nil, |depth| Value::Number(f64::from(depth)))),
        ])
    }

    fn lot_record(&self, block: &StreetBlock, lot: &Lot, terrace: Option<f64>) -> Value {
        let line = |points: &[DVec2]| Geometry::Line(points.iter().map(|at| at.extend(0.0)).collect());
        let number = |value: Option<f64>| value.map_or(Value::Nil, Value::Number);
        let front = lot.fronts.first();
        let attributes = lot.piece.map(|piece| self.network.attributes(piece));
        let terrace = terrace.filter(|_| lot.purpose == LotUse::Building).map(|depth| {
            let parts = lot.row(depth, JOINT).into_iter();
            parts.map(|part| Geometry::Polygon(Rings::from(&part).at_height(0.0))).collect::<Vec<_>>()
        });
        let fronts: Vec<Geometry> = lot.fronts.iter().map(|front| line(front)).collect();
        record([
            ("id", Value::Text(format!("{}/{}", block.id, lot.number).into())),
            ("geometry", polygon(&lot.rings)),
            ("use", Value::Text(lot.purpose.name().into())),
            ("area", Value::Number(lot.area)),
            ("width", Value::Number(lot.width)),
            ("depth", Value::Number(lot.depth)),
            ("front", front.map_or(Value::Nil, |front| line(front).into_value())),
            ("fronts", fronts.into_value()),
            ("front_length", Value::Number(lot.front_length)),
            ("corner", Value::Boolean(lot.is_corner)),
            ("access", front.map_or(Value::Nil, |_| lot.access.extend(0.0).into_value())),
            ("facing", number(front.map(|_| lot.facing.to_angle().to_degrees()))),
            ("block", Value::Text(block.id.as_str().into())),
            ("street_depth", number(attributes.map(|street| f64::from(street.depth)))),
            ("street_width", number(attributes.map(|street| street.width))),
            ("terrace", terrace.map_or(Value::Nil, Parameter::into_value)),
        ])
    }
}

/// Describes that no block has room for a building lot.
fn without_room(blocks: &[StreetBlock], options: &LotOptions) -> String {
    let greatest = blocks.iter().map(area_of).fold(0.0, f64::max);
    format!(
        "network:lots: none of {} block{} has room for a lot with {} m of front and {} m²: the greatest has {greatest:.0} m²",
        blocks.len(),
        if blocks.len() == 1 { "" } else { "s" },
        options.min_width,
        options.min_area
    )
}

fn depth_of(network: &StreetNetwork, piece: PieceId) -> u32 {
    network.attributes(piece).depth
}

pub(super) fn record<const COUNT: usize>(entries: [(&str, Value); COUNT]) -> Value {
    let there = entries.into_iter().filter(|(_, value)| !matches!(value, Value::Nil));
    let entries = there.map(|(name, value)| (TableKey::Name(name.into()), value)).collect();
    Value::Table(Arc::new(Table { class: None, entries }))
}

fn polygon(rings: &Rings<DVec2>) -> Value {
    Geometry::Polygon(rings.at_height(0.0)).into_value()
}

fn area_of(block: &StreetBlock) -> f64 {
    block.rings.iter().map(|ring| twice_area(ring.iter().copied()) / 2.0).sum()
}
