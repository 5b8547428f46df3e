//! Light as shadows that spread downwards: `shadow_voxels` in scripts.

use std::collections::BTreeMap;
use std::sync::OnceLock;

use burgeon_base::error::{Error, Result};
use burgeon_base::{MemoryOwner, Stop};
use burgeon_kit::{Environment, Vector, fields, methods, object};
use glam::DVec3;
use rustc_hash::FxHashMap;

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
    /// Amounts of the places in each voxel, by the numbers of the voxel along x, y and z.
    amounts: FxHashMap<[i32; 3], f64>,
    /// Sums of the amounts, built by the first question after the last change.
    layers: OnceLock<BTreeMap<i32, LayerSums>>,
}

/// Sums of the amounts in a layer.
#[derive(Debug, Clone)]
struct LayerSums {
    /// Numbers of the first voxel along x and y.
    first: [i32; 2],
    /// Numbers of voxels along x and y.
    counts: [usize; 2],
    /// Sum of the amounts of all voxels before x and y, row by row, with a row and a column of zeros.
    sums: Vec<f64>,
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
            MemoryOwner::ensure_room(2 * self.amounts.len() * size_of::<([i32; 3], f64)>())?;
        }
        self.layers.take();
        *self.amounts.entry(voxel).or_default() += amount;
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
        Ok(Self { options, amounts: FxHashMap::default(), layers: OnceLock::new() })
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
        let (mut shadow, mut strength) = (0.0, self.options.strength);
        for above in 0..=self.options.depth.cast_signed() {
            if let Some(layer) = layers.get(&(z + above)) {
                shadow += strength * layer.sum([x - above, y - above], [x + above, y + above]);
            }
            strength *= self.options.decay;
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
fn layers(amounts: &FxHashMap<[i32; 3], f64>) -> Result<BTreeMap<i32, LayerSums>> {
    let mut spans: BTreeMap<i32, [[i32; 2]; 2]> = BTreeMap::new();
    // Sorted, so that rounding does not depend on the order of a hash table.
    let mut voxels: Vec<([i32; 3], f64)> = amounts.iter().map(|(voxel, amount)| (*voxel, *amount)).collect();
    voxels.sort_unstable_by_key(|(voxel, _)| *voxel);
    for ([x, y, z], _) in &voxels {
        let span = spans.entry(*z).or_insert([[*x, *y], [*x, *y]]);
        *span = [[span[0][0].min(*x), span[0][1].min(*y)], [span[1][0].max(*x), span[1][1].max(*y)]];
    }
    let mut layers: BTreeMap<i32, LayerSums> = BTreeMap::new();
    for (z, [first, last]) in spans {
        Stop::check_current()?;
        let counts = [0, 1].map(|axis| last[axis].abs_diff(first[axis]) as usize + 1);
        let size = (counts[0] + 1).saturating_mul(counts[1] + 1);
        if size > LARGEST_LAYER {
            return Err(Error::argument(format!(
                "shadow_voxels: a layer of {} by {} voxels is too large",
                counts[0], counts[1]
            ))
            .help("use larger voxels"));
        }
        MemoryOwner::ensure_room(size * size_of::<f64>())?;
        layers.insert(z, LayerSums { first, counts, sums: vec![0.0; size] });
    }
    for ([x, y, z], amount) in voxels {
        if let Some(layer) = layers.get_mut(&z) {
            let at = layer
                .index([x.abs_diff(layer.first[0]) as usize + 1, y.abs_diff(layer.first[1]) as usize + 1]);
            layer.sums[at] += amount;
        }
    }
    for layer in layers.values_mut() {
        for y in 1..=layer.counts[1] {
            let mut row = 0.0;
            for x in 1..=layer.counts[0] {
                let at = layer.index([x, y]);
                row += layer.sums[at];
                layer.sums[at] = row + layer.sums[layer.index([x, y - 1])];
            }
        }
    }
    Ok(layers)
}

impl LayerSums {
    fn index(&self, [x, y]: [usize; 2]) -> usize {
        y * (self.counts[0] + 1) + x
    }

    /// Returns the sum of the amounts from voxel `from` to voxel `to`.
    fn sum(&self, from: [i32; 2], to: [i32; 2]) -> f64 {
        let clamped = |axis: usize, number: i32| -> usize {
            usize::try_from(number - self.first[axis]).unwrap_or(0).min(self.counts[axis])
        };
        let [x0, y0] = [0, 1].map(|axis| clamped(axis, from[axis]));
        let [x1, y1] = [0, 1].map(|axis| clamped(axis, to[axis] + 1));
        let at = |x, y| self.sums[self.index([x, y])];
        at(x1, y1) - at(x0, y1) - at(x1, y0) + at(x0, y0)
    }
}
