#!/bin/sh
# parallel.sh MODELS BAKED: bakes every mesh below MODELS with GNU parallel, one process per file, into the same place
# below BAKED. The job log holds every exit code. A second run takes finished files from the cache and retries the others.
set -eu
mkdir -p "$2"
baked="$(cd "$2" && pwd)"
cd "$1"
find . -type d -print0 | (cd "$baked" && xargs -0 mkdir -p --)
find . -name '*.ply' -o -name '*.obj' -o -name '*.gltf' -o -name '*.glb' | sort |
  parallel --will-cite --joblog "$baked/bake.log" \
    jalousie-bake {} -o "$baked/{.}.glb" --jobs 1 --cache "$baked/.cache" --quiet || failed=$?
# Columns of the log: 7 is the exit code, 9 starts the command. Exit code 5: malformed, 6: not supported, 7: over a limit.
awk 'NR > 1 && $7 != 0 { print "exit code " $7 ": " $10 }' "$baked/bake.log"
exit "${failed:-0}"
