//! Survey of the sources of a script, and sources of which a run reads only a part.

use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};

use burgeon_base::error::{Error, Result};
use burgeon_base::locks::LockRecovery;
use burgeon_data::{FrameExtent, Layer, RecordChoice, Source, SourceOptions, each_piece};
use burgeon_spatial::{Crs, ReferenceFrame};

/// Source of a script that a survey has found.
#[derive(Debug, Clone)]
pub struct SurveyedSource {
    /// Text that identifies the call of `source` in the script.
    pub key: String,
    /// File.
    pub path: PathBuf,
    /// Name of the file as the script writes it.
    pub name: String,
    /// Options of the call.
    pub options: SourceOptions,
    /// File and layer.
    pub label: String,
}

/// Record of the sources that a script loads. A run with a survey gets the layers without their features, so that memory
/// does not grow with the data.
#[derive(Debug, Default)]
pub struct SourceSurvey {
    /// Set if the run gets the features too.
    keeps_features: bool,
    found: Mutex<Vec<SurveyedSource>>,
    frame: Mutex<Option<(Crs, [f64; 2])>>,
}

impl SourceSurvey {
    /// Creates an empty record; if `keeps_features` is set, the run gets the features too.
    pub fn new(keeps_features: bool) -> Self {
        Self { keeps_features, ..Self::default() }
    }

    /// Returns the sources, in the order of loading.
    pub fn sources(&self) -> Vec<SurveyedSource> {
        self.found.lock().recover().clone()
    }

    /// Returns the coordinate system and the place around which [`ReferenceFrame::around`] makes the frame of the run; `None`
    /// if a source that is no file determines it.
    pub fn frame(&self) -> Option<(Crs, [f64; 2])> {
        self.frame.lock().recover().clone()
    }

    /// Reads the layer of a source, and records it.
    pub(super) fn read(
        &self,
        mut source: SurveyedSource,
        frame: &mut Option<ReferenceFrame>,
    ) -> Result<Layer> {
        let SurveyedSource { path, name, options, .. } = &source;
        let is_first = frame.is_none();
        let (mut first, mut extent) = (None, FrameExtent::default());
        each_piece(path, name, options, |mut table| {
            if is_first {
                extent.add(&mut table)?;
            }
            first.get_or_insert(table);
            Ok(if is_first { ControlFlow::Continue(()) } else { ControlFlow::Break(()) })
        })?;
        let mut table = first.ok_or_else(|| Error::internal("a layer has no pieces"))?;
        if is_first {
            let (crs, place) = extent.centre(&table.shown)?;
            *frame = Some(ReferenceFrame::around(&crs, place, &table.shown)?);
            *self.frame.lock().recover() = Some((crs, place));
        }
        if self.keeps_features {
            table = Source::open_within(path, name, options)?.read(name, options)?;
        }
        let mut layer = Layer::new(table, frame)?;
        if !self.keeps_features {
            layer.features.clear();
            layer.refused.clear();
            layer.notes.clear();
            (layer.empty, layer.collapsed, layer.derived) = (0, 0, 0);
        }
        source.label.clone_from(&layer.shown);
        self.found.lock().recover().push(source);
        Ok(layer)
    }
}

/// Features of a source that a run reads.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WindowBox {
    /// West, south, east and north (m) of a box relative to the origin of the frame. The run reads the features that touch it.
    pub needed: [f64; 4],
    /// Set if the file may be read partially; otherwise it is read once and the features are chosen from it.
    pub in_parts: bool,
    /// Minimum and maximum coordinates (m) of all features, which the script sees as those of the source.
    pub bounds: [[f64; 3]; 2],
}

/// Sources of which a run reads only the features in a box. Other sources are read completely.
#[derive(Default)]
pub struct SourceWindow {
    /// Frame of the run.
    pub(super) frame: Option<ReferenceFrame>,
    boxes: BTreeMap<String, WindowBox>,
    served: Mutex<Vec<(String, Arc<Layer>)>>,
}

impl SourceWindow {
    /// Creates a window in the coordinates of `frame`, with a box for each source by its key.
    pub fn new(frame: ReferenceFrame, boxes: BTreeMap<String, WindowBox>) -> Self {
        Self { frame: Some(frame), boxes, served: Mutex::default() }
    }

    /// Returns the layers that the run has read, by the keys of their sources. They have all features that touch the boxes,
    /// and may have others.
    pub fn served(&self) -> Vec<(String, Arc<Layer>)> {
        self.served.lock().recover().clone()
    }

    pub(super) fn serve(&self, key: &str, layer: &Arc<Layer>) {
        self.served.lock().recover().push((key.to_owned(), Arc::clone(layer)));
    }

    /// Reads the features of a source in its box from the file at `path`; `None` if the file is to be read completely.
    pub(super) fn read(
        &self,
        key: &str,
        path: &Path,
        name: &str,
        wanted: &SourceOptions,
    ) -> Result<Option<Layer>> {
        let Some(WindowBox { needed, in_parts: true, bounds }) = self.boxes.get(key) else { return Ok(None) };
        let Some(frame) = &self.frame else { return Ok(None) };
        if wanted.limit.is_some() || wanted.within.is_some() {
            return Ok(None);
        }
        let mut part = SourceOptions { records: Some(RecordChoice::Indexed), ..wanted.clone() };
        let source = Source::open_within(path, name, &part)?;
        if !matches!(source, Source::GeoPackage(_)) {
            return Ok(None);
        }
        // The box is in the coordinates of the file, which an empty piece tells.
        part.records = Some(RecordChoice::After { key: i64::MAX, most: 0 });
        let crs = Source::open_within(path, name, &part)?.read(name, &part)?.crs?;
        let within = frame.passage(&crs)?.leave_box(*needed);
        let Some(within) = within else { return Ok(None) };
        (part.records, part.within) = (Some(RecordChoice::Indexed), Some(within));
        let table = source.read(name, &part)?;
        let mut frame = Some(frame.clone());
        let layer = Layer::new(table, &mut frame)?;
        Ok(Some(Layer { bounds: *bounds, ..layer }))
    }

    /// Returns the features of a complete `layer` whose bounds touch the box of the source.
    pub(super) fn choose(&self, key: &str, layer: &Layer) -> Option<Layer> {
        let WindowBox { needed: [west, south, east, north], .. } = *self.boxes.get(key)?;
        let touches = |feature: &&burgeon_data::Feature| {
            feature.geometry.bounds().is_some_and(|[low, high]| {
                low.x <= east && high.x >= west && low.y <= north && high.y >= south
            })
        };
        Some(Layer {
            name: layer.name.clone(),
            shown: layer.shown.clone(),
            crs: layer.crs.clone(),
            origin: layer.origin,
            names: layer.names.clone(),
            features: layer.features.iter().filter(touches).cloned().collect(),
            bounds: layer.bounds,
            empty: 0,
            collapsed: 0,
            refused: Vec::new(),
            notes: Vec::new(),
            derived: 0,
        })
    }
}
