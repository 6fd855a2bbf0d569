#include "monitor/client.hpp"

#include <array>
#include <chrono>
#include <string_view>
#include <utility>

namespace gyrod::monitor {
namespace {

/// A request of ours is one line and a few headers; a browser's is below 4 KiB.
constexpr std::size_t kMaxRequestBytes = std::size_t{16} * 1024;
/// From the connection to the last byte of the request.
constexpr std::chrono::seconds kRequestTime{2};
/// From the connection to the last byte of the answer. Prometheus gives up after 10 s by default.
constexpr std::chrono::seconds kAnswerTime{10};
/// For the client to close first: bytes left unread would make close() send a reset, and the client might lose
/// the answer.
constexpr std::chrono::milliseconds kClosingTime{500};

}  // namespace

Client::Client(Transport transport, Deadline now)
    : transport_(std::move(transport)), begin_(now), deadline_(now + kRequestTime), last_progress_(now) {}

bool Client::step(Deadline now, short revents) {
  if (now >= deadline_ && !times_out(now)) return false;
  if (state_ == State::kReading && !read(now)) return false;
  if (state_ == State::kWriting && !write(now)) return false;
  if (state_ == State::kClosing && !drain()) return false;
  const bool waits = state_ == State::kAsking || state_ == State::kAnswering;
  return !waits || (revents & (POLLERR | POLLHUP)) == 0;
}

pollfd Client::waits_for() const noexcept {
  if (state_ == State::kAsking || state_ == State::kAnswering) return transport_.waits_for(0);
  return transport_.waits_for(state_ == State::kWriting ? POLLOUT : POLLIN);
}

std::string Client::take_request() {
  state_ = State::kAnswering;
  return std::exchange(request_, {});
}

void Client::answer(Reply reply) {
  reply_ = std::move(reply);
  last_progress_ = std::chrono::steady_clock::now();
  state_ = State::kWriting;
}

std::optional<EventStream> Client::take_stream() {
  if (!reply_.events) return std::nullopt;
  return EventStream(std::move(reply_.place), std::move(transport_), std::move(reply_.bytes),
                     std::move(reply_.events));
}

std::optional<Deadline> Client::idle_since() const noexcept {
  switch (state_) {
    case State::kReading:
      return begin_;
    case State::kWriting:
    case State::kClosing:
      return last_progress_;
    default:
      return std::nullopt;
  }
}

/// @return whether there is something left to say to the client
bool Client::times_out(Deadline now) {
  if (state_ != State::kReading || request_.empty()) return false;
  answer(refusal(408, "the request did not come within 2 s"));
  deadline_ = now + kClosingTime;
  return true;
}

bool Client::read(Deadline now) {
  std::array<char, 4096> bytes{};
  while (true) {
    const Transfer transfer = transport_.read(bytes);
    if (transfer.ended) return false;
    if (transfer.bytes == 0) return true;
    const std::size_t seen = request_.size() < 3 ? 0 : request_.size() - 3;
    request_.append(bytes.data(), transfer.bytes);
    const std::size_t end = request_.find("\r\n\r\n", seen);
    if (end != std::string::npos && end + 4 <= kMaxRequestBytes) {
      request_.resize(end + 4);
      state_ = State::kAsking;
      deadline_ = begin_ + kAnswerTime;
      return true;
    }
    if (request_.size() >= kMaxRequestBytes) {
      answer(refusal(431, "a request has 16 KiB at most"));
      deadline_ = now + kClosingTime;
      return true;
    }
  }
}

bool Client::write(Deadline now) {
  while (unsent_bytes() > 0) {
    const Transfer transfer = transport_.write(std::string_view(reply_.bytes).substr(sent_));
    if (transfer.ended) return false;
    if (transfer.bytes == 0) return true;
    sent_ += transfer.bytes;
    last_progress_ = now;
  }
  reply_ = {};
  sent_ = 0;
  transport_.end_writing();
  state_ = State::kClosing;
  deadline_ = now + kClosingTime;
  return true;
}

bool Client::drain() {
  std::array<char, 4096> unread{};
  constexpr int kMostReads = 16;  // the others wait
  for (int i = 0; i < kMostReads; ++i) {
    const Transfer transfer = transport_.read(unread);
    if (transfer.ended) return false;
    if (transfer.bytes == 0) return true;
  }
  return true;
}

}  // namespace gyrod::monitor
