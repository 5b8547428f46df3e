//! The layout of a wall over a frontage: its faces and models, and their positions.

use glam::{DVec2, DVec3};

use super::fixture::Fixture;
use super::grid::count;
use super::wall::{Wall, WallRule};
use burgeon_scene::{Material, SurfaceMeaning};

/// A part of a frontage: its lower left corner and its size (m).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rectangle {
    /// Position relative to the frontage's lower left corner.
    pub at: DVec2,
    /// Width and height.
    pub size: DVec2,
}

/// A rectangle in the frontage's coordinates (m): x to the right, y upwards, z out of the building.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FacadeFace<'a> {
    /// Lower left corner.
    pub at: DVec3,
    /// Vector along the lower side, from that corner.
    pub right: DVec3,
    /// Vector along the left side, from that corner.
    pub up: DVec3,
    /// Material of the face; the template's if `None`.
    pub material: Option<&'a Material>,
    /// Set if the material's image covers the face once.
    pub stretched: bool,
    /// Meaning of the surface.
    pub meaning: SurfaceMeaning,
}

impl<'a> FacadeFace<'a> {
    /// Creates a face of a wall with the template's material.
    pub fn new(at: DVec3, right: DVec3, up: DVec3) -> Self {
        Self { at, right, up, material: None, stretched: false, meaning: SurfaceMeaning::Wall }
    }

    /// Returns this face with another material and meaning.
    #[must_use]
    pub fn of(self, material: Option<&'a Material>, stretched: bool, meaning: SurfaceMeaning) -> Self {
        Self { material, stretched, meaning, ..self }
    }
}

/// The layout of a wall. Faces without area are omitted.
#[derive(Default)]
pub struct FacadeLayout<'a> {
    /// Faces of the wall.
    pub faces: Vec<FacadeFace<'a>>,
    /// Models, each with the lower left corner (m) and the size of the part of the wall that it is on.
    pub(super) fixtures: Vec<(&'a Fixture, DVec3, DVec2)>,
    /// Set if the layout was abandoned because it has more than [`MOST`] faces or models.
    pub too_many: bool,
}

impl std::fmt::Debug for FacadeLayout<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("FacadeLayout").field("faces", &self.faces).finish_non_exhaustive()
    }
}

/// Maximum number of faces or models of a frontage.
pub const MOST: usize = 2_000_000;

/// Minimum side length (m) of a face.
const NONE: f64 = 1e-6;

impl<'a> FacadeLayout<'a> {
    /// Clears the layout but keeps its memory.
    pub fn clear(&mut self) {
        self.faces.clear();
        self.fixtures.clear();
        self.too_many = false;
    }

    /// Lays out `wall` over `over`, `depth` (m) in front of the frontage. Returns false if the wall does not fit or has
    /// too many faces.
    ///
    /// ```
    /// use burgeon_kit::{Parameter, Table, TableKey, Value};
    /// use burgeon_objects::Wall;
    /// use burgeon_objects::facade::{FacadeLayout, Rectangle, grid, panel};
    /// use glam::{DVec2, DVec3};
    ///
    /// let table = |fields: &[(&str, Value)]| {
    ///     let entries = fields.iter().map(|(name, value)| (TableKey::Name((*name).into()), value.clone()));
    ///     Table { class: None, entries: entries.collect() }
    /// };
    /// // Panels 1 to 2 m wide and 3 m high, in a row.
    /// let sizes = table(&[("width", vec![1.0, 2.0].into_value()), ("height", Value::Number(3.0))]);
    /// let bay = Value::Object(panel::kind().make(&sizes)?.into());
    /// let row = table(&[("wall", bay), ("columns", vec![1.0, 9.0].into_value()), ("rows", Value::Number(1.0))]);
    /// let wall = Wall::from_value(Value::Object(grid::kind().make(&row)?.into())).expect("a wall");
    /// let mut layout = FacadeLayout::default();
    /// let front = Rectangle { at: DVec2::ZERO, size: DVec2::new(9.0, 3.0) };
    /// assert!(layout.lay(&wall, front, 0.0));
    /// assert_eq!((layout.faces.len(), layout.faces[0].right), (6, DVec3::new(1.5, 0.0, 0.0)));
    /// # Ok::<(), burgeon_base::Error>(())
    /// ```
    pub fn lay(&mut self, wall: &'a Wall, over: Rectangle, depth: f64) -> bool {
        let inner = &*wall.0;
        let material = inner.material.as_ref();
        let Rectangle { at, size } = over;
        match &inner.rule {
            WallRule::Panel { decoration, fixture, background, meaning } => {
                if *background {
                    let (material, stretched) = match decoration.as_deref() {
                        Some(decoration) => (Some(decoration), true),
                        None => (material, false),
                    };
                    let face = self.front(over, depth).of(material, stretched, *meaning);
                    self.face(face);
                }
                self.fixture(fixture.as_ref(), over, depth);
                true
            }
            WallRule::Bordered { columns, rows, wall } => {
                let (Some(columns), Some(rows)) = (columns.divide(size.x), rows.divide(size.y)) else {
                    return false;
                };
                let low = at + DVec2::new(columns[0], rows[0]);
                let high = low + DVec2::new(columns[1], rows[1]);
                let mut margin = |at: DVec2, size: DVec2| {
                    let face = FacadeFace { material, ..self.front(Rectangle { at, size }, depth) };
                    self.face(face);
                };
                margin(at, DVec2::new(columns[0], size.y));
                margin(DVec2::new(low.x, at.y), DVec2::new(columns[1], rows[0]));
                margin(DVec2::new(low.x, high.y), DVec2::new(columns[1], rows[2]));
                margin(DVec2::new(high.x, at.y), DVec2::new(columns[2], size.y));
                self.lay(wall, Rectangle { at: low, size: high - low }, depth)
            }
            WallRule::Extruded { depth: by, sides, fixture, wall } => {
                let out = DVec3::new(0.0, 0.0, *by);
                let (right, up) = (DVec3::new(size.x, 0.0, 0.0), DVec3::new(0.0, size.y, 0.0));
                let corner = at.extend(depth);
                // Side faces are seen from outside, or from inside if the wall is recessed.
                let faces = [
                    (corner, out, up),
                    (corner + right + out, -out, up),
                    (corner, right, out),
                    (corner + up + out, right, -out),
                ];
                for ((at, right, up), shown) in faces.into_iter().zip(sides) {
                    if *shown {
                        self.face(FacadeFace { material, ..FacadeFace::new(at, right, up) });
                    }
                }
                self.fixture(fixture.as_ref(), over, depth);
                self.lay(wall, over, depth + by)
            }
            WallRule::List { upwards, split, walls } => {
                let along = if *upwards { DVec2::Y } else { DVec2::X };
                let Some(lengths) = split.divide(size.dot(along)) else { return false };
                let mut at = at;
                for (wall, length) in walls.iter().zip(lengths) {
                    let size = along * length + size * (DVec2::ONE - along);
                    if !self.lay(wall, Rectangle { at, size }, depth) {
                        return false;
                    }
                    at += along * length;
                }
                true
            }
            WallRule::Grid { counts, wall } => {
                let number =
                    |side: usize| count(size[side], &counts[side], &wall.0.sizes[side], wall.0.targets[side]);
                let (Some(columns), Some(rows)) = (number(0), number(1)) else { return false };
                self.grid(wall, over, [columns, rows], depth)
            }
        }
    }

