#!/usr/bin/env bash
# The public headers with Clang, where it is installed: no warning of ours. Usage: clang_test.sh SOURCE_FOLDER
# shellcheck source=tests/tools/assert.sh
. "$(dirname "${BASH_SOURCE[0]}")/assert.sh" "$1"
needs clang++
capture clang++ -std=c++20 -fsyntax-only -I"$root" -isystem /usr/include/eigen3 -Wall -Wextra -Wpedantic -Wshadow \
  -Wnon-virtual-dtor -Wno-psabi -Werror "$root/tests/tools/consumer/main.cpp"
[ "$status" -eq 0 ] || fail "clang++: $output"
