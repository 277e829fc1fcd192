#!/bin/bash
# A Slurm array of the runs of a sweep, a task a run. A task that is stopped before its end, by its time
# limit or by preemption, puts itself back into the queue and goes on from its checkpoint.
#
#   bond-sweep plan table.csv --case case.toml -o sweep
#   sbatch --array=1-$(wc -l <sweep/runs.txt)%50 slurm-array.sh sweep
#   sbatch --dependency=singleton --job-name=bond-sweep --wrap "bond-sweep collect sweep -o table-results.csv"
#
#SBATCH --job-name=bond-sweep
#SBATCH --ntasks=1
#SBATCH --cpus-per-task=1
#SBATCH --mem=2G
#SBATCH --time=04:00:00
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --signal=B:TERM@120
set -u
sweep=$1
run=$(sed -n "${SLURM_ARRAY_TASK_ID}p" "$sweep/runs.txt")

bond-sweep run "$sweep" "$run" &
child=$!
# The shell gets the signal and hands it on; bond-sweep then ends with 75 within 5 s.
trap 'kill -TERM $child 2>/dev/null' TERM
wait $child
status=$?
while kill -0 $child 2>/dev/null; do wait $child; status=$?; done

if [ $status -eq 75 ]; then
    exec scontrol requeue "$SLURM_ARRAY_JOB_ID"_"$SLURM_ARRAY_TASK_ID"
fi
exit $status
