#!/usr/bin/env bash
# A picture of a run by ParaView without a screen: seeds and air are on it, and bad input is refused.
# Usage: picture.sh SEEDFLOW SOURCE_DIR
set -eu
seedflow=$1 source=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
fail() { echo "FAILED: $*" >&2; exit 1; }
picture() { "$source/seedflow" picture "$@" >"$folder/picture.log" 2>&1; }
refused() {
  local said=$1 status=0
  shift
  picture "$@" || status=$?
  ((status == 2)) || fail "status $status of: picture $*"
  grep -q -- "$said" "$folder/picture.log" || fail "'$said' is not said: $(tail -n 3 "$folder/picture.log")"
}

"$seedflow" run "$source/prm/settling.prm" --set "Run/End time=0.02 s" --output "$folder/run" >"$folder/run.log" 2>&1 ||
  fail "the run: $(tail -n 3 "$folder/run.log")"
picture "$folder/run" --size 400,300 || fail "$(tail -n 5 "$folder/picture.log")"
file=$folder/run/picture.png
[[ $(head -c 4 "$file" | tail -c 3) == PNG ]] || fail "no PNG"
# An empty scene of this size is a PNG of less than 4 kB.
size=$(stat -c %s "$file")
((size > 10000)) || fail "the picture has $size bytes: seeds and air are missing"

refused "there is no folder" "$folder/nothing"
refused "neither seeds.pvd nor air.pvd" "$folder"
refused "outside the air" "$folder/run" --plane z=7
refused "is not like" "$folder/run" --plane middle
refused "are not 2 numbers" "$folder/run" --size 400
echo "a picture of $size bytes"
