//! Derivation: rewrites the chains of a system step by step, in parallel, and has them interpreted in between.
//!
//! Input: a system as a script declared it. Output: a [`DerivedSystem`](crate::results::DerivedSystem). The chain of a
//! step is read-only while the next one is made, so a batch never sees what another batch does. It never knows what type
//! an object is.
//!
//! Steps are made by `burgeon_rewriting`, which calls the functions of rules through [`LuaRules`](functions::LuaRules).
//! [`lead()`] plans a derivation, runs its phases, and settles its result; [`ThreadPool`] has other machines take pieces of the
//! work.

mod functions;
mod interpret;
mod lead;
mod pending;
mod phases;
mod plan;
mod rewriter;
mod step;
mod threads;

pub(crate) use threads::ThreadPool;
