//! Terrain tiles beside the tiles of features.

use serde_json::Value;

use crate::city::City;

/// Writes hills of 3 km around the city, with a height each 10 m.
fn write_heights(city: &City, lift: f64) {
    let mut text = "ncols 300\nnrows 300\nxllcorner 650600\nyllcorner 6860600\ncellsize 10\n".to_owned();
    for row in 0..300 {
        let height = |column: i32| {
            let (x, y) = (f64::from(column) / 17.0, f64::from(row) / 23.0);
            format!("{:.2}", 60.0 + lift + 25.0 * x.sin() * y.cos() + f64::from((column * row) % 7) * 0.3)
        };
        text += &(0..300).map(height).collect::<Vec<_>>().join(" ");
        text.push('\n');
    }
    std::fs::write(city.path("hills.asc"), text).unwrap();
}

fn plan(city: &City, folder: &str) -> Value {
    let arguments = ["plan", "city.lua", "-o", folder, "--target-features", "100", "--geoid-height", "44"];
    city.json(&[&arguments[..], &["--terrain", "hills.asc"]].concat())
}

/// Returns the geometric errors of the contents of a tile and of those inside, by level below it.
fn errors(tile: &Value, depth: usize, found: &mut Vec<(usize, f64, bool)>) {
    let children = tile["children"].as_array().cloned().unwrap_or_default();
    if tile["content"]["uri"].is_string() {
        let error = tile["geometricError"].as_f64().unwrap();
        found.push((depth, error, !children.is_empty()));
        assert!(children.is_empty() || tile["refine"] == "REPLACE");
    }
    children.iter().for_each(|child| errors(child, depth + 1, found));
}

#[test]
fn terrain_has_its_own_levels_with_measured_errors_beside_the_features() {
    let city = City::new(200);
    write_heights(&city, 0.0);
    let planned = plan(&city, "out");
    let tiles = planned["terrain"].as_u64().unwrap();
    assert!(tiles > 20, "{planned}");
    for share in ["2/2", "1/2"] {
        city.json(&["make", "out", "--share", share]);
    }
    let joined = city.json(&["join", "out", "--tiling", "both"]);
    assert_eq!(
        (&joined["terrain"], &joined["open"], &joined["missing"]),
        (&tiles.into(), &0.into(), &0.into())
    );
    let checked = city.json(&["check", "out"]);
    assert_eq!((&checked["terrain"], &checked["features"]), (&tiles.into(), &200.into()));
    let read = |name: &str| -> Value {
        serde_json::from_slice(&std::fs::read(city.path("out").join(name)).unwrap()).unwrap()
    };
    for name in ["tileset.json", "implicit.json"] {
        let children = read(name)["root"]["children"].as_array().cloned().unwrap();
        assert_eq!((children.len(), &children[1]["content"]["uri"]), (2, &"terrain.json".into()), "{name}");
    }
    let mut found = Vec::new();
    errors(&read("terrain.json")["root"], 0, &mut found);
    assert_eq!(found.len() as u64, tiles);
    for (_, error, has_children) in &found {
        // Noise of up to 1.8 m is in no coarser grid, and hills of 25 m in none with steps of hundreds of metres.
        assert!(if *has_children { (1.0..60.0).contains(error) } else { *error == 0.0 }, "{found:?}");
    }
    // The same bytes by one process.
    plan(&city, "other");
    city.json(&["make", "other", "--threads", "1"]);
    city.json(&["join", "other", "--tiling", "both"]);
    city.assert_same("out", "other");
    let status = city.json(&["status", "out"]);
    assert_eq!((&status["open"], &status["part"]), (&0.into(), &1.0.into()));
}

