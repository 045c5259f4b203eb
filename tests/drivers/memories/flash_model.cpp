// SPDX-License-Identifier: Apache-2.0
#include "flash_model.hpp"

#include <algorithm>

namespace test {
namespace {

constexpr std::uint8_t blank = 0xFF;
constexpr std::uint8_t wrong = 0x5A;

FlashModel& model(void* ctx) { return *static_cast<FlashModel*>(ctx); }

const CO_FLASH_ACCESS access = {
    [](void* ctx, std::uint32_t address, std::uint32_t number) { return model(ctx).erase(address, number); },
    [](void* ctx, std::uint32_t address, const void* unit) { return model(ctx).program(address, unit); },
    [](void* ctx, std::uint32_t address, void* to, std::uint32_t size) { return model(ctx).read(address, to, size); },
};

}  // namespace

FlashModel::FlashModel(std::vector<CO_FLASH_REGION> regions, std::uint32_t program_size, bool has_code)
    : regions_(std::move(regions)), program_size_(program_size), has_code_(has_code) {
  for (const CO_FLASH_REGION& region : regions_) {
    for (std::uint32_t n = 0; n < region.PageNum; ++n) {
      const Unit unit = {std::vector<std::uint8_t>(program_size, blank), true, false};
      pages_.push_back({region.Address + n * region.PageSize, region.FirstNumber + n,
                        std::vector<Unit>(region.PageSize / program_size, unit)});
    }
  }
}

void* FlashModel::context() {
  context_ = {&access, this, regions_.data(), static_cast<std::uint32_t>(regions_.size()), program_size_};
  return &context_;
}

FlashModel::Place FlashModel::find(std::uint32_t address) {
  for (Page& page : pages_) {
    const std::uint32_t offset = address - page.address;
    if (address >= page.address && offset < page.units.size() * program_size_) {
      return {&page, &page.units[offset / program_size_], offset % program_size_};
    }
  }
  return {nullptr, nullptr, 0};
}

void FlashModel::erase_unit(Unit& unit) const { unit = {std::vector<std::uint8_t>(program_size_, blank), true, false}; }

// Sets a unit to the state after an interrupted operation.
void FlashModel::leave(Unit& unit, const std::vector<std::uint8_t>& to, bool is_first_half, bool is_erase) {
  const bool is_half_erased = is_erase && power.partial == Partial::half;
  if (power.partial == Partial::untouched || (is_half_erased && !is_first_half)) {
    return;
  }
  if (power.partial == Partial::done || is_half_erased) {
    unit = {to, is_erase, false};
    return;
  }
  unit.is_erased = false;
  unit.is_damaged = has_code_ && power.partial != Partial::erased;
  for (std::size_t n = 0; n < unit.bytes.size(); ++n) {
    switch (power.partial) {
      case Partial::erased: unit.bytes[n] = blank; break;
      case Partial::garbage: unit.bytes[n] = static_cast<std::uint8_t>(to[n] ^ wrong); break;
      default: unit.bytes[n] = n < unit.bytes.size() / 2 ? to[n] : unit.bytes[n];
    }
  }
}

bool FlashModel::erase(std::uint32_t address, std::uint32_t number) {
  const Place place = find(address);
  if (place.page == nullptr || place.page->address != address || place.page->number != number) {
    faults.push_back("erase of a page that does not exist, address " + std::to_string(address));
    return false;
  }
  if (power.is_off || ++erases + programs == fail_at) {
    return false;
  }
  const bool executed = power.begins();
  std::vector<Unit>& units = place.page->units;
  const std::vector<std::uint8_t> to(program_size_, blank);
  for (std::size_t n = 0; n < units.size(); ++n) {
    executed ? erase_unit(units[n]) : leave(units[n], to, n < units.size() / 2, true);
  }
  return executed;
}

bool FlashModel::program(std::uint32_t address, const void* unit) {
  const Place place = find(address);
  const auto* const bytes = static_cast<const std::uint8_t*>(unit);
  if (place.unit == nullptr || place.offset != 0) {
    faults.push_back("programming at address " + std::to_string(address));
    return false;
  }
  if (reinterpret_cast<std::uintptr_t>(unit) % 8 != 0) {
    faults.emplace_back("unit is not aligned");
  }
  if (power.is_off || ++programs + erases == fail_at) {
    return false;
  }
  if (!place.unit->is_erased) {
    faults.push_back("unit programmed twice, address " + std::to_string(address));
    return false;
  }
  const std::vector<std::uint8_t> to(bytes, bytes + program_size_);
  if (!power.begins()) {
    leave(*place.unit, to, true, false);
    return false;
  }
  *place.unit = {to, false, false};
  return true;
}

bool FlashModel::read(std::uint32_t address, void* to, std::uint32_t size) const {
  auto* const bytes = static_cast<std::uint8_t*>(to);
  if (power.is_off) {
    return false;
  }
  for (std::uint32_t n = 0; n < size; ++n) {
    const Place place = const_cast<FlashModel*>(this)->find(address + n);
    if (place.unit == nullptr || place.unit->is_damaged) {
      std::fill_n(bytes, size, blank);  // differs from the contents: the driver must not return it
      return false;
    }
    bytes[n] = place.unit->bytes[place.offset];
  }
  return true;
}

std::uint8_t& FlashModel::byte(std::uint32_t address) {
  const Place place = find(address);
  place.unit->is_erased = false;
  return place.unit->bytes[place.offset];
}

void FlashModel::damage(std::uint32_t address) { find(address).unit->is_damaged = true; }

}  // namespace test
