#include "cases/files/growing_file.h"

#include <algorithm>
#include <system_error>

#include "cases/files/output_file.h"

namespace lahar::cases {

namespace {

constexpr std::chrono::seconds kLeastInterval{1};
constexpr std::chrono::seconds kAfterRefusal{60};
constexpr int kCopyTimes = 50;  // from one copy to the next, over the time that it takes

void copy_bytes(const std::filesystem::path& from, const std::filesystem::path& to) {
  std::error_code error;
  std::filesystem::copy_file(from, to, std::filesystem::copy_options::overwrite_existing, error);
  if (error) throw FileError(to, "cannot be written: " + error.message());
}

void move_to(const std::filesystem::path& from, const std::filesystem::path& to) {
  std::error_code error;
  std::filesystem::rename(from, to, error);
  if (error) throw FileError(to, "cannot be replaced: " + error.message());
}

}  // namespace

std::filesystem::path GrowingFile::open_name() const {
  std::filesystem::path open = name_;
  return open += ".open";
}

void GrowingFile::take_up() const {
  if (!std::filesystem::exists(name_)) throw FileError(name_, "there is no such file");
  try {
    copy_bytes(name_, open_name());
  } catch (const FileError& e) {
    std::error_code ignored;
    std::filesystem::remove(open_name(), ignored);
    throw CannotTakeUp(name_, std::string("cannot be copied to go on with (") + e.what() + ")");
  }
}

void GrowingFile::copy() {
  const Clock::time_point start = Clock::now();
  try {
    replace_file(name_, [&](const std::filesystem::path& next) { copy_bytes(open_name(), next); });
  } catch (const FileError& e) {
    next_copy_ = Clock::now() + kAfterRefusal;
    throw CannotCopy(name_,
                     std::string("cannot be brought up to date with ") + open_name().string() + " (" + e.what() + ")");
  }
  const Clock::time_point end = Clock::now();
  next_copy_ = end + std::max<Clock::duration>(kLeastInterval, kCopyTimes * (end - start));
}

void GrowingFile::copy_if_due(const std::function<void()>& flush) {
  if (!copy_due()) return;
  try {
    flush();
    refusal_.clear();
  } catch (const CannotCopy& e) {
    refusal_ = e.what();
  }
}

void GrowingFile::finish() const { move_to(open_name(), name_); }

std::filesystem::path GrowingFile::set_aside() const {
  if (!std::filesystem::exists(name_)) return {};
  const auto aside_name = [&](const std::string& number) {
    std::filesystem::path aside = name_;
    return aside.replace_extension(".damaged" + number + name_.extension().string());
  };
  std::filesystem::path aside = aside_name("");
  for (int k = 2; std::filesystem::exists(aside); ++k) aside = aside_name(std::to_string(k));
  move_to(name_, aside);
  return aside;
}

}  // namespace lahar::cases
