//! Watches the files that determine the result of a run, and reports changes of their content.
//!
//! Input: paths of files and folders, which need not exist. Output: a [`Change`] soon after the content of one of them
//! changes, or after it is created or deleted. The content of a folder is the names in it. A save that changes nothing
//! is never reported, and only regular files are opened.
//!
//! Folders are watched instead of files, because most editors save by renaming a new file over the old one (`folders`).
//! The effect of an event is determined by comparing contents (`files`).

mod database;
mod files;
mod folders;
mod watcher;

pub use watcher::{Change, Watch, settled, unsettled};
