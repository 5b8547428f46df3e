//! Converts samples to pixels: finds the surfaces that each pixel sees, shades them, and mixes the colours.

use super::super::settings::{Background, Picture};
use super::coverage::noise;
use super::detail::RenderDetail;
use super::shade::{Fragment, Light};
use super::share;
use super::sky::smooth;
use super::surface::{SeenPoint, SeenTriangle, SurfacePoint};
use super::tone;
use super::visible::Visible;
use burgeon_base::srgb_byte;
use burgeon_scene::image::Image;
use glam::{Vec2, Vec3, Vec3A, Vec4};
use rayon::prelude::*;
use std::f32::consts::TAU;
use std::sync::atomic::{AtomicBool, Ordering};

/// Maximum number of samples in memory, which takes 8 bytes for each.
const HELD: usize = 32_000_000;
/// Width and height (pixels) of a tile that is shaded together.
const TILE: [usize; 2] = [32, 16];
/// Distances from the model, in the stage's units, up to which the ground shows its full shadow, and from which on it
/// shows none.
const FADE: [f32; 2] = [0.7, 2.4];

/// Samples of a pixel that see the same triangle, or none.
struct SampleGroup {
    pixel: usize,
    /// Number of the triangle.
    number: Option<u32>,
    /// Mean of the samples' pixel coordinates.
    place: [f32; 2],
    /// Fraction of the pixel.
    weight: f32,
}

/// Contribution of a fragment to its pixel.
struct FragmentShare {
    pixel: usize,
    weight: f32,
    ground: bool,
}

/// Computes the image of a scene in `light`, and returns true with it if it shows the model.
pub(super) fn develop(light: &Light, picture: &Picture, detail: &RenderDetail) -> (Image, bool) {
    let (width, height) = (picture.width as usize, picture.height as usize);
    let mut pixels = vec![[0; 4]; width * height];
    let is_seen = AtomicBool::new(false);
    let progress = light.stage.stop.progress();
    progress.begin("shading", "pixels", width * height);
    let band = (HELD / (width * detail.samples())).max(TILE[1]) / TILE[1] * TILE[1];
    for (index, rows) in pixels.chunks_mut(band * width).enumerate() {
        // A band takes time and memory even if nothing is drawn after cancellation, so stop here.
        if light.stage.stop.is_stopped() {
            break;
        }
        let first = index * band;
        let last = (first + band).min(height);
        let visible = Visible::new(light.stage, light.camera, detail, width, first..last);
        rows.par_chunks_mut(TILE[1] * width).enumerate().for_each(|(index, rows)| {
            let top = first + index * TILE[1];
            for left in (0..width).step_by(TILE[0]) {
                if light.stage.stop.is_stopped() {
                    return;
                }
                let size = [TILE[0].min(width - left), rows.len() / width];
                let tile = tile(light, picture, detail, &visible, [left, top], size, &is_seen);
                progress.add(tile.len());
                for (y, line) in tile.chunks(size[0]).enumerate() {
                    rows[y * width + left..][..line.len()].copy_from_slice(line);
                }
            }
        });
    }
    let image = Image::from_pixels(picture.width, picture.height, pixels);
    (image.unwrap_or_else(|| Image::filled(0, 0, [0; 4])), is_seen.into_inner())
}

