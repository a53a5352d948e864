#!/bin/bash
# One piece of a ranking, as a task of a Slurm array or of GNU parallel: see README.md beside this file.
#SBATCH --requeue --open-mode=append --cpus-per-task=1 --output=log/%A_%a.log
#
# PIECES     how many pieces there are
# SCENES     scene files, separated by blanks
# CATALOGUE  catalogue file, copied for every task
# CFS        the program (default: cfs)
set -eu
n=$SLURM_ARRAY_TASK_ID
out=out/shard-$n.csv
# A file under its final name is whole.
[ -s "$out" ] && exit 0
tmp=$(mktemp -d)
trap 'rm -rf "$tmp"' EXIT
# A catalogue is one file with one writer: every task has its own.
cp "$CATALOGUE" "$tmp/catalogue.cfsdb"
export RAYON_NUM_THREADS=${SLURM_CPUS_PER_TASK:-1} CFS_CATALOGUE=$tmp/catalogue.cfsdb HOME=$tmp
# Written beside its name and renamed by the program itself.
# shellcheck disable=SC2086 # a list of files
"${CFS:-cfs}" rank $SCENES --shard "$n/$PIECES" --out "$out"
