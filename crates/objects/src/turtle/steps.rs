//! Steps of a turtle, and the beginning and end of branches and passes.

use burgeon_base::error::{Error, Result};
use burgeon_geometry::Strand;
use burgeon_kit::Color;
use burgeon_scene::Material;

use super::Turtle;
use super::joined::JoinedBranches;
use super::state::{Branch, TurtleState};

impl Turtle {
    /// Returns the scaled `length` (m), or that of a step.
    #[inline]
    pub(super) fn length(&self, length: Option<f64>) -> f64 {
        length.unwrap_or(self.options.step) * self.state.scale
    }

    /// Returns the sine and cosine of `angle` (degrees), or of the default angle.
    #[inline]
    pub(super) fn angle(&mut self, angle: Option<f64>) -> (f64, f64) {
        self.angles.sin_cos(angle.unwrap_or(self.options.angle))
    }

    pub(super) fn paint_with(&mut self, color: Color) {
        let material = self.drawing.material_of(self.state.part);
        self.state.part = self.drawing.material(&Material { base_color: color.0, ..(*material).clone() });
    }

    /// Returns the part with the present material, visible from both sides.
    pub(super) fn two_sided(&mut self) -> usize {
        let material = self.drawing.material_of(self.state.part);
        let material = Material { double_sided: true, ..(*material).clone() };
        self.drawing.material(&material)
    }

    /// Adds a control point at the turtle's position to the open cylinder.
    pub(super) fn control(&mut self) {
        let TurtleState { frame, width, contour, cylinder, .. } = &mut self.state;
        if let Some(cylinder) = cylinder {
            cylinder.add(frame, *width, contour.as_ref());
        }
    }

    /// Draws the open cylinder, if there is one.
    pub(super) fn close_cylinder(&mut self) -> Result<()> {
        self.state.joined.end_cylinder();
        let cylinder = self.state.cylinder.take();
        cylinder.map_or(Ok(()), |cylinder| cylinder.draw(&mut self.drawing, self.options.sides))
    }

    pub(super) fn draw(&mut self, length: f64) -> Result<()> {
        if let Some(joined) = &mut self.joined
            && self.polygons.is_empty()
            && (self.state.width > 0.0 || self.state.joined.in_cylinder)
        {
            joined.prepare(&mut self.state, self.drawing.maker());
            self.state.frame.forward(length);
            joined.add_point(&mut self.state, self.drawing.maker());
        } else if self.state.cylinder.is_some() && self.polygons.is_empty() {
            self.state.frame.forward(length);
            self.control();
        } else if self.polygons.is_empty() && self.state.width > 0.0 {
            let part = self.state.part;
            if self.state.strand.as_ref().is_none_or(|branch| branch.part != part) {
                self.lift();
                let frame = &self.state.frame;
                let sides = self.options.sides as usize;
                let strand = Strand::begin(sides, frame.position, frame.left, self.state.width / 2.0)?;
                self.state.strand = Some(Branch { part, strand, maker: self.drawing.maker() });
            }
            self.state.frame.forward(length);
            let position = self.state.frame.position;
            if let Some(Branch { part, strand, maker }) = &mut self.state.strand {
                // These faces belong to the previous segment, which is drawn only now.
                let radius = self.state.width / 2.0;
                self.drawing.draw_for(*maker, *part, |part| strand.extend_to(part, position, radius))?;
                *maker = self.drawing.maker();
            }
        } else {
            self.leave();
            self.state.frame.forward(length);
        }
        self.state.bend();
        Ok(())
    }

    /// Ends the branch that is being drawn, because the turtle moves without drawing.
    pub(super) fn leave(&mut self) {
        self.lift();
        self.state.joined.leave();
    }

    /// Ends the branch that is being drawn.
    pub(super) fn lift(&mut self) {
        if let Some(Branch { part, strand, maker }) = self.state.strand.take() {
            self.drawing.draw_for(maker, part, |part| strand.end(part));
        }
    }
}

impl Turtle {
    pub(super) fn restart(&mut self) {
        self.stack.clear();
        self.drawing.clear();
        self.state = TurtleState::begin(&self.options, &mut self.drawing);
        self.polygons.clear();
        self.joined.iter_mut().for_each(JoinedBranches::clear);
        self.warnings.clear();
    }

    pub(super) fn open_branch(&mut self) {
        if let Some(joined) = &mut self.joined {
            joined.open(&mut self.state, self.drawing.maker());
        }
        // The new branch starts without a strand; the strand in the copy continues after the branch.
        let cylinder = self.state.cylinder.take();
        self.stack.push(TurtleState { cylinder, ..self.state.clone() });
        self.state.strand = None;
        self.state.joined.end_cylinder();
    }

    pub(super) fn close_branch(&mut self) -> Result<()> {
        self.lift();
        self.close_cylinder()?;
        // Uses `clone_from` because moving the state out of the stack would copy it twice.
        let Self { stack, state, .. } = self;
        stack.pop_with(|outer| {
            let cylinder = outer.cylinder.take();
            state.clone_from(outer);
            state.cylinder = cylinder;
        });
        Ok(())
    }

    pub(super) fn finish(&mut self) -> Result<()> {
        self.lift();
        self.close_cylinder()?;
        if let Some(joined) = &mut self.joined {
            self.warnings.extend(joined.draw(&mut self.drawing, self.options.sides)?);
        }
        if let Some(open) = self.polygons.first() {
            return Err(Error::script(format!(
                "a polygon of {} corners is still open at the end",
                open.len()
            ))
            .help("end it with EndPolygon()"));
        }
        Ok(())
    }
}
