//! The types of columns and expressions, as in PostgreSQL.

/// The type of a value.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(crate) enum SqlType {
    /// Unknown until the statement runs, such as the type of a parameter.
    #[default]
    Unknown,
    /// Quoted string, whose type depends on its context.
    Literal,
    /// Boolean.
    Boolean,
    /// Integer.
    Integer,
    /// Decimal number.
    Numeric,
    /// Binary number.
    Double,
    /// String.
    Text,
    /// Geometry.
    Geometry,
    /// List of values.
    List,
}

impl SqlType {
    /// Returns the name for messages.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Unknown | Self::Literal => "unknown",
            Self::Boolean => "boolean",
            Self::Integer => "integer",
            Self::Numeric => "numeric",
            Self::Double => "double precision",
            Self::Text => "text",
            Self::Geometry => "geometry",
            Self::List => "array",
        }
    }

    /// Reports whether the type is numeric.
    pub(super) fn is_number(self) -> bool {
        matches!(self, Self::Integer | Self::Numeric | Self::Double)
    }

    /// Reports whether the type is known, and not a quoted string.
    pub(super) fn is_known(self) -> bool {
        !matches!(self, Self::Unknown | Self::Literal)
    }

    /// Returns the type of the result of arithmetic.
    pub(super) fn with(self, other: Self) -> Self {
        match (self, other) {
            (Self::Double, other) | (other, Self::Double) if other.is_number() => Self::Double,
            (Self::Numeric, other) | (other, Self::Numeric) if other.is_number() => Self::Numeric,
            (Self::Integer, Self::Integer) => Self::Integer,
            // A quoted string takes the type of the other operand.
            (Self::Literal, other) | (other, Self::Literal) if other.is_number() => other,
            _ => Self::Unknown,
        }
    }

    /// Returns the common type of two alternatives.
    pub(super) fn or(self, other: Self) -> Self {
        match (self, other) {
            (a, b) if a == b => a,
            (Self::Literal, Self::Text) | (Self::Text, Self::Literal) => Self::Text,
            (Self::Unknown | Self::Literal, other) | (other, Self::Unknown | Self::Literal) => other,
            (a, b) => a.with(b),
        }
    }

    /// Returns the type of a column with this declaration in a file.
    pub(crate) fn from_declaration(kind: &str) -> Self {
        let kind = kind.to_ascii_uppercase();
        let is = |words: &[&str]| words.iter().any(|word| kind.contains(word));
        match () {
            () if is(&["BOOL"]) => Self::Boolean,
            () if is(&["INT"]) && !is(&["POINT"]) => Self::Integer,
            () if is(&["CHAR", "TEXT", "CLOB", "DATE", "TIME"]) => Self::Text,
            () if is(&["REAL", "DOUBLE", "FLOAT"]) => Self::Double,
            () if is(&["NUMERIC", "DECIMAL"]) => Self::Numeric,
            () => Self::Unknown,
        }
    }

    /// Returns the type named by a cast or a declaration in a statement, or `None` if it is unknown here.
    pub(super) fn from_name(name: &str) -> Option<Self> {
        let name = name.to_ascii_lowercase();
        let plain = name.split('(').next().unwrap_or_default().trim();
        Some(match plain {
            "boolean" | "bool" => Self::Boolean,
            "int" | "integer" | "bigint" | "smallint" | "int2" | "int4" | "int8" => Self::Integer,
            "numeric" | "decimal" | "dec" => Self::Numeric,
            "double precision" | "double" | "float" | "float8" | "float4" | "real" => Self::Double,
            "text" | "varchar" | "character varying" | "char" | "character" | "bpchar" | "name" => Self::Text,
            "geometry" => Self::Geometry,
            _ => return None,
        })
    }
}

/// The columns of a table or a query, with their names, or `None` if they are unknown.
pub(crate) type ColumnTypes = Option<Vec<(String, SqlType)>>;
