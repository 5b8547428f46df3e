//! The features of a data file and their geometries, on their way from a source to a constructor.

use std::sync::Arc;

use super::{Ahead, Key, Kind, Object, Parameter, Table, Value};
use crate::error::Error;
use crate::sources::{Geometry, Layer};

/// The features of a source. A constructor may take them; no script holds them in this form.
#[derive(Clone)]
pub struct Features(pub Arc<Layer>);

impl Features {
    const KIND: Kind = Kind {
        name: "source",
        doc: "The features of a data file.",
        fields: &[],
        first: None,
        methods: &[],
        construct: |_: &Table| {
            Err(Error::argument("a source is made of a file").help("write source(\"a.gpkg\")"))
        },
    };
}

impl Object for Features {
    fn kind(&self) -> &'static Kind {
        const { &Self::KIND }
    }

    fn boxed(&self) -> Box<dyn Object> {
        Box::new(self.clone())
    }
}

/// The geometry of a feature. A constructor may take it; scripts see it as a table.
#[derive(Clone)]
pub struct Shape {
    layer: Arc<Layer>,
    index: usize,
    ahead: Option<Arc<Ahead>>,
}

impl Shape {
    const KIND: Kind = Kind {
        name: "geometry",
        doc: "The geometry of a feature.",
        fields: &[],
        first: None,
        methods: &[],
        construct: |_: &Table| Err(Error::argument("a geometry is what a feature has")),
    };

    /// That of the feature with this number, from 0; `None` if there is none. Its plan may be made `ahead`.
    pub(crate) fn new(layer: &Arc<Layer>, index: usize, ahead: Option<&Arc<Ahead>>) -> Option<Self> {
        let there = index < layer.features.len();
        there.then(|| Self { layer: Arc::clone(layer), index, ahead: ahead.cloned() })
    }

    /// Where its plan may have been made already, and its feature's number there.
    pub(super) fn ahead(&self) -> Option<(&Ahead, usize)> {
        self.ahead.as_deref().map(|ahead| (ahead, self.index))
    }

    /// The geometry itself.
    pub fn geometry(&self) -> &Geometry {
        &self.layer.features[self.index].geometry
    }

    /// The table that scripts see.
    pub(crate) fn to_table(&self) -> Value {
        let points = |points: &[[f64; 3]]| points.iter().map(|point| point.to_vec()).collect::<Vec<_>>();
        let geometry = self.geometry();
        let (name, lists) = match geometry {
            Geometry::Polygon(rings) => {
                ("rings", rings.iter().map(|ring| points(ring)).collect::<Vec<_>>().into_value())
            }
            Geometry::Line(line) => ("points", points(line).into_value()),
            Geometry::Point(point) => ("points", points(&[*point]).into_value()),
        };
        let kind = Value::Text(geometry.kind().name().into());
        let entries = vec![(Key::Name("kind".into()), kind), (Key::Name(name.into()), lists)];
        Value::Table(Arc::new(Table { class: None, entries }))
    }
}

impl Object for Shape {
    fn kind(&self) -> &'static Kind {
        const { &Self::KIND }
    }

    fn boxed(&self) -> Box<dyn Object> {
        Box::new(self.clone())
    }
}
