#!/usr/bin/env bash
# Makes the tiles of a village with each launcher of examples/tiles on two workers, and compares their bytes with those of one
# process: tests/launchers.sh PROGRAM FOLDER. Installs the tools into FOLDER, and skips one, with the reason, only if it cannot be
# installed.
set -euo pipefail
cd "$(dirname "$0")/.."

program=$(realpath "$1") folder=$(realpath "$2")/launchers
launchers=$PWD/examples/tiles script=$PWD/examples/tiles/houses.lua data=$PWD/examples/data
options=(--target-features 10 --geoid-height 50 --reach 2 --levels 2)
passed=0 failed=0 skipped=0

rm -rf "$folder"
mkdir -p "$folder/bin"
ln -s "$program" "$folder/bin/burgeon"
export PATH="$folder/bin:$PATH"

# One process, without a launcher.
burgeon tiles plan "$script" --data "$data" -o "$folder/one" "${options[@]}"
burgeon tiles make "$folder/one" --threads 1
burgeon tiles join "$folder/one"
burgeon tiles check "$folder/one"
tiles=$(find "$folder/one/tiles" -name '*.glb' | wc -l)
if [ "$tiles" -lt 8 ]; then
  echo "$tiles tiles are too few for two workers"
  exit 1
fi

# Runs a launcher, and compares the tileset and all contents with those of one process.
compare() {
  local name=$1
  shift
  echo "-- $name"
  if "$@" >"$folder/$name.txt" 2>&1 && diff -r -x log "$folder/one" "$folder/$name"; then
    # Each share that made a tile has a log of its own.
    local shares
    shares=$(find "$folder/$name/log" -name 'share-*.tsv' | wc -l)
    echo "$name: the bytes of $tiles tiles are the same, made in $shares shares"
    if [ "$shares" -gt 1 ]; then
      passed=$((passed + 1))
      return
    fi
  fi
  cat "$folder/$name.txt"
  failed=$((failed + 1))
}

skip() {
  echo "skipped: $1, because $2"
  skipped=$((skipped + 1))
}

command -v parallel >/dev/null || {
  apt-get update -q && DEBIAN_FRONTEND=noninteractive apt-get install -y -q parallel
} >"$folder/apt.txt" 2>&1 || true
if command -v parallel >/dev/null; then
  compare parallel "$launchers/parallel.sh" "$script" "$data" "$folder/parallel" 2 "${options[@]}"
else
  skip parallel "it cannot be installed: $(tail -n 1 "$folder/apt.txt")"
fi

# An environment for Python needs a package of its own on some systems.
python3 -m venv "$folder/python" >"$folder/venv.txt" 2>&1 || {
  apt-get update -q && DEBIAN_FRONTEND=noninteractive apt-get install -y -q python3-venv &&
    python3 -m venv --clear "$folder/python"
} >>"$folder/venv.txt" 2>&1 || true
# Runs a launcher in Python: its name, and the packages that it needs.
python() {
  local name=$1 pip=$folder/python/bin/pip
  shift
  if "$pip" install --quiet --disable-pip-version-check "$@" >"$folder/pip-$name.txt" 2>&1; then
    compare "$name" "$folder/python/bin/python" "$launchers/${name}_tiles.py" "$script" "$data" "$folder/$name" 2 \
      "${options[@]}"
  else
    skip "$name" "it cannot be installed: $(tail -n 1 "$folder/pip-$name.txt")"
  fi
}
python dask "distributed==2026.8.0"
RAY_USAGE_STATS_ENABLED=0 python ray "ray==2.60.0"

echo "$passed passed, $failed failed, $skipped skipped"
[ "$failed" -eq 0 ]
