//! Tests of films: `burgeon run --frames` and `--turntable`.

use std::path::Path;

use gltf::animation::util::ReadOutputs;
use insta::assert_snapshot;

use crate::support::{Folder, assert_decent};

const SCRIPT: &str = r#"local time = param("time", { default = 1, min = 0, max = 9, unit = "days" })
param("kind", { default = "a", choices = { "a", "b" } })
local A = module("A", "x")
local s = lsystem({ object = turtle({ width = 0.2 }) })
s:axiom(A(1))
s:rule("A(x)", function(this, x)
  if time == 7 then error("seven is too many") end
  return F(x * (0.5 + time)), { Turn(30), A(x * random(0.4, 0.9)) }, A(x * 0.5)
end)
s:interpret("A(x)", function(this, x) this:forward(x) end)
s:derive(3)
local ground = lsystem({ object = extruder({ sides = 4 }) })
local Slab = module("Slab")
ground:axiom(Slab())
ground:interpret("Slab", function(this) this:extrude(0.1) end)
ground:derive()
"#;

fn folder() -> Folder {
    Folder::new().with("s.lua", SCRIPT)
}

fn arguments<'a>(flags: &[&'a str]) -> Vec<&'a str> {
    [&["run", "s.lua", "--size", "48x36"], flags].concat()
}

/// Returns the error message for a film that is refused, which leaves all files as they were.
fn refused(flags: &[&str]) -> String {
    folder().with("film.gif", "old").refuses(&arguments(flags))
}

/// Returns the error message for a wrong command line.
fn wrong(flags: &[&str]) -> String {
    let said = folder().burgeon(&arguments(flags));
    assert_eq!((said.status, said.stdout.as_str()), (2, ""), "{}", said.stderr);
    assert_decent(&said.stderr);
    said.stderr
}

/// Returns the delays (1/100 s) and the whole images of the frames of a GIF, and the number of repetitions.
fn read_gif(path: &Path) -> (Vec<u16>, Vec<Vec<u8>>, gif::Repeat) {
    let mut options = gif::DecodeOptions::new();
    options.set_color_output(gif::ColorOutput::RGBA);
    let mut decoder = options.read_info(std::fs::File::open(path).unwrap()).unwrap();
    let (width, height) = (usize::from(decoder.width()), usize::from(decoder.height()));
    assert_eq!((width, height), (48, 36));
    let mut canvas = vec![0; width * height * 4];
    let (mut delays, mut images) = (Vec::new(), Vec::new());
    while let Some(frame) = decoder.read_next_frame().unwrap() {
        let row = usize::from(frame.width) * 4;
        for (y, pixels) in frame.buffer.chunks(row).enumerate() {
            let begin = ((usize::from(frame.top) + y) * width + usize::from(frame.left)) * 4;
            let place = canvas[begin..begin + row].chunks_exact_mut(4);
            place
                .zip(pixels.chunks(4))
                .filter(|(_, new)| new[3] > 0)
                .for_each(|(old, new)| old.copy_from_slice(new));
        }
        delays.push(frame.delay);
        images.push(canvas.clone());
    }
    (delays, images, decoder.repeat())
}

/// Returns the delays (s) and the whole images of the frames of an animated PNG, in RGB.
fn read_apng(path: &Path) -> (Vec<(u16, u16)>, Vec<Vec<u8>>) {
    let file = std::io::BufReader::new(std::fs::File::open(path).unwrap());
    let mut reader = png::Decoder::new(file).read_info().unwrap();
    let control = *reader.info().animation_control().unwrap();
    assert_eq!(control.num_plays, 0);
    let mut canvas = vec![0; 48 * 36 * 3];
    let (mut delays, mut images) = (Vec::new(), Vec::new());
    for _ in 0..control.num_frames {
        let mut data = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut data).unwrap();
        let frame = *reader.info().frame_control().unwrap();
        let row = frame.width as usize * 3;
        for (y, pixels) in data.chunks(row).take(frame.height as usize).enumerate() {
            let begin = ((frame.y_offset as usize + y) * 48 + frame.x_offset as usize) * 3;
            canvas[begin..begin + row].copy_from_slice(pixels);
        }
        delays.push((frame.delay_num, frame.delay_den));
        images.push(canvas.clone());
    }
    (delays, images)
}

