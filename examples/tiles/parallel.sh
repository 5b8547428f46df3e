#!/bin/sh
# Makes tiles on one machine with GNU parallel: parallel.sh SCRIPT DATA FOLDER JOBS [OPTIONS OF PLAN]
# Shares are smaller than jobs, so that all cores are busy until the end. A share is repeated if a file could not be written.
set -eu
script=$1 data=$2 folder=$3 jobs=$4
shift 4
shares=$((jobs * 4))

burgeon tiles plan "$script" --data "$data" -o "$folder" "$@"
# The join lists features that are missing, so a share that fails does not end the others.
seq "$shares" | parallel -j "$jobs" --retries 3 \
  burgeon tiles make "$folder" --threads 1 --share "{}/$shares" || true
burgeon tiles join "$folder"
burgeon tiles check "$folder"
