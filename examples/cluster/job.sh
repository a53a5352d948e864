#!/bin/bash
# Computes one piece of a ranking, as a task of a Slurm array job or of GNU parallel (see README.md):
#   sbatch --array=0-7 job.sh
#SBATCH --requeue --open-mode=append --cpus-per-task=1 --output=log/%A_%a.log
#
# PIECES     number of pieces
# SCENES     scene files, separated by spaces
# CATALOGUE  catalogue file; each task works on a copy
# CFS        path of the program (default: cfs)
set -eu
n=$SLURM_ARRAY_TASK_ID
out=out/shard-$n.csv
# A file under its final name is complete: nothing to do.
[ -s "$out" ] && exit 0
tmp=$(mktemp -d)
trap 'rm -rf "$tmp"' EXIT
# Tasks do not share a catalogue, since each may write into it.
cp "$CATALOGUE" "$tmp/catalogue.cfsdb"
export RAYON_NUM_THREADS=${SLURM_CPUS_PER_TASK:-1} CFS_CATALOGUE=$tmp/catalogue.cfsdb HOME=$tmp
# The program writes a temporary file and renames it when it is complete.
# shellcheck disable=SC2086 # a list of files
"${CFS:-cfs}" rank $SCENES --shard "$n/$PIECES" --out "$out"
