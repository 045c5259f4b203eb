// SPDX-License-Identifier: Apache-2.0
#include "simulate/profile.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "simulate/drive.hpp"
#include "simulate/inputs_outputs.hpp"

namespace lexican::simulate {
namespace {

constexpr std::uint64_t io_profile = 401;
constexpr std::uint64_t drive_profile = 402;
constexpr unsigned most_axes = 8;
constexpr Micros step_interval = millisecond;
constexpr Micros longest_delay = second;   // that a behaviour catches up
constexpr unsigned axis_distance = 0x800;  // between the objects of two axes

}  // namespace

std::vector<std::unique_ptr<Behaviour>> behaviours_of(Device& device) {
  std::vector<std::unique_ptr<Behaviour>> behaviours;
  const std::uint64_t profile = Numbers(device).natural(0x1000, 0, 0) & 0xFFFF;
  for (unsigned axis = 0; axis < most_axes && profile == drive_profile; ++axis) {
    const Numbers numbers(device, static_cast<std::uint16_t>(axis * axis_distance));
    if (numbers.has(0x6040) && numbers.has(0x6041)) {
      behaviours.push_back(std::make_unique<Drive>(numbers));
    }
  }
  if (profile == io_profile) {
    behaviours.push_back(std::make_unique<InputsOutputs>(Numbers(device)));
  }
  return behaviours;
}

template <typename Call>
void Behaviours::for_each(Call call) {
  for (const std::unique_ptr<Behaviour>& behaviour : behaviours_) {
    call(*behaviour);
  }
}

bool Behaviours::are_at_rest() const {
  return std::all_of(behaviours_.begin(), behaviours_.end(), [](const auto& one) { return one->is_at_rest(); });
}

void Behaviours::start(Device& device) {
  device_ = &device;
  behaviours_ = behaviours_of(device);
  device.take_events();
  for_each([](Behaviour& one) { one.reset(); });
  device.dictionary().on_written([this](std::uint16_t index, std::uint8_t sub_index) {
    for_each([=](Behaviour& one) { one.written(index, sub_index); });
  });
  device.on_pdo([this] { update(); });
}

void Behaviours::update() {
  const Device::Hold hold(*device_);
  for_each([](Behaviour& one) { one.update(); });
}

Micros Behaviours::process(Micros now) {
  const Device::Events events = device_->take_events();
  if (events.was_reset) {
    for_each([](Behaviour& one) { one.reset(); });
  }
  if (events.is_separated) {
    const Device::Hold hold(*device_);
    for_each([](Behaviour& one) { one.disconnected(); });
  }
  update();
  stepped_ = has_rested_ || now - stepped_ > longest_delay ? now : stepped_;
  for (; !are_at_rest() && now - stepped_ >= step_interval; stepped_ += step_interval) {
    const Device::Hold hold(*device_);
    for_each([](Behaviour& one) {
      if (!one.is_at_rest()) {
        one.step(step_interval);
      }
    });
  }
  has_rested_ = are_at_rest();
  return has_rested_ ? for_ever : stepped_ + step_interval - now;
}

bool Behaviours::commanded(std::uint16_t index, std::uint8_t sub_index, const Bytes& value) {
  return std::any_of(behaviours_.begin(), behaviours_.end(),
                     [&](const auto& one) { return one->commanded(index, sub_index, value); });
}

void Behaviours::raised(std::uint16_t code) {
  const Device::Hold hold(*device_);
  for_each([=](Behaviour& one) { one.raised(code); });
}

std::string Behaviours::terminals(std::uint16_t index, std::uint8_t sub_index) const {
  for (const std::unique_ptr<Behaviour>& behaviour : behaviours_) {
    if (const std::optional<std::int64_t> terminal = behaviour->terminal(index, sub_index)) {
      return fmt::format(", terminals {}", *terminal);
    }
  }
  return {};
}

std::uint64_t natural_of(const Bytes& bytes) {
  std::uint64_t number = 0;
  for (std::size_t n = 0; n < bytes.size() && n < 8; ++n) {
    number |= std::uint64_t{bytes[n]} << 8 * n;
  }
  return number;
}

std::int64_t integer_of(const Bytes& bytes) {
  const std::uint64_t number = natural_of(bytes);
  const auto unused = static_cast<unsigned>(64 - 8 * std::min<std::size_t>(bytes.size(), 8));
  return unused < 64 ? static_cast<std::int64_t>(number << unused) >> unused : 0;
}

std::optional<Bytes> Numbers::bytes(std::uint16_t index, std::uint8_t sub_index) const {
  return device_.get(static_cast<std::uint16_t>(index + offset_), sub_index);
}

bool Numbers::has(std::uint16_t index, std::uint8_t sub_index) const { return bytes(index, sub_index).has_value(); }

std::uint64_t Numbers::natural(std::uint16_t index, std::uint8_t sub_index, std::uint64_t otherwise) const {
  const std::optional<Bytes> value = bytes(index, sub_index);
  return value ? natural_of(*value) : otherwise;
}

std::int64_t Numbers::integer(std::uint16_t index, std::uint8_t sub_index, std::int64_t otherwise) const {
  const std::optional<Bytes> value = bytes(index, sub_index);
  return value ? integer_of(*value) : otherwise;
}

void Numbers::put(std::uint16_t index, std::uint8_t sub_index, std::int64_t value, bool is_event) const {
  const std::optional<Bytes> old = bytes(index, sub_index);
  if (!old) {
    return;
  }
  Bytes bytes(old->size());
  for (std::size_t n = 0; n < bytes.size(); ++n) {
    bytes[n] = static_cast<std::uint8_t>(static_cast<std::uint64_t>(value) >> 8 * n);
  }
  if (bytes != *old) {
    device_.put(static_cast<std::uint16_t>(index + offset_), sub_index, bytes, is_event);
  }
}

void Numbers::send(std::uint16_t index) const {
  if (const std::optional<Bytes> value = bytes(index, 0)) {
    device_.set(static_cast<std::uint16_t>(index + offset_), 0, *value);
  }
}

}  // namespace lexican::simulate
