#!/usr/bin/env bash
# ./demo with stand-ins for cmake, the package database and lahar: what it runs, what it says, how it ends.
# shellcheck source=tests/tools/assert.sh
. "$(dirname "${BASH_SOURCE[0]}")/assert.sh" "$1"

mkdir -p "$scratch/tree/build/release/bin" "$scratch/bin"
cp -r "$root/tools" "$root/demo" "$scratch/tree/"

# stand_in FILE TEXT
stand_in() {
  printf '#!/bin/sh\n%s\n' "$2" >"$1"
  chmod +x "$1"
}
stand_in "$scratch/bin/dpkg-query" 'printf "install ok installed"'
stand_in "$scratch/bin/cmake" 'exit 0'
lahar="$scratch/tree/build/release/bin/lahar"
export PATH="$scratch/bin:$PATH"

# A run that leaves two files in the folder after --out.
# shellcheck disable=SC2016
stand_in "$lahar" 'echo "called: $*"
while [ "$1" != --out ]; do shift; done
mkdir -p "$2" && touch "$2/summary.json" "$2/image_000001.png"'

capture "$scratch/tree/demo" --threads 2
expect_equal 'the status' "$status" 0
expect_contains "$output" "called: run $scratch/tree/cases/debris_flow/demo.toml --overwrite --out $scratch/tree/results/demo --threads 2"
expect_contains "$output" "Results are in $scratch/tree/results/demo."
expect_contains "$output" 'image_*.png'
case "$output" in *particles.xmf*) fail "a file that is not there is offered: $output" ;; esac
[ -f "$scratch/tree/results/demo/summary.json" ] || fail 'no results'

capture "$scratch/tree/demo" --out "$scratch/elsewhere"
expect_contains "$output" "demo.toml --out $scratch/elsewhere"
expect_contains "$output" "Results are in $scratch/elsewhere."

# An interrupted or failed run ends with its own status.
stand_in "$lahar" 'exit 130'
capture "$scratch/tree/demo"
expect_equal 'the status of an interrupted run' "$status" 130
