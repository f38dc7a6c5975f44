#!/usr/bin/env bash
# The words are put together from parts, so that this file itself passes.
# shellcheck source=tests/tools/assert.sh
. "$(dirname "${BASH_SOURCE[0]}")/assert.sh" "$1"

expect_refused() {
  clear_tree
  plant core/a.h $'// first line\n'"$1"
  capture "$root/tools/check_words" "$scratch/tree"
  [ "$status" -eq 1 ] || fail "not refused (status $status): $1"
  expect_contains "$output" "core/a.h:2:"
}

expect_allowed() {
  clear_tree
  plant core/a.h "$1"
  capture "$root/tools/check_words" "$scratch/tree"
  [ "$status" -eq 0 ] || fail "refused: $1: $output"
}

for word in 'TO''DO' 'FIX''ME' 'XX''X' 'HA''CK'; do
  expect_refused "// $word: later"
  expect_allowed "// no${word}word"
done
for folder in home root work tmp Users; do
  expect_refused "const char* path = \"/$folder""/someone/file\";"
done
expect_allowed 'mktemp -d -t lahar.XX''XXXX'
expect_allowed 'see lbm/home''/x and results/demo'
expect_allowed 'units of N/m, work/energy'
expect_refused '<<<<''<<< HEAD'

# What is kept of results is.
clear_tree
plant core/a.h '// clean'
plant docs/results/a.json "/home""/someone"
capture "$root/tools/check_words" "$scratch/tree"
expect_equal 'status with a path in a kept result' "$status" 1

# Build output and results are not sources.
clear_tree
plant core/a.h '// clean'
plant build/dev/log.txt "/home""/someone"
plant results/demo/run.log "/home""/someone"
capture "$root/tools/check_words" "$scratch/tree"
expect_equal 'status with mistakes only in build and results' "$status" 0
