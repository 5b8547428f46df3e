//! Methods of shapes for scripts.

use std::sync::Arc;

use burgeon_base::error::{Error, ErrorKind, Result};
use burgeon_geometry::Rings;
use burgeon_kit::{Color, TableOf, Value, Vector, methods};
use burgeon_shapes::{CutPlane, EdgeKind, FaceStyle, Selector, Shape, ShapeBody, SolidOperation};
use burgeon_spatial::Geometry;
use glam::{DAffine3, DMat3, DVec2, DVec3};

use super::component_selector::{ComponentChoice, ComponentSelector};
use super::division::SplitDirection;
use super::edge_distances::{EdgeDistances, EnvelopeLimits};
use super::holes::HoleArgument;
use super::object::{ShapeObject, warn};
use super::options::ScatterOptions;
use super::part_sizes::SplitSizes;
use super::relations::ShapeOrPlace;
use super::roofing::ShapeRoofOptions;
use super::support::{read_selector, split_axis, unit, warn_of_shift, warn_of_split};
use super::sweep_path::{SweepPathOptions, SweepPoints};
use super::tiles::{ProjectOptions, TileLength};
use super::trimming::TrimOptions;
use crate::MaterialOptions;

#[methods("shape")]
impl ShapeObject {
    /// Returns the extent (m) along the axes of the scope.
    pub fn size(&self) -> DVec3 {
        self.shape.scope().size
    }

    /// Returns the corner of the scope with the least coordinates (m).
    pub fn position(&self) -> DVec3 {
        self.shape.scope().origin
    }

    /// Returns the centre of the scope (m).
    pub fn center(&self) -> DVec3 {
        self.shape.scope().center()
    }

    /// Returns the direction of the x axis: along an edge, and to the right on a face seen from outside.
    pub fn x_axis(&self) -> DVec3 {
        // Turns -0 into 0.
        self.shape.scope().axes.x_axis + DVec3::ZERO
    }

    /// Returns the direction of the y axis: upwards on a face.
    pub fn y_axis(&self) -> DVec3 {
        // Turns -0 into 0.
        self.shape.scope().axes.y_axis + DVec3::ZERO
    }

    /// Returns the direction of the z axis: outwards on a face and an edge.
    pub fn z_axis(&self) -> DVec3 {
        // Turns -0 into 0.
        self.shape.scope().axes.z_axis + DVec3::ZERO
    }

    /// Returns true if the shape is closed, so that it has a volume.
    pub fn is_solid(&self) -> bool {
        self.shape.is_closed()
    }

    /// Returns the kind of an edge: "ridge", "hip", "valley", "eave", "rake", "corner", "border" or "plain"; nil for
    /// other shapes.
    pub fn edge_kind(&self) -> Option<String> {
        match &self.shape.body {
            ShapeBody::Edge(kind, _) => Some(kind.name().into()),
            _ => None,
        }
    }

    /// Returns the volume of a solid (m³); 0 if the shape is open.
    pub fn volume(&self) -> f64 {
        self.shape.volume()
    }

    /// Returns the area of all faces (m²).
    pub fn area(&self) -> f64 {
        self.shape.area()
    }

    /// Returns the length of an edge, or of the outlines of open faces (m); 0 for a solid.
    pub fn length(&self) -> f64 {
        if let ShapeBody::Edge(..) = self.shape.body {
            return self.shape.scope().size.x;
        }
        let mesh = self.shape.mesh();
        mesh.open_edges().map(|[from, to]| mesh.at(from).distance(mesh.at(to))).sum()
    }

    /// Returns the angle between the first face and the horizontal plane (degrees): 0 for a floor, 90 for a wall, 180
    /// for a ceiling.
    pub fn slope(&self) -> f64 {
        self.shape.normal().angle_between(DVec3::Z).to_degrees()
    }

    /// Returns the number of faces.
    pub fn face_count(&self) -> f64 {
        self.shape.body.faces() as f64
    }

    /// Returns the number of open edges: 0 for a solid.
    pub fn open_edges(&self) -> f64 {
        self.shape.mesh().open_edges().count() as f64
    }

    /// Returns the corners (m) in the order of the faces.
    pub fn points(&self) -> Vec<Vector> {
        if let ShapeBody::Edge(..) = self.shape.body {
            let scope = &self.shape.scope();
            return vec![Vector(scope.origin), Vector(scope.point(scope.size))];
        }
        self.shape.mesh().points.iter().copied().map(Vector).collect()
    }

