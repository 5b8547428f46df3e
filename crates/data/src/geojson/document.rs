//! GeoJSON document: its members, with the features of a collection passed on one by one.

use std::fmt;

use serde::de::{DeserializeSeed, Error as _, IgnoredAny, MapAccess, SeqAccess, Visitor};
use serde_json::Value;
use serde_json::value::RawValue;

/// Members of a document, excluding the features of its collection.
#[derive(Default)]
pub(super) struct DocumentHeader<'t> {
    /// Member `type`, of any JSON type.
    pub kind: Option<Value>,
    /// Set if there is a list of features, which the reader has already processed.
    pub features: bool,
    pub crs: Option<Value>,
    pub name: Option<Value>,
    // Members of a single feature or geometry.
    pub id: Option<&'t RawValue>,
    pub properties: Option<&'t RawValue>,
    pub geometry: Option<&'t RawValue>,
    pub coordinates: Option<&'t RawValue>,
    pub geometries: Option<&'t RawValue>,
}

/// Function that takes the text of a feature; it returns false if reading must end.
type TakeFeature<'f> = dyn FnMut(&str) -> bool + 'f;

/// Reads the document at the start of `text`, and passes the features of its collection to `take`; returns its members
/// and the rest of the text.
pub(super) fn read_document<'t>(
    take: &mut TakeFeature<'_>,
    text: &'t str,
) -> Result<(DocumentHeader<'t>, &'t str), serde_json::Error> {
    let mut parser = serde_json::Deserializer::from_str(text);
    let head = DocumentMembers(take).deserialize(&mut parser)?;
    let end = parser.into_iter::<IgnoredAny>().byte_offset();
    Ok((head, text.get(end..).unwrap_or_default()))
}

struct DocumentMembers<'r, 'f>(&'r mut TakeFeature<'f>);

impl<'t> DeserializeSeed<'t> for DocumentMembers<'_, '_> {
    type Value = DocumentHeader<'t>;

    fn deserialize<D: serde::Deserializer<'t>>(
        self,
        deserializer: D,
    ) -> Result<DocumentHeader<'t>, D::Error> {
        deserializer.deserialize_map(self)
    }
}

impl<'t> Visitor<'t> for DocumentMembers<'_, '_> {
    type Value = DocumentHeader<'t>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an object")
    }

    fn visit_map<A: MapAccess<'t>>(self, mut map: A) -> Result<DocumentHeader<'t>, A::Error> {
        let mut head = DocumentHeader::default();
        while let Some(key) = map.next_key::<std::borrow::Cow<'t, str>>()? {
            match &*key {
                "type" => head.kind = Some(map.next_value()?),
                "features" => {
                    map.next_value_seed(FeatureList(&mut *self.0))?;
                    head.features = true;
                }
                "crs" => head.crs = Some(map.next_value()?),
                "name" => head.name = map.next_value()?,
                "id" => head.id = map.next_value()?,
                "properties" => head.properties = map.next_value()?,
                "geometry" => head.geometry = map.next_value()?,
                "coordinates" => head.coordinates = map.next_value()?,
                "geometries" => head.geometries = map.next_value()?,
                _ => drop(map.next_value::<IgnoredAny>()?),
            }
        }
        Ok(head)
    }
}

/// List of a collection's features.
struct FeatureList<'r, 'f>(&'r mut TakeFeature<'f>);

impl<'t> DeserializeSeed<'t> for FeatureList<'_, '_> {
    type Value = ();

    fn deserialize<D: serde::Deserializer<'t>>(self, deserializer: D) -> Result<(), D::Error> {
        deserializer.deserialize_seq(self)
    }
}

impl<'t> Visitor<'t> for FeatureList<'_, '_> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a list of features")
    }

    fn visit_seq<A: SeqAccess<'t>>(self, mut list: A) -> Result<(), A::Error> {
        while let Some(feature) = list.next_element::<&'t RawValue>()? {
            if !(self.0)(feature.get()) {
                return Err(A::Error::custom("stopped"));
            }
        }
        Ok(())
    }
}
