/// Clients that mean no good, at a steady pace, for as long as the object lives.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "unit/monitor/http_client.hpp"

namespace gyrod {

/// One thread: holds 200 half-open requests, and ten times a second opens 20 connections that send garbage, ask for the
/// metrics and do not read them, or leave at once. Beside it a good client scrapes four times a second.
class HttpAbuse {
 public:
  explicit HttpAbuse(std::uint16_t port) : port_(port), thread_([this] { run(); }) {}
  ~HttpAbuse() {
    done_ = true;
    thread_.join();
  }
  HttpAbuse(const HttpAbuse&) = delete;
  HttpAbuse& operator=(const HttpAbuse&) = delete;

  [[nodiscard]] int scrapes() const noexcept { return scrapes_; }
  [[nodiscard]] int failed_scrapes() const noexcept { return failed_; }
  [[nodiscard]] int connections() const noexcept { return connections_; }

 private:
  using Client = std::unique_ptr<monitor::test::HttpClient>;

  Client open(const std::string& sends) {
    ++connections_;
    auto client = std::make_unique<monitor::test::HttpClient>(port_);
    (void)client->send(sends);
    return client;
  }

  void run() {
    constexpr std::size_t kHeld = 200;
    constexpr std::chrono::milliseconds kRound{100};
    std::vector<Client> held(kHeld);
    std::vector<Client> deaf;
    auto next = std::chrono::steady_clock::now();
    for (std::size_t round = 0; !done_; ++round) {
      // Half-open ones are ended by gyrod after 2 s: all are opened again in that time.
      for (std::size_t i = 0; i < kHeld / 20; ++i)
        held[(round * kHeld / 20 + i) % kHeld] = open("GET / HTTP/1.1\r\n");
      deaf.clear();
      for (int i = 0; i < 5; ++i) deaf.push_back(open("GET /metrics HTTP/1.1\r\nHost: localhost\r\n\r\n"));
      for (int i = 0; i < 5; ++i) (void)open(std::string("\x16\x03\x01\0\xff", 5) + std::string(2000, 'x'));
      if (round % 5 < 2) scrape();
      next += kRound;
      std::this_thread::sleep_until(next);
    }
  }

  void scrape() {
    ++scrapes_;
    if (monitor::test::get(port_, "/metrics").status != 200) ++failed_;
  }

  std::uint16_t port_;
  std::atomic<bool> done_{false};
  std::atomic<int> scrapes_{0};
  std::atomic<int> failed_{0};
  std::atomic<int> connections_{0};
  std::thread thread_;
};

}  // namespace gyrod
