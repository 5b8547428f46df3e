//! Server of the real binary in a temporary folder, and pages that communicate with it.

use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use serde_json::{Value, json};
use tungstenite::{Message, WebSocket};

/// Time limit of all actions; most take a hundredth of it.
pub(crate) const PATIENCE: Duration = Duration::from_secs(30);

/// Returns a script of `count` segments, with a parameter and a random turn.
pub(crate) fn script(count: usize) -> String {
    format!(
        r#"local length = param("length", {{ default = 1, min = 1, max = 9, step = 1 }})
local A, S = module("A", "n"), module("S")
local s = lsystem({{ object = turtle() }})
s:axiom(A({count}))
s:rule("A(n)", function(this, n) if n > 0 then return S(), Turn(random(0, 9)), A(n - 1) end return nil end)
s:interpret("S", function(this) this:forward(length) end)
s:derive()
"#
    )
}

/// Returns the number of triangles of that script's model.
pub(crate) fn triangles(count: usize) -> usize {
    16 * count + 12
}

/// Script whose run takes a long time.
pub(crate) const SLOW: &str = r#"local A = module("A", "n")
local s = lsystem({})
s:axiom(A(0))
s:rule("A(n)", function(this, n) return A(n + 1) end)
s:derive()
"#;

/// Temporary folder with a server in it; both end with the test.
pub(crate) struct Server {
    child: Child,
    pub port: u16,
    pub token: String,
    folder: tempfile::TempDir,
}

impl Server {
    /// Serves `s.lua`, which contains `script` if there is one, on a free port.
    pub(crate) fn new(script: Option<&str>) -> Self {
        Self::with(script, &[])
    }

    pub(crate) fn with(script: Option<&str>, flags: &[&str]) -> Self {
        let folder = tempfile::tempdir().unwrap();
        if let Some(script) = script {
            std::fs::write(folder.path().join("s.lua"), script).unwrap();
        }
        Self::start(folder, flags)
    }

    pub(crate) fn start(folder: tempfile::TempDir, flags: &[&str]) -> Self {
        Self::by(Command::new(env!("CARGO_BIN_EXE_burgeon")), folder, "s.lua", flags)
    }

    /// Serves the tileset in `name`, a folder of `folder`.
    pub(crate) fn of_tileset(folder: tempfile::TempDir, name: &str) -> Self {
        Self::by(Command::new(env!("CARGO_BIN_EXE_burgeon")), folder, name, &[])
    }

