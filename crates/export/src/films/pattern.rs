//! Patterns of file names that contain the number of a frame.

use burgeon_base::error::{Error, Result};
use std::path::{Path, PathBuf};

/// Maximum width of a number in a file name.
const WIDEST: usize = 9;

/// Pattern of file names with the number of a frame, such as `frames/%04d.png`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FramePattern {
    path: PathBuf,
    before: String,
    /// Minimum number of digits.
    digits: usize,
    after: String,
}

impl FramePattern {
    /// Parses the file name of `path`; `None` if it contains no number pattern.
    ///
    /// `%d` is the number, `%4d` and `%04d` the number with at least four digits. Fails if there are several patterns,
    /// or too many digits.
    ///
    /// ```
    /// use burgeon_export::films::FramePattern;
    /// use std::path::Path;
    ///
    /// let pattern = FramePattern::of(Path::new("frames/tree-%04d.png"))?.expect("a pattern");
    /// assert_eq!(pattern.path(12), Path::new("frames/tree-0012.png"));
    /// assert_eq!(FramePattern::of(Path::new("100%.png"))?, None);
    /// assert!(FramePattern::of(Path::new("%d-%d.png")).is_err());
    /// # Ok::<(), burgeon_base::Error>(())
    /// ```
    pub fn of(path: &Path) -> Result<Option<Self>> {
        let Some(name) = path.file_name().and_then(|name| name.to_str()) else { return Ok(None) };
        let Some((before, digits, after)) = split(name) else { return Ok(None) };
        let shown = path.display();
        if split(after).is_some() {
            return Err(Error::usage(format!("{shown} has several patterns for the number of the frame"))
                .help("keep one of them, such as %04d"));
        }
        if digits > WIDEST {
            return Err(Error::usage(format!("{shown}: a number has at most {WIDEST} digits"))
                .help("write a pattern such as %04d"));
        }
        let (before, after) = (before.to_owned(), after.to_owned());
        Ok(Some(Self { path: path.to_owned(), before, digits, after }))
    }

    /// Returns the path of frame `number`.
    pub fn path(&self, number: usize) -> PathBuf {
        let Self { before, digits, after, .. } = self;
        self.path.with_file_name(format!("{before}{number:0digits$}{after}"))
    }

    /// Returns the folder of the files; `None` for the current folder.
    pub fn folder(&self) -> Option<&Path> {
        self.path.parent().filter(|folder| !folder.as_os_str().is_empty())
    }
}

/// Returns the text before the first pattern of `name`, its number of digits, and the text after it.
fn split(name: &str) -> Option<(&str, usize, &str)> {
    name.match_indices('%').find_map(|(at, _)| {
        let rest = &name[at + 1..];
        let end = rest.find(|letter: char| !letter.is_ascii_digit())?;
        let after = rest[end..].strip_prefix('d')?;
        let digits = if end == 0 { 1 } else { rest[..end].parse().unwrap_or(usize::MAX) };
        Some((&name[..at], digits.max(1), after))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pattern_is_found_in_the_name_and_not_in_the_folder() {
        let path = |text: &str, number| {
            let pattern = FramePattern::of(Path::new(text)).unwrap();
            pattern.map(|pattern| pattern.path(number).display().to_string())
        };
        assert_eq!(path("a/%d.png", 7).as_deref(), Some("a/7.png"));
        assert_eq!(path("%3d.png", 7).as_deref(), Some("007.png"));
        assert_eq!(path("f%02d.glb", 1234).as_deref(), Some("f1234.glb"));
        assert_eq!(path("50%-%03d.png", 1).as_deref(), Some("50%-001.png"));
        assert_eq!(path("%00d.png", 1).as_deref(), Some("1.png"));
        for plain in ["a.png", "%04d/a.png", "%x.png", "%.png", "%4.png", "100%"] {
            assert_eq!(path(plain, 1), None, "{plain}");
        }
        assert!(FramePattern::of(Path::new("%99999999999999999999d.png")).is_err());
    }
}
