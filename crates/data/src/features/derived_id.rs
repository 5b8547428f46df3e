//! Ids of features that have no id in their file.

use burgeon_kit::Attribute;
use burgeon_spatial::Geometry;

/// Returns the id of a feature without one: a hash of its geometry and its attributes, independent of their order.
pub(crate) fn derived_id(parts: &[Geometry], attributes: &[(usize, Attribute)], names: &[String]) -> String {
    let mut hasher = blake3::Hasher::new();
    let mut add = |bytes: &[u8]| {
        hasher.update(bytes);
    };
    for part in parts {
        add(&[part.kind() as u8]);
        for list in part.lists() {
            add(&list.len().to_le_bytes());
            for point in list {
                // Both zeros are the same position.
                point.to_array().iter().for_each(|value| add(&(value + 0.0).to_bits().to_le_bytes()));
            }
        }
    }
    let mut known: Vec<(&str, &Attribute)> =
        attributes.iter().filter_map(|(number, value)| Some((names.get(*number)?.as_str(), value))).collect();
    known.sort_by_key(|(name, _)| *name);
    for (name, value) in known {
        let text = value.text();
        for part in [name, value.kind(), &text] {
            add(&part.len().to_le_bytes());
            add(part.as_bytes());
        }
    }
    // A short string needs no heap memory.
    let hash = hasher.finalize().to_hex();
    format!("f{}", &hash[..11])
}

#[cfg(test)]
mod tests {
    use crate::{Attribute, Feature, FeatureTable, Geometry, SourceOptions};
    use burgeon_base::error::Error;
    use burgeon_spatial::Crs;

    #[test]
    fn features_without_ids_keep_theirs_whatever_comes_and_goes_around_them() {
        let read = |all: &[usize]| {
            let mut table = FeatureTable::new("a", "a", Crs::epsg(4326), &SourceOptions::default());
            // Another feature may have introduced the names in another order.
            let names = if all.len().is_multiple_of(2) { ["height", "kind"] } else { ["kind", "height"] };
            let [a, b] = names.map(|name| table.name(name));
            let [kind, height] = if all.len().is_multiple_of(2) { [b, a] } else { [a, b] };
            for number in all {
                let shape = Geometry::point([f64::from(*number as u32 % 50), 1.0, 0.0]);
                let known = vec![
                    (kind, table.text(["house", "shed"][number % 2])),
                    (height, Attribute::Number(f64::from(*number as u32 / 10))),
                ];
                table.push_unnamed(vec![shape], known).unwrap();
            }
            assert_eq!(table.derived, all.len());
            let id = |feature: &Feature| feature.id.to_string();
            all.iter().copied().zip(table.features.iter().map(id)).collect::<Vec<_>>()
        };
        let all: Vec<usize> = (0..400).collect();
        let known: std::collections::BTreeMap<usize, String> = read(&all).into_iter().collect();
        let unique: std::collections::BTreeSet<&String> = known.values().collect();
        assert_eq!(unique.len(), 400);
        let mut stream = 7_usize;
        for round in 0..200 {
            let mut changed = all.clone();
            for _ in 0..1 + round % 7 {
                stream =
                    stream.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                let at = (stream >> 33) % changed.len();
                match round % 3 {
                    0 => drop(changed.remove(at)),
                    1 => changed.insert(at, 1000 + (stream >> 40) % 1000),
                    _ => changed.rotate_left(at),
                }
            }
            for (number, id) in read(&changed) {
                assert!(known.get(&number).is_none_or(|known| *known == id), "{round}: {number}");
            }
        }
        let twice = read(&[3, 5, 3, 3]);
        assert_eq!(twice[2].1, format!("{}.2", twice[0].1));
        assert_eq!(twice[1].1, known[&5]);
    }

    #[test]
    fn where_a_box_is_wanted_only_features_that_may_touch_it_are_reported() {
        let within = Some([0.0, 0.0, 10.0, 10.0]);
        let wanted = SourceOptions { within, ..SourceOptions::default() };
        let mut table = FeatureTable::new("a", "a", Crs::epsg(4326), &wanted);
        let why = || Error::data("odd");
        table.refuse_at("1".to_owned(), why(), Some([20.0, 0.0, 30.0, 5.0])).unwrap();
        table.refuse_at("2".to_owned(), why(), Some([9.0, 0.0, 30.0, 5.0])).unwrap();
        table.refuse_at("3".to_owned(), why(), None).unwrap();
        table.push("4", Vec::new(), Vec::new()).unwrap();
        table.add_empty(&[], Some([20.0, 0.0, 20.0, 0.0]));
        table.add_empty(&[], Some([2.0, 0.0, 2.0, 0.0]));
        let refused: Vec<&str> = table.refused.iter().map(|(id, _)| id.as_str()).collect();
        assert_eq!((refused, table.empty, table.collapsed), (vec!["2", "3"], 1, 1));
    }
}
