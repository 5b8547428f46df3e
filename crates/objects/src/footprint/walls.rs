//! The walls of a building: plain walls, photos, and facades laid out by templates.

use glam::{DAffine3, DMat3, DVec2, DVec3};

use super::cover::WallSpan;
use super::object::Footprint;
use super::sides::{horizontal_direction, material_of};
use super::state::Plain;
use crate::MaterialOptions;
use crate::facade::lay::MOST;
use crate::facade::template::BLIND;
use crate::facade::{FacadeFace, FacadeLayout, FaceMesh, Joiner, Rectangle, Template, Templates};
use crate::roofs::{Height, check_height};
use burgeon_base::error::{Error, Limit, Result};
use burgeon_base::random::Stream;
use burgeon_base::warning::{Warning, WarningKind};
use burgeon_geometry::{Ring, SAME, fill};
use burgeon_kit::{Color, fields};
use burgeon_scene::{Material, Part, SurfaceMeaning};

/// Options of `footprint:walls { ... }`.
#[fields("footprint:walls")]
pub struct Walls {
    /// Height of the walls (m). If omitted, the footprint's height.
    pub height: Option<Height>,
    /// Facade layout: a facade, a template or a list of templates.
    pub templates: Option<Templates>,
    /// Material whose image covers each frontage once, such as a photo of the building.
    pub photo: Option<MaterialOptions>,
    /// Width and height (m) of one bay of the photo. The photo then repeats in the number of whole bays that fits a
    /// frontage best. Parts of walls that neighbours cover stay plain.
    pub bay: Vec<f64>,
    /// Colour of plain walls, and of templates without a material.
    pub color: Option<Color>,
    /// Material of plain walls, and of templates without a material, instead of the colour.
    pub material: Option<MaterialOptions>,
    /// Convert models on the walls to faces of the building, instead of instances.
    pub expand: bool,
}

impl Walls {
    /// Returns the width and height (m) of a bay of the photo. Fails if there is no photo to repeat.
    fn bay(&self) -> Result<Option<DVec2>> {
        let refused =
            |why: &str, remedy: &str| Error::argument(format!("footprint:walls: {why}")).help(remedy);
        match (&self.bay[..], &self.photo) {
            ([], _) => Ok(None),
            (_, None) => Err(refused("bay needs a photo", "also set photo = { texture = ... }")),
            (&[width, height], Some(photo))
                if width >= 0.1 && height >= 0.1 && !photo.texture_size.is_empty() =>
            {
                Ok(Some(DVec2::new(width, height)))
            }
            _ => Err(refused(
                "bay must be { width, height } in metres, at least 0.1, with a photo that has a texture_size",
                "write bay = { 2.5, 3 } and photo = { texture = ..., texture_size = { 10, 12 } }",
            )),
        }
    }
}

/// A side of the building, over the height of the walls.
#[derive(Debug, Clone, Copy)]
struct Frontage {
    /// Lower left and lower right corner, seen from outside (m).
    ends: [DVec3; 2],
    /// Width and height (m).
    size: DVec2,
    /// Axes to the right, upwards and out of the building.
    axes: DMat3,
    /// Extension (m) of a projection of 1 m beyond the left and the right end, to meet the projection around the
    /// corner.
    miters: [f64; 2],
    /// Start of texture coordinates: the distances around the building and above the ground (m).
    passed: DVec2,
    /// Height (m) that a neighbour covers, from the bottom.
    covered: f64,
    /// Edge to which the frontage belongs.
    edge: usize,
}

/// Width (m) below which a frontage without a template is a remark and no warning: such edges come from rounded corners.
const NARROW: f64 = 1.0;

/// Maximum extension of a mitre beyond a corner, per metre of projection.
const STEEPEST_MITER: f64 = 1.5;

/// Returns the warning that no template fits a frontage of this width and height (m). The message has no size, so that the
/// frontages of all buildings are one warning.
fn plain_warning(size: DVec2) -> Warning {
    let text = "footprint:walls: no template fits a frontage, so its wall stays plain";
    let help = format!(
        "the first is {:.2} m wide and {:.2} m high: allow this size in a template, or give a template that fits all sizes, \
         such as template(panel({{}}), {{ weight = 0 }}); --report FILE lists the others",
        size.x, size.y
    );
    Warning::new(WarningKind::Doubtful, text).help(help)
}

