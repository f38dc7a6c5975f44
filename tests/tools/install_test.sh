#!/usr/bin/env bash
# `cmake --install` into a fresh folder; a project outside finds Lahar there, compiles against every target and runs.
# Usage: install_test.sh BUILD_FOLDER
# shellcheck source=tests/tools/assert.sh
. "$(dirname "${BASH_SOURCE[0]}")/assert.sh" "$1"

prefix="$scratch/prefix"
cmake --install "$root" --prefix "$prefix" >"$scratch/install.log" || fail "cmake --install: $(cat "$scratch/install.log")"
compiler="$(sed -n 's/^CMAKE_CXX_COMPILER:[A-Z]*=//p' "$root/CMakeCache.txt")"
flags="$(sed -n 's/^LAHAR_SANITIZE:STRING=\(..*\)$/-fsanitize=\1/p' "$root/CMakeCache.txt")"

cp -r "$(dirname "${BASH_SOURCE[0]}")/consumer" "$scratch/consumer"
capture cmake -S "$scratch/consumer" -B "$scratch/build" -DCMAKE_PREFIX_PATH="$prefix" \
  -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_CXX_FLAGS="$flags" -DCMAKE_BUILD_TYPE=Release
[ "$status" -eq 0 ] || fail "find_package(Lahar): $output"
capture cmake --build "$scratch/build"
[ "$status" -eq 0 ] || fail "building against the installed Lahar: $output"
capture "$scratch/build/consumer"
[ "$status" -eq 0 ] || fail "the program built against Lahar: $output"

capture "$prefix/bin/lahar" --help
[ "$status" -eq 0 ] || fail "the installed lahar: $output"

# Reference data are those beside the installed program: a mistake in them is told with its place.
sed -i 's/274.1127/far/' "$prefix/share/lahar/cases/validate/reference/dem_hertz.csv"
capture "$prefix/bin/validate" dem.elastic_impact_of_spheres
expect_equal 'status with a mistake in the reference data' "$status" 1
expect_contains "$output" 'share/lahar/cases/validate/reference/dem_hertz.csv:4:'
