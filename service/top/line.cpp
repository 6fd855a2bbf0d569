#include "top/line.hpp"

#include "top/printable.hpp"

namespace gyrod::top {
namespace {

std::string code_of(Look look, bool coloured) {
  std::string code;
  switch (look.weight) {
    case Weight::kBold:
      code += ";1";
      break;
    case Weight::kFaint:
      code += ";2";
      break;
    case Weight::kInverse:
      code += ";7";
      break;
    case Weight::kNormal:
      break;
  }
  if (coloured && look.colour >= 0) code += ";38;5;" + std::to_string(look.colour);
  return "\x1b[0" + code + "m";
}

}  // namespace

Line& Line::add(std::string_view text, Look look) {
  if (!text.empty()) words_.push_back({printable(text, text.size()), look});
  return *this;
}

Line& Line::add_left(std::string_view text, std::size_t width, Look look) {
  std::string cell(text.substr(0, width));
  cell.resize(width, ' ');
  return add(cell, look);
}

Line& Line::add_right(std::string_view text, std::size_t width, Look look) {
  const std::string_view cut = text.substr(0, width);
  return add(std::string(width - cut.size(), ' ').append(cut), look);
}

std::string Line::plain(std::size_t width) const {
  std::string text;
  for (const Word& word : words_) text += word.text;
  return text.substr(0, width);
}

std::string Line::painted(std::size_t width, bool coloured) const {
  std::string text;
  for (const Word& word : words_) {
    if (width == 0) break;
    const std::string_view part = std::string_view(word.text).substr(0, width);
    text += code_of(word.look, coloured);
    text += part;
    width -= part.size();
  }
  return text + code_of({}, coloured);
}

void Line::set_look(Look look) {
  for (Word& word : words_) word.look = look;
}

}  // namespace gyrod::top
