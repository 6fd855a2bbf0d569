#include "app/sample_sender.hpp"

#include <algorithm>

#include "app/errors.hpp"
#include "app/options.hpp"

namespace gyrod::app {
namespace {

/// At full speed one wake-up of the network carries so many samples.
constexpr std::size_t kSamplesAtOnce = 256;
constexpr std::chrono::seconds kPatience{60};

/// Whole batches; one by one where every sample has a time of its own.
std::size_t chunk_of(const SendFlags& flags) {
  if (flags.speed.speed > 0.0) return flags.batch;
  return std::max<std::size_t>(1, kSamplesAtOnce / flags.batch) * flags.batch;
}

/// The same flags, once the bus is known to take their batches.
const SendFlags& checked(const SendFlags& flags, const settings::BusSettings& settings) {
  if (flags.batch <= settings.max_batch_samples) return flags;
  throw CLI::ValidationError(
      "--batch", "'" + std::to_string(flags.batch) + "' given; expected a number from 1 to " +
                     std::to_string(settings.max_batch_samples) + ", which is bus.max_batch_samples");
}

}  // namespace

void SendFlags::add_to(CLI::App& command) {
  command.add_option("--batch", batch, "Samples a message; above 1 on the topic of batches [1]")
      ->type_name("N")
      ->check(whole_in_range(1, 65536));
  command.add_option("--wait", wait_s, "Seconds to wait for a reader before giving up [10]")
      ->type_name("S")
      ->check(in_range(0.0, 86400.0));
  command
      .add_option(
          "--keep", keep,
          "Samples to keep for readers that come later, such as a gyrod that restarts (transient local) [0]")
      ->type_name("N")
      ->check(whole_in_range(0, 1000000));
  speed.add_to(command);
}

SampleSender::SampleSender(const settings::BusSettings& settings, const SendFlags& flags,
                           Interrupt& interrupt)
    : topic_(checked(flags, settings).batch == 1 ? settings.topics.raw : settings.topics.raw_batch),
      chunk_(chunk_of(flags)),
      interrupt_(interrupt),
      pacer_(flags.speed.speed, interrupt),
      domain_(settings.domain, settings.network, settings.security.folder),
      writer_(domain_, bus_options(settings), flags.batch, (flags.keep + flags.batch - 1) / flags.batch) {
  constexpr std::chrono::milliseconds kLook{100};
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::duration<double>(flags.wait_s);
  while (!writer_.wait_for_subscriber(kLook) && !interrupt.requested()) {
    if (std::chrono::steady_clock::now() < give_up) continue;
    throw Incomplete(
        "nobody reads topic '" + topic_ + "' in domain " + std::to_string(settings.domain) + " on network '" +
        settings.network +
        "'; expected a gyrod run with the same --domain, --network and, if any, --security authority");
  }
  // The others that listen already are found within a moment of the first; what is sent before they are is not theirs.
  constexpr std::chrono::milliseconds kDiscovery{500};
  (void)interrupt.wait_for(kDiscovery);
  for (std::size_t k = 1; k <= flags.sensors; ++k) {
    sources_.push_back({flags.sensors == 1 ? flags.sensor : flags.sensor + "_" + std::to_string(k), {}});
    sources_.back().waiting.reserve(chunk_);
  }
}

bool SampleSender::send(const stream::Sample& sample, std::size_t sensor) {
  Source& source = sources_[sensor];
  source.waiting.push_back(sample);
  if (source.waiting.size() < chunk_) return true;
  return pacer_.wait_until_due(sample.stamp_ns) && flush(source);
}

void SampleSender::finish() {
  for (Source& source : sources_) {
    if (!flush(source)) return;
    // Without the end gyrod would hold the last samples back, as more might follow.
    if (!insist([this, &source] { return writer_.end(source.sensor); })) return;
  }
  constexpr std::chrono::milliseconds kLook{200};
  (void)insist([this, kLook] { return writer_.wait_for_acknowledgements(kLook); });
}

/// @return false if it was interrupted
bool SampleSender::flush(Source& source) {
  std::size_t done = 0;
  const bool all = insist([&] {
    done += writer_.publish(source.sensor, std::span(source.waiting).subspan(done));
    return done == source.waiting.size();
  });
  sent_ += done;
  source.waiting.clear();
  return all;
}

/// Tries until it works. @return false if it was interrupted
template <class Attempt>
bool SampleSender::insist(const Attempt& attempt) {
  const auto give_up = std::chrono::steady_clock::now() + kPatience;
  while (!attempt()) {
    if (interrupt_.requested()) return false;
    if (std::chrono::steady_clock::now() < give_up) continue;
    throw Incomplete("the readers of topic '" + topic_ + "' have taken nothing for " +
                     std::to_string(kPatience.count()) + " s; " + std::to_string(sent_) +
                     " samples were sent");
  }
  return true;
}

}  // namespace gyrod::app
