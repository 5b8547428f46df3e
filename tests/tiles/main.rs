//! Tiles of synthetic cities: the real program, and runs over cells compared with the whole run.

#![allow(clippy::unwrap_used, clippy::cast_precision_loss, reason = "a test stops at what is wrong")]

mod bad_input;
mod bytes;
mod cells;
mod city;
mod content;
mod heights;
mod implicit;
mod killed;
mod levels;
mod tables;
mod tall;
mod terrain;
