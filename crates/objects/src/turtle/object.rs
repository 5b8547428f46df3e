//! The turtle: walks, turns and draws branches, polygons and instances.

use std::sync::Arc;

use glam::{DAffine3, DVec3};

use super::angles::Angles;
use super::cylinder::{CylinderOptions, OpenCylinder, already_open, not_open};
use super::joined::JoinedBranches;
use super::options::TurtleOptions;
use super::state::TurtleState;
use super::tropism::SimpleTropism;
use crate::MaterialOptions;
use crate::curves::curve::CurveObject;
use crate::curves::surface::SurfaceObject;
use crate::frame_stack::FrameStack;
use crate::mesh::{MeshFaces, MeshOptions, MeshPoints, draw_mesh};
use crate::shapes::{ShapeObject, ShapeTarget, draw_shape};
use burgeon_base::error::{Error, Result};
use burgeon_base::warning::{Warning, WarningKind};
use burgeon_geometry::{Frame, face, sphere};
use burgeon_kit::{
    AxisScale, Color, Drawing, Locate, Model, ObjectPlace, Rescale, Rewind, TableOf, Vector, Warn, methods,
    object,
};

/// A turtle as in The Algorithmic Beauty of Plants, which draws round branches in three dimensions.
///
/// ```
/// use burgeon_kit::Object;
/// use burgeon_objects::Turtle;
/// use glam::DVec3;
///
/// let mut turtle = Turtle::new(Default::default())?;
/// turtle.forward(Some(2.0))?;
/// turtle.push();
/// turtle.turn(Some(90.0));
/// turtle.forward(None)?;
/// assert!(turtle.position().abs_diff_eq(DVec3::new(-1.0, 0.0, 2.0), 1e-9));
/// turtle.pop()?;
/// assert_eq!(turtle.position(), DVec3::new(0.0, 0.0, 2.0));
/// # Ok::<(), burgeon_base::Error>(())
/// ```
#[object(
    "turtle",
    options = TurtleOptions,
    example = include_str!("../../scripts/turtle.lua"),
    draws,
    can(Warn, Locate, Rescale, Rewind),
    begins_empty,
    begin = restart,
    push = open_branch,
    pop = close_branch,
    end = finish
)]
pub struct Turtle {
    pub(super) options: TurtleOptions,
    pub(super) state: TurtleState,
    pub(super) stack: FrameStack<TurtleState>,
    pub(super) drawing: Drawing,
    pub(super) angles: Angles,
    pub(super) polygons: Vec<Vec<DVec3>>,
    /// Branches that the end draws as one surface, if `turtle.joints` is "smooth".
    pub(super) joined: Option<JoinedBranches>,
    pub(super) warnings: Vec<Warning>,
}

#[methods("turtle")]
impl Turtle {
    /// Moves forward by `length` (m, turtle.step unless given) and draws a branch. Within a polygon, only moves.
    pub fn forward(&mut self, length: Option<f64>) -> Result<()> {
        self.draw(self.length(length))
    }

    /// Moves forward by `length` (m, turtle.step unless given) without drawing.
    pub fn advance(&mut self, length: Option<f64>) {
        self.leave();
        let length = self.length(length);
        self.state.frame.forward(length);
        self.state.apply_simple_tropism();
    }

    /// Turns to the left by `angle` (degrees, turtle.angle unless given); a negative angle turns right.
    pub fn turn(&mut self, angle: Option<f64>) {
        let angle = self.angle(angle);
        self.state.frame.turn_by(angle);
    }

    /// Pitches down by `angle` (degrees, turtle.angle unless given); a negative angle pitches up.
    pub fn pitch(&mut self, angle: Option<f64>) {
        let angle = self.angle(angle);
        self.state.frame.pitch_by(angle);
    }

    /// Rolls about the heading by `angle` (degrees, turtle.angle unless given), the left side up; a negative angle
    /// rolls back.
    pub fn roll(&mut self, angle: Option<f64>) {
        let angle = self.angle(angle);
        self.state.frame.roll_by(angle);
    }

    /// Turns to the right by `angle` (degrees, turtle.angle unless given).
    pub fn turn_right(&mut self, angle: Option<f64>) {
        let angle = self.angle(angle);
        self.state.frame.turn_by((-angle.0, angle.1));
    }

    /// Pitches up by `angle` (degrees, turtle.angle unless given).
    pub fn pitch_up(&mut self, angle: Option<f64>) {
        let angle = self.angle(angle);
        self.state.frame.pitch_by((-angle.0, angle.1));
    }

