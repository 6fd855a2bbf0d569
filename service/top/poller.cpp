#include "top/poller.hpp"

#include <chrono>
#include <utility>

namespace gyrod::top {

Poller::Poller(Client& client) : client_(client) {
  known_.picture.url = client.url();
  thread_ = std::thread([this] { run(); });
}

Poller::~Poller() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  wake_.notify_all();
  client_.stop();
  thread_.join();
}

void Poller::want(const View& view, std::uint64_t rows) {
  {
    const std::lock_guard lock(mutex_);
    const auto asked = [](const View& v) { return sensors_query(v, v.first, 0); };
    if (rows_ == rows && asked(view_) == asked(view)) return;
    view_ = view;
    rows_ = rows;
    changed_ = true;
  }
  wake_.notify_all();
}

Poller::Known Poller::known() {
  const std::lock_guard lock(mutex_);
  return known_;
}

Picture Poller::ask(const View& view, std::uint64_t rows) {
  Picture picture;
  try {
    picture.status = parse_status(client_.status_text());
    picture.page = parse_sensors(client_.sensors_text(view, view.first, rows));
    picture.events = parse_events(client_.events_text(kEventsShown));
  } catch (const std::exception& error) {
    picture.trouble = error.what();
  }
  return picture;
}

void Poller::run() {
  constexpr std::chrono::seconds kBetween{1};
  std::unique_lock lock(mutex_);
  while (!ending_) {
    changed_ = false;
    const View view = view_;
    const std::uint64_t rows = rows_;
    lock.unlock();
    Picture fresh = ask(view, rows);
    lock.lock();
    // What was known stays on the screen beside the reason why nothing newer is.
    if (fresh.trouble.empty()) {
      fresh.url = known_.picture.url;
      known_.picture = std::move(fresh);
    } else {
      known_.picture.trouble = std::move(fresh.trouble);
    }
    ++known_.version;
    wake_.wait_for(lock, kBetween, [this] { return ending_ || changed_; });
  }
}

}  // namespace gyrod::top
