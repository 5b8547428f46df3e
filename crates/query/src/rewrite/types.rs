//! The types of columns and expressions, as PostgreSQL would see them.

/// The type of a value.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(crate) enum SqlType {
    /// Not known before the statement runs, such as that of a parameter.
    #[default]
    Unknown,
    /// A text in quotes, which is taken for what stands beside it.
    Literal,
    /// True or false.
    Boolean,
    /// A whole number.
    Integer,
    /// A decimal number.
    Numeric,
    /// A binary number.
    Double,
    /// A text.
    Text,
    /// A geometry.
    Geometry,
    /// A list of values.
    List,
}

impl SqlType {
    /// Its name in messages.
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

    /// Reports whether it is a number.
    pub(super) fn is_number(self) -> bool {
        matches!(self, Self::Integer | Self::Numeric | Self::Double)
    }

    /// Reports whether it is known, and not only written as a text.
    pub(super) fn is_known(self) -> bool {
        !matches!(self, Self::Unknown | Self::Literal)
    }

    /// The type of numbers that are computed of two.
    pub(super) fn with(self, other: Self) -> Self {
        match (self, other) {
            (Self::Double, other) | (other, Self::Double) if other.is_number() => Self::Double,
            (Self::Numeric, other) | (other, Self::Numeric) if other.is_number() => Self::Numeric,
            (Self::Integer, Self::Integer) => Self::Integer,
            // A text in quotes is taken for what the other one is.
            (Self::Literal, other) | (other, Self::Literal) if other.is_number() => other,
            _ => Self::Unknown,
        }
    }

    /// The type of a value that is one of several.
    pub(super) fn or(self, other: Self) -> Self {
        match (self, other) {
            (a, b) if a == b => a,
            (Self::Literal, Self::Text) | (Self::Text, Self::Literal) => Self::Text,
            (Self::Unknown | Self::Literal, other) | (other, Self::Unknown | Self::Literal) => other,
            (a, b) => a.with(b),
        }
    }

    /// The type of a column that was declared so in a file.
    pub(crate) fn declared(kind: &str) -> Self {
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

    /// The type that a cast or a declaration in a statement names; `None` if it is not known here.
    pub(super) fn named(name: &str) -> Option<Self> {
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

/// The columns of a table or a query, with their names; `None` if they are not known.
pub(crate) type ColumnTypes = Option<Vec<(String, SqlType)>>;
