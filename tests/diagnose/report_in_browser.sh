#!/usr/bin/env bash
# The report of a diagnosis in a real browser: it is rendered with its verdict and its plots, and prints.
# Usage: report_in_browser.sh SEEDFLOW BROWSER SOURCE_DIR
set -eu
seedflow=$1 browser=$2 source=$3
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
fail() { echo "FAILED: $*" >&2; exit 1; }
open() {
  timeout 120 "$browser" --headless --no-sandbox --disable-gpu --no-first-run --disable-background-networking \
    --user-data-dir="$folder/profile" "$@" "file://$folder/out/report.html" 2>"$folder/browser.log"
}

"$seedflow" diagnose "$source/prm/diagnosis/mordant_pinton.prm" --output "$folder/out" >"$folder/run.log" ||
  fail "the diagnosis: $(tail -n 3 "$folder/run.log")"

open --dump-dom >"$folder/dom.html" || fail "the browser: $(tail -n 3 "$folder/browser.log")"
grep -q "Missing: " "$folder/dom.html" || fail "the verdict is not on the page"
plots=$(grep -o "<svg" "$folder/dom.html" | wc -l)
((plots >= 4)) || fail "$plots plots on the page, where at least 4 are expected"
grep -q "parsererror" "$folder/dom.html" && fail "a plot is malformed"

open --print-to-pdf="$folder/report.pdf" || fail "the browser does not print: $(tail -n 3 "$folder/browser.log")"
[[ $(head -c 4 "$folder/report.pdf") == %PDF ]] || fail "no PDF"
size=$(stat -c %s "$folder/report.pdf")
((size > 20000)) || fail "the PDF has $size bytes: plots are missing"
echo "verdict, $plots plots, a PDF of $size bytes"
