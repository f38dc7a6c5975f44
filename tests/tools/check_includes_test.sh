#!/usr/bin/env bash
# shellcheck source=tests/tools/assert.sh
. "$(dirname "${BASH_SOURCE[0]}")/assert.sh" "$1"

# expect_refused PATH LINE WORD: one planted line must be found, with its place.
expect_refused() {
  clear_tree
  plant core/vector.h '#include <vector>'
  plant "$1" "$2"
  capture "$root/tools/check_includes" "$scratch/tree"
  [ "$status" -eq 1 ] || fail "not refused (status $status): $2 in $1"
  expect_contains "$output" "$1:1: "
  expect_contains "$output" "$3"
}

expect_allowed() {
  clear_tree
  plant "$1" "$2"
  capture "$root/tools/check_includes" "$scratch/tree"
  [ "$status" -eq 0 ] || fail "refused: $2 in $1: $output"
}

# Every edge between rooms, allowed or not.
declare -A allowed=([core]='' [lbm]='core' [dem]='core' [barrier]='core dem' [coupling]='core lbm dem barrier'
  [cases]='core lbm dem barrier coupling' [tests]='core lbm dem barrier coupling cases')
for from in "${!allowed[@]}"; do
  for to in core lbm dem barrier coupling cases; do
    case " ${allowed[$from]} $from " in
      *" $to "*) expect_allowed "$from/a.h" "#include \"$to/b.h\"" ;;
      *) expect_refused "$from/a.h" "#include \"$to/b.h\"" "$from must not include $to" ;;
    esac
  done
done

# The line may be written in other ways and stand deeper in the room.
expect_refused lbm/collision/bgk.cpp '  #  include "dem/particles.h"  // grains' 'lbm must not include dem'
expect_refused dem/contact/hertz.h '#include "../../lbm/fluid.h"' 'path from the root'
expect_refused dem/contact/hertz.h '#include "linear.h"' 'path from the root'

expect_refused dem/a.h '#include <lbm/step/fluid.h>' 'dem must not include lbm'
expect_refused core/units.h '#include <tbb/parallel_for.h>' 'tbb/parallel_for.h'

# Folders of cases: scene to solver runs one way.
expect_refused cases/scene/reader.cpp '#include "cases/assembly/build.h"' 'cases/scene must not include cases/assembly'
expect_refused cases/assembly/build.cpp '#include "cases/observers/flow.h"' 'cases/assembly must not include cases/observers'
expect_refused cases/observers/flow.h '#include "cases/runner/run.h"' 'cases/observers must not include cases/runner'
expect_refused cases/files/png_file.h '#include "cases/pictures/colour.h"' 'cases/files must not include cases/pictures'
expect_allowed cases/pictures/chart.cpp '#include "cases/files/png_file.h"'
expect_allowed cases/assembly/build.cpp '#include "cases/scene/scene.h"'
expect_allowed cases/runner/run.cpp '#include "cases/observers/flow.h"'
expect_allowed cases/validate/entry.cpp '#include "cases/runner/run.h"'

expect_refused coupling/audit.cpp '#include <openvdb/openvdb.h>' 'openvdb/openvdb.h'
expect_refused cases/scene/scene.cpp '#include <openvdb/openvdb.h>' 'openvdb/openvdb.h'
expect_allowed cases/files/vdb_writer.cpp '#include <openvdb/openvdb.h>'
expect_allowed lbm/grid/block_topology.cpp '#include <openvdb/openvdb.h>'
expect_refused barrier/net.cpp '#include <hdf5.h>' 'hdf5.h'
expect_refused core/units.h '#include <toml++/toml.h>' 'toml++/toml.h'
expect_refused dem/solids.cpp '#include <tbb/parallel_for.h>' 'tbb/parallel_for.h'
expect_refused core/parallel.h '#include <omp.h>' 'omp.h'
expect_allowed cases/files/series.cpp '#include <hdf5.h>'
expect_allowed core/parallel.h '#include <tbb/parallel_for.h>'

# What is not an include is no include.
expect_allowed core/vector.h '// #include "lbm/step/fluid.h"'
