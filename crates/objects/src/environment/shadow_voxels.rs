//! Light as shadows that spread downwards: `shadow_voxels` in scripts.

use std::collections::BTreeMap;
use std::sync::OnceLock;

use burgeon_base::error::{Error, Result};
use burgeon_base::{MemoryOwner, Stop};
use burgeon_kit::{Environment, Vector, fields, methods, object};
use glam::DVec3;

/// Largest absolute coordinate of a voxel.
const FARTHEST: f64 = 1e6;
/// Maximum number of voxels of a layer that has a table of sums.
const LARGEST_LAYER: usize = 1 << 24;

/// Fields of `shadow_voxels { ... }`.
#[fields("shadow_voxels")]
pub struct ShadowVoxelOptions {
    /// Length of the side of a voxel (m).
    #[default(0.5)]
    pub size: f64,
    /// Number of layers below a place that it shades.
    #[default(8)]
    pub depth: u32,
    /// Shadow of a place of amount 1 in its own voxel; light is 1 minus the shadow.
    #[default(0.2)]
    pub strength: f64,
    /// Factor by which a shadow becomes weaker from layer to layer.
    #[default(0.5)]
    pub decay: f64,
}

/// Light as shadows in a grid of voxels: each place shades a pyramid of voxels below it.
///
/// Method: W. Palubicki and others, "Self-organizing tree models for image synthesis", 2009.
#[object(
    "shadow_voxels",
    can(Environment),
    options = ShadowVoxelOptions,
    example = include_str!("../../scripts/shadow_voxels.lua"),
    begins_empty,
    begin = restart,
)]
pub struct ShadowVoxels {
    options: ShadowVoxelOptions,
    /// Shadow of a place of amount 1 in its own layer and in each layer below.
    strengths: Vec<f64>,
    /// Amounts in the order of the calls, with the numbers of their voxels along x, y and z. Amounts of one voxel are
    /// added up if there is no room for more.
    amounts: Vec<VoxelAmount>,
    /// Sums of the amounts in ascending layers, built by the first question after the last change.
    layers: OnceLock<Vec<LayerSums>>,
}

/// Numbers of a voxel along x, y and z, and an amount in it.
type VoxelAmount = ([i32; 3], f64);

/// Sums of the amounts in a layer. Rows and columns without amounts take no room in the table.
#[derive(Debug, Clone)]
struct LayerSums {
    /// Number of the layer along z.
    layer: i32,
    /// Rows and columns along x and y.
    lines: [VoxelLines; 2],
    /// Sum of the amounts of all voxels before x and y, row by row, with a row and a column of zeros.
    sums: Vec<f64>,
}

/// Lines of voxels along an axis of a layer, from the first to the last line that has amounts.
#[derive(Debug, Clone)]
struct VoxelLines {
    /// Number of the first line.
    first: i32,
    /// Number of lines with amounts before each line, and before the end.
    before: Vec<u32>,
}

#[methods("shadow_voxels")]
impl ShadowVoxels {
    /// Adds the shadow of a place, such as that of a leaf, with an amount (1 unless given).
    pub fn shade(&mut self, place: Vector, amount: Option<f64>) -> Result<()> {
        let voxel = self.voxel(place.0)?;
        let amount = amount.unwrap_or(1.0);
        if !amount.is_finite() {
            return Err(Error::argument(format!("shadow_voxels:shade: the amount is {amount}"))
                .help("give a finite number"));
        }
        if self.amounts.len() == self.amounts.capacity() {
            self.make_room()?;
        }
        self.layers.take();
        self.amounts.push((voxel, amount));
        Ok(())
    }

    /// Returns the light at a place, from 0 to 1, without the shadow that a place of amount 1 casts there.
    pub fn light(&self, place: Vector) -> Result<f64> {
        let shadow = self.shadow_in(self.voxel(place.0)?)?;
        Ok((1.0 - shadow + self.options.strength).clamp(0.0, 1.0))
    }

    /// Returns the direction in which the shadow becomes weaker, of length 1; the zero vector if it is the same on all
    /// sides.
    pub fn brightest(&self, place: Vector) -> Result<DVec3> {
        let voxel = self.voxel(place.0)?;
        let mut darker = DVec3::ZERO;
        for axis in 0..3 {
            let shadow_at = |step: i32| {
                let mut near = voxel;
                near[axis] += step;
                self.shadow_in(near)
            };
            darker[axis] = shadow_at(1)? - shadow_at(-1)?;
        }
        Ok((-darker).normalize_or_zero())
    }
}