/// Returns the pixels of a PNG without their opacity.
fn read_png(path: &Path) -> Vec<u8> {
    let image = burgeon::scene::image::decode(&std::fs::read(path).unwrap()).unwrap();
    image.pixels().iter().flat_map(|pixel| pixel[..3].to_vec()).collect()
}

#[test]
fn a_film_has_all_frames_and_delays_in_every_format_and_the_same_bytes_for_any_number_of_threads() {
    let film = |threads: &str| {
        let folder = folder();
        let outputs = ["-o", "a.gif", "-o", "a.apng", "-o", "a.glb", "-o", "frames/%03d.png"];
        let flags = ["--frames", "0:2:0.5", "--fps", "30", "--threads", threads];
        let said = folder.burgeon(&arguments(&[&flags[..], &outputs].concat())).done();
        assert!(said.stderr.starts_with("5 frames, 0.17 s at 30 frames per second; "), "{}", said.stderr);
        folder
    };
    let (one, two) = (film("1"), film("2"));
    assert_eq!(one.files(), two.files());
    assert_eq!(one.files().len(), 9);
    for name in one.files().keys() {
        let read = |folder: &Folder| std::fs::read(folder.path().join(name)).unwrap();
        assert!(read(&one) == read(&two), "{name}");
    }
    let (delays, exact) = read_apng(&one.path().join("a.apng"));
    assert_eq!(delays, [(1, 30); 5]);
    for (number, image) in exact.iter().enumerate() {
        assert!(read_png(&one.path().join(format!("frames/00{number}.png"))) == *image, "frame {number}");
    }
    assert!(exact.windows(2).all(|pair| pair[0] != pair[1]));
    let (delays, images, repeat) = read_gif(&one.path().join("a.gif"));
    assert_eq!((delays.as_slice(), repeat), ([3, 4, 3, 3, 4].as_slice(), gif::Repeat::Infinite));
    for (image, exact) in images.iter().zip(&exact) {
        let colors = image.chunks(4).zip(exact.chunks(3));
        let farthest = colors.flat_map(|(a, b)| (0..3).map(|channel| a[channel].abs_diff(b[channel])));
        assert!(farthest.max().unwrap() < 40);
    }
    let bytes = std::fs::read(one.path().join("a.glb")).unwrap();
    let file = gltf::Gltf::from_slice(&bytes).unwrap();
    let channels: Vec<_> = file.animations().next().unwrap().channels().collect();
    assert_eq!(channels.len(), 5);
    for (number, channel) in channels.iter().enumerate() {
        let reader = channel.reader(|_| file.blob.as_deref());
        let Some(ReadOutputs::Scales(scales)) = reader.read_outputs() else { panic!("no scales") };
        let keys: Vec<(f32, [f32; 3])> = reader.read_inputs().unwrap().zip(scales).collect();
        let shown: Vec<f32> =
            keys.iter().filter(|(_, scale)| *scale == [1.0; 3]).map(|(time, _)| *time).collect();
        assert!((shown[0] - number as f32 / 30.0).abs() < 1e-6, "frame {number}: {keys:?}");
    }
    // The ground is the same in all frames and stored once; the plants are not.
    assert_eq!(file.meshes().count(), 6);
}

#[test]
fn a_pattern_writes_a_model_for_each_frame_that_equals_a_single_run() {
    let folder = folder();
    folder.burgeon(&arguments(&["--frames", "2:0:-1", "-o", "%d.glb"])).done();
    folder.burgeon(&["run", "s.lua", "--set", "time=0", "--no-recipe", "-o", "single.glb"]).done();
    assert_eq!(folder.read_bytes("2.glb"), folder.read_bytes("single.glb"));
    assert_eq!(folder.files().len(), 5);
}

