//! Elevation files that are missing, truncated, without heights, or incomplete.

use insta::assert_snapshot;

use crate::support::Folder;

/// Returns a PNG file of 2 by 2 samples.
fn picture(color: png::ColorType, depth: png::BitDepth, content: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, 2, 2);
    encoder.set_color(color);
    encoder.set_depth(depth);
    let mut writer = encoder.write_header().unwrap();
    writer.write_image_data(content).unwrap();
    writer.finish().unwrap();
    bytes
}

/// Returns the header of a PNG file with very large dimensions.
fn large(side: u32) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, side, side);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.set_depth(png::BitDepth::Sixteen);
    drop(encoder.write_header().unwrap());
    bytes
}

/// Returns a TIFF file of 2 by 2 heights.
fn tiff(keys: &[u16], steps: &[f64], heights: [f32; 4]) -> Vec<u8> {
    use tiff::tags::Tag;
    let mut bytes = std::io::Cursor::new(Vec::new());
    let mut encoder = tiff::encoder::TiffEncoder::new(&mut bytes).unwrap();
    let mut image = encoder.new_image::<tiff::encoder::colortype::Gray32Float>(2, 2).unwrap();
    if let [a, b, c, d] = *steps {
        let matrix = [a, b, 0.0, 7.0, c, d, 0.0, 44.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0];
        image.encoder().write_tag(Tag::ModelTransformationTag, &matrix[..]).unwrap();
    }
    if !keys.is_empty() {
        image.encoder().write_tag(Tag::GeoKeyDirectoryTag, keys).unwrap();
    }
    image.write_data(&heights).unwrap();
    bytes.into_inner()
}

/// Returns an ASCII grid with the lines `header` and `heights`.
fn grid(header: &str, heights: &str) -> String {
    format!("ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\n{header}\n{heights}\n")
}

/// Returns a folder with valid and faulty files.
fn folder() -> Folder {
    use png::{BitDepth, ColorType};
    let tile = |heights: i16| (0..heights).flat_map(|height| height.to_be_bytes()).collect::<Vec<u8>>();
    let grey = picture(ColorType::Grayscale, BitDepth::Sixteen, &[0; 8]);
    let named = |code: u16| [1, 1, 0, 2, 1024, 0, 1, 2, 2048, 0, 1, code];
    let (north, flat) = ([0.1, 0.0, 0.0, -0.1], [1.0; 4]);
    let whole = tiff(&named(4326), &north, flat);
    let gdal = include_bytes!("../elevation/floats_f32.tif");
    let mut packed = zip::ZipWriter::new(std::io::Cursor::new(Vec::new()));
    packed.start_file("read.me", zip::write::SimpleFileOptions::default()).unwrap();
    let packed = packed.finish().unwrap().into_inner();
    Folder::new()
        .with("in/N43E007.hgt", tile(25))
        .with("in/cut/N43E007.hgt", tile(24))
        .with("in/nowhere.hgt", vec![0; 1201 * 1201 * 2])
        .with("in/sea/N43E006.hgt", [0x80, 0].repeat(1201 * 1201))
        .with("in/empty.hgt", "")
        .with("in/one.r32", [0; 4])
        .with("in/cut.r32", [0; 20])
        .with("in/bytes.png", picture(ColorType::Grayscale, BitDepth::Eight, &[0; 4]))
        .with("in/colours.png", picture(ColorType::Rgb, BitDepth::Eight, &[0; 12]))
        .with("in/grey.png", grey.as_slice())
        .with("in/cut.png", &grey[..grey.len() - 30])
        .with("in/big.png", large(65536))
        .with("in/bomb.png", large(14000))
        .with("in/whole.tif", whole.as_slice())
        .with("in/text.tif", "no picture at all")
        .with("in/cut.tif", &gdal[..4000])
        .with("in/cut2.tif", &whole[..whole.len() - 9])
        .with("in/turned.tif", tiff(&named(4326), &[0.1, 0.02, 0.02, -0.1], flat))
        .with("in/other.tif", tiff(&named(32767), &north, flat))
        .with("in/unknown.tif", tiff(&named(9999), &north, flat))
        .with("in/plain.tif", tiff(&[], &[], flat))
        .with("in/endless.tif", tiff(&named(4326), &north, [1.0, 2.0, f32::INFINITY, 4.0]))
        .with("in/cut.asc", grid("cellsize 1", "1 2 3"))
        .with("in/more.asc", grid("cellsize 1", "1 2 3 4 5"))
        .with("in/comma.asc", grid("cellsize 1", "1,5 2 3 4"))
        .with("in/mark.asc", grid("cellsize 1", "1 2 3 999999"))
        .with("in/degrees.asc", grid("cellsize 0.0002", "1 2 3 4"))
        .with("in/size.asc", grid("", "1 2 3 4"))
        .with("in/odd.asc", grid("cellsize 1\nproj 3", "1 2 3 4"))
        .with("in/huge.asc", "ncols 100000\nnrows 100000\ncellsize 1\n1")
        .with("in/whole.asc", grid("cellsize 1", "1 2 3 4"))
        .with("in/packed.hgt.zip", packed)
        .with("in/broken.zip", "PK\u{3}\u{4} and so on")
        .with("in/heights.xyz", "1 2 3")
        .with("outside.hgt", tile(25))
}