impl ShadowVoxels {
    /// Creates an empty grid.
    ///
    /// ```
    /// use burgeon_kit::Vector;
    /// use burgeon_objects::ShadowVoxels;
    /// use glam::DVec3;
    ///
    /// let mut light = ShadowVoxels::new(Default::default())?;
    /// light.shade(Vector(DVec3::new(0.0, 0.0, 2.0)), None)?;
    /// assert_eq!(light.light(Vector(DVec3::ZERO))?, 1.0);
    /// light.shade(Vector(DVec3::new(0.0, 0.0, 1.0)), Some(8.0))?;
    /// assert!(light.light(Vector(DVec3::ZERO))? < 1.0);
    /// # Ok::<(), burgeon_base::Error>(())
    /// ```
    pub fn new(options: ShadowVoxelOptions) -> Result<Self> {
        let refuse = |name: &str, allowed: &str, value: f64| {
            Err(Error::argument(format!("shadow_voxels: {name} is {value}")).help(format!("give {allowed}")))
        };
        if !(options.size > 0.0 && options.size.is_finite()) {
            return refuse("size", "a length above 0", options.size);
        }
        if !(0.0..=1.0).contains(&options.decay) {
            return refuse("decay", "a factor from 0 to 1", options.decay);
        }
        if !(options.strength >= 0.0 && options.strength.is_finite()) {
            return refuse("strength", "a number of at least 0", options.strength);
        }
        if options.depth > 1000 {
            return refuse("depth", "at most 1000 layers", f64::from(options.depth));
        }
        let layers = 0..=options.depth;
        let strengths = layers.scan(options.strength, |strength, _| {
            let own = *strength;
            *strength *= options.decay;
            Some(own)
        });
        let strengths = strengths.collect();
        Ok(Self { options, strengths, amounts: Vec::new(), layers: OnceLock::new() })
    }

    /// Adds up the amounts of each voxel, in the order of the calls, and enlarges the list if many voxels remain.
    fn make_room(&mut self) -> Result<()> {
        let full = self.amounts.len();
        self.amounts.sort_by_key(|(voxel, _)| *voxel);
        self.amounts.dedup_by(|(voxel, amount), (kept, sum)| {
            let is_same = voxel == kept;
            if is_same {
                *sum += *amount;
            }
            is_same
        });
        if self.amounts.len() * 2 >= full {
            let more = full.max(64);
            MemoryOwner::ensure_room((full + more) * size_of::<VoxelAmount>())?;
            self.amounts.reserve(more);
        }
        Ok(())
    }

    fn restart(&mut self) {
        self.amounts.clear();
        self.layers.take();
    }

    /// Returns the numbers of the voxel that contains `place` (m).
    #[allow(clippy::cast_possible_truncation, reason = "the range is checked")]
    fn voxel(&self, place: DVec3) -> Result<[i32; 3]> {
        let voxel = (place / self.options.size).floor();
        if voxel.abs().max_element() > FARTHEST || !voxel.is_finite() {
            let [x, y, z] = place.to_array();
            return Err(Error::argument(format!(
                "shadow_voxels: the place {{{x:?}, {y:?}, {z:?}}} (m) is outside of the grid"
            ))
            .help("use larger voxels, or places near the origin"));
        }
        Ok(voxel.to_array().map(|number| number as i32))
    }

    /// Returns the shadow in a voxel.
    fn shadow_in(&self, [x, y, z]: [i32; 3]) -> Result<f64> {
        let layers = match self.layers.get() {
            Some(layers) => layers,
            None => {
                let layers = layers(&self.amounts)?;
                self.layers.get_or_init(|| layers)
            }
        };
        let mut shadow = 0.0;
        for layer in &layers[layers.partition_point(|layer| layer.layer < z)..] {
            let above = layer.layer - z;
            let Some(strength) = self.strengths.get(above.unsigned_abs() as usize) else { break };
            shadow += strength * layer.sum([x - above, y - above], [x + above, y + above]);
        }
        Ok(shadow)
    }
}

impl Environment for ShadowVoxels {
    fn end_pass(&mut self) -> Result<()> {
        self.layers = OnceLock::from(layers(&self.amounts)?);
        Ok(())
    }
}

