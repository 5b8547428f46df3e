//! Writes a drawing of a scene.

use std::fmt::Write as _;
use std::io::Write as _;
use std::path::Path;

use super::faces::{Palette, VisibleFaces};
use super::view::DrawingSide;
use super::{outline, sheets};
use crate::Export;
use crate::check::{SceneCheck, check};
use crate::files::Files;
use crate::texture::Images;
use burgeon_base::error::{Error, Limit, Result};
use burgeon_base::stop::Stop;
use burgeon_base::text::grouped;
use burgeon_scene::Scene;
use glam::DVec3;

/// Maximum number of triangles in a drawing. A render shows larger models.
const LIMIT: usize = 1_000_000;

/// Draws `scene` as an SVG document.
///
/// Fails if the scene is invalid, if a texture cannot be read, if it has more than a million triangles, or if `stop`
/// requests cancellation.
///
/// ```
/// use burgeon_base::{Error, Stop};
/// use burgeon_export::svg::svg;
/// use burgeon_scene::Scene;
///
/// let stop = Stop::new();
/// assert!(svg(&Scene::default(), &stop)?.starts_with("<svg"));
/// stop.stop(Error::cancellation("the window was closed"));
/// assert!(svg(&Scene::default(), &stop).is_err());
/// # Ok::<(), Error>(())
/// ```
pub fn svg(scene: &Scene, stop: &Stop) -> Result<String> {
    let checked = check(scene)?;
    let count = scene.triangles();
    if count > LIMIT {
        let error = Error::limit(
            Limit::Size,
            format!("a drawing cannot show {} triangles; the limit is {}", grouped(count), grouped(LIMIT)),
        );
        return Err(error.help(
            "write a render (.png), reduce the model with --lod, or draw a part of it with --part K/N",
        ));
    }
    let images = Images::load(&checked)?;
    let view = DrawingSide::of(&checked);
    stop.check()?;
    let faces = VisibleFaces::collect(&checked, view);
    stop.check()?;
    let palette = Palette::new(&scene.materials, &images)?;
    document(&checked, view, &faces, &palette, stop)
}

/// Writes a drawing to `path`.
pub(crate) fn write(export: &Export<'_>, path: &Path, files: &mut Files) -> Result<()> {
    let drawing = svg(export.scene, &files.stop())?;
    files.write(path, |out| out.write_all(drawing.as_bytes()))
}

/// Area and size of the paper, in metres of the drawing's coordinates with y downwards.
struct Paper {
    left: f64,
    top: f64,
    width: f64,
    height: f64,
    /// Larger side (m) of the drawing without its margins. Line widths and font sizes are relative to it.
    size: f64,
    /// Horizontal centre (m) of the drawing.
    middle: f64,
    bottom: f64,
}

impl Paper {
    fn around(faces: &VisibleFaces) -> Option<Self> {
        let (low, high) = faces.bounds()?;
        let metres = |number: i64| number as f64 / 1000.0;
        let (left, right) = (metres(low[0]), metres(high[0]));
        let (top, bottom) = (-metres(high[1]), -metres(low[1]));
        let size = (right - left).max(bottom - top).max(0.01);
        let margin = size * 0.05;
        // Wide enough for the scale bar below a tall drawing.
        let width = (right - left).max(size * 0.4) + 2.0 * margin;
        let middle = (left + right) / 2.0;
        let height = bottom - top + 2.0 * margin + size * 0.06;
        Some(Self { left: middle - width / 2.0, top: top - margin, width, height, size, middle, bottom })
    }
}

