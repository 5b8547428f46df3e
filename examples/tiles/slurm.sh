#!/bin/sh
# Makes tiles on a Slurm cluster. Plan first: burgeon tiles plan SCRIPT --data DATA -o FOLDER
# Submit: sbatch --array=0-63%16 slurm.sh FOLDER
# Then:   sbatch --dependency=afterany:JOB --wrap "burgeon tiles join FOLDER"
#SBATCH --job-name=tiles
#SBATCH --cpus-per-task=2
#SBATCH --mem=4G
#SBATCH --time=04:00:00
#SBATCH --requeue
set -u
status=0
burgeon tiles make "$1" --of "${SLURM_ARRAY_TASK_COUNT}" --threads "${SLURM_CPUS_PER_TASK:-1}" || status=$?
# 75 says that a file could not be read or written: the job is worth another attempt, at most 3.
if [ "$status" -eq 75 ] && [ "${SLURM_RESTART_COUNT:-0}" -lt 3 ]; then
  scontrol requeue "${SLURM_ARRAY_JOB_ID}_${SLURM_ARRAY_TASK_ID}"
fi
exit "$status"