/// Returns the sums of the amounts in each layer that has some.
///
/// Amounts are added in the order of the calls, so that rounding is the same in every run.
fn layers(amounts: &[VoxelAmount]) -> Result<Vec<LayerSums>> {
    let mut spans: BTreeMap<i32, [[i32; 2]; 2]> = BTreeMap::new();
    for ([x, y, z], _) in amounts {
        let span = spans.entry(*z).or_insert([[*x, *y], [*x, *y]]);
        *span = [[span[0][0].min(*x), span[0][1].min(*y)], [span[1][0].max(*x), span[1][1].max(*y)]];
    }
    let mut layers: Vec<LayerSums> = Vec::with_capacity(spans.len());
    for (layer, [first, last]) in spans {
        Stop::check_current()?;
        let counts = [0, 1].map(|axis| last[axis].abs_diff(first[axis]) as usize + 1);
        if (counts[0] + 1).saturating_mul(counts[1] + 1) > LARGEST_LAYER {
            return Err(Error::argument(format!(
                "shadow_voxels: a layer of {} by {} voxels is too large",
                counts[0], counts[1]
            ))
            .help("use larger voxels"));
        }
        MemoryOwner::ensure_room((counts[0] + counts[1] + 2) * size_of::<u32>())?;
        let lines = [0, 1].map(|axis| VoxelLines { first: first[axis], before: vec![0; counts[axis] + 1] });
        layers.push(LayerSums { layer, lines, sums: Vec::new() });
    }
    for ([x, y, z], _) in amounts {
        if let Some(layer) = find(&mut layers, *z) {
            layer.lines[0].mark(*x);
            layer.lines[1].mark(*y);
        }
    }
    for layer in &mut layers {
        layer.lines.iter_mut().for_each(VoxelLines::count);
        let [columns, rows] = [0, 1].map(|axis| layer.lines[axis].kept() + 1);
        MemoryOwner::ensure_room(columns * rows * size_of::<f64>())?;
        layer.sums = vec![0.0; columns * rows];
    }
    for ([x, y, z], amount) in amounts {
        if let Some(layer) = find(&mut layers, *z) {
            let at = layer.index([layer.lines[0].before_end(*x), layer.lines[1].before_end(*y)]);
            layer.sums[at] += amount;
        }
    }
    for layer in &mut layers {
        Stop::check_current()?;
        layer.add_up();
    }
    Ok(layers)
}

/// Returns the layer with a number.
fn find(layers: &mut [LayerSums], number: i32) -> Option<&mut LayerSums> {
    let at = layers.partition_point(|layer| layer.layer < number);
    layers.get_mut(at)
}

impl VoxelLines {
    /// Marks a line that has an amount.
    fn mark(&mut self, number: i32) {
        self.before[number.abs_diff(self.first) as usize + 1] = 1;
    }

    /// Replaces the marks by the numbers of marked lines before each line.
    fn count(&mut self) {
        let mut count = 0;
        for before in &mut self.before {
            count += *before;
            *before = count;
        }
    }

    /// Returns the number of lines with amounts.
    fn kept(&self) -> usize {
        self.before.last().map_or(0, |count| *count as usize)
    }

    /// Returns the number of lines with amounts before the line `number`, which can be outside of the layer.
    fn before(&self, number: i32) -> usize {
        let at = usize::try_from(number - self.first).unwrap_or(0);
        self.before[at.min(self.before.len() - 1)] as usize
    }

    /// Returns the number of lines with amounts up to and including the line `number`.
    fn before_end(&self, number: i32) -> usize {
        self.before(number + 1)
    }
}

impl LayerSums {
    fn index(&self, [x, y]: [usize; 2]) -> usize {
        y * (self.lines[0].kept() + 1) + x
    }

    /// Replaces the amount of each voxel by the sum of the amounts up to it.
    fn add_up(&mut self) {
        let width = self.lines[0].kept() + 1;
        let mut above = vec![0.0; width];
        for row in self.sums.chunks_exact_mut(width).skip(1) {
            let mut sum = 0.0;
            for (value, above) in row.iter_mut().zip(&mut above) {
                sum += *value;
                *above += sum;
                *value = *above;
            }
        }
    }

    /// Returns the sum of the amounts from voxel `from` to voxel `to`.
    fn sum(&self, from: [i32; 2], to: [i32; 2]) -> f64 {
        let [x0, y0] = [0, 1].map(|axis| self.lines[axis].before(from[axis]));
        let [x1, y1] = [0, 1].map(|axis| self.lines[axis].before_end(to[axis]));
        let at = |x, y| self.sums[self.index([x, y])];
        at(x1, y1) - at(x0, y1) - at(x1, y0) + at(x0, y0)
    }
}
