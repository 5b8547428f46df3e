//! The upper part of a building: its roof.

use glam::{DVec2, DVec3};

use super::{Color, Footprint, Surface, along, check_height, edges, unknown};
use crate::error::{Error, Result};
use crate::geometry::skeleton::{Pace, Skeleton};
use crate::geometry::{Patch, Polygon, fill, gables, patches, shed};

fields! {
    /// What `footprint:roof { ... }` takes.
    pub struct Roof for "footprint:roof" {
        /// "flat", "shed", "hip", "mansard", "pagoda", "porch", "gable" or "gambrel".
        pub kind: String = "hip".into(),
        /// How high the ridge is above the walls (m); after `slope` if left out.
        pub height: Option<f64> = None,
        /// Slope (degrees) from the eaves to the highest ridge, where no height is given.
        pub slope: f64 = 35.0,
        /// How far it juts out over the walls (m), where there is room.
        pub overhang: f64 = 0.0,
        /// Height of the upright faces along its outline (m).
        pub slab: f64 = 0.0,
        /// Height of the border of a flat roof (m).
        pub border: f64 = 0.0,
        /// Width of the border of a flat roof (m).
        pub border_width: f64 = 0.3,
        /// Its colour.
        pub color: Option<Color> = None,
        /// Its material, in place of the colour.
        pub material: Option<Surface> = None,
        /// The material of gables; the roof's if left out.
        pub gable: Option<Surface> = None,
        /// The material of slabs, borders and the undersides of overhangs; the roof's if left out.
        pub trim: Option<Surface> = None,
    }
}

const KINDS: [&str; 8] = ["flat", "shed", "hip", "mansard", "pagoda", "porch", "gable", "gambrel"];

/// The corners of each kind's profile between eaves and ridge: parts of the width and of the height.
fn bends(kind: &str) -> &'static [(f64, f64)] {
    match kind {
        "mansard" => &[(0.25, 0.7)],
        "gambrel" => &[(0.35, 0.62)],
        "porch" => &[(0.35, 0.15)],
        "pagoda" => &[(0.35, 0.12), (0.7, 0.42)],
        _ => &[],
    }
}

impl Footprint {
    pub(super) fn cover(&mut self, options: &Roof) -> Result<()> {
        self.check_open("roof")?;
        let kind = options.kind.as_str();
        if !KINDS.contains(&kind) {
            return Err(unknown("footprint:roof", kind, &KINDS));
        }
        if let Some(height) = options.height {
            check_height("footprint:roof: height", height)?;
        }
        if !(options.slope > 0.0 && options.slope <= 85.0) {
            return Err(Error::new(format!("footprint:roof: slope is {} degrees", options.slope))
                .help("give degrees above 0, up to 85"));
        }
        for (name, length) in
            [("overhang", options.overhang), ("slab", options.slab), ("border", options.border)]
        {
            if !(0.0..=100.0).contains(&length) {
                return Err(
                    Error::new(format!("footprint:roof: {name} is {length} m")).help("give 0 to 100 m")
                );
            }
        }
        if !(0.05..=100.0).contains(&options.border_width) {
            return Err(Error::new(format!("footprint:roof: border_width is {} m", options.border_width))
                .help("give 0.05 to 100 m"));
        }
        if !self.shell.begun {
            self.lay("z_min", options.material.clone())?;
        }
        self.shell.closed = true;
        self.repair = "";
        let base = self.shell.top;
        let (rings, overhang) = self.plan.outset(options.overhang);
        if overhang > 0.0 {
            self.underside(&rings, base, options)?;
        }
        if kind == "shed" {
            let rise = |depth: f64| options.height.unwrap_or(options.slope.to_radians().tan() * depth);
            let (sides, slope) = shed(&rings, rise, base);
            self.draw(options, sides)?;
            let part = self.part(options.color, options.material.as_ref())?;
            return fill(self.drawing.part(part), &slope, DVec3::X, slope[0][0]);
        }
        let flat = kind == "flat" && options.border == 0.0 && options.slab == 0.0;
        let made = if flat { None } else { self.skeleton(&rings, matches!(kind, "gable" | "gambrel")) };
        let Some((skeleton, speeds)) = made else {
            let top: Vec<Vec<DVec3>> =
                rings.iter().map(|ring| ring.iter().map(|at| at.extend(base)).collect()).collect();
            let part = self.part(options.color, options.material.as_ref())?;
            return fill(self.drawing.part(part), &top, DVec3::X, DVec3::ZERO);
        };
        let wide = skeleton.duration();
        let mut profile = vec![DVec2::ZERO];
        if options.slab > 0.0 {
            profile.push(DVec2::new(0.0, options.slab));
        }
        if kind == "flat" {
            let inner = options.border_width.min(wide * 0.5);
            if options.border > 0.0 {
                let low = options.slab;
                let high = low + options.border;
                profile.extend([(0.0, high), (inner, high), (inner, low)].map(DVec2::from));
                if options.slab > 0.0 {
                    profile.remove(1);
                }
            }
            profile.push(DVec2::new(wide, options.slab));
        } else {
            let rise = options.height.unwrap_or(options.slope.to_radians().tan() * wide);
            let corner =
                |&(width, height): &(f64, f64)| DVec2::new(width * wide, options.slab + height * rise);
            profile.extend(bends(kind).iter().chain([&(1.0, 1.0)]).map(corner));
        }
        self.draw(options, patches(&skeleton, &speeds, &profile, base))
    }

    /// The skeleton over `rings`, with gables if they can be made.
    fn skeleton(&mut self, rings: &[Vec<DVec2>], with_gables: bool) -> Option<(Skeleton, Vec<Pace>)> {
        let equal = vec![Pace::default(); rings.iter().map(Vec::len).sum()];
        let Ok(hip) = Skeleton::new(rings, &equal) else {
            self.repair = "flat";
            return None;
        };
        if hip.moved {
            self.repair = "moved";
        }
        if with_gables {
            let speeds = gables(rings, &hip);
            match Skeleton::new(rings, &speeds) {
                Ok(gabled) => return Some((gabled, speeds)),
                Err(_) => self.repair = "hip",
            }
        }
        Some((hip, equal))
    }

    /// The underside of the overhang, between the walls and the roof's outline.
    fn underside(&mut self, rings: &[Vec<DVec2>], base: f64, options: &Roof) -> Result<()> {
        let trim = options.trim.as_ref().or(options.material.as_ref());
        let part = self.part(options.color, trim)?;
        let inner = self.plan.flat();
        let part = self.drawing.part(part);
        for (outer, inner) in rings.iter().zip(&inner) {
            for ([a, b], [c, d]) in edges(outer).zip(edges(inner)) {
                let corners = vec![b.extend(base), a.extend(base), c.extend(base), d.extend(base)];
                fill(part, &[corners], along(b, a), b.extend(base))?;
            }
        }
        Ok(())
    }

    fn draw(&mut self, options: &Roof, polygons: Vec<Polygon>) -> Result<()> {
        let slope = self.part(options.color, options.material.as_ref())?;
        let gable = self.part(options.color, options.gable.as_ref().or(options.material.as_ref()))?;
        let step = self.part(options.color, options.trim.as_ref().or(options.material.as_ref()))?;
        for (patch, direction, corners) in polygons {
            let part = match patch {
                Patch::Slope => slope,
                Patch::Gable => gable,
                Patch::Step => step,
            };
            let origin = corners[0];
            fill(self.drawing.part(part), &[corners], direction.extend(0.0), origin)?;
        }
        Ok(())
    }
}
