//! Tags, colours and materials of faces.

use std::cell::RefCell;
use std::sync::Arc;

use burgeon_scene::Material;
use glam::DAffine3;

use crate::UvMap;

/// Tags and appearance of a face.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct FaceStyle {
    /// Tags, such as "roof.slope", in alphabetical order.
    pub tags: Vec<Arc<str>>,
    /// Linear colour with opacity, if the face has its own.
    pub color: Option<[f32; 4]>,
    /// Material, if the face has its own.
    pub material: Option<Arc<Material>>,
    /// Projection of texture coordinates; metres in the plane of the face if `None`.
    pub uv: Option<UvMap>,
    /// Named projections besides `uv`, in alphabetical order: further sets of texture coordinates.
    pub sets: Vec<(Arc<str>, UvMap)>,
    /// Largest angle (radians) to a neighbour across which the face is drawn smooth.
    pub smooth: Option<f64>,
}

/// Style that several faces share; `None` without any.
pub type SharedStyle = Option<Arc<FaceStyle>>;

impl FaceStyle {
    /// Returns `style` with another tag.
    pub fn with_tag(style: &SharedStyle, tag: &Arc<str>) -> SharedStyle {
        let mut own = style.as_deref().cloned().unwrap_or_default();
        if let Err(at) = own.tags.binary_search(tag) {
            own.tags.insert(at, Arc::clone(tag));
        }
        Some(Arc::new(own))
    }

    /// Returns `style` with an automatic tag, such as "extrude.side", which replaces those of earlier operations of the same
    /// kind.
    pub(crate) fn with_automatic_tag(style: &SharedStyle, tag: &'static str) -> SharedStyle {
        if style.is_none() {
            return Some(Self::of_tag(tag));
        }
        let kind = tag.split('.').next().unwrap_or(tag);
        let is_earlier = |own: &Arc<str>| own.split('.').next() == Some(kind);
        if style.as_deref().is_some_and(|own| own.tags.iter().any(is_earlier)) {
            return Self::with_tag(&Self::without_tags(style, kind), &tag.into());
        }
        Self::with_tag(style, &tag.into())
    }

