//! Derivation: rewrites the chains of a system step by step, in parallel, and has them interpreted in between.
//!
//! Comes in: a system as a script declared it. Goes out: a [`DerivedSystem`](crate::results::DerivedSystem). The chain of a
//! step is read-only while the next one is made, so a batch never sees what another batch does. It never knows what type
//! an object is.
//!
//! Functions of rules are run by a [`RuleFunctions`](functions::RuleFunctions), of which virtual machines are one.
//! [`lead()`] plans a derivation, makes its steps, and settles what came of it; [`ThreadPool`] has other machines take
//! pieces of the work.

mod batch;
mod choose;
mod functions;
mod group;
mod interpret;
mod lead;
mod output;
mod pending;
mod plan;
mod rewriter;
mod splice;
mod step;
mod threads;

pub(crate) use threads::ThreadPool;
