#include "cases/files/checkpoint_file.h"

#include <algorithm>
#include <cstdio>

namespace lahar::cases {

void CheckSum::add(const void* data, std::size_t bytes) {
  const auto* byte = static_cast<const unsigned char*>(data);
  std::uint64_t sum = sum_;
  for (std::size_t k = 0; k < bytes; ++k) sum = (sum ^ byte[k]) * 0x100000001b3U;
  sum_ = sum;
}

std::string CheckSum::text() const {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(sum_));
  return text;
}

CheckpointWriter::CheckpointWriter(const std::filesystem::path& path)
    : Archive(Direction::save), file_(Hdf5File::create(path)) {}

std::size_t CheckpointWriter::begin(const std::string& path, Number type, std::size_t count) {
  name_ = "/" + path;
  type_ = type;
  sum_ = {};
  list_.emplace(file_.create_parts(name_, type, count));
  return count;
}

void CheckpointWriter::pass(void* data, std::size_t count) {
  sum_.add(data, count * bytes_of(type_));
  list_->write(data, count);
}

void CheckpointWriter::end() {
  list_->flush();
  list_.reset();
  file_.set_attribute(name_, "check", sum_.text());
}

CheckpointReader::CheckpointReader(const std::filesystem::path& path)
    : Archive(Direction::load), file_(Hdf5File::open_for_reading(path)) {}

std::size_t CheckpointReader::begin(const std::string& path, Number type, std::size_t) {
  const std::string name = "/" + path;
  verify(name, type);
  list_.emplace(file_.open_parts(name, type));
  return list_->count();
}

void CheckpointReader::verify(const std::string& name, Number type) const {
  Hdf5Parts list = file_.open_parts(name, type);
  std::vector<unsigned char> buffer(std::size_t{1} << 20);
  const std::uint64_t at_once = buffer.size() / bytes_of(type);
  CheckSum sum;
  for (std::uint64_t left = list.count(); left > 0;) {
    const std::uint64_t now = std::min(left, at_once);
    list.read(buffer.data(), now);
    sum.add(buffer.data(), now * bytes_of(type));
    left -= now;
  }
  if (sum.text() != file_.text_attribute(name, "check")) throw ArchiveError(name + " does not have its check sum");
}

void CheckpointReader::pass(void* data, std::size_t count) { list_->read(data, count); }

}  // namespace lahar::cases
