/// The direction of dependency as a function on text: which includes a file of service/ may not have.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace gyrod::architecture {

/// One include that is not allowed.
struct Violation {
  std::string file;      ///< relative to service/
  std::size_t line = 0;  ///< from 1
  std::string include;   ///< as it stands, e.g. "bus/wire.hpp" or <thread>
  std::string reason;
};

/// Checks every #include of one file against
///   app -> bus, monitor, settings, files -> stream -> core -> Eigen
/// with siblings apart; inside core: denoise -> emd -> signal, and simulation on its own. core may use the
/// standard library, less threads, clocks, files and streams, and Eigen; each library has its rooms.
/// @param file path relative to service/, with '/'
[[nodiscard]] std::vector<Violation> check_includes(std::string_view file, std::string_view text);

}  // namespace gyrod::architecture
