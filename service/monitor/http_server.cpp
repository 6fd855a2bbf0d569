#include "monitor/http_server.hpp"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <exception>
#include <iterator>
#include <utility>

#include "monitor/background.hpp"

namespace gyrod::monitor {
namespace {

/// Far above any fleet's scrapers and people; 16 KiB each at most before they are answered.
constexpr std::size_t kMaxClients = 256;
/// Of answers that clients have not taken yet; beyond it none is made before there is room.
constexpr std::size_t kMaxUnsentBytes = std::size_t{64} * 1024 * 1024;
/// Beyond it, too, those are disconnected that have taken nothing for so long.
constexpr std::chrono::milliseconds kDeafTime{500};
/// Before the clients that are here have their turn.
constexpr int kMaxAccepted = 64;
constexpr std::chrono::seconds kLookForCertificate{1};
/// After a failed accept(), e.g. no descriptor left: others may give some back.
constexpr std::chrono::milliseconds kAcceptPause{50};

}  // namespace

HttpServer::HttpServer(Socket listener, Answerer answer, const HttpOptions& options)
    : listener_(std::move(listener)),
      answer_(std::move(answer)),
      tell_(options.tell),
      gate_(options.access, options.address, options.tell),
      requests_(options.requests),
      streams_(options.streams) {
  if (options.access.uses_tls()) tls_.emplace(options.access.certificate_file, options.access.key_file);
}

void HttpServer::start() {
  streams_.start();
  pool_.start();
  thread_ = std::thread([this] { serve(); });
}

void HttpServer::stop() noexcept {
  stopping_ = true;
  wake_.raise();
  if (thread_.joinable()) thread_.join();
  listener_ = {};
  clients_.clear();
  pool_.stop();
  streams_.stop();
}

void HttpServer::serve() noexcept {
  run_in_background();
  while (!stopping_) {
    try {
      serve_once();
    } catch (const std::exception&) {
      clients_.clear();  // out of memory: what they hold is given back, and they may try again
    }
  }
}

void HttpServer::serve_once() {
  wait();
  wake_.clear();
  const Deadline now = std::chrono::steady_clock::now();
  step(now);
  take_answers();
  if (descriptors_[1].revents != 0) accept_clients(now);
  hand_out_requests(now);
}

void HttpServer::wait() {
  Deadline next = Deadline::max();
  const bool accepts = std::chrono::steady_clock::now() >= accept_again_;
  if (!accepts) next = accept_again_;
  if (holds_back_) next = std::chrono::steady_clock::now() + kDeafTime;
  descriptors_.clear();
  descriptors_.push_back({wake_.descriptor(), POLLIN, 0});
  descriptors_.push_back({accepts ? listener_.descriptor() : -1, POLLIN, 0});
  for (const auto& [number, client] : clients_) {
    descriptors_.push_back(client.waits_for());
    next = std::min(next, client.deadline());
  }
  poll_until(descriptors_, next);
}

/// The clients are those of wait(), in the same order.
void HttpServer::step(Deadline now) {
  std::size_t place = 2;
  for (auto each = clients_.begin(); each != clients_.end(); ++place) {
    const bool goes_on = each->second.step(now, descriptors_[place].revents);
    each = goes_on ? std::next(each) : clients_.erase(each);
  }
}

void HttpServer::accept_clients(Deadline now) {
  for (int i = 0; i < kMaxAccepted; ++i) {
    if (clients_.size() >= kMaxClients && !drop_longest_idle()) {
      accept_again_ = now + kAcceptPause;
      return;
    }
    auto [socket, address] = accept_from(listener_);
    if (!socket) {
      if (errno != EAGAIN && errno != ECONNABORTED) accept_again_ = now + kAcceptPause;
      return;
    }
    Ssl tls = tls_ ? new_tls(socket.descriptor(), now) : nullptr;
    if (tls_ && tls == nullptr) continue;  // no memory
    clients_.emplace(next_number_++,
                     Client(Transport(std::move(socket), std::move(tls)), std::move(address), now, counts_));
  }
}

Ssl HttpServer::new_tls(int descriptor, Deadline now) {
  if (now >= look_for_certificate_) {
    look_for_certificate_ = now + kLookForCertificate;
    try {
      if (tls_->renew())
        tell_(Tone::kNews, "monitor.tls: a new certificate was read; new connections use it");
    } catch (const AccessError& error) {
      tell_(Tone::kTrouble,
            std::string("monitor.tls: ") + error.what() + "; the certificate before stays in use");
    }
  }
  return tls_->serve(descriptor);
}

void HttpServer::take_answers() {
  for (Done& done : pool_.take_done()) {
    --jobs_;
    counts_.count(done.reply.status, done.reply.refusal);
    go_on(done.client, std::move(done.reply));
  }
}

void HttpServer::go_on(std::uint64_t number, Reply reply) {
  const auto found = clients_.find(number);
  if (found == clients_.end()) return;  // gone meanwhile
  Client& client = found->second;
  client.answer(std::move(reply));
  std::optional<EventStream> stream = client.take_stream();
  if (stream) streams_.add(std::move(*stream));
  const bool goes_on = !stream && client.step(std::chrono::steady_clock::now(), 0);
  if (!goes_on) clients_.erase(found);
}

/// As many at a time as there are threads, those first who came first: whoever leaves meanwhile costs nothing.
void HttpServer::hand_out_requests(Deadline now) {
  holds_back_ = unsent_bytes() > kMaxUnsentBytes;
  if (holds_back_) return drop_deaf_ones(now);
  for (auto& [number, client] : clients_) {
    if (jobs_ >= AnswerPool::kThreads) return;
    if (!client.has_request()) continue;
    std::string request = client.take_request();
    if (!requests_.take(client.address(), now)) {
      client.refuse(429, Refusal::kRate, "more than 200 requests a second from this address");
      continue;
    }
    pool_.add({number, std::move(request), client.address()});
    ++jobs_;
  }
}

std::size_t HttpServer::unsent_bytes() const {
  std::size_t bytes = 0;
  for (const auto& [number, client] : clients_) bytes += client.unsent_bytes();
  return bytes;
}

void HttpServer::drop_deaf_ones(Deadline now) {
  const std::size_t dropped = std::erase_if(clients_, [now](const auto& each) {
    return each.second.unsent_bytes() > 0 && each.second.idle_since() < now - kDeafTime;
  });
  counts_.count(Refusal::kNotTaken, dropped);
}

/// @return whether there was one
bool HttpServer::drop_longest_idle() {
  const auto since = [](const auto& each) { return each.second.idle_since().value_or(Deadline::max()); };
  const auto longest = std::ranges::min_element(clients_, {}, since);
  if (longest == clients_.end() || !longest->second.idle_since()) return false;
  counts_.count(Refusal::kNoPlace);
  clients_.erase(longest);
  return true;
}

}  // namespace gyrod::monitor
