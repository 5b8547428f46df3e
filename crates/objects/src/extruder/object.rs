//! The extruder object of scripts.

use std::any::Any;
use std::sync::Arc;

use super::bend::bend_warning;
use super::joint::Joint;
use super::options::{ExtruderOptions, check_resolution};
use super::state::{ExtruderState, SolidRun};
use crate::MaterialOptions;
use crate::frame_stack::{FrameStack, FrameStackMark};
use crate::mesh::{MeshFaces, MeshOptions, MeshPoints, draw_mesh};
use crate::shapes::{ShapeObject, ShapeTarget, draw_shape};
use burgeon_base::error::{Error, Result};
use burgeon_base::warning::{Warning, WarningKind};
use burgeon_geometry::{Frame, Rings, Section, Segment, Station, SweepOptions, sweep};
use burgeon_kit::{
    AxisScale, Color, Drawing, DrawingMark, Locate, Model, ObjectPlace, Rewind, Vector, Warn, methods, object,
};
use burgeon_spatial::Path;
use glam::{DAffine3, DVec2, DVec3};
use smallvec::{SmallVec, smallvec};

/// Angle (degrees) of a cross-section's corner above which the corner is sharp on smooth surfaces too.
const CREASE: f64 = 40.0;

/// Sweeps a cross-section along segments, straight or curved, as in the ML-System paper.
///
/// Each segment has its own length, curvature, twist and scale. Segments that continue each other exactly form one
/// solid. A jump in position, direction, scale or section closes the solid and begins another.
///
/// ```
/// use burgeon_kit::Object;
/// use burgeon_objects::Extruder;
/// use burgeon_scene::Scene;
///
/// let mut extruder = Extruder::new(Default::default())?;
/// extruder.rectangle(2.0, 1.0)?;
/// extruder.extrude(3.0)?;
/// extruder.end()?;
/// assert_eq!((extruder.position().z, extruder.open_edges()), (3.0, 0));
/// let (mut scene, drawn): (Scene, &dyn Object) = (Scene::default(), &extruder);
/// drawn.show(&mut scene, "beam", None)?;
/// assert_eq!((scene.triangles(), scene.instances[0].name.as_str()), (12, "beam"));
/// # Ok::<(), burgeon_base::Error>(())
/// ```
#[object(
    "extruder",
    options = ExtruderOptions,
    example = include_str!("../../scripts/extruder.lua"),
    draws,
    can(Warn, Locate, Rewind),
    begins_empty,
    begin = restart,
    push = open_branch,
    pop = close_branch,
    end = finish,
)]
pub struct Extruder {
    options: ExtruderOptions,
    first_section: Arc<Section>,
    state: ExtruderState,
    stack: FrameStack<ExtruderState>,
    /// Recently set cross-sections, because scripts often set the same ones again.
    known: Vec<(SectionShape, Arc<Section>)>,
    pub(super) drawing: Drawing,
    open_edges: usize,
    warnings: Vec<Warning>,
}

/// A cross-section defined by a few numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
enum SectionShape {
    Regular(u32),
    Star(u32, f64),
    Rectangle(f64, f64),
}

/// Number of cross-sections that are kept.
const KNOWN: usize = 16;

#[methods("extruder")]
impl Extruder {
    /// Sets the cross-section to a regular polygon with `sides` and radius 1.
    pub fn regular(&mut self, sides: u32) -> Result<()> {
        self.set(SectionShape::Regular(sides))
    }

    /// Sets the cross-section to a star with `points` outer corners at radius 1 and as many inner corners at radius
    /// `inner`.
    pub fn star(&mut self, points: u32, inner: f64) -> Result<()> {
        self.set(SectionShape::Star(points, inner))
    }

    /// Sets the cross-section to a centred rectangle, `width` (m) to the right and `height` (m) up.
    ///
    /// Right and up are the directions of `shift`: x and y before the first turn, while the extruder faces along z. If
    /// it faces sideways, `direction(heading, above)` turns the height towards `above`.
    pub fn rectangle(&mut self, width: f64, height: f64) -> Result<()> {
        self.set(SectionShape::Rectangle(width, height))
    }

    /// Sets the cross-section to a polygon with holes, each a list of points { x, y } (m), or to a geometry.
    pub fn polygon(&mut self, outer: Path, holes: Option<Vec<Path>>) -> Result<()> {
        let Path { points, holes: own } = outer;
        let holes = holes.unwrap_or_default().into_iter().map(|hole| hole.points);
        let section = Section::polygon(&flatten(std::iter::once(points).chain(own.0).chain(holes)))?;
        self.state.section = Arc::new(shade(section, self.state.smooth));
        Ok(())
    }