#[test]
fn other_heights_remake_the_terrain_and_no_features() {
    let city = City::new(60);
    write_heights(&city, 0.0);
    let planned = plan(&city, "out");
    let (terrain, tiles) = (planned["terrain"].as_u64().unwrap(), planned["tiles"].as_u64().unwrap());
    assert_eq!(city.json(&["make", "out"])["made"], terrain + tiles);
    write_heights(&city, 3.0);
    assert!(city.fails(&["make", "out"], 1).contains("hills.asc has changed"));
    plan(&city, "out");
    let made = city.json(&["make", "out"]);
    assert_eq!((&made["made"], &made["kept"]), (&terrain.into(), &tiles.into()));
    city.json(&["join", "out"]);
    city.json(&["check", "out"]);
    let path = city.path("out/terrain.json");
    let text = std::fs::read_to_string(&path).unwrap();
    std::fs::write(&path, text.replace("REPLACE", "ADD")).unwrap();
    assert!(city.fails(&["check", "out"], 1).contains("is shown together with finer terrain"));
    // The coordinate system of the heights can be a file of its own.
    std::fs::write(city.path("hills.prj"), "none").unwrap();
    assert!(city.fails(&["make", "out"], 1).contains("hills.asc has changed"));
    std::fs::remove_file(city.path("hills.prj")).unwrap();
    // Without a terrain, its tileset is removed.
    city.json(&[
        "plan",
        "city.lua",
        "-o",
        "out",
        "--target-features",
        "100",
        "--geoid-height",
        "44",
        "--replace",
    ]);
    city.json(&["join", "out"]);
    assert!(!path.exists());
    let text = city.fails(&["plan", "city.lua", "-o", "no", "--terrain", "none.tif"], 1);
    assert!(text.contains("there is no file of heights none.tif"), "{text}");
}

#[test]
fn a_script_whose_houses_stand_on_a_terrain_of_its_own_is_planned_and_made() {
    let script = "local Walls = module(\"Walls\")\nlocal buildings = source(\"city.gpkg:buildings\")\n\
        local land = lsystem({ object = terrain({ size = 2000, position = { 0, 0 }, levels = 5,\n\
        \x20 elevation = elevation(\"hills.asc\", { crs = 2154 }) }) })\n\
        local ground = land:derive().objects[1]\n\
        local houses = lsystem({ object = footprint })\n\
        houses:axiom(buildings, function(feature) return footprint(feature.geometry, { ground = ground }), Walls() end)\n\
        houses:interpret(\"Walls\", function(this) this:walls({ height = 5 }) end)\nhouses:derive(0)\n";
    let city = City::new(60);
    write_heights(&city, 0.0);
    std::fs::write(city.path("city.lua"), script).unwrap();
    plan(&city, "out");
    city.json(&["make", "out"]);
    city.json(&["join", "out"]);
    let checked = city.json(&["check", "out"]);
    assert_eq!(checked["features"], 60);
}

/// Returns the images of all terrain tiles with their paths, as red, green and blue.
fn images(city: &City, folder: &str) -> Vec<(String, image::RgbImage)> {
    let mut found = Vec::new();
    let mut folders = vec![city.path(folder)];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
                continue;
            }
            if path.extension().is_none_or(|extension| extension != "glb") {
                continue;
            }
            let file = gltf::Gltf::from_slice_without_validation(&std::fs::read(&path).unwrap()).unwrap();
            let blob = file.blob.as_deref().unwrap_or_default();
            for image in file.images() {
                let gltf::image::Source::View { view, .. } = image.source() else { continue };
                let bytes = &blob[view.offset()..view.offset() + view.length()];
                let pixels = image::load_from_memory(bytes).unwrap().to_rgb8();
                found.push((path.display().to_string(), pixels));
            }
        }
    }
    found.sort_by(|(a, _), (b, _)| a.cmp(b));
    found
}

