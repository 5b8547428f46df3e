//! The features of a data file, on their way from a source to a constructor.

use std::sync::Arc;

use super::{Kind, Object, Table};
use crate::error::{Error, Result};
use crate::scene::Scene;
use crate::sources::Layer;

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
        construct: |_: &Table| Err(Error::new("a source is made of a file").help("write source(\"a.gpkg\")")),
    };
}

impl Object for Features {
    fn kind(&self) -> &'static Kind {
        const { &Self::KIND }
    }

    fn boxed(&self) -> Box<dyn Object> {
        Box::new(self.clone())
    }

    fn show(&self, _: &mut Scene, _: &str, _: Option<&str>) -> Result<()> {
        Ok(())
    }
}