    /// Rolls about the heading by `angle` (degrees, turtle.angle unless given), the right side up.
    pub fn roll_back(&mut self, angle: Option<f64>) {
        let angle = self.angle(angle);
        self.state.frame.roll_by((-angle.0, angle.1));
    }

    /// Turns around.
    pub fn turn_around(&mut self) {
        self.state.frame.turn(std::f64::consts::PI);
    }

    /// Rolls so that the left side is horizontal.
    pub fn level(&mut self) {
        self.state.frame.level();
    }

    /// Turns the heading to `direction`.
    pub fn face(&mut self, direction: Vector) -> Result<()> {
        if direction.0.length_squared() < 1e-24 {
            return Err(
                Error::argument("turtle:face: direction has no length").help("use a vector that is not zero")
            );
        }
        self.state.frame.face(direction.0);
        Ok(())
    }

    /// Moves to a position (m) without drawing.
    pub fn jump(&mut self, position: Vector) {
        self.leave();
        self.state.frame.position = position.0 - self.drawing.origin();
    }

    /// Turns the heading to a position (m), moves there and draws a branch. Within a polygon, only moves. Tropisms bend the
    /// heading after the branch.
    pub fn line_to(&mut self, position: Vector) -> Result<()> {
        let to = position.0 - self.drawing.origin();
        let way = to - self.state.frame.position;
        if way.length_squared() < 1e-24 {
            let text = "turtle:line_to: the turtle is already at this position, so nothing is drawn";
            self.warnings.push(
                Warning::new(WarningKind::DrawsNothing, text).help("use a position at a distance").of_all(),
            );
            return Ok(());
        }
        self.state.frame.face(way);
        self.draw(way.length())
    }

    /// Sets the diameter of branches to `width` (m). A branch tapers to it along the next step.
    pub fn width(&mut self, width: f64) -> Result<()> {
        if width < 0.0 {
            return Err(Error::argument(format!("turtle:width: width must be at least 0, not {width}")));
        }
        self.state.width = width * self.state.scale;
        Ok(())
    }

    /// Multiplies all lengths and widths from now on by `factor`, until the end of the branch.
    pub fn scale(&mut self, factor: f64) -> Result<()> {
        self.state.rescale(factor).map_err(|error| error.about("turtle:scale"))
    }

    /// Sets the colour of the surfaces.
    pub fn color(&mut self, color: Color) {
        self.paint_with(color);
    }

    /// Selects a colour of the palette, by its number from 1.
    pub fn paint(&mut self, number: u32) -> Result<()> {
        let color = (number as usize).checked_sub(1).and_then(|index| self.options.palette.get(index));
        let Some(color) = color else {
            return Err(Error::argument(format!(
                "turtle:paint: unknown colour number {number} of the palette"
            ))
            .help(format!(
                "the palette has {}; set it with turtle {{ palette = {{ \"#2f6b3a\", ... }} }}",
                self.options.palette.len()
            )));
        };
        self.paint_with(*color);
        Ok(())
    }

    /// Sets the whole material of the surfaces.
    pub fn material(&mut self, material: MaterialOptions) -> Result<()> {
        self.state.part = self.drawing.material(&material.material()?);
        Ok(())
    }

    /// Bends the heading towards `direction` with each step drawn, by `elasticity`.
    pub fn tropism(&mut self, direction: Vector, elasticity: f64) {
        self.warn_of_direction("tropism", direction, elasticity);
        self.state.tropism = direction.0.normalize_or_zero();
        self.state.elasticity = elasticity;
    }

    /// Adds a tropism to the others: the heading bends by `elasticity` until it makes `angle` (degrees) with `direction`, 0
    /// unless given. With an angle of 90, branches grow across the direction.
    pub fn add_tropism(&mut self, direction: Vector, elasticity: f64, angle: Option<f64>) -> Result<()> {
        self.warn_of_direction("add_tropism", direction, elasticity);
        self.state.add_tropism(direction.0, elasticity, angle.unwrap_or(0.0))
    }

    /// Adds a torque to the others: with each step drawn, the turtle rolls about its heading, and its up vector approaches
    /// `direction` by `elasticity`, at most by 1 radian. Leaves then turn to one side of a branch.
    pub fn add_torque(&mut self, direction: Vector, elasticity: f64) -> Result<()> {
        self.warn_of_direction("add_torque", direction, elasticity);
        self.state.add_torque(direction.0, elasticity)
    }