#[test]
fn a_film_has_the_warnings_about_the_files_of_its_first_frame() {
    let folder = Folder::new().with("s.lua", SCRIPT.replace("sides = 4", "sides = 4, caps = false"));
    let flags = ["--frames", "0:2:1", "-o", "%d.stl"];
    let said = folder.burgeon(&arguments(&flags)).done();
    assert!(said.stderr.contains("0.stl: ") && said.stderr.contains(" open edges"), "{}", said.stderr);
    assert!(!said.stderr.contains("1.stl"), "{}", said.stderr);
    let refused = folder.burgeon(&arguments(&[&flags[..], &["--strict"]].concat())).failed();
    assert!(refused.contains("0.stl: "), "{refused}");
}

#[test]
fn a_turntable_returns_to_its_beginning() {
    let film = |threads: &str| {
        let folder = folder();
        let flags =
            ["--turntable", "8", "-o", "a.gif", "-o", "%d.png", "--fps", "12.5", "--threads", threads];
        let said = folder.burgeon(&arguments(&flags)).done();
        assert!(said.stderr.starts_with("8 frames, 0.64 s at 12.5 frames per second; "), "{}", said.stderr);
        folder
    };
    let (one, two) = (film("1"), film("2"));
    for name in ["a.gif", "0.png", "7.png"] {
        assert_eq!(one.read_bytes(name), two.read_bytes(name), "{name}");
    }
    assert_eq!(read_gif(&one.path().join("a.gif")).0, [8; 8]);
    assert!((1..8).all(|number| one.read_bytes(&format!("{number}.png")) != one.read_bytes("0.png")));
    let turned = folder();
    turned.burgeon(&arguments(&["--turntable", "4", "--azimuth", "240", "-o", "%d.png"])).done();
    assert_eq!(turned.read_bytes("0.png"), one.read_bytes("2.png"));
}

