//! Derivation: rewrites the chains of a system step by step in parallel, with interpretation passes in
//! between.
//!
//! Input: a system as declared by a script. Output: a [`DerivedSystem`](crate::results::DerivedSystem). The
//! chain of a step is read-only while the next chain is made, so batches are independent of each other. The
//! derivation is independent of the types of objects.
//!
//! `burgeon_rewriting` makes the steps, and calls the functions of rules through
//! [`LuaRules`](functions::LuaRules). [`lead()`] plans a derivation, runs its phases and builds its result.
//! [`ThreadPool`] distributes pieces of the work to other machines.

mod checkpoints;
mod functions;
mod hooks;
mod interpret;
mod lead;
mod passes;
mod pending;
mod phases;
mod plan;
mod rewrite;
mod rewriter;
mod state;
mod step;
mod threads;

pub(crate) use threads::ThreadPool;
