#include "bus/writer_identity.hpp"

#include <algorithm>
#include <cstdint>
#include <memory>

#include "bus/entity.hpp"
#include "bus/qos_match.hpp"

namespace gyrod::bus {

std::string text_of(const dds_guid_t& guid) {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string text;
  for (const std::uint8_t byte : guid.v) {
    text += kDigits[byte >> 4];
    text += kDigits[byte & 15U];
  }
  return text;
}

std::string guid_of(dds_entity_t writer) {
  dds_guid_t guid{};
  check(dds_get_guid(writer, &guid), "name the writer of denoised samples");
  return text_of(guid);
}

std::vector<std::string> place_of(const dds_qos_t* qos) {
  std::vector<std::string> partitions = partitions_of(qos);
  if (partitions.empty()) partitions.emplace_back();
  std::ranges::sort(partitions);
  return partitions;
}

std::vector<std::string> place_of(dds_entity_t writer) {
  const std::unique_ptr<dds_qos_t, void (*)(dds_qos_t*)> qos(dds_create_qos(), dds_delete_qos);
  check(dds_get_qos(writer, qos.get()), "read the QoS of the writer of denoised samples");
  return place_of(qos.get());
}

std::string user_data_of(const dds_qos_t* qos) {
  void* data = nullptr;
  std::size_t size = 0;
  if (!dds_qget_userdata(qos, &data, &size) || data == nullptr) return {};
  std::string text(static_cast<const char*>(data), size);
  dds_free(data);
  return text;
}

}  // namespace gyrod::bus
