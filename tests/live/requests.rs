//! Access checks and answers of the server.

use std::io::{Read, Write};
use std::net::TcpStream;
use std::process::Command;
use std::time::Duration;

use serde_json::json;
use tungstenite::Message;

use crate::support::{PATIENCE, Server, script, triangles};

#[test]
fn the_page_and_its_parts_are_served_with_headers_that_lock_it_in() {
    let server = Server::new(Some(&script(3)));
    for (path, kind) in [("", "text/html"), ("viewer.js", "text/javascript"), ("viewer.css", "text/css")] {
        let answer = server.get(path);
        assert_eq!(answer.status, 200, "{path}");
        for header in [
            &format!("content-type: {kind}"),
            "content-security-policy: default-src 'none'",
            "cache-control: no-store",
            "x-content-type-options: nosniff",
            "referrer-policy: no-referrer",
        ] {
            assert!(answer.head.contains(header), "{header}: {}", answer.head);
        }
    }
    let bare = format!("GET /{} HTTP/1.1\r\nHost: localhost:1\r\n", server.token);
    let answer = server.request(&bare);
    assert_eq!(answer.status, 308);
    assert!(answer.head.contains(&format!("location: /{}/", server.token)), "{}", answer.head);
}

#[test]
fn requests_without_the_token_or_from_elsewhere_are_refused() {
    let server = Server::new(Some(&script(3)));
    let (token, port) = (&server.token, server.port);
    let host = format!("Host: 127.0.0.1:{port}\r\n");
    let other = format!("{}{}", if token.starts_with('0') { '1' } else { '0' }, &token[1..]);
    let unproven = [
        format!("GET / HTTP/1.1\r\n{host}"),
        format!("GET /favicon.ico HTTP/1.1\r\n{host}"),
        format!("GET /{other}/ HTTP/1.1\r\n{host}"),
        format!("GET /{}/ HTTP/1.1\r\n{host}", &token[1..]),
        format!("GET //{token}/ HTTP/1.1\r\n{host}"),
        format!("GET /{token}/ HTTP/1.1\r\nHost: example.org\r\n"),
        format!("GET /{token}/ HTTP/1.1\r\nHost: example.org:{port}\r\n"),
        format!("GET /{token}/ HTTP/1.1\r\nHost: 127.0.0.1.example.org\r\n"),
        format!("GET /{token}/ HTTP/1.1\r\n"),
        format!("GET /{token}/ HTTP/1.0\r\n"),
        format!("GET /{token}/ HTTP/1.1\r\n{host}Host: example.org\r\n"),
        format!("GET http://example.org/{token}/ HTTP/1.1\r\nHost: example.org\r\n"),
        format!("GET /{token}/ HTTP/1.1\r\n{host}Origin: http://example.org\r\n"),
        format!("GET /{token}/ HTTP/1.1\r\n{host}Origin: null\r\n"),
        format!("GET /{token}/ HTTP/1.1\r\n{host}Origin: https://127.0.0.1:{port}\r\n"),
        format!(
            "GET /{token}/socket HTTP/1.1\r\n{host}Origin: http://evil.example\r\nUpgrade: websocket\r\n\
                 Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n"
        ),
    ];
    for head in &unproven {
        assert_eq!(server.request(head).status, 403, "{head}");
    }
    let friends = [
        format!("GET /{token}/ HTTP/1.1\r\n{host}Origin: http://127.0.0.1:{port}\r\n"),
        format!("GET /{token}/ HTTP/1.1\r\nHost: localhost:9999\r\nOrigin: http://localhost:9999\r\n"),
        format!("GET /{token}/ HTTP/1.1\r\nHost: [::1]:80\r\n"),
    ];
    for head in &friends {
        assert_eq!(server.request(head).status, 200, "{head}");
    }
    for method in ["POST", "PUT", "DELETE", "OPTIONS", "HEAD"] {
        assert_eq!(server.request(&format!("{method} /{token}/ HTTP/1.1\r\n{host}")).status, 405, "{method}");
    }
}

