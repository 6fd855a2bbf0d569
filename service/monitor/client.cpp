#include "monitor/client.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <string_view>
#include <utility>

namespace gyrod::monitor {
namespace {

/// A request of ours is one line and a few headers; a browser's is below 4 KiB.
constexpr std::size_t kMaxRequestBytes = std::size_t{16} * 1024;
/// The same with TLS and its handshake around.
constexpr std::uint64_t kMaxRawBytes = std::uint64_t{32} * 1024;
constexpr std::string_view kEndOfHead = "\r\n\r\n";
/// From the connection, or the first byte where it was kept, to the last byte of the request.
constexpr std::chrono::seconds kRequestTime{2};
/// From there to the last byte of the answer. Prometheus gives up after 10 s by default.
constexpr std::chrono::seconds kAnswerTime{10};
/// For the client to close first: bytes left unread would make close() send a reset, and the client might lose
/// the answer.
constexpr std::chrono::milliseconds kClosingTime{500};

}  // namespace

Client::Client(Transport transport, std::string address, Deadline now, HttpCounts& counts)
    : transport_(std::move(transport)),
      address_(std::move(address)),
      begin_(now),
      deadline_(now + kRequestTime),
      last_progress_(now),
      counts_(counts) {}

bool Client::step(Deadline now, short revents) {
  if (now >= deadline_ && !times_out(now)) return false;
  if (state_ == State::kReading && !read(now)) return false;
  if (state_ == State::kWriting && !write(now)) return false;
  if (state_ == State::kClosing && !drain()) return false;
  // Who has left gets no answer made: one that only ends its own side before it has one does not either.
  const bool waits = state_ == State::kAsking || state_ == State::kAnswering;
  return !waits || (revents & (POLLERR | POLLHUP | POLLRDHUP)) == 0;
}

pollfd Client::waits_for() const noexcept {
  if (state_ == State::kAsking || state_ == State::kAnswering) return transport_.waits_for(POLLRDHUP);
  return transport_.waits_for(state_ == State::kWriting ? POLLOUT : POLLIN);
}

std::string Client::take_request() {
  state_ = State::kAnswering;
  std::string request = received_.substr(0, request_bytes_);
  received_.erase(0, request_bytes_);
  return request;
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
  if (state_ == State::kWriting) counts_.count(Refusal::kNotTaken);
  if (state_ != State::kReading) return false;
  if (received_.empty()) return gone();
  refuse(408, Refusal::kTimeout, "the request did not come within 2 s");
  deadline_ = now + kClosingTime;
  return true;
}

void Client::refuse(int status, Refusal why, std::string_view words) {
  Reply reply = refusal(status, why, words);
  counts_.count(reply.status, reply.refusal);
  answer(std::move(reply));
}

/// While it was read from.
/// @return false
bool Client::gone() noexcept {
  if (transport_.is_shaking_hands()) counts_.count(Refusal::kTls);
  return false;
}

bool Client::read(Deadline now) {
  std::array<char, 4096> bytes{};
  bool whole = find_request(0);
  while (!whole) {
    const Transfer transfer = transport_.read(bytes);
    if (transfer.ended) return gone();
    const bool too_much = received_.size() + transfer.bytes > kMaxRequestBytes ||
                          transport_.received_bytes() - bytes_before_ > kMaxRawBytes;
    if (too_much) {
      // Before TLS has begun there is no way to say so.
      if (received_.empty()) return gone();
      refuse(431, Refusal::kTooLarge, "a request has 16 KiB at most");
      deadline_ = now + kClosingTime;
      return true;
    }
    if (transfer.bytes == 0) return true;
    // A connection that was kept: the next request begins with its first byte.
    if (received_.empty() && requests_ > 0) begin_next(now);
    const std::size_t seen = received_.size() - std::min(received_.size(), kEndOfHead.size() - 1);
    received_.append(bytes.data(), transfer.bytes);
    whole = find_request(seen);
  }
  return true;
}

/// @return whether a whole one is here
bool Client::find_request(std::size_t from) {
  const std::size_t end = received_.find(kEndOfHead, from);
  if (end == std::string::npos) return false;
  request_bytes_ = end + kEndOfHead.size();
  state_ = State::kAsking;
  deadline_ = begin_ + kAnswerTime;
  return true;
}

void Client::begin_next(Deadline now) {
  begin_ = now;
  deadline_ = now + kRequestTime;
  bytes_before_ = transport_.received_bytes();
}

bool Client::write(Deadline now) {
  while (unsent_bytes() > 0) {
    const Transfer transfer = transport_.write(std::string_view(reply_.bytes).substr(sent_));
    if (transfer.ended) return false;
    if (transfer.bytes == 0) return true;
    sent_ += transfer.bytes;
    last_progress_ = now;
  }
  const bool stays = reply_.keep_open && ++requests_ < kMaxRequests;
  reply_ = {};
  sent_ = 0;
  if (stays) {
    begin_next(now);
    if (received_.empty()) deadline_ = now + kKeepOpenTime;
    state_ = State::kReading;
    return read(now);
  }
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
