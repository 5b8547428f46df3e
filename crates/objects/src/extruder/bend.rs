//! Warnings of bends that are tighter than their cross-section.

use burgeon_base::warning::{Warning, WarningKind};
use burgeon_geometry::{Section, Segment, Station};

/// Share of a radius that is a rounding error.
const ROUNDING: f64 = 1e-9;

/// Returns a warning if the section reaches beyond the centre of the bend, so that the solid crosses itself.
///
/// The text is the same for all sizes, because the first of equal warnings represents all of them.
pub(super) fn bend_warning(segment: &Segment, section: &Section, stations: &[Station]) -> Option<Warning> {
    let radius = segment.radius();
    let scale = segment.from.abs().max(segment.to.abs());
    if (section.reach() * scale).length() <= radius {
        return None;
    }
    let reach = segment.inner_reach(section, stations);
    if reach <= radius * (1.0 + ROUNDING) {
        return None;
    }
    let text = "extruder:extrude: the bend is tighter than the cross-section, so the solid crosses itself";
    let least = reach * segment.bend.abs();
    let help = format!(
        "the bend has a radius of {radius:.3} m, and the section reaches {reach:.3} m to the inside: extrude at least \
         {least:.3} m, bend by at most {:.1} degrees, or use a narrower section",
        (segment.length.abs() / reach).to_degrees()
    );
    Some(Warning::new(WarningKind::Doubtful, text).help(help))
}

#[cfg(test)]
mod tests {
    use super::super::object::Extruder;
    use super::super::options::ExtruderOptions;
    use burgeon_kit::{Object, Warn};

    /// Returns the warnings of a drawing with a section of 2 m by 0.5 m.
    fn warnings(draw: impl FnOnce(&mut Extruder)) -> Vec<String> {
        let mut extruder = Extruder::new(ExtruderOptions::default()).expect("the options are valid");
        extruder.begin();
        extruder.rectangle(2.0, 0.5).expect("a section");
        draw(&mut extruder);
        extruder.end().expect("a solid");
        extruder.take_warnings().iter().map(ToString::to_string).collect()
    }

    #[test]
    fn a_bend_that_is_tighter_than_its_section_warns_of_the_tightest_radius_without_crossing() {
        let bend = |angle: f64, toward: f64, length: f64| {
            warnings(|it| {
                it.bend(angle, Some(toward));
                it.extrude(length).expect("a segment");
            })
        };
        let quarter = std::f64::consts::FRAC_PI_2;
        insta::assert_snapshot!(bend(90.0, 0.0, 1.0).join("\n"), @r"
        extruder:extrude: the bend is tighter than the cross-section, so the solid crosses itself
          help: the bend has a radius of 0.637 m, and the section reaches 1.000 m to the inside: extrude at least 1.571 m, bend by at most 57.3 degrees, or use a narrower section
        ");
        // Towards the short side, and at the remedies, nothing crosses.
        assert!(bend(90.0, 90.0, 1.0).is_empty() && bend(90.0, 90.0, 0.39).len() == 1);
        assert!(bend(90.0, 0.0, quarter).is_empty() && bend(90.0, 0.0, quarter - 0.001).len() == 1);
        assert!(bend(-57.2, 0.0, 1.0).is_empty() && bend(-57.4, 0.0, 1.0).len() == 1);
        assert!(bend(0.0, 0.0, 1.0).is_empty());
    }

    #[test]
    fn the_scale_of_both_ends_counts_in_a_bend() {
        let scaled = |from: f64, to: f64| {
            warnings(|it| {
                it.scale(from, None);
                it.taper(to, None);
                it.bend(90.0, None);
                it.extrude(1.0).expect("a segment");
            })
        };
        assert!(scaled(0.5, 0.5).is_empty() && scaled(0.6, 0.0).is_empty());
        assert_eq!((scaled(0.5, 0.7).len(), scaled(0.7, 0.5).len()), (1, 1));
    }
}
