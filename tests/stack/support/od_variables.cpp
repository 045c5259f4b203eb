// SPDX-License-Identifier: Apache-2.0

// The dictionary macros contain C casts, as in firmware.
#pragma GCC diagnostic ignored "-Wold-style-cast"

#include "od_variables.hpp"

#include <cstring>

#if USE_OD

namespace test {
namespace {

std::uint32_t number_size(CO_OBJ*, CO_NODE*, std::uint32_t) { return 4; }
CO_ERR number_read(CO_OBJ* obj, CO_NODE*, void* buffer, std::uint32_t size) {
  if (size != 4) {
    return CO_ERR_BAD_ARG;
  }
  std::memcpy(buffer, static_cast<const std::uint32_t*>(obj->Data), size);
  return CO_ERR_NONE;
}
CO_ERR number_write(CO_OBJ* obj, CO_NODE*, void* buffer, std::uint32_t size) {
  if (size != 4) {
    return CO_ERR_BAD_ARG;
  }
  std::memcpy(static_cast<std::uint32_t*>(obj->Data), buffer, size);
  return CO_ERR_NONE;
}
const CO_OBJ_TYPE number_type = {number_size, nullptr, number_read, number_write, nullptr};
constexpr OD_TYPE extensible_number = OD_VALUE(&number_type, OD_ORIGINAL);

std::uint32_t long_size(CO_OBJ*, CO_NODE*, std::uint32_t) { return 12; }
CO_ERR long_read(CO_OBJ* obj, CO_NODE*, void* buffer, std::uint32_t size) {
  std::memcpy(buffer, static_cast<const std::uint8_t*>(obj->Data), size);
  return CO_ERR_NONE;
}
CO_ERR long_write(CO_OBJ* obj, CO_NODE*, void* buffer, std::uint32_t size) {
  std::memcpy(static_cast<std::uint8_t*>(obj->Data), buffer, size);
  return CO_ERR_NONE;
}
const CO_OBJ_TYPE long_type = {long_size, nullptr, long_read, long_write, nullptr};

CO_OBJ logged_and_extensible(LoggedStream& stream, std::uint16_t index) {
  static const CO_OBJ_TYPE* const original = LoggedStream().plain(index).Type;
  static const OD_TYPE type = OD_STREAM(original, OD_ORIGINAL);
  return {CO_KEY(index, 0, CO_OBJ_____RW), &type.Ex.Type, CO_DATA(&stream)};
}

Bytes with_zeros(Bytes text, std::size_t length) {
  text.resize(length);
  return text;
}

Bytes up_to(std::uint8_t last) {
  Bytes all;
  for (std::uint8_t n = 1; n <= last; ++n) {
    all.push_back(n);
  }
  return all;
}

}  // namespace

Variables::Variables()
    : node(Setup()
               .only_small()
               .with(plain.plain(0x4000))
               .with(extended.extended(0x4001))
               .with(logged_and_extensible(extensible, 0x4002))
               .with({CO_KEY(0x4003, 0, CO_OBJ_____RW), &number_type, (CO_DATA)(&number)})
               .with({CO_KEY(0x4004, 0, CO_OBJ_____RW), &extensible_number.Ex.Type, (CO_DATA)(&other_number)})
               .with({CO_KEY(0x4005, 0, CO_OBJ_D___RW), CO_TUNSIGNED16, (CO_DATA)(0x1234)})
               .with({CO_KEY(0x4005, 1, CO_OBJ_D___RW), CO_TUNSIGNED32, (CO_DATA)(0x12345678)})
               .with({CO_KEY(0x4005, 2, CO_OBJ_D___RW), OD_TUNSIGNED8, (CO_DATA)(0x12)})
               .with({CO_KEY(0x4006, 0, CO_OBJ__N__RW), CO_TUNSIGNED32, (CO_DATA)(&relative)})
               .with({CO_KEY(0x4007, 0, CO_OBJ_____RW), OD_TDOMAIN, (CO_DATA)(&domain)})
               .with({CO_KEY(0x4008, 0, CO_OBJ_____RW), OD_TVISIBLE_STRING, (CO_DATA)(&text)})
               .with({CO_KEY(0x4009, 0, CO_OBJ_____RW), &long_type, (CO_DATA)(&long_value)})
               .with({CO_KEY(0x400A, 0, CO_OBJ_____RW), OD_TNUMBER, (CO_DATA)(4)})
               .with({CO_KEY(0x400A, 1, CO_OBJ_____RW), OD_TSTREAM, 0})
               .before_init([](Objects& o) {
                 o.boolean = 1;
                 o.octets = {0, 10, 10, o.octets_memory};
                 std::memcpy(o.octets_memory, "\1\2\3\4\5\6\7\10\11\12", 10);
                 o.real32 = -1.2345678F;
                 o.real64 = -1.2345678901234567;
               })) {
  plain.data = up_to(20);
  extended.data = up_to(21);
  extensible.data = up_to(22);
}

Variable Variables::at(const std::string& name, std::uint16_t index, std::uint8_t sub, const Bytes& value) {
  return {name, variable(node, index, sub), value};
}

Variable Variables::in_memory(const std::string& name, Bytes& bytes) { return {name, variable(bytes), bytes}; }

std::vector<Variable> Variables::writable() {
  const Objects& o = node.objects;
  return {in_memory("memory", memory),
          in_memory("a byte of memory", byte),
          at("UNSIGNED8", 0x2001, 0, bytes_of(o.u8)),
          at("UNSIGNED16", 0x2002, 0, bytes_of(o.u16)),
          at("UNSIGNED24", 0x2003, 0, bytes_of(o.u24, 3)),
          at("UNSIGNED32", 0x2004, 0, bytes_of(o.u32)),
          at("UNSIGNED40", 0x2005, 0, bytes_of(o.u40, 5)),
          at("UNSIGNED48", 0x2006, 0, bytes_of(o.u48, 6)),
          at("UNSIGNED56", 0x2007, 0, bytes_of(o.u56, 7)),
          at("UNSIGNED64", 0x2008, 0, bytes_of(o.u64)),
          at("REAL32", 0x2024, 0, bytes_of(o.real32)),
          at("REAL64", 0x2028, 0, bytes_of(o.real64)),
          at("flag D", 0x4005, 0, bytes_of(std::uint16_t{0x1234})),
          at("flag D, 32 bits", 0x4005, 1, bytes_of(std::uint32_t{0x12345678})),
          at("flag D, extensible", 0x4005, 2, {0x12}),
          at("OCTET_STRING", 0x2111, 0, up_to(10)),
          at("DOMAIN", 0x2100, 15, up_to(15)),
          at("DOMAIN of a byte", 0x2100, 1, up_to(1)),
          at("DOMAIN, extensible", 0x4007, 0, octets),
          at("a value of the application", 0x4003, 0, bytes_of(number)),
          at("a value of the application, extensible", 0x4004, 0, bytes_of(other_number))};
}

std::vector<Variable> Variables::all() {
  std::vector<Variable> all = writable();
  const std::vector<Variable> others = {
      at("BOOLEAN", 0x2020, 0, {1}),
      at("flag N", 0x4006, 0, bytes_of(relative + 1)),
      at("VISIBLE_STRING", 0x2110, 0, with_zeros({'t', 'e', 'x', 't'}, 16)),
      at("VISIBLE_STRING, extensible", 0x4008, 0, letters),
      at("UNICODE_STRING", 0x2112, 0, with_zeros({0x41, 0, 0xE4, 0, 0xAC, 0x20}, 8)),
      at("constant text", 0x1008, 0,
         {'L', 'e', 'x', 'i', 'c', 'a', 'n', ' ', 't', 'e', 's', 't', ' ', 'n', 'o', 'd', 'e'}),
      at("a stream of the application", 0x4000, 0, up_to(20)),
      at("a stream of the application that takes part in transfers", 0x4001, 0, up_to(21)),
      at("a stream of the application, extensible", 0x4002, 0, up_to(22))};
  all.insert(all.end(), others.begin(), others.end());
  return all;
}

}  // namespace test

#endif
