// SPDX-License-Identifier: Apache-2.0
#include "gen/eds.hpp"

#include <algorithm>
#include <utility>

#include "eds/write.hpp"
#include "text/compress.hpp"

namespace lexican::codict::gen {

namespace {

constexpr std::uint16_t store_eds = 0x1021;
constexpr std::uint16_t store_format = 0x1022;

void add(Device& device, Object object) {
  if (device.find(object.index) != nullptr) {
    return;
  }
  object.name.is_given = true;
  const auto place = std::find_if(device.objects.begin(), device.objects.end(),
                                  [&object](const Object& other) { return other.index > object.index; });
  device.objects.insert(place, std::move(object));
}

}  // namespace

std::uint64_t format_of(EmbeddedEds embedded) {
  constexpr std::uint64_t zlib = 0x80;  // CO_EDS_FORMAT_ZLIB
  return embedded == EmbeddedEds::zlib ? zlib : 0;
}

void add_eds_objects(Device& device) {
  Object eds;
  eds.index = store_eds;
  eds.name.text = "Store EDS";
  eds.object_code.value = ObjectCode::domain;
  eds.data_type.value = type_code::domain;
  eds.access.value = Access::ro;
  add(device, std::move(eds));
  Object format;
  format.index = store_format;
  format.name.text = "Store format";
  format.object_code.value = ObjectCode::variable;
  format.data_type.value = type_code::unsigned16;
  format.access.value = Access::constant;
  add(device, std::move(format));
}

void embed_eds(Device device, const std::string& file_name, const Options& options, Plan& plan) {
  Device result = described(std::move(device), plan);
  result.file.file_name.text = file_name;
  result.file.file_name.is_given = true;
  const std::string bytes = eds::write(result, eds::WriteOptions());
  plan.eds = options.embedded_eds == EmbeddedEds::zlib ? zlib_compressed(bytes) : bytes;
}

}  // namespace lexican::codict::gen
