#include "core/denoise/record_analysis.hpp"

#include <algorithm>
#include <cmath>

#include "core/denoise/decomposition.hpp"
#include "core/denoise/model_filter.hpp"
#include "core/signal/moments.hpp"

namespace gyrod::core {
namespace {

using Samples = std::vector<double>;

Samples& output(RecordAnalysis& analysis, Scheme scheme) {
  return analysis.outputs[static_cast<std::size_t>(scheme)];
}

void filter_directly(std::span<const double> record, ModelFilter& filter, RecordAnalysis& analysis) {
  const double centre = analysis.report.mean;
  Samples& out = output(analysis, Scheme::kDirect);
  out.assign(record.begin(), record.end());
  for (double& value : out) value -= centre;
  analysis.report.direct_model = filter.filter(out, filter_noise_of_record(analysis.report, variance(out)));
  analysis.direct = filter.identification();
  if (analysis.report.direct_model.used) {
    for (double& value : out) value += centre;
  } else {
    out.assign(record.begin(), record.end());
  }
}

/// Scheme 3, which changes the decomposition's mixed IMFs: last.
void filter_mixed(Decomposition& decomposition, ModelFilter& filter, RecordAnalysis& analysis) {
  for (std::size_t i = analysis.report.j; i < analysis.report.k; ++i) {
    analysis.report.imf[i].model = filter.filter(
        decomposition.imf(i), filter_noise_of_imf(analysis.report, i, ModelChoice::kIdentified));
    analysis.mixed.push_back(filter.identification());
  }
}

}  // namespace

DenoiserOptions whole_record_options(DenoiserOptions options) {
  options.screening.rule = ScreeningRule::kPaper;
  options.models = ModelChoice::kIdentified;
  options.keep_mean = true;
  return options;
}

RecordAnalysis analyse_record(std::span<const double> record, const DenoiserOptions& options) {
  RecordAnalysis analysis;
  analysis.report.window_samples = record.size();
  analysis.report.mean = mean(record);
  if (record.size() < Denoiser::kMinSamples) {
    analysis.outputs.fill(Samples(record.begin(), record.end()));
    analysis.residue.assign(record.begin(), record.end());
    return analysis;
  }
  Decomposition decomposition(record.size(), options.emd, options.screening);
  ModelFilter filter(record.size(), ModelChoice::kIdentified, options.max_ar_order);
  WindowReport& report = analysis.report;
  decomposition.take_apart(record, report);
  for (std::size_t i = 0; i < report.imf_count; ++i)
    analysis.imfs.emplace_back(decomposition.imf(i).begin(), decomposition.imf(i).end());
  analysis.residue.assign(decomposition.residue().begin(), decomposition.residue().end());

  output(analysis, Scheme::kRaw).assign(record.begin(), record.end());
  filter_directly(record, filter, analysis);
  for (const Scheme scheme : {Scheme::kEmd, Scheme::kAcfEmd, Scheme::kImproved}) {
    if (scheme == Scheme::kImproved) filter_mixed(decomposition, filter, analysis);
    Samples& out = output(analysis, scheme);
    out.resize(record.size());
    decomposition.reconstruct(first_kept(scheme, report), report.imf_count, out);
  }
  for (const Scheme scheme : kAllSchemes) {
    if (options.keep_mean && scheme != Scheme::kRaw) give_mean(report.mean, output(analysis, scheme));
  }
  return analysis;
}

}  // namespace gyrod::core
