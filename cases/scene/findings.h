#pragma once
// What reading a scene brings to light: where each value stands, what is wrong, and which values are not to be trusted.
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "cases/scene/document.h"
#include "core/check.h"

namespace lahar::scene {

class Findings {
 public:
  explicit Findings(std::string file) : file_(std::move(file)) {}

  /// Notes where the value of a path stands.
  void locate(const std::string& path, Place place) { places_[path] = std::move(place); }
  /// The place of a path, or of the nearest table around it that is written somewhere.
  [[nodiscard]] Place place(std::string path) const;
  /// Adds a mistake; its path is from now on not sound.
  void mistake(const std::string& path, std::string message);
  /// The same where `others` have a part in it: told where the first of all stands that the command line or
  /// scene.changes set, else the first that is written.
  void mistake(const std::string& path, std::string message, const std::vector<std::string>& others);
  void mistake_at(const Place& place, std::string message);
  /// What another mistake kept from being read: not sound, without a mistake of its own.
  void not_read(const std::string& path) { unsound_.insert(path); }
  /// Whether the values of all these paths, and everything inside them, were read without a mistake.
  [[nodiscard]] bool sound(const std::vector<std::string>& paths) const;
  /// All mistakes, by file and line.
  [[nodiscard]] std::vector<InputMistake> mistakes() const;
  /// Throws InputError with all of them if there are any.
  void raise() const;

 private:
  std::string file_;
  std::map<std::string, Place> places_;
  std::set<std::string, std::less<>> unsound_;
  std::vector<InputMistake> mistakes_;
};

}  // namespace lahar::scene
