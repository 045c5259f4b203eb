// SPDX-License-Identifier: Apache-2.0
// Systematic inputs that the corpus of the fuzz targets may lack: every NMT command, every identifier, every SDO
// command in every state of the server, every LSS command, transfers of a large object by each protocol, and PDOs with
// the largest possible mapping. The input is the name of the sweep.
#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <iterator>
#include <string_view>
#include <vector>

#include "co_core.h"
#include "fuzz/fuzz.hpp"

namespace {

constexpr std::uint8_t node_id = 5;
constexpr unsigned pdos = 8;                // in each direction
constexpr unsigned mapped = 8;              // objects in each PDO
constexpr std::uint32_t large_size = 2000;  // larger than two buffers
constexpr std::uint32_t identity[] = {0x11111111, 0x22222222, 0x33333333, 0x44444444};
constexpr CO_MODE modes[] = {CO_PREOP, CO_OPERATIONAL, CO_STOP};

CO_NODE node;
CO_NODE_EXT ext;
CO_TMR_MEM timers[1];
std::uint8_t sdo_buffer[CO_SSDO_N * CO_SDO_BUF_BYTE];

std::uint8_t error_register;
std::uint16_t heartbeat = 0;
std::uint32_t sync_id = 0x80;
std::uint32_t time_id = CO_TIME_COBID_CONSUME | 0x100;
CO_HBCONS monitored;
std::uint8_t objects[pdos * mapped];
std::uint8_t large_memory[large_size];
CO_OBJ_DOM large;
std::uint32_t rpdo_id[pdos];
std::uint32_t tpdo_id[pdos];
std::uint8_t pdo_type;

std::vector<CO_OBJ> table;

const CO_IF_FRM* received = nullptr;
std::uint32_t time_now = 0;

std::int16_t read(void*, CO_IF_FRM* frame) {
  if (received == nullptr) {
    return 0;
  }
  *frame = *received;
  received = nullptr;
  return sizeof *frame;
}
std::int16_t send(void*, const CO_IF_FRM* frame) { return sizeof *frame; }
void nothing(void*) {}
void no_number(void*, std::uint32_t) {}
std::uint32_t now(void*) { return ++time_now; }

constexpr CO_IF_CAN_DRV_EX can = {nothing, no_number, read, send, nothing, nothing, nullptr, CONodeCanReport};
constexpr CO_IF_TIMER_DRV_EX timer = {no_number, now, nullptr};

// The dictionary ----------------------------------------------------------------------------------------------------

void add(std::uint32_t index, std::uint32_t sub, std::uint32_t flags, const CO_OBJ_TYPE* type, CO_DATA data) {
  table.push_back({CO_KEY(index, sub, flags), type, data});
}

constexpr std::uint32_t object_of(unsigned place) { return 0x20000008U | (place + 1U) << 8; }

// Adds PDOs. Each RPDO maps an object of every TPDO, so that an RPDO triggers all of them.
void add_pdos() {
  const std::uint32_t constant = CO_OBJ_D___R_;
  for (unsigned n = 0; n < pdos; ++n) {
    rpdo_id[n] = 0x240U + n;
    tpdo_id[n] = 0x1C0U + n;
    add(0x1400U + n, 1, CO_OBJ_____RW, CO_TPDO_ID, CO_DATA(&rpdo_id[n]));
    add(0x1400U + n, 2, CO_OBJ_____RW, CO_TPDO_TYPE, CO_DATA(&pdo_type));
    add(0x1800U + n, 1, CO_OBJ_____RW, CO_TPDO_ID, CO_DATA(&tpdo_id[n]));
    add(0x1800U + n, 2, CO_OBJ_____RW, CO_TPDO_TYPE, CO_DATA(&pdo_type));
    for (const std::uint32_t index : {0x1600U + n, 0x1A00U + n}) {
      add(index, 0, constant, CO_TPDO_NUM, CO_DATA(mapped));
      for (unsigned k = 0; k < mapped; ++k) {
        const unsigned place = index < 0x1A00 ? mapped * n + k : n + pdos * k;
        add(index, k + 1, constant, CO_TPDO_MAP, CO_DATA(object_of(place)));
      }
    }
  }
}

void add_others() {
  add(0x1001, 0, CO_OBJ_____R_, CO_TUNSIGNED8, CO_DATA(&error_register));
  add(0x1005, 0, CO_OBJ_____RW, CO_TSYNC_ID, CO_DATA(&sync_id));
  add(0x1012, 0, CO_OBJ_____RW, CO_TTIME_ID, CO_DATA(&time_id));
  add(0x1014, 0, CO_OBJ_DN__R_, CO_TEMCY_ID, CO_DATA(0x80));
  add(0x1016, 1, CO_OBJ_____RW, CO_THB_CONS, CO_DATA(&monitored));
  add(0x1017, 0, CO_OBJ_____RW, CO_THB_PROD, CO_DATA(&heartbeat));
  for (unsigned part = 0; part < std::size(identity); ++part) {
    add(0x1018, part + 1, CO_OBJ_D___R_, CO_TUNSIGNED32, CO_DATA(identity[part]));
  }
  for (unsigned place = 0; place < std::size(objects); ++place) {
    add(0x2000, place + 1, CO_OBJ___APRW, CO_TUNSIGNED8, CO_DATA(&objects[place]));
  }
  add(0x2100, 0, CO_OBJ_____RW, CO_TDOMAIN, CO_DATA(&large));
}

// The node ----------------------------------------------------------------------------------------------------------

void start(std::uint8_t type = 255) {
  pdo_type = type;
  large = {0, large_size, large_memory};
  monitored = {};
  monitored.NodeId = 9;
  monitored.Time = 50;
  CO_NODE_SPEC spec = {};
  spec.NodeId = node_id;
  spec.Baudrate = 250000;
  spec.Dict = table.data();
  spec.DictLen = static_cast<std::uint16_t>(table.size());
  spec.TmrMem = timers;
  spec.TmrNum = static_cast<std::uint16_t>(std::size(timers));
  spec.TmrFreq = 1000;
  spec.SdoBuf = sdo_buffer;
  ext = {};
  ext.Size = sizeof ext;
  ext.Can = &can;
  ext.Timer = &timer;
  CONodeInitEx(&node, &spec, &ext);
  fuzz::require(CONodeGetErr(&node) == CO_ERR_NONE, "the node starts");
  CONodeStart(&node);
}

void make_table() {
  table.clear();
  add_pdos();
  add_others();
  std::sort(table.begin(), table.end(),
            [](const CO_OBJ& left, const CO_OBJ& right) { return CO_GET_DEV(left.Key) < CO_GET_DEV(right.Key); });
}

void receive(const CO_IF_FRM& frame) {
  received = &frame;
  fuzz::given = {frame.Identifier, frame.DLC, frame.Data, true};
  fuzz::process(node);
}

using Bytes = std::initializer_list<std::uint8_t>;

void receive(std::uint32_t identifier, Bytes bytes) {
  CO_IF_FRM frame = {identifier, {}, 0};
  for (const std::uint8_t byte : bytes) {
    frame.Data[frame.DLC++] = byte;
  }
  receive(frame);
}

// The sweeps --------------------------------------------------------------------------------------------------------

void sweep_nmt() {
  start();
  for (const CO_MODE mode : modes) {
    for (unsigned command = 0; command < 256; ++command) {
      for (const std::uint8_t id : {std::uint8_t{0}, node_id, std::uint8_t{6}}) {
        CONmtSetMode(&node.Nmt, mode);
        receive(0, {static_cast<std::uint8_t>(command), id});
      }
    }
  }
}

void sweep_identifiers() {
  start();
  for (const CO_MODE mode : modes) {
    CONmtSetMode(&node.Nmt, mode);
    for (std::uint32_t id = 1; id <= 0x7FF; ++id) {
      for (const std::uint8_t length : {std::uint8_t{0}, std::uint8_t{1}, std::uint8_t{6}, std::uint8_t{8}}) {
        receive({id, {}, length});
      }
      receive({id | CO_IF_FRM_RTR, {}, 0});
      receive({id | CO_IF_FRM_EXT, {}, 8});
    }
  }
}

constexpr std::uint32_t sdo = 0x600U + node_id;
constexpr std::uint8_t low = 0x00;  // low byte of the large object's index
constexpr std::uint8_t high = 0x21;
constexpr std::uint8_t size_low = large_size & 0xFFU;
constexpr std::uint8_t size_high = large_size >> 8;
constexpr std::uint8_t longest_block = 127;

void ask(std::uint8_t command, std::uint8_t fifth = 0, std::uint8_t sixth = 0) {
  receive(sdo, {command, low, high, 0, fifth, sixth, 0, 0});
}

// Request sequences that lead into each state of the server, as far as one object permits; 0 ends a sequence.
constexpr std::uint8_t abort_request = 0x80;
constexpr std::uint8_t last_segment = 0x81;
constexpr std::uint8_t states[][4] = {
    {abort_request},
    {abort_request, 0x21},
    {abort_request, 0x40},
    {abort_request, 0xC6},
    {abort_request, 0xC6, last_segment},
    {abort_request, 0xA4},
    {abort_request, 0xA4, 0xA3},
};

void sweep_sdo() {
  start();
  for (const auto& state : states) {
    for (unsigned command = 0; command < 256; ++command) {
      for (const std::uint8_t* request = state; *request != 0; ++request) {
        *request == 0xA4 ? ask(*request, longest_block) : ask(*request, size_low, size_high);
      }
      ask(static_cast<std::uint8_t>(command), longest_block);
    }
  }
}

// Sends a segment whose data differ from byte to byte.
void send_segment(std::uint8_t command, unsigned position) {
  CO_IF_FRM frame = {sdo, {command}, 8};
  for (unsigned n = 1; n < 8; ++n) {
    frame.Data[n] = static_cast<std::uint8_t>(0x5A * (position + n));
  }
  receive(frame);
}

constexpr unsigned segments = (large_size + 6) / 7;

// Transfers the large object by each protocol. The CRC of the block download is wrong, which does not change its cost:
// the server computes it before it compares it.
void sweep_transfers() {
  start();
  ask(0xC6, size_low, size_high);
  for (unsigned n = 0; n < segments; ++n) {
    const bool is_last = n + 1 == segments;
    send_segment(static_cast<std::uint8_t>(n % longest_block + 1 + (is_last ? 0x80 : 0)), 7 * n);
  }
  receive(sdo, {0xC1 | (7 * segments - large_size) << 2, 0, 0, 0, 0, 0, 0, 0});
  ask(0xA4, longest_block);
  ask(0xA3);
  for (unsigned left = segments; left != 0; left -= left < longest_block ? left : longest_block) {
    const auto sent = static_cast<std::uint8_t>(left < longest_block ? left : longest_block);
    receive(sdo, {0xA2, sent, longest_block, 0, 0, 0, 0, 0});
  }
  receive(sdo, {0xA1, 0, 0, 0, 0, 0, 0, 0});
  ask(0x21, size_low, size_high);
  for (unsigned n = 0; n < segments; ++n) {
    const bool is_last = n + 1 == segments;
    send_segment(static_cast<std::uint8_t>((n % 2) << 4 | (is_last ? 1 | (7 * segments - large_size) << 1 : 0)), 7 * n);
  }
  ask(0x40);
  for (unsigned n = 0; n < segments; ++n) {
    receive(sdo, {static_cast<std::uint8_t>(0x60 | (n % 2) << 4), 0, 0, 0, 0, 0, 0, 0});
  }
}

void ask_lss(std::uint8_t command, std::uint32_t number, std::uint8_t sixth = 0) {
  const auto byte = [number](unsigned place) { return static_cast<std::uint8_t>(number >> (8 * place)); };
  receive(CO_LSS_RX_ID, {command, byte(0), byte(1), byte(2), byte(3), sixth, 0, 0});
}

// Sends each LSS command with each part of the address, and a few other numbers. The node starts again for each
// command, as some of them change its bit rate or node-ID.
void sweep_lss() {
  constexpr std::uint8_t switch_global = 0x04;
  constexpr std::uint32_t numbers[] = {0, 1, 0x0300, identity[0], identity[1], identity[2], identity[3]};
  for (const std::uint32_t mode : {0U, 1U}) {
    for (unsigned command = 0; command < 256; ++command) {
      start();
      for (const std::uint32_t number : numbers) {
        ask_lss(switch_global, mode);
        ask_lss(static_cast<std::uint8_t>(command), number, 0x80);
      }
    }
  }
  start();
  for (std::uint8_t part = 0; part < std::size(identity); ++part) {
    ask_lss(static_cast<std::uint8_t>(0x40 + part), identity[part]);
  }
}

CO_IF_FRM pdo(unsigned number, unsigned turn) {
  CO_IF_FRM frame = {rpdo_id[number], {}, mapped};
  for (std::uint8_t& byte : frame.Data) {
    byte = static_cast<std::uint8_t>(++turn);
  }
  return frame;
}

void sweep_pdo() {
  constexpr unsigned turns = 4;
  for (const std::uint8_t type : {std::uint8_t{255}, std::uint8_t{1}, std::uint8_t{0}}) {
    start(type);
    CONmtSetMode(&node.Nmt, CO_OPERATIONAL);
    for (unsigned turn = 0; turn < turns; ++turn) {
      for (unsigned n = 0; n < pdos; ++n) {
        receive(pdo(n, turn));
      }
      receive(0x80, {});
      for (unsigned n = 0; n < pdos; ++n) {
        receive({tpdo_id[n] | CO_IF_FRM_RTR, {}, 0});
      }
    }
  }
}

struct Sweep {
  std::string_view name;
  void (*run)();
};

constexpr Sweep sweeps[] = {
    {"nmt", sweep_nmt}, {"identifiers", sweep_identifiers},
    {"sdo", sweep_sdo}, {"transfers", sweep_transfers},
    {"lss", sweep_lss}, {"pdo", sweep_pdo},
};

}  // namespace

extern "C" {

CO_ERR COLssStore(std::uint32_t, std::uint8_t) { return CO_ERR_NONE; }

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view name(reinterpret_cast<const char*>(data), size);
  make_table();
  for (const Sweep& sweep : sweeps) {
    if (sweep.name == name) {
      sweep.run();
      return 0;
    }
  }
  fuzz::require(false, "a sweep has this name");
  return 0;
}

}  // extern "C"