#[test]
fn nothing_is_served_but_what_is_listed() {
    let server = Server::new(Some(&script(3)));
    server.page().until("model");
    let paths = [
        "s.lua",
        "../s.lua",
        "../../../../etc/passwd",
        "%2e%2e/s.lua",
        "..%2fs.lua",
        "%2e%2e%2fs.lua",
        "/etc/passwd",
        "//etc/passwd",
        "./",
        "index.html",
        "viewer.js/",
        "model/",
        "model/x.glb",
        "model/../viewer.js",
        "model",
        "model/%2e%2e%2f%2e%2e%2fs.lua",
        "export/",
        "export/s.lua",
        "export/../s.lua",
        "export/..%2f..%2fx.glb",
        "export/a/b.glb",
        "export/%00.glb",
        "export/%ff.glb",
        "export/glb",
        "picture/x.png",
        "socket/",
        "%",
        "..",
    ];
    for path in paths {
        assert_eq!(server.get(path).status, 404, "{path}");
    }
    assert_eq!(server.get("socket").status, 400);
    assert_eq!(server.get("export/a.png?depth=1").status, 400);
}

#[test]
fn the_model_is_a_glb_that_never_changes_under_its_name() {
    let server = Server::new(Some(&script(3)));
    let mut page = server.page();
    let model = page.next("model");
    let url = model["url"].as_str().unwrap().to_owned();
    let answer = server.get(&url);
    assert_eq!(answer.status, 200);
    assert!(
        answer.head.contains("immutable") && answer.head.contains("model/gltf-binary"),
        "{}",
        answer.head
    );
    assert_eq!(answer.body.len() as u64, model["bytes"].as_u64().unwrap());
    // The normals are integers, which the reader does not support.
    let document = gltf::Gltf::from_slice_without_validation(&answer.body).unwrap();
    assert!(document.meshes().len() > 0);
    assert_eq!(
        (&model["triangles"], &model["cause"], &model["seed"]),
        (&json!(triangles(3)), &json!("start"), &json!("0"))
    );
    assert_eq!(model["bounds"]["high"].as_array().unwrap().len(), 3);
    assert_eq!(model["files"], json!(["s.lua"]));
    let urls: Vec<String> = (2..6)
        .map(|length| {
            let message = json!({ "type": "set", "params": { "length": length.to_string() } });
            page.model_of(message)["url"].as_str().unwrap().to_owned()
        })
        .collect();
    assert_eq!(server.get(&urls[3]).status, 200);
    assert_eq!(server.get(&url).status, 404);
    let back = page.model_of(json!({ "type": "reset" }));
    assert_eq!(back["url"], url);
    assert!(server.get(&url).body == answer.body);
}

#[test]
fn texture_coordinates_of_the_present_model_come_when_asked_for() {
    let server = Server::new(Some(&script(3)));
    let mut page = server.page();
    let url = page.next("model")["url"].as_str().unwrap().replace(".glb", ".uv.glb");
    let primitives = |path: &str| -> Vec<(bool, usize)> {
        let answer = server.get(path);
        let document = gltf::Gltf::from_slice_without_validation(&answer.body).unwrap();
        let primitives: Vec<_> = document.meshes().flat_map(|mesh| mesh.primitives()).collect();
        let count = |it: &gltf::Primitive<'_>| it.indices().unwrap().count();
        let coordinates = gltf::Semantic::TexCoords(0);
        primitives.iter().map(|it| (it.get(&coordinates).is_some(), count(it))).collect()
    };
    let (whole, plain) = (primitives(&url), primitives(&url.replace(".uv.glb", ".glb")));
    assert!(!whole.is_empty() && whole.iter().all(|(measured, _)| *measured));
    assert_eq!(plain, whole.iter().map(|(_, count)| (false, *count)).collect::<Vec<_>>());
    assert_eq!(server.get("model/0.uv.glb").status, 404);
    page.model_of(json!({ "type": "set", "params": { "length": "4" } }));
    assert_eq!(server.get(&url).status, 404);
}