/// Computes the colours of the pixels of a tile, from `corner` on. Sets `is_seen` if one shows the model.
fn tile(
    light: &Light,
    picture: &Picture,
    detail: &RenderDetail,
    visible: &Visible,
    corner: [usize; 2],
    size: [usize; 2],
    is_seen: &AtomicBool,
) -> Vec<[u8; 4]> {
    let mut fragments: Vec<Fragment> = Vec::new();
    let mut shares: Vec<FragmentShare> = Vec::new();
    let mut colors = vec![Vec4::ZERO; size[0] * size[1]];
    let at = |pixel: usize| [corner[0] + pixel % size[0], corner[1] + pixel / size[0]];
    let groups = group_samples(visible, detail, colors.len(), at);
    let mut hint = 0;
    let find =
        |group: &SampleGroup| group.number.map(|number| SeenTriangle::find(light.stage, &mut hint, number));
    let mut triangles: Vec<Option<SeenTriangle>> = groups.iter().map(find).collect();
    triangles.iter_mut().flatten().for_each(SeenTriangle::read);
    let mut pairs = groups.iter().zip(&triangles).peekable();
    for (pixel, color) in colors.iter_mut().enumerate() {
        let first = fragments.len();
        let [x, y] = at(pixel);
        let spin = Vec2::from_angle(noise(x as u32, y as u32, 1) * TAU);
        while let Some((&SampleGroup { weight, place, .. }, triangle)) =
            pairs.next_if(|(group, _)| group.pixel == pixel)
        {
            let (surface, ground) = match triangle {
                Some(triangle) => {
                    let seen = SeenPoint::at_pixel(light.stage, light.images, light.camera, triangle, place);
                    // Triangles of one smooth surface are shaded as one fragment.
                    let alike = (first..fragments.len()).find(|i| fragments[*i].joins(&seen.surface));
                    if let Some(i) = alike {
                        shares[i].weight += weight;
                        continue;
                    }
                    (seen.finish(light.camera), false)
                }
                None => match ground(light, place) {
                    Some(surface) => (surface, true),
                    None => {
                        *color += backdrop(light, picture, place) * weight;
                        continue;
                    }
                },
            };
            fragments.push(Fragment::new(surface, spin, fragments.len()));
            shares.push(FragmentShare { pixel, weight, ground });
        }
        if !detail.pools_light {
            share::take_turns(&mut fragments[first..], light.sky.maps.len(), detail.turns, [x, y]);
        }
    }
    let pixels: Vec<usize> = shares.iter().map(|share| share.pixel).collect();
    if detail.pools_light {
        share::pool_light(&mut fragments, &pixels, size, light.camera);
    }
    let mut gathered = light.gather(&fragments, fragments.len());
    if detail.turns > 1 {
        gathered = share::add_neighbours(&fragments, &pixels, &gathered, size, light.camera);
    }
    if shares.iter().any(|share| !share.ground) {
        is_seen.store(true, Ordering::Relaxed);
    }
    for (fragment, share) in fragments.iter().zip(&shares) {
        let gathered = &gathered[fragment.pool];
        let pixel = share.pixel;
        let place = [(corner[0] + pixel % size[0]) as f32 + 0.5, (corner[1] + pixel / size[0]) as f32 + 0.5];
        let position = fragment.surface.position;
        let color = if share.ground {
            let fade = fade(light, position);
            let part = Vec3::ONE.lerp(light.ground(fragment, gathered), fade);
            let color = shade_backdrop(backdrop(light, picture, place), part);
            // The studio's ground is its background.
            if picture.background == Background::Sky {
                hazy(light, picture, color, position, place)
            } else {
                color
            }
        } else {
            let color = tone::compress(light.color(fragment, gathered)).extend(1.0);
            hazy(light, picture, color, position, place)
        };
        colors[share.pixel] += color * share.weight;
    }
    colors.into_iter().map(encode).collect()
}

/// Returns the samples of `count` pixels of a tile, which are `at` these coordinates, joined by triangle.
fn group_samples(
    visible: &Visible,
    detail: &RenderDetail,
    count: usize,
    at: impl Fn(usize) -> [usize; 2],
) -> Vec<SampleGroup> {
    let mut groups = Vec::with_capacity(2 * count);
    let mut seen: Vec<(Option<u32>, f32, [f32; 2])> = Vec::new();
    for pixel in 0..count {
        let [x, y] = at(pixel);
        seen.clear();
        visible.each_sample(x, y, |number, [px, py]| {
            match seen.iter_mut().find(|(known, ..)| *known == number) {
                Some((_, count, sum)) => {
                    *count += 1.0;
                    *sum = [sum[0] + px, sum[1] + py];
                }
                None => seen.push((number, 1.0, [px, py])),
            }
        });
        let kept = limit_surfaces(&mut seen, detail.surfaces);
        groups.extend(seen.iter().map(|(number, count, sum)| SampleGroup {
            pixel,
            number: *number,
            place: sum.map(|sum| sum / count),
            weight: count * if number.is_some() { kept } else { 1.0 } / detail.samples() as f32,
        }));
    }
    groups
}

/// Keeps at most `most` surfaces of a pixel: the background, if it is seen, and those of the model with the most samples. The
/// samples of the others count as those of the kept ones, so that the model covers as much of the background. Returns the
/// factor of the samples of the model.
fn limit_surfaces(seen: &mut Vec<(Option<u32>, f32, [f32; 2])>, most: usize) -> f32 {
    let samples = |seen: &[(Option<u32>, f32, [f32; 2])]| {
        seen.iter().filter(|(number, ..)| number.is_some()).map(|(_, count, _)| count).sum::<f32>()
    };
    let ground = seen.iter().position(|(number, ..)| number.is_none());
    if seen.len() <= most {
        return 1.0;
    }
    let ground = ground.map(|index| seen.remove(index));
    let all = samples(seen);
    // The order of the samples is the same for any number of threads, and the sort is stable.
    seen.sort_by(|(_, a, _), (_, b, _)| b.total_cmp(a));
    seen.truncate((most - usize::from(ground.is_some())).max(1));
    let kept = samples(seen);
    seen.extend(ground);
    all / kept
}

