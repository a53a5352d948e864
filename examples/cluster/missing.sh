#!/bin/sh
# Prints the numbers of the missing pieces, separated by commas, for `sbatch --array`; nothing if all are there:
#   ./missing.sh PIECES
n=0
while [ "$n" -lt "$1" ]; do
  [ -s "out/shard-$n.csv" ] || echo "$n"
  n=$((n + 1))
done | paste -sd,