#[test]
fn exports_come_in_every_format_and_several_files_as_one_archive() {
    let server = Server::new(Some(&script(3)));
    server.page().until("model");
    let begins = |path: &str, bytes: &[u8], file: &str| {
        let answer = server.get(path);
        assert_eq!(answer.status, 200, "{path}");
        assert!(answer.body.starts_with(bytes), "{path}");
        assert!(answer.head.contains(&format!("filename=\"{file}\"")), "{}", answer.head);
        answer.body
    };
    begins("export/a.glb", b"glTF", "a.glb");
    begins("export/my%20tower.svg", b"<", "my_tower.svg");
    let png = begins("export/a.png?azimuth=10&elevation=20&width=30&height=20", b"\x89PNG", "a.png");
    assert_eq!(image::load_from_memory(&png).unwrap().to_rgba8().dimensions(), (30, 20));
    let names = |bytes: Vec<u8>| {
        let mut archive = zip::ZipArchive::new(std::io::Cursor::new(bytes)).unwrap();
        (0..archive.len()).map(|i| archive.by_index(i).unwrap().name().to_owned()).collect::<Vec<_>>()
    };
    assert_eq!(names(begins("export/a.gltf", b"PK", "a.gltf.zip")), ["a.bin", "a.gltf"]);
    assert_eq!(names(begins("export/a.obj", b"PK", "a.obj.zip")), ["a.mtl", "a.obj"]);
    let waiting = Server::new(None);
    assert_eq!(waiting.get("export/a.glb").status, 409);
}

#[test]
fn messages_that_mean_nothing_are_refused_and_the_server_goes_on() {
    let server = Server::new(Some(&script(3)));
    let mut page = server.page();
    page.next("model");
    let wrong = [
        "",
        "nonsense",
        "[]",
        "7",
        "{\"type\":\"fly\"}",
        "{\"type\":\"set\",\"params\":{\"length\":{}}}",
        "{\"type\":\"set\",\"params\":{\"lenght\":\"2\"}}",
        "{\"type\":\"set\",\"params\":{\"length\":\"90\"}}",
        "{\"type\":\"seed\",\"seed\":\"-1\"}",
        "{\"type\":\"steps\",\"steps\":1.5}",
        "{\"type\":\"cancel\"}",
        "{\"type\":\"open\",\"file\":\"/etc/passwd\",\"line\":1}",
        "{\"type\":\"pick\",\"id\":3}",
        "{\"type\":\"highlight\",\"id\":4,\"file\":\"../x\",\"line\":99999999}",
    ];
    for text in wrong {
        page.send(Message::text(text));
        let answer = page.any();
        assert_eq!(answer["type"], "refused", "{text}: {answer}");
    }
    page.send(Message::binary(vec![0; 9]));
    assert_eq!(page.any()["type"], "refused");
    page.send(Message::text("[".repeat(60_000)));
    assert_eq!(page.any()["type"], "refused");
    page.send(Message::text("x".repeat(100_000)));
    let mut other = server.page();
    other.next("model");
    other.is_quiet(Duration::from_millis(50));
}

#[test]
fn garbage_and_silent_connections_do_not_keep_others_waiting() {
    let server = Server::new(Some(&script(3)));
    let mut silent: Vec<TcpStream> =
        (0..40).map(|_| TcpStream::connect(("127.0.0.1", server.port)).unwrap()).collect();
    for (i, stream) in silent.iter_mut().enumerate() {
        stream.write_all(&vec![if i % 2 == 0 { b'\0' } else { b'G' }; i * 100]).unwrap();
    }
    let mut page = server.page();
    page.next("model");
    assert_eq!(server.get("").status, 200);
    // A socket that is opened and never read.
    let mut lazy = TcpStream::connect(("127.0.0.1", server.port)).unwrap();
    write!(
        lazy,
        "GET /{}/socket HTTP/1.1\r\nHost: localhost\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n\
         Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n",
        server.token
    )
    .unwrap();
    for length in (2..6).chain(1..6) {
        page.model_of(json!({ "type": "set", "params": { "length": length } }));
    }
    let mut head = [0; 12];
    lazy.read_exact(&mut head).unwrap();
    assert_eq!(&head, b"HTTP/1.1 101");
}

#[test]
fn a_port_that_is_in_use_is_told_with_one_that_is_free() {
    let server = Server::new(Some(&script(3)));
    let said = Command::new(env!("CARGO_BIN_EXE_burgeon"))
        .args(["live", "s.lua", "--port", &server.port.to_string()])
        .output()
        .unwrap();
    let text = String::from_utf8(said.stderr).unwrap();
    assert_eq!(said.status.code(), Some(1), "{text}");
    assert!(text.contains(&format!("port {} is in use", server.port)) && text.contains("--port "), "{text}");
    assert!(said.stdout.is_empty());
}

