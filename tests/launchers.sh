#!/usr/bin/env bash
# Makes the tiles of a village with each launcher of examples/tiles on two workers, and compares their bytes with those of one
# process: tests/launchers.sh PROGRAM FOLDER. Installs the tools into FOLDER, and skips one, with the reason, only if it cannot be
# installed. Slurm and Kubernetes need a cluster: tests/launchers runs their jobs without one.
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
# Runs a launcher that needs a package of Python: its name, the package, and the launcher.
python() {
  local name=$1 package=$2
  shift 2
  if "$folder/python/bin/pip" install --quiet --disable-pip-version-check "$package" >"$folder/pip-$name.txt" 2>&1; then
    compare "$name" "$@"
  else
    skip "$name" "it cannot be installed: $(tail -n 1 "$folder/pip-$name.txt")"
  fi
}
# Runs a script in Python: its name, the package, and the script with the arguments before those of all launchers.
python_script() {
  local name=$1 package=$2
  shift 2
  python "$name" "$package" "$folder/python/bin/python" "$@" "$script" "$data" "$folder/$name" 2 "${options[@]}"
}
snakemake() {
  "$folder/python/bin/snakemake" --cores 2 --snakefile "$launchers/Snakefile" --directory "$folder" \
    --config script="$script" data="$data" folder="$folder/snakemake" shares=8 options="${options[*]}"
}
python_script dask "distributed==2026.8.0" "$launchers/dask_tiles.py"
RAY_USAGE_STATS_ENABLED=0 python_script ray "ray==2.60.0" "$launchers/ray_tiles.py"
python snakemake "snakemake==9.27.1" snakemake
python_script kubernetes "kubernetes==37.0.2" "$PWD/tests/launchers/kubernetes_job.py" "$launchers/kubernetes.yaml"
compare slurm tests/launchers/slurm_array.sh "$launchers/slurm.sh" "$script" "$data" "$folder/slurm" 8 "${options[@]}"

echo "$passed passed, $failed failed, $skipped skipped"
[ "$failed" -eq 0 ]
