/// The API on a view with known values.
#pragma once

#include <memory>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "live/live.hpp"
#include "monitor/api.hpp"
#include "unit/monitor/fixed_view.hpp"

namespace gyrod::monitor::test {

class ApiTest : public ::testing::Test {
 protected:
  using json = nlohmann::json;

  ApiTest() { view_.live = &live_; }

  /// @param target as a client writes it, "/api/v1/..." with or without a query of plain characters
  [[nodiscard]] Answer ask(const std::string& target, const std::string& last_event_id = "") {
    if (!api_) api_ = std::make_unique<Api>(options(), view_);
    Request request;
    request.raw_path = target.substr(0, target.find('?'));
    request.path = request.raw_path;
    request.last_event_id = last_event_id;
    std::string query =
        target.size() > request.raw_path.size() ? target.substr(request.raw_path.size() + 1) : "";
    while (!query.empty()) {
      const std::string pair = query.substr(0, query.find('&'));
      query.erase(0, std::min(query.size(), pair.size() + 1));
      const std::size_t equals = std::min(pair.find('='), pair.size());
      request.query.emplace(pair.substr(0, equals), pair.substr(std::min(equals + 1, pair.size())));
    }
    return api_->answer(request);
  }

  [[nodiscard]] json get(const std::string& target) {
    const Answer answer = ask("/api/v1/" + target);
    EXPECT_EQ(answer.status, 200) << answer.body;
    EXPECT_EQ(answer.content_type, "application/json");
    return json::parse(answer.body);
  }

  /// The words of an error.
  [[nodiscard]] std::string refused(int status, const std::string& target) {
    const Answer answer = ask("/api/v1/" + target);
    EXPECT_EQ(answer.status, status) << answer.body;
    return json::parse(answer.body).at("error");
  }

  [[nodiscard]] ApiOptions options() {
    return {.version = "1.2.3",
            .start_time_s = 1.7e9,
            .uptime_s = [] { return 42.5; },
            .steady_s = [this] { return now_s_; },
            .time_s = [] { return 1.7e9 + 42.5; }};
  }

  Shown shown_ = busy_gyrod();
  View view_ = view_of(shown_);
  live::Live live_;
  double now_s_ = 100.0;
  std::unique_ptr<Api> api_;
};

}  // namespace gyrod::monitor::test
