#include "web/assets.hpp"

#include <algorithm>
#include <cassert>

#include "web/asset_table.hpp"

namespace gyrod::web {
namespace {

const Asset& find(std::string_view name) noexcept {
  const auto found = std::ranges::find(assets(), name, &Asset::name);
  assert(found != assets().end());
  return *found;
}

}  // namespace

std::string_view asset(std::string_view name) noexcept { return find(name).text; }

std::string_view asset_hash(std::string_view name) noexcept { return find(name).hash; }

}  // namespace gyrod::web
