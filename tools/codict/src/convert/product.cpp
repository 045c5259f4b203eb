// SPDX-License-Identifier: Apache-2.0
#include "convert/product.hpp"

#include <fmt/format.h>

#include <cstdint>

namespace lexican::codict::convert {

namespace {

// Returns the number in [DeviceInfo] or DeviceIdentity, else that in 1018h; 0 if both are missing.
std::uint64_t number_of(const Device& device, const Field<std::uint32_t>& number, std::uint8_t sub_index) {
  const Entry* const entry = device.find(0x1018, sub_index);
  const bool has_default = entry != nullptr && entry->default_value.is_integer();
  return number.value != 0 || !has_default ? number.value : entry->default_value.integer.bits();
}

std::string difference(const char* name, std::uint64_t base, std::uint64_t overlay) {
  const bool is_other = base != 0 && overlay != 0 && base != overlay;
  return is_other ? fmt::format("{} 0x{:X}, the base has 0x{:X}", name, overlay, base) : std::string();
}

}  // namespace

std::string other_product(const Device& base, const Device& overlay) {
  if (overlay.find(0x1000) == nullptr) {
    return {};
  }
  const std::string vendor = difference("vendor number", number_of(base, base.identity.vendor_number, 1),
                                        number_of(overlay, overlay.identity.vendor_number, 1));
  const std::string product = difference("product number", number_of(base, base.identity.product_number, 2),
                                         number_of(overlay, overlay.identity.product_number, 2));
  return vendor.empty() ? product : vendor;
}

}  // namespace lexican::codict::convert
