/// The JSON API: /api/v1/..., described in docs/api.md.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "monitor/answer.hpp"
#include "monitor/row_board.hpp"
#include "monitor/status_json.hpp"
#include "monitor/view.hpp"

namespace gyrod::monitor {

/// Answers from the view when asked; keeps nothing but rows that streams share. Thread-safe as far as the view is. Outlives its answers' streams.
class Api {
 public:
  Api(ApiOptions options, View view);

  /// Whether answer() is for this path.
  [[nodiscard]] static bool is_for(const std::string& path);
  /// What is wrong with a request is the answer: 4xx or 5xx with {"error": words}.
  [[nodiscard]] Answer answer(const Request& request) const;

 private:
  [[nodiscard]] Answer route(const Request& request) const;
  [[nodiscard]] Answer route_channel(const Request& request, std::string_view rest) const;
  [[nodiscard]] Answer route_live(const Request& request, const stream::ChannelSnapshot& channel,
                                  std::string_view what) const;

  ApiOptions options_;
  View view_;
  std::unique_ptr<RowBoard> board_;
};

}  // namespace gyrod::monitor