impl Footprint {
    pub(super) fn raise(&mut self, options: &Walls) -> Result<()> {
        self.check_open("walls")?;
        let Some(Height(height)) = options.height.or(self.options.height) else {
            return Err(Error::argument("footprint:walls: missing height of the walls or the footprint")
                .help("write this:walls { height = 6 }")
                .of_data());
        };
        check_height("footprint:walls: height", height)?;
        if !self.shell.begun {
            self.lay("z_min", options.material.as_ref())?;
        }
        let (from, to) = (self.shell.top, self.shell.top + height);
        self.shell.top = to;
        self.raised += 1;
        if self.detail == 0 {
            return Ok(());
        }
        let bay = options.bay()?;
        let of_template = options.templates.as_ref().and_then(Templates::first).and_then(Template::material);
        let plain = match (&options.material, options.color, of_template) {
            (None, None, Some(material)) => self.drawing.material(material),
            (material, color, _) => self.part(color, material.as_ref())?,
        };
        (0..self.plan.polygon().size()).for_each(|edge| self.note_part(edge, plain));
        if self.detail < 3 {
            if self.plain.is_none_or(|known| known.part != plain) {
                self.finish_walls_up_to(from)?;
                self.plain = Some(Plain { from, part: plain, maker: self.drawing.maker() });
            }
            return Ok(());
        }
        match (&options.templates, &options.photo) {
            (None, None) => self.draw_plain(plain, from, to),
            (None, Some(photo)) => self.draw_photo(&photo.material()?, bay, plain, from, to),
            (Some(templates), None) => {
                let bare = self.material(options.color, options.material.as_ref())?;
                self.draw_facades(templates, (&bare, plain), options.expand, from, to)
            }
            (Some(_), Some(_)) => Err(Error::argument("footprint:walls: templates and photo are both set")
                .help("remove one of them")),
        }
    }

    /// Draws the pending plain walls.
    pub(super) fn finish_walls(&mut self) -> Result<()> {
        self.finish_walls_up_to(self.shell.top)
    }

    fn finish_walls_up_to(&mut self, top: f64) -> Result<()> {
        let Some(Plain { from, part, maker }) = self.plain.take() else { return Ok(()) };
        let done = self.drawing.triangles_of(part);
        self.drawing.made(self.drawing.maker(), part, done);
        self.draw_plain(part, from, top)?;
        let count = self.drawing.triangles_of(part);
        self.drawing.made(maker, part, count);
        Ok(())
    }

    fn draw_plain(&mut self, part: usize, from: f64, to: f64) -> Result<()> {
        for frontage in self.frontages(from, to) {
            frontage.fill(self.drawing.surface(part, SurfaceMeaning::Wall))?;
        }
        Ok(())
    }

    fn draw_photo(
        &mut self,
        photo: &Material,
        bay: Option<DVec2>,
        plain: usize,
        from: f64,
        to: f64,
    ) -> Result<()> {
        let part = self.drawing.material(photo);
        let whole = photo.image_size().map_or(DVec2::ONE, DVec2::from);
        let frontages = match bay {
            Some(_) => self.divide(from, to),
            None => self.frontages(from, to),
        };
        for frontage in &frontages {
            let edge = frontage.edge;
            let (right, up) = (DVec3::new(frontage.size.x, 0.0, 0.0), DVec3::new(0.0, frontage.size.y, 0.0));
            let face = FacadeFace::new(DVec3::ZERO, right, up).of(None, true, SurfaceMeaning::Wall);
            let shown = match bay {
                None => [DVec2::ZERO, whole],
                Some(_) if frontage.is_blind() => {
                    frontage.fill(self.drawing.surface(plain, SurfaceMeaning::Wall))?;
                    continue;
                }
                Some(bay) => {
                    // Each frontage begins with a random bay, so that windows differ between frontages.
                    let chance = Stream::new(self.seed ^ mix_seed(self.raised, edge)).uniform();
                    let first = (chance * (whole / bay).round()).floor() * bay * DVec2::X;
                    [first, (frontage.size / bay).round().max(DVec2::ONE) * bay]
                }
            };
            let part = self.drawing.surface(part, SurfaceMeaning::Wall);
            frontage.draw(part, &face, &FaceMesh::of(&face), shown);
        }
        Ok(())
    }

