#include "monitor/row_board.hpp"

#include <functional>
#include <utility>

#include "monitor/channel_rows.hpp"

namespace gyrod::monitor {
namespace {

std::shared_ptr<const RowTexts> make(const View& view, bool history, double now_s) {
  auto made = std::make_shared<RowTexts>();
  const std::vector<ChannelRow> rows = rows_of(view);
  made->overload_step = worst_overload_step(rows);
  made->made_s = now_s;
  made->rows.reserve(rows.size());
  for (const ChannelRow& row : rows) {
    std::string text = text_of(json_of(row));
    const std::size_t hash = std::hash<std::string>{}(text);
    if (history) text = text_of(json_of(row, view.live));
    made->rows.push_back({row.sensor, std::move(text), hash});
  }
  return made;
}

}  // namespace

std::shared_ptr<const RowTexts> RowBoard::look(const View& view, bool history, double now_s) {
  const std::lock_guard lock(mutex_);
  std::shared_ptr<const RowTexts>& made = made_[history ? 1 : 0];
  if (!made || now_s - made->made_s >= kFreshS) made = make(view, history, now_s);
  return made;
}

}  // namespace gyrod::monitor
