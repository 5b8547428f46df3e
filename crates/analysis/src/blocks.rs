//! The way through statements that hold others, for whoever walks a script and keeps the variables in scope.

use full_moon::ast::{Block, Expression, NumericFor, Stmt};

/// A walk through a script that keeps the variables in scope.
pub(super) trait ScopeWalk {
    /// How many variables are in scope.
    fn in_scope(&self) -> usize;

    /// Takes variables out of scope until so many are left.
    fn leave(&mut self, outside: usize);

    /// Walks the expression of a condition or of a bound.
    fn term(&mut self, expression: &Expression);

    /// Puts the variable of a loop over numbers into scope.
    fn counter(&mut self, numeric: &NumericFor);

    /// Walks a block and leaves its variables in scope.
    fn open_block(&mut self, block: &Block);

    /// Walks a block, whose variables are known in it alone.
    fn block(&mut self, block: &Block) {
        let outside = self.in_scope();
        self.open_block(block);
        self.leave(outside);
    }

    /// Walks blocks, branches and loops but those over lists; anything else holds no statements of its own.
    fn nested(&mut self, statement: &Stmt) {
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
            // What it ends by sees the variables of its block.
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
