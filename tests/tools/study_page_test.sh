#!/usr/bin/env bash
# shellcheck source=tests/tools/assert.sh
. "$(dirname "${BASH_SOURCE[0]}")/assert.sh" "$1"
needs python3

clear_tree
mkdir -p "$scratch/tree/tools"
cp "$root/tools/study_page" "$scratch/tree/tools/"
page="$scratch/tree/tools/study_page"
capture "$page"
expect_equal 'status without records' "$status" 1
expect_contains "$output" 'comparison.csv: not there; compare_cfd_dem --report --records writes it'

plant docs/results/study/comparison.csv '# theirs
quantity,unit,case,theirs,ours,difference,spread
e_in,kJ,matched-L4.10-coarse-resolved-seed1,54.361,50,-0.08,
e_in,kJ,matched-L4.10-coarse-averaged-seed1,54.361,52.123456,-0.04,
e_in,kJ,matched-L4.10-standard-resolved-seed1,54.361,40,-0.26,
depth,m,matched-L4.10-coarse-resolved-seed1,,0.25,,
depth,m,matched-L4.10-coarse-averaged-seed1,,,,
depth,m,matched-L4.10-standard-resolved-seed1,,0.2,,'
for case in coarse-resolved coarse-averaged standard-resolved; do
  plant "docs/results/study/matched-L4.10-$case-seed1.json" '{"summary": {"wall_seconds": 600, "threads": 1,
"commit": "abc"}}'
done
capture "$page"
expect_equal 'status without checks' "$status" 1
expect_contains "$output" 'checks.csv: not there; compare_cfd_dem --report --records writes it'
plant docs/results/study/checks.csv 'case,check,value,bar,outcome
matched-L4.10-coarse-resolved-seed1,liquid_mass_ledger,2e-05,1e-05,failed
matched-L4.10-coarse-resolved-seed1,momentum_audit,1e-08,1e-06,passed
matched-L4.10-coarse-resolved-seed1,solids_energy_ledger,,,absent
matched-L4.10-coarse-averaged-seed1,momentum_audit,1e-08,1e-06,passed'
plant docs/results/study/nearness.csv 'quantity,sweep,preset,flows,of_one_program,resolved_nearer,averaged_nearer,resolved_over_theirs,averaged_over_theirs
e_b,matched,coarse,10,4,7,3,0.08123,0.079
e_b,as_printed,coarse,9,1,2,6,0.5,0.4'
capture "$page"
expect_equal 'status' "$status" 0
expect_contains "$output" '| matched-L4.10-coarse-resolved-seed1 | 10.0 | 1 | abc | ? | liquid_mass_ledger 2e-05 (at most 1e-05), solids_energy_ledger absent |'
expect_contains "$output" '| matched-L4.10-coarse-averaged-seed1 | 10.0 | 1 | abc | ? | none |'
expect_contains "$output" 'Coarse cases took 10 min in the median (1 resolved 10 min, 1 averaged 10 min), 0.3 core hours in all'
expect_contains "$output" '## matched, which is nearer to the paper'
expect_contains "$output" '| `e_b` | coarse | 10 | 4 | 7 | 3 | 0.0812 | 0.079 |'
expect_lacks "$output" '| `e_b` | coarse | 9 |'
expect_contains "$output" '## matched, L = 4.10 m'
expect_contains "$output" '| `e_in` | kJ | 54.36 | 50 | 52.12 | 40 |'
expect_contains "$output" '| `depth` | m | - | 0.25 | - | 0.2 |'
expect_contains "$output" '| Quantity | matched-L4.10-coarse-resolved-seed1 against matched-L4.10-standard-resolved-seed1 |'
expect_contains "$output" '| `depth` | +25.0 |'
expect_lacks "$output" 'in all cases'
expect_lacks "$output" '## Over the flows'
expect_lacks "$output" 'momentum of the water'

# Strips have a table of their own, over seeds.
for case in resolved-seed1 resolved-seed2 averaged-seed1 averaged-seed2; do
  printf '%s\n' "e_in,kJ,matched-L4.10-strip-$case,,8,," >>"$scratch/tree/docs/results/study/comparison.csv"
  plant "docs/results/study/matched-L4.10-strip-$case.json" '{"summary": {"wall_seconds": 300, "threads": 1,
"commit": "abc"}}'
done
capture "$page"
expect_equal 'status without means over seeds' "$status" 1
plant docs/results/study/over_seeds.csv 'quantity,unit,sweep,preset,release_m,coupling,seeds,mean,deviation,change,change_error,commit
e_in,kJ,matched,strip,4.10,resolved,2,6.6602,0.0067,,,"abc"
e_in,kJ,matched,strip,4.10,averaged,2,6.767,0.005,0.016035,0.00089,"abc"'
capture "$page"
expect_equal 'status with strips' "$status" 0
expect_contains "$output" '4 runs of strips 0.3 m wide'
expect_contains "$output" '| Quantity | Unit | L = 4.10 m, resolved, 2 seeds | L = 4.10 m, averaged, 2 seeds |'
expect_contains "$output" '| `e_in` | kJ | 6.66 ± 0.0067 | 6.77 ± 0.005; +1.6 ± 0.1 % |'
expect_lacks "$output" '| matched-L4.10-strip-resolved-seed1 |'

