#pragma once
// What a program tells its user beside its results.
#include <cstdio>
#include <string>

namespace lahar::cases {

/// Writes to standard error. Where that is closed or full the text is lost, and nothing else happens.
inline void tell(const std::string& text) { std::fputs(text.c_str(), stderr); }

}  // namespace lahar::cases
