//! The functions, in the order of the book's page.

use super::forms::FORMS;
use super::making::MAKERS;
use super::measures::MEASURES;
use super::relations::RELATIONS;
use super::{FunctionCall, FunctionResult};

/// A function that statements may call.
#[derive(Debug, Clone, Copy)]
pub struct SpatialFunction {
    /// Name, which is not case-sensitive.
    pub name: &'static str,
    /// Arguments.
    pub takes: &'static str,
    /// Type of the result.
    pub gives: &'static str,
    /// Description.
    pub doc: &'static str,
    /// Minimum number of arguments.
    pub(crate) least: u8,
    /// Maximum number of arguments.
    pub(crate) most: u8,
    pub(crate) run: fn(&FunctionCall<'_>) -> Result<FunctionResult, String>,
}

impl std::fmt::Debug for FunctionCall<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("FunctionCall")
    }
}

type FunctionBody = fn(&FunctionCall<'_>) -> Result<FunctionResult, String>;

/// Creates a row of the table.
pub(super) const fn function(
    name: &'static str,
    (least, most): (u8, u8),
    takes: &'static str,
    gives: &'static str,
    doc: &'static str,
    run: FunctionBody,
) -> SpatialFunction {
    SpatialFunction { name, takes, gives, doc, least, most, run }
}
/// Arguments of functions of two geometries.
pub(super) const PAIR: &str = "(geometry, geometry)";
/// Arguments of functions of one geometry.
pub(super) const ONE: &str = "(geometry)";

/// Functions by topic.
const ROOMS: [&[SpatialFunction]; 4] = [RELATIONS, MEASURES, MAKERS, FORMS];

/// Number of functions.
const COUNT: usize = RELATIONS.len() + MEASURES.len() + MAKERS.len() + FORMS.len();

const fn all() -> [SpatialFunction; COUNT] {
    let mut made = [RELATIONS[0]; COUNT];
    let (mut room, mut at) = (0, 0);
    while room < ROOMS.len() {
        let mut index = 0;
        while index < ROOMS[room].len() {
            made[at] = ROOMS[room][index];
            index += 1;
            at += 1;
        }
        room += 1;
    }
    made
}

/// All functions of geometries.
pub static FUNCTIONS: &[SpatialFunction] = &all();