/// Returns the background at pixel coordinates `place`: a linear colour times its opacity, and the opacity.
fn backdrop(light: &Light, picture: &Picture, place: [f32; 2]) -> Vec4 {
    let (top, bottom) = match picture.background {
        Background::Light => (Vec3::new(0.560, 0.590, 0.620), Vec3::new(0.775, 0.765, 0.740)),
        Background::Dark => (Vec3::new(0.020, 0.022, 0.026), Vec3::new(0.062, 0.064, 0.070)),
        Background::Sky => {
            let (_, ray) = light.camera.ray(place[0], place[1]);
            return tone::compress(light.sky.visible(ray.normalize())).extend(1.0);
        }
        Background::Clear => return Vec4::ZERO,
    };
    top.lerp(bottom, smooth(0.0, 1.0, place[1] / picture.height as f32)).extend(1.0)
}

/// Returns `color` behind the haze between the camera and `position`, at the pixel coordinates `place`.
fn hazy(light: &Light, picture: &Picture, color: Vec4, position: Vec3A, place: [f32; 2]) -> Vec4 {
    let Some(haze) = picture.haze else { return color };
    let metres = f64::from(light.camera.distance(position)) / light.stage.shrink.matrix3.x_axis.length();
    let kept = (-metres.max(0.0) / haze).exp() as f32;
    let air = match picture.background {
        Background::Light | Background::Dark => backdrop(light, picture, place).truncate(),
        Background::Sky | Background::Clear => {
            let (_, ray) = light.camera.ray(place[0], place[1]);
            // Haze has the colour of the sky above the horizon.
            tone::compress(light.sky.visible(ray.with_z(ray.z.max(0.0)).normalize_or(Vec3A::X)))
        }
    };
    (color.truncate().lerp(air * color.w, 1.0 - kept)).extend(color.w)
}

/// Returns `backdrop` with a ground in front of it that receives this fraction of its light.
fn shade_backdrop(backdrop: Vec4, part: Vec3) -> Vec4 {
    if backdrop.w > 0.0 {
        return (backdrop.truncate() * part).extend(backdrop.w);
    }
    // Images are composited by their sRGB values, in which half the light is about three quarters.
    Vec4::new(0.0, 0.0, 0.0, 1.0 - (part.element_sum() / 3.0).powf(1.0 / 2.2))
}

/// Returns the ground at pixel coordinates `place`, if it is visible there and near enough to show a shadow.
fn ground(light: &Light, place: [f32; 2]) -> Option<SurfacePoint> {
    let floor = light.floor?.height;
    let (eye, ray) = light.camera.ray(place[0], place[1]);
    let height = eye.z - floor;
    if height <= 0.0 || ray.z >= -1e-6 {
        return None;
    }
    let position = eye + ray * (height / -ray.z);
    (fade(light, position) > 0.0).then(|| SurfacePoint::ground(position, light.camera))
}

/// Returns the strength, 0 to 1, of the ground's shadow at `position`.
fn fade(light: &Light, position: Vec3A) -> f32 {
    let (low, high) = light.stage.bounds;
    let outside = (position - position.clamp(low, high)).with_z(0.0).length();
    1.0 - smooth(FADE[0], FADE[1], outside)
}

/// Encodes a linear colour times its opacity, and the opacity, as an sRGB pixel.
fn encode(color: Vec4) -> [u8; 4] {
    let opacity = color.w.clamp(0.0, 1.0);
    let straight = color.truncate() / opacity.max(1e-6);
    let [red, green, blue] = straight.to_array().map(srgb_byte);
    [red, green, blue, (opacity * 255.0 + 0.5) as u8]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn surfaces_that_are_left_out_count_as_the_others_and_the_background_keeps_its_samples() {
        let at = [0.0; 2];
        let all = vec![
            (Some(7), 1.0, at),
            (None, 2.0, at),
            (Some(3), 3.0, at),
            (Some(5), 1.0, at),
            (Some(9), 1.0, at),
        ];
        for (most, expected) in [(3, vec![Some(3), Some(7), None]), (2, vec![Some(3), None])] {
            let mut seen = all.clone();
            let factor = limit_surfaces(&mut seen, most);
            assert_eq!(seen.iter().map(|(number, ..)| *number).collect::<Vec<_>>(), expected);
            let model: f32 =
                seen.iter().filter(|seen| seen.0.is_some()).map(|(_, count, _)| count * factor).sum();
            assert!((model - 6.0).abs() < 1e-6 && (seen[seen.len() - 1].1 - 2.0).abs() < 1e-6);
        }
        let mut seen = all.clone();
        assert!((limit_surfaces(&mut seen, 5) - 1.0).abs() < 1e-6 && seen == all);
    }
}
