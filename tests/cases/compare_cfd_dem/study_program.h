#pragma once
// The executable of the study, as a user runs it.
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace lahar::study {

/// Exit code of the executable, whose messages go into a file, as does what it prints.
inline int run_study(const std::string& arguments, const std::filesystem::path& messages,
                     const std::filesystem::path& printed = "/dev/null") {
  const int status = std::system(("'" LAHAR_STUDIES "/compare_cfd_dem' " + arguments + " > '" + printed.string() +
                                  "' 2> '" + messages.string() + "'")
                                     .c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

inline std::string content_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

}  // namespace lahar::study
