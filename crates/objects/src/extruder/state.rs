//! The state with which an extruder draws, and its current solid.

use std::sync::Arc;

use glam::DVec2;
use smallvec::SmallVec;

use super::options::ExtruderOptions;
use crate::surface::plain_material;
use burgeon_geometry::{Frame, Section, Station};
use burgeon_scene::Material;

/// The frame, the cross-section and the material of the next segment.
#[derive(Clone)]
pub(super) struct ExtruderState {
    pub(super) frame: Frame,
    pub(super) section: Arc<Section>,
    pub(super) scale: DVec2,
    pub(super) taper: DVec2,
    pub(super) bend: f64,
    pub(super) toward: f64,
    pub(super) twist: f64,
    pub(super) along: u32,
    pub(super) around: u32,
    pub(super) smooth: bool,
    pub(super) caps: [bool; 2],
    pub(super) material: Arc<Material>,
    pub(super) run: Option<SolidRun>,
}

/// Segments that form one solid.
#[derive(Clone)]
pub(super) struct SolidRun {
    pub(super) stations: SmallVec<[Station; 2]>,
    /// Module that drew up to each station.
    pub(super) makers: SmallVec<[u32; 2]>,
    pub(super) section: Arc<Section>,
    pub(super) end: Frame,
    /// Length (m) of the last step without the part that a joint at its start takes.
    pub(super) free: f64,
    pub(super) scale: DVec2,
    pub(super) smooth: bool,
    pub(super) caps: [bool; 2],
    pub(super) material: Arc<Material>,
}

impl ExtruderState {
    pub(super) fn begin(options: &ExtruderOptions, section: &Arc<Section>) -> Self {
        let mut frame = Frame::default();
        frame.face(options.heading.0);
        let material = plain_material(options.color, options.roughness, options.metallic);
        Self {
            frame,
            section: Arc::clone(section),
            scale: DVec2::ONE,
            taper: DVec2::ONE,
            bend: 0.0,
            toward: 0.0,
            twist: 0.0,
            along: options.along,
            around: options.around,
            smooth: options.smooth,
            caps: [options.caps; 2],
            material: Arc::new(material),
            run: None,
        }
    }
}