    /// Turns the direction of extrusion to `direction`, by the shortest rotation, or so that the cross-section's up
    /// direction points to `above`.
    pub fn direction(&mut self, direction: Vector, above: Option<Vector>) -> Result<()> {
        if direction.0.length_squared() < 1e-24 {
            return Err(Error::argument("extruder:direction: direction has no length")
                .help("use a vector that is not zero"));
        }
        match above {
            None => self.state.frame.face(direction.0),
            Some(above) if above.0.length_squared() < 1e-24 => {
                return Err(Error::argument("extruder:direction: above has no length")
                    .help("use a vector that is not zero, or omit it"));
            }
            // The y axis of a section is opposite to the up direction of the frame.
            Some(above) => self.state.frame.look(direction.0, -above.0),
        }
        Ok(())
    }

    /// Sets the number of divisions along each segment and of points around the cross-section; 0 selects them
    /// automatically.
    pub fn resolution(&mut self, along: u32, around: u32) -> Result<()> {
        check_resolution(along, around)?;
        self.state.along = along;
        self.state.around = around;
        Ok(())
    }

    /// Sets the scale of the cross-section immediately: to the right `scale`, and up `y` (`scale` unless given).
    pub fn scale(&mut self, scale: f64, y: Option<f64>) {
        self.state.scale = DVec2::new(scale, y.unwrap_or(scale));
        self.state.taper = self.state.scale;
    }

    /// Sets the scale at the end of the next segment: to the right `scale`, and up `y` (`scale` unless given). The
    /// scale changes linearly along the segment.
    pub fn taper(&mut self, scale: f64, y: Option<f64>) {
        self.state.taper = DVec2::new(scale, y.unwrap_or(scale));
    }

    /// Bends each following segment by `angle` (degrees), towards the side at `toward` (degrees, 0 unless given), where
    /// 0 is left.
    pub fn bend(&mut self, angle: f64, toward: Option<f64>) {
        self.state.bend = angle.to_radians();
        self.state.toward = toward.unwrap_or(0.0).to_radians();
    }

    /// Twists each following segment by `angle` (degrees).
    pub fn twist(&mut self, angle: f64) {
        self.state.twist = angle.to_radians();
    }

    /// Sets whether the start is closed, and the `end` (`start` unless given).
    pub fn caps(&mut self, start: bool, end: Option<bool>) {
        self.state.caps = [start, end.unwrap_or(start)];
    }

    /// Sets smooth or flat shading.
    pub fn smooth(&mut self, smooth: bool) {
        self.state.smooth = smooth;
    }

    /// Extrudes the cross-section by `length` (m). A segment that begins where the last one ends continues its solid: across
    /// a turn with a mitre, unless the turn is above 120 degrees, rolls more than it bends, or a segment is too short.
    pub fn extrude(&mut self, length: f64) -> Result<()> {
        self.segment(length)
    }

    /// Moves forward by `length` (m) without drawing.
    pub fn advance(&mut self, length: f64) {
        self.state.frame.forward(length);
    }

    /// Moves across the direction of extrusion: to the right by `right` (m), and up by `up` (m).
    pub fn shift(&mut self, right: f64, up: f64) {
        let frame = &mut self.state.frame;
        frame.position += frame.left * -right - frame.up * up;
    }

    /// Moves to a position (m) without drawing.
    pub fn jump(&mut self, position: Vector) {
        self.state.frame.position = position.0 - self.drawing.origin();
    }

    /// Turns the direction to the left by `angle` (degrees).
    pub fn turn(&mut self, angle: f64) {
        self.state.frame.turn(angle.to_radians());
    }

    /// Pitches the direction down by `angle` (degrees).
    pub fn pitch(&mut self, angle: f64) {
        self.state.frame.pitch(angle.to_radians());
    }

    /// Rolls about the direction by `angle` (degrees).
    pub fn roll(&mut self, angle: f64) {
        self.state.frame.roll(angle.to_radians());
    }

    /// Sets the colour of the surfaces.
    pub fn color(&mut self, color: Color) {
        Arc::make_mut(&mut self.state.material).base_color = color.0;
    }

    /// Sets the whole material of the surfaces.
    pub fn material(&mut self, material: MaterialOptions) -> Result<()> {
        self.state.material = Arc::new(material.material()?);
        Ok(())
    }

    /// Draws `faces` in the extruder's frame, each a list of the numbers of its corners among `points` (m), such as {
    /// 1, 2, 3 }.
    ///
    /// For many faces, pass buffers: points of three 32-bit floats, and triangles of three 32-bit integers, which
    /// number the points from 0. `options` sets shading and colours.
    pub fn mesh(&mut self, points: MeshPoints, faces: MeshFaces, options: Option<MeshOptions>) -> Result<()> {
        let to = ("extruder", &mut self.drawing, &*self.state.material);
        draw_mesh(to, &self.state.frame.transform(), &points, &faces, &options.unwrap_or_default())
    }

