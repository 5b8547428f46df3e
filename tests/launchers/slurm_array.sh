#!/usr/bin/env bash
# Makes tiles with examples/tiles/slurm.sh as Slurm would, two tasks of an array at a time: slurm_array.sh JOB SCRIPT DATA FOLDER TASKS
# [OPTIONS OF PLAN]. Slurm itself is replaced: the options of the job are read, its variables are set, and scontrol notes the tasks that
# ask for another attempt. The first attempt of task 2 ends with status 75, and a task whose attempts all do so ends with it.
set -euo pipefail
job=$1 script=$2 data=$3 folder=$4 tasks=$5
shift 5

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/bin" "$work/flaky"
printf '#!/bin/sh\necho "$@" >>"%s/requeued"\n' "$work" >"$work/bin/scontrol"
printf '#!/bin/sh\nexit 75\n' >"$work/flaky/burgeon"
chmod +x "$work/bin/scontrol" "$work/flaky/burgeon"
export PATH="$work/bin:$PATH" SLURM_ARRAY_JOB_ID=7 SLURM_ARRAY_TASK_COUNT=$tasks SLURM_ARRAY_TASK_MIN=1

# Each directive is an option of sbatch.
directives=$(sed -n 's/^#SBATCH --\([a-z-]*\).*/\1/p' "$job" | sort | tr '\n' ' ')
if [ "$directives" != "cpus-per-task job-name mem requeue time " ]; then
  echo "unexpected options: $directives"
  exit 1
fi
cpus=$(sed -n 's/^#SBATCH --cpus-per-task=//p' "$job")
# Runs a task: its number, the number of earlier attempts, and a folder of programs.
task() {
  SLURM_ARRAY_TASK_ID=$1 SLURM_RESTART_COUNT=$2 SLURM_CPUS_PER_TASK=$cpus PATH="$3:$PATH" sh "$job" "$folder"
}
# Fails unless a task ends with a status: the status, and the task.
expect() {
  local wanted=$1 status=0
  shift
  task "$@" || status=$?
  if [ "$status" -ne "$wanted" ]; then
    echo "task $1 ended with status $status, not $wanted"
    exit 1
  fi
}

burgeon tiles plan "$script" --data "$data" -o "$folder" "$@"
expect 75 2 0 "$work/flaky"
[ "$(cat "$work/requeued")" = "requeue 7_2" ]
# After three attempts, the task is not put back.
expect 75 2 3 "$work/flaky"
[ "$(wc -l <"$work/requeued")" -eq 1 ]
export -f task expect
export work job folder cpus
seq "$tasks" | xargs -P 2 -I{} bash -c 'expect 0 {} 1 "$work/bin"'
burgeon tiles join "$folder"
burgeon tiles check "$folder"