    /// Lays out one cell and repeats it.
    fn grid(&mut self, wall: &'a Wall, over: Rectangle, [columns, rows]: [u32; 2], depth: f64) -> bool {
        let cell = over.size / DVec2::new(f64::from(columns), f64::from(rows));
        let (first_face, first_fixture) = (self.faces.len(), self.fixtures.len());
        if !self.lay(wall, Rectangle { at: over.at, size: cell }, depth) {
            return false;
        }
        let (faces, fixtures) = (self.faces.len(), self.fixtures.len());
        let each = (faces - first_face).max(fixtures - first_fixture);
        if each.saturating_mul(columns as usize * rows as usize) > MOST {
            self.too_many = true;
            return false;
        }
        for (row, column) in (0..rows).flat_map(|row| (0..columns).map(move |column| (row, column))).skip(1) {
            let by = (cell * DVec2::new(f64::from(column), f64::from(row))).extend(0.0);
            for index in first_face..faces {
                let face = self.faces[index];
                self.faces.push(FacadeFace { at: face.at + by, ..face });
            }
            for index in first_fixture..fixtures {
                let (fixture, at, size) = self.fixtures[index];
                self.fixtures.push((fixture, at + by, size));
            }
        }
        true
    }

    /// Returns a face that faces out of the building.
    fn front(&self, over: Rectangle, depth: f64) -> FacadeFace<'a> {
        let (right, up) = (DVec3::new(over.size.x, 0.0, 0.0), DVec3::new(0.0, over.size.y, 0.0));
        FacadeFace::new(over.at.extend(depth), right, up)
    }

    fn face(&mut self, face: FacadeFace<'a>) {
        if face.right.abs().max_element() > NONE && face.up.abs().max_element() > NONE {
            self.faces.push(face);
        }
    }

    fn fixture(&mut self, fixture: Option<&'a Fixture>, over: Rectangle, depth: f64) {
        if let Some(fixture) = fixture {
            self.fixtures.push((fixture, over.at.extend(depth), over.size));
        }
    }

    /// Returns the models, each with its origin in the frontage (m) and its scale along x, y and z.
    pub fn models(&self) -> impl Iterator<Item = (&'a Fixture, DVec3, DVec3)> + '_ {
        self.fixtures.iter().map(|&(fixture, at, size)| {
            let [width, height] = fixture.extent();
            let stretch = |to: f64, from: f64| if fixture.stretch && from > NONE { to / from } else { 1.0 };
            let scale = DVec3::new(stretch(size.x, width), 1.0, stretch(size.y, height));
            let low = fixture.low * scale;
            let x = (size.x - width * scale.x) / 2.0 - low.x;
            let y = (size.y - height * scale.z) * fixture.anchor - low.z;
            (fixture, at + DVec3::new(x, y, 0.0), scale)
        })
    }
}