    /// Sets the strength with which the heading bends with each step drawn.
    pub fn elasticity(&mut self, elasticity: f64) {
        self.state.elasticity = elasticity;
    }

    /// Sets the simple tropism of cpfg and lpfg: after each step, drawn or not, the heading tilts towards `direction` by
    /// `elasticity`.
    pub fn simple_tropism(&mut self, direction: Vector, elasticity: f64) {
        self.warn_of_direction("simple_tropism", direction, elasticity);
        self.state.simple = SimpleTropism::new(direction.0, elasticity);
    }

    /// Sets the strength of the simple tropism; without a value, adds `turtle.simple_increment` to it.
    pub fn simple_elasticity(&mut self, elasticity: Option<f64>) {
        let increment = self.options.simple_increment;
        if elasticity.is_none() && increment == 0.0 {
            let text =
                "turtle:simple_elasticity: without a value, it adds turtle.simple_increment, which is 0";
            let warning = Warning::new(WarningKind::NoEffect, text);
            self.warnings.push(
                warning
                    .help("give a value, as _(0.05) in strings, or turtle({ simple_increment = 0.05 })")
                    .of_all(),
            );
        }
        let simple = &mut self.state.simple;
        simple.elasticity = elasticity.unwrap_or(simple.elasticity + increment);
    }

    /// Begins a polygon: `point` adds its corners, `end_polygon` fills it.
    pub fn begin_polygon(&mut self) {
        self.leave();
        self.polygons.push(Vec::new());
    }

    /// Adds the turtle's position to the current polygon.
    pub fn point(&mut self) -> Result<()> {
        let position = self.state.frame.position;
        match self.polygons.last_mut() {
            Some(polygon) => polygon.push(position),
            None => return Err(no_polygon("point")),
        }
        Ok(())
    }

    /// Fills the current polygon, which is visible from both sides.
    pub fn end_polygon(&mut self) -> Result<()> {
        let Some(corners) = self.polygons.pop() else { return Err(no_polygon("end_polygon")) };
        let part = self.two_sided();
        face(self.drawing.part(part), &corners)
    }

    /// Begins a generalised cylinder, a smooth surface with the turtle's width and contour: `forward` adds control points
    /// of its axis, `end_cylinder` or the end of the branch completes it.
    ///
    /// It does not twist: turns about the heading have no effect on it, unless the options set `twist`. Moving without drawing
    /// adds no point.
    pub fn begin_cylinder(&mut self, options: Option<TableOf<CylinderOptions>>) -> Result<()> {
        let CylinderOptions { twist } = options.unwrap_or_default().read()?;
        self.lift();
        if self.state.cylinder.is_some() || self.state.joined.in_cylinder {
            return Err(already_open());
        }
        if let Some(joined) = &mut self.joined {
            joined.begin_cylinder(&mut self.state, self.drawing.maker(), twist);
            return Ok(());
        }
        let cylinder = OpenCylinder::begin(&self.drawing, self.state.part, &self.state.frame, twist);
        self.state.cylinder = Some(Box::new(cylinder));
        self.control();
        Ok(())
    }

    /// Sets the contour of generalised cylinders, a closed curve in the plane z = 0; a circle if omitted. It is scaled
    /// by half of the width. A cylinder blends to it along the next step.
    pub fn contour(&mut self, contour: Option<Arc<CurveObject>>) -> Result<()> {
        let curve = contour.as_deref().map(CurveObject::contour).transpose();
        self.state.contour = curve.map_err(|error| error.about("turtle:contour"))?.cloned();
        Ok(())
    }

    /// Completes and draws the generalised cylinder: one closed surface, with flat ends, or tips where the width is 0.
    pub fn end_cylinder(&mut self) -> Result<()> {
        let is_open = self.state.cylinder.is_some() || self.state.joined.in_cylinder;
        if is_open { self.close_cylinder() } else { Err(not_open()) }
    }

    /// Draws a surface in the turtle's frame, with this `scale` (1 unless given), which may be a vector with a scale for
    /// each axis of the surface. It is visible from both sides, and its texture covers it once with a size of 1 m.
    pub fn surface(&mut self, surface: Arc<SurfaceObject>, scale: Option<AxisScale>) -> Result<()> {
        let part = self.two_sided();
        let scale = DAffine3::from_scale(scale.unwrap_or_default().0);
        surface.draw(self.drawing.part(part), &(self.state.transform() * scale))
    }

