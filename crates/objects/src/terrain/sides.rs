//! The sides and the underside of the ground, and the sides of the water on it.

use glam::{DVec3, Vec2, Vec3};

use burgeon_base::error::{Error, Result};
use burgeon_kit::{Expectation, Parameter, Value};
use burgeon_scene::Part;

/// Depth of an automatic underside below the lowest ground, as a part of the length of the sides.
const AUTOMATIC_DEPTH: f64 = 0.02;

/// Height of the underside of a terrain.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Underside {
    /// Height (m).
    Height(f64),
    /// Height below the lowest ground, by a fiftieth of the length of the sides.
    Automatic,
}

impl Underside {
    /// Returns the height (m) for a terrain whose lowest ground has the height `lowest` (m) and whose sides have the length
    /// `size` (m).
    pub(super) fn height(self, lowest: f64, size: f64) -> f64 {
        match self {
            Self::Height(height) => height,
            Self::Automatic => lowest - size * AUTOMATIC_DEPTH,
        }
    }
}

impl Parameter for Underside {
    fn luau() -> String {
        "number | string".into()
    }

    fn from_value(value: Value) -> Result<Self, Expectation> {
        match value {
            Value::Number(height) if height.is_finite() => Ok(Self::Height(height)),
            Value::Text(text) if &*text == "auto" => Ok(Self::Automatic),
            _ => Err(Expectation::new("a height (m) or \"auto\"")),
        }
    }

    fn into_value(self) -> Value {
        match self {
            Self::Height(height) => Value::Number(height),
            Self::Automatic => Value::Text("auto".into()),
        }
    }
}

/// Draws upright faces from the edges of `rim` (m), which have the ground on their left, down to the height `base` (m),
/// and an underside.
pub(super) fn draw(rim: &[[DVec3; 2]], base: f64, part: &mut Part) -> Result<()> {
    let lowest = rim.iter().flatten().map(|at| at.z).fold(f64::INFINITY, f64::min);
    if lowest <= base {
        return Err(Error::argument(format!("terrain: base is {base} m, above the ground at its edge"))
            .help(format!("use a height below {lowest:.1} m, or base = \"auto\"")));
    }
    let middle = rim.iter().flatten().sum::<DVec3>() / (rim.len().max(1) * 2) as f64;
    for [from, to] in rim {
        let down = |at: &DVec3| DVec3::new(at.x, at.y, base);
        let way = *to - *from;
        let out = DVec3::new(way.y, -way.x, 0.0).normalize_or_zero().as_vec3();
        face(part, &[down(from), down(to), *to, *from], out);
        face(part, &[down(to), down(from), down(&middle)], Vec3::NEG_Z);
    }
    Ok(())
}

/// Draws upright faces from the edges of `rim` (m) that are below the height `level` (m) of standing water, up to it.
pub(super) fn draw_water(rim: &[[DVec3; 2]], level: f64, part: &mut Part) {
    for [from, to] in rim.iter().filter(|edge| edge.iter().any(|end| end.z < level)) {
        let up = |at: &DVec3| DVec3::new(at.x, at.y, at.z.max(level));
        let way = *to - *from;
        let out = DVec3::new(way.y, -way.x, 0.0).normalize_or_zero().as_vec3();
        let corners: Vec<DVec3> = match (from.z < level, to.z < level) {
            (true, true) => vec![*from, *to, up(to), up(from)],
            (true, false) => vec![*from, from.lerp(*to, (level - from.z) / (to.z - from.z)), up(from)],
            _ => vec![from.lerp(*to, (level - from.z) / (to.z - from.z)), *to, up(to)],
        };
        face(part, &corners, out);
    }
}

/// Adds a face with this normal.
fn face(part: &mut Part, corners: &[DVec3], normal: Vec3) {
    let Ok(first) = u32::try_from(part.positions.len()) else { return };
    for at in corners {
        part.positions.push(at.as_vec3());
        part.normals.push(normal.into());
        let along = if normal.z == 0.0 { at.truncate().length() } else { at.x };
        let up = if normal.z == 0.0 { at.z } else { at.y };
        #[allow(clippy::cast_possible_truncation, reason = "texture coordinates are f32")]
        part.uvs.push(Vec2::new(along as f32, up as f32));
    }
    part.triangles
        .extend((2..).zip(&corners[2..]).map(|(corner, _)| [first, first + corner - 1, first + corner]));
}