fn covered(color: &str) -> String {
    format!(
        "local Walls = module(\"Walls\")\n\
         lsystem({{ object = terrain({{ size = 2000, levels = 4, visible = false,\n\
         \x20 rules = {{ A = {{ \"A\", \"A\", \"A\", \"A\", change = {{ 0, 0, 0, 0 }}, decay = 0.5 }} }},\n\
         \x20 covers = {{ {{ color = \"{color}\" }}, {{ color = \"#808080\", on = {{ slope = {{ 1, 4 }} }} }} }} }}) }}):derive()\n\
         local houses = lsystem({{ object = footprint }})\n\
         houses:axiom(source(\"city.gpkg:buildings\"), function(feature) return footprint(feature.geometry), Walls() end)\n\
         houses:interpret(\"Walls\", function(this) this:walls({{ height = 5 }}) end)\nhouses:derive(0)\n"
    )
}

#[test]
fn a_terrain_without_covers_and_water_is_named_as_the_reason_of_one_colour() {
    let city = City::new(60);
    write_heights(&city, 0.0);
    let one = covered("#407030");
    let (before, rest) = one.split_once("  covers").unwrap();
    let (_, after) = rest.split_once("}) })").unwrap();
    let plain = format!("{before}  color = \"#407030\" }}) }}){after}");
    std::fs::write(city.path("city.lua"), &plain).unwrap();
    let said = |planned: Value| planned["warnings"].to_string();
    let one_color = "terrain tiles have one colour, because";
    let text = said(plan(&city, "out"));
    assert!(
        text.contains(&format!("{one_color} the terrain of the script has no covers and no water")),
        "{text}"
    );
    city.json(&["make", "out"]);
    assert!(images(&city, "out").is_empty());
    // The terrain a second time: the lines between the module and the houses.
    let again = plain.split_once('\n').and_then(|(_, rest)| rest.split_once("local houses")).unwrap().0;
    let two = plain.replace("local houses", &format!("{again}local houses"));
    std::fs::write(city.path("city.lua"), two).unwrap();
    let text = said(plan(&city, "two"));
    assert!(text.contains(&format!("{one_color} none of the 2 terrains of the script has covers")), "{text}");
}

#[test]
fn terrain_has_the_colours_of_the_covers_of_the_script_in_any_share() {
    let city = City::new(60);
    write_heights(&city, 0.0);
    let said = |planned: &Value| planned["warnings"].to_string().contains("terrain tiles have one colour");
    assert!(said(&plan(&city, "plain")));
    city.json(&["make", "plain"]);
    assert!(images(&city, "plain").is_empty());

    std::fs::write(city.path("city.lua"), covered("#407030")).unwrap();
    let planned = plan(&city, "out");
    let tiles = planned["terrain"].as_u64().unwrap();
    assert!(!said(&planned), "{planned}");
    for share in ["2/2", "1/2"] {
        city.json(&["make", "out", "--share", share]);
    }
    city.json(&["join", "out"]);
    city.json(&["check", "out"]);
    let found = images(&city, "out");
    assert_eq!(found.len() as u64, tiles);
    // The green of flat ground and the grey of slopes, or their mean.
    let is_green = |pixel: &image::Rgb<u8>| pixel[1] > pixel[0] + 20;
    let is_grey = |pixel: &image::Rgb<u8>| pixel[1].abs_diff(pixel[0]) < 8;
    let mixed = found.iter().filter(|(_, image)| image.pixels().any(is_green) && image.pixels().any(is_grey));
    assert!(mixed.count() * 2 > found.len());

    plan(&city, "other");
    city.json(&["make", "other", "--threads", "1"]);
    city.json(&["join", "other"]);
    city.assert_same("out", "other");

    // Other colours make the tiles again.
    std::fs::write(city.path("city.lua"), covered("#c03030")).unwrap();
    plan(&city, "out");
    let made = city.json(&["make", "out"]);
    assert!(made["made"].as_u64().unwrap() >= tiles, "{made}");
    assert!(
        images(&city, "out").iter().any(|(_, image)| image.pixels().any(|pixel| pixel[0] > pixel[1] + 50))
    );
}
