// SPDX-License-Identifier: Apache-2.0
#include "simulate/inputs_outputs.hpp"

#include <algorithm>
#include <iterator>

namespace lexican::simulate {
namespace {

constexpr std::uint64_t all_bits = 0xFFFFFFFF;
constexpr std::uint16_t analogue_inputs[] = {0x6400, 0x6401, 0x6402};  // 8, 16 and 32 bits
constexpr std::uint16_t analogue_outputs[] = {0x6410, 0x6411, 0x6412};

template <std::size_t Size>
bool contains(const std::uint16_t (&list)[Size], std::uint16_t index) {
  return std::find(std::begin(list), std::end(list), index) != std::end(list);
}

}  // namespace

/// Indices of the objects of digital inputs, in one width.
struct InputsOutputs::Inputs {
  std::uint16_t value;
  std::uint16_t polarity;
  std::uint16_t any_change;
  std::uint16_t low_to_high;
  std::uint16_t high_to_low;
};

struct InputsOutputs::Outputs {
  std::uint16_t value;
  std::uint16_t polarity;
  std::uint16_t error_mode;
  std::uint16_t error_value;
  std::uint16_t filter;
};

const InputsOutputs::Inputs InputsOutputs::inputs[] = {{0x6000, 0x6002, 0x6006, 0x6007, 0x6008},
                                                       {0x6100, 0x6102, 0x6106, 0x6107, 0x6108},
                                                       {0x6120, 0x6122, 0x6126, 0x6127, 0x6128}};
const InputsOutputs::Outputs InputsOutputs::outputs[] = {{0x6200, 0x6202, 0x6206, 0x6207, 0x6208},
                                                         {0x6300, 0x6302, 0x6306, 0x6307, 0x6308},
                                                         {0x6320, 0x6322, 0x6326, 0x6327, 0x6328}};

const InputsOutputs::Inputs* InputsOutputs::inputs_at(std::uint16_t index, std::uint16_t Inputs::*member) {
  const auto* const found =
      std::find_if(std::begin(inputs), std::end(inputs), [&](const Inputs& group) { return group.*member == index; });
  return found != std::end(inputs) ? found : nullptr;
}

const InputsOutputs::Outputs* InputsOutputs::outputs_at(std::uint16_t index) {
  const auto* const found = std::find_if(std::begin(outputs), std::end(outputs), [&](const Outputs& group) {
    return group.value == index || group.polarity == index;
  });
  return found != std::end(outputs) ? found : nullptr;
}

/// Calls a function for each sub-index of an array.
template <typename Call>
void InputsOutputs::for_each(std::uint16_t index, Call call) const {
  const std::uint64_t last = std::min<std::uint64_t>(numbers_.natural(index, 0, 0), 254);
  for (unsigned n = 1; n <= last; ++n) {
    const auto sub_index = static_cast<std::uint8_t>(n);
    if (numbers_.has(index, sub_index)) {
      call(sub_index);
    }
  }
}

void InputsOutputs::reset() {
  levels_.clear();
  for (const Inputs& group : inputs) {
    for_each(group.value, [&](std::uint8_t n) {
      terminals_.emplace(Key{group.value, n}, numbers_.natural(group.value, n, 0));  // a reset does not change them
      read_input(group, n, false);
    });
  }
  for (const Outputs& group : outputs) {
    for_each(group.value, [&](std::uint8_t n) { drive_output(group, n, false); });
  }
  for (const std::uint16_t index : analogue_inputs) {
    for_each(index, [&](std::uint8_t n) { sent_[{index, n}] = numbers_.integer(index, n, 0); });
  }
}

void InputsOutputs::written(std::uint16_t index, std::uint8_t sub_index) {
  if (sub_index == 0) {
    return;
  }
  if (const Inputs* const group = inputs_at(index, &Inputs::polarity)) {
    read_input(*group, sub_index, true);
  }
  if (const Outputs* const group = outputs_at(index)) {
    drive_output(*group, sub_index, index == group->value);
  }
  levels_.erase({index, sub_index});
}

bool InputsOutputs::commanded(std::uint16_t index, std::uint8_t sub_index, const Bytes& value) {
  if (sub_index == 0 || !numbers_.has(index, sub_index)) {
    return false;
  }
  if (const Inputs* const group = inputs_at(index, &Inputs::value)) {
    terminals_[{index, sub_index}] = natural_of(value);
    read_input(*group, sub_index, true);
    return true;
  }
  if (contains(analogue_inputs, index)) {
    read_analogue(index, sub_index, integer_of(value));
    return true;
  }
  return false;
}

/// Brings the state of terminals into the object. Its change is sent if the masks of the interrupts say so.
void InputsOutputs::read_input(const Inputs& group, std::uint8_t sub_index, bool may_send) {
  const std::uint64_t old = numbers_.natural(group.value, sub_index, 0);
  const std::uint64_t now = terminals_[{group.value, sub_index}] ^ numbers_.natural(group.polarity, sub_index, 0);
  const std::uint64_t any = (old ^ now) & numbers_.natural(group.any_change, sub_index, all_bits);
  const std::uint64_t risen = now & ~old & numbers_.natural(group.low_to_high, sub_index, 0);
  const std::uint64_t fallen = old & ~now & numbers_.natural(group.high_to_low, sub_index, 0);
  const bool is_event = (any | risen | fallen) != 0 && numbers_.natural(0x6005, 0, 1) != 0;
  numbers_.put(group.value, sub_index, static_cast<std::int64_t>(now), may_send && is_event);
}

/// An analogue value is sent if it differs by more than the delta from the one that was sent last.
void InputsOutputs::read_analogue(std::uint16_t index, std::uint8_t sub_index, std::int64_t value) {
  std::int64_t& sent = sent_[{index, sub_index}];
  const auto distance = static_cast<std::uint64_t>(value > sent ? value - sent : sent - value);
  const bool is_event = distance > numbers_.natural(0x6426, sub_index, 0) && numbers_.natural(0x6423, 0, 1) != 0;
  numbers_.put(index, sub_index, value, is_event);
  sent = is_event ? value : sent;
}

/// Brings the value of the object to the terminals. \a is_filtered: those without a bit of the filter mask stay.
void InputsOutputs::drive_output(const Outputs& group, std::uint8_t sub_index, bool is_filtered) {
  std::uint64_t& terminals = terminals_[{group.value, sub_index}];
  const std::uint64_t value =
      numbers_.natural(group.value, sub_index, 0) ^ numbers_.natural(group.polarity, sub_index, 0);
  const std::uint64_t filter = is_filtered ? numbers_.natural(group.filter, sub_index, all_bits) : all_bits;
  terminals = (terminals & ~filter) | (value & filter);
}

void InputsOutputs::disconnected() {
  for (const Outputs& group : outputs) {
    for_each(group.value, [&](std::uint8_t n) {
      std::uint64_t& terminals = terminals_[{group.value, n}];
      const std::uint64_t mode = numbers_.natural(group.error_mode, n, all_bits);
      terminals = (terminals & ~mode) | (numbers_.natural(group.error_value, n, 0) & mode);
    });
  }
  for (const std::uint16_t index : analogue_outputs) {
    for_each(index, [&](std::uint8_t n) {
      if (numbers_.natural(0x6443, n, 1) == 1) {
        levels_[{index, n}] = numbers_.integer(0x6444, n, 0);
      }
    });
  }
}

std::optional<std::int64_t> InputsOutputs::terminal(std::uint16_t index, std::uint8_t sub_index) const {
  const auto digital = terminals_.find({index, sub_index});
  if (digital != terminals_.end()) {
    return static_cast<std::int64_t>(digital->second);
  }
  const auto analogue = levels_.find({index, sub_index});
  return analogue != levels_.end() ? std::optional(analogue->second) : std::nullopt;
}

}  // namespace lexican::simulate