    /// Draws templates. `bare` is the material of templates without one, `plain` the part of walls without a template.
    fn draw_facades(
        &mut self,
        templates: &Templates,
        (bare, plain): (&Material, usize),
        expand: bool,
        from: f64,
        to: f64,
    ) -> Result<()> {
        let mut laid = FacadeLayout::default();
        let mut joiner = Joiner::take_spare();
        // Parts are indexed by the addresses of materials, which do not move while the templates exist.
        let mut parts: Vec<(*const Material, usize)> = Vec::new();
        let mut without: Vec<DVec2> = Vec::new();
        let mut frontages = self.divide(from, to);
        self.miter(&mut frontages);
        let mut has_free = vec![false; self.plan.polygon().size()];
        for frontage in frontages.iter().filter(|frontage| !frontage.is_blind()) {
            has_free[frontage.edge] = true;
        }
        let mut count = frontages.len();
        let mut index = 0;
        while index < frontages.len() {
            let frontage = frontages[index];
            index += 1;
            laid.clear();
            let is_partly = frontage.covered > 0.0 && !frontage.is_blind();
            let chosen = self.choose(templates, &frontage);
            let over = Rectangle { at: DVec2::ZERO, size: frontage.size };
            let Some(template) = chosen.filter(|template| laid.lay(template.wall(), over, 0.0)) else {
                if laid.too_many {
                    return Err(Error::limit(
                        Limit::Size,
                        format!("footprint:walls: a frontage has more than {MOST} faces"),
                    )
                    .help("repeat fewer or larger walls in its template"));
                }
                if is_partly {
                    frontages.extend(frontage.divided_at(frontage.covered));
                    count += 1;
                    continue;
                }
                if !frontage.is_blind() {
                    without.push(frontage.size);
                }
                frontage.fill(self.drawing.surface(plain, SurfaceMeaning::Wall))?;
                continue;
            };
            if is_partly {
                // Storeys that begin above the neighbour's cover stay unchanged.
                let level =
                    laid.level_above(frontage.covered).filter(|level| *level < frontage.size.y - SAME);
                let Some(level) = level else {
                    frontages.push(Frontage { covered: frontage.size.y, ..frontage });
                    continue;
                };
                laid.keep_above(level);
                let [below, _] = frontage.divided_at(level);
                frontages.push(below);
            }
            let edge = frontage.edge;
            let of_template = template.material().unwrap_or(bare);
            self.draw_laid(&laid, of_template, &frontage, &mut parts, &mut joiner);
            let material: *const Material = material_of(&laid, of_template);
            // A gable continues the free part of the wall below it.
            if (!frontage.is_blind() || !has_free[edge])
                && let Some((_, part)) = parts.iter().find(|(known, _)| *known == material)
            {
                self.note_part(edge, *part);
            }
            self.note_storey(edge, &laid, frontage.size, from);
            for (fixture, at, scale) in laid.models() {
                // Models face -y.
                let DMat3 { x_axis, y_axis, z_axis } = frontage.axes;
                let turned = DMat3::from_cols(x_axis * scale.x, -z_axis * scale.y, y_axis * scale.z);
                let frame = DAffine3 { matrix3: turned, translation: frontage.place(at) };
                if expand {
                    self.drawing.draw_model(&fixture.model, &frame, fixture.meaning);
                } else {
                    self.drawing.place_as(&fixture.model, frame, fixture.meaning);
                }
            }
        }
        joiner.retire();
        if let Some(first) = without.first() {
            let why = format!(
                "no template fits {} of {} frontages, the first {:.2} m wide and {:.2} m high",
                without.len(),
                count,
                first.x,
                first.y
            );
            self.notes.push(Warning::simplification("plain walls where no template fits").with_cause(why));
            if let Some(wide) = without.iter().find(|size| size.x >= NARROW) {
                self.warnings.push(plain_warning(*wide));
            }
        }
        Ok(())
    }

