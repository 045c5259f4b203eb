// SPDX-License-Identifier: Apache-2.0
// Prints the functions of the stack that operations of a node call: "WALK<TAB>name", then "DEPTH<TAB>ADDRESS" for each
// call in the order of the calls. walk.py translates the addresses.
#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "co_core.h"

namespace {

struct Call {
  unsigned depth;
  std::uintptr_t function;
};

Call calls[4096];
unsigned calls_num;
unsigned depth;
bool records;

}  // namespace

extern "C" {

void __cyg_profile_func_enter(void* function, void*) {
  if (records && calls_num < sizeof calls / sizeof calls[0]) {
    calls[calls_num++] = {depth, reinterpret_cast<std::uintptr_t>(function)};
  }
  ++depth;
}

void __cyg_profile_func_exit(void*, void*) { --depth; }

}  // extern "C"

namespace {

// Drivers: one received frame, frames sent are dropped, a clock that stands still, 1 KB of memory.
CO_IF_FRM received;
bool is_received;
std::uint8_t memory[1024];

std::int16_t read(void*, CO_IF_FRM* frm) {
  if (!is_received) {
    return 0;
  }
  is_received = false;
  *frm = received;
  return sizeof *frm;
}
std::int16_t send(void*, const CO_IF_FRM* frm) { return sizeof *frm; }
void nothing(void*) {}
const CO_IF_CAN_DRV_EX can = {nothing, [](void*, std::uint32_t) {}, read, send, nothing, nothing, nullptr, nullptr};

const CO_IF_TIMER_DRV_EX timer = {[](void*, std::uint32_t) {}, [](void*) { return std::uint32_t{0}; }, nullptr};

std::uint32_t load(void*, std::uint32_t start, std::uint8_t* buffer, std::uint32_t size) {
  std::memcpy(buffer, memory + start, size);
  return size;
}
std::uint32_t store(void*, std::uint32_t start, const std::uint8_t* buffer, std::uint32_t size) {
  std::memcpy(memory + start, buffer, size);
  return size;
}
CO_NVM_SHAPE shape(void*) {
  CO_NVM_SHAPE of{};
  of.Capacity = sizeof memory;
  return of;
}
const CO_IF_NVM_DRV_EX nvm = {nothing, load, store, nullptr, shape};

// The dictionary: an RPDO, a synchronous TPDO, a domain, a parameter group.
std::uint8_t error_register;
std::uint32_t target;
std::uint32_t source = 0x12345678;
std::uint32_t parameter = 7;
std::uint8_t bytes[64];
CO_OBJ_DOM domain = {0, sizeof bytes, bytes};
CO_PARA group;

CO_OBJ dictionary[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, CO_DATA(0)},
    {CO_KEY(0x1001, 0, CO_OBJ_____R_), CO_TUNSIGNED8, CO_DATA(&error_register)},
    {CO_KEY(0x1005, 0, CO_OBJ_D___R_), CO_TSYNC_ID, CO_DATA(0x80)},
    {CO_KEY(0x1010, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, CO_DATA(1)},
    {CO_KEY(0x1010, 1, CO_OBJ_____RW), CO_TPARA_STORE, CO_DATA(&group)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, CO_DATA(1)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, CO_DATA(0)},
    {CO_KEY(0x1400, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, CO_DATA(2)},
    {CO_KEY(0x1400, 1, CO_OBJ_DN__R_), CO_TPDO_ID, CO_DATA(CO_COBID_RPDO_DEFAULT(0))},
    {CO_KEY(0x1400, 2, CO_OBJ_D___R_), CO_TPDO_TYPE, CO_DATA(254)},
    {CO_KEY(0x1600, 0, CO_OBJ_D___R_), CO_TPDO_NUM, CO_DATA(1)},
    {CO_KEY(0x1600, 1, CO_OBJ_D___R_), CO_TPDO_MAP, CO_DATA(CO_LINK(0x2000, 0, 32))},
    {CO_KEY(0x1800, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, CO_DATA(2)},
    {CO_KEY(0x1800, 1, CO_OBJ_DN__R_), CO_TPDO_ID, CO_DATA(CO_COBID_TPDO_DEFAULT(0))},
    {CO_KEY(0x1800, 2, CO_OBJ_D___R_), CO_TPDO_TYPE, CO_DATA(1)},
    {CO_KEY(0x1A00, 0, CO_OBJ_D___R_), CO_TPDO_NUM, CO_DATA(1)},
    {CO_KEY(0x1A00, 1, CO_OBJ_D___R_), CO_TPDO_MAP, CO_DATA(CO_LINK(0x2001, 0, 32))},
    {CO_KEY(0x2000, 0, CO_OBJ____PRW), CO_TUNSIGNED32, CO_DATA(&target)},
    {CO_KEY(0x2001, 0, CO_OBJ____PR_), CO_TUNSIGNED32, CO_DATA(&source)},
    {CO_KEY(0x2002, 0, CO_OBJ_____RW), CO_TDOMAIN, CO_DATA(&domain)},
    CO_OBJ_DICT_ENDMARK,
};

CO_NODE node;
std::uint8_t sdo_buffer[CO_SSDO_N * CO_SDO_BUF_BYTE];

void require(bool condition, const char* what) {
  if (!condition) {
    std::fprintf(stderr, "walk: %s\n", what);
    std::exit(1);
  }
}

// Passes a frame to the node: process(0x201, {1, 2, 3, 4}).
template <unsigned length>
void process(std::uint32_t identifier, const std::uint8_t (&data)[length]) {
  received = {identifier, {}, length};
  std::memcpy(received.Data, data, length);
  is_received = true;
  CONodeProcess(&node);
}

template <class Operation>
void walk(const char* name, Operation operation) {
  calls_num = 0;
  depth = 0;
  records = true;
  operation();
  records = false;
  std::printf("WALK\t%s\n", name);
  for (unsigned n = 0; n < calls_num; ++n) {
    std::printf("%u\t%" PRIxPTR "\n", calls[n].depth, calls[n].function);
  }
}

void start() {
  static CO_NODE_SPEC spec = {1,    500000,  dictionary, sizeof dictionary / sizeof dictionary[0], nullptr, nullptr, 0,
                              1000, nullptr, sdo_buffer};
  static CO_NODE_EXT drivers;
  group.Size = sizeof parameter;
  group.Start = reinterpret_cast<std::uint8_t*>(&parameter);
  group.Type = CO_RESET_NODE;
  group.Value = CO_PARA___E;
  std::memset(memory, 0xFF, sizeof memory);
  drivers.Size = sizeof drivers;
  drivers.Can = &can;
  drivers.Timer = &timer;
  drivers.Nvm = &nvm;
  CONodeInitEx(&node, &spec, &drivers);
  CONodeStart(&node);
  require(CONodeGetErr(&node) == CO_ERR_NONE, "the node does not start");
  CONmtSetMode(&node.Nmt, CO_OPERATIONAL);
}

}  // namespace

int main() {
  start();
  walk("RPDO", [] { process(0x201, {1, 2, 3, 4}); });
  require(target == 0x04030201, "the RPDO is not written");
  walk("SYNC", [] {
    received = {0x080, {}, 0};
    is_received = true;
    CONodeProcess(&node);
  });
  walk("SDO upload", [] { process(0x601, {0x40, 0x00, 0x20, 0, 0, 0, 0, 0}); });
  walk("SDO block download", [] {
    process(0x601, {0xC2, 0x02, 0x20, 0, 14, 0, 0, 0});
    process(0x601, {0x01, 1, 2, 3, 4, 5, 6, 7});
    process(0x601, {0x82, 8, 9, 10, 11, 12, 13, 14});
    process(0x601, {0xC1, 0, 0, 0, 0, 0, 0, 0});
  });
  require(bytes[13] == 14, "the block is not written");
  walk("save", [] { process(0x601, {0x23, 0x10, 0x10, 1, 0x73, 0x61, 0x76, 0x65}); });
  require(memory[0] != 0xFF, "the group is not stored");
  walk("NMT reset", [] { process(0x000, {0x82, 0x01}); });
  return 0;
}