    /// Draws the faces of a shape in the extruder's frame, in their own colours, or else in `color`, that of the extruder unless
    /// given.
    pub fn shape(&mut self, shape: Arc<ShapeObject>, color: Option<Color>) -> Result<()> {
        let transform = self.state.frame.transform();
        let to = ShapeTarget { drawing: &mut self.drawing, base: &self.state.material, color };
        let warning = draw_shape(to, &transform, &shape)?;
        self.warnings.extend(warning);
        Ok(())
    }

    /// Places another system's model at the extruder's frame, with this `scale` (1 unless given), which may be a vector
    /// with a scale for each axis of the model.
    pub fn place(&mut self, model: Arc<Model>, scale: Option<AxisScale>) {
        let scale = DAffine3::from_scale(scale.unwrap_or_default().0);
        self.drawing.place(&model, self.state.frame.transform() * scale);
    }

    /// Returns the position (m).
    pub fn position(&self) -> DVec3 {
        self.drawing.origin() + self.state.frame.position
    }

    /// Returns the direction of extrusion.
    pub fn heading(&self) -> DVec3 {
        self.state.frame.heading
    }

    /// Returns the distance (m) from a position to the nearest point of the drawn model.
    pub fn distance(&self, place: Vector) -> f64 {
        self.drawing.distance(place.0 - self.drawing.origin())
    }

    /// Returns the number of edges left open by missing caps and open sections.
    pub fn open_edges(&self) -> u32 {
        u32::try_from(self.open_edges).unwrap_or(u32::MAX)
    }
}

/// Converts rings of points to rings in the plane of a section, by their x and y.
fn flatten(rings: impl IntoIterator<Item = Vec<DVec3>>) -> Rings<DVec2> {
    rings.into_iter().map(|ring| ring.iter().map(|point| point.truncate()).collect()).collect()
}

/// Returns the section with its corners marked as smooth or sharp.
fn shade(section: Section, smooth: bool) -> Section {
    if smooth { section.creased(CREASE.to_radians()) } else { section.marked(false) }
}

impl Extruder {
    /// Creates an extruder in its initial state.
    pub fn new(options: ExtruderOptions) -> Result<Self> {
        check_resolution(options.along, options.around)?;
        if options.heading.0.length_squared() < 1e-24 {
            return Err(Error::argument("extruder: heading has no length"));
        }
        let section = if options.shape.is_empty() {
            Section::regular(options.sides as usize)?
        } else {
            shade(Section::polygon(&flatten([Path::from(options.shape.clone()).points]))?, options.smooth)
        };
        let section = Arc::new(section);
        let state = ExtruderState::begin(&options, &section);
        let drawing = Drawing::at(options.position.0);
        Ok(Self {
            options,
            first_section: section,
            state,
            stack: FrameStack::default(),
            known: Vec::new(),
            drawing,
            open_edges: 0,
            warnings: Vec::new(),
        })
    }

    /// Sets the cross-section to `shape`.
    fn set(&mut self, shape: SectionShape) -> Result<()> {
        let index = match self.known.iter().position(|(known, _)| *known == shape) {
            Some(index) => index,
            None => {
                let section = Arc::new(match shape {
                    SectionShape::Regular(sides) => Section::regular(sides as usize)?,
                    SectionShape::Star(points, inner) => Section::star(points as usize, inner)?,
                    SectionShape::Rectangle(width, height) => Section::rectangle(width, height)?,
                });
                if self.known.len() == KNOWN {
                    self.known.remove(0);
                }
                self.known.push((shape, section));
                self.known.len() - 1
            }
        };
        self.state.section = Arc::clone(&self.known[index].1);
        Ok(())
    }