    /// Chooses the template of a frontage. A partly blind wall gets the template that it would have if it were free.
    fn choose<'a>(&self, templates: &'a Templates, frontage: &Frontage) -> Option<&'a Template> {
        let chance = Stream::new(self.seed ^ mix_seed(self.raised, frontage.edge)).uniform();
        let keywords = self.keywords_of(frontage.edge, frontage.is_blind());
        templates.choose(&keywords, frontage.size.x, frontage.size.y, chance)
    }

    fn draw_laid<'a>(
        &mut self,
        laid: &FacadeLayout<'a>,
        template: &'a Material,
        frontage: &Frontage,
        parts: &mut Vec<(*const Material, usize)>,
        joiner: &mut Joiner,
    ) {
        let material_of = |face: &FacadeFace<'a>| face.material.unwrap_or(template);
        let part_of = |face: &FacadeFace<'a>| {
            let material = material_of(face);
            let address: *const Material = material;
            let known = parts.iter().find(|(known, _)| *known == address).map(|(_, part)| *part);
            known.unwrap_or_else(|| {
                let part = self.drawing.material(material);
                parts.push((address, part));
                part
            })
        };
        let of_faces: Vec<usize> = laid.faces.iter().map(part_of).collect();
        joiner.join(&laid.faces, &of_faces, |number, mesh| {
            let face = &laid.faces[number];
            let part = self.drawing.surface(of_faces[number], face.meaning);
            let size = material_of(face).image_size().unwrap_or([1.0; 2]);
            frontage.draw(part, face, mesh, [DVec2::ZERO, size.into()]);
        });
    }

    fn frontages(&self, from: f64, to: f64) -> Vec<Frontage> {
        let mut frontages: Vec<Frontage> = Vec::with_capacity(self.plan.polygon().size());
        for ring in &self.plan.flat() {
            let mut passed = 0.0;
            for [a, b] in ring.edges() {
                let right = horizontal_direction(a, b);
                let length = a.distance(b);
                frontages.push(Frontage {
                    miters: [0.0; 2],
                    ends: [a.extend(from), b.extend(from)],
                    size: DVec2::new(length, to - from),
                    axes: DMat3::from_cols(right, DVec3::Z, right.cross(DVec3::Z)),
                    // Textures continue around the corners.
                    passed: DVec2::new(passed, from - self.shell.bottom),
                    covered: 0.0,
                    edge: frontages.len(),
                });
                passed += length;
            }
        }
        frontages
    }

    /// Returns the frontages, divided where neighbours begin and end.
    fn divide(&self, from: f64, to: f64) -> Vec<Frontage> {
        let mut divided = Vec::with_capacity(self.plan.polygon().size());
        for frontage in self.frontages(from, to) {
            let Frontage { edge, size, .. } = frontage;
            divided.extend(self.spans(edge, size.x, [from, to]).into_iter().map(|span| frontage.part(&span)));
        }
        divided
    }

    /// Computes the mitres at the corners between frontages. A mitre never extends over a neighbour's wall.
    fn miter(&self, frontages: &mut [Frontage]) {
        let mut first = 0;
        let mut edges = 0;
        for count in self.plan.polygon().iter().map(|ring| ring.len()) {
            edges += count;
            let end = first + frontages[first..].iter().take_while(|frontage| frontage.edge < edges).count();
            for index in first..end {
                let next = if index + 1 == end { first } else { index + 1 };
                if frontages[index].edge == frontages[next].edge {
                    continue;
                }
                let turn = frontages[index].axes.x_axis.truncate();
                let turn = turn.angle_to(frontages[next].axes.x_axis.truncate());
                let miter = (turn / 2.0).tan().clamp(-STEEPEST_MITER, STEEPEST_MITER);
                let reach = |other: usize| if frontages[other].is_blind() { 0.0 } else { miter };
                let [after, before] = [reach(next), reach(index)];
                frontages[index].miters[1] = after;
                frontages[next].miters[0] = before;
            }
            first = end;
        }
    }

    /// Returns the keywords that describe a frontage on an edge, which is blind or not.
    fn keywords_of(&self, edge: usize, is_blind: bool) -> Vec<&str> {
        let own = self.options.keywords.iter().map(String::as_str);
        let words = own.chain(self.edge_keywords(edge).iter().map(|word| &**word));
        words.filter(|word| *word != BLIND).chain(is_blind.then_some(BLIND)).collect()
    }
}

