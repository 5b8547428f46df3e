//! Light that neighbouring pixels share. Each gathers it from a part of the sky's maps, and takes the sum: that of the two by
//! two pixels on the same surface, or, which is smoother and takes longer, that of its own neighbours.

use super::camera::Camera;
use super::shade::{Fragment, GatheredLight};

/// Side (pixels) of the square of pixels whose light is added.
const WINDOW: usize = 4;
/// Maximum distance of a neighbour from the plane of a surface, in pixels at the surface's distance.
const NEAR: f32 = 2.0;
/// Minimum cosine of the angle between the normals of neighbours.
const ALIKE: f32 = 0.9;
/// Minimum number of maps that a fragment gathers from, so that it distinguishes light from shade alone.
const LEAST: usize = 6;

/// Divides the sky's `maps` among the pixels of a square of `turns` pixels, and further among the `fragments` of the
/// pixel at `x`, `y`, if they are many, because their light is mixed anyway.
pub(super) fn take_turns(fragments: &mut [Fragment], maps: usize, turns: usize, [x, y]: [usize; 2]) {
    let side = turns.isqrt().max(1);
    let turn = y % side * side + x % side;
    let crowd = fragments.len().div_ceil(2).min(maps / turns.max(1) / LEAST).max(1);
    for (i, fragment) in fragments.iter_mut().enumerate() {
        fragment.crowd = (i % crowd, crowd);
        fragment.share = (turn * crowd + i % crowd, turns * crowd);
    }
}

/// Lets the fragments of each two by two pixels that lie on one surface share one light: each gathers it from a part of the
/// sky. So do those of crowded pixels, because their colours are mixed anyway. The fragments are those of a tile of `size`
/// pixels, in order, and `pixels` are the pixels that they belong to.
pub(super) fn pool_light(
    fragments: &mut [Fragment],
    pixels: &[usize],
    [width, height]: [usize; 2],
    camera: &Camera,
) {
    let starts = starts(pixels, width * height);
    let mut groups: Vec<Vec<usize>> = Vec::new();
    for y in (0..height).step_by(2) {
        for x in (0..width).step_by(2) {
            let mut count = 0;
            for row in y..(y + 2).min(height) {
                for pixel in row * width + x..row * width + (x + 2).min(width) {
                    let own = starts[pixel]..starts[pixel + 1];
                    count_crowd(&mut fragments[own.clone()]);
                    for index in own {
                        let fragment = &fragments[index];
                        let mut known = groups[..count].iter_mut();
                        match known.find(|group| has_light_of(fragment, &fragments[group[0]], camera)) {
                            Some(group) => group.push(index),
                            None => {
                                if count == groups.len() {
                                    groups.push(Vec::new());
                                }
                                groups[count].push(index);
                                count += 1;
                            }
                        }
                    }
                }
            }
            for group in &mut groups[..count] {
                for (turn, index) in group.iter().enumerate() {
                    (fragments[*index].share, fragments[*index].pool) = ((turn, group.len()), group[0]);
                }
                group.clear();
            }
        }
    }
}

/// Counts the surfaces of the model in a pixel that shows more than two.
fn count_crowd(fragments: &mut [Fragment]) {
    let of_model = || |fragment: &&mut Fragment| fragment.surface.material.is_some();
    let count = fragments.iter_mut().filter(of_model()).count();
    if count > 2 {
        fragments
            .iter_mut()
            .filter(of_model())
            .enumerate()
            .for_each(|(i, fragment)| fragment.crowd = (i, count));
    }
}

/// Returns true if a fragment gathers the same light as the `first` of others nearby.
fn has_light_of(fragment: &Fragment, first: &Fragment, camera: &Camera) -> bool {
    if fragment.crowd.1 > 2 && first.crowd.1 > 2 {
        return true;
    }
    let (own, other) = (&fragment.surface, &first.surface);
    let near = NEAR * camera.footprint(own.position);
    let aside = (other.position - own.position).dot(own.plane).abs();
    own.material == other.material && aside < near && other.normal.dot(own.normal) > ALIKE
}

/// Returns the index of the first fragment of each of `count` pixels, and the number of fragments.
fn starts(pixels: &[usize], count: usize) -> Vec<usize> {
    let mut starts = vec![0; count + 1];
    for pixel in pixels {
        starts[pixel + 1] += 1;
    }
    for pixel in 0..count {
        starts[pixel + 1] += starts[pixel];
    }
    starts
}

