//! Vectors and scales as types of fields and arguments.

use std::sync::{Arc, LazyLock};

use glam::DVec3;

use crate::{Expectation, ObjectContent, Parameter, Table, TableKey, Value};

/// Two or three numbers, as a list or with the names x, y and z. Two numbers have the z value 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Vector(pub DVec3);

/// A scale for each axis, or one scale for all axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AxisScale(pub DVec3);

/// Names in the tables of all vectors.
struct VectorNames {
    class: Arc<str>,
    parts: [Arc<str>; 3],
}

static NAMES: LazyLock<VectorNames> =
    LazyLock::new(|| VectorNames { class: "vec".into(), parts: ["x", "y", "z"].map(Into::into) });

/// Returns the vector of a table that [`Vector::into_value`] has made, if its numbers are finite.
fn finite_vector(table: &Table) -> Option<DVec3> {
    let VectorNames { class, parts } = &*NAMES;
    if !table.class.as_ref().is_some_and(|known| Arc::ptr_eq(known, class)) {
        return None;
    }
    let [x, y, z] = table.entries.as_slice() else { return None };
    let number = |(key, value): &(TableKey, Value), name: &Arc<str>| match (key, value) {
        (TableKey::Name(key), Value::Number(number)) if Arc::ptr_eq(key, name) => Some(*number),
        _ => None,
    };
    let vector = DVec3::new(number(x, &parts[0])?, number(y, &parts[1])?, number(z, &parts[2])?);
    vector.is_finite().then_some(vector)
}

impl Vector {
    /// Replaces `value` by the script's value of the vector, in the memory of a vector that nothing else uses.
    ///
    /// ```
    /// use burgeon_kit::{Parameter, Value, Vector};
    ///
    /// let mut value = Vector::from([1.0, 2.0, 3.0]).into_value();
    /// Vector::from([4.0, 5.0, 6.0]).store_in(&mut value);
    /// assert_eq!(value, Vector::from([4.0, 5.0, 6.0]).into_value());
    /// ```
    pub fn store_in(self, value: &mut Value) {
        let class = &NAMES.class;
        if let Value::Table(table) = value
            && let Some(Table { class: Some(known), entries }) = Arc::get_mut(table)
            && Arc::ptr_eq(known, class)
            && let [(_, Value::Number(x)), (_, Value::Number(y)), (_, Value::Number(z))] =
                entries.as_mut_slice()
        {
            (*x, *y, *z) = self.0.into();
        } else {
            *value = self.into_value();
        }
    }
}

impl From<[f64; 3]> for Vector {
    fn from(parts: [f64; 3]) -> Self {
        Self(DVec3::from_array(parts))
    }
}

impl Default for AxisScale {
    fn default() -> Self {
        Self(DVec3::ONE)
    }
}

impl Parameter for AxisScale {
    fn luau() -> String {
        "number | Vector".into()
    }

    fn from_value(value: Value) -> Result<Self, Expectation> {
        match value {
            Value::Number(_) => f64::from_value(value).map(|scale| Self(DVec3::splat(scale))),
            value => {
                let found = Vector::read_value(&value);
                found.map(|Vector(scale)| Self(scale)).map_err(|_| {
                    Expectation::new("a number, or a vector with a scale for each axis").found(&value)
                })
            }
        }
    }

    fn into_value(self) -> Value {
        Vector(self.0).into_value()
    }
}

impl Parameter for Vector {
    fn luau() -> String {
        "Vector".into()
    }

    fn read_value(value: &Value) -> Result<Self, Expectation> {
        if let Value::Table(table) = value
            && let Some(vector) = finite_vector(table)
        {
            return Ok(Self(vector));
        }
        Self::from_value(value.clone())
    }

    fn from_value(value: Value) -> Result<Self, Expectation> {
        let what = || Expectation::new("a vector: { x, y, z } or vec(x, y, z)");
        if let Value::Object(object) = &value
            && let Some(position) = object.capability::<dyn ObjectContent>().and_then(|it| it.position())
        {
            return Ok(Self(position));
        }
        let Value::Table(table) = value else { return Err(what()) };
        if let Some(vector) = finite_vector(&table) {
            return Ok(Self(vector));
        }
        let mut parts = table.list();
        if parts.is_empty() {
            parts = ["x", "y", "z"].iter().filter_map(|name| table.get(name)).collect();
        }
        let number = |part: &Value| match part {
            Value::Number(number) if !number.is_finite() => {
                Err(Expectation::new("a vector of finite numbers").found(&Value::Table(Arc::clone(&table))))
            }
            part => f64::read_value(part).map_err(|_| what()),
        };
        let numbers: Vec<f64> = parts.into_iter().map(number).collect::<Result<_, _>>()?;
        match numbers.as_slice() {
            [x, y] => Ok(Self(DVec3::new(*x, *y, 0.0))),
            [x, y, z] => Ok(Self(DVec3::new(*x, *y, *z))),
            _ => Err(what()),
        }
    }

    fn into_value(self) -> Value {
        let VectorNames { class, parts: [x, y, z] } = &*NAMES;
        let entry = |name: &Arc<str>, part: f64| (TableKey::Name(Arc::clone(name)), Value::Number(part));
        let entries = vec![entry(x, self.0.x), entry(y, self.0.y), entry(z, self.0.z)];
        Value::Table(Arc::new(Table { class: Some(Arc::clone(class)), entries }))
    }

    fn written(self) -> String {
        format!("vec({}, {}, {})", self.0.x, self.0.y, self.0.z)
    }
}

impl Parameter for DVec3 {
    fn luau() -> String {
        Vector::luau()
    }

    fn from_value(value: Value) -> Result<Self, Expectation> {
        Vector::from_value(value).map(|vector| vector.0)
    }

    fn into_value(self) -> Value {
        Vector(self).into_value()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_vector_is_read_from_its_own_table_and_from_others() {
        let vector = Vector::from([1.0, -2.0, 0.5]);
        assert_eq!(Vector::from_value(vector.into_value()).ok(), Some(vector));
        assert!(Vector::from_value(Vector::from([1.0, f64::NAN, 0.0]).into_value()).is_err());
        let mut value = vector.into_value();
        let shared = value.clone();
        Vector::from([4.0, 5.0, 6.0]).store_in(&mut value);
        assert_eq!(Vector::read_value(&shared).ok(), Some(vector), "a shared value keeps its numbers");
        assert_eq!(Vector::read_value(&value).ok(), Some(Vector::from([4.0, 5.0, 6.0])));
        let list =
            [3.0, 4.0].iter().zip(1..).map(|(part, place)| (TableKey::Index(place), Value::Number(*part)));
        let list = Value::Table(Arc::new(Table { class: None, entries: list.collect() }));
        assert_eq!(Vector::from_value(list).ok(), Some(Vector::from([3.0, 4.0, 0.0])));
    }

    #[test]
    fn a_scale_is_one_number_or_one_for_each_axis() {
        let axes = Vector(DVec3::new(2.0, 3.0, 4.0)).into_value();
        assert_eq!(AxisScale::from_value(Value::Number(2.0)).ok(), Some(AxisScale(DVec3::splat(2.0))));
        assert_eq!(AxisScale::from_value(axes).ok(), Some(AxisScale(DVec3::new(2.0, 3.0, 4.0))));
        assert!(AxisScale::from_value(Value::Text("large".into())).is_err());
        assert_eq!(AxisScale::default(), AxisScale(DVec3::ONE));
    }
}
