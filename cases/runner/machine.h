#pragma once
// Who computed it, and with what.
#include <cstdint>
#include <string>

namespace lahar::cases {

/// "0.1.0"
std::string version();
/// The commit of the sources that were built, with "-dirty" behind it where they differed from it; "unknown" outside a
/// repository (cmake/write_commit.cmake).
std::string commit();
/// Processor and number of hardware threads: "Intel(R) Xeon(R) ... , 2 threads".
std::string machine_name();
/// Largest resident memory of this process so far, bytes.
std::uint64_t peak_rss_bytes();

}  // namespace lahar::cases