    fn segment(&mut self, length: f64) -> Result<()> {
        let state = &mut self.state;
        if state.scale == DVec2::ZERO && state.taper == DVec2::ZERO {
            let text = "extruder:extrude draws nothing if the scale is 0";
            let help = "use a scale above 0, or advance without drawing: this:advance(length)";
            self.warnings.push(Warning::new(WarningKind::DrawsNothing, text).help(help).of_all());
        }
        let section = if state.around > 0 {
            Arc::new(state.section.resampled(state.around as usize)?)
        } else {
            Arc::clone(&state.section)
        };
        let mut segment = Segment {
            length,
            bend: state.bend,
            toward: state.toward,
            twist: state.twist,
            from: state.scale,
            to: state.taper,
            steps: state.along as usize,
            sharp: !state.smooth,
        };
        if segment.steps == 0 {
            segment.steps = segment.steps_for(10f64.to_radians());
        }
        let joint = state.run.as_ref().and_then(|run| {
            let is_alike = run.scale == state.scale
                && (Arc::ptr_eq(&run.section, &section) || run.section == section)
                && run.smooth == state.smooth
                && run.caps == state.caps
                && (Arc::ptr_eq(&run.material, &state.material) || run.material == state.material);
            if is_alike { Joint::between(run, state.frame, &segment) } else { None }
        });
        if joint.is_none() {
            self.close()?;
        }
        let state = &mut self.state;
        let mut stations: SmallVec<[Station; 2]> = SmallVec::new();
        let end = segment.stations(state.frame, &mut stations)?;
        self.warnings.extend(bend_warning(&segment, &section, &stations));
        let maker = self.drawing.maker();
        let free = segment.length / segment.steps as f64;
        match state.run.as_mut().zip(joint) {
            Some((run, joint)) => {
                let steps = segment.steps as f64;
                for (step, station) in stations.iter_mut().enumerate() {
                    station.twist -= joint.roll * (1.0 - step as f64 / steps);
                }
                run.stations.extend(stations.into_iter().skip(usize::from(joint.is_straight)));
                run.makers.resize(run.stations.len(), maker);
                run.end = end;
                run.scale = state.taper;
                run.free = if segment.steps == 1 { free - joint.length } else { free };
            }
            None => {
                state.run = Some(SolidRun {
                    makers: smallvec![maker; stations.len()],
                    stations,
                    section,
                    end,
                    free,
                    scale: state.taper,
                    smooth: state.smooth,
                    caps: state.caps,
                    material: state.material.clone(),
                });
            }
        }
        state.frame = end;
        state.scale = state.taper;
        let run = state.run.as_ref();
        self.drawing.expect(run.map_or(0, |run| 2 * run.stations.len() * run.section.corners()));
        Ok(())
    }

    /// Builds the solid of the segments so far.
    fn close(&mut self) -> Result<()> {
        let Some(run) = self.state.run.take() else { return Ok(()) };
        self.drawing.expect(0);
        let options = SweepOptions {
            around: run.smooth,
            along: run.smooth,
            start_cap: run.caps[0],
            end_cap: run.caps[1],
            ..SweepOptions::default()
        };
        let part = self.drawing.material(&run.material);
        // Triangles drawn earlier by the current module are assigned to it first.
        self.drawing.draw_for(self.drawing.maker(), part, |_| ());
        let swept = sweep(self.drawing.part(part), &run.section, &run.stations, &options)?;
        for (station, count) in &swept.reached {
            self.drawing.made(run.makers[*station], part, *count);
        }
        self.open_edges += swept.open.len();
        Ok(())
    }
}

impl Extruder {
    fn restart(&mut self) {
        self.state = ExtruderState::begin(&self.options, &self.first_section);
        self.stack.clear();
        self.drawing.clear();
        self.open_edges = 0;
    }

    fn open_branch(&mut self) {
        let run = self.state.run.take();
        self.stack.push(ExtruderState { run, ..self.state.clone() });
    }

    fn close_branch(&mut self) -> Result<()> {
        self.close()?;
        let Self { stack, state, .. } = self;
        stack.pop_with(|outer| std::mem::swap(state, outer));
        Ok(())
    }

    fn finish(&mut self) -> Result<()> {
        self.close()
    }
}

/// State of an extruder in a pass, without what it has drawn.
struct ExtruderMark {
    state: ExtruderState,
    stack: FrameStackMark<ExtruderState>,
    drawing: DrawingMark,
    open_edges: usize,
}

impl Rewind for Extruder {
    fn mark_size(&self) -> usize {
        self.state.run.as_ref().map_or(0, |run| run.stations.len())
    }

    fn mark(&mut self) -> Box<dyn Any + Send + Sync> {
        Box::new(ExtruderMark {
            state: self.state.clone(),
            stack: self.stack.mark(),
            drawing: self.drawing.mark(),
            open_edges: self.open_edges,
        })
    }

    fn rewind(&mut self, mark: &(dyn Any + Send + Sync)) -> bool {
        let Some(mark) = mark.downcast_ref::<ExtruderMark>() else { return false };
        self.state.clone_from(&mark.state);
        self.stack.rewind(&mark.stack);
        self.drawing.rewind(&mark.drawing);
        self.open_edges = mark.open_edges;
        true
    }
}

impl Locate for Extruder {
    fn place(&self) -> ObjectPlace {
        let Frame { heading, left, up, .. } = self.state.frame;
        ObjectPlace { position: self.position(), heading, left, up }
    }
}

impl Warn for Extruder {
    fn take_warnings(&mut self) -> Vec<Warning> {
        std::mem::take(&mut self.warnings)
    }
}
