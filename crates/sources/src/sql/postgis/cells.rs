//! The conversion of values to and from the server.

use std::error::Error as StdError;
use std::sync::Arc;

use bytes::BytesMut;
use tokio_postgres::types::{FromSql, IsNull, Kind, ToSql, Type, to_sql_checked};

use crate::sql::blob;
use crate::sql::cell::{Cell, integer};
use burgeon_base::budget::Budget;

type BoxedError = Box<dyn StdError + Sync + Send>;

/// The value of a parameter, in the coordinates of the server.
#[derive(Debug)]
pub(super) struct BoundCell(pub(super) Cell);

impl BoundCell {
    /// Returns true if the value can be passed as a type.
    pub(super) fn fits(&self, kind: &Type) -> bool {
        let number = |text: &str| text.trim().parse::<f64>().ok();
        match &self.0 {
            Cell::Null => true,
            Cell::Boolean(_) => *kind == Type::BOOL || is_text(kind),
            Cell::Number(value) => {
                is_text(kind) || is_float(kind) || is_integer(kind) && integer(*value).is_some()
            }
            Cell::Text(text) => {
                is_text(kind)
                    || is_float(kind) && number(text).is_some()
                    || is_integer(kind) && number(text).and_then(integer).is_some()
            }
            Cell::Geometry(_) => *kind == Type::BYTEA,
            Cell::List(_) => false,
        }
    }
}

fn is_text(kind: &Type) -> bool {
    [Type::TEXT, Type::VARCHAR, Type::BPCHAR, Type::NAME, Type::UNKNOWN].contains(kind)
}

fn is_float(kind: &Type) -> bool {
    [Type::FLOAT4, Type::FLOAT8].contains(kind)
}

fn is_integer(kind: &Type) -> bool {
    [Type::INT2, Type::INT4, Type::INT8, Type::OID].contains(kind)
}

impl ToSql for BoundCell {
    fn to_sql(&self, kind: &Type, out: &mut BytesMut) -> Result<IsNull, BoxedError> {
        let number = match &self.0 {
            Cell::Null => return Ok(IsNull::Yes),
            Cell::Geometry(geometry) => return geometry.to_ewkb(None).to_sql(&Type::BYTEA, out),
            Cell::Boolean(value) if *kind == Type::BOOL => return value.to_sql(kind, out),
            Cell::Boolean(value) => return value.to_string().to_sql(&Type::TEXT, out),
            Cell::Text(text) if is_text(kind) => return text.as_ref().to_sql(&Type::TEXT, out),
            Cell::Number(value) if is_text(kind) => return value.to_string().to_sql(&Type::TEXT, out),
            Cell::Number(value) => *value,
            Cell::List(_) => return Err("a list is no parameter".into()),
            Cell::Text(text) => text.trim().parse::<f64>()?,
        };
        let whole =
            || integer(number).ok_or_else(|| BoxedError::from(format!("{number} is no whole number")));
        match *kind {
            Type::INT2 => i16::try_from(whole()?)?.to_sql(kind, out),
            Type::INT4 => i32::try_from(whole()?)?.to_sql(kind, out),
            Type::INT8 => whole()?.to_sql(kind, out),
            Type::OID => u32::try_from(whole()?)?.to_sql(kind, out),
            #[allow(clippy::cast_possible_truncation, reason = "that is what the server keeps")]
            Type::FLOAT4 => (number as f32).to_sql(kind, out),
            _ => number.to_sql(&Type::FLOAT8, out),
        }
    }

    fn accepts(_: &Type) -> bool {
        true
    }

    to_sql_checked!();
}

/// A value received from the server, with geometries in the coordinates of the server.
pub(super) enum ServerCell {
    Cell(Cell),
    /// Geometry that cannot be read, with the reason.
    Unreadable(String),
}

/// Names of the types, besides `geometry`, whose values can be read directly; others can be cast to text.
pub(super) const COME_AS_THEY_ARE: [&str; 17] = [
    "bool", "bpchar", "bytea", "citext", "float4", "float8", "int2", "int4", "int8", "json", "jsonb", "name",
    "numeric", "oid", "text", "uuid", "varchar",
];

