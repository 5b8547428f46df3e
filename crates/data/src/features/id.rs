//! Compact feature ids, for millions of features.

use std::fmt;
use std::ops::Deref;

/// Maximum length of an id that is stored inline (bytes).
const SHORT: usize = 14;

/// Feature id: a text; short texts need no heap memory.
///
/// ```
/// use burgeon_data::FeatureId;
///
/// let id = FeatureId::from("way/123456789");
/// assert_eq!((id.as_str(), size_of::<FeatureId>()), ("way/123456789", 16));
/// ```
#[derive(Clone)]
pub struct FeatureId(IdText);

#[derive(Clone)]
enum IdText {
    Short {
        length: u8,
        bytes: [u8; SHORT],
    },
    #[allow(clippy::box_collection, reason = "a thin pointer, so that an id is 16 bytes")]
    Long(Box<String>),
}

impl FeatureId {
    /// Returns the text.
    pub fn as_str(&self) -> &str {
        match &self.0 {
            // The bytes are from a valid text.
            IdText::Short { length, bytes } => {
                std::str::from_utf8(&bytes[..usize::from(*length)]).unwrap_or_default()
            }
            IdText::Long(text) => text,
        }
    }

    /// Returns the memory (bytes) used in addition to the value itself.
    pub(crate) fn weight(&self) -> usize {
        match &self.0 {
            IdText::Short { .. } => 0,
            IdText::Long(text) => 48 + text.len(),
        }
    }
}

impl From<&str> for FeatureId {
    fn from(text: &str) -> Self {
        let mut bytes = [0; SHORT];
        Self(match (bytes.get_mut(..text.len()), u8::try_from(text.len())) {
            (Some(place), Ok(length)) => {
                place.copy_from_slice(text.as_bytes());
                IdText::Short { length, bytes }
            }
            _ => IdText::Long(Box::new(text.to_owned())),
        })
    }
}

impl Deref for FeatureId {
    type Target = str;

    fn deref(&self) -> &str {
        self.as_str()
    }
}

impl PartialEq for FeatureId {
    fn eq(&self, other: &Self) -> bool {
        self.as_str() == other.as_str()
    }
}

impl Eq for FeatureId {}

impl PartialEq<str> for FeatureId {
    fn eq(&self, other: &str) -> bool {
        self.as_str() == other
    }
}

impl PartialEq<&str> for FeatureId {
    fn eq(&self, other: &&str) -> bool {
        self.as_str() == *other
    }
}

impl fmt::Debug for FeatureId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(self.as_str(), f)
    }
}

impl fmt::Display for FeatureId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.as_str())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_id_is_its_text_however_long_and_takes_sixteen_bytes() {
        for text in ["", "a", "way/1234567890", "way/12345678901", "é\u{1f333}éééé", &"x".repeat(1000)] {
            let id = FeatureId::from(text);
            assert_eq!((id.as_str(), id.to_string().as_str(), id == text), (text, text, true));
            assert_eq!(id.weight() > 0, text.len() > SHORT, "{text}");
        }
        assert_eq!(size_of::<FeatureId>(), 16);
    }
}