    /// Returns the style with nothing but an automatic tag, which all faces of a thread share.
    fn of_tag(tag: &'static str) -> Arc<Self> {
        thread_local! {
            static STYLES: RefCell<Vec<(&'static str, Arc<FaceStyle>)>> = const { RefCell::new(Vec::new()) };
        }
        STYLES.with_borrow_mut(|styles| {
            if let Some((_, style)) = styles.iter().find(|(known, _)| *known == tag) {
                return Arc::clone(style);
            }
            let style = Arc::new(Self { tags: vec![tag.into()], ..Self::default() });
            styles.push((tag, Arc::clone(&style)));
            style
        })
    }

    /// Returns `style` without the tags that `pattern` matches.
    pub fn without_tags(style: &SharedStyle, pattern: &str) -> SharedStyle {
        let own = style.as_deref()?;
        let tags: Vec<Arc<str>> =
            own.tags.iter().filter(|tag| !matches_tag(pattern, tag)).map(Arc::clone).collect();
        let rest = Self { tags, ..own.clone() };
        (rest != Self::default()).then(|| Arc::new(rest))
    }

    /// Returns `style` in another colour.
    pub fn with_color(style: &SharedStyle, color: [f32; 4]) -> SharedStyle {
        let own = style.as_deref().cloned().unwrap_or_default();
        Some(Arc::new(Self { color: Some(color), ..own }))
    }

    /// Returns `style` with another material, in its colour.
    pub fn with_material(style: &SharedStyle, material: &Arc<Material>) -> SharedStyle {
        let own = style.as_deref().cloned().unwrap_or_default();
        Some(Arc::new(Self { material: Some(Arc::clone(material)), color: None, ..own }))
    }

    /// Returns `style` that is smooth across edges up to an angle (radians), or flat with 0.
    pub fn with_smooth(style: &SharedStyle, angle: f64) -> SharedStyle {
        let own = style.as_deref().cloned().unwrap_or_default();
        let smooth = (angle > 0.0).then_some(angle);
        Some(Arc::new(Self { smooth, ..own }))
    }

    /// Returns `style` with a projection of texture coordinates: the named set, or the first one if the name is empty.
    pub fn with_projection(style: &SharedStyle, set: &Arc<str>, map: UvMap) -> SharedStyle {
        let mut own = style.as_deref().cloned().unwrap_or_default();
        match own.sets.binary_search_by(|(known, _)| known.cmp(set)) {
            _ if set.is_empty() => own.uv = Some(map),
            Ok(at) => own.sets[at].1 = map,
            Err(at) => own.sets.insert(at, (Arc::clone(set), map)),
        }
        Some(Arc::new(own))
    }

    /// Returns `style` with its projections moved with the face.
    pub(crate) fn with_projections_moved(style: &SharedStyle, frame: &DAffine3) -> SharedStyle {
        let own = style.as_deref()?;
        if !own.is_projected() {
            return style.clone();
        }
        let uv = own.uv.map(|map| map.transform(frame));
        let sets = own.sets.iter().map(|(name, map)| (Arc::clone(name), map.transform(frame))).collect();
        Some(Arc::new(Self { uv, sets, ..own.clone() }))
    }

    /// Returns `style` with the projections of another style.
    pub(crate) fn with_projections_of(style: &SharedStyle, other: &SharedStyle) -> SharedStyle {
        let (uv, sets) =
            other.as_deref().map_or_else(Default::default, |other| (other.uv, other.sets.clone()));
        let own = style.as_deref().cloned().unwrap_or_default();
        let new = Self { uv, sets, ..own };
        (new != Self::default()).then(|| Arc::new(new))
    }

    /// Returns the projection of a named set of texture coordinates.
    pub fn set(&self, name: &str) -> Option<&UvMap> {
        self.sets.iter().find_map(|(known, map)| (**known == *name).then_some(map))
    }

    /// Returns true if the faces have a projection.
    pub fn is_projected(&self) -> bool {
        self.uv.is_some() || !self.sets.is_empty()
    }

    /// Returns true if a tag matches `pattern`.
    pub fn has_tag(style: &SharedStyle, pattern: &str) -> bool {
        style.as_deref().is_some_and(|own| own.tags.iter().any(|tag| matches_tag(pattern, tag)))
    }
}

/// Returns true if a pattern matches a tag or one of the levels above it: "roof" matches "roof.slope".
///
/// `*` stands for any characters and `?` for one, within a level. Linear in the length of the tag per star.
pub(crate) fn matches_tag(pattern: &str, tag: &str) -> bool {
    if !pattern.bytes().any(|byte| matches!(byte, b'*' | b'?')) {
        return tag.strip_prefix(pattern).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'));
    }
    let mut levels = tag.split('.');
    pattern.split('.').all(|wanted| levels.next().is_some_and(|level| matches_level(wanted, level)))
}

fn matches_level(pattern: &str, text: &str) -> bool {
    if !pattern.contains(['*', '?']) {
        return pattern == text;
    }
    let (pattern, text): (Vec<char>, Vec<char>) = (pattern.chars().collect(), text.chars().collect());
    let (mut at, mut place) = (0, 0);
    let mut star: Option<(usize, usize)> = None;
    while place < text.len() {
        match pattern.get(at) {
            Some('*') => {
                star = Some((at, place));
                at += 1;
            }
            Some(wanted) if *wanted == '?' || *wanted == text[place] => {
                at += 1;
                place += 1;
            }
            _ => {
                let Some((star_at, star_place)) = star else { return false };
                star = Some((star_at, star_place + 1));
                at = star_at + 1;
                place = star_place + 1;
            }
        }
    }
    pattern[at..].iter().all(|left| *left == '*')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pattern_matches_a_tag_and_the_levels_below_it() {
        for (pattern, tag, matches) in [
            ("roof", "roof", true),
            ("roof", "roof.slope", true),
            ("roof.slope", "roof", false),
            ("r*f.s?ope", "roof.slope", true),
            ("*", "roof.slope", true),
            ("*.side", "extrude.side", true),
            ("*.side", "extrude.top", false),
            ("ro", "roof", false),
            ("*a*b", "xxaxxbab", true),
        ] {
            assert_eq!(matches_tag(pattern, tag), matches, "{pattern} {tag}");
        }
    }
}