impl<'a> FromSql<'a> for ServerCell {
    fn from_sql(kind: &Type, raw: &'a [u8]) -> Result<Self, BoxedError> {
        let text = |raw: &[u8]| Cell::Text(String::from_utf8_lossy(raw).into());
        if let Kind::Domain(of) = kind.kind() {
            return Self::from_sql(of, raw);
        }
        if let Kind::Array(of) = kind.kind() {
            let values = Vec::<Option<Self>>::from_sql(kind, raw).map_err(|error| {
                BoxedError::from(format!("is of type {}[]: {error}; make it text: ...::text", of.name()))
            })?;
            let mut cells = Vec::with_capacity(values.len());
            for value in values {
                match value.unwrap_or(Self::Cell(Cell::Null)) {
                    Self::Cell(cell) => cells.push(cell),
                    unreadable @ Self::Unreadable(_) => return Ok(unreadable),
                }
            }
            return Ok(Self::Cell(Cell::List(cells.into())));
        }
        Ok(Self::Cell(match *kind {
            Type::BOOL => Cell::Boolean(bool::from_sql(kind, raw)?),
            Type::INT2 => Cell::Number(i16::from_sql(kind, raw)?.into()),
            Type::INT4 => Cell::Number(i32::from_sql(kind, raw)?.into()),
            #[allow(clippy::cast_precision_loss, reason = "Lua's own numbers are f64")]
            Type::INT8 => Cell::Number(i64::from_sql(kind, raw)? as f64),
            Type::OID => Cell::Number(u32::from_sql(kind, raw)?.into()),
            Type::FLOAT4 => Cell::Number(f32::from_sql(kind, raw)?.into()),
            Type::FLOAT8 => Cell::Number(f64::from_sql(kind, raw)?),
            Type::NUMERIC => numeric(raw).map_or(Cell::Null, Cell::Number),
            // The first byte is the version.
            Type::JSONB => text(raw.get(1..).unwrap_or_default()),
            Type::JSON => text(raw),
            Type::UUID => Cell::Text(uuid(raw).into()),
            _ if *kind == Type::BYTEA || kind.name() == "geometry" => {
                match blob::read(raw, &Budget::default()) {
                    Ok(geometry) => Cell::Geometry(Arc::new(geometry)),
                    Err(why) => return Ok(Self::Unreadable(why)),
                }
            }
            _ if is_text(kind) || kind.name() == "citext" || matches!(kind.kind(), Kind::Enum(_)) => {
                text(raw)
            }
            _ => {
                let (name, list) = match kind.kind() {
                    Kind::Array(of) => (of.name(), "[]"),
                    _ => (kind.name(), ""),
                };
                return Err(format!("is of type {name}{list}; make it text: ...::text").into());
            }
        }))
    }

    fn from_sql_null(_: &Type) -> Result<Self, BoxedError> {
        Ok(Self::Cell(Cell::Null))
    }

    fn accepts(_: &Type) -> bool {
        true
    }
}

/// Converts a number of arbitrary precision to the nearest `f64`. It is stored as groups of four digits and the
/// position of the decimal point.
fn numeric(raw: &[u8]) -> Option<f64> {
    let word = |index: usize| Some(i16::from_be_bytes(raw.get(2 * index..2 * index + 2)?.try_into().ok()?));
    let (count, weight, sign) = (word(0)?, word(1)?, word(2)?);
    let digits: Option<String> =
        (0..usize::try_from(count).ok()?).map(|index| Some(format!("{:04}", word(index + 4)?))).collect();
    let exponent = 4 * (i32::from(weight) - i32::from(count) + 1);
    let minus = if sign == 0x4000 { "-" } else { "" };
    // The remaining signs are NaN and infinities.
    if !matches!(sign, 0 | 0x4000) {
        return None;
    }
    let digits = digits?;
    format!("{minus}{}e{exponent}", if digits.is_empty() { "0" } else { &digits }).parse().ok()
}

fn uuid(raw: &[u8]) -> String {
    let hex: String = raw.iter().map(|byte| format!("{byte:02x}")).collect();
    let parts = [0..8, 8..12, 12..16, 16..20, 20..32].map(|range| hex.get(range).unwrap_or_default());
    parts.join("-")
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Types whose values can be read, and one whose values cannot.
    const KINDS: [Type; 16] = [
        Type::BOOL,
        Type::INT2,
        Type::INT4,
        Type::INT8,
        Type::OID,
        Type::FLOAT4,
        Type::FLOAT8,
        Type::NUMERIC,
        Type::JSON,
        Type::JSONB,
        Type::UUID,
        Type::BYTEA,
        Type::TEXT,
        Type::BPCHAR,
        Type::NAME,
        Type::DATE,
    ];

    proptest! {
        #[test]
        fn whatever_a_server_sends_is_a_cell_or_refused_and_never_a_panic(
            mut raw in prop::collection::vec(any::<u8>(), 0..80),
            groups in 0u8..20,
        ) {
            for is_number in [false, true] {
                if is_number {
                    // The prefix is the header of a number with this many groups of digits.
                    raw.splice(0..0, [0, groups, 0, 1, 0, 0, 0, 0]);
                }
                let read = KINDS.map(|kind| ServerCell::from_sql(&kind, &raw));
                prop_assert!(matches!(read[12], Ok(ServerCell::Cell(Cell::Text(_)))));
                prop_assert!(read[15].is_err());
                if let Ok(ServerCell::Cell(Cell::Geometry(geometry))) = &read[11] {
                    prop_assert!(geometry.is_sound());
                }
            }
        }
    }

    #[test]
    fn numbers_of_any_length_become_the_nearest_of_ours() {
        let words = |words: &[i16]| words.iter().flat_map(|word| word.to_be_bytes()).collect::<Vec<u8>>();
        assert_eq!(numeric(&words(&[0, 0, 0, 0])), Some(0.0));
        assert_eq!(numeric(&words(&[2, 0, 0, 2, 12, 3400])), Some(12.34));
        assert_eq!(numeric(&words(&[1, 1, 0x4000, 0, 5])), Some(-50_000.0));
        assert_eq!(numeric(&words(&[1, -1, 0, 4, 1])), Some(0.0001));
        assert_eq!(numeric(&words(&[0, 0, -0x4000, 0])), None);
        assert_eq!(numeric(&[0, 9]), None);
    }
}
