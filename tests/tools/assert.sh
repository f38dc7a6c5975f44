# Assertions for the tests of the scripts. To be sourced by bash; $1 of the test is the root of the project.
# shellcheck shell=bash disable=SC2034
set -euo pipefail

root="$(cd "$1" && pwd)"
scratch="$(mktemp -d)"
trap 'rm -rf "$scratch"' EXIT

fail() {
  printf 'FAILED: %s\n' "$*" >&2
  exit 1
}

# expect_equal WHAT VALUE EXPECTED
expect_equal() { [ "$2" = "$3" ] || fail "$1 is '$2', expected '$3'"; }

# expect_contains TEXT PART
expect_contains() { case "$1" in *"$2"*) ;; *) fail "expected '$2' in: $1" ;; esac; }
# expect_lacks TEXT PART
expect_lacks() { case "$1" in *"$2"*) fail "did not expect '$2' in: $1" ;; esac; }

# needs PROGRAM: without it the test is skipped.
needs() {
  command -v "$1" >/dev/null && return
  echo "skipped: there is no $1"
  exit 77
}

# Runs a command; sets `output` (both streams) and `status`.
capture() {
  status=0
  output="$("$@" 2>&1)" || status=$?
}

# plant PATH TEXT: a file under $scratch/tree
plant() {
  mkdir -p "$(dirname "$scratch/tree/$1")"
  printf '%s\n' "$2" >"$scratch/tree/$1"
}

clear_tree() { rm -rf "$scratch/tree" && mkdir -p "$scratch/tree"; }