    /// Returns the number among the parts of the operation that made the shape, from 1.
    pub fn index(&self) -> f64 {
        f64::from(self.place.index + 1)
    }

    /// Returns the number of parts of the operation that made the shape.
    pub fn count(&self) -> f64 {
        f64::from(self.place.count)
    }

    /// Returns the number of the size that made the part of a split, or of the selector that chose the component, from 1. Sizes
    /// in repeated lists count separately.
    pub fn entry(&self) -> f64 {
        f64::from(self.place.entry + 1)
    }

    /// Returns the named value; nil if there is none. Parts inherit values.
    pub fn get(&self, name: String) -> Value {
        self.value(&name)
    }

    /// Returns the shape with a named value, which its parts inherit; nil removes it.
    pub fn with(&self, name: String, value: Option<Value>) -> Self {
        self.with_value(&name, value.unwrap_or(Value::Nil))
    }

    /// Returns the tags of the faces, in alphabetical order.
    pub fn tags(&self) -> Vec<String> {
        let mut tags: Vec<String> = self
            .shape
            .styles()
            .iter()
            .flatten()
            .flat_map(|style| style.tags.iter().map(ToString::to_string))
            .collect();
        tags.sort();
        tags.dedup();
        tags
    }

    /// Returns true if a face has a tag that matches `pattern`: "roof" matches "roof.slope", * any characters, and ? one.
    pub fn has_tag(&self, pattern: String) -> bool {
        let tagged = Selector::Tagged(pattern);
        self.shape.styles().iter().any(|style| tagged.matches(DVec3::Z, style, &DMat3::IDENTITY))
    }

    /// Returns the shape with a tag on all faces, such as "facade.front".
    pub fn tag(&self, name: String) -> Result<Self> {
        if name.is_empty() || name.split('.').any(str::is_empty) || name.contains(['*', '?']) {
            return Err(Error::argument(format!("shape:tag: {name:?} is no tag"))
                .help("use names with dots between them, such as \"facade.front\""));
        }
        let name: Arc<str> = name.as_str().into();
        Ok(self.with_shape(self.shape.with_styles(|style| FaceStyle::with_tag(style, &name))))
    }

    /// Returns the shape without the tags that match `pattern`.
    pub fn untag(&self, pattern: String) -> Self {
        self.with_shape(self.shape.with_styles(|style| FaceStyle::without_tags(style, &pattern)))
    }

    /// Returns the shape with faces of this colour, which override the colour of the drawing object.
    pub fn color(&self, color: Color) -> Self {
        self.with_shape(self.shape.with_styles(|style| FaceStyle::with_color(style, color.0)))
    }

    /// Returns the colour that all faces have from `color`, as a text such as "#c08040"; nil if they have none or several.
    pub fn face_color(&self) -> Option<String> {
        self.common_color()
    }

    /// Returns the shape with faces of another material, such as { texture = "brick.png", texture_size = { 2, 1 } }. A later
    /// colour multiplies the texture.
    pub fn material(&self, material: MaterialOptions) -> Result<Self> {
        let material = Arc::new(material.material()?);
        Ok(self.with_shape(self.shape.with_styles(|style| FaceStyle::with_material(style, &material))))
    }

    /// Returns the shape with the image of its material projected onto its faces: tiles of `width` (m) and `height` (m) along x
    /// and y of the scope, from its corner; "~2" stands for whole tiles of about 2 m. Cuts and movements keep the
    /// image in its place on the faces. Faces along the direction of projection keep tiles of the size of the material.
    /// { set = "dirt" } is a second set of coordinates, for the dirt map of a material that names it.
    pub fn project(
        &self,
        width: TileLength,
        height: TileLength,
        options: Option<TableOf<ProjectOptions>>,
    ) -> Result<Self> {
        self.with_tiles([width, height], &options.unwrap_or_default().read()?)
    }

    /// Returns the shape drawn smooth across edges whose faces turn by at most `angle` (degrees, 40 unless given): round
    /// columns and domes. 0 draws flat faces. Only the shading changes.
    pub fn smooth(&self, angle: Option<f64>) -> Result<Self> {
        let angle = angle.unwrap_or(40.0);
        if !(0.0..=180.0).contains(&angle) {
            return Err(Error::argument(format!("shape:smooth: the angle is {angle} degrees"))
                .help("use an angle from 0 to 180 degrees"));
        }
        let angle = angle.to_radians();
        Ok(self.with_shape(self.shape.with_styles(|style| FaceStyle::with_smooth(style, angle))))
    }

