#!/usr/bin/env bash
# Each TOML block of the tutorial and of README.md passes `lahar check`: a block below the name of a file of the project is
# part of that file, word for word, and the file is checked; any other block is checked as a scene in the project's root.
# Usage: scene_blocks_test.sh ROOT LAHAR
# shellcheck source=tests/tools/assert.sh
. "$(dirname "${BASH_SOURCE[0]}")/assert.sh" "$1"
lahar="$2"

# Writes the blocks of a page to $scratch/blocks/N.toml, each with the file named last before it in N.name.
extract() {
  rm -rf "$scratch/blocks" && mkdir "$scratch/blocks"
  awk -v to="$scratch/blocks/" '
    /^```toml$/ { inside = 1; n++; print name > (to n ".name"); next }
    /^```/ { inside = 0; next }
    inside { print > (to n ".toml"); next }
    match($0, /cases\/[a-z_\/]+\.toml/) { name = substr($0, RSTART, RLENGTH) }
  ' "$1"
}

# is_part BLOCK FILE: the lines of the block stand in the file, one after the other
is_part() { awk 'NR == FNR { block = block $0 "\n"; next } { file = file $0 "\n" } END { exit !index(file, block) }' "$1" "$2"; }

check_scene() {
  capture "$lahar" check "$1"
  [ "$status" -eq 0 ] || fail "lahar check of $2: $output"
}

# check_page PAGE BLOCKS
check_page() {
  local block name found=0
  extract "$root/$1"
  for block in "$scratch"/blocks/*.toml; do
    found=$((found + 1))
    name="$(cat "${block%.toml}.name")"
    if [ -n "$name" ]; then
      is_part "$block" "$root/$name" || fail "$1: block $found is not a part of $name"
      check_scene "$root/$name" "$name"
    else
      mkdir -p "$scratch/scenes" && ln -sfn "$root/cases" "$scratch/scenes/cases"
      cp "$block" "$scratch/scenes/block.toml"
      check_scene "$scratch/scenes/block.toml" "block $found of $1"
    fi
  done
  expect_equal "TOML blocks of $1" "$found" "$2"
}

check_page docs/tutorial.md 4
check_page README.md 1

# A changed block is found.
printf '[scene]\nname = "other"\n' >"$scratch/other.toml"
if is_part "$scratch/other.toml" "$root/cases/tutorial/net.toml"; then fail 'a foreign block passes as a part'; fi
