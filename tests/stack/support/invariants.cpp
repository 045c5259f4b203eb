// SPDX-License-Identifier: Apache-2.0
#include "invariants.hpp"

#include <algorithm>
#include <cstring>

#include "notation.hpp"
#include "stride.hpp"

namespace test {
namespace {

bool zero_from(const CO_IF_FRM& frm, unsigned first) {
  return std::all_of(frm.Data + first, frm.Data + 8, [](std::uint8_t byte) { return byte == 0; });
}

std::uint32_t little_endian(const std::uint8_t* bytes) {
  return bytes[0] | (std::uint32_t{bytes[1]} << 8) | (std::uint32_t{bytes[2]} << 16) | (std::uint32_t{bytes[3]} << 24);
}

// Checks an answer of an upload. Bytes without data are 0. [301:7.2.4.3.3]
std::string fault_of_upload_answer(const CO_IF_FRM& frm) {
  switch (frm.Data[0]) {
    case 0x40: return zero_from(frm, 4) ? "" : "reserved bytes not 0";
    case 0x41:
    case 0x43: return "";
    case 0x47: return zero_from(frm, 7) ? "" : "bytes beyond the data not 0";
    case 0x4B: return zero_from(frm, 6) ? "" : "bytes beyond the data not 0";
    case 0x4F: return zero_from(frm, 5) ? "" : "bytes beyond the data not 0";
    default: return "no answer of an SDO server";
  }
}

std::string fault_of_segment(const CO_IF_FRM& frm) {
  const unsigned length = 7U - ((frm.Data[0] >> 1) & 7U);
  if (length < 7 && (frm.Data[0] & 1U) == 0) {
    return "a segment that is not full and not the last";
  }
  return zero_from(frm, 1 + length) ? "" : "bytes beyond the data not 0";
}

// Checks an answer of a block download. The server always supports the CRC. [301:7.2.4.3.9, 7.2.4.3.10, 7.2.4.3.11]
std::string fault_of_block_download(const CO_IF_FRM& frm) {
  const std::uint8_t blksize = frm.Data[frm.Data[0] == 0xA2 ? 2 : 4];
  const bool is_blksize = blksize >= 1 && blksize <= 127;
  switch (frm.Data[0]) {
    case 0xA4: return is_blksize && zero_from(frm, 5) ? "" : "no block size, or reserved bytes not 0";
    case 0xA2: return is_blksize && frm.Data[1] <= 127 && zero_from(frm, 3) ? "" : "no block size or sequence number";
    case 0xA1: return zero_from(frm, 1) ? "" : "reserved bytes not 0";
    default: return "no answer of an SDO server";
  }
}

// [301:7.2.4.3.12, 7.2.4.3.15]
std::string fault_of_block_upload(const CO_IF_FRM& frm) {
  switch (frm.Data[0] & 0xE3U) {
    case 0xC0: return frm.Data[0] == 0xC4 && zero_from(frm, 4) ? "" : "reserved bits or bytes not 0";
    case 0xC2: return frm.Data[0] == 0xC6 ? "" : "reserved bits not 0";
    case 0xC1: return zero_from(frm, 3) ? "" : "reserved bytes not 0";
    default: return "no answer of an SDO server";
  }
}

std::string fault_of_sdo(const CO_IF_FRM& frm, bool sending) {
  if (frm.DLC != 8) {
    return "DLC not 8";
  }
  if (sending && frm.Data[0] != 0x80) {
    return (frm.Data[0] & 0x7FU) != 0 ? "" : "a segment without a number";
  }
  switch (frm.Data[0] >> 5) {
    case 0: return fault_of_segment(frm);
    case 1: return (frm.Data[0] & 0x0FU) == 0 && zero_from(frm, 1) ? "" : "reserved bits or bytes not 0";
    case 2: return fault_of_upload_answer(frm);
    case 3: return frm.Data[0] == 0x60 && zero_from(frm, 4) ? "" : "reserved bits or bytes not 0";
    case 4: return frm.Data[0] == 0x80 && little_endian(frm.Data + 4) != 0 ? "" : "abort without a code";
    case 5: return fault_of_block_download(frm);
    case 6: return fault_of_block_upload(frm);
    default: return "no answer of an SDO server";
  }
}

// [301:7.2.8.2.2.1] [N4] [N5]
std::string fault_of_error_control(const CO_IF_FRM& frm, CO_MODE mode) {
  if (frm.DLC != 1) {
    return "DLC not 1";
  }
  const std::uint8_t state = frm.Data[0];
  if (state == 0x00) {
    return mode == CO_INIT || mode == CO_PREOP ? "" : "boot-up in a wrong state";
  }
  const bool right = (state == 0x7F && mode == CO_PREOP) || (state == 0x05 && mode == CO_OPERATIONAL) ||
                     (state == 0x04 && mode == CO_STOP);
  return right ? "" : "heartbeat tells another state";
}

// [301:7.2.7.3.1] [E1] [E3]
std::string fault_of_emergency(const CO_IF_FRM& frm, CO_MODE mode) {
  if (mode != CO_PREOP && mode != CO_OPERATIONAL) {
    return "EMCY in a state that forbids it";
  }
  if (frm.DLC != 8) {
    return "DLC not 8";
  }
  const std::uint8_t reg = frm.Data[2];
  return reg == 0 || (reg & 0x41U) == 0x01 ? "" : "error register without generic error, or with reserved bit";
}

}  // namespace

std::string fault_of(const CO_IF_FRM& frm, std::uint8_t node_id, CO_MODE mode, bool sdo, bool sending) {
  if (frm.Identifier == 0) {
    return "an NMT command, which only the master may send";
  }
  if (frm.DLC > 8 || !zero_from(frm, frm.DLC)) {
    return "bytes beyond the DLC not 0";
  }
  if (sdo) {
    const bool allowed = mode == CO_PREOP || mode == CO_OPERATIONAL;
    return allowed ? fault_of_sdo(frm, sending) : "SDO in a state that forbids it";
  }
  if (frm.Identifier == 0x080U + node_id) {
    return fault_of_emergency(frm, mode);
  }
  return frm.Identifier == 0x700U + node_id ? fault_of_error_control(frm, mode) : "";
}

void MemoryWatch::add(std::uint32_t key, const void* memory, std::size_t size, bool stream) {
  if (memory == nullptr) {
    return;
  }
  const auto* bytes = static_cast<const std::uint8_t*>(memory);
  regions_.push_back({key, bytes, size, stream, copies_.size()});
  copies_.insert(copies_.end(), bytes, bytes + size);
}

namespace {

constexpr std::size_t largest_watched = 100000 / stride(20);  // bytes; limits the time of the check after each frame

struct Width {
  const CO_OBJ_TYPE* type;
  std::size_t bytes;  // size of the variable
};

const Width* width_of(const CO_OBJ_TYPE* type) {
  static const Width widths[] = {
    {CO_TUNSIGNED8, 1},
    {CO_TBOOLEAN, 1},
    {CO_TUNSIGNED16, 2},
    {CO_TUNSIGNED24, 4},
    {CO_TSIGNED24, 4},
    {CO_TUNSIGNED32, 4},
    {CO_TUNSIGNED40, 8},
    {CO_TUNSIGNED48, 8},
    {CO_TUNSIGNED56, 8},
    {CO_TSIGNED40, 8},
    {CO_TSIGNED48, 8},
    {CO_TSIGNED56, 8},
    {CO_TUNSIGNED64, 8},
    {CO_TREAL32, 4},
    {CO_TREAL64, 8},
    {CO_THB_PROD, 2},
    {CO_TSDO_ID, 4},
    {CO_TTIME_OF_DAY, sizeof(CO_TIME_OF_DAY)},
#if USE_EMCY
    {CO_TEMCY_ID, 4},
#endif
#if CO_EMCY_CONS_N > 0
    {CO_TEMCY_CONS, 4},
#endif
  };
  const auto* found =
      std::find_if(std::begin(widths), std::end(widths), [=](const Width& w) { return w.type == type; });
  return found == std::end(widths) ? nullptr : found;
}

template <class T>
T* behind(const CO_OBJ& entry) {
  return static_cast<T*>(entry.Data);
}

bool is_string(const CO_OBJ_TYPE* type) {
  return type == CO_TVISIBLE_STRING || type == CO_TOCTET_STRING || type == CO_TUNICODE_STRING;
}

}  // namespace

void MemoryWatch::add(CO_OBJ& entry) {
  if (CO_IS_DIRECT(entry.Key) != 0) {
    add(entry.Key, &entry.Data, sizeof entry.Data, false);
  } else if (behind<void>(entry) == nullptr) {
    return;
  } else if (const Width* width = width_of(entry.Type); width != nullptr) {
    add(entry.Key, behind<void>(entry), width->bytes, false);
  } else if (entry.Type == CO_TDOMAIN) {
    const auto* domain = behind<CO_OBJ_DOM>(entry);
    if (domain->Size <= largest_watched) {
      add(entry.Key, domain->Start, domain->Size, true);
    }
  } else if (entry.Type == CO_TSTRING) {
    const auto* text = reinterpret_cast<const char*>(behind<CO_OBJ_STR>(entry)->Start);
    add(entry.Key, text, std::strlen(text) + 1, true);
  } else if (is_string(entry.Type)) {
    const auto* text = behind<CO_OBJ_STR_RW>(entry);
    add(entry.Key, text->Start, text->Capacity, true);
    add(entry.Key, &text->Size, sizeof text->Size, true);
  }
}

void MemoryWatch::release(std::uint32_t dev) {
  Region* to = begin();
  for (const Region *from = begin(), *last = end(); from != last; ++from) {
    if (CO_GET_DEV(from->key) != dev) {
      *to++ = *from;
    }
  }
  regions_.resize(static_cast<std::size_t>(to - begin()));
}

void MemoryWatch::remember() {
  std::uint8_t* const copies = copies_.data();
  for (const Region *region = begin(), *last = end(); region != last; ++region) {
    if (region->size > 0) {
      std::memcpy(copies + region->copy, region->memory, region->size);
    }
  }
}

std::vector<std::uint32_t> MemoryWatch::changed() const {
  std::vector<std::uint32_t> devs;
  const std::uint8_t* const copies = copies_.data();
  for (const Region *region = begin(), *last = end(); region != last; ++region) {
    if (region->size > 0 && std::memcmp(copies + region->copy, region->memory, region->size) != 0) {
      devs.push_back(CO_GET_DEV(region->key));
    }
  }
  return devs;
}

const MemoryWatch::Region* MemoryWatch::find(std::uint32_t dev) const {
  const auto same = [=](const Region& region) { return CO_GET_DEV(region.key) == dev; };
  const auto* found = std::find_if(begin(), end(), same);
  return found == end() ? nullptr : found;
}

bool MemoryWatch::is_stream(std::uint32_t dev) const {
  const Region* region = find(dev);
  return region != nullptr && region->stream;
}

bool MemoryWatch::is_read_only(std::uint32_t dev) const {
  const Region* region = find(dev);
  return region != nullptr && CO_IS_WRITE(region->key) == 0;
}

bool MemoryWatch::shares(std::uint32_t dev, const std::set<std::uint32_t>& allowed) const {
  const Region* region = find(dev);
  return std::any_of(allowed.begin(), allowed.end(), [&](std::uint32_t other) {
    const Region* twin = find(other);
    return twin != nullptr && region != nullptr && twin->memory == region->memory;
  });
}

}  // namespace test
