#include "monitor/failure.hpp"

#include <string>

namespace gyrod::monitor {
namespace {

std::string json_text(std::string_view words) {
  std::string text = "\"";
  for (const char c : words) {
    if (c == '"' || c == '\\') text += '\\';
    text += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
  }
  return text + '"';
}

}  // namespace

Answer failure(int status, std::string_view path, std::string_view words) {
  if (!path.starts_with("/api/")) return {.status = status, .body = std::string(words) + "\n"};
  return {
      .status = status, .content_type = "application/json", .body = "{\"error\":" + json_text(words) + "}\n"};
}

}  // namespace gyrod::monitor
