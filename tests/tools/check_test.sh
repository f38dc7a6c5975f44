#!/usr/bin/env bash
# ./check in a copy of the project's scripts, with stand-ins for cmake, ctest and the package database: what it prints
# last and how it ends.
# shellcheck source=tests/tools/assert.sh
. "$(dirname "${BASH_SOURCE[0]}")/assert.sh" "$1"

mkdir -p "$scratch/tree/build/release" "$scratch/tree/core" "$scratch/tree/tests" "$scratch/bin"
cp -r "$root/tools" "$root/check" "$scratch/tree/"
mkdir -p "$scratch/tree/.ci" && cp "$root/.ci/run" "$scratch/tree/.ci/"

stand_in() {
  printf '#!/bin/sh\n%s\n' "$2" >"$scratch/bin/$1"
  chmod +x "$scratch/bin/$1"
}
stand_in dpkg-query 'printf "install ok installed"'
stand_in cmake 'exit 0'

# expect_end COMMAND LINE SUCCESS
expect_end() {
  capture env PATH="$scratch/bin:$PATH" "$1"
  expect_equal "the last line of $1" "$(printf '%s\n' "$output" | tail -n 1)" "$2"
  if [ "$3" = success ]; then
    expect_equal "the status of $1" "$status" 0
  else
    [ "$status" -ne 0 ] || fail "$1 ended with status 0 although: $2"
  fi
}

stand_in ctest 'echo "100% tests passed, 0 tests failed out of 12"'
expect_end "$scratch/tree/check" '12 passed, 0 failed' success
expect_end "$scratch/tree/.ci/run" '12 passed, 0 failed' success
(cd / && expect_end "$scratch/tree/check" '12 passed, 0 failed' success)

stand_in ctest 'echo "83% tests passed, 2 tests failed out of 12"; exit 8'
expect_end "$scratch/tree/.ci/run" '10 passed, 2 failed' failure

stand_in ctest 'echo "92% tests passed, 1 tests failed out of 12"; exit 8'
expect_end "$scratch/tree/check" '11 passed, 1 failed' failure

stand_in ctest 'echo "100% tests passed, 0 tests failed out of 12"
echo "The following tests did not run:"
printf "\t  7 - core.FlushDenormals.Acts (Skipped)\n"'
expect_end "$scratch/tree/check" '11 passed, 0 failed' success

stand_in ctest 'echo "No tests were found!!!"; exit 8'
expect_end "$scratch/tree/check" '0 passed, 1 failed' failure

# A failing lint alone is a failure too.
stand_in ctest 'echo "100% tests passed, 0 tests failed out of 12"'
printf '#include "lbm/step/fluid.h"\n' >"$scratch/tree/core/a.h"
expect_end "$scratch/tree/check" '12 passed, 1 failed' failure
rm "$scratch/tree/core/a.h"

stand_in cmake 'echo "compiler killed" >&2; exit 1'
expect_end "$scratch/tree/check" '0 passed, 1 failed' failure
