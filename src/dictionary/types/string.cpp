// SPDX-License-Identifier: Apache-2.0
#include "co_string.h"

#include "dictionary/types/stream.hpp"
#include "hal/port.hpp"
#include "wire/bytes.hpp"

namespace co::string {
namespace {

using stream::clip;

// Read-only text ------------------------------------------------------------------------------------------------------

uint32_t text_size(CO_OBJ* obj, CO_NODE*, uint32_t) {
  const auto* const text = data_of<const CO_OBJ_STR>(*obj);
  if (text == nullptr || text->Start == nullptr) {
    return 0;
  }
  uint32_t n = 0;
  while (text->Start[n] != 0) {
    ++n;
  }
  return n;
}

// Reads the next bytes of the text, which may have become shorter since the access began.
CO_ERR text_read(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  auto* const text = data_of<CO_OBJ_STR>(*obj);
  if (text == nullptr || text->Start == nullptr) {
    return CO_ERR_BAD_ARG;
  }
  const uint32_t n = clip(size, text->Offset, text_size(obj, node, 0));
  wire::copy(static_cast<uint8_t*>(buffer), text->Start + text->Offset, n);
  text->Offset += n;
  return CO_ERR_NONE;
}

// Strings that can be written -----------------------------------------------------------------------------------------

// Returns the string of an entry; null: the entry has no string, or the string has no memory.
CO_OBJ_STR_RW* find_string(const CO_OBJ& obj) {
  auto* const string = data_of<CO_OBJ_STR_RW>(obj);
  return string == nullptr || string->Start == nullptr ? nullptr : string;
}

// Returns the present length in bytes. The application may have set Size to more than Capacity.
uint32_t octets_in(const CO_OBJ_STR_RW& string) {
  return string.Size < string.Capacity ? string.Size : string.Capacity;
}

// Returns the present length in bytes of a text, which ends at its first zero.
uint32_t text_in(const CO_OBJ_STR_RW& string) {
  uint32_t n = 0;
  while (n < octets_in(string) && string.Start[n] != 0) {
    ++n;
  }
  return n;
}

// Returns the length of an upload if width is 0, else the length nearest to width that a download may have: any length
// up to the capacity.
uint32_t size_for(const CO_OBJ& obj, uint32_t width, uint32_t (*length)(const CO_OBJ_STR_RW&)) {
  const CO_OBJ_STR_RW* const string = find_string(obj);
  if (string == nullptr) {
    return 0;
  }
  if (width == 0) {
    return length(*string);
  }
  return width < string->Capacity ? width : string->Capacity;
}

uint32_t visible_size(CO_OBJ* obj, CO_NODE*, uint32_t width) { return size_for(*obj, width, text_in); }

uint32_t octet_size(CO_OBJ* obj, CO_NODE*, uint32_t width) { return size_for(*obj, width, octets_in); }

uint32_t unicode_size(CO_OBJ* obj, CO_NODE*, uint32_t width) { return size_for(*obj, width, octets_in) & ~1U; }

// Mask for the offsets of bytes in a UNICODE_STRING, whose characters are stored in the byte order of the CPU.
// [301:7.1.6.4]
constexpr uint32_t unicode_flip = wire::host_is_little_endian ? 0 : 1;

template <uint32_t flip>
CO_ERR read(CO_OBJ* obj, CO_NODE*, void* buffer, uint32_t size) {
  CO_OBJ_STR_RW* const string = find_string(*obj);
  if (string == nullptr) {
    return CO_ERR_BAD_ARG;
  }
  auto* to = static_cast<uint8_t*>(buffer);
  for (uint32_t n = clip(size, string->Offset, octets_in(*string)); n != 0; --n) {
    *to++ = string->Start[string->Offset++ ^ flip];
  }
  return CO_ERR_NONE;
}

template <uint32_t flip>
CO_ERR write(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  CO_OBJ_STR_RW* const string = find_string(*obj);
  if (string == nullptr) {
    return CO_ERR_BAD_ARG;
  }
  const auto* from = static_cast<const uint8_t*>(buffer);
  uint32_t n = clip(size, string->Offset, string->Capacity);
  if (!port::is_writable(*node, string->Start, string->Capacity)) {
    return CO_ERR_OBJ_ACC;
  }
  for (; n != 0; --n) {
    string->Start[string->Offset++ ^ flip] = *from++;
  }
  string->Size = string->Offset < string->Capacity ? string->Offset : string->Capacity;
  return CO_ERR_NONE;
}

CO_ERR visible_write(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  const CO_ERR err = write<0>(obj, node, buffer, size);
  if (err != CO_ERR_NONE) {
    return err;
  }
  const CO_OBJ_STR_RW& string = *find_string(*obj);
  if (string.Size < string.Capacity) {
    string.Start[string.Size] = 0;
  }
  return CO_ERR_NONE;
}

}  // namespace
}  // namespace co::string

extern "C" {

const CO_OBJ_TYPE COTString = {co::string::text_size, co::stream::init, co::string::text_read, nullptr,
                               co::stream::reset};
const CO_OBJ_TYPE COTVisibleString = {co::string::visible_size, co::stream::init, co::string::read<0>,
                                      co::string::visible_write, co::stream::reset};
const CO_OBJ_TYPE COTOctetString = {co::string::octet_size, co::stream::init, co::string::read<0>, co::string::write<0>,
                                    co::stream::reset};
const CO_OBJ_TYPE COTUnicodeString = {co::string::unicode_size, co::stream::init,
                                      co::string::read<co::string::unicode_flip>,
                                      co::string::write<co::string::unicode_flip>, co::stream::reset};

}  // extern "C"
