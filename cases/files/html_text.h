#pragma once
// Text inside pages.
#include <string>

namespace lahar::cases {

/// With `&`, `<`, `>` and `"` as HTML writes them.
[[nodiscard]] inline std::string html_text(const std::string& text) {
  std::string html;
  for (const char c : text) {
    if (c == '&')
      html += "&amp;";
    else if (c == '<')
      html += "&lt;";
    else if (c == '>')
      html += "&gt;";
    else if (c == '"')
      html += "&quot;";
    else
      html += c;
  }
  return html;
}

}  // namespace lahar::cases
