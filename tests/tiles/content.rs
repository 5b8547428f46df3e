//! Models of tiles: one mesh, compressed or not.

use serde_json::Value;

use crate::city::City;

/// Returns the descriptions of the models in a folder.
fn models(city: &City, folder: &str) -> Vec<Value> {
    let files = city.files(folder);
    let models = files.iter().filter(|(name, _)| name.ends_with(".glb"));
    let read = models.map(|(_, bytes)| {
        let length = u32::from_le_bytes(bytes[12..16].try_into().unwrap()) as usize;
        serde_json::from_slice(&bytes[20..20 + length]).unwrap()
    });
    read.collect()
}

#[test]
fn a_tile_is_one_mesh_with_a_primitive_for_each_material() {
    let city = City::new(200);
    let tiles = city.plan("out")["tiles"].as_u64().unwrap() as usize;
    city.json(&["make", "out"]);
    let models = models(&city, "out");
    assert!(models.len() == tiles && tiles > 5);
    for model in models {
        let list = |key: &str| model[key].as_array().unwrap();
        assert_eq!((list("meshes").len(), list("nodes").len()), (1, 1), "{model}");
        let primitives = list("meshes")[0]["primitives"].as_array().unwrap();
        assert_eq!(primitives.len(), list("materials").len());
        for primitive in primitives {
            let attributes = &primitive["attributes"];
            assert!(attributes["NORMAL"].is_u64() && attributes["_FEATURE_ID_0"].is_u64(), "{primitive}");
        }
        let tables = &model["extensions"]["EXT_structural_metadata"]["propertyTables"];
        assert_eq!(tables.as_array().map(Vec::len), Some(1));
    }
}

#[test]
fn compressed_tiles_show_the_same_features_in_fewer_bytes_by_any_number_of_threads() {
    let city = City::new(200);
    let mut sizes = Vec::new();
    let mut triangles = Vec::new();
    for method in ["none", "quantize", "meshopt"] {
        let other = format!("{method}-2");
        for folder in [method, &other] {
            let plan = ["plan", "city.lua", "-o", folder, "--reach", "2", "--target-features", "60"];
            city.json(&[&plan[..], &["--geoid-height", "44", "--compress", method]].concat());
        }
        city.json(&["make", method, "--threads", "1"]);
        for share in ["2/2", "1/2"] {
            city.json(&["make", &other, "--threads", "2", "--share", share]);
        }
        for folder in [method, &other] {
            city.json(&["join", folder]);
        }
        city.assert_same(method, &other);
        let checked = city.json(&["check", method]);
        assert_eq!((&checked["features"], &checked["missing"]), (&200.into(), &0.into()), "{method}");
        triangles.push(checked["triangles"].as_u64().unwrap());
        let files = city.files(method);
        sizes.push(
            files.iter().filter(|(name, _)| name.ends_with(".glb")).map(|(_, it)| it.len()).sum::<usize>(),
        );
    }
    assert!(sizes[0] > sizes[1] && sizes[1] > sizes[2], "{sizes:?}");
    assert!(triangles[0] > 1000 && triangles.iter().all(|count| *count == triangles[0]), "{triangles:?}");
}

#[test]
fn a_plan_with_other_choices_for_models_needs_to_be_replaced() {
    let city = City::new(20);
    city.plan("out");
    let plan =
        ["plan", "city.lua", "-o", "out", "--reach", "2", "--target-features", "30", "--geoid-height", "44"];
    let text = city.fails(&[&plan[..], &["--expand-instances"]].concat(), 1);
    assert!(text.contains("--replace"), "{text}");
    for (option, value) in [("--compress", "zip"), ("--precision", "0"), ("--precision", "a")] {
        city.fails(&[&plan[..], &[option, value]].concat(), 2);
    }
}