/// Returns the light of each of `fragments`: the sum of what it and its neighbours on the same surface have `gathered`.
/// The fragments are those of a tile of `size` pixels, in order, and `pixels` are the pixels that they belong to.
pub(super) fn add_neighbours(
    fragments: &[Fragment],
    pixels: &[usize],
    gathered: &[GatheredLight],
    [width, height]: [usize; 2],
    camera: &Camera,
) -> Vec<GatheredLight> {
    let starts = starts(pixels, width * height);
    let range = |at: usize, most: usize| {
        // The window holds as many pixels of each turn.
        let first = at.saturating_sub(1 + at % 2).min(most.saturating_sub(WINDOW));
        first..(first + WINDOW).min(most)
    };
    let sum = |(own, pixel): (&Fragment, &usize)| {
        let (x, y) = (pixel % width, pixel / width);
        let near = NEAR * camera.footprint(own.surface.position);
        let mut light = GatheredLight::default();
        for row in range(y, height) {
            let columns = range(x, width);
            for i in starts[row * width + columns.start]..starts[row * width + columns.end] {
                let other = &fragments[i].surface;
                let aside = (other.position - own.surface.position).dot(own.surface.plane).abs();
                if aside < near && other.normal.dot(own.surface.normal) > ALIKE {
                    light.add(&gathered[fragments[i].pool]);
                }
            }
        }
        light
    };
    fragments.iter().zip(pixels).map(sum).collect()
}

#[cfg(test)]
mod tests {
    use super::super::surface::SurfacePoint;
    use super::super::view::Viewpoint;
    use super::*;
    use glam::{Vec2, Vec3A};

    fn fragment(camera: &Camera, position: Vec3A, pool: usize) -> Fragment {
        Fragment::new(SurfacePoint::ground(position, camera), Vec2::X, pool)
    }

    #[test]
    fn the_turns_of_a_square_of_pixels_take_every_map_once() {
        let camera =
            Camera::fit([Vec3A::ZERO].into_iter(), Viewpoint { azimuth: 0.0, elevation: 1.0 }, [8, 8]);
        for (maps, turns, crowd) in [(48_usize, 4_usize, 1), (48, 4, 6), (47, 16, 3), (24, 1, 9)] {
            let mut taken = vec![0; maps];
            for pixel in 0..turns {
                let side = turns.isqrt();
                let mut fragments: Vec<Fragment> =
                    (0..crowd).map(|i| fragment(&camera, Vec3A::ZERO, i)).collect();
                take_turns(&mut fragments, maps, turns, [pixel % side, pixel / side]);
                let mut shares: Vec<_> = fragments.iter().map(|fragment| fragment.share).collect();
                shares.sort_unstable();
                shares.dedup();
                for (turn, of) in shares {
                    ((turn * maps).div_ceil(of)..((turn + 1) * maps).div_ceil(of))
                        .for_each(|map| taken[map] += 1);
                }
            }
            assert!(taken.iter().all(|count| *count == 1), "{maps} maps, {turns} turns, {crowd}: {taken:?}");
        }
    }

    #[test]
    fn two_by_two_pixels_on_one_surface_take_every_map_once_and_another_surface_takes_its_own() {
        let camera =
            Camera::fit([Vec3A::ZERO].into_iter(), Viewpoint { azimuth: 0.0, elevation: 1.0 }, [8, 8]);
        // Five by three pixels, of which number 6 sees another surface far above the others.
        let pixels: Vec<usize> = (0..15).collect();
        let height = |pixel: usize| if pixel == 6 { 0.5 } else { 0.0 };
        let mut fragments: Vec<Fragment> =
            pixels.iter().map(|pixel| fragment(&camera, Vec3A::Z * height(*pixel), *pixel)).collect();
        pool_light(&mut fragments, &pixels, [5, 3], &camera);
        for (pools, count) in
            [([0, 1, 5].as_slice(), 3), (&[6], 1), (&[2, 3, 7, 8], 4), (&[4, 9], 2), (&[14], 1)]
        {
            let mut turns: Vec<usize> = pools.iter().map(|pixel| fragments[*pixel].share.0).collect();
            turns.sort_unstable();
            assert_eq!(turns, (0..count).collect::<Vec<_>>());
            let is_pooled =
                |pixel: &usize| (fragments[*pixel].pool, fragments[*pixel].share.1) == (pools[0], count);
            assert!(pools.iter().all(is_pooled), "{pools:?}");
        }
    }

    #[test]
    fn crowded_pixels_share_one_light_except_for_the_ground_behind_them() {
        let camera =
            Camera::fit([Vec3A::ZERO].into_iter(), Viewpoint { azimuth: 0.0, elevation: 1.0 }, [8, 8]);
        let pixels = [0, 0, 0, 0, 1, 1, 1];
        let mut fragments: Vec<Fragment> =
            (0..7).map(|i| fragment(&camera, Vec3A::Z * (i % 4) as f32 * 0.2, i)).collect();
        fragments.iter_mut().enumerate().for_each(|(i, fragment)| {
            fragment.surface.material = (i != 3).then_some(i);
        });
        pool_light(&mut fragments, &pixels, [2, 1], &camera);
        let pools: Vec<usize> = fragments.iter().map(|fragment| fragment.pool).collect();
        assert_eq!(pools, [0, 0, 0, 3, 0, 0, 0]);
        assert_eq!((fragments[3].share, fragments[6].share, fragments[5].crowd), ((0, 1), (5, 6), (1, 3)));
    }
}
