#!/usr/bin/env bash
# Builds the wheel for Python and the archive for people without it, installs each into an empty folder without a compiler, and
# runs the tower with both: tests/wheel.sh FOLDER [PROGRAM]. PROGRAM is a built command for the archive; without it, one is built.
# The wheel and the archive are in FOLDER/dist. Only Linux is tried; for macOS and Windows the commands are the same, untried.
set -euo pipefail
cd "$(dirname "$0")/.."

mkdir -p "$1"
folder=$(realpath "$1") root=$PWD
dist=$folder/dist
rm -rf "$dist" "$folder"/{tools,cargo,wheel,archive,empty}
mkdir -p "$dist" "$folder/empty" "$folder/archive"

if ! python3 -m venv "$folder/tools" >/dev/null 2>&1; then
  echo "skipped: Python has no module venv"
  exit 0
fi
if ! "$folder/tools/bin/pip" install --quiet --disable-pip-version-check 'maturin>=1.8,<2'; then
  echo "skipped: maturin cannot be installed"
  exit 0
fi

# Features of dependencies depend on the packages of a build. With those of the tests, everything that the tests have built is used
# again, and the program is built with the module. Other systems link modules with flags of maturin's own.
mkdir -p "$folder/cargo"
if [ "$(uname -s)" = Linux ]; then
  cargo=$(command -v cargo)
  cat >"$folder/cargo/cargo" <<END
#!/usr/bin/env bash
if [ "\${1:-}" = rustc ]; then
  exec "$cargo" build --release --locked --message-format json-render-diagnostics --manifest-path "$root/Cargo.toml" \
    --workspace --exclude burgeon-typecheck --lib --bin burgeon --test house
fi
exec "$cargo" "\$@"
END
  chmod +x "$folder/cargo/cargo"
  export CARGO="$folder/cargo/cargo"
else
  echo "note: wheels have been tried on Linux only"
fi

# A compiler that fails shows that nothing is built.
for tool in cc c++ gcc g++ clang cargo rustc; do
  printf '#!/bin/sh\necho "%s must not run" >&2\nexit 1\n' "$tool" >"$folder/empty/$tool"
  chmod +x "$folder/empty/$tool"
done

echo "-- wheel"
(cd crates/python && env PATH="$folder/cargo:$PATH" "$folder/tools/bin/maturin" build --release --locked --out "$dist")
wheel=("$dist"/burgeon-*-cp310-abi3-*.whl)
[ "${#wheel[@]}" -eq 1 ]
python3 -m venv "$folder/wheel"

# A wheel of another platform is refused before anything is installed.
foreign=$folder/empty/$(basename "${wheel[0]}" | sed 's/abi3-.*/abi3-win_amd64.whl/')
cp "${wheel[0]}" "$foreign"
if refused=$("$folder/wheel/bin/pip" install --disable-pip-version-check --no-index "$foreign" 2>&1); then
  echo "pip installed $foreign"
  exit 1
fi
grep -q 'not a supported wheel on this platform' <<<"$refused"

# From the installation to the first picture, in less than 10 s. The time of the processor counts, because other programs can
# occupy the machine.
first_picture() {
  env PATH="$folder/empty:$folder/wheel/bin:/usr/bin:/bin" "$folder/wheel/bin/pip" install --quiet \
    --disable-pip-version-check --no-index "${wheel[0]}"
  (cd "$folder/empty" && env PATH="$folder/empty:$folder/wheel/bin:/usr/bin:/bin" \
    burgeon run "$root/scripts/tower.lua" -o tower.glb -o tower.png)
}
TIMEFORMAT='%U %S %R'
{ time first_picture 2>"$folder/first_picture.txt"; } 2>"$folder/seconds.txt" || {
  cat "$folder/first_picture.txt"
  exit 1
}
read -r user system real <"$folder/seconds.txt"
echo "from the wheel to the first picture: $user s of the processor, $system s of the system, $real s in all"
awk -v spent="$user" -v more="$system" 'BEGIN { exit !(spent + more < 10) }'
cp "$folder/empty/tower.glb" "$folder/wheel.glb"

# The module does not bring an allocator for the process.
if command -v nm >/dev/null; then
  library=$(echo "$folder"/wheel/lib/python3*/site-packages/burgeon/_burgeon.abi3.so)
  if nm -D --defined-only "$library" | grep -wE 'malloc|calloc|realloc|free|mi_malloc'; then
    echo "$library replaces the allocator of Python"
    exit 1
  fi
fi

echo "-- archive"
program=${2:-}
if [ -z "$program" ]; then
  unset CARGO
  [ "$(uname -s)" = Linux ] || cargo build --release --locked
  program=$(cargo metadata --format-version 1 --no-deps | python3 -c \
    'import json, sys; print(json.load(sys.stdin)["target_directory"] + "/release/burgeon")')
fi
name=burgeon-$("$program" --version | cut -d' ' -f2)-$(uname -m)-$(uname -s | tr '[:upper:]' '[:lower:]')
mkdir -p "$folder/archive/$name"
cp "$program" "$folder/archive/$name/burgeon"
# The profile strips the program already.
! command -v strip >/dev/null || strip "$folder/archive/$name/burgeon"
cp -r LICENSE-APACHE LICENSE-MIT README.md CHANGELOG.md scripts "$folder/archive/$name/"
tar -C "$folder/archive" -czf "$dist/$name.tar.gz" "$name"
rm -rf "$folder/archive" "$folder/empty"/tower.*
mkdir "$folder/archive"
tar -C "$folder/archive" -xzf "$dist/$name.tar.gz"
(cd "$folder/empty" && env PATH="$folder/empty:/usr/bin:/bin" "$folder/archive/$name/burgeon" run \
  "$folder/archive/$name/scripts/tower.lua" -o tower.glb -o tower.png)
cmp "$folder/empty/tower.glb" "$folder/wheel.glb"

echo "-- tests"
packages=(pytest numpy pandas trimesh mypy)
if "$folder/wheel/bin/pip" install --quiet --disable-pip-version-check "${packages[@]}"; then
  (cd crates/python && "$folder/wheel/bin/python" -B -m pytest -p no:cacheprovider)
  # Types of the package, and those of the stub against the compiled module.
  (cd crates/python && "$folder/wheel/bin/mypy" --cache-dir "$folder/mypy" python/burgeon)
  (cd "$folder" && wheel/bin/stubtest burgeon._burgeon)
else
  echo "skipped: ${packages[*]} cannot be installed"
fi
ls -l "$dist"
