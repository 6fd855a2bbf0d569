/// The files of an evaluation.
#pragma once

#include <filesystem>
#include <string>

#include "report/json.hpp"

namespace gyrod::app {

/// Writes evaluation.html, evaluation.json, evaluation.csv, guards.csv and turns.csv; a turns.csv of another run goes where there were no turns. Each file is there in full or not at all.
class EvaluationFolder {
 public:
  /// Makes the folder, with those above it. @throws files::FileError if it cannot be made or written to
  explicit EvaluationFolder(std::filesystem::path folder);

  /// @param evaluation as evaluation_json() makes it  @throws files::FileError
  void write(const report::Json& evaluation) const;

 private:
  void write(const std::string& name, const std::string& text) const;
  void remove(const std::string& name) const;

  std::filesystem::path folder_;
};

}  // namespace gyrod::app
