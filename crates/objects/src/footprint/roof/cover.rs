//! The construction of a roof on a footprint.

use super::replace;
use super::smooth::smooth;
use crate::footprint::object::Footprint;
use crate::roofs::Roof;
use crate::roofs::{is_curved, roof_map, roof_shape};
use burgeon_base::error::{Error, Result};
use burgeon_base::warning::Warning;
use burgeon_geometry::roof::{
    Eaves, Patch, PatchKind, RoofCover, RoofShape, RoofSurface as SurfaceOf, STEEPEST_EAVES, Support,
};
use burgeon_geometry::{Plan, fill};
use burgeon_scene::SurfaceMeaning;
use glam::DVec3;

impl Footprint {
    pub(crate) fn cover(&mut self, options: &Roof) -> Result<()> {
        self.check_open("roof")?;
        let shape = roof_shape(options)?;
        let origin = self.origin().truncate();
        let map = roof_map(options, origin)?;
        for detail in &options.details {
            detail.check()?;
        }
        if !self.shell.begun {
            self.lay("z_min", options.material.as_ref())?;
        }
        self.finish_walls()?;
        self.shell.closed = true;
        match self.detail {
            0 => return Ok(()),
            1 => return self.cap(options),
            _ => {}
        }
        let (walls, base) = (self.plan.flat(), self.shell.top);
        let rows = options.party_gables && matches!(shape.surface, SurfaceOf::Sloped(..));
        let party = if rows { self.party_walls() } else { Vec::new() };
        let open = shape.eaves == Eaves::Open && shape.overhang > 0.0;
        let juts = self.juts(open);
        let furthest = shape.overhang + juts.iter().copied().fold(0.0, f64::max);
        let drop = if open { STEEPEST_EAVES * shape.overhang } else { 0.0 };
        let reach = if furthest > 0.0 { self.reach(furthest, drop) } else { Vec::new() };
        let support =
            Support { walls: &walls, base, party: &party, juts: &juts, reach: &reach, map: map.as_ref() };
        let mut make = |shape: &RoofShape, support: &Support<'_>| shape.cover_on(support);
        let made = replace::cover(&shape, &options.kind, &support, &mut make);
        for line in &made.cover.unused {
            let remark = Warning::simplification("a line of a roof is not used as it is given");
            self.notes.push(remark.with_cause(line.text(origin)).help(line.help()));
        }
        let mut note =
            |what: String, why: String| self.notes.push(Warning::simplification(what).with_cause(why));
        if let Some((what, why)) = made.replaced {
            note(what, why);
        }
        if let Some(remark) = made.cover.remark {
            note(format!("the {} roof is adapted to its plan", options.kind), remark.into());
        }
        if made.cover.hipped {
            note(format!("hips instead of gables of a {} roof", options.kind), String::new());
        }
        // A neighbour is the cause if an edge would have a larger overhang without neighbours.
        let is_limited = !made.cover.tight.is_empty() && reach.iter().any(|reach| *reach < furthest);
        let alone = if is_limited { shape.cover_on(&Support { reach: &[], ..support }).ok() } else { None };
        let has_more = |cover: &RoofCover, edge: usize| cover.overhangs[edge] > made.cover.overhangs[edge];
        let is_beside = |edge: &usize| alone.as_ref().is_some_and(|alone| has_more(alone, *edge));
        let (beside, within): (Vec<usize>, Vec<usize>) =
            made.cover.tight.iter().partition(|edge| is_beside(edge));
        for (edges, cause) in [(beside, "a neighbour is near"), (within, "the space is too small")] {
            if !edges.is_empty() {
                let why = overhang_text(&edges, &made.cover.overhangs, options.overhang, &self.plan);
                note(format!("a smaller overhang over some edges, as {cause}"), why);
            }
        }
        self.draw(options, &made.cover.patches).map_err(Error::of_data)?;
        if self.detail < 3 {
            return Ok(());
        }
        for (index, detail) in options.details.iter().enumerate() {
            let seed = self.seed.wrapping_add((index as u64 + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15));
            for (model, frame) in detail.frames(&made.cover.patches, seed) {
                self.drawing.place(&model, frame);
            }
        }
        Ok(())
    }

    /// Closes the walls with a level face, instead of a roof.
    fn cap(&mut self, options: &Roof) -> Result<()> {
        let base = self.shell.top;
        let top = self.plan.flat().at_height(base);
        let part = self.part(options.color, options.material.as_ref())?;
        fill(self.drawing.surface(part, SurfaceMeaning::Roof), &top, DVec3::X, DVec3::ZERO)
            .map_err(Error::of_data)
    }

    fn draw(&mut self, options: &Roof, patches: &[Patch]) -> Result<()> {
        let material = options.material.as_ref();
        let trim = options.trim.as_ref().or(material);
        let slope = self.part(options.color, material)?;
        let gable = options.gable.as_ref().map(|gable| self.part(None, Some(gable))).transpose()?;
        let fascia = self.part(options.color, trim)?;
        let underside = self.part(options.color, options.underside.as_ref().or(trim))?;
        let (is_curved, has_ribs) = (is_curved(&options.kind), options.kind == "dome");
        let mut sides = Vec::new();
        let first = self.drawing.surface(slope, SurfaceMeaning::Roof).positions.len();
        for patch in patches {
            let part = match (patch.kind, gable) {
                (PatchKind::Slope, _) => slope,
                (PatchKind::Gable, Some(gable)) => gable,
                // A gable continues the wall below it.
                (PatchKind::Gable, None) => match self.sides.get(patch.edge) {
                    Some(side) => side.part,
                    None => self.part(None, None)?,
                },
                (PatchKind::Fascia, _) => fascia,
                (PatchKind::Underside, _) => underside,
            };
            let Some(&origin) = patch.rings.first().and_then(|ring| ring.first()) else { continue };
            let right = if patch.along == glam::DVec2::ZERO { DVec3::X } else { patch.along.extend(0.0) };
            let meaning =
                if patch.kind == PatchKind::Gable { SurfaceMeaning::Wall } else { SurfaceMeaning::Roof };
            let surface = self.drawing.surface(part, meaning);
            fill(surface, &patch.rings, right, origin)?;
            if has_ribs && part == slope {
                sides.resize(surface.positions.len() - first, patch.along);
            }
        }
        if is_curved {
            smooth(self.drawing.surface(slope, SurfaceMeaning::Roof), first, &sides);
        }
        Ok(())
    }
}

/// Maximum number of edges that a note names.
const NAMED: usize = 8;

/// Describes the overhangs of a roof over `edges`, which are smaller than the requested `overhang`, and names the edges
/// by their given numbers.
fn overhang_text(edges: &[usize], overhangs: &[f64], overhang: f64, plan: &Plan) -> String {
    let found = edges.iter().map(|&edge| overhangs[edge]);
    let (least, most) =
        found.fold((f64::INFINITY, 0.0f64), |(least, most), by| (least.min(by), most.max(by)));
    let range = if least < most { format!("{least} to {most}") } else { format!("{most}") };
    let given = plan.given_edges();
    let mut edges: Vec<usize> =
        edges.iter().filter_map(|&edge| given.get(edge)).flatten().map(|edge| edge + 1).collect();
    edges.sort_unstable();
    let named: Vec<String> = edges.iter().take(NAMED).map(usize::to_string).collect();
    let more = edges.len() - named.len();
    let more = if more > 0 { format!(" and {more} more") } else { String::new() };
    let word = if edges.len() == 1 { "edge" } else { "edges" };
    format!("{range} m instead of {overhang} m over {word} {}{more}", named.join(", "))
}
