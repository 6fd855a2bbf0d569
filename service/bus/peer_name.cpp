#include "bus/peer_name.hpp"

#include <algorithm>
#include <array>
#include <cstdio>

#include "bus/entity.hpp"
#include "bus/loan.hpp"

namespace gyrod::bus {
namespace {

/// A property that Cyclone DDS gives its participants; empty where there is none.
std::string property(const dds_qos_t* qos, const char* name) {
  char* value = nullptr;
  if (!dds_qget_prop(qos, name, &value)) return {};
  const std::string text = printable(value);
  dds_free(value);
  return text;
}

std::string entity_name(const dds_qos_t* qos) {
  char* value = nullptr;
  if (!dds_qget_entity_name(qos, &value) || value == nullptr) return {};
  const std::string text = printable(value);
  dds_free(value);
  return text;
}

std::string hex(const dds_guid_t& guid) {
  constexpr std::size_t kPrefixBytes = 12;
  std::string text;
  for (std::size_t i = 0; i < kPrefixBytes; ++i) {
    std::array<char, 3> byte{};
    std::snprintf(byte.data(), byte.size(), "%02x", guid.v[i]);
    text += byte.data();
  }
  return text;
}

std::string described(const dds_qos_t* qos) {
  const std::string process = property(qos, "__ProcessName");
  const std::string pid = property(qos, "__Pid");
  const std::string host = property(qos, "__Hostname");
  const std::string name = process.empty() ? entity_name(qos) : process.substr(process.rfind('/') + 1);
  if (name.empty()) return {};
  std::string text = "'" + name + "'";
  if (!pid.empty() || !host.empty()) {
    text += pid.empty() ? " (" : " (process " + pid;
    if (!host.empty()) text += (pid.empty() ? "on " : " on ") + host;
    text += ")";
  }
  return text;
}

}  // namespace

std::string printable(std::string_view text) {
  constexpr std::size_t kLongest = 64;
  std::string shown(text.substr(0, kLongest));
  std::ranges::replace_if(
      shown, [](char c) { return c < ' ' || c > '~'; }, '?');
  return shown;
}

std::string name_of_participant(const Domain& domain, const dds_guid_t& participant) {
  std::string name;
  const dds_entity_t created =
      dds_create_reader(domain.participant(), DDS_BUILTIN_TOPIC_DCPSPARTICIPANT, nullptr, nullptr);
  if (created > 0) {
    const Entity participants(created, "look for participants");
    dds_builtintopic_participant_t key{};
    key.key = participant;
    const dds_instance_handle_t instance = dds_lookup_instance(created, &key);
    if (instance != DDS_HANDLE_NIL) {
      const Loan<dds_builtintopic_participant_t> loan(created, instance);
      if (loan.size() > 0 && loan.info(0).valid_data) name = described(loan.message(0).qos);
    }
  }
  return name.empty() ? "participant " + hex(participant) : name;
}

}  // namespace gyrod::bus
