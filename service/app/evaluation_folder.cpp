#include "app/evaluation_folder.hpp"

#include <system_error>
#include <utility>

#include "app/evaluation_report.hpp"
#include "files/file_error.hpp"
#include "files/output_file.hpp"
#include "report/csv.hpp"
#include "report/page.hpp"

namespace gyrod::app {

EvaluationFolder::EvaluationFolder(std::filesystem::path folder) : folder_(std::move(folder)) {
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (error) throw files::FileError(folder_.string() + ": the folder cannot be made: " + error.message());
  // Where the page cannot be written, that is better known before the work than after.
  const files::OutputFile probe(folder_ / "evaluation.html");
}

void EvaluationFolder::write(const report::Json& evaluation) const {
  write("evaluation.json", report::file_text(evaluation));
  write("evaluation.csv", report::table_csv(estimator_rows(evaluation)));
  write("guards.csv", report::table_csv(guard_rows(evaluation)));
  const report::Json turns = turn_rows(evaluation);
  if (turns.empty()) {
    remove("turns.csv");
  } else {
    write("turns.csv", report::table_csv(turns));
  }
  const std::string title = "Evaluation on " + evaluation.at("record").at("name").get<std::string>();
  write("evaluation.html", report::evaluation_page(title, evaluation));
}

void EvaluationFolder::write(const std::string& name, const std::string& text) const {
  files::OutputFile file(folder_ / name);
  file.write(text);
  file.close();
}

void EvaluationFolder::remove(const std::string& name) const {
  std::error_code error;
  std::filesystem::remove(folder_ / name, error);
  if (error)
    throw files::FileError((folder_ / name).string() +
                           ": of another run, cannot be removed: " + error.message());
}

}  // namespace gyrod::app
