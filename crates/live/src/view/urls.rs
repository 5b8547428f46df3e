//! URLs of models and renders, whose names are the hashes of their content.

use burgeon_export::{Format, GLB, PNG};

/// End of the name of a model with all its texture coordinates, before the extension.
const MEASURED: &str = ".uv";

/// Format of models in the page.
pub(super) const MODEL: Format = GLB;

/// Format of renders in the page.
pub(super) const PICTURE: Format = PNG;

/// Returns the URL of the model whose content has this `hash`.
pub(super) fn model_url(hash: &str) -> String {
    format!("model/{hash}.{}", MODEL.extension())
}

/// Returns the URL of the render whose content has this `hash`.
pub(super) fn picture_url(hash: &str) -> String {
    format!("picture/{hash}.{}", PICTURE.extension())
}

/// Returns the hash in the name of a model with all its texture coordinates; `None` for other names.
pub(super) fn measured_hash(name: &str) -> Option<&str> {
    MODEL.file.stem(name)?.strip_suffix(MEASURED)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_model_with_texture_coordinates_is_named_after_the_model() {
        let url = model_url("0a1b");
        let name = url.strip_prefix("model/").unwrap();
        assert_eq!((MODEL.file.stem(name), measured_hash(name)), (Some("0a1b"), None));
        assert_eq!(measured_hash("0a1b.uv.glb"), Some("0a1b"));
        assert_eq!(measured_hash("0a1b.uv.gltf"), None);
    }
}
