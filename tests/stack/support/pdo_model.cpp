// SPDX-License-Identifier: Apache-2.0
#include "pdo_model.hpp"

#include <cstdio>

namespace test {
namespace {

constexpr std::uint32_t unsupported_access = 0x06010000;
constexpr std::uint32_t no_object = 0x06020000;
constexpr std::uint32_t not_mappable = 0x06040041;
constexpr std::uint32_t too_long = 0x06040042;
constexpr std::uint32_t no_sub_index = 0x06090011;
constexpr std::uint32_t invalid_value = 0x06090030;

unsigned bits_of(const CO_OBJ_TYPE* type) {
  const std::map<const CO_OBJ_TYPE*, unsigned> bits = {
      {CO_TBOOLEAN, 8},     {CO_TUNSIGNED8, 8},   {CO_TUNSIGNED16, 16}, {CO_TUNSIGNED24, 24},
      {CO_TUNSIGNED32, 32}, {CO_TUNSIGNED40, 40}, {CO_TUNSIGNED48, 48}, {CO_TUNSIGNED56, 56},
      {CO_TUNSIGNED64, 64}, {CO_TREAL32, 32},     {CO_TREAL64, 64},
  };
  const auto found = bits.find(type);
  return found == bits.end() ? 0 : found->second;
}

std::uint32_t check_dummy(bool transmit, std::uint32_t word) {
  constexpr unsigned bits[] = {1, 8, 16, 32, 8, 16, 32};
  const unsigned expected = bits[CO_GET_IDX(word) - 1];
  const bool fits = expected % 8 == 0 || USE_PDO_BITS != 0;
  return !transmit && fits && CO_GET_SUB(word) == 0 && (word & 0xFFU) == expected ? 0 : not_mappable;
}

}  // namespace

ModelObjects::ModelObjects(const CO_DICT& dict) {
  for (std::uint16_t n = 0; n < dict.Num; ++n) {
    const CO_OBJ& entry = dict.Root[n];
    const bool is_bit = USE_PDO_BITS != 0 && entry.Type == CO_TBOOLEAN;
    objects_[CO_GET_DEV(entry.Key)] = {entry.Key & 0xFFU, bits_of(entry.Type), is_bit};
    indices_.insert(CO_GET_IDX(entry.Key));
  }
}

std::uint32_t ModelObjects::check(bool transmit, std::uint32_t word) const {
  const std::uint16_t index = CO_GET_IDX(word);
  if (index >= 1 && index <= 7) {
    return check_dummy(transmit, word);
  }
  if (indices_.count(index) == 0) {
    return no_object;
  }
  const auto found = objects_.find(CO_GET_DEV(word));
  if (found == objects_.end()) {
    return not_mappable;
  }
  const std::uint32_t rights = transmit ? CO_OBJ____PR_ : CO_OBJ____P_W;
  const bool has_rights = (found->second.flags & rights) == rights;
  const unsigned bits = word & 0xFFU;
  const bool has_length = bits != 0 && (bits == found->second.bits || (bits == 1 && found->second.is_bit));
  return has_rights && has_length ? 0 : not_mappable;
}

std::vector<std::uint32_t> ModelObjects::mappable(bool transmit) const {
  std::vector<std::uint32_t> words;
  for (const auto& [dev, object] : objects_) {
    const std::uint32_t word = dev | (object.is_bit ? 1 : object.bits);
    if (CO_IS_ASYNC(object.flags) == 0 && check(transmit, word) == 0) {
      words.push_back(word);
    }
  }
  return words;
}

std::uint32_t PdoModel::check_cob_id(std::uint32_t value) const {
  constexpr std::uint32_t off = 0x80000000;
  constexpr std::uint32_t no_remote = 0x40000000;
  constexpr std::uint32_t wide = 0x20000000;
  if ((value & off) != 0) {
    return 0;
  }
  if (transmit_ && USE_PDO_RTR == 0 && (value & no_remote) == 0) {
    return invalid_value;
  }
  if (exists()) {
    return ((value ^ pdo_.cob_id) & ~no_remote) == 0 ? 0 : invalid_value;  // a valid PDO keeps bits 0 to 29
  }
  const bool fits = (value & wide) != 0 || (value & 0x1FFFF800U) == 0;
  const bool is_free = !is_forbidden(value & 0x1FFFFFFFU);
  return fits && is_free && pdo_.number != 0 ? 0 : invalid_value;
}

bool PdoModel::is_type(std::uint32_t value) const {
  const bool remote = transmit_ && USE_PDO_RTR != 0 && (value == 252 || value == 253);
  return (USE_SYNC != 0 && value <= 240) || remote || value >= 254;
}

std::uint32_t PdoModel::write_communication(std::uint8_t sub, std::uint32_t value) {
  const auto result = [&](bool right, auto& parameter) -> std::uint32_t {
    if (!right) {
      return invalid_value;
    }
    parameter = static_cast<std::decay_t<decltype(parameter)>>(value);
    return 0;
  };
  switch (sub) {
    case 1: return result(check_cob_id(value) == 0, pdo_.cob_id);
    case 2: return result(is_type(value), pdo_.type);
    case 3: return result(!exists() || value == pdo_.inhibit, pdo_.inhibit);
    case 5: return result(true, pdo_.event);
    case 6:
      if (!transmit_) return no_sub_index;
      return result(value <= 240 && (!exists() || value == pdo_.start), pdo_.start);
    default: return no_sub_index;
  }
}

std::uint32_t PdoModel::read_communication(std::uint8_t sub) const {
  switch (sub) {
    case 1: return pdo_.cob_id;
    case 2: return pdo_.type;
    case 3: return pdo_.inhibit;
    case 5: return pdo_.event;
    default: return pdo_.start;
  }
}

std::uint32_t PdoModel::write_number(std::uint32_t value) {
  if (exists()) {
    return unsupported_access;
  }
  pdo_.number = 0;
  unsigned bits = 0;
  for (std::uint32_t n = 0; n < value; ++n) {
    if (n >= pdo_.map.size() || pdo_.map[n] == 0) {
      return too_long;
    }
    bits += pdo_.map[n] & 0xFFU;
  }
  if (bits > 64) {
    return too_long;
  }
  pdo_.number = static_cast<std::uint8_t>(value);
  return 0;
}

std::uint32_t PdoModel::write_word(std::uint8_t sub, std::uint32_t value) {
  if (sub > pdo_.map.size()) {
    return no_sub_index;
  }
  if (exists() || pdo_.number != 0) {
    return unsupported_access;
  }
  const std::uint32_t abort = value == 0 ? 0 : objects_.check(transmit_, value);
  if (abort == 0) {
    pdo_.map[sub - 1U] = value;
  }
  return abort;
}

std::vector<std::uint32_t> PdoModel::words() const { return {pdo_.map.begin(), pdo_.map.begin() + pdo_.number}; }

std::string PdoModel::identifier() const {
  char text[16];
  const bool wide = (pdo_.cob_id & 0x20000000U) != 0;
  std::snprintf(text, sizeof text, wide ? "%08X" : "%03X", static_cast<unsigned>(pdo_.cob_id & 0x1FFFFFFFU));
  return text;
}

}  // namespace test
