//! Traversal of nested statements for walks that track the variables in scope.

use full_moon::ast::{Block, Expression, NumericFor, Stmt};

/// A walk through a script that tracks the variables in scope.
pub(super) trait ScopeWalk {
    /// Returns the number of variables in scope.
    fn in_scope(&self) -> usize;

    /// Removes the latest variables from scope until `outside` of them are left.
    fn leave(&mut self, outside: usize);

    /// Walks the expression of a condition or of a loop bound.
    fn term(&mut self, expression: &Expression);

    /// Adds the variable of a numeric loop to the scope.
    fn counter(&mut self, numeric: &NumericFor);

    /// Walks a block and keeps its variables in scope.
    fn open_block(&mut self, block: &Block);

    /// Walks a block and then removes its variables from scope.
    fn block(&mut self, block: &Block) {
        let outside = self.in_scope();
        self.open_block(block);
        self.leave(outside);
    }

    /// Walks the statements inside blocks, branches and loops, except for generic loops. Other statements contain no
    /// statements.
    fn walk_nested(&mut self, statement: &Stmt) {
        match statement {
            Stmt::Do(inner) => self.block(inner.block()),
            Stmt::NumericFor(numeric) => {
                self.term(numeric.start());
                self.term(numeric.end());
                if let Some(step) = numeric.step() {
                    self.term(step);
                }
                let outside = self.in_scope();
                self.counter(numeric);
                self.block(numeric.block());
                self.leave(outside);
            }
            Stmt::If(branches) => {
                self.term(branches.condition());
                self.block(branches.block());
                for branch in branches.else_if().into_iter().flatten() {
                    self.term(branch.condition());
                    self.block(branch.block());
                }
                if let Some(block) = branches.else_block() {
                    self.block(block);
                }
            }
            // The condition of a repeat loop sees the variables of its block.
            Stmt::Repeat(repeat) => {
                let outside = self.in_scope();
                self.open_block(repeat.block());
                self.term(repeat.until());
                self.leave(outside);
            }
            Stmt::While(repeat) => {
                self.term(repeat.condition());
                self.block(repeat.block());
            }
            _ => {}
        }
    }
}
