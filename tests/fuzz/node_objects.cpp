// SPDX-License-Identifier: Apache-2.0
#include "fuzz/node_objects.hpp"

#include <algorithm>
#include <cstring>

#include "fuzz/fuzz.hpp"

namespace fuzz {

Source source;

namespace {

CO_ERR answer_of(CO_OBJ* obj, CO_NODE* node) {
  const CO_ERR err = mood();
  if (err != CO_ERR_NONE) {
    COObjTypeUserSDOAbort(obj, node, CO_SDO_ERR_NO_DATA);
  }
  return err;
}

std::uint32_t size_of_short(CO_OBJ*, CO_NODE*, std::uint32_t) {
  mood();
  return 4;
}
std::uint32_t size_of_long(CO_OBJ*, CO_NODE*, std::uint32_t width) {
  mood();
  return width != 0 && width < long_value ? width : long_value;
}
// Returns a different random size at each call: 1…20.
std::uint32_t size_of_chance(CO_OBJ*, CO_NODE*, std::uint32_t) {
  meddle();
  return 1 + chance(long_value);
}
CO_ERR init(CO_OBJ* obj, CO_NODE* node) { return answer_of(obj, node); }
CO_ERR read(CO_OBJ* obj, CO_NODE* node, void* buffer, std::uint32_t size) {
  require(size <= long_value, "a type function is asked for no more than its size");
  std::memset(buffer, 0x22, size);
  return answer_of(obj, node);
}
CO_ERR write(CO_OBJ* obj, CO_NODE* node, void* buffer, std::uint32_t size) {
  require(size <= long_value, "a type function is given no more than its size");
  std::uint8_t copy[long_value];
  std::memcpy(copy, buffer, size);
  return answer_of(obj, node);
}
CO_ERR reset(CO_OBJ* obj, CO_NODE* node, std::uint32_t) { return answer_of(obj, node); }

constexpr CO_OBJ_TYPE short_value_type = {size_of_short, init, read, write, nullptr};
constexpr CO_OBJ_TYPE long_value_type = {size_of_long, nullptr, read, write, nullptr};
constexpr CO_OBJ_TYPE stream_type = {size_of_long, nullptr, read, write, reset};
constexpr CO_OBJ_TYPE moody_type = {size_of_chance, nullptr, read, write, nullptr};
constexpr CO_OBJ_TYPE moody_stream_type = {size_of_chance, init, read, write, reset};
constexpr CO_OBJ_TYPE empty_type = {nullptr, nullptr, nullptr, nullptr, nullptr};

// A byte that an SRDO can map: its value depends on Data.
std::uint32_t size_of_byte(CO_OBJ*, CO_NODE*, std::uint32_t) { return 1; }
CO_ERR read_byte(CO_OBJ* obj, CO_NODE*, void* buffer, std::uint32_t size) {
  std::memset(buffer, obj->Data == 0 ? 0x5A : 0xA5, size);
  return mood();
}
CO_ERR write_byte(CO_OBJ*, CO_NODE*, void*, std::uint32_t) { return mood(); }
constexpr CO_OBJ_TYPE byte_type = {size_of_byte, nullptr, read_byte, write_byte, nullptr};

std::uint32_t size_of_source(CO_OBJ*, CO_NODE*, std::uint32_t width) {
  if (width == 0) {
    return source.is_read ? Source::bytes : CO_OBJ_SIZE_UNKNOWN;
  }
  return std::min(width, 2 * large_domain);
}
CO_ERR read_source(CO_OBJ* obj, CO_NODE* node, void* buffer, std::uint32_t size) {
  const std::uint32_t n = std::min(size, Source::bytes - std::min(Source::bytes, source.position));
  std::memset(buffer, 0x33, n);
  source.position += n;
  source.is_read |= n < size;
  return answer_of(obj, node);
}
CO_ERR write_source(CO_OBJ* obj, CO_NODE* node, void* buffer, std::uint32_t size) {
  const std::vector<std::uint8_t> copy(static_cast<std::uint8_t*>(buffer), static_cast<std::uint8_t*>(buffer) + size);
  source.position += static_cast<std::uint32_t>(copy.size());
  return answer_of(obj, node);
}
CO_ERR reset_source(CO_OBJ*, CO_NODE*, std::uint32_t position) {
  source.position = position;
  return CO_ERR_NONE;
}
CO_ERR begin_source(CO_OBJ* obj, CO_NODE* node, CO_OBJ_TRANSFER, std::uint32_t) {
  require(source.open == 0 || source.has_moved, "a stream belongs to one transfer at a time");
  source.is_read = false;
  const CO_ERR err = answer_of(obj, node);
  source.open = err == CO_ERR_NONE ? 1 : 0;
  return err;
}
CO_ERR end_source(CO_OBJ* obj, CO_NODE* node, CO_OBJ_TRANSFER, std::uint32_t) {
  require(source.open == 1 || source.has_moved, "a transfer ends once, if it has begun");
  source.open = 0;
  return answer_of(obj, node);
}
constexpr CO_OBJ_TYPE_EX source_type = {
    {size_of_source, nullptr, read_source, write_source, COObjTypeExReset}, reset_source, begin_source, end_source};

#if USE_OD
// Returns the result of an extension: usually the correct one, else a random one.
ODR_t extension_answer(OD_stream_t* stream, OD_size_t count, OD_size_t* passed, bool is_last) {
  const std::uint32_t what = chance(16);
  *passed = what == 15 ? chance(256) : count;
  stream->dataOffset = is_last ? 0 : stream->dataOffset + count;
  if (what == 14) {
    stream->dataOffset = chance(256);
    stream->dataLength = chance(256);
  }
  if (what == 13) {
    return static_cast<ODR_t>(static_cast<int>(chance(30)) - 2);
  }
  return is_last ? ODR_OK : ODR_PARTIAL;
}
// Reads from the extension. The buffer has at least \a count bytes, or the address sanitizer reports an error.
ODR_t read_extended(OD_stream_t* stream, void* buf, OD_size_t count, OD_size_t* passed) {
  meddle();
  require(count != 0, "an extension is asked for a byte, at least");
  std::memset(buf, static_cast<int>(chance(4)), count);
  const std::uint32_t left = chance(64);
  return left < 8 ? extension_answer(stream, left < count ? left : count, passed, true)
                  : extension_answer(stream, count, passed, false);
}
ODR_t write_extended(OD_stream_t* stream, const void* buf, OD_size_t count, OD_size_t* passed) {
  const std::vector<std::uint8_t> copy(static_cast<const std::uint8_t*>(buf),
                                       static_cast<const std::uint8_t*>(buf) + count);
  meddle();
  return extension_answer(stream, static_cast<OD_size_t>(copy.size()), passed,
                          stream->dataOffset + count == stream->dataLength);
}
#endif

}  // namespace

#if USE_OD
OD_extension_t extension = {nullptr, read_extended, write_extended, {}};
#endif

std::vector<CO_OBJ> dictionary(Objects& o) {
  constexpr bool holds_64_bits = sizeof(CO_DATA) == sizeof(std::uint64_t);
  std::vector<CO_OBJ> table = {
      {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0x191)},
      {CO_KEY(0x1001, 0, CO_OBJ_____R_), CO_TUNSIGNED8, (CO_DATA)(&o.error_register)},
      {CO_KEY(0x1008, 0, CO_OBJ_____R_), CO_TSTRING, (CO_DATA)(&o.name)},
      {CO_KEY(0x1017, 0, CO_OBJ_____RW), CO_THB_PROD, (CO_DATA)(&o.heartbeat)},
      {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(5)},
      {CO_KEY(0x1200, 1, CO_OBJ__N__RW), CO_TSDO_ID, (CO_DATA)(&o.cob_id[0])},
      {CO_KEY(0x1200, 2, CO_OBJ__N__RW), CO_TSDO_ID, (CO_DATA)(&o.cob_id[1])},
      {CO_KEY(0x1201, 1, CO_OBJ_____RW), CO_TSDO_ID, (CO_DATA)(&o.cob_id[2])},
      {CO_KEY(0x1201, 2, CO_OBJ_____RW), CO_TSDO_ID, (CO_DATA)(&o.cob_id[3])},
      {CO_KEY(0x1202, 1, CO_OBJ_DN__RW), CO_TSDO_ID, (CO_DATA)(CO_SDO_ID_OFF)},
      {CO_KEY(0x1202, 2, CO_OBJ_DN__RW), CO_TSDO_ID, (CO_DATA)(CO_SDO_ID_OFF)},
      {CO_KEY(0x1280, 1, CO_OBJ_____RW), CO_TSDO_ID, (CO_DATA)(&o.client_tx[0])},
      {CO_KEY(0x1280, 2, CO_OBJ_____RW), CO_TSDO_ID, (CO_DATA)(&o.client_rx[0])},
      {CO_KEY(0x1280, 3, CO_OBJ_____RW), CO_TUNSIGNED8, (CO_DATA)(&o.server_node_id[0])},
      {CO_KEY(0x1281, 1, CO_OBJ_____RW), CO_TSDO_ID, (CO_DATA)(&o.client_tx[1])},
      {CO_KEY(0x1281, 2, CO_OBJ_____RW), CO_TSDO_ID, (CO_DATA)(&o.client_rx[1])},
      {CO_KEY(0x1281, 3, CO_OBJ_____RW), CO_TUNSIGNED8, (CO_DATA)(&o.server_node_id[1])},
      {CO_KEY(0x2000, 0, CO_OBJ___APRW), CO_TUNSIGNED8, (CO_DATA)(&o.u8)},
      {CO_KEY(0x2000, 1, CO_OBJ____PRW), CO_TUNSIGNED16, (CO_DATA)(&o.u16)},
      {CO_KEY(0x2000, 2, CO_OBJ__N_PRW), CO_TUNSIGNED24, (CO_DATA)(&o.u24)},
      {CO_KEY(0x2000, 3, CO_OBJ___APRW), CO_TUNSIGNED32, (CO_DATA)(&o.u32)},
      {CO_KEY(0x2000, 4, CO_OBJ____PRW), CO_TUNSIGNED40, (CO_DATA)(&o.u40)},
      {CO_KEY(0x2000, 5, CO_OBJ___APRW), CO_TUNSIGNED56, (CO_DATA)(&o.u56)},
      {CO_KEY(0x2000, 6, CO_OBJ____PRW), CO_TUNSIGNED64, (CO_DATA)(&o.u64)},
      {CO_KEY(0x2000, 7, CO_OBJ____PRW), CO_TSIGNED24, (CO_DATA)(&o.s24)},
      {CO_KEY(0x2000, 8, CO_OBJ____PRW), CO_TREAL32, (CO_DATA)(&o.real32)},
      {CO_KEY(0x2000, 9, CO_OBJ____PRW), CO_TREAL64, (CO_DATA)(&o.real64)},
      {CO_KEY(0x2000, 10, CO_OBJ____PRW), CO_TTIME_OF_DAY, (CO_DATA)(&o.time_of_day)},
      {CO_KEY(0x2000, 11, CO_OBJ____PRW), CO_TBOOLEAN, (CO_DATA)(&o.boolean)},
      {CO_KEY(0x2000, 12, CO_OBJ_______), CO_TUNSIGNED8, (CO_DATA)(&o.no_access)},
      {CO_KEY(0x2000, 13, CO_OBJ_D___RW | CO_OBJ____P__), CO_TUNSIGNED32, (CO_DATA)(7)},
      {CO_KEY(0x2100, 0, CO_OBJ____PRW), CO_TDOMAIN, (CO_DATA)(&o.domain)},
      {CO_KEY(0x2100, 1, CO_OBJ_____RW), CO_TDOMAIN, (CO_DATA)(&o.small_domain)},
      {CO_KEY(0x2100, 2, CO_OBJ_____RW), CO_TVISIBLE_STRING, (CO_DATA)(&o.text)},
      {CO_KEY(0x2100, 3, CO_OBJ_____RW), CO_TOCTET_STRING, (CO_DATA)(&o.octets)},
      {CO_KEY(0x2100, 4, CO_OBJ_____RW), CO_TUNICODE_STRING, (CO_DATA)(&o.unicode)},
      {CO_KEY(0x2100, 5, CO_OBJ_____RW), CO_TOCTET_STRING, (CO_DATA)(&o.nothing)},
      {CO_KEY(0x2100, 6, CO_OBJ_____RW), CO_TDOMAIN, (CO_DATA)(&o.large)},
      {CO_KEY(0x2200, 0, CO_OBJ___APRW), &short_value_type, (CO_DATA)(1)},
      {CO_KEY(0x2200, 1, CO_OBJ_____RW), &stream_type, (CO_DATA)(1)},
      {CO_KEY(0x2200, 2, CO_OBJ_____RW), &long_value_type, (CO_DATA)(1)},
      {CO_KEY(0x2200, 3, CO_OBJ____PRW), &moody_type, (CO_DATA)(1)},
      {CO_KEY(0x2200, 4, CO_OBJ_____RW), &moody_stream_type, (CO_DATA)(1)},
      {CO_KEY(0x2200, 5, CO_OBJ_____RW), &empty_type, (CO_DATA)(1)},
      {CO_KEY(0x2200, 6, (holds_64_bits ? CO_OBJ_D_____ : 0U) | CO_OBJ____PRW), CO_TUNSIGNED64,
       holds_64_bits ? (CO_DATA)(7) : (CO_DATA)(&o.direct)},
      {CO_KEY(0x2200, 7, CO_OBJ_____RW), &source_type.Type, (CO_DATA)(1)},
      {CO_KEY(0x2310, 3, CO_OBJ____PRW), &byte_type, (CO_DATA)(0)},
      {CO_KEY(0x2311, 3, CO_OBJ____PRW), &byte_type, (CO_DATA)(1)},
  };
#if USE_OD
  table.push_back({CO_KEY(0x2000, 14, CO_OBJ_____RW), OD_TSTREAM, (CO_DATA)(0)});
  table.push_back({CO_KEY(0x2000, 15, CO_OBJ_____RW), OD_TVISIBLE_STRING, (CO_DATA)(&o.extended_text)});
#endif
  add_network(table, o.network);
  std::sort(table.begin(), table.end(),
            [](const CO_OBJ& left, const CO_OBJ& right) { return CO_GET_DEV(left.Key) < CO_GET_DEV(right.Key); });
  return table;
}

}  // namespace fuzz
