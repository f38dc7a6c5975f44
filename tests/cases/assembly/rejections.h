#pragma once
// One change to a good scene, and the one mistake that it must cause.
#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

#include "tests/cases/scene/scene_files.h"

namespace lahar::scene {

struct Rejection {
  std::vector<std::string> set;  ///< changes, each a --set
  std::string path;              ///< the message starts with it
  std::string part;              ///< of the message
  friend std::ostream& operator<<(std::ostream& out, const Rejection& r) {
    return out << testing::PrintToString(r.set);
  }
};

/// Exactly one mistake, which begins with the path and contains the part.
inline void expect_rejection(const std::filesystem::path& file, const Rejection& r) {
  const auto all = mistakes_in(file, r.set);
  ASSERT_EQ(all.size(), 1u) << testing::PrintToString(all);
  EXPECT_NE(all[0].find(": " + r.path), std::string::npos) << all[0];
  EXPECT_NE(all[0].find(r.part), std::string::npos) << all[0];
}

}  // namespace lahar::scene
