#!/usr/bin/env bash
# shellcheck source=tests/tools/assert.sh
. "$(dirname "${BASH_SOURCE[0]}")/assert.sh" "$1"
needs python3

page() { capture "$root/tools/results_page" --root "$scratch/tree" "$@"; }
text() { cat "$scratch/tree/docs/results.md"; }

# row LABEL VALUE ERROR TOLERANCE PASS
row() {
  printf '{"label": "%s", "value": %s, "reference": 1, "error": %s, "tolerance": %s, "pass": %s}' "$@"
}

# results COMMIT ENTRY[, ENTRY]...
results() {
  printf '{"machine": "a machine", "commit": "%s", "quick": false, "entries": [%s]}' "$1" "$2"
}

clear_tree
plant cases/validate/entries.txt $'# remark\nfluid/first\nfluid/second    old.second\nbarrier/post'
plant first.json "$(results aaa "{\"name\": \"fluid.first\", \"pass\": true, \"seconds\": 12.4, \"source\": \"theory\",
  \"rows\": [$(row 'speed a|b, lu' 1.02 0.02 0.05 true)]}")"
plant both.json "$(results bbb "{\"name\": \"fluid.second\", \"pass\": false, \"seconds\": 3, \"source\": \"a book\",
  \"failure\": \"went wrong\", \"rows\": [$(row depth null null 0.1 false), $(row width 1 0 0.1 true)]},
  {\"name\": \"fluid.first\", \"pass\": true, \"seconds\": 9, \"source\": \"theory\",
  \"rows\": [$(row 'speed a|b, lu' 1.01 0.01 0.05 true)]}")"
plant benchmark.json '{"machine": {"name": "a machine", "stream_gb_s_1": 20.04, "stream_gb_s_all": 40},
  "commit": "ccc", "entries": [{"name": "fluid.plain", "value": 150.26, "unit": "MLUPS", "ratio": 0.7,
  "against": "stream", "bar": 0.65, "at_least": true, "pass": true}]}'

page "$scratch/tree/first.json"
expect_equal 'status' "$status" 0
# shellcheck disable=SC2016  # the backquotes are Markdown's
expect_contains "$(text)" '| **`fluid.first`** theory; 12 s, aaa |  |  |  |  | 1 of 1 |'
expect_contains "$(text)" '| speed a\|b, lu | 1.02 | 1 | 0.02 | 0.05 | yes |'
# shellcheck disable=SC2016
expect_contains "$(text)" 'Without a result: `fluid.second`.'

# A later run replaces its entries and keeps the others; the order is that of the ladder.
page "$scratch/tree/both.json" "$scratch/tree/benchmark.json"
expect_equal 'status' "$status" 0
expect_contains "$(text)" '| speed a\|b, lu | 1.01 | 1 | 0.01 | 0.05 | yes |'
case "$(text)" in *'1.02'*) fail 'the replaced figure is still there' ;; esac
# shellcheck disable=SC2016
expect_contains "$(text)" '| **`fluid.second`** a book; 3 s, bbb; stopped: went wrong |  |  |  |  | **1 of 2** |'
expect_contains "$(text)" '| depth | - | 1 | - | 0.1 | **no** |'
expect_contains "$(text)" '1 of 2 entries reach all of their bars'
# shellcheck disable=SC2016
expect_contains "$(text)" '| `fluid.plain` | 150.3 MLUPS | 0.7 | stream | >= 0.65 | yes |'
expect_contains "$(text)" 'a machine, stream 20.0 GB/s on one thread, 40.0 GB/s on all, commit ccc: 1 entry'
# shellcheck disable=SC2016
expect_equal 'order of the entries' "$(grep -o '`fluid\.[a-z]*`\*\*' "$scratch/tree/docs/results.md" | tr -d '\n')" \
  '`fluid.first`**`fluid.second`**'

# The page is made from the store alone, the same every time.
before="$(text)"
page
expect_equal 'page written again' "$(text)" "$before"

# Hard cases: which entries reach all their rows, and what lies farthest from its bar. The list has all its cases.
plant cases/validate/reference/hard_cases.csv $'# note\nid,case,pass\nH1,"A splash, wet",none lost\nH2,Snow,none'
plant cases/hard_cases/hard_cases.cpp '{{"H1", {"fluid.first", "fluid.second"}}, {"H2", {"fluid.first"}}}
  {{"L1",
    "Oil, here",
    "it floats",
    {"fluid.first", "barrier.post"}}}'
page
expect_equal 'status with hard cases' "$status" 0
# shellcheck disable=SC2016
expect_contains "$(text)" \
  '| H1 | A splash, wet | `fluid.first`, `fluid.second` | 2 of 3 | 12 | **no** | `fluid.second` stopped: went wrong |'
# shellcheck disable=SC2016
expect_contains "$(text)" '| H2 | Snow | `fluid.first` | 1 of 1 | 9 | yes |  |'
# shellcheck disable=SC2016
expect_contains "$(text)" '| L1 | Oil, here | `fluid.first`, `barrier.post` | 1 of 1 | 9 | **no** | not all were run |'
expect_contains "$(text)" '1 of 2 of the list, 0 of 1 of those found here'
plant shorter.json "$(results bbb "{\"name\": \"fluid.second\", \"pass\": false, \"seconds\": 3, \"source\": \"a book\",
  \"rows\": [$(row depth 1.2 0.2 0.1 false), $(row width 1.9 0.9 0.5 false)]}")"
page "$scratch/tree/shorter.json"
# shellcheck disable=SC2016
expect_contains "$(text)" '| 1 of 3 | 12 | **no** | depth: 1.2, error 0.2, bar 0.1 |'
plant cases/hard_cases/hard_cases.cpp '{{"H1", {"fluid.first"}}}'
page
expect_equal 'status of a case that has no entries' "$status" 1
expect_contains "$output" 'no entries for H2'
rm -r "$scratch/tree/cases/hard_cases"
page "$scratch/tree/both.json"
expect_equal 'page without hard cases' "$(text)" "$before"

# What does not belong there is refused, and the store stays as it was.
plant quick.json "$(results ddd '' | sed 's/"quick": false/"quick": true/')"
page "$scratch/tree/quick.json"
expect_equal 'status of quick results' "$status" 1
expect_contains "$output" 'quick'
plant float.json "$(results ddd '' | sed 's/"quick": false/"quick": false, "precision": "float"/')"
page "$scratch/tree/float.json"
expect_equal 'status of results in float' "$status" 1
expect_contains "$output" 'precision'
plant unknown.json "$(results eee '{"name": "fluid.third", "rows": [], "pass": true, "seconds": 1, "source": "x"}')"
page "$scratch/tree/unknown.json"
expect_equal 'status of an unknown entry' "$status" 1
expect_contains "$output" 'fluid.third is not in cases/validate/entries.txt'
plant broken.json '{"entries": ['
page "$scratch/tree/broken.json"
expect_equal 'status of a broken file' "$status" 1
expect_equal 'page after refusals' "$(text)" "$before"

# A group without a section of its own would be counted and shown nowhere.
plant cases/validate/entries.txt $'fluid/first\nsnow/flake'
page
expect_equal 'status of a group without a section' "$status" 1
expect_contains "$output" 'snow.flake'
