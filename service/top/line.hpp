/// A line of a terminal: words that have a look, never wider than the terminal.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace gyrod::top {

enum class Weight { kNormal, kBold, kFaint, kInverse };

struct Look {
  Weight weight = Weight::kNormal;
  int colour = -1;  ///< of 256; -1: the terminal's own
};

class Line {
 public:
  /// Appends text, of which what is not printable shows as '?'.
  Line& add(std::string_view text, Look look = {});
  /// Appends text in a column of so many characters, cut, or filled up on its right or, for numbers, left.
  Line& add_left(std::string_view text, std::size_t width, Look look = {});
  Line& add_right(std::string_view text, std::size_t width, Look look = {});

  /// Its text, cut to `width`, without looks.
  [[nodiscard]] std::string plain(std::size_t width) const;
  /// The same with the codes of its looks, the normal look at its end; without colour where `coloured` is false, which leaves bold, faint
  /// and inverse.
  [[nodiscard]] std::string painted(std::size_t width, bool coloured) const;
  /// One look for all of it, e.g. of the row that is chosen.
  void set_look(Look look);

 private:
  struct Word {
    std::string text;
    Look look;
  };
  std::vector<Word> words_;
};

}  // namespace gyrod::top
