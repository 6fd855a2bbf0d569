#include "report/summary.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <string_view>

#include "report/axis_input.hpp"

namespace gyrod::report {
namespace {

/// The schemes that the paper compares in its Tables 5 and 6. acf-emd stands in Tables 7 to 9 only.
constexpr std::array<std::string_view, 4> kPaperSchemes = {"raw", "direct", "emd", "improved"};

const Json& row_of(const Json& rows, std::string_view scheme) {
  for (const Json& row : rows) {
    if (row.at("scheme") == scheme) return row;
  }
  return rows.front();
}

double std_of(const Json& axis, std::string_view scheme) {
  return row_of(axis.at("table5").at("rows"), scheme).at("std_dps");
}

/// Mean frequency of IMF number `imf`, counted from 1.
std::string frequency_of(const Json& decomposition, std::size_t imf) {
  const double period_s = decomposition.at("imfs").at(imf - 1).at("mean_period_s");
  constexpr int kDigits = 2;
  return number_text(1.0 / period_s, kDigits);
}

/// Part of `before` that `after` is; nothing where there was nothing before.
Json ratio(double before, double after) { return before > 0.0 ? Json(after / before) : Json(nullptr); }

/// Raw to improved at the cluster times up to 10 s.
Json allan_change(const Json& allan) {
  constexpr double kLongest = 10.5;
  Json all = Json::array();
  if (allan.contains("absent")) return all;
  const Json& taus = allan.at("chosen_tau_s");
  for (std::size_t i = 0; i < taus.size() && taus[i].get<double>() < kLongest; ++i) {
    const auto deviation = [&allan, i](std::string_view scheme) -> double {
      return row_of(allan.at("chosen"), scheme).at("deviation_dps").at(i);
    };
    all.push_back(Json{{"tau_s", taus[i]}, {"ratio", ratio(deviation("raw"), deviation("improved"))}});
  }
  return all;
}

/// A ratio in words: "75 % less".
std::string change_words(double ratio) {
  const long percent = std::lround(100.0 * std::abs(ratio - 1.0));
  if (percent == 0) return "no change";
  return std::to_string(percent) + (ratio < 1.0 ? " % less" : " % more");
}

/// Axes on which the rule finds nothing to do.
void append_idle_axes(const Json& axes, std::vector<std::string>& sentences) {
  std::string names;
  for (const auto& [name, axis] : axes.items()) {
    const Json& decomposition = axis.at("decomposition");
    if (decomposition.contains("absent") || decomposition.at("k") != 0) continue;
    names += (names.empty() ? "" : ", ") + name;
  }
  if (names.empty()) return;
  sentences.push_back("Axis " + names +
                      ": k = 0, the rule takes every IMF for signal, and nothing is changed.");
}

/// Several: "75 to 81 % less"; "2 % less to 3 % more".
std::string changes_words(const std::vector<double>& ratios) {
  const auto [least, most] = std::ranges::minmax(ratios);
  std::string low = change_words(most < 1.0 ? most : least);
  const std::string high = change_words(most < 1.0 ? least : most);
  if (low == high) return low;
  const bool same_way = low.substr(low.find(' ')) == high.substr(high.find(' '));
  return (same_way ? low.substr(0, low.find(' ')) : low) + " to " + high;
}

/// "Raw to improved: standard deviation 75 to 81 % less; Allan deviation at 0.1 s ...", over the axes.
std::string change_sentence(const Json& rows) {
  std::string sentence = "Raw to improved, over the axes:";
  const auto add = [&](const std::string& what, auto&& find) {
    std::vector<double> ratios;
    for (const Json& row : rows) {
      const Json& found = find(row);
      if (found.is_number()) ratios.push_back(found);
    }
    if (!ratios.empty()) sentence += " " + what + " " + changes_words(ratios) + ";";
  };
  add("standard deviation", [](const Json& row) -> const Json& { return row.at("std_ratio"); });
  for (std::size_t i = 0; i < rows.front().at("allan_change").size(); ++i) {
    const std::string tau = number_text(rows.front().at("allan_change").at(i).at("tau_s"), 1);
    add("Allan deviation at " + tau + " s",
        [i](const Json& row) -> const Json& { return row.at("allan_change").at(i).at("ratio"); });
  }
  sentence.back() = '.';
  return sentence;
}

std::vector<std::string> truth_sentences(const Json& axes) {
  std::vector<std::string> sentences;
  for (const auto& [name, axis] : axes.items()) {
    const Json& rows = axis.at("table5").at("rows");
    const Json& raw = row_of(rows, "raw").at("snr_db");
    const Json& improved = row_of(rows, "improved").at("snr_db");
    if (!raw.is_number() || !improved.is_number()) continue;
    sentences.push_back(name + " axis, against the true rate: SNR " + number_text(raw, 3) + " dB raw, " +
                        number_text(improved, 3) + " dB improved.");
  }
  return sentences;
}

/// Which of the paper's schemes has the least value; nothing where two share it.
template <typename Value>
std::string_view least(Value&& value) {
  std::string_view best;
  double least_value = std::numeric_limits<double>::infinity();
  for (const std::string_view scheme : kPaperSchemes) {
    const double mine = value(scheme);
    if (mine >= least_value) continue;
    least_value = mine;
    best = scheme;
  }
  return best;
}

/// Where `improved` is not the best of the paper's schemes on an axis: "standard deviation (emd)", ...
std::vector<std::string> defeats(const Json& axis) {
  std::vector<std::string> lost;
  const auto judge = [&lost](const std::string& what, std::string_view best) {
    if (best != "improved") lost.push_back(what + " (best: " + std::string(best) + ")");
  };
  const Json& rows = axis.at("table5").at("rows");
  judge("standard deviation",
        least([&](std::string_view scheme) { return row_of(rows, scheme).at("std_dps").get<double>(); }));
  const Json& allan = axis.at("allan");
  if (allan.contains("absent")) return lost;
  const Json& taus = allan.at("chosen_tau_s");
  for (std::size_t i = 0; i < taus.size() && taus[i].get<double>() < 50.0; ++i) {
    judge("Allan deviation at " + number_text(taus[i], 1) + " s", least([&](std::string_view scheme) {
            return row_of(allan.at("chosen"), scheme).at("deviation_dps").at(i).get<double>();
          }));
  }
  return lost;
}

std::string ranking_sentence(const Json& axes) {
  std::string disagreement;
  for (const auto& [name, axis] : axes.items()) {
    if (axis.at("decomposition").contains("absent")) continue;
    for (const std::string& lost : defeats(axis)) {
      if (!disagreement.empty()) disagreement += "; ";
      disagreement.append(name).append(": ").append(lost);
    }
  }
  if (disagreement.empty()) {
    return "Of the paper's schemes (raw, direct, emd, improved) improved is best on every axis, in standard "
           "deviation and in Allan "
           "deviation at 0.1, 1 and 10 s as far as the record shows them.";
  }
  return "Improved is not the best of the paper's schemes (raw, direct, emd, improved) everywhere. " +
         disagreement + ".";
}

}  // namespace

Json summary_rows(const Json& axes, bool still) {
  Json rows = Json::array();
  for (const auto& [name, axis] : axes.items()) {
    const Json& decomposition = axis.at("decomposition");
    if (decomposition.contains("absent")) continue;
    const std::size_t j = decomposition.at("j");
    const std::size_t k = decomposition.at("k");
    const std::size_t count = decomposition.at("imfs").size();
    const auto from_to = [&decomposition](std::size_t slow, std::size_t fast) {
      return slow == fast ? frequency_of(decomposition, slow)
                          : frequency_of(decomposition, slow) + " to " + frequency_of(decomposition, fast);
    };
    rows.push_back(
        Json{{"axis", name},
             {"std_raw_dps", std_of(axis, "raw")},
             {"std_improved_dps", std_of(axis, "improved")},
             {"std_ratio", ratio(std_of(axis, "raw"), std_of(axis, "improved"))},
             {"dropped_hz", j > 0 ? "from " + frequency_of(decomposition, j) + " up" : "none"},
             {"filtered_hz", k > j ? from_to(k, j + 1) : "none"},
             {"kept_hz", k < count ? "up to " + frequency_of(decomposition, k + 1) : "residue only"},
             {"allan_change", still ? allan_change(axis.at("allan")) : Json::array()}});
  }
  return rows;
}

std::vector<std::string> summary_sentences(const Json& axes, bool still) {
  std::vector<std::string> sentences;
  for (const auto& [name, axis] : axes.items()) {
    const Json& decomposition = axis.at("decomposition");
    if (!decomposition.contains("absent")) continue;
    sentences.push_back(name + " axis: nothing is denoised, since " +
                        decomposition.at("absent").get<std::string>());
  }
  const Json rows = summary_rows(axes, still);
  if (rows.empty()) return sentences;
  if (still) sentences.push_back(change_sentence(rows));
  if (!still) std::ranges::move(truth_sentences(axes), std::back_inserter(sentences));
  if (!still)
    sentences.emplace_back("The standard deviation of a moving record is that of motion and noise together.");
  append_idle_axes(axes, sentences);
  sentences.emplace_back(
      "What is dropped is dropped whether it is noise or motion: where the sensor is to follow motion at "
      "those frequencies, this "
      "scheme is the wrong one.");
  if (still) sentences.push_back(ranking_sentence(axes));
  return sentences;
}

std::vector<std::string> cautions(const Json& record) {
  std::vector<std::string> words;
  const std::size_t samples = record.at("samples");
  if (!record.at("still").get<bool>()) {
    words.emplace_back(
        "This record moves. The paper's rule holds only while noise dominates the record: slow motion "
        "correlates most with it "
        "and noise least, so that the rule keeps noise or drops motion. This page shows what the paper's "
        "method does, not what "
        "to drive with: `gyrod denoise` and `gyrod run` use a rule that survives motion.");
  }
  if (samples < kPaperSamples / 2 || samples > kPaperSamples * 2) {
    words.push_back("The paper's threshold of 0.001 is made for 360 000 samples. This record has " +
                    std::to_string(samples) + ", so that k falls at other periods than the paper's 8 s.");
  }
  const auto count = [&record](const char* key) { return record.at(key).get<std::uint64_t>(); };
  if (count("gaps") > 0) {
    words.push_back("Only the longest stretch without a long gap is shown: " + std::to_string(samples) +
                    " of " + std::to_string(count("rows")) + " rows; " + std::to_string(count("left_out")) +
                    " good samples are left out.");
  }
  if (count("bridged") > 0 || count("refused") > 0 || count("broken_rows") > 0) {
    words.push_back(std::to_string(count("refused")) +
                    " samples were refused (not finite, out of range, duplicate, out of order), " +
                    std::to_string(count("broken_rows")) + " rows could not be read; " +
                    std::to_string(count("bridged")) +
                    " samples of this page are straight lines across short gaps.");
  }
  return words;
}

}  // namespace gyrod::report