fn document(
    checked: &SceneCheck<'_>,
    view: DrawingSide,
    faces: &VisibleFaces,
    palette: &Palette,
    stop: &Stop,
) -> Result<String> {
    let mut out = String::new();
    let title = view.title();
    let Some(paper) = Paper::around(faces) else {
        return Ok(format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 10 10\">\n<title>{title}</title>\n\
             <desc>Nothing is seen from here.</desc>\n</svg>\n"
        ));
    };
    let Paper { left, top, width, height, size, .. } = paper;
    let [left, top, width, height] = [left, top, width, height].map(decimals);
    let DVec3 { x, y, z } = checked.origin;
    let mut line = |text: std::fmt::Arguments<'_>| {
        // Writing to a string does not fail.
        let _ = out.write_fmt(text);
        out.push('\n');
    };
    line(format_args!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"{left} {top} {width} {height}\">"
    ));
    line(format_args!("<title>{title}</title>"));
    line(format_args!(
        "<desc>One unit is one metre, counted from ({x}, {y}, {z}). Burgeon {}</desc>",
        env!("CARGO_PKG_VERSION")
    ));
    line(format_args!(
        "<rect x=\"{left}\" y=\"{top}\" width=\"{width}\" height=\"{height}\" fill=\"#fff\"/>"
    ));
    // Proportional to the drawing, so that a shed and a city look the same on paper.
    let pen = size / 1000.0;
    line(format_args!("<g fill=\"none\" stroke-linejoin=\"round\" stroke-linecap=\"round\">"));
    for sheet in sheets::stack(faces, pen, stop)? {
        stop.check()?;
        let fill = outline::filled_outline(faces, &sheet.faces);
        let (color, opacity) = palette.fill(sheet.ink);
        let opacity =
            if opacity < 1.0 { format!(" opacity=\"{}\"", decimals(opacity)) } else { String::new() };
        if !fill.is_empty() {
            line(format_args!("<path fill=\"{color}\"{opacity} d=\"{fill}\"/>"));
        }
        // Renderers leave a light gap between adjacent areas. Where no dark line covers the gap, a wide line in the
        // area's own colour does.
        let [edge, thin] = [0.32, 0.7].map(|brightness| palette.tone(sheet.ink, brightness));
        // Shapes that are narrower than a line, such as markings on a street, are drawn as lines in their own colour.
        let drawn = [
            (sheet.seams, &color, 2.0),
            (sheet.hairs, &color, 0.4),
            (sheet.thin, &thin, 0.7),
            (sheet.lines, &edge, 0.8),
        ];
        for (ends, color, pens) in drawn {
            if !ends.is_empty() {
                let (width, data) = (decimals(pen * pens), outline::lines(ends));
                line(format_args!(
                    "<path stroke=\"{color}\" stroke-width=\"{width}\"{opacity} d=\"{data}\"/>"
                ));
            }
        }
    }
    line(format_args!("</g>"));
    line(format_args!("{}", scale_bar(&paper)));
    if view == DrawingSide::Plan {
        line(format_args!("{}", north_arrow(&paper)));
    }
    line(format_args!("</svg>"));
    Ok(out)
}

/// Draws a scale bar of a round length, half black and half white, with its length as text.
fn scale_bar(paper: &Paper) -> String {
    let length = round_length((paper.width * 0.3).min(paper.size * 0.2));
    let label = match length {
        km if km >= 1000.0 => format!("{} km", decimals(km / 1000.0)),
        m if m >= 1.0 => format!("{} m", decimals(m)),
        cm if cm >= 0.01 => format!("{} cm", decimals(cm * 100.0)),
        mm => format!("{} mm", decimals(mm * 1000.0)),
    };
    let (thick, letters) = (paper.size * 0.006, paper.size * 0.022);
    let x = paper.left + paper.size * 0.05;
    let y = paper.bottom + paper.size * 0.055;
    let [x0, half, y0, thick_text, pen] = [x, length / 2.0, y, thick, paper.size / 1000.0].map(decimals);
    let [middle, text_x, text_y, letters] =
        [x + length / 2.0, x + length + letters * 0.5, y + thick * 0.5 + letters * 0.36, letters]
            .map(decimals);
    format!(
        "<g stroke=\"#222\" stroke-width=\"{pen}\">\
         <rect x=\"{x0}\" y=\"{y0}\" width=\"{half}\" height=\"{thick_text}\" fill=\"#222\"/>\
         <rect x=\"{middle}\" y=\"{y0}\" width=\"{half}\" height=\"{thick_text}\" fill=\"#fff\"/></g>\n\
         <text x=\"{text_x}\" y=\"{text_y}\" font-family=\"sans-serif\" font-size=\"{letters}\" fill=\"#222\">\
         {label}</text>"
    )
}

/// Draws an arrow to the top of the paper with an N next to it.
fn north_arrow(paper: &Paper) -> String {
    let unit = paper.size * 0.018;
    let x = 2.0 * paper.middle - paper.left - paper.size * 0.05 - unit;
    let y = paper.bottom + paper.size * 0.072;
    let [left, tip, right, low, notch, high] =
        [x - unit * 0.5, x, x + unit * 0.5, y, y - unit * 0.4, y - unit * 1.8].map(decimals);
    let [text_x, text_y, letters] = [x - unit, y - unit * 0.2, unit * 1.2].map(decimals);
    format!(
        "<path fill=\"#222\" d=\"M{tip} {high}L{right} {low}L{tip} {notch}L{left} {low}z\"/>\n\
         <text x=\"{text_x}\" y=\"{text_y}\" text-anchor=\"end\" font-family=\"sans-serif\" \
         font-size=\"{letters}\" fill=\"#222\">N</text>"
    )
}

/// Returns the largest of 1, 2, 5, 10, 20, 50 and so on that is at most `most`.
fn round_length(most: f64) -> f64 {
    let power = 10_f64.powf(most.log10().floor());
    [5.0, 2.0].map(|digit| digit * power).into_iter().find(|length| *length <= most).unwrap_or(power)
}

