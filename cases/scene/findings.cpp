#include "cases/scene/findings.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <tuple>

namespace lahar::scene {

Place Findings::place(std::string path) const {
  while (true) {
    if (const auto found = places_.find(path); found != places_.end()) return found->second;
    const std::size_t cut = path.find_last_of(".[");
    if (cut == std::string::npos) return {file_};
    path.resize(cut);
  }
}

void Findings::mistake(const std::string& path, std::string message) {
  unsound_.insert(path);
  mistake_at(place(path), std::move(message));
}

void Findings::mistake(const std::string& path, std::string message, const std::vector<std::string>& others) {
  unsound_.insert(path);
  const auto first = [&](const auto& wanted) -> const Place* {
    const auto place_where_wanted = [&](const std::string& p) -> const Place* {
      const auto found = places_.find(p);
      return found != places_.end() && wanted(found->second) ? &found->second : nullptr;
    };
    if (const Place* own = place_where_wanted(path)) return own;
    for (const std::string& other : others)
      if (const Place* at = place_where_wanted(other)) return at;
    return nullptr;
  };
  const Place* at = first([](const Place& p) { return source_file(p) != p.file; });
  if (!at) at = first([](const Place&) { return true; });
  mistake_at(at ? *at : place(path), std::move(message));
}

void Findings::mistake_at(const Place& place, std::string message) {
  mistakes_.push_back({place.file, place.line, place.column, std::move(message)});
}

bool Findings::sound(const std::vector<std::string>& paths) const {
  // Neither the path itself, nor anything inside it, nor a table around it may be unsound.
  const auto around_is_unsound = [&](std::string_view path) {
    for (std::size_t k = 0; k < path.size(); ++k)
      if ((path[k] == '.' || path[k] == '[') && unsound_.contains(path.substr(0, k))) return true;
    return false;
  };
  const auto some_inside_is_unsound = [&](const std::string& path) {
    return std::ranges::any_of(std::array{'.', '['}, [&](char mark) {
      const std::string first = path + mark;
      const auto next = unsound_.lower_bound(first);
      return next != unsound_.end() && next->starts_with(first);
    });
  };
  return std::ranges::none_of(paths, [&](const std::string& path) {
    return unsound_.contains(path) || around_is_unsound(path) || some_inside_is_unsound(path);
  });
}

std::vector<InputMistake> Findings::mistakes() const {
  std::vector<InputMistake> sorted = mistakes_;
  std::stable_sort(sorted.begin(), sorted.end(), [](const InputMistake& a, const InputMistake& b) {
    return std::tie(a.file, a.line, a.column) < std::tie(b.file, b.line, b.column);
  });
  return sorted;
}

void Findings::raise() const {
  if (!mistakes_.empty()) throw InputError(mistakes());
}

}  // namespace lahar::scene
