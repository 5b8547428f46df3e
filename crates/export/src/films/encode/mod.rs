//! Encoders of animated images.

mod apng;
mod changes;
mod delay;
mod gif;
mod palette;
mod sink;

pub(super) use apng::apng;
pub(super) use gif::gif;
