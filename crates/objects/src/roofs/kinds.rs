//! The types of roof that scripts can name.

use super::checks::{check_height, unknown_kind};
use super::direction::axis;
use super::options::Roof;
use super::storeys::{MOST_LEVELS, bends_at_floors, rise, slope};
use burgeon_base::error::{Error, Result};
use burgeon_base::text::number;
use burgeon_geometry::roof::{Border, Eaves, Ends, FieldRoof, RidgeAxis, RoofShape, RoofSurface};

/// A type of roof: the shape of the ends of wings, and the bends of the slopes between eaves and ridge, as fractions of
/// the width and of the height.
struct RoofKind {
    name: &'static str,
    ends: Ends,
    bends: &'static [(f64, f64)],
}

const SLOPED: [RoofKind; 9] = [
    RoofKind { name: "gable", ends: Ends::Gables, bends: &[] },
    RoofKind { name: "gambrel", ends: Ends::Gables, bends: &[(0.36, 0.64)] },
    RoofKind { name: "shed_gambrel", ends: Ends::Gables, bends: &[(0.26, 0.06), (0.56, 0.66)] },
    RoofKind { name: "bellcast", ends: Ends::Gables, bends: &[(0.16, 0.08), (0.3, 0.2)] },
    RoofKind { name: "hip", ends: Ends::Hips, bends: &[] },
    RoofKind { name: "mansard", ends: Ends::Hips, bends: &[(0.25, 0.7)] },
    RoofKind { name: "pagoda", ends: Ends::Hips, bends: &[(0.35, 0.12), (0.7, 0.42)] },
    RoofKind { name: "porch", ends: Ends::Hips, bends: &[(0.4, 0.16)] },
    RoofKind { name: "dutch_hip", ends: Ends::DutchHips, bends: &[] },
];

/// Types with one ridge over the whole plan, or with one apex.
const FIELDS: [(&str, FieldRoof); 12] = [
    ("saltbox", FieldRoof::Saltbox),
    ("clerestory", FieldRoof::Clerestory),
    ("round", FieldRoof::Round),
    ("butterfly", FieldRoof::Butterfly),
    ("cross_gable", FieldRoof::CrossGable),
    ("side_hip", FieldRoof::SideHip),
    ("side_dutch_hip", FieldRoof::SideHalfHip),
    ("gablet", FieldRoof::Gablet),
    ("pyramid", FieldRoof::Pyramid),
    ("cone", FieldRoof::Pyramid),
    ("dome", FieldRoof::Dome),
    ("onion", FieldRoof::Onion),
];

/// All types of roof.
pub(super) const KINDS: [&str; 24] = [
    "flat",
    "shed",
    "gable",
    "gambrel",
    "shed_gambrel",
    "bellcast",
    "saltbox",
    "clerestory",
    "sawtooth",
    "butterfly",
    "round",
    "cross_gable",
    "gablet",
    "hip",
    "dutch_hip",
    "side_hip",
    "side_dutch_hip",
    "mansard",
    "pagoda",
    "porch",
    "pyramid",
    "cone",
    "dome",
    "onion",
];

/// Types whose slopes approximate curves.
const CURVED: [&str; 4] = ["round", "cone", "dome", "onion"];

const EAVES: [&str; 3] = ["closed", "open", "slab"];

/// Thickness (m) of plates, and height of slabs, if none is given.
const THICKNESS: f64 = 0.15;

/// Returns the roof shape for the options of the script. Fails if an option is unknown or out of range.
pub(crate) fn roof_shape(options: &Roof) -> Result<RoofShape> {
    check(options)?;
    let kind = options.kind.as_str();
    let border = Border { height: options.border, width: options.border_width };
    let surface = surface(options, border)?;
    let is_field = matches!(surface, RoofSurface::Field(..)) || options.has_lines();
    let eaves = match options.eaves.as_deref() {
        Some("closed") => Eaves::Closed,
        Some("open") => Eaves::Open,
        Some("slab") => Eaves::Slab,
        None if is_field && options.overhang > 0.0 => Eaves::Open,
        None if options.slab > 0.0 => Eaves::Slab,
        None => Eaves::Closed,
        Some(eaves) => {
            let message = format!("footprint:roof: unknown kind of eaves {eaves:?}");
            let error = Error::not_found("kind", eaves, EAVES, message);
            return Err(error.help(format!("use {}", EAVES.join(", "))));
        }
    };
    if eaves == Eaves::Closed && options.slab > 0.0 {
        return Err(
            Error::argument("footprint:roof: closed eaves cannot have a slab").help("use eaves = \"slab\"")
        );
    }
    let juts_out = options.overhang > 0.0;
    if is_field && juts_out && eaves != Eaves::Open {
        let message =
            format!("footprint:roof: the overhang of a {kind} roof with one ridge or apex is a plate");
        return Err(Error::argument(message).help("use eaves = \"open\""));
    }
    if juts_out && matches!(surface, RoofSurface::Field(FieldRoof::Onion, _)) {
        return Err(Error::argument("footprint:roof: an onion roof has no overhang").help("omit overhang"));
    }
    // Eaves without thickness would be as thin as paper, so they get a default thickness.
    let needed = match eaves {
        Eaves::Slab => true,
        Eaves::Open => juts_out,
        Eaves::Closed => juts_out && matches!(surface, RoofSurface::Flat(_)),
    };
    let slab = if needed && options.slab == 0.0 { THICKNESS } else { options.slab };
    let rise = rise(options);
    Ok(RoofShape { surface, rise, overhang: options.overhang, eaves, slab })
}