    /// Returns the parts along an axis of the scope, "x", "y" or "z", in ascending order.
    ///
    /// `sizes` is a list: a number (m), "30%" of the whole, "~3" for a flexible size that shares the rest, "3*" or "~3*"
    /// for as many as fit, and a list of sizes for a repeated group. A solid's parts are solids. Along "u" and "v", the
    /// directions of an image from `project`, sizes are in tiles: 0.25 cuts an image of four windows between them.
    pub fn split(&self, axis: String, sizes: SplitSizes) -> Result<Vec<Arc<Self>>> {
        self.divide_along(SplitDirection::read(&axis)?, &sizes)
    }

    /// Returns the parts of a face along an axis of the scope by area: sizes as of `split`, in m².
    pub fn split_area(&self, axis: String, areas: SplitSizes) -> Result<Vec<Arc<Self>>> {
        let split = self.shape.split_area(split_axis("split_area", &axis)?, &areas.0);
        let split = split.map_err(|error| error.about("shape:split_area"))?;
        warn_of_split("split_area", "m²", &split);
        Ok(self.number_parts(split.parts))
    }

    /// Returns the part behind the plane through a point (m), against its `normal`; nil if there is none.
    pub fn trim(&self, point: Vector, normal: Vector) -> Result<Option<Self>> {
        let normal = unit("shape:trim: the normal", normal.0)?;
        let ([below, _], open) = self.shape.cut(&CutPlane::through(point.0, normal))?;
        if open {
            warn(
                "trim",
                "the solid could not be closed where it was cut",
                "check the solid with shape:open_edges",
            );
        }
        Ok(below.map(|part| self.with_shape(part)))
    }

    /// Returns the shape, such as a brick on `face`, cut by the planes that bisect the angles between this face and its
    /// neighbours in the solid that it was taken from; nil if nothing remains. So solids on neighbouring faces meet at corners
    /// and hips. Parts of a face have the planes of the whole face, also after movements.
    pub fn trim_to(&self, face: Arc<Self>, options: Option<TableOf<TrimOptions>>) -> Result<Option<Self>> {
        self.trim_at(&face, &options.unwrap_or_default().read()?)
    }

    /// Returns the part of faces within a rectangle along the axes of the scope, from `x` (m) and `y` (m) with `width` (m) and
    /// `height` (m); nil if there is none.
    pub fn crop(&self, x: f64, y: f64, width: f64, height: f64) -> Result<Option<Self>> {
        let low = DVec2::new(x, y);
        Ok(self.shape.crop(low, low + DVec2::new(width, height))?.map(|part| self.with_shape(part)))
    }

    /// Returns the faces, each as a shape: all, or those that `selector` matches.
    ///
    /// Selectors are "front", "back", "left", "right", "side", "top" and "bottom" by the scope; "north", "east",
    /// "south", "west", "up" and "down"; "vertical", "horizontal", "slanted" and "overhanging"; and "tag:" with a
    /// pattern.
    pub fn faces(&self, selector: Option<String>) -> Result<Vec<Arc<Self>>> {
        let mut faces = self.parts(self.shape.faces(&read_selector("faces", selector)?)?);
        for face in faces.iter_mut().filter_map(Arc::get_mut) {
            face.matching = Selector::matching(face.shape.normal(), &self.shape.scope().axes);
        }
        Ok(faces)
    }

    /// Returns true if `selector` selects this face among the faces of the shape that it comes from, or this edge by its
    /// kind.
    pub fn matches(&self, selector: String) -> Result<bool> {
        let selector = ComponentSelector::read(&selector, self.is_edge())
            .map_err(|error| error.about("shape:matches"))?;
        Ok(self.is_selected(&selector))
    }

    /// Returns the faces that `selector` matches as one shape; nil if there are none.
    pub fn joined_faces(&self, selector: Option<String>) -> Result<Option<Self>> {
        let joined = self.shape.join_faces(&read_selector("joined_faces", selector)?);
        Ok(joined.map(|faces| self.with_shape(faces)))
    }