/// Returns the error message for a script whose second line is `line`.
fn told(line: &str) -> String {
    folder().with("in/s.lua", format!("local a = 1\n{line}\n")).refuses(&["run", "in/s.lua"])
}

#[test]
fn what_is_made_of_a_file_alone_takes_no_options() {
    assert_snapshot!(told(r#"model("a.glb", { fast = true })"#), @r#"
    error: in/s.lua:2:1: model does not accept options
      | model("a.glb", { fast = true })
      | ^^^^^
      help: write model("window.glb")
    "#);
}

#[test]
fn a_file_of_heights_that_is_missing_or_lies_outside_is_told() {
    assert_snapshot!(told(r#"elevation("N43E008.hgt")"#), @r#"
    error: in/s.lua:2:1: height file not found: N43E008.hgt
      | elevation("N43E008.hgt")
      | ^^^^^^^^^^^^^^^^^^^^^^^^
      help: it is looked for from the script's folder; other folders are given with --data FOLDER
    "#);
    assert_snapshot!(told(r#"elevation("../outside.hgt")"#), @r#"
    error: in/s.lua:2:1: the height file ../outside.hgt lies outside the script's folder
      | elevation("../outside.hgt")
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: a script reads data in its own folder and below it, and in those that are given: --data FOLDER
    "#);
    assert_snapshot!(told(r#"elevation()"#), @r#"
    error: in/s.lua:2:1: elevation needs a file name
      | elevation()
      | ^^^^^^^^^
      help: write elevation("N43E007.hgt")
    "#);
    assert_snapshot!(told(r#"elevation("cut")"#), @r#"
    error: in/s.lua:2:1: cut/N43E007.hgt is not square: it has 48 of the 2884802 bytes of 1201 x 1201 heights
      | elevation("cut")
      | ^^^^^^^^^^^^^^^^
      help: it is cut short; download it again
    "#);
}

#[test]
fn a_file_that_is_not_whole_is_told() {
    assert_snapshot!(told(r#"elevation("empty.hgt")"#), @r#"
    error: in/s.lua:2:1: empty.hgt is empty
      | elevation("empty.hgt")
      | ^^^^^^^^^^^^^^^^^^^^^^
      help: download it again
    "#);
    assert_snapshot!(told(r#"elevation("cut/N43E007.hgt")"#), @r#"
    error: in/s.lua:2:1: cut/N43E007.hgt is not square: it has 48 of the 2884802 bytes of 1201 x 1201 heights
      | elevation("cut/N43E007.hgt")
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: it is cut short; download it again
    "#);
    assert_snapshot!(told(r#"elevation("cut.r32")"#), @r#"
    error: in/s.lua:2:1: cut.r32 is not square: it has 20 of the 36 bytes of 3 x 3 floats
      | elevation("cut.r32")
      | ^^^^^^^^^^^^^^^^^^^^
      help: it is cut short, or not a square of floats; a GeoTIFF can have any shape
    "#);
    assert_snapshot!(told(r#"elevation("cut.png", { bounds = { 0, 0, 1, 1 } })"#), @r#"
    error: in/s.lua:2:1: cut.png is cut short: it ends after 42 bytes, but more should follow
      | elevation("cut.png", { bounds = { 0, 0, 1, 1 } })
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: download it again
    "#);
    assert_snapshot!(told(r#"elevation("cut.tif")"#), @r#"
    error: in/s.lua:2:1: cut.tif is cut short: it has 4000 of 5862 bytes
      | elevation("cut.tif")
      | ^^^^^^^^^^^^^^^^^^^^
      help: download it again
    "#);
    assert_snapshot!(told(r#"elevation("cut2.tif")"#), @r#"
    error: in/s.lua:2:1: cut2.tif is cut short
      | elevation("cut2.tif")
      | ^^^^^^^^^^^^^^^^^^^^^
      help: download it again
    "#);
    assert_snapshot!(told(r#"elevation("cut.asc")"#), @r#"
    error: in/s.lua:2:1: cut.asc is cut short: it has 3 of 4 heights (57 bytes)
      | elevation("cut.asc")
      | ^^^^^^^^^^^^^^^^^^^^
      help: download it again
    "#);
    assert_snapshot!(told(r#"elevation("broken.zip")"#), @r#"
    error: in/s.lua:2:1: broken.zip cannot be unpacked
      | elevation("broken.zip")
      | ^^^^^^^^^^^^^^^^^^^^^^^
      help: the file is damaged or cut short; download it again
    "#);
    assert_snapshot!(told(r#"elevation("packed.hgt.zip")"#), @r#"
    error: in/s.lua:2:1: packed.hgt.zip contains no .hgt file
      | elevation("packed.hgt.zip")
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: unpack it, and specify the height file itself
    "#);
}

#[test]
fn a_file_that_is_no_raster_of_heights_is_told() {
    assert_snapshot!(told(r#"elevation("heights.xyz")"#), @r#"
    error: in/s.lua:2:1: heights.xyz has an unknown format of heights
      | elevation("heights.xyz")
      | ^^^^^^^^^^^^^^^^^^^^^^^^
      help: supported formats are .hgt (also zipped), GeoTIFF (.tif), ESRI ASCII grid (.asc), PNG, and raw floats (.r32, .r64)
    "#);
    assert_snapshot!(told(r#"elevation("text.tif")"#), @r#"
    error: in/s.lua:2:1: text.tif does not begin like a .tif file
      | elevation("text.tif")
      | ^^^^^^^^^^^^^^^^^^^^^
      help: download it again, or correct its extension
    "#);
    assert_snapshot!(told(r#"elevation("bytes.png")"#), @r#"
    error: in/s.lua:2:1: bytes.png is a PNG of at most 8 bits: 256 levels are too coarse for heights
      | elevation("bytes.png")
      | ^^^^^^^^^^^^^^^^^^^^^^
      help: export it with 16 bits, or as a GeoTIFF
    "#);
    assert_snapshot!(told(r#"elevation("colours.png")"#), @r#"
    error: in/s.lua:2:1: colours.png is a PNG in colour, not in 16-bit grey
      | elevation("colours.png")
      | ^^^^^^^^^^^^^^^^^^^^^^^^
      help: if its colours are heights in Mapbox encoding, set encoding = "terrain-rgb"
    "#);
    assert_snapshot!(told(r#"elevation("turned.tif")"#), @r#"
    error: in/s.lua:2:1: turned.tif is rotated: its columns do not point north
      | elevation("turned.tif")
      | ^^^^^^^^^^^^^^^^^^^^^^^
      help: resample it: gdalwarp IN OUT.tif
    "#);
    assert_snapshot!(told(r#"elevation("comma.asc")"#), @r#"
    error: in/s.lua:2:1: comma.asc has "1,5" in line 6, which is not a height
      | elevation("comma.asc")
      | ^^^^^^^^^^^^^^^^^^^^^^
      help: write heights with a decimal point, such as 12.5
    "#);
    assert_snapshot!(told(r#"elevation("size.asc")"#), @r#"
    error: in/s.lua:2:1: size.asc has no cellsize in its header
      | elevation("size.asc")
      | ^^^^^^^^^^^^^^^^^^^^^
      help: a grid begins with ncols, nrows, xllcorner, yllcorner and cellsize; convert the file: gdal_translate -of AAIGrid IN OUT.asc
    "#);
    assert_snapshot!(told(r#"elevation("odd.asc")"#), @r#"
    error: in/s.lua:2:1: odd.asc has "proj 3" in line 6, in its header
      | elevation("odd.asc")
      | ^^^^^^^^^^^^^^^^^^^^
      help: a grid begins with ncols, nrows, xllcorner, yllcorner and cellsize; convert the file: gdal_translate -of AAIGrid IN OUT.asc
    "#);
    assert_snapshot!(told(r#"elevation("one.r32")"#), @r#"
    error: in/s.lua:2:1: one.r32 has 1 x 1 heights
      | elevation("one.r32")
      | ^^^^^^^^^^^^^^^^^^^^
      help: at least 2 x 2 heights are needed for interpolation
    "#);
}

#[test]
fn sizes_and_heights_that_cannot_be_are_told() {
    assert_snapshot!(told(r#"elevation("N43E007.hgt")"#), @r#"
    error: in/s.lua:2:1: N43E007.hgt has 5 x 5 heights, which is not the size of a one-degree tile
      | elevation("N43E007.hgt")
      | ^^^^^^^^^^^^^^^^^^^^^^^^
      help: tiles have 1201 x 1201 or 3601 x 3601 heights; if it is a part of a tile, specify its bounds and crs
    "#);
    assert_snapshot!(told(r#"elevation("bomb.png", { low = 0, high = 1, bounds = { 0, 0, 1, 1 } })"#), @r#"
    error: in/s.lua:2:1: bomb.png is cut short: its 45 bytes cannot hold 14000 x 14000 heights
      | elevation("bomb.png", { low = 0, high = 1, bounds = { 0, 0, 1, 1 } })
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: download it again
    "#);
    assert_snapshot!(told(r#"elevation("huge.asc")"#), @r#"
    error: in/s.lua:2:1: huge.asc has 100000 x 100000 heights, more than 200 million
      | elevation("huge.asc")
      | ^^^^^^^^^^^^^^^^^^^^^
      help: cut out a part: gdal_translate -srcwin LEFT TOP COLUMNS ROWS
    "#);
    assert_snapshot!(told(r#"elevation("big.png")"#), @r#"
    error: in/s.lua:2:1: big.png has 65536 x 65536 heights, more than 200 million
      | elevation("big.png")
      | ^^^^^^^^^^^^^^^^^^^^
      help: cut out a part: gdal_translate -srcwin LEFT TOP COLUMNS ROWS
    "#);
    assert_snapshot!(told(r#"elevation("sea/N43E006.hgt")"#), @r#"
    error: in/s.lua:2:1: sea/N43E006.hgt contains no data: all its heights are missing
      | elevation("sea/N43E006.hgt")
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: download another part, or open it in a map viewer
    "#);
}

#[test]
fn marks_of_missing_heights_that_a_file_does_not_declare_are_reported_and_left_out() {
    let script = r#"--!strict
local one = elevation("endless.tif")
local two = elevation("mark.asc", { bounds = { 0, 0, 2, 2 } })
print(one:high().z, two:high().z)
elevation("mark.asc", { fill = true })
"#;
    let folder = folder().with("in/s.lua", script);
    let said = folder.burgeon(&["run", "in/s.lua", "--json"]).done();
    assert_eq!(said.stderr.trim(), "4\t3");
    let json = said.json();
    let told = |warning: &serde_json::Value| warning["message"].as_str().unwrap().to_owned();
    let warnings: Vec<String> = json["warnings"].as_array().unwrap().iter().map(told).collect();
    assert_snapshot!(warnings.join("\n"), @r#"
    endless.tif: 1 height is inf and counts as missing, though the file does not declare it
    endless.tif: filled 1 of 4 missing heights from their surroundings
    mark.asc: 1 height is 999999 and counts as missing, though the file does not declare it
    mark.asc: filled 1 of 4 missing heights from their surroundings
    "#);
}

#[test]
fn several_files_are_one_ground() {
    let script = r#"--!strict
local ground = elevation({ "tiles/east.asc", "tiles/west.asc" })
local folder = elevation("tiles")
local pattern = elevation("tiles/*st.asc")
for _, x in { 0.5, 1.9, 2, 2.1, 3.5 } do
  print(ground:height({ x, 1 }), folder:height({ x, 1 }), pattern:height({ x, 1 }))
end
"#;
    let tile = |x: f64, heights: &str| {
        format!("ncols 2\nnrows 2\nxllcorner {x}\nyllcorner 0\ncellsize 1\n{heights}\n")
    };
    let folder = Folder::new()
        .with("s.lua", script)
        .with("tiles/west.asc", tile(0.0, "1 2\n1 2"))
        .with("tiles/east.asc", tile(2.0, "3 4\n3 4"));
    let said = folder.burgeon(&["run", "s.lua", "--json"]).done();
    assert_snapshot!(said.stderr, @r#"
    1	1	1
    2.3999999999999995	2.3999999999999995	2.3999999999999995
    2.5	2.5	2.5
    2.6000000000000005	2.6000000000000005	2.6000000000000005
    4	4	4
    "#);
    let refused = |call: &str| {
        let folder = Folder::new()
            .with("s.lua", format!("{call}\n"))
            .with("a.asc", tile(0.0, "1 2\n1 2"))
            .with("b.asc", tile(2.3, "1 2\n1 2"))
            .with("empty/readme.txt", "");
        folder.refuses(&["run", "s.lua"])
    };
    assert_snapshot!(refused(r#"elevation({ "a.asc", "b.asc" })"#), @r#"
    error: s.lua:1:1: the heights of b.asc are not on the same grid as the heights of a.asc
      | elevation({ "a.asc", "b.asc" })
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: resample all files to one grid: gdalwarp -tr X Y -tap IN... OUT.tif
    "#);
    assert_snapshot!(refused(r#"elevation("empty")"#), @r#"
    error: s.lua:1:1: empty means no files, each a height file
      | elevation("empty")
      | ^^^^^^^^^^^^^^^^^^
      help: name 1 to 1000 files that end in .hgt, .tif, .tiff, .asc, .zip
    "#);
    assert_snapshot!(refused(r#"elevation({ "a.asc", 3 })"#), @r#"
    error: s.lua:1:1: elevation needs a file name, or a list of file names
      | elevation({ "a.asc", 3 })
      | ^^^^^^^^^
      help: write elevation("N43E007.hgt")
    "#);
    assert_snapshot!(refused(r#"elevation("c*.asc")"#), @r#"
    error: s.lua:1:1: c*.asc means no files, each a height file
      | elevation("c*.asc")
      | ^^^^^^^^^^^^^^^^^^^
      help: name 1 to 1000 files that end in .hgt, .tif, .tiff, .asc, .zip
    "#);
}

#[test]
fn what_a_file_does_not_tell_is_asked_for() {
    assert_snapshot!(told(r#"elevation("nowhere.hgt")"#), @r#"
    error: in/s.lua:2:1: nowhere.hgt does not contain its location
      | elevation("nowhere.hgt")
      | ^^^^^^^^^^^^^^^^^^^^^^^^
      help: name it after its south-west corner, such as N43E007.hgt, or specify its bounds and crs
    "#);
    assert_snapshot!(told(r#"elevation("grey.png", { bounds = { 0, 0, 1, 1 } })"#), @r#"
    error: in/s.lua:2:1: grey.png does not specify the heights of black and white
      | elevation("grey.png", { bounds = { 0, 0, 1, 1 } })
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: specify them (m): elevation(file, { low = 0, high = 1200, ... })
    "#);
    assert_snapshot!(told(r#"elevation("grey.png", { low = 0, high = 100 })"#), @r#"
    error: in/s.lua:2:1: grey.png does not contain its location
      | elevation("grey.png", { low = 0, high = 100 })
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: specify its bounds: elevation(file, { bounds = { west, south, east, north } }), in metres of the run, or in the coordinate system crs
    "#);
    assert_snapshot!(told(r#"elevation("plain.tif")"#), @r#"
    error: in/s.lua:2:1: plain.tif does not contain its location
      | elevation("plain.tif")
      | ^^^^^^^^^^^^^^^^^^^^^^
      help: specify its bounds: elevation(file, { bounds = { west, south, east, north } }), in metres of the run, or in the coordinate system crs
    "#);
    assert_snapshot!(told(r#"elevation("other.tif")"#), @r#"
    error: in/s.lua:2:1: other.tif has a coordinate system without an EPSG code
      | elevation("other.tif")
      | ^^^^^^^^^^^^^^^^^^^^^^
      help: specify its EPSG code: elevation(file, { crs = 3067 }), or convert the file: gdalwarp -t_srs EPSG:4326 IN OUT.tif
    "#);
    assert_snapshot!(told(r#"elevation("unknown.tif")"#), @r#"
    error: in/s.lua:2:1: unknown.tif: unknown coordinate system EPSG:9999
      | elevation("unknown.tif")
      | ^^^^^^^^^^^^^^^^^^^^^^^^
      help: specify its EPSG code: elevation(file, { crs = 3067 }), or convert the file: gdalwarp -t_srs EPSG:4326 IN OUT.tif
    "#);
    assert_snapshot!(told(r#"elevation("degrees.asc")"#), @r#"
    error: in/s.lua:2:1: degrees.asc has steps of 0.0002 x 0.0002 m, less than a millimetre
      | elevation("degrees.asc")
      | ^^^^^^^^^^^^^^^^^^^^^^^^
      help: if these are degrees, specify it: elevation(file, { crs = 4326 })
    "#);
    assert_snapshot!(told(r#"elevation("whole.tif", { crs = 3067 }) source("none.gpkg")"#), @r#"
    error: in/s.lua:2:1: data file not found: none.gpkg
      | elevation("whole.tif", { crs = 3067 }) source("none.gpkg")
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: it is looked for from the script's folder; other folders are given with --data FOLDER
    "#);
}

#[test]
fn options_that_cannot_be_are_told() {
    assert_snapshot!(told(r#"elevation("whole.tif", { csr = 4326 })"#), @r#"
    error: in/s.lua:2:26: unknown field `csr` in elevation
      | elevation("whole.tif", { csr = 4326 })
      |                          ^^^
      help: did you mean crs?
    "#);
    assert_snapshot!(told(r#"elevation("whole.tif", { crs = 99999 })"#), @r#"
    error: in/s.lua:2:1: elevation: unknown coordinate system EPSG:99999
      | elevation("whole.tif", { crs = 99999 })
      | ^^^^^^^^^
      help: specify the correct one: elevation(file, { crs = 4326 })
    "#);
    assert_snapshot!(told(r#"elevation("whole.tif", { low = 1 })"#), @r#"
    error: in/s.lua:2:26: whole.tif is not a PNG, so low, high and encoding are not allowed
      | elevation("whole.tif", { low = 1 })
      |                          ^^^
      help: its heights are already in metres; remove these options
    "#);
    assert_snapshot!(told(r#"elevation("whole.tif", { bounds = { 1, 2, 3 } })"#), @r#"
    error: in/s.lua:2:1: elevation: bounds has 3 numbers, not 4
      | elevation("whole.tif", { bounds = { 1, 2, 3 } })
      | ^^^^^^^^^
      help: write { west, south, east, north }
    "#);
    assert_snapshot!(told(r#"elevation("whole.tif", { bounds = { 1, 2, 0, 3 } })"#), @r#"
    error: in/s.lua:2:1: elevation: bounds = { 1, 2, 0, 3 } are empty
      | elevation("whole.tif", { bounds = { 1, 2, 0, 3 } })
      | ^^^^^^^^^
      help: write { west, south, east, north }, with west below east and south below north
    "#);
    assert_snapshot!(told(r#"elevation("whole.tif", { bounds = { 385000, 6671000, 386000, 6672000 } })"#), @r#"
    error: in/s.lua:2:1: whole.tif is at 385250, 6671750, which is not a valid longitude and latitude
      | elevation("whole.tif", { bounds = { 385000, 6671000, 386000, 6672000 } })
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: specify the coordinate system of the file: elevation(file, { crs = 3067 })
    "#);
    assert_snapshot!(told(r#"elevation("grey.png", { encoding = "terrarium" })"#), @r#"
    error: in/s.lua:2:37: elevation: unknown encoding "terrarium"
      | elevation("grey.png", { encoding = "terrarium" })
      |                                     ^^^^^^^^^
      help: write encoding = "terrain-rgb", or omit it
    "#);
    assert_snapshot!(told(r#"elevation("grey.png", { encoding = "terrain-rgb" })"#), @r#"
    error: in/s.lua:2:1: grey.png has no 8-bit colours to decode as heights
      | elevation("grey.png", { encoding = "terrain-rgb" })
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: remove encoding if it is grey; download the tile as .pngraw if it has a palette
    "#);
    assert_snapshot!(told(r#"elevation("grey.png", { low = 9, high = 1, bounds = { 0, 0, 1, 1 } })"#), @r#"
    error: in/s.lua:2:25: grey.png cannot be scaled from low = 9 to high = 1
      | elevation("grey.png", { low = 9, high = 1, bounds = { 0, 0, 1, 1 } })
      |                         ^^^
      help: low is the height (m) of black; high, the height of white, must be greater
    "#);
    assert_snapshot!(told(r#"elevation("whole.tif", 4326)"#), @r#"
    error: in/s.lua:2:1: elevation takes a table of options, not a number
      | elevation("whole.tif", 4326)
      | ^^^^^^^^^
      help: write elevation("N43E007.hgt", { crs = 4326 })
    "#);
}

#[test]
fn a_place_outside_is_told() {
    assert_snapshot!(told(r#"elevation("whole.asc"):height({ 2, 2.5 })"#), @r#"
    error: in/s.lua:2:1: elevation: 2.0, 2.5 is outside whole.asc, which extends from 0.0, 0.0 to 2.0, 2.0
      | elevation("whole.asc"):height({ 2, 2.5 })
      | ^^^^^^^^^
      help: use a position within its bounds, or a larger file
    "#);
    assert_snapshot!(told(r#"elevation("whole.asc"):height({ 2 })"#), @r#"
    error: in/s.lua:2:24: elevation:height: place must be a vector: { x, y, z } or vec(x, y, z), not {2}
      | elevation("whole.asc"):height({ 2 })
      |                        ^^^^^^
      help: write elevation:height(place: Vector)
    "#);
    assert_snapshot!(told(r#"elevation("whole.asc"):hight({ 2, 2 })"#), @r#"
    error: in/s.lua:2:24: unknown method or field `hight` of elevation
      | elevation("whole.asc"):hight({ 2, 2 })
      |                        ^^^^^
      help: did you mean high?
    "#);
}

#[test]
fn a_chain_whose_place_lies_outside_is_left_out() {
    let script = r#"
local ground = elevation("whole.asc")
local A = module("A", "x")
local s = lsystem({ object = turtle() })
s:axiom(source({ { id = "in", x = 1 }, { id = "out", x = 9 } }), function(feature)
  return A(ground:height({ feature.x, 1 }))
end)
s:interpret("A(h)", function(this, h) this:forward(h) end)
print(#s:derive(1).chains)
"#;
    let folder = folder().with("in/s.lua", script);
    let said = folder.burgeon(&["run", "in/s.lua"]).done();
    assert!(said.stderr.contains("1 of 2 features skipped"), "{}", said.stderr);
}

#[test]
fn heights_are_asked_in_rules_and_holes_are_told_where_the_file_is_asked_for() {
    let script = r#"
local ground = elevation("holes.asc")
assert(elevation("holes.asc"):height({ 0.5, 0.5 }) == ground:height({ 0.5, 0.5 }))
local A, B = module("A", "x"), module("B", "h")
local s = lsystem()
s:axiom(A(0.5), A(1.5))
s:rule("A(x)", function(this, x) return B(ground:height({ x, 1.5 })) end)
print(s:derive().chains[1])
print(ground:low().z, ground:high().z, ground:high().x, ground:step(), tostring(ground))
"#;
    let folder =
        folder().with("in/s.lua", script).with("in/holes.asc", grid("cellsize 1\nnodata_value 0", "4 8 0 6"));
    let said = folder.burgeon(&["run", "in/s.lua", "--json"]).done();
    assert_snapshot!(said.stderr, @r#"
    B(4) B(8)
    4	8	2	1	elevation
    "#);
    let warnings: Vec<String> = said.json()["warnings"]
        .as_array()
        .unwrap()
        .iter()
        .map(|told| format!("{}: {} ({})", told["line"], told["message"].as_str().unwrap(), told["code"]))
        .collect();
    assert_snapshot!(warnings.join("\n"), @r#"
    2: holes.asc: filled 1 of 4 missing heights from their surroundings ("warning.data")
    3: holes.asc: filled 1 of 4 missing heights from their surroundings ("warning.data")
    "#);
}
