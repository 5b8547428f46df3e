//! Size and speed of a film.

/// Size and speed of a film.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FilmSettings {
    /// Number of frames.
    pub frames: u32,
    /// Number of frames per second, above 0.
    pub fps: f64,
    /// Width and height (pixels).
    pub size: (u32, u32),
    /// Set if pixels of frames can be transparent.
    pub transparent: bool,
}

impl FilmSettings {
    /// Returns the time (s) from the first frame to frame `number`, which counts from 0.
    ///
    /// ```
    /// use burgeon_export::films::FilmSettings;
    ///
    /// let film = FilmSettings { frames: 100, fps: 25.0, size: (800, 600), transparent: false };
    /// assert_eq!(film.time_of(50), 2.0);
    /// ```
    pub fn time_of(&self, number: u32) -> f64 {
        f64::from(number) / self.fps
    }
}
