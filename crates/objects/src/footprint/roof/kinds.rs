//! The types of roof that scripts can name.

use super::options::Roof;
use crate::footprint::checks::{check_height, unknown_kind};
use burgeon_base::error::{Error, Result};
use burgeon_base::text::number;
use burgeon_geometry::roof::{Border, Eaves, Ends, Rise, RoofShape, RoofSurface};

/// A type of roof: the shape of the ends of wings, and the bends of the slopes between eaves and ridge, as fractions of
/// the width and of the height.
struct RoofKind {
    name: &'static str,
    ends: Ends,
    bends: &'static [(f64, f64)],
}

const SLOPED: [RoofKind; 8] = [
    RoofKind { name: "gable", ends: Ends::Gables, bends: &[] },
    RoofKind { name: "gambrel", ends: Ends::Gables, bends: &[(0.36, 0.64)] },
    RoofKind { name: "shed_gambrel", ends: Ends::Gables, bends: &[(0.26, 0.06), (0.56, 0.66)] },
    RoofKind { name: "hip", ends: Ends::Hips, bends: &[] },
    RoofKind { name: "mansard", ends: Ends::Hips, bends: &[(0.25, 0.7)] },
    RoofKind { name: "pagoda", ends: Ends::Hips, bends: &[(0.35, 0.12), (0.7, 0.42)] },
    RoofKind { name: "porch", ends: Ends::Hips, bends: &[(0.4, 0.16)] },
    RoofKind { name: "dutch_hip", ends: Ends::DutchHips, bends: &[] },
];

const KINDS: [&str; 10] =
    ["flat", "shed", "gable", "gambrel", "shed_gambrel", "hip", "mansard", "pagoda", "porch", "dutch_hip"];

const EAVES: [&str; 3] = ["closed", "open", "slab"];

/// Thickness (m) of plates, and height of slabs, if none is given.
const THICKNESS: f64 = 0.15;

/// Returns the roof shape for the options of the script. Fails if an option is unknown or out of range.
pub(crate) fn shape(options: &Roof) -> Result<RoofShape> {
    check(options)?;
    let kind = options.kind.as_str();
    let border = Border { height: options.border, width: options.border_width };
    let surface = match kind {
        "flat" => RoofSurface::Flat((border.height > 0.0).then_some(border)),
        "shed" => RoofSurface::Shed,
        _ => match SLOPED.iter().find(|known| known.name == kind) {
            Some(RoofKind { ends, bends, .. }) => RoofSurface::Sloped(*ends, bends),
            None => return Err(unknown_kind("footprint:roof", kind, &KINDS)),
        },
    };
    let eaves = match options.eaves.as_deref() {
        Some("closed") => Eaves::Closed,
        Some("open") => Eaves::Open,
        Some("slab") => Eaves::Slab,
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
    // Eaves without thickness would be as thin as paper, so they get a default thickness.
    let needed = match eaves {
        Eaves::Slab => true,
        Eaves::Open => juts_out,
        Eaves::Closed => juts_out && matches!(surface, RoofSurface::Flat(_)),
    };
    let slab = if needed && options.slab == 0.0 { THICKNESS } else { options.slab };
    let rise = options.height.map_or(Rise::Slope(options.slope.to_radians().tan()), Rise::Height);
    Ok(RoofShape { surface, rise, overhang: options.overhang, eaves, slab })
}

fn check(options: &Roof) -> Result<()> {
    if let Some(height) = options.height {
        check_height("footprint:roof: height", height)?;
    }
    if !(options.slope > 0.0 && options.slope <= 85.0) {
        return Err(Error::argument(format!("footprint:roof: slope is {} degrees", options.slope))
            .help("give degrees above 0, up to 85"));
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
            assert!(shape(&Roof { kind: kind.into(), ..Roof::default() }).is_ok(), "{kind}");
        }
        let error = shape(&Roof { kind: "mansarde".into(), ..Roof::default() }).expect_err("no such kind");
        assert!(error.to_string().contains("mansard"), "{error}");
        let error =
            shape(&Roof { eaves: Some("shut".into()), ..Roof::default() }).expect_err("no such eaves");
        assert!(error.to_string().contains("closed, open, slab"), "{error}");
        let both = Roof { eaves: Some("closed".into()), slab: 0.2, ..Roof::default() };
        assert!(shape(&both).is_err());
    }
}
