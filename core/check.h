#pragma once
// Three kinds of check:
//   lahar::require     a violated invariant or wrong argument; always on, cheap
//   InputError         bad input of the user: every mistake with file:line:column (exit code 2)
//   NumericalFailure   numbers went wrong during a run: place, step and cause (exit code 3)
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace lahar {

/// One mistake in the user's input, with the place where it stands (line and column start at 1; 0 means unknown).
struct InputMistake {
  std::string file;
  int line = 0;
  int column = 0;
  std::string message;

  /// `file:line:column: message`
  [[nodiscard]] std::string text() const {
    return file + ":" + std::to_string(line) + ":" + std::to_string(column) + ": " + message;
  }
};

/// Bad input. Carries all mistakes that were found, so that the user mends them in one go.
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::vector<InputMistake> mistakes)
      : std::runtime_error(join(mistakes)), mistakes_(std::move(mistakes)) {}
  explicit InputError(const std::string& message) : InputError(std::vector<InputMistake>{{"input", 0, 0, message}}) {}
  [[nodiscard]] const std::vector<InputMistake>& mistakes() const { return mistakes_; }

 private:
  static std::string join(const std::vector<InputMistake>& mistakes) {
    std::string all;
    for (const auto& m : mistakes) {
      if (!all.empty()) all += '\n';
      all += m.text();
    }
    return all;
  }
  std::vector<InputMistake> mistakes_;
};

/// Numbers that went wrong: not a number, too fast, overlap beyond reason. `where` names the cell or particle.
class NumericalFailure : public std::runtime_error {
 public:
  NumericalFailure(std::string where, std::int64_t step, std::string cause)
      : std::runtime_error(where + ", step " + std::to_string(step) + ": " + cause),
        where_(std::move(where)),
        cause_(std::move(cause)),
        step_(step) {}
  [[nodiscard]] const std::string& where() const { return where_; }
  [[nodiscard]] const std::string& cause() const { return cause_; }
  [[nodiscard]] std::int64_t step() const { return step_; }

 private:
  std::string where_, cause_;
  std::int64_t step_;
};

/// Throws std::logic_error if an invariant does not hold.
inline void require(bool condition, const char* message) {
  if (!condition) throw std::logic_error(message);
}

}  // namespace lahar