impl Frontage {
    /// Returns true if a neighbour covers the whole frontage.
    fn is_blind(&self) -> bool {
        self.covered >= self.size.y
    }

    /// Returns the part of the frontage between two positions along the edge.
    fn part(&self, span: &WallSpan) -> Self {
        let [begin, end] = span.part;
        let is_all = [begin <= 0.0, end >= self.size.x];
        let at = |place: f64| self.ends[0] + self.axes.x_axis * place;
        Self {
            ends: [
                if is_all[0] { self.ends[0] } else { at(begin) },
                if is_all[1] { self.ends[1] } else { at(end) },
            ],
            size: DVec2::new(if is_all == [true; 2] { self.size.x } else { end - begin }, self.size.y),
            passed: self.passed + DVec2::new(begin.max(0.0), 0.0),
            covered: span.covered,
            ..*self
        }
    }

    /// Divides the frontage at a height (m) above its lower side into the blind part below and the free part above.
    fn divided_at(&self, height: f64) -> [Self; 2] {
        let by = |height: f64| self.ends.map(|end| end + DVec3::Z * height);
        let size = |height: f64| DVec2::new(self.size.x, height);
        [
            Self { size: size(height), covered: height, miters: [0.0; 2], ..*self },
            Self {
                ends: by(height),
                size: size(self.size.y - height),
                passed: self.passed + DVec2::new(0.0, height),
                covered: 0.0,
                ..*self
            },
        ]
    }

    /// Converts a point of the frontage to the footprint's coordinates (m).
    ///
    /// Measures from the nearer end, so that adjacent frontages meet exactly.
    fn place(&self, at: DVec3) -> DVec3 {
        if at.x < self.size.x / 2.0 {
            self.ends[0] + self.axes * at
        } else {
            self.ends[1] + self.axes * DVec3::new(at.x - self.size.x, at.y, at.z)
        }
    }

    /// Adds the whole frontage as one plain face.
    fn fill(&self, part: &mut Part) -> Result<()> {
        let up = DVec3::Z * self.size.y;
        let [a, b] = self.ends;
        let origin = a - self.axes.x_axis * self.passed.x - DVec3::Z * self.passed.y;
        let face = Ring::without_repeats(vec![a, b, b + up, a + up]);
        face.map_or(Ok(()), |face| fill(part, &[face], self.axes.x_axis, origin))
    }

    /// Adds `mesh`, the mesh of `face`, with texture coordinates (m). A face with a stretched image shows the section
    /// of the image that begins at the first point of `shown` and has the size of the second (m).
    fn draw(&self, part: &mut Part, face: &FacadeFace<'_>, mesh: &FaceMesh, shown: [DVec2; 2]) {
        let Ok(base) = u32::try_from(part.positions.len()) else { return };
        let normal = (self.axes * face.right.cross(face.up)).normalize_or_zero().as_vec3();
        let ([first, size], lies) = (shown, face.up.y == 0.0);
        part.make_room(mesh.corners.len(), mesh.triangles.len());
        for &given in &mesh.corners {
            let mut corner = given;
            if corner.z > 0.0 && corner.x < SAME {
                corner.x -= corner.z * self.miters[0];
            } else if corner.z > 0.0 && corner.x > self.size.x - SAME {
                corner.x += corner.z * self.miters[1];
            }
            let uv = if face.stretched {
                let part = |way: DVec3| (given - face.at).dot(way) / way.length_squared();
                first + DVec2::new(part(face.right), part(face.up)) * size
            } else if lies {
                self.passed + DVec2::new(corner.x, corner.y + corner.z)
            } else {
                // Texture coordinates also continue around the edges of projections and recesses.
                self.passed + DVec2::new(corner.x + corner.z, corner.y)
            };
            part.positions.push(self.place(corner).as_vec3());
            part.normals.push(normal.into());
            part.uvs.push(uv.as_vec2());
        }
        part.triangles.extend(mesh.triangles.iter().map(|triangle| triangle.map(|corner| base + corner)));
    }
}

/// Returns a random seed for an edge of the walls raised as number `raised`.
fn mix_seed(raised: u64, edge: usize) -> u64 {
    raised.wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ (edge as u64).wrapping_mul(0xD134_2543_DE82_EF95)
}
