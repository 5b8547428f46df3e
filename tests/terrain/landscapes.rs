//! Checks of the shipped landscape script, for all kinds, sizes and seeds, with few cells.

use std::path::Path;

use burgeon::WarningKind;
use burgeon::script::RunOptions;

/// Kinds, with the height of their water as a fraction of the size.
pub(crate) const KINDS: [(&str, Option<f64>); 5] = [
    ("mountains", None),
    ("hills", Some(-0.009)),
    ("ridge", None),
    ("crater", Some(-0.03)),
    ("plain", Some(-0.0035)),
];

/// Side lengths (m).
pub(crate) const SIZES: [u32; 3] = [500, 3000, 50_000];

/// Runs a landscape, and returns its number of trees. Fails with an error, a warning, or a tree in the sea.
pub(crate) fn check(kind: &str, size: u32, seed: u64) -> Result<usize, String> {
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("scripts/landscape.lua");
    let set = [
        ("kind", kind.to_owned()),
        ("size", size.to_string()),
        ("levels", "5".into()),
        ("rough", "2".into()),
    ];
    // Large landscapes without trees take an eighth of the time.
    let trees = if size > 3000 { "false" } else { "true" };
    let set = set.into_iter().chain([("trees", trees.into())]).map(|(name, value)| (name.to_owned(), value));
    let options =
        RunOptions { params: set.collect::<Vec<_>>().into(), seed, threads: Some(1), ..burgeon::options() };
    let told = |what: String| format!("kind={kind} size={size} seed={seed}: {what}");
    let run = burgeon::run(&script, options).map_err(|error| told(error.to_string()))?;
    // With so few cells, a spring may be next to the shore, where no river can start.
    let warning = run.warnings.iter().find(|warning| warning.kind() != WarningKind::DrawsNothing);
    if let Some(warning) = warning {
        return Err(told(warning.to_string()));
    }
    let level = KINDS.iter().find(|(known, _)| *known == kind).and_then(|(_, level)| *level);
    let mut trees = 0;
    // Trees are the only placed models.
    for tree in run.scene.instances.iter().filter(|instance| instance.placement.is_some()) {
        trees += 1;
        let height = tree.transform.translation.z;
        if level.is_some_and(|level| height + 0.3 < level * f64::from(size)) {
            return Err(told(format!("a tree at the height {height} m")));
        }
    }
    Ok(trees)
}