    /// Draws a sphere with `radius` (m) around the turtle's position.
    pub fn sphere(&mut self, radius: f64) -> Result<()> {
        let sides = self.options.sides.max(6);
        let radius = radius * self.state.scale;
        sphere(self.drawing.part(self.state.part), self.state.frame.position, radius, sides)
    }

    /// Draws the faces of a shape in the turtle's frame, in their own colours, or else in `color`, that of the turtle unless given.
    pub fn shape(&mut self, shape: Arc<ShapeObject>, color: Option<Color>) -> Result<()> {
        let base = self.drawing.material_of(self.state.part);
        let transform = self.state.transform();
        let to = ShapeTarget { drawing: &mut self.drawing, base: &base, color };
        let warning = draw_shape(to, &transform, &shape)?;
        self.warnings.extend(warning);
        Ok(())
    }

    /// Places another system's model at the turtle's frame, with this `scale` (1 unless given), which may be a vector
    /// with a scale for each axis of the model.
    pub fn place(&mut self, model: Arc<Model>, scale: Option<AxisScale>) {
        let scale = DAffine3::from_scale(scale.unwrap_or_default().0);
        self.drawing.place(&model, self.state.transform() * scale);
    }

    /// Draws `faces` in the turtle's frame, each a list of the numbers of its corners among `points` (m), such as { 1,
    /// 2, 3 }.
    ///
    /// For many faces, pass buffers: points of three 32-bit floats, and triangles of three 32-bit integers, which
    /// number the points from 0. `options` sets shading and colours.
    pub fn mesh(&mut self, points: MeshPoints, faces: MeshFaces, options: Option<MeshOptions>) -> Result<()> {
        let base = self.drawing.material_of(self.state.part);
        let to = ("turtle", &mut self.drawing, &*base);
        draw_mesh(to, &self.state.transform(), &points, &faces, &options.unwrap_or_default())
    }

    /// Returns the position (m).
    pub fn position(&self) -> DVec3 {
        self.drawing.origin() + self.state.frame.position
    }

    /// Returns the heading.
    pub fn heading(&self) -> DVec3 {
        self.state.frame.heading
    }

    /// Returns the direction to the left.
    pub fn left(&self) -> DVec3 {
        self.state.frame.left
    }

    /// Returns the upward direction of the turtle.
    pub fn up(&self) -> DVec3 {
        self.state.frame.up
    }

    /// Returns the distance (m) from a position to the nearest point of the drawn model.
    pub fn distance(&self, place: Vector) -> f64 {
        self.drawing.distance(place.0 - self.drawing.origin())
    }
}

impl Warn for Turtle {
    fn take_warnings(&mut self) -> Vec<Warning> {
        std::mem::take(&mut self.warnings)
    }
}

impl Locate for Turtle {
    fn place(&self) -> ObjectPlace {
        let Frame { heading, left, up, .. } = self.state.frame;
        ObjectPlace { position: self.position(), heading, left, up }
    }
}

#[cold]
fn no_polygon(method: &str) -> Error {
    Error::script(format!("turtle:{method}: no polygon is open")).help("begin it with BeginPolygon()")
}

impl Turtle {
    /// Warns of a tropism or a torque without a direction.
    fn warn_of_direction(&mut self, method: &str, direction: Vector, elasticity: f64) {
        if elasticity != 0.0 && direction.0.normalize_or_zero() == DVec3::ZERO {
            let text = format!("turtle:{method}: the direction has no length, so it bends nothing");
            let help = "give a direction, such as { 0, 0, -1 }, or the elasticity 0";
            self.warnings.push(Warning::new(WarningKind::NoEffect, text).help(help).of_all());
        }
    }

    /// Creates a turtle in its initial state.
    pub fn new(options: TurtleOptions) -> Result<Self> {
        if !(3..=64).contains(&options.sides) {
            return Err(Error::argument(format!(
                "turtle: sides must be from 3 to 64, not {}",
                options.sides
            )));
        }
        if options.width < 0.0 {
            return Err(Error::argument(format!("turtle: width must be at least 0, not {}", options.width)));
        }
        if options.heading.0.length_squared() < 1e-24 {
            return Err(Error::argument("turtle: heading has no length"));
        }
        let joined = options.joins()?.then(JoinedBranches::default);
        let mut drawing = Drawing::at(options.position.0);
        let state = TurtleState::begin(&options, &mut drawing);
        Ok(Self {
            options,
            state,
            stack: FrameStack::default(),
            drawing,
            angles: Angles::default(),
            polygons: Vec::new(),
            joined,
            warnings: Vec::new(),
        })
    }
}