plant docs/results/study/matched-L4.10-coarse-averaged_ergun-seed1.json "$(cat "$scratch/tree/docs/results/study/matched-L4.10-coarse-resolved-seed1.json")"
printf '%s\n' 'water_momentum,kNs,matched-L4.10-coarse-resolved-seed1,,2.251,,' \
  'water_momentum,kNs,matched-L4.10-coarse-averaged_ergun-seed1,,2.239,,' >>"$scratch/tree/docs/results/study/comparison.csv"
capture "$page"
expect_contains "$output" "## matched, momentum of the water: resolved; Ergun's; Di Felice's"
expect_contains "$output" '| `water_momentum` | kNs | 2.25; 2.24; - |'

plant docs/results/study/matched-L4.10-coarse-averaged_ergun-seed1.json '{"summary": {"wall_seconds": 1800, "threads": 2,
"commit": "def"}}'
printf '%s\n' 'net_impulse_grains,kNs,matched-L4.10-coarse-resolved-seed1,,20,,' \
  'net_impulse_grains,kNs,matched-L4.10-coarse-averaged-seed1,,19,,' \
  'net_impulse_grains,kNs,matched-L4.10-coarse-averaged_ergun-seed1,,18,,' >>"$scratch/tree/docs/results/study/comparison.csv"
sed -i 's/averaged-seed1,,,,/averaged-seed1,,0.24,,/' "$scratch/tree/docs/results/study/comparison.csv"
capture "$page"
expect_contains "$output" "what averaging over 0.15 m changes: Ergun's; Di Felice's"
expect_contains "$output" '| `net_impulse_grains` | (-10.0); -5.0 |'

expect_contains "$output" '| code of before | | ?; ? |'
expect_contains "$output" 'Coarse cases took 10 min in the median (1 resolved 10 min, 2 averaged 20 min), 1.3 core hours in all'

# Per cent of what is nearly 0 beside its row, or of another sign, says nothing.
printf '%s\n' 'froude_deepest,1,matched-L4.10-coarse-resolved-seed1,,2.5,,' \
  'froude_deepest,1,matched-L4.10-standard-resolved-seed1,,0.001,,' \
  'grains_impulse_water,kNs,matched-L4.10-coarse-resolved-seed1,,0.5,,' \
  'grains_impulse_water,kNs,matched-L4.10-coarse-averaged-seed1,,-0.2,,' \
  'grains_impulse_water,kNs,matched-L4.10-coarse-averaged_ergun-seed1,,0.4,,' \
  'water_momentum_made,kNs,matched-L4.10-coarse-resolved-seed1,,-0.1,,' \
  'water_momentum_made,kNs,matched-L4.10-standard-resolved-seed1,,0.2,,' >>"$scratch/tree/docs/results/study/comparison.csv"
capture "$page"
expect_contains "$output" '| `froude_deepest` | - |'
expect_contains "$output" '| `grains_impulse_water` | (-20.0); - |'
expect_contains "$output" '| `water_momentum_made` | - |'
expect_contains "$output" '| `depth` | +25.0 |'

plant docs/results/study/trends.csv 'trend,sweep,coupling,preset,flows,programs,measure,agrees
eta rises (4.4),matched,resolved,coarse,3,2,1.00,yes
eta rises (4.4),matched,averaged,coarse,4,1,-0.33,no
zeta falls (4.4),matched,resolved,coarse,0,0,nan,-
zeta falls (4.4),matched,averaged,coarse,3,1,-0.33,mostly'
plant docs/images/study/flows_zeta_lower.png ''
capture "$page"
expect_contains "$output" '## Over the flows'
expect_contains "$output" '![flows_zeta_lower](images/study/flows_zeta_lower.png)'
expect_lacks "$output" 'flows_e_b'
expect_lacks "$output" '## Pictures of'
plant docs/images/study/forces_000009.png ''
capture "$page"
expect_contains "$output" '![1.8 s](images/study/forces_000009.png)'
expect_lacks "$output" 'forces_000020'
expect_contains "$output" '| The paper | matched, resolved, coarse, 3 flows, 2 programs | matched, averaged, coarse, 4 flows, 1 programs |'
expect_contains "$output" '| eta rises (4.4) | 1.00, yes | -0.33, no |'
expect_contains "$output" '| zeta falls (4.4) | - | -0.33, mostly (3 flows) |'

capture "$page" one two
expect_equal 'status of a wrong command' "$status" 1
expect_contains "$output" 'Usage: tools/study_page'