    /// Returns the edges, each as a shape along its x axis: all, or those of a kind such as "ridge". Edges between
    /// coplanar faces do not count.
    pub fn edges(&self, kind: Option<String>) -> Result<Vec<Arc<Self>>> {
        let kind = kind.map(|kind| EdgeKind::read(&kind)).transpose();
        let kind = kind.map_err(|error| error.about("shape:edges"))?;
        Ok(self.parts(self.shape.edges(kind.as_ref().map(std::slice::from_ref))))
    }

    /// Returns the "faces", "edges", "holes" or "pieces" that one of `selectors` matches; the method `entry` gives the number of
    /// the first that does. The selector "all" matches all.
    pub fn components(&self, kind: String, selectors: Vec<String>) -> Result<Vec<Arc<Self>>> {
        ComponentChoice::read(&kind, &selectors)?.of(self)
    }

    /// Returns the holes of the faces, filled.
    pub fn holes(&self) -> Vec<Arc<Self>> {
        self.parts(self.shape.holes())
    }

    /// Returns the faces without holes.
    pub fn without_holes(&self) -> Self {
        self.with_shape(self.shape.without_holes())
    }

    /// Returns the connected pieces.
    pub fn pieces(&self) -> Result<Vec<Arc<Self>>> {
        Ok(self.parts(self.shape.pieces()?))
    }

    /// Returns the solid between the faces and their copies at `distance` (m) along `direction`, their normal unless
    /// given. New faces have the tags "extrude.bottom", "extrude.side" and "extrude.top".
    pub fn extrude(&self, distance: f64, direction: Option<Vector>) -> Result<Self> {
        let direction = direction.map(|to| unit("shape:extrude: the direction", to.0)).transpose()?;
        let solid = self.shape.extrude(distance, direction).map_err(|error| error.about("shape:extrude"))?;
        Ok(self.with_shape(solid))
    }

    /// Returns the back and the sides of a recess of `depth` (m) behind the faces, such as that of a window. Faces have the
    /// tags "recess.back" and "recess.side".
    pub fn recess(&self, depth: f64) -> Result<Self> {
        Ok(self.with_shape(self.shape.recess(depth).map_err(|error| error.about("shape:recess"))?))
    }

    /// Returns a face with a hole, or nil if the hole covers it: an outline of points (m) or a polygon in the scope of the face, x
    /// to the right and y upwards from its corner, or a shape, whose projection along the normal is cut. A hole that reaches
    /// the edge of the face divides it or makes a recess in its outline.
    pub fn cut_hole(&self, hole: HoleArgument) -> Result<Option<Self>> {
        self.without_hole(&hole)
    }

    /// Returns the solid between a face and its copy at `height` (m), scaled by `scale` (0 unless given, a pyramid).
    pub fn taper(&self, height: f64, scale: Option<f64>) -> Result<Self> {
        let solid =
            self.shape.taper(height, scale.unwrap_or(0.0)).map_err(|error| error.about("shape:taper"))?;
        Ok(self.with_shape(solid))
    }

    /// Returns a roof over a horizontal face, closed from below. Faces have the tags "roof.slope", "roof.gable",
    /// "roof.side" and "roof.bottom".
    pub fn roof(&self, options: Option<TableOf<ShapeRoofOptions>>) -> Result<Self> {
        self.build_roof(options.unwrap_or_default().read()?)
    }

    /// Returns the solid that a closed profile sweeps around the outline of a face, with mitred corners: a cornice or a
    /// frame. `profile` is a list of points { outwards, up } (m) from the outline.
    pub fn molding(&self, profile: Vec<Vector>) -> Result<Self> {
        self.build_molding(&profile)
    }

    /// Returns the solid that a profile sweeps along a path: a list of positions (m), a curve or an edge. The profile is a face
    /// around the origin of the ground plane, such as disk(0.1): x is to the right of the path, y upwards. Faces have the
    /// tags "sweep.start", "sweep.side" and "sweep.end".
    pub fn sweep(&self, path: SweepPoints, options: Option<TableOf<SweepPathOptions>>) -> Result<Self> {
        self.sweep_along(path, &options.unwrap_or_default().read()?)
    }

    /// Returns the solid between a face and another one with as many corners.
    pub fn loft(&self, other: Arc<Self>) -> Result<Self> {
        Ok(self.with_shape(self.shape.loft(&other.shape).map_err(|error| error.about("shape:loft"))?))
    }

    /// Returns a solid with convex edges cut off by planes, `distance` (m) from the edge on both faces: all, or those of
    /// a kind.
    pub fn chamfer(&self, distance: f64, kind: Option<String>) -> Result<Self> {
        self.bevel("chamfer", distance, 0, kind)
    }

