/// Errors that end a subcommand with an exit code of their own.
#pragma once

#include <stdexcept>

namespace gyrod::app {

/// Something of the machine is not to be had, e.g. the HTTP port. what() names it and the reason.
class Unavailable : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The work could not be done in full, e.g. nobody reads. what() says what is missing.
class Incomplete : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace gyrod::app
