/// Certificates, keys and permissions for tests, made by deploy/security/make.sh when they are needed and gone afterwards.
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "support/scratch_folder.hpp"

namespace gyrod::testing {

/// An authority of its own with the programs that make.sh makes, if not told otherwise: gyrod (role daemon), sensor, reader.
class SecurityFolder {
 public:
  /// Runs make.sh, found by GYROD_SOURCE_DIR. @throws std::runtime_error with what it said, if it fails
  explicit SecurityFolder(const std::vector<std::string>& arguments = {});

  /// Runs make.sh again. @return what it said
  std::string make(const std::vector<std::string>& arguments) const;

  /// One program's folder, or "ca".
  [[nodiscard]] std::string of(const std::string& program) const { return scratch_.path("made/" + program); }
  [[nodiscard]] std::string path(const std::string& name) const { return scratch_.path("made/" + name); }

  /// A copy of a program's folder, to be changed. @return its path
  std::string copy(const std::string& program, const std::string& name) const;

  /// Has the authority sign the certificate in a folder again, for another time.
  void reissue(const std::string& folder, std::chrono::seconds from_now, std::chrono::seconds until) const;

  /// Has the authority sign an XML document.
  void sign(const std::string& xml, const std::string& file) const;

 private:
  ScratchFolder scratch_;
};

/// The text of a template of deploy/security/templates.
[[nodiscard]] std::string security_template(const std::string& name);

}  // namespace gyrod::testing