    /// Returns a solid with convex edges rounded from `distance` (m) on both faces, by arcs of `segments` (4 unless
    /// given): all edges, or those of a kind.
    pub fn fillet(&self, distance: f64, kind: Option<String>, segments: Option<u32>) -> Result<Self> {
        self.bevel("fillet", distance, segments.unwrap_or(4).max(1), kind)
    }

    /// Returns the volume that a zoning law allows over a horizontal face, at most `height` (m) high. `limits` has, by
    /// selectors of edges, { height (m), angle (degrees) }: up to the height an upright wall, then a slope inwards.
    pub fn envelope(&self, height: f64, limits: EnvelopeLimits) -> Result<Self> {
        let by_edge =
            limits.by_edge(self.shape.scope().axes).map_err(|error| error.about("shape:envelope"))?;
        let solid = self.shape.envelope(height, by_edge).map_err(|error| error.about("shape:envelope"))?;
        Ok(self.with_shape(solid))
    }

    /// Returns a large rectangle inside a face, along the axes of its scope; nil if the face is too narrow.
    pub fn inner_rectangle(&self) -> Result<Option<Self>> {
        let inner = self.shape.inner_rectangle().map_err(|error| error.about("shape:inner_rectangle"))?;
        Ok(inner.map(|inner| self.with_shape(inner)))
    }

    /// Returns the faces after all edges of a face moved outwards by `distance` (m), or inwards if it is negative; an
    /// empty list if nothing remains.
    pub fn offset(&self, distance: f64) -> Result<Vec<Arc<Self>>> {
        Ok(self.parts(self.shape.offset(-distance).map_err(|error| error.about("shape:offset"))?))
    }

    /// Returns the rest of a face after its edges moved inwards by `distances` (m): one for all, a list with one for each
    /// edge, or a table of selectors, such as { front = 3, side = 1 }.
    pub fn setback(&self, distances: EdgeDistances) -> Result<Vec<Arc<Self>>> {
        Ok(self.parts(self.divide_border("setback", &distances)?.inner))
    }

    /// Returns the strips along the edges of a face, in the order of the edges, with `distances` (m) as of `setback`.
    /// Strips of neighbouring edges meet on the line between them.
    pub fn border(&self, distances: EdgeDistances) -> Result<Vec<Arc<Self>>> {
        Ok(self.parts(self.divide_border("border", &distances)?.border))
    }

    /// Returns the strips along the edges of a face, with `distances` (m) as of `setback`, joined to an L, a U, an O or
    /// parts of them.
    pub fn wings(&self, distances: EdgeDistances) -> Result<Vec<Arc<Self>>> {
        let border = self.divide_border("wings", &distances)?.border;
        let strips: Vec<&Shape> = border.iter().collect();
        let Some(joined) = Shape::join(&strips)? else { return Ok(Vec::new()) };
        Ok(self.parts(joined.recompose()?.faces(&Selector::All)?))
    }

    /// Returns the faces that the shape covers seen from above, at `height` (m, the bottom of the shape unless given); nil if
    /// all faces are upright.
    pub fn ground_plan(&self, height: Option<f64>) -> Result<Option<Self>> {
        let height = height.unwrap_or_else(|| self.shape.bounds()[0].z);
        let plan = self.shape.ground_plan(height).map_err(|error| error.about("shape:ground_plan"))?;
        Ok(plan.map(|plan| self.with_shape(plan)))
    }

    /// Returns the shape with its faces divided into convex ones without holes. A solid stays a solid.
    pub fn convexify(&self) -> Result<Self> {
        Ok(self.with_shape(self.shape.convexify().map_err(|error| error.about("shape:convexify"))?))
    }

    /// Returns the shape with about `share` of its triangles, of the same points: distant models. Borders and edges between
    /// colours keep their form as long as possible, and a solid stays a solid.
    pub fn reduce(&self, share: f64) -> Result<Self> {
        let (shape, rest) = self.shape.reduce(share).map_err(|error| error.about("shape:reduce"))?;
        if rest > 1.1 * share {
            let text =
                format!("{rest:.3} of the triangles remain, not {share}, since no other can be removed");
            warn("reduce", &text, "use a larger share, or a simpler shape");
        }
        Ok(self.with_shape(shape))
    }

