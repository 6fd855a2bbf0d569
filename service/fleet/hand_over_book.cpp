#include "fleet/hand_over_book.hpp"

#include <algorithm>

namespace gyrod::fleet {

template <class Change>
void HandOverBook::change(const std::string& id, const Change& change) {
  const auto known = accounts_.find(id);
  if (known == accounts_.end() && accounts_.size() == kMost) return;
  const auto account = known != accounts_.end() ? known : accounts_.emplace(id, Account{}).first;
  owing_ -= account->second.owes() ? 1U : 0U;
  change(account->second);
  owing_ += account->second.owes() ? 1U : 0U;
  if (account->second.gone && !account->second.owes()) accounts_.erase(account);
}

void HandOverBook::announce(const std::string& id, std::uint64_t number) {
  change(id, [number](Account& account) {
    account.announced = std::max(account.announced, number);
    account.gone = false;
  });
}

void HandOverBook::receive(const std::string& id, std::uint64_t number) {
  change(id, [number](Account& account) { account.received = std::max(account.received, number); });
}

void HandOverBook::forget(const std::string& id) {
  change(id, [](Account& account) { account.gone = true; });
}

void HandOverBook::write_off() {
  for (auto& [id, account] : accounts_) account.received = std::max(account.received, account.announced);
  std::erase_if(accounts_, [](const auto& entry) { return entry.second.gone; });
  owing_ = 0;
}

}  // namespace gyrod::fleet