    /// Starts a server with a limit on the number of open files.
    #[cfg(target_os = "linux")]
    pub(crate) fn with_few_files(script: &str, files: usize) -> Self {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("s.lua"), script).unwrap();
        let mut command = Command::new("sh");
        let limited = format!("ulimit -n {files} && exec \"$0\" \"$@\"");
        command.args(["-c", &limited, env!("CARGO_BIN_EXE_burgeon")]);
        Self::by(command, folder, "s.lua", &[])
    }

    fn by(mut command: Command, folder: tempfile::TempDir, subject: &str, flags: &[&str]) -> Self {
        let mut child = command
            .args(["live", subject, "--json", "--no-open"])
            .args(flags)
            .args(if flags.contains(&"--port") { &[][..] } else { &["--port", "0"] })
            .current_dir(folder.path())
            .env("XDG_RUNTIME_DIR", folder.path())
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let mut line = String::new();
        BufReader::new(child.stdout.take().unwrap()).read_line(&mut line).unwrap();
        let said: Value = serde_json::from_str(&line).unwrap_or_else(|error| panic!("{error}: {line:?}"));
        let port = u16::try_from(said["port"].as_u64().unwrap()).unwrap();
        let token = said["token"].as_str().unwrap().to_owned();
        assert_eq!(said["address"], format!("http://127.0.0.1:{port}/{token}/"));
        Self { child, port, token, folder }
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    pub(crate) fn write(&self, name: &str, text: impl AsRef<[u8]>) {
        std::fs::write(self.path(name), text).unwrap();
    }

    /// Requests `path` below the token, as a browser does.
    pub(crate) fn get(&self, path: &str) -> Answer {
        self.request(&format!("GET /{}/{path} HTTP/1.1\r\nHost: 127.0.0.1:{}\r\n", self.token, self.port))
    }

    /// Sends the head of a request unchanged, and adds the final empty line.
    pub(crate) fn request(&self, head: &str) -> Answer {
        let mut stream = TcpStream::connect(("127.0.0.1", self.port)).unwrap();
        stream.set_read_timeout(Some(PATIENCE)).unwrap();
        write!(stream, "{head}Connection: close\r\n\r\n").unwrap();
        let mut bytes = Vec::new();
        stream.read_to_end(&mut bytes).unwrap();
        let end = bytes.windows(4).position(|window| window == b"\r\n\r\n").unwrap_or(bytes.len());
        let head = String::from_utf8(bytes[..end].to_vec()).unwrap();
        Answer {
            status: head[9..12].parse().unwrap(),
            head,
            body: bytes.get(end + 4..).unwrap_or(&[]).to_vec(),
        }
    }

    /// Opens a page, and receives its greeting.
    pub(crate) fn page(&self) -> Page {
        self.greeted().0
    }

    /// Returns the greeting of a new page.
    pub(crate) fn hello(&self) -> Value {
        self.greeted().1
    }

    fn greeted(&self) -> (Page, Value) {
        let mut page = self.connect();
        let hello = page.next("hello");
        assert_eq!(hello["script"], "s.lua");
        (page, hello)
    }

    /// Opens a page, which has not received its greeting yet.
    pub(crate) fn connect(&self) -> Page {
        let stream = TcpStream::connect(("127.0.0.1", self.port)).unwrap();
        stream.set_read_timeout(Some(PATIENCE)).unwrap();
        stream.set_nodelay(true).unwrap();
        let address = format!("ws://127.0.0.1:{}/{}/socket", self.port, self.token);
        let (socket, _) = tungstenite::client(&address[..], stream).unwrap();
        socket.get_ref().set_read_timeout(Some(Duration::from_millis(50))).unwrap();
        Page { socket, last: String::new() }
    }

    /// Returns the number of open files of the server.
    #[cfg(target_os = "linux")]
    pub(crate) fn open_files(&self) -> usize {
        std::fs::read_dir(format!("/proc/{}/fd", self.child.id())).unwrap().count()
    }

    /// Interrupts the server as a user does. Returns its shutdown time and its exit status.
    #[cfg(unix)]
    pub(crate) fn interrupt(mut self) -> (Duration, Option<i32>) {
        let begin = Instant::now();
        Command::new("kill").args(["-INT", &self.child.id().to_string()]).status().unwrap();
        let status = self.child.wait().unwrap();
        (begin.elapsed(), status.code())
    }

    /// Ends the server and returns its folder.
    pub(crate) fn end(mut self) -> tempfile::TempDir {
        self.child.kill().unwrap();
        self.child.wait().unwrap();
        std::mem::replace(&mut self.folder, tempfile::tempdir().unwrap())
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// Answer to a request.
pub(crate) struct Answer {
    pub status: u16,
    pub head: String,
    pub body: Vec<u8>,
}

/// Page side of the socket.
pub(crate) struct Page {
    socket: WebSocket<TcpStream>,
    /// Last message, for error messages.
    last: String,
}

impl Page {
    pub(crate) fn say(&mut self, message: &Value) {
        self.send(Message::text(message.to_string()));
    }

    pub(crate) fn send(&mut self, message: Message) {
        self.socket.send(message).unwrap();
    }

    /// Returns the next message of any type.
    #[track_caller]
    pub(crate) fn any(&mut self) -> Value {
        match self.within(PATIENCE) {
            Some(message) => message,
            None => panic!("the server says nothing after {}", self.last),
        }
    }

    /// Returns the next message within `time`, if there is one.
    pub(crate) fn within(&mut self, time: Duration) -> Option<Value> {
        let begin = Instant::now();
        while begin.elapsed() < time {
            match self.socket.read() {
                Ok(Message::Text(text)) => {
                    self.last = text.to_string();
                    return Some(serde_json::from_str(&text).unwrap());
                }
                Ok(_) => {}
                Err(tungstenite::Error::Io(error)) if error.kind() == std::io::ErrorKind::WouldBlock => {}
                Err(error) => panic!("{error}"),
            }
        }
        None
    }

    /// Returns the next message, which must have this type; progress messages are skipped.
    #[track_caller]
    pub(crate) fn next(&mut self, kind: &str) -> Value {
        loop {
            let message = self.any();
            if message["type"] == kind {
                return message;
            }
            let news = ["working", "progress", "variations"].iter().any(|news| message["type"] == **news);
            let news = news || (message["type"] == "cancelled" && message["stale"] == false);
            assert!(news, "{kind}: {message}");
        }
    }

    /// Returns the next message of this type, and skips all others.
    #[track_caller]
    pub(crate) fn until(&mut self, kind: &str) -> Value {
        loop {
            let message = self.any();
            if message["type"] == kind {
                return message;
            }
        }
    }

    /// Sends a message, and returns the resulting model.
    #[track_caller]
    pub(crate) fn model_of(&mut self, message: Value) -> Value {
        self.say(&message);
        self.next("model")
    }

    /// Asserts that the server sends nothing within `time` and then still answers a request.
    #[track_caller]
    pub(crate) fn is_quiet(&mut self, time: Duration) {
        assert_eq!(self.within(time), None);
        self.say(&json!({ "type": "fly" }));
        assert_eq!(self.any()["type"], "refused");
    }
}
