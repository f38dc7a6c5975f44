#!/usr/bin/env bash
# What the tutorial says that `lahar` prints is what it prints, for the scenes that take seconds: lines of `lahar check`
# word for word; results of `lahar run` by their names and values, checks by whether they pass.
# Usage: printed_results_test.sh ROOT LAHAR
# shellcheck source=tests/tools/assert.sh
. "$(dirname "${BASH_SOURCE[0]}")/assert.sh" "$1"
lahar="$2"

# printed_after PAGE COMMAND: the block that follows the block whose last line begins with the command
printed_after() {
  awk -v command="$2" '
    /^```/ { inside = !inside; if (inside && waiting) printing = 1; if (!inside && printing) exit; next }
    inside && printing { print; next }
    inside { waiting = index($0, command) == 1 }
  ' "$1"
}

# same_results EXPECTED PRINTED: each line of the first is in the second, its value within a hundredth; a value that is
# held against a reference is rounding, and only has to pass
same_results() {
  awk '
    function off(a, b) { return (a > b ? a - b : b - a) > 0.01 * (b < 0 ? -b : b) }
    NR == FNR { if (NF >= 2) { value[$1] = $2; last[$1] = $NF } next }
    !($1 in value) { print $1 ": not printed"; next }
    / pass\)$/ { if (last[$1] != "pass)") print $1 ": does not pass"; next }
    off(value[$1], $2) { print $1 ": " value[$1] " is printed, the page says " $2 }
  ' "$2" "$1"
}

# compare_check NAME, compare_run NAME: the block of a scene of the tutorial against the program
compare_check() {
  local line
  printed_after "$root/docs/tutorial.md" "build/release/bin/lahar check cases/tutorial/$1.toml" >"$scratch/expected"
  [ -s "$scratch/expected" ] || fail "the tutorial prints nothing of lahar check $1"
  "$lahar" check "$root/cases/tutorial/$1.toml" >"$scratch/printed"
  while IFS= read -r line; do
    grep -qxF -- "$line" "$scratch/printed" || fail "lahar check $1 does not print: $line"
  done <"$scratch/expected"
}

compare_run() {
  printed_after "$root/docs/tutorial.md" "build/release/bin/lahar run cases/tutorial/$1.toml" >"$scratch/expected"
  [ -s "$scratch/expected" ] || fail "the tutorial prints nothing of lahar run $1"
  "$lahar" run "$root/cases/tutorial/$1.toml" --threads 1 --set run.image_interval_s=0 --out "$scratch/$1" \
    >"$scratch/printed"
  expect_equal "results of $1 that differ" "$(same_results "$scratch/expected" "$scratch/printed")" ''
}

compare_check dam_break
compare_run dam_break
compare_run probe

# Another value, another name and a check that fails are found; rounding is not.
printf '  a 1.00\n  b 2  (reference 0, pass)\n' >"$scratch/expected"
printf '  a 1.005\n  b 3  (reference 0, pass)\n' >"$scratch/printed"
expect_equal 'differences' "$(same_results "$scratch/expected" "$scratch/printed")" ''
printf '  a 1.02\n  b 2  (reference 0, FAIL)\n' >"$scratch/printed"
expect_contains "$(same_results "$scratch/expected" "$scratch/printed")" 'a: 1.02 is printed, the page says 1.00'
expect_contains "$(same_results "$scratch/expected" "$scratch/printed")" 'b: does not pass'
printf '  c 1\n' >"$scratch/printed"
expect_contains "$(same_results "$scratch/expected" "$scratch/printed")" 'a: not printed'
