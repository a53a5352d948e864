#!/bin/sh
# The numbers of the pieces that are not there yet, as `sbatch --array` takes them: missing.sh PIECES. Nothing: all are there.
n=0
while [ "$n" -lt "$1" ]; do
  [ -s "out/shard-$n.csv" ] || echo "$n"
  n=$((n + 1))
done | paste -sd,