/// Returns true if the slopes of a type approximate curves.
pub(crate) fn is_curved(kind: &str) -> bool {
    CURVED.contains(&kind)
}

/// Returns the surface for the options of the script. Fails if the type is unknown or has no direction.
fn surface(options: &Roof, border: Border) -> Result<RoofSurface> {
    let kind = options.kind.as_str();
    let axis = axis(options.direction, options.orientation.as_deref())?;
    let sloped = SLOPED.iter().find(|known| known.name == kind);
    let form = match (kind, sloped) {
        ("shed", _) => axis.map(|_| FieldRoof::Shed),
        ("sawtooth", _) => Some(FieldRoof::Sawtooth { slope: slope(options) }),
        (_, Some(known @ RoofKind { ends: Ends::Gables, .. })) => {
            axis.map(|_| FieldRoof::Gable(bends(known, options)))
        }
        _ => FIELDS.iter().find(|(name, _)| *name == kind).map(|(_, form)| *form),
    };
    if let Some(form) = form
        && (form.has_axis() || axis.is_none())
    {
        return Ok(RoofSurface::Field(form, axis.unwrap_or(RidgeAxis::Along)));
    }
    if !KINDS.contains(&kind) {
        return Err(unknown_kind("footprint:roof", kind, &KINDS));
    }
    if axis.is_some() {
        let with: Vec<&str> = KINDS.into_iter().filter(|kind| has_direction(kind)).collect();
        return Err(Error::argument(format!("footprint:roof: a {kind} roof has no direction"))
            .help(format!("omit direction and orientation, or use {}", with.join(", "))));
    }
    Ok(match (kind, sloped) {
        (_, Some(known)) => RoofSurface::Sloped(known.ends, bends(known, options)),
        ("shed", _) => RoofSurface::Shed,
        _ => RoofSurface::Flat((border.height > 0.0).then_some(border)),
    })
}

/// Returns the bends of the slopes of a type.
fn bends(kind: &RoofKind, options: &Roof) -> &'static [(f64, f64)] {
    options.levels.and_then(|levels| bends_at_floors(kind.name, levels)).unwrap_or(kind.bends)
}

/// Returns true if a type of roof has a direction.
fn has_direction(kind: &str) -> bool {
    let is_gabled = |known: &RoofKind| known.name == kind && known.ends == Ends::Gables;
    kind == "shed"
        || kind == "sawtooth"
        || SLOPED.iter().any(is_gabled)
        || FIELDS.iter().any(|(name, form)| *name == kind && form.has_axis())
}

fn check(options: &Roof) -> Result<()> {
    if let Some(height) = options.height {
        check_height("footprint:roof: height", height)?;
    }
    if let Some(slope) = options.slope.filter(|slope| !(*slope > 0.0 && *slope <= 85.0)) {
        return Err(Error::argument(format!("footprint:roof: slope is {slope} degrees"))
            .help("give degrees above 0, up to 85"));
    }
    if let Some(levels) = options.levels.filter(|levels| !(*levels > 0.0 && *levels <= MOST_LEVELS)) {
        return Err(Error::argument(format!("footprint:roof: levels is {levels}"))
            .help(format!("give a number of storeys above 0, up to {MOST_LEVELS}")));
    }
    for (name, length) in [("overhang", options.overhang), ("slab", options.slab), ("border", options.border)]
    {
        if !(0.0..=100.0).contains(&length) {
            return Err(
                Error::argument(format!("footprint:roof: {name} is {length} m")).help("give 0 to 100 m")
            );
        }
    }
    if !(0.05..=100.0).contains(&options.border_width) {
        return Err(Error::argument(format!(
            "footprint:roof: border_width is {} m",
            number(options.border_width)
        ))
        .help("give 0.05 to 100 m"));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kind_has_a_shape_and_others_are_refused_with_the_nearest() {
        for kind in KINDS {
            assert!(roof_shape(&Roof { kind: kind.into(), ..Roof::default() }).is_ok(), "{kind}");
        }
        let error =
            roof_shape(&Roof { kind: "mansarde".into(), ..Roof::default() }).expect_err("no such kind");
        assert!(error.to_string().contains("mansard"), "{error}");
        let error =
            roof_shape(&Roof { eaves: Some("shut".into()), ..Roof::default() }).expect_err("no such eaves");
        assert!(error.to_string().contains("closed, open, slab"), "{error}");
        let both = Roof { eaves: Some("closed".into()), slab: 0.2, ..Roof::default() };
        assert!(roof_shape(&both).is_err());
    }

    #[test]
    fn a_direction_selects_one_ridge_and_is_refused_for_types_without_one() {
        let with = |kind: &str| {
            roof_shape(&Roof { kind: kind.into(), orientation: Some("across".into()), ..Roof::default() })
        };
        for kind in KINDS {
            match with(kind) {
                Ok(shape) => assert!(
                    matches!(shape.surface, RoofSurface::Field(_, RidgeAxis::Across)) && has_direction(kind),
                    "{kind}"
                ),
                Err(error) => {
                    assert!(!has_direction(kind) && error.to_string().contains("no direction"), "{error}");
                }
            }
        }
        assert_eq!(KINDS.into_iter().filter(|kind| has_direction(kind)).count(), 14);
        let gable = roof_shape(&Roof { kind: "gable".into(), ..Roof::default() }).expect("a roof");
        assert!(matches!(gable.surface, RoofSurface::Sloped(..)));
        let onion = Roof { kind: "onion".into(), overhang: 0.3, ..Roof::default() };
        assert!(roof_shape(&onion).is_err());
    }
}
