//! Animation of a film: it shows the node of one frame after another by scales of 1 and 0.

use super::body::{Body, BodyArray};
use super::description::{Accessor, Description, Extreme};
use super::mesh::accessor;
use crate::film_settings::FilmSettings;
use gltf_json as json;
use json::accessor::{ComponentType, Type};
use serde_json::json;

/// Scales of the first, of a middle and of the last frame, at the times of [`times`].
const SCALES: [&[f32]; 3] = [&[1.0, 0.0, 0.0], &[0.0, 1.0, 0.0, 0.0], &[0.0, 1.0, 1.0]];

/// Adds the animation of `frames`, the nodes of the frames that show something. A single frame is not animated.
pub(super) fn write(
    frames: &[(u32, usize)],
    settings: &FilmSettings,
    description: &mut Description<'_>,
    body: &mut Body<'_>,
) {
    if frames.is_empty() || settings.frames < 2 {
        return;
    }
    let all: Vec<Vec<f32>> = frames.iter().map(|(frame, _)| times(*frame, settings)).collect();
    let times_view = body.add(BodyArray::Floats(all.concat()));
    let scales: Vec<f32> = SCALES.concat().iter().flat_map(|scale| [*scale; 3]).collect();
    let scales_view = body.add(BodyArray::Floats(scales));
    let mut offset = 0;
    let outputs = SCALES.map(|scales| {
        let array = accessor((scales_view, offset), ComponentType::F32, Type::Vec3, scales.len());
        offset += scales.len() as u64 * 12;
        description.accessor(array)
    });
    let (mut channels, mut samplers) = (Vec::new(), Vec::new());
    let mut offset = 0;
    for ((frame, node), times) in frames.iter().zip(&all) {
        let extreme = |time: Option<&f32>| time.map(|time| Extreme::Number([*time]));
        let array = accessor((times_view, offset), ComponentType::F32, Type::Scalar, times.len());
        let array = Accessor { min: extreme(times.first()), max: extreme(times.last()), ..array };
        offset += times.len() as u64 * 4;
        let input = description.accessor(array);
        let output = outputs[usize::from(*frame > 0) + usize::from(frame + 1 == settings.frames)];
        channels.push(json!({ "sampler": samplers.len(), "target": { "node": node, "path": "scale" } }));
        samplers.push(json!({ "input": input, "interpolation": "STEP", "output": output }));
    }
    description.animations.push(json!({ "channels": channels, "name": "film", "samplers": samplers }));
}

/// Returns the times (s) at which the scale of a frame is set: the beginning of the film and of the frame, the end of
/// the frame, and the end of the film.
fn times(frame: u32, settings: &FilmSettings) -> Vec<f32> {
    let mut numbers = vec![0, frame, frame + 1, settings.frames];
    numbers.dedup();
    numbers.into_iter().map(|number| settings.time_of(number) as f32).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::films::{FilmFrame, FilmWriter};
    use crate::samples;
    use burgeon_base::stop::Stop;
    use burgeon_scene::Scene;
    use gltf::animation::util::ReadOutputs;
    use gltf::animation::{Interpolation, Property};
    use std::sync::Arc;

    /// Returns the file of a film of these models with 2 frames per second.
    fn film(models: Vec<Scene>) -> gltf::Gltf {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("film.glb");
        let settings =
            FilmSettings { frames: models.len() as u32, fps: 2.0, size: (8, 8), transparent: false };
        let paths = [path.clone()];
        let mut writer = FilmWriter::new(&paths, settings, 1 << 30, &Arc::new(Stop::new())).unwrap();
        assert!(writer.needs().scenes && !writer.needs().images);
        for scene in models {
            writer.add(FilmFrame { scene: Some(scene), ..FilmFrame::default() }).unwrap();
        }
        writer.finish().unwrap();
        // The crate does not know the extension of instances.
        gltf::Gltf::from_slice_without_validation(&std::fs::read(path).unwrap()).unwrap()
    }

    /// Returns the numbers of the frames that are visible at `time` (s).
    fn visible(file: &gltf::Gltf, time: f32) -> Vec<String> {
        let animation = file.animations().next().unwrap();
        let mut shown = Vec::new();
        for channel in animation.channels() {
            assert_eq!(channel.sampler().interpolation(), Interpolation::Step);
            assert_eq!(channel.target().property(), Property::Scale);
            let reader = channel.reader(|_| file.blob.as_deref());
            let times: Vec<f32> = reader.read_inputs().unwrap().collect();
            assert!(times.is_sorted_by(|a, b| a < b), "{times:?}");
            let Some(ReadOutputs::Scales(scales)) = reader.read_outputs() else { panic!("no scales") };
            let scales: Vec<[f32; 3]> = scales.collect();
            assert_eq!(scales.len(), times.len());
            let at = times.iter().rposition(|known| *known <= time).unwrap_or(0);
            if scales[at] == [1.0; 3] {
                shown.push(channel.target().node().name().unwrap().to_owned());
            }
        }
        shown
    }

    #[test]
    fn one_frame_after_another_is_visible() {
        for count in [2, 3, 7] {
            let file = film((1..=count).map(samples::boxes).collect());
            for number in 0..count {
                let expected = vec![format!("frame {number}")];
                assert_eq!(visible(&file, number as f32 * 0.5 + 0.25), expected, "of {count}");
            }
            assert_eq!(visible(&file, 99.0), [format!("frame {}", count - 1)]);
            assert_eq!(file.meshes().count(), 1);
            let scene = file.scenes().next().unwrap();
            let sizes: Vec<usize> = scene.nodes().map(|node| node.children().count()).collect();
            assert_eq!(sizes, (1..=count).collect::<Vec<_>>());
            // Programs without animations show the first frame.
            let first = scene.nodes().filter(|node| node.transform().decomposed().2 == [1.0; 3]);
            assert_eq!(first.map(|node| node.name().unwrap().to_owned()).collect::<Vec<_>>(), ["frame 0"]);
        }
    }

    #[test]
    fn frames_that_show_nothing_are_empty_and_keep_their_time() {
        let mut row = samples::boxes(40);
        row.instances.iter_mut().for_each(|instance| instance.name = "box".into());
        let file = film(vec![Scene::default(), row, Scene::default()]);
        assert!(visible(&file, 0.25).is_empty() && visible(&file, 1.25).is_empty());
        assert_eq!(visible(&file, 0.75), ["frame 1"]);
        // The instances of a frame share a node.
        assert_eq!(file.scenes().next().unwrap().nodes().next().unwrap().children().count(), 1);
        assert_eq!(film(vec![samples::boxes(1)]).animations().count(), 0);
    }
}