/// Formats a number with as many decimals as a drawing of its size needs, at most six.
fn decimals(number: f64) -> String {
    let digits = if number.abs() >= 1.0 { 3 } else { 6 };
    let text = format!("{number:.digits$}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text.is_empty() || text == "-0" { "0".into() } else { text.into() }
}

#[cfg(test)]
mod tests {
    fn svg(scene: &Scene) -> Result<String> {
        super::svg(scene, &Stop::default())
    }

    use super::*;
    use crate::samples;

    /// Returns the area (m²) and the number of corners of all filled paths.
    fn filled_paths(drawing: &str) -> (f64, usize) {
        let (mut area, mut corners) = (0.0, 0);
        for line in drawing.lines().filter(|line| line.starts_with("<path fill=\"#") && !line.contains('L')) {
            let data = line.split(" d=\"").nth(1).unwrap().trim_end_matches("\"/>");
            for ring in data.split('M').skip(1) {
                let spaced = ring.trim_end_matches('z').replace('l', " ").replace('-', " -");
                let numbers: Vec<f64> = spaced.split_whitespace().map(|it| it.parse().unwrap()).collect();
                let mut at = DVec3::ZERO;
                let mut points = Vec::new();
                for step in numbers.chunks(2) {
                    at += DVec3::new(step[0], step[1], 0.0);
                    points.push(at);
                }
                for (a, b) in points.iter().zip(points.iter().cycle().skip(1)) {
                    area += (b.x * a.y - a.x * b.y) / 2.0;
                }
                corners += points.len();
            }
        }
        (area, corners)
    }

    #[test]
    fn a_box_in_plan_is_one_square() {
        let drawing = svg(&samples::boxes(1)).unwrap();
        assert!(drawing.contains("<title>Plan, north up</title>"), "{drawing}");
        assert_eq!(filled_paths(&drawing), (1.0, 4));
        assert!(drawing.contains(">20 cm</text>"), "{drawing}");
    }

    #[test]
    fn a_hill_covers_its_ground_and_its_triangles_merge() {
        let drawing = svg(&samples::hill(120)).unwrap();
        let (area, corners) = filled_paths(&drawing);
        assert!((area - 10_000.0).abs() < 1e-3, "{area}");
        assert!(corners < 120 * 120 * 2, "{corners}");
    }

    #[test]
    fn every_house_is_drawn_once_on_the_ground() {
        let scene = samples::town(3);
        let (area, _) = filled_paths(&svg(&scene).unwrap());
        let seen: f64 = scene
            .instances
            .iter()
            .enumerate()
            .map(|(i, instance)| {
                let base = instance.transform.matrix3.x_axis.cross(instance.transform.matrix3.y_axis).z;
                // Each house consists of its flat top and, above it, a roof that is a tenth wider.
                if i == 0 { base } else { base * 2.1 }
            })
            .sum();
        assert!((area - seen).abs() < 0.1, "{area} is not {seen}");
    }

    #[test]
    fn what_stands_upright_and_thin_is_drawn_from_the_front() {
        let drawing = svg(&samples::standing()).unwrap();
        assert!(drawing.contains("<title>Elevation, seen from the south</title>"), "{drawing}");
        let mut turned = samples::standing();
        for instance in &mut turned.instances {
            instance.transform =
                glam::DAffine3::from_rotation_z(std::f64::consts::FRAC_PI_2) * instance.transform;
        }
        assert!(svg(&turned).unwrap().contains("<title>Elevation, seen from the east</title>"));
    }

    #[test]
    fn a_drawing_of_more_than_a_million_triangles_is_refused_before_it_is_drawn() {
        let mut scene = samples::boxes(1);
        scene.instances = vec![scene.instances[0].clone(); 100_000];
        insta::assert_snapshot!(svg(&scene).unwrap_err(), @r"
        a drawing cannot show 1,200,000 triangles; the limit is 1,000,000
          help: write a render (.png), reduce the model with --lod, or draw a part of it with --part K/N
        ");
    }

    #[test]
    fn a_far_model_is_counted_from_whole_metres_that_the_drawing_tells() {
        let drawing = svg(&samples::far_box()).unwrap();
        assert!(drawing.contains("counted from (531000, 4556000, 0)"), "{drawing}");
    }

    #[test]
    fn a_scene_with_nothing_to_see_is_a_document_too() {
        insta::assert_snapshot!(svg(&Scene::default()).unwrap(), @r#"
        <svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 10 10">
        <title>Plan, north up</title>
        <desc>Nothing is seen from here.</desc>
        </svg>
        "#);
    }

    #[test]
    fn a_scale_bar_is_round() {
        assert_eq!(
            [0.3, 1.0, 4.9, 5.0, 70.0, 1999.0].map(round_length).to_vec(),
            [0.2, 1.0, 2.0, 5.0, 50.0, 1000.0]
        );
        assert_eq!([0.0, -0.0004, 12.5, 1.0 / 3.0].map(decimals), ["0", "-0.0004", "12.5", "0.333333"]);
    }
}
