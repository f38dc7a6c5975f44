#!/usr/bin/env bash
# A project that takes Lahar in with add_subdirectory, by flags of its own: its sources get the processor options that
# Lahar's have, and none of its warnings. Configures only. Usage: embed_test.sh BUILD_FOLDER SOURCE_FOLDER
# shellcheck source=tests/tools/assert.sh
. "$(dirname "${BASH_SOURCE[0]}")/assert.sh" "$1"
source_folder="$(cd "$2" && pwd)"
compiler="$(sed -n 's/^CMAKE_CXX_COMPILER:[A-Z]*=//p' "$root/CMakeCache.txt")"

plant CMakeLists.txt 'cmake_minimum_required(VERSION 3.25)
project(parent LANGUAGES CXX)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
add_subdirectory('"$source_folder"' lahar)
add_executable(parent main.cpp)
target_link_libraries(parent PRIVATE Lahar::coupling)'
plant main.cpp 'int main() {}'
capture env CXXFLAGS=-g cmake -S "$scratch/tree" -B "$scratch/build" -DCMAKE_CXX_COMPILER="$compiler" -DLAHAR_NATIVE=ON \
  -DCMAKE_INSTALL_INCLUDEDIR=include/vendor
[ "$status" -eq 0 ] || fail "add_subdirectory: $output"

# The command that compiles a source.
command_of() { grep -F '"command"' "$scratch/build/compile_commands.json" | grep -F -- "$1" | head -n 1; }
parents="$(command_of tree/main.cpp)"
ours="$(command_of core/geometry.cpp)"
expect_contains "$ours" ' -march=native '
expect_contains "$parents" ' -march=native '
expect_lacks "$parents" '-Werror'
expect_lacks "$ours" '-Werror'
expect_lacks "$(cat "$scratch/build/compile_commands.json")" 'tests/core'

# Flags that say nothing of optimisation do not switch it off.
expect_contains "$ours" ' -g -O3 '
# The headers are looked for where they are installed.
exported="$(cat "$scratch"/build/lahar/CMakeFiles/Export/*/LaharTargets.cmake)"
expect_contains "$exported" 'include/vendor/lahar'