    /// Returns a face with right angles: edges within `angle` (degrees, 10 unless given) of the axes of its scope become
    /// parallel to them. If the face would cross itself or change by more than a quarter, a warning says so, and the face
    /// is returned as it is.
    pub fn rectify(&self, angle: Option<f64>) -> Result<Self> {
        match self.shape.rectify(angle.unwrap_or(10.0).to_radians()) {
            Ok(face) => Ok(self.with_shape(face)),
            Err(error) if *error.kind() != ErrorKind::Geometry => Err(error.about("shape:rectify")),
            Err(error) => {
                let text = format!("{}; the face is kept", error.message());
                warn("rectify", &text, error.remedy().unwrap_or("use a smaller angle"));
                Ok(self.clone())
            }
        }
    }

    /// Returns the rest of a face with this `area` (m²) after all edges moved inwards by the same distance.
    pub fn setback_to_area(&self, area: f64) -> Result<Vec<Arc<Self>>> {
        let setback =
            self.shape.setback_to_area(area).map_err(|error| error.about("shape:setback_to_area"))?;
        Ok(self.parts(setback.0.inner))
    }

    /// Returns the shape moved by an offset (m).
    pub fn translate(&self, offset: Vector) -> Self {
        self.with_shape(self.shape.translate(offset.0))
    }

    /// Returns the shape moved by an offset (m) along the axes of its scope.
    pub fn shift(&self, offset: Vector) -> Self {
        self.with_shape(self.shape.translate(self.shape.scope().axes * offset.0))
    }

    /// Returns the shape rotated by `angle` (degrees) around an axis, the z axis of its scope unless given, through `point` (m,
    /// the centre of the scope unless given).
    pub fn rotate(&self, angle: f64, axis: Option<Vector>, point: Option<Vector>) -> Result<Self> {
        let axis =
            axis.map_or(Ok(self.shape.scope().axes.z_axis), |axis| unit("shape:rotate: the axis", axis.0))?;
        let point = point.map_or_else(|| self.shape.scope().center(), |point| point.0);
        Ok(self.with_shape(self.shape.rotate(point, axis, angle.to_radians())))
    }

    /// Returns the shape with a scope of this size (m), scaled from the scope's position.
    pub fn resize(&self, size: Vector) -> Result<Self> {
        Ok(self.with_shape(self.shape.resize(size.0).map_err(|error| error.about("shape:resize"))?))
    }

    /// Returns the shape mirrored at the plane through `point` (m, the centre of the scope unless given) with a normal.
    pub fn mirror(&self, normal: Vector, point: Option<Vector>) -> Result<Self> {
        let normal = unit("shape:mirror: the normal", normal.0)?;
        let point = point.map_or_else(|| self.shape.scope().center(), |point| point.0);
        Ok(self.with_shape(self.shape.mirror(point, normal)))
    }

    /// Returns the shape with its faces turned inside out.
    pub fn reverse(&self) -> Self {
        self.with_shape(self.shape.reverse())
    }

    /// Returns the shape with another scope around it: z along `up` (the world's z axis unless given), and x close to
    /// `right` (the world's x axis unless given).
    pub fn align(&self, right: Option<Vector>, up: Option<Vector>) -> Result<Self> {
        let up = unit("shape:align: up", up.map_or(DVec3::Z, |up| up.0))?;
        let right = right.map_or(DVec3::X, |right| right.0);
        let x = unit("shape:align: the part of right across up", right - up * up.dot(right))?;
        Ok(self.with_shape(self.shape.align(DMat3::from_cols(x, up.cross(x), up))))
    }

    /// Returns another shape, moved, turned and scaled so that its scope fills the scope of this one. An extent of 0
    /// keeps the size along this axis.
    pub fn fit(&self, other: Arc<Self>) -> Result<Self> {
        let (own, others) = (&self.shape.scope(), &other.shape.scope());
        let size = DVec3::from_array(
            [0, 1, 2].map(|axis| if own.size[axis] > 0.0 { own.size[axis] } else { others.size[axis] }),
        );
        let sized = other.shape.resize(size).map_err(|error| error.about("shape:fit"))?;
        let turn = own.axes * sized.scope().axes.transpose();
        let frame = DAffine3::from_mat3_translation(turn, own.origin - turn * sized.scope().origin);
        Ok(other.with_shape(sized.transform(&frame)))
    }

    /// Returns `count` copies of the shape, each moved by `offset` (m) from the one before; the first is in place.
    pub fn array(&self, count: u32, offset: Vector) -> Result<Vec<Arc<Self>>> {
        self.copies(count, offset.0)
    }

