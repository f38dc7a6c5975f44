#!/usr/bin/env bash
# shellcheck source=tests/tools/assert.sh
. "$(dirname "${BASH_SOURCE[0]}")/assert.sh" "$1"

# The tree that every page below may name.
plant_tree() {
  clear_tree
  plant lbm/step/fluid.h '// a file'
  plant docs/fluid.md $'# The fluid\n\n## One step, of `many`'
  plant tests/lbm/fluid_test.cpp 'TEST(Fluid, Flows) { EXPECT_TRUE(true); }'
}

# refused TEXT WHAT: a page with TEXT is refused, naming WHAT
refused() {
  plant_tree
  plant docs/page.md "$1"
  capture "$root/tools/check_docs" "$scratch/tree"
  [ "$status" -eq 1 ] || fail "not refused (status $status): $1"
  expect_contains "$output" "docs/page.md:1: $2"
}

allowed() {
  plant_tree
  plant docs/page.md "$1"
  capture "$root/tools/check_docs" "$scratch/tree"
  [ "$status" -eq 0 ] || fail "refused: $1: $output"
}

allowed 'see [fluid](fluid.md), [step](../lbm/step), [part](fluid.md#one-step-of-many), [there](https://example.org/x.md#none)'
allowed $'[here](#here-it-is)\n\n# Here it is'
refused 'see [part](fluid.md#two-steps)' 'no fluid.md#two-steps'
refused 'see [here](#there)' 'no #there'
refused 'see [fluid](fluids.md)' 'no fluids.md'
refused '![picture](images/none.png)' 'no images/none.png'
refused 'see [up](../../outside.md)' 'no ../../outside.md'

# shellcheck disable=SC2016  # the backticks are Markdown's
{
  allowed '`lbm/step/fluid.h`, `step/fluid.h` and `fluid.h`; `steeper.toml` is a user'"'"'s'
  refused '`lbm/fluid.h`' 'no lbm/fluid.h'
  refused 'one `luid.h`' 'no luid.h'
  refused '`cases/none.toml`' 'no cases/none.toml'
  allowed '`lbm/step/`, `lbm/step`'
  refused '`lbm/none.txt`' 'no lbm/none.txt'
  refused '`lbm/none/`' 'no lbm/none/'
  refused '`tools/none`' 'no tools/none'
  allowed '`Fluid.Flows`, `Fluid.*`, `fluid.cell_size_m`'
  refused '`Fluid.Stands`' 'no test Fluid.Stands'
  refused '`Fluids.*`' 'no test Fluids.*'
}

# What stands in a fenced block is no name.
plant_tree
plant docs/page.md $'```\n`none.h` [x](none.md)\n```'
capture "$root/tools/check_docs" "$scratch/tree"
expect_equal 'status with names in a fenced block only' "$status" 0

# The project itself.
capture "$root/tools/check_docs"
[ "$status" -eq 0 ] || fail "the pages of the project: $output"