#[test]
fn json_is_one_document_about_the_film() {
    let folder = folder();
    let mut document =
        folder.burgeon(&arguments(&["--frames", "0:2", "-o", "a.apng", "--json"])).done().json();
    assert!(document["seconds"]["total"].as_f64().unwrap() > 0.0);
    document["seconds"]["total"] = 0.into();
    document["peak_memory_mb"] = 0.into();
    assert_snapshot!(document, @r#"{"ok":true,"frames":3,"fps":25.0,"param":"time","values":[0.0,2.0],"modules":23,"triangles":348,"warnings":[],"seconds":{"film":0.12,"total":0},"peak_memory_mb":0}"#);
    let document = folder.burgeon(&arguments(&["--turntable", "3", "-o", "t.gif", "--json"])).done().json();
    assert_eq!(
        (&document["frames"], &document["fps"], &document["ok"]),
        (&3.into(), &25.0.into(), &true.into())
    );
}

#[test]
fn a_film_over_the_steps_shows_the_derivation() {
    let folder = folder();
    folder.burgeon(&arguments(&["--frames", "steps=0:3", "-o", "%d.glb"])).done();
    folder.burgeon(&["run", "s.lua", "--steps", "2", "--no-recipe", "-o", "single.glb"]).done();
    assert_eq!(folder.read_bytes("2.glb"), folder.read_bytes("single.glb"));
}

#[test]
fn the_texts_of_frames_have_places_and_frames_and_are_in_their_order() {
    let folder = folder().with("s.lua", format!("{SCRIPT}print(\"at\", time)\n"));
    let prints = |flags: &[&str]| {
        let said = folder.burgeon(&[&arguments(&["--frames", "0:2"]), flags].concat()).done();
        let lines = said.stderr.lines().filter(|line| line.contains("at"));
        lines.filter(|line| line.starts_with("s.lua")).map(str::to_owned).collect::<Vec<_>>()
    };
    let expected: Vec<String> = (0..3).map(|n| format!("s.lua:17: frame {n}, time {n}: at\t{n}")).collect();
    assert_eq!(prints(&["--places", "-o", "%d.glb"]), expected);
    assert_eq!(prints(&["--places", "-o", "film.gif"]), expected);
    assert!(prints(&["-o", "film.gif"]).is_empty());
}

#[test]
fn a_film_that_cannot_be_made_is_refused_and_leaves_the_old_one() {
    assert_snapshot!(refused(&["--frames", "n=0:3", "-o", "film.gif"]), @r"
    error: s.lua: unknown parameter `n`
      help: it has time, kind
    ");
    assert_snapshot!(refused(&["--frames", "tim=0:3", "-o", "film.gif"]), @r"
    error: s.lua: unknown parameter `tim`
      help: did you mean time?
    ");
    assert_snapshot!(refused(&["--frames", "kind=0:3", "-o", "film.gif"]), @r"
    error: param kind is not a number, so frames cannot run over it
      help: name a number: --frames NAME=FIRST:LAST:STEP
    ");
    assert_snapshot!(refused(&["--frames", "0:10", "-o", "film.gif"]), @r"
    error: param time is 10, out of its range
      help: the allowed values are 0 to 9
    ");
    assert_snapshot!(refused(&["--frames", "steps=0:3:0.5", "-o", "film.gif"]), @r"
    error: 0.5 is not a number of steps
      help: use integers of at least 0, such as --frames steps=0:12
    ");
    assert_snapshot!(refused(&["--frames", "0:9:0.0001", "-o", "film.gif"]), @r"
    error: 90,001 frames exceed the maximum of 10,000
      help: use a larger step, FIRST:LAST:STEP, or raise the limit: --frame-limit N
    ");
    assert_snapshot!(refused(&["--frames", "0:9:0.1", "--frame-limit", "20", "-o", "film.gif"]), @r"
    error: 91 frames exceed the maximum of 20
      help: use a larger step, FIRST:LAST:STEP, or raise the limit: --frame-limit N
    ");
    assert_snapshot!(refused(&["--frames", "0:3", "--set", "time=3", "-o", "film.gif"]), @r"
    error: --set and --frames both use `time`; remove one
      help: remove --set time or --frames time
    ");
    // Frames before the one that fails are complete, and not published.
    assert_snapshot!(refused(&["--frames", "5:9", "-o", "film.gif", "-o", "%d.png"]), @r#"
    error: s.lua:7:3: rule A(x): seven is too many (frame 2, time 7)
      | if time == 7 then error("seven is too many") end
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      module: A(1), step 1
    "#);
    assert_snapshot!(refused(&["--frames", "0:3"]), @r"
    error: a film has no file
      help: write it to a .gif, .apng or .glb file, such as -o film.gif
    ");
    assert_snapshot!(refused(&["--frames", "0:3", "-o", "tree.png"]), @r"
    error: tree.png cannot hold the frames of a film
      help: write .gif, .apng and .glb files, or one file for each frame by a pattern such as tree-%04d.png
    ");
    assert_snapshot!(refused(&["--frames", "0:3", "-o", "tree.gpkg"]), @r"
    error: tree.gpkg cannot hold the frames of a film
      help: write .gif, .apng and .glb files, or one file for each frame by a pattern such as tree-%04d.png
    ");
    assert_snapshot!(refused(&["--frames", "0:3", "-o", "%d-%d.png"]), @r"
    error: %d-%d.png has several patterns for the number of the frame
      help: keep one of them, such as %04d
    ");
    assert_snapshot!(refused(&["--frames", "0:3", "-o", "film.gif", "-o", "film.gif"]), @r"
    error: film.gif would be written twice
      help: specify different files
    ");
    assert_snapshot!(refused(&["--frames", "0:3", "-o", "no/film.gif"]), @r"
    error: cannot write no/film.gif: folder not found: no
      help: create the folder first, or write to an existing folder
    ");
    assert_snapshot!(refused(&["--frames", "0:3", "--fps", "60", "-o", "film.gif"]), @r"
    error: a .gif file has at most 50 frames per second, not 60
      help: use --fps 50 or less
    ");
    assert_snapshot!(refused(&["--turntable", "8", "-o", "film.glb"]), @r"
    error: a turntable consists of renders, and a model file cannot hold them
      help: write a .gif or .apng file, or a pattern such as frames/%04d.png
    ");
    assert_snapshot!(refused(&["-o", "film.gif"]), @r"
    error: film.gif holds the frames of a film, and this is a single run
      help: add --frames FIRST:LAST:STEP or --turntable N
    ");
}

#[test]
fn the_time_limit_holds_for_each_run_of_a_film() {
    let script = "local time = param(\"time\", { default = 0 })\nwhile time > 2 do end\n\
                  local s = lsystem({ object = turtle({}) })\ns:axiom(F(1))\ns:derive(1)\n";
    let folder = Folder::new().with("s.lua", script).with("film.gif", "old");
    let text = folder.refuses(&arguments(&["--frames", "0:9", "--time-limit", "0.5", "-o", "film.gif"]));
    assert!(text.contains("(frame 3, time 3)") && text.contains("time limit"), "{text}");
}

#[test]
fn ranges_that_are_none_are_a_wrong_command_line() {
    assert_snapshot!(wrong(&["--frames", "0:3:0", "-o", "film.gif"]), @r"
    error: invalid value '0:3:0' for '--frames <[NAME=]FIRST:LAST:STEP>': the step 0 cannot reach 3 from 0
      help: write 0:3:1

    For more information, try '--help'.
    ");
    assert_snapshot!(wrong(&["--frames", "0:3:-1", "-o", "film.gif"]), @r"
    error: invalid value '0:3:-1' for '--frames <[NAME=]FIRST:LAST:STEP>': the step -1 cannot reach 3 from 0
      help: write 0:3:1

    For more information, try '--help'.
    ");
    assert_snapshot!(wrong(&["--frames", "0:nan:1", "-o", "film.gif"]), @r#"
    error: invalid value '0:nan:1' for '--frames <[NAME=]FIRST:LAST:STEP>': "nan" is not a number for the last value
      help: write FIRST:LAST:STEP, such as 0:10:0.1, or NAME=FIRST:LAST:STEP

    For more information, try '--help'.
    "#);
    assert_snapshot!(wrong(&["--frames", "3", "-o", "film.gif"]), @r#"
    error: invalid value '3' for '--frames <[NAME=]FIRST:LAST:STEP>': "3" is not a range
      help: write FIRST:LAST:STEP, such as 0:10:0.1, or NAME=FIRST:LAST:STEP

    For more information, try '--help'.
    "#);
    assert_snapshot!(wrong(&["--turntable", "1", "-o", "film.gif"]), @r"
    error: invalid value '1' for '--turntable <N>': write an integer of at least 2

    For more information, try '--help'.
    ");
    assert_snapshot!(wrong(&["--turntable", "8", "--frames", "0:3", "-o", "film.gif"]), @r"
    error: the argument '--turntable <N>' cannot be used with '--frames <[NAME=]FIRST:LAST:STEP>'

    Usage: burgeon run --size <WIDTHxHEIGHT> --turntable <N> --output <FILE> <SCRIPT>

    For more information, try '--help'.
    ");
    assert_snapshot!(wrong(&["--frames", "0:3", "--fps", "0", "-o", "film.gif"]), @r"
    error: invalid value '0' for '--fps <N>': write a number of frames per second from 0.1 to 1000

    For more information, try '--help'.
    ");
    assert_snapshot!(wrong(&["--fps", "10", "-o", "film.gif"]), @r"
    error: the following required arguments were not provided:
      <--frames <[NAME=]FIRST:LAST:STEP>|--turntable <N>>

    Usage: burgeon run --size <WIDTHxHEIGHT> --fps <N> --output <FILE> <--frames <[NAME=]FIRST:LAST:STEP>|--turntable <N>> <SCRIPT>

    For more information, try '--help'.
    ");
    assert_snapshot!(wrong(&["--frames", "0:3", "--chain", "-", "-o", "film.gif"]), @r"
    error: the argument '--frames <[NAME=]FIRST:LAST:STEP>' cannot be used with '--chain <FILE>'

    Usage: burgeon run --size <WIDTHxHEIGHT> --frames <[NAME=]FIRST:LAST:STEP> --output <FILE> <SCRIPT>

    For more information, try '--help'.
    ");
}
