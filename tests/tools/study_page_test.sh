#!/usr/bin/env bash
# shellcheck source=tests/tools/assert.sh
. "$(dirname "${BASH_SOURCE[0]}")/assert.sh" "$1"

clear_tree
plant study/comparison.csv '# theirs
quantity,unit,case,theirs,ours,difference,spread
e_in,kJ,matched-L4.10-coarse-resolved-seed1,54.361,50,-0.08,
e_in,kJ,matched-L4.10-coarse-averaged-seed1,54.361,52.123456,-0.04,
e_in,kJ,matched-L4.10-standard-resolved-seed1,54.361,40,-0.26,
depth,m,matched-L4.10-coarse-resolved-seed1,,0.25,,
depth,m,matched-L4.10-coarse-averaged-seed1,,,,
depth,m,matched-L4.10-standard-resolved-seed1,,0.2,,'
for case in coarse-resolved coarse-averaged standard-resolved; do
  plant "study/matched-L4.10-$case-seed1/summary.json" '{"wall_seconds": 600, "threads": 1, "commit": "abc",
"checks": [{"name": "momentum_audit", "pass": false}, {"name": "liquid_mass_ledger", "pass": true}]}'
done
mkdir -p "$scratch/tree/tools"
cp "$root/tools/study_page" "$scratch/tree/tools/"
page="$scratch/tree/tools/study_page"
capture "$page" "$scratch/tree/study"
expect_equal 'status' "$status" 0
expect_contains "$output" '| matched-L4.10-coarse-resolved-seed1 | 10.0 | 1 | abc | momentum_audit |'
expect_contains "$output" '## matched, L = 4.10 m'
expect_contains "$output" '| `e_in` | kJ | 54.36 | 50 | 52.12 | 40 |'
expect_contains "$output" '| `depth` | m | - | 0.25 | - | 0.2 |'
expect_contains "$output" '| Quantity | matched-L4.10-coarse-resolved-seed1 against matched-L4.10-standard-resolved-seed1 |'
expect_contains "$output" '| `depth` | +25.0 |'
first="$output"
rm -r "$scratch/tree/study"
capture "$page"
expect_equal 'the page of what was kept' "$output" "$first"
plant next/comparison.csv '# theirs
quantity,unit,case,theirs,ours,difference,spread
e_in,kJ,matched-L4.10-coarse-averaged-seed1,54.361,60,0.1,
e_in,kJ,matched-L4.10-coarse-averaged-seed2,54.361,40,-0.26,
water_left,kg,matched-L4.10-coarse-averaged-seed2,,400,,'
for seed in 1 2; do
  plant "next/matched-L4.10-coarse-averaged-seed$seed/summary.json" '{"wall_seconds": 60, "threads": 2, "commit": "def",
"checks": []}'
done
capture "$page" "$scratch/tree/next"
expect_equal 'status' "$status" 0
expect_contains "$output" '| matched-L4.10-coarse-averaged-seed1 | 1.0 | 2 | def | none |'
expect_contains "$output" '| `e_in` | kJ | 54.36 | 50 | 60 | 40 | 40 |'
expect_contains "$output" '| `depth` | m | - | 0.25 | - | - | 0.2 |'
expect_contains "$output" '| `water_left` | kg | - | - | - | 400 | - |'
expect_contains "$(cat "$scratch/tree/docs/results/study/comparison.csv")" \
  'e_in,kJ,matched-L4.10-coarse-averaged-seed2,54.361,40,-0.26,0.2'
capture "$page" "$scratch/tree/none"
expect_equal 'status without a study' "$status" 1
expect_contains "$output" 'it has no comparison.csv'
