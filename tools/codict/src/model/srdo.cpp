// SPDX-License-Identifier: Apache-2.0
#include "model/srdo.hpp"

#include <algorithm>
#include <utility>

#include "lexican/srdo.hpp"

namespace lexican::codict {

namespace {

// Reads values until one is unknown.
class Reader {
 public:
  explicit Reader(const NumberOf& number_of) : number_of_(number_of) {}

  template <typename Number>
  Number read(unsigned index, unsigned sub_index) {
    const std::optional<std::uint64_t> number =
        number_of_(static_cast<std::uint16_t>(index), static_cast<std::uint8_t>(sub_index));
    is_complete_ = is_complete_ && number.has_value();
    return static_cast<Number>(number.value_or(0));
  }
  bool is_complete() const { return is_complete_; }

 private:
  const NumberOf& number_of_;
  bool is_complete_ = true;
};

std::optional<std::uint64_t> number_in(const Device& device, std::uint16_t index, std::uint8_t sub_index) {
  const Entry* const entry = device.find(index, sub_index);
  if (entry == nullptr || value_in_force(*entry).kind == Value::Kind::none) {
    return 0;
  }
  const Value& value = value_in_force(*entry);
  return value.is_integer() && !value.adds_node_id ? std::optional(value.integer.bits()) : std::nullopt;
}

}  // namespace

std::uint8_t Srdo::bytes() const {
  constexpr unsigned most = 8;
  unsigned bits = 0;
  for (std::size_t place = 0; place < mapped.size(); place += 2) {
    bits += mapped[place].bits;
  }
  return static_cast<std::uint8_t>(std::min(bits / 8, most));
}

std::vector<Srdo> srdos_of(const Device& device) {
  std::vector<Srdo> srdos;
  for (std::uint8_t number = 1; number <= srdo_limit; ++number) {
    const auto index = static_cast<std::uint16_t>(srdo_index::communication + number - 1);
    Srdo srdo;
    srdo.number = number;
    srdo.communication = device.find(index);
    srdo.direction = number_in(device, index, 1).value_or(0);
    if (srdo.communication == nullptr || srdo.direction == 0) {
      continue;
    }
    srdo.mapping = device.find(static_cast<std::uint16_t>(srdo_index::mapping + number - 1));
    if (srdo.mapping != nullptr) {
      srdo.mapped = mapped_objects(device, *srdo.mapping, srdo_mapped_limit);
    }
    srdos.push_back(std::move(srdo));
  }
  return srdos;
}

std::optional<std::uint16_t> srdo_signature(std::uint8_t number, const NumberOf& number_of) {
  const unsigned communication = srdo_index::communication + number - 1U;
  const unsigned mapping = srdo_index::mapping + number - 1U;
  Reader reader(number_of);
  co::srdo::Parameter parameter{};
  parameter.direction = reader.read<std::uint8_t>(communication, 1);
  parameter.cycle = reader.read<std::uint16_t>(communication, 2);
  parameter.validation = reader.read<std::uint8_t>(communication, 3);
  parameter.plain_id = reader.read<std::uint32_t>(communication, 5);
  parameter.inverse_id = reader.read<std::uint32_t>(communication, 6);
  const auto mapped = reader.read<std::uint64_t>(mapping, 0);
  if (parameter.direction == 0 || mapped > srdo_mapped_limit) {
    return std::nullopt;
  }
  std::uint16_t signature = co::srdo::begin_signature(parameter, static_cast<std::uint8_t>(mapped));
  for (std::uint8_t sub_index = 1; sub_index <= mapped; ++sub_index) {
    signature = co::srdo::add_mapping(signature, sub_index, reader.read<std::uint32_t>(mapping, sub_index));
  }
  return reader.is_complete() ? std::optional(signature) : std::nullopt;
}

std::optional<std::uint16_t> srdo_signature(std::uint8_t number, const Device& device) {
  return srdo_signature(
      number, [&device](std::uint16_t index, std::uint8_t sub_index) { return number_in(device, index, sub_index); });
}

}  // namespace lexican::codict
