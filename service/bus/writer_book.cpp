#include "bus/writer_book.hpp"

#include <algorithm>
#include <utility>

#include "bus/loan.hpp"

namespace gyrod::bus {
namespace {

const char* const kLookForWriters = "look for writers";

/// Writers that have gone and are remembered.
constexpr std::size_t kMostGone = 1024;

}  // namespace

Reliability reliability_of(const dds_qos_t* qos) noexcept {
  dds_reliability_kind_t kind = DDS_RELIABILITY_BEST_EFFORT;
  (void)dds_qget_reliability(qos, &kind, nullptr);
  return kind == DDS_RELIABILITY_RELIABLE ? Reliability::kReliable : Reliability::kBestEffort;
}

WriterBook::WriterBook(const Domain& domain, std::vector<std::string_view> types)
    : types_(std::move(types)),
      publications_(
          dds_create_reader(domain.participant(), DDS_BUILTIN_TOPIC_DCPSPUBLICATION, nullptr, nullptr),
          kLookForWriters),
      news_condition_(dds_create_readcondition(publications_.get(), DDS_ANY_STATE), kLookForWriters) {}

std::vector<WriterBook::Writer> WriterBook::take_news() {
  look();
  return std::exchange(news_, {});
}

bool WriterBook::is_best_effort(dds_instance_handle_t writer) {
  auto found = writers_.find(writer);
  if (found == writers_.end()) {
    look();
    found = writers_.find(writer);
  }
  return found != writers_.end() && found->second.best_effort;
}

std::optional<WriterBook::Sighting> WriterBook::last_sighting(dds_instance_handle_t writer) {
  look();
  const auto found = writers_.find(writer);
  if (found == writers_.end()) return std::nullopt;
  return found->second.sighting;
}

/// Takes what discovery has told since the last time. A writer that came and went in between shows as both.
void WriterBook::look() {
  while (true) {
    const Loan<dds_builtintopic_endpoint_t> loan(publications_.get());
    if (loan.size() == 0) return;
    for (std::size_t i = 0; i < loan.size(); ++i) {
      const dds_sample_info_t& info = loan.info(i);
      if (info.valid_data && std::ranges::count(types_, std::string_view(loan.message(i).type_name)) > 0) {
        const Reliability reliability = reliability_of(loan.message(i).qos);
        Entry& entry = writers_[info.instance_handle];
        entry = {reliability == Reliability::kBestEffort, {.number = ++sightings_}};
        std::ranges::copy(loan.message(i).key.v, entry.sighting.writer.begin());
        news_.push_back({loan.message(i).topic_name, reliability});
      }
      if (info.instance_state == DDS_ALIVE_INSTANCE_STATE || !writers_.contains(info.instance_handle))
        continue;
      gone_.push_back(info.instance_handle);
      if (gone_.size() <= kMostGone) continue;
      writers_.erase(gone_.front());
      gone_.pop_front();
    }
  }
}

}  // namespace gyrod::bus
