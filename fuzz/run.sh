#!/usr/bin/env bash
# Has each reader of foreign bytes look at damaged ones for a minute, or for as many seconds as are named.
# What it finds is left in fuzz/found; a file that was mended for goes to fuzz/corpus/TARGET, where the tests read it.
set -euo pipefail
cd "$(dirname "$0")/.."
# What would overflow silently is to be found as well.
export CARGO_PROFILE_RELEASE_OVERFLOW_CHECKS=true CARGO_PROFILE_RELEASE_DEBUG_ASSERTIONS=true
seconds=${1:-60} seed=${2:-$RANDOM} failed=0
# Debug assertions of i_overlay hold of areas that fit its grid, and of tangles they may not.
cargo build --quiet --release --example fuzz --target-dir target/fuzz \
  --config profile.release.package.i_overlay.debug-assertions=false
echo "seed $seed"
for folder in fuzz/corpus/*/; do
  target/fuzz/release/examples/fuzz "$(basename "$folder")" "$seconds" "$seed" || failed=1
done
exit "$failed"
