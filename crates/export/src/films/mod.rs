//! Films: frames as one animated file, or as one file for each frame.
//!
//! Input: the frames in order, as images or as scenes. Output: the files of the paths that [`FilmWriter`] was created
//! with. An animated file is complete or absent; files of single frames appear one by one, each complete.

mod formats;
mod pattern;
mod writer;

#[cfg_attr(not(feature = "pictures"), path = "absent.rs")]
mod encode;
mod encoder;

pub use crate::film_model::FilmModel;
pub use crate::film_settings::FilmSettings;
pub use encoder::FrameEncoder;
pub use formats::{FILM_FORMATS, FilmContent, FilmFormat};
pub use pattern::FramePattern;
pub use writer::{FilmFrame, FilmNeeds, FilmWriter};
