#!/usr/bin/env bash
# shellcheck source=tests/tools/assert.sh
. "$(dirname "${BASH_SOURCE[0]}")/assert.sh" "$1"
needs python3

clear_tree
plant study.csv '# a machine, 2 of its threads used, commit abc, 2020-02-29, full form
problem,trial,error,seconds,time,beaten_by,front,failure
vortex,defaults,0.00123456,2,4,2,false,
vortex,"cells 8, steps 2",0.0005,1,2,0.5,true,
vortex,cells 1,nan,nan,nan,0,false,"too coarse, really"
column,defaults,0.1,1,2,0,true,'
capture "$root/tools/speed_error_page" "$scratch/tree/study.csv"
expect_equal 'status' "$status" 0
expect_contains "$output" 'a machine, 2 of its threads used, commit abc, 2020-02-29, full form.'
expect_contains "$output" '## vortex'
expect_contains "$output" '| defaults | 0.00123 | 4 | 2 |'
expect_contains "$output" '| **cells 8, steps 2** | 0.0005 | 2 | on the front |'
expect_contains "$output" '| cells 1 | - | - | too coarse, really |'
expect_contains "$output" '| **defaults** | 0.1 | 2 | on the front |'

plant other.csv 'problem,trial'
capture "$root/tools/speed_error_page" "$scratch/tree/other.csv"
expect_equal 'status of another table' "$status" 1
expect_contains "$output" 'other.csv: no table of bin/speed_error'
capture "$root/tools/speed_error_page" "$scratch/tree/none.csv"
expect_equal 'status without a file' "$status" 1
expect_contains "$output" 'none.csv: No such file'
