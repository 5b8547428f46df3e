//! Rewriting from a script to its chains, tested against the laws of the design and the literature.

mod candidates;
mod choice;
mod closures;
mod contexts;
mod continued;
mod decomposition;
mod determinism;
mod distributions;
mod fragments;
mod generate;
mod interpretation;
mod lineage;
mod literature;
mod meaning;
mod modules_as_tables;
mod naive;
mod parameters;
mod parts;
mod passes;
mod properties;
mod queries;
mod results;
mod scripts;
mod steps;
mod stochastic;
mod streams;
