//! Visibility of the model in a render.

/// Part of a model that a render shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ModelSight {
    /// Pixels of the model, or the scene shows nothing from any side.
    Seen,
    /// None: the model is outside of the picture.
    Outside,
    /// None: the model is smaller than a pixel.
    Speck,
    /// None: its faces are seen from behind, transparent, or thinner than a pixel.
    Hidden,
}
