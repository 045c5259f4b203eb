// SPDX-License-Identifier: Apache-2.0
#include "convert/commission.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "convert/merge.hpp"

namespace lexican::codict::convert {

namespace {

template <typename T>
void set(Field<T>& field, T value) {
  field.value = value;
  field.text = std::to_string(value);
  field.is_given = true;
}

}  // namespace

std::string fault_of(const NodeSettings& settings) {
  const std::string name = settings.node_name.value_or("");
  const bool has_control =
      std::any_of(name.begin(), name.end(), [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7F'; });
  return has_control ? "the node name has a control character or a line end; give one line of text" : "";
}

void commission(const NodeSettings& settings, Device& device) {
  Commissioning& commissioning = device.commissioning;
  commissioning.is_given = commissioning.is_given || settings.is_any();
  if (settings.node_id) {
    set(commissioning.node_id, *settings.node_id);
  }
  if (settings.bit_rate) {
    set(commissioning.bit_rate, *settings.bit_rate);
  }
  if (settings.node_name) {
    commissioning.node_name.text = *settings.node_name;
    commissioning.node_name.is_given = true;
  }
}

bool commission(const NodeSettings& settings, const eds::Document& dcf, std::string& bytes) {
  std::string lines = "[DeviceComissioning]\n";
  const auto add = [&lines](const char* key, const std::string& value) { lines += fmt::format("{}={}\n", key, value); };
  if (settings.node_id) {
    add("NodeID", std::to_string(*settings.node_id));
  }
  if (settings.node_name) {
    add("NodeName", *settings.node_name);
  }
  if (settings.bit_rate) {
    add("Baudrate", std::to_string(*settings.bit_rate));
  }
  Findings ignored;
  std::vector<ReplacedValue> replaced;
  return merge(dcf, eds::Document(Source("commissioning", std::move(lines)), ignored), bytes, replaced);
}

}  // namespace lexican::codict::convert