#[test]
fn two_servers_find_ports_of_their_own_and_print_the_address_first() {
    use std::io::{BufRead, BufReader};
    let folder = tempfile::tempdir().unwrap();
    let mut servers: Vec<_> = (0..2)
        .map(|_| {
            Command::new(env!("CARGO_BIN_EXE_burgeon"))
                .args(["live", "none.lua", "--no-open"])
                .current_dir(folder.path())
                .env("XDG_RUNTIME_DIR", folder.path())
                .stdout(std::process::Stdio::piped())
                .stderr(std::process::Stdio::null())
                .spawn()
                .unwrap()
        })
        .collect();
    let addresses: Vec<String> = servers
        .iter_mut()
        .map(|server| {
            let mut line = String::new();
            BufReader::new(server.stdout.take().unwrap()).read_line(&mut line).unwrap();
            line
        })
        .collect();
    for server in &mut servers {
        server.kill().unwrap();
        server.wait().unwrap();
    }
    assert!(
        addresses.iter().all(|it| it.starts_with("http://127.0.0.1:") && it.ends_with("/\n")),
        "{addresses:?}"
    );
    let port = |address: &str| address.split([':', '/']).nth(4).unwrap().parse::<u16>().unwrap();
    assert_ne!(port(&addresses[0]), port(&addresses[1]));
}

#[cfg(unix)]
#[test]
fn an_interrupt_ends_it_at_once_and_a_page_finds_the_next_server_under_the_same_address() {
    let token = "0123456789abcdef".repeat(2);
    let server = Server::with(Some(&script(3)), &["--token", &token]);
    assert_eq!(server.token, token);
    let port = server.port.to_string();
    let folder = server.end();
    let server = Server::start(folder, &["--token", &token, "--port", &port]);
    let mut page = server.page();
    page.next("model");
    server.write("s.lua", crate::support::SLOW);
    page.next("working");
    let (time, status) = server.interrupt();
    assert!(time < PATIENCE / 10, "{time:?}");
    assert_eq!(status, Some(0));
}

#[test]
fn a_model_brings_its_warnings_and_a_strict_server_an_error() {
    let twice = "local s = lsystem({ object = turtle() })\ns:axiom(F(1))\ns:derive(0)\ns:derive(0)\n";
    let server = Server::new(Some(twice));
    let mut page = server.page();
    let warnings = page.next("model")["warnings"].clone();
    let (kind, file, line) = (&warnings[0]["kind"], &warnings[0]["file"], &warnings[0]["line"]);
    assert_eq!((kind, file, line), (&"derived-twice".into(), &"s.lua".into(), &4.into()), "{warnings}");
    server.write("s.lua", script(3));
    assert_eq!(page.next("model")["warnings"].as_array().map(Vec::len), Some(0));
    let strict = Server::with(Some(twice), &["--strict"]);
    assert_eq!(strict.page().next("error")["errors"][0]["line"], 4);
}

#[test]
fn what_became_of_features_comes_with_the_model_and_names_the_script() {
    let crossed = r#"local A = module("A")
local s = lsystem({ object = footprint })
s:axiom(source({
  { id = "hourglass", rings = { { 0, 0 }, { 8, 8 }, { 8, 0 }, { 0, 8 } } },
  { id = "sound", rings = { { 0, 0 }, { 4, 0 }, { 8, 0 }, { 0, 8 } } },
}), function(f)
  return footprint(f.rings, { height = 3 }), A()
end)
s:interpret("A", function(this) this:walls():roof({ kind = "flat" }) end)
s:derive()
"#;
    let server = Server::new(Some(crossed));
    let mut page = server.page();
    let told = json!([{
        "message": "1 of 2 features simplified",
        "help": "burgeon run s.lua --report FILE lists them",
    }]);
    assert_eq!(page.next("model")["notes"], told);
    page.is_quiet(Duration::from_millis(50));
    assert_eq!(page.model_of(json!({ "type": "seed", "seed": "2" }))["notes"], told);
    page.is_quiet(Duration::from_millis(50));
    server.write("s.lua", script(3));
    assert_eq!(page.next("model")["notes"], json!([]));
}
