#!/usr/bin/env bash
# shellcheck source=tests/tools/assert.sh
. "$(dirname "${BASH_SOURCE[0]}")/assert.sh" "$1"

run_lint() { capture "$root/tools/check_tests_assert" "$scratch/tree"; }

# expect_refused NAME SOURCE: the test must be named with its place.
expect_refused() {
  clear_tree
  plant tests/a_test.cpp "$2"
  run_lint
  [ "$status" -eq 1 ] || fail "not refused (status $status): $2"
  expect_contains "$output" "$1 asserts nothing"
}

expect_allowed() {
  clear_tree
  plant tests/a_test.cpp "$1"
  run_lint
  [ "$status" -eq 0 ] || fail "refused: $1: $output"
}

expect_refused 'TEST(A, B)' 'TEST(A, B) { run(); }'
expect_refused 'TEST_F(A, B)' $'TEST(A, A) { EXPECT_TRUE(x); }\nTEST_F(A, B) { run(); }'
expect_refused 'TEST_P(A, B)' 'TEST_P(A, B) { if (x) { run(); } }'
expect_refused 'TYPED_TEST(A, B)' 'TYPED_TEST(A, B) {}'
expect_refused 'TEST(A, B)' $'TEST(A, B) {\n  // EXPECT_EQ(1, 1);\n  /* ASSERT_TRUE(x) */ run("EXPECT_EQ(");\n}'
expect_refused 'TEST(A, B)' $'TEST(A, B) { run(R"(EXPECT_EQ(1, 1) })"); }\nTEST(A, C) { EXPECT_EQ(1, 1); }'
expect_refused 'TEST(A, B)' $'void helper() { run(); }\nTEST(A, B) { helper(); }'

expect_allowed 'TEST(A, B) { EXPECT_EQ(1, 1); }'
expect_allowed $'TEST(A, B) {\n  for (int i : v) {\n    if (i) ASSERT_GT(i, 0);\n  }\n}'
expect_allowed $'void helper(int x) { EXPECT_GT(x, 0); }\nTEST(A, B) { helper(1); }'
expect_allowed $'void inner() { EXPECT_GT(1, 0); }\nvoid outer() { inner(); }\nTEST(A, B) { outer(); }'
expect_allowed $'void inner();\nvoid outer() { inner(); }\nvoid inner() { EXPECT_GT(1, 0); }\nTEST(A, B) { outer(); }'
expect_allowed $'template <class T>\nvoid helper() {\n  EXPECT_GT(T(1), 0);\n}\nTEST(A, B) { helper<int>(); }'
expect_allowed $'#define CHECK_ROW(x) \\\n  EXPECT_EQ(x, 1)\nTEST(A, B) { CHECK_ROW(1); }'
expect_allowed $'TEST(A, B) { run(\'{\', 1\'000, "}"); EXPECT_EQ(1, 1); }\nTEST(A, C) { EXPECT_EQ(1, 1); }'

expect_allowed $'void helper(const O& o = {}, int k = 0) {\n  EXPECT_GT(k, 0);\n}\nTEST(A, B) { helper(); }'
expect_allowed $'struct F {\n  void expect_one() { EXPECT_TRUE(x); }\n};\nTEST_F(F, B) { this->expect_one(); }'

# A name that asserts elsewhere, or of a member of something else, is none of this test.
clear_tree
plant tests/b_test.cpp $'struct S {\n  void step() { EXPECT_TRUE(x); }\n};\nTEST(B, A) { EXPECT_TRUE(x); }'
plant tests/a_test.cpp 'TEST(A, B) { f.step(); }'
run_lint
expect_equal 'status with a helper in another file' "$status" 1
plant tests/a_test.cpp 'TEST(A, B) { step(); }'
run_lint
expect_equal 'status with a function of that name' "$status" 1
expect_refused 'TEST(A, B)' $'void step() { EXPECT_TRUE(x); }\nTEST(A, B) { f.step(); }'

# A helper may stand in a header of the tests.
clear_tree
plant tests/properties/law.h 'inline void expect_law() { EXPECT_EQ(1, 1); }'
plant tests/dem/a_test.cpp 'TEST(A, B) { expect_law(); }'
run_lint
expect_equal 'status with a helper in a header' "$status" 0

# The place is that of the test.
clear_tree
plant tests/a_test.cpp $'#include <x>\n\nTEST(A, B) { EXPECT_TRUE(x); }\nTEST(A, C) {\n  run();\n}'
run_lint
expect_contains "$output" 'tests/a_test.cpp:4: TEST(A, C) asserts nothing'
