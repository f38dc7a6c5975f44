#!/usr/bin/env bash
# tools/common.sh with stand-ins for the programs that it calls.
# shellcheck source=tests/tools/assert.sh
. "$(dirname "${BASH_SOURCE[0]}")/assert.sh" "$1"
# shellcheck source=tools/common.sh
. "$root/tools/common.sh"

# A copy of the scripts with its own package list.
lahar_root="$scratch/tree"
plant tools/packages.txt $'# a comment\ncmake\n\nlibeigen3-dev\nbrowser optional'

dpkg-query() {
  case "${*: -1}" in cmake) printf 'install ok installed' ;; *) return 1 ;; esac
}
expect_equal 'the missing package' "$(missing_packages)" libeigen3-dev
expect_equal 'the missing optional package' "$(missing_packages optional)" browser

# Who may not install is told what to install, be it needed or optional.
id() { echo 1000; }
command() { [ "$2" != sudo ]; }
capture install_packages
expect_contains "$output" 'apt-get install -y --no-install-recommends libeigen3-dev'
capture install_optional_packages
expect_contains "$output" 'apt-get install -y --no-install-recommends browser'
unset -f id command

calls="$scratch/calls"
as_root() { printf '%s\n' "$*" >>"$calls"; }
install_packages >"$scratch/log"
expect_contains "$(cat "$calls")" 'apt-get update'
expect_contains "$(cat "$calls")" 'install -q -y --no-install-recommends libeigen3-dev'

# shellcheck disable=SC2317  # called by install_packages
as_root() { return 100; }
capture install_packages
[ "$status" -ne 0 ] || fail 'apt failed and nobody noticed'
expect_contains "$output" 'error: apt-get update failed'

# What is optional may be missing: everything goes on, as root or not.
dpkg-query() {
  case "${*: -1}" in browser) return 1 ;; *) printf 'install ok installed' ;; esac
}
capture install_packages
expect_equal 'status without an optional package' "$status" 0
capture install_optional_packages
expect_equal 'status where it cannot be installed' "$status" 0
expect_contains "$output" 'going on without browser'
as_root() { die 'neither root nor is there sudo'; }
capture install_optional_packages
expect_equal 'status where nothing can be installed' "$status" 0

# Nothing missing: no apt at all.
dpkg-query() { printf 'install ok installed'; }
as_root() { fail 'apt was called although nothing is missing'; }
install_packages >"$scratch/log"
expect_contains "$(cat "$scratch/log")" 'all packages are installed'

# One job for 1600 MiB, never more than processors, never less than one.
nproc() { echo 16; }
for row in '500 1' '3300 2' '8000 5' '100000 16'; do
  available_memory_mib() { echo "${row% *}"; }
  expect_equal "jobs with ${row% *} MiB" "$(parallel_jobs)" "${row#* }"
done

# A build folder written for another checkout goes, our own stays.
plant build/dev/CMakeCache.txt "CMAKE_HOME_DIRECTORY:INTERNAL=$lahar_root"
drop_foreign_cache "$lahar_root/build/dev"
[ -f "$lahar_root/build/dev/CMakeCache.txt" ] || fail 'our own build folder was removed'
plant build/dev/CMakeCache.txt 'CMAKE_HOME_DIRECTORY:INTERNAL=/another/checkout'
drop_foreign_cache "$lahar_root/build/dev"
[ ! -e "$lahar_root/build/dev" ] || fail 'a build folder of another checkout was kept'

expect_equal 'duration' "$(duration_text 200)" '3 min 20 s'
