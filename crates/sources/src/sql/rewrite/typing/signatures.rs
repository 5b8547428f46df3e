//! The types of the arguments and results of functions.

use crate::sql::functions;
use crate::sql::rewrite::types::SqlType;

/// The types of a function's arguments.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Takes {
    /// Values of any type.
    Anything,
    /// Numbers.
    Numbers,
    /// A string, followed by values of any type.
    Texts,
}

/// The types of a function.
pub(super) struct FunctionSignature {
    pub(super) takes: Takes,
    /// Function from the types of the arguments to the type of the result.
    pub(super) gives: fn(&[SqlType]) -> SqlType,
}

fn unknown_type(_: &[SqlType]) -> SqlType {
    SqlType::Unknown
}

fn boolean(_: &[SqlType]) -> SqlType {
    SqlType::Boolean
}

fn integer(_: &[SqlType]) -> SqlType {
    SqlType::Integer
}

fn double(_: &[SqlType]) -> SqlType {
    SqlType::Double
}

fn numeric(_: &[SqlType]) -> SqlType {
    SqlType::Numeric
}

fn text(_: &[SqlType]) -> SqlType {
    SqlType::Text
}

fn geometry(_: &[SqlType]) -> SqlType {
    SqlType::Geometry
}

fn list(_: &[SqlType]) -> SqlType {
    SqlType::List
}

/// Returns the type of the first argument.
fn first_type(kinds: &[SqlType]) -> SqlType {
    kinds.first().copied().unwrap_or_default()
}

/// Returns the common type of the arguments.
fn any(kinds: &[SqlType]) -> SqlType {
    kinds.iter().copied().reduce(SqlType::or).unwrap_or_default()
}

/// Returns a decimal type for decimals, and otherwise a binary type.
fn round_type(kinds: &[SqlType]) -> SqlType {
    match kinds {
        [SqlType::Numeric | SqlType::Literal, ..] | [_, _] => SqlType::Numeric,
        _ => SqlType::Double,
    }
}

/// Returns the type of an average, which is a decimal for integers.
fn average(kinds: &[SqlType]) -> SqlType {
    match kinds {
        [SqlType::Integer | SqlType::Numeric] => SqlType::Numeric,
        _ => SqlType::Double,
    }
}

/// Returns the types of a function with a lower-case name.
pub(super) fn find(name: &str) -> FunctionSignature {
    use Takes::{Anything, Numbers, Texts};
    let signature = |takes: Takes, gives: fn(&[SqlType]) -> SqlType| FunctionSignature { takes, gives };
    if let Some(function) = functions::find(name) {
        return signature(
            Anything,
            match function.gives {
                "boolean" => boolean,
                "geometry" => geometry,
                "text" => text,
                "number" if name.starts_with("st_n") || name == "st_dimension" || name == "st_srid" => {
                    integer
                }
                "number" => double,
                _ => unknown_type,
            },
        );
    }
    match name {
        "acos" | "acosh" | "asin" | "asinh" | "atan" | "atan2" | "atanh" | "cbrt" | "cos" | "cosh"
        | "cot" | "degrees" | "exp" | "ln" | "log" | "log10" | "log2" | "pi" | "pow" | "power"
        | "radians" | "sin" | "sinh" | "sqrt" | "tan" | "tanh" => signature(Numbers, double),
        "ceil" | "ceiling" | "floor" | "round" | "sign" | "trunc" => signature(Numbers, round_type),
        "abs" | "mod" | "sum" | "total" => signature(Numbers, first_type),
        "avg" => signature(Numbers, average),
        "coalesce" | "greatest" | "ifnull" | "iif" | "lag" | "last_value" | "lead" | "least"
        | "first_value" | "max" | "min" | "nth_value" => signature(Anything, any),
        "nullif" => signature(Anything, first_type),
        "count" | "dense_rank" | "instr" | "json_array_length" | "ntile" | "octet_length" | "rank"
        | "row_number" | "st_clusterdbscan" | "unicode" | "array_length" | "cardinality" => {
            signature(Anything, integer)
        }
        "cume_dist" | "percent_rank" => signature(Anything, double),
        "ascii" | "char_length" | "character_length" | "length" | "strpos" => signature(Texts, integer),
        "btrim" | "initcap" | "left" | "lower" | "lpad" | "ltrim" | "repeat" | "replace" | "reverse"
        | "right" | "rpad" | "rtrim" | "split_part" | "burgeon_substr" | "substr" | "substring"
        | "translate" | "trim" | "upper" => signature(Texts, text),
        "starts_with" => signature(Texts, boolean),
        "array_to_string" | "char" | "chr" | "concat" | "concat_ws" | "format" | "group_concat" | "hex"
        | "printf" | "quote" | "string_agg" | "typeof" => signature(Anything, text),
        "bool_and" | "bool_or" | "every" => signature(Anything, boolean),
        "array_agg" => signature(Anything, list),
        // These functions replace operators and casts.
        "burgeon_whole" | "burgeon_whole_decimal" => signature(Anything, integer),
        "burgeon_number" | "burgeon_quotient" | "burgeon_round" => signature(Anything, double),
        "burgeon_decimal" | "burgeon_round_decimal" => signature(Anything, numeric),
        "burgeon_text" | "burgeon_truth" => signature(Anything, text),
        "burgeon_boolean" | "burgeon_like" | "burgeon_ilike" => signature(Anything, boolean),
        "burgeon_divide" | "burgeon_modulo" => signature(Anything, any),
        "st_extent" | "st_collect" | "st_union" | "st_memunion" => signature(Anything, geometry),
        _ => signature(Anything, unknown_type),
    }
}
