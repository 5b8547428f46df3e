//! Tests of shapes in scripts are in `tests/kind` and `tests/scripts`.