    /// Returns `count` positions (m) on the faces, in the volume or in the scope, uniformly distributed.
    pub fn scatter(&self, count: u32, options: Option<TableOf<ScatterOptions>>) -> Result<Vec<Vector>> {
        let ScatterOptions { seed, within } = options.unwrap_or_default().read()?;
        let (count, seed) = (count as usize, seed.to_bits());
        let points = match within.as_str() {
            "faces" => self.shape.scatter(count, seed).map(|all| all.into_iter().map(|(at, _)| at).collect()),
            "volume" => self.shape.scatter_inside(count, seed),
            "scope" => self.shape.scatter_in_scope(count, seed),
            other => Err(Error::argument(format!("unknown place {other:?}"))
                .help("use within = \"faces\", \"volume\" or \"scope\"")),
        };
        let points: Vec<DVec3> = points.map_err(|error| error.about("shape:scatter"))?;
        Ok(points.into_iter().map(Vector).collect())
    }

    /// Returns the union with another solid. If the operation fails, a warning says so, and this solid is returned.
    pub fn union(&self, other: Arc<Self>) -> Result<Option<Self>> {
        self.combine("union", &other, SolidOperation::Union)
    }

    /// Returns this solid without another; nil if nothing remains. If the operation fails, a warning says so, and this
    /// solid is returned.
    pub fn subtract(&self, other: Arc<Self>) -> Result<Option<Self>> {
        self.combine("subtract", &other, SolidOperation::Difference)
    }

    /// Returns the intersection with another solid; nil if there is none. If the operation fails, a warning says so, and
    /// this solid is returned.
    pub fn intersect(&self, other: Arc<Self>) -> Result<Option<Self>> {
        self.combine("intersect", &other, SolidOperation::Intersection)
    }

    /// Returns the shape with coplanar neighbouring faces of the same tags and colour joined, and without opposite equal
    /// faces inside: the joined parts of a split become the whole.
    pub fn recompose(&self) -> Result<Self> {
        Ok(self.with_shape(self.shape.recompose()?))
    }

    /// Returns true if a position (m), or a whole shape, is inside this solid.
    pub fn contains(&self, other: ShapeOrPlace) -> Result<bool> {
        let place = match other {
            ShapeOrPlace::Place(place) => place,
            ShapeOrPlace::Shape(other) => {
                let found = self.shape.contains_solid(&other.shape);
                let (is_inside, shift) = found.map_err(|error| error.about("shape:contains"))?;
                warn_of_shift("contains", shift);
                return Ok(is_inside);
            }
        };
        self.shape.contains(place).map_err(|error| error.about("shape:contains"))
    }

    /// Returns true if the interiors of two solids, or the faces of open shapes, intersect.
    pub fn overlaps(&self, other: Arc<Self>) -> Result<bool> {
        self.shape.overlaps(&other.shape)
    }

    /// Returns true if two shapes touch without overlapping.
    pub fn touches(&self, other: Arc<Self>) -> Result<bool> {
        self.shape.touches(&other.shape)
    }

    /// Returns the distance (m) to a position or another shape; 0 if they touch or overlap.
    pub fn distance(&self, other: ShapeOrPlace) -> Result<f64> {
        match other {
            ShapeOrPlace::Place(place) => self.shape.distance_to_place(place),
            ShapeOrPlace::Shape(other) => self.shape.distance(&other.shape),
        }
    }

    /// Returns the outline of a face as a polygon with heights, for geometries and footprints.
    pub fn geometry(&self) -> Result<Geometry> {
        let mesh = self.shape.mesh();
        let [face] = mesh.faces.as_slice() else {
            let message = format!("shape:geometry: the shape has {} faces", mesh.faces.len());
            return Err(Error::argument(message).help("use one face: shape:faces(\"top\")[1]"));
        };
        let ring = |ring: &Vec<u32>| ring.iter().map(|point| mesh.at(*point)).collect();
        let invalid = || Error::geometry("shape:geometry: the face is upright, so it has no plan");
        let mut geometry =
            Geometry::polygon(Rings(face.rings.iter().map(ring).collect())).ok_or_else(invalid)?;
        if geometry.area() <= 0.0 {
            return Err(invalid().help("use a face that looks up or down"));
        }
        geometry.turn();
        Ok(geometry)
    }
}
