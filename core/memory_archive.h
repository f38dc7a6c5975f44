#pragma once
// A state in memory: what two runs compare by, bit for bit.
#include <cstring>

#include "core/archive.h"

namespace lahar {

/// The numbers of a state by their names.
struct StoredState {
  struct List {
    Archive::Number type;
    std::size_t count = 0;
    std::vector<std::uint8_t> bytes;
    bool operator==(const List&) const = default;
  };
  std::map<std::string, List> lists;

  [[nodiscard]] std::size_t bytes() const {
    std::size_t sum = 0;
    for (const auto& [name, list] : lists) sum += list.bytes.size();
    return sum;
  }
};

/// Names of the lists that differ in any bit, or that only one of the two has.
inline std::vector<std::string> differing_lists(const StoredState& a, const StoredState& b) {
  std::vector<std::string> names;
  for (const auto& [name, list] : a.lists)
    if (const auto other = b.lists.find(name); other == b.lists.end() || !(other->second == list))
      names.push_back(name);
  for (const auto& [name, list] : b.lists)
    if (!a.lists.contains(name)) names.push_back(name);
  return names;
}

class MemoryArchive : public Archive {
 public:
  MemoryArchive(Direction direction, StoredState& state) : Archive(direction), state_(state) {}

 protected:
  std::size_t begin(const std::string& path, Number type, std::size_t count) override {
    at_ = 0;
    if (!loading()) {
      const auto [place, fresh] = state_.lists.try_emplace(path, StoredState::List{type, count, {}});
      if (!fresh) throw std::logic_error("two lists of a state are called " + path);
      list_ = &place->second;
      return count;
    }
    const auto found = state_.lists.find(path);
    if (found == state_.lists.end()) throw ArchiveError(path + " is missing");
    list_ = &found->second;
    if (list_->type != type) throw ArchiveError(path + " is of another kind");
    return list_->count;
  }
  void pass(void* data, std::size_t count) override {
    const std::size_t bytes = count * bytes_of(list_->type);
    if (!loading()) list_->bytes.resize(at_ + bytes);
    if (loading())
      std::memcpy(data, list_->bytes.data() + at_, bytes);
    else
      std::memcpy(list_->bytes.data() + at_, data, bytes);
    at_ += bytes;
  }
  void end() override {}

 private:
  StoredState& state_;
  StoredState::List* list_ = nullptr;
  std::size_t at_ = 0;
};

/// The state of an owner.
template <class Owner>
StoredState state_of(Owner& owner) {
  StoredState state;
  MemoryArchive archive(Archive::Direction::save, state);
  owner.transfer(archive);
  return state;
}

/// Puts a state into an owner of the same scene.
template <class Owner>
void load_state(StoredState& state, Owner& owner) {
  MemoryArchive archive(Archive::Direction::load, state);
  owner.transfer(archive);
}

}  // namespace lahar
