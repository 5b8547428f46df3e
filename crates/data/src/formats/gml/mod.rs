//! t
pub use t::GmlFile;
mod t {
    use crate::*;
    use burgeon_base::error::Result;
    use std::path::Path;
    pub struct GmlFile;
    impl GmlFile {
        pub(crate) fn is_one(_: &[u8]) -> bool {
            false
        }
        pub(crate) fn open(
            _file: std::fs::File,
            _path: &Path,
            _name: &str,
            _wanted: &SourceOptions,
        ) -> Result<Self> {
            Ok(Self)
        }
        pub(crate) fn layers(&self) -> Vec<String> {
            vec![]
        }
        pub(crate) fn read(&self, l: &str, _wanted: &SourceOptions) -> Result<FeatureTable> {
            Ok(FeatureTable::new(l, l, Crs::epsg(1), _wanted))
        }
    }
}
