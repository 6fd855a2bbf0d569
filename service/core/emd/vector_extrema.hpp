// Extrema of the vector kernels: rises and falls as bits, 64 samples a word, so that the search branches once
// a word and not once a sample. Included as vector_lanes.hpp is.
namespace gyrod::core::GYROD_KERNEL {

/// Marks where the signal rises and falls. With kSubtract it takes the mean of the envelopes off first, in
/// the same pass: the signal is then read once a sift. Each block also computes its right neighbour's first
/// sample, which costs less than passing it on.
template <bool kSubtract>
void compare_neighbours(SiftWorkspace& ws) noexcept {
  double* const signal = ws.signal.data();
  const double* const mean = ws.mean.data();
  const auto value = [signal, mean](std::size_t i) noexcept {
    return kSubtract ? load(signal + i) - load(mean + i) : load(signal + i);
  };
  for (std::size_t word = 0; 64 * word < ws.size; ++word) {
    std::uint64_t rises = 0;
    std::uint64_t falls = 0;
    for (std::size_t bit = 0; bit < 64; bit += kLanes) {
      const std::size_t i = 64 * word + bit;
      const Lanes here = value(i);
      const Lanes next = value(i + 1);
      if constexpr (kSubtract) {
        store(signal + i, here);
      }
      rises |= greater(next, here) << bit;
      falls |= greater(here, next) << bit;
    }
    ws.rises[word] = rises;
    ws.falls[word] = falls;
  }
}

/// Walks through the words of rises and falls and writes down where one follows the other.
class ExtremaCollector {
 public:
  explicit ExtremaCollector(SiftWorkspace& ws) noexcept
      : out_(ws.extrema.position2.data() + Extrema::kMaxAdded),
        is_moving_((ws.rises[0] | ws.falls[0]) & 1U),
        is_rising_(ws.rises[0] & 1U) {}

  /// @param from  sample of bit 0
  /// @param valid bits that are differences of the signal
  void add_word(std::size_t from, std::uint64_t rises, std::uint64_t falls, std::uint64_t valid) noexcept {
    rises &= valid;
    falls &= valid;
    if ((rises | falls) == valid && is_moving_ && flat_from_ == from) {
      add_moving(from, rises, valid);
    } else {
      add_with_flats(from, rises, rises | falls);
    }
  }

  [[nodiscard]] const std::int32_t* end() const noexcept { return out_; }

 private:
  /// Without equal neighbours, the extrema are where the direction bit changes.
  void add_moving(std::size_t from, std::uint64_t rises, std::uint64_t valid) noexcept {
    std::uint64_t turns = (rises ^ (rises << 1U | static_cast<std::uint64_t>(is_rising_))) & valid;
    const auto count = static_cast<std::size_t>(std::popcount(turns));
    const auto from2 = static_cast<std::int32_t>(2 * from);
    // Four at a time, some of them beyond the count: one branch in place of four.
    for (std::size_t i = 0; i < count; i += 4) {
      for (std::size_t j = 0; j < 4; ++j) {
        out_[i + j] = from2 + 2 * std::countr_zero(turns);
        turns &= turns - 1;
      }
    }
    out_ += count;
    const auto length = static_cast<std::size_t>(std::bit_width(valid));
    is_rising_ = ((rises >> (length - 1)) & 1U) != 0;
    flat_from_ = from + length;
  }

  /// With flats, the extremum is the middle of the samples between two moves.
  void add_with_flats(std::size_t from, std::uint64_t rises, std::uint64_t moves) noexcept {
    for (; moves != 0; moves &= moves - 1) {
      const auto bit = static_cast<std::size_t>(std::countr_zero(moves));
      const bool is_rising = ((rises >> bit) & 1U) != 0;
      if (is_moving_ && is_rising != is_rising_) {
        *out_++ = static_cast<std::int32_t>(flat_from_ + from + bit);
      }
      is_moving_ = true;
      is_rising_ = is_rising;
      flat_from_ = from + bit + 1;
    }
  }

  std::int32_t* out_;
  bool is_moving_;             ///< the signal has moved yet
  bool is_rising_;             ///< its last move
  std::size_t flat_from_ = 0;  ///< the sample after its last move
};

/// The list of extrema from the marks of compare_neighbours.
inline void collect_extrema(SiftWorkspace& ws) noexcept {
  ExtremaCollector collector(ws);
  const std::size_t differences = ws.size - 1;
  for (std::size_t word = 0; 64 * word < differences; ++word) {
    const std::size_t left = differences - 64 * word;
    const std::uint64_t valid = left < 64 ? (std::uint64_t{1} << left) - 1 : ~std::uint64_t{0};
    collector.add_word(64 * word, ws.rises[word], ws.falls[word], valid);
  }
  Extrema& extrema = ws.extrema;
  extrema.begin = Extrema::kMaxAdded;
  extrema.end = static_cast<std::size_t>(collector.end() - extrema.position2.data());
  const std::int32_t* const position2 = extrema.position2.data();
  const double* const signal = ws.signal.data();
  double* const value = extrema.value.data();
  for (std::size_t k = extrema.begin; k < extrema.end; ++k) {
    value[k] = signal[position2[k] / 2];
  }
}

}  // namespace gyrod::core::GYROD_KERNEL
