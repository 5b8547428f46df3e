//! Rewriting from a script to its chains, tested against the laws of the design and the literature.

use burgeon::rewriting;

mod candidates;
mod chains_as_axioms;
mod choice;
mod closures;
mod contexts;
mod continued;
mod decomposition;
mod determinism;
mod distributions;
mod edits;
mod expectations;
mod fragments;
mod generate;
mod hooks;
mod interpretation;
mod lineage;
mod literature;
mod meaning;
mod modules_as_tables;
mod naive;
mod parameters;
mod parts;
mod passes;
mod patterns;
mod properties;
mod queries;
mod results;
mod returned_modules;
mod scripts;
mod sequences;
mod steps;
mod stochastic;
mod streams;
mod strings;
