//! Films: a script over the values of a parameter, and a model from all sides.
//!
//! A [`Film`] runs the script once for each value of a [`FrameAxis`], on several threads, and passes the frames on in
//! order; a [`Turntable`] renders one model. The same input results in the same frames for any number of threads. Memory
//! does not grow with the number of frames.

mod axis;
mod film;
mod order;
mod prints;
mod turntable;

pub use axis::{FrameAxis, MOST_FRAMES};
pub use film::{Film, FilmProgress};
pub use turntable::Turntable;
