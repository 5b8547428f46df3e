//! The functions, in the order of the book's page.

use super::forms::FORMS;
use super::making::MAKERS;
use super::measures::MEASURES;
use super::relations::RELATIONS;
use super::spatial_function::SpatialFunction;

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
