// SPDX-License-Identifier: Apache-2.0
// Device for the tests of lexican, described by fixtures/device.eds:
//   lexican_test_device BUS NODE-ID [silent] [slow] [no-revision] [no-product] [time-out] [refuses-rate]
//                       [refuses-store] [serial=HEX] [eds=FILE]
//   lexican_test_device BUS 0 answers-lss
// NODE-ID 255: it has none, and is an LSS slave; silent: has a heartbeat and no SDO server; slow: processes frames
// every 50 ms; no-revision, no-product: refuses 1018h:03, 1018h:02; time-out: refuses 2008h with 0504 0000h;
// refuses-rate, refuses-store: refuses this LSS service; serial=HEX: 1018h:04; eds=FILE: stores this file in 1021h.
// answers-lss: no device, but an answer to each LSS request. Prints "ready" after its boot-up, then "request" for the
// first SDO request, "abort CODE" for each abort of the client, "rate RATE" for a bit rate that LSS configures, and
// "stored RATE". Runs until SIGTERM.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

#include "bus/open.hpp"
#include "host/bus_host.hpp"
#include "host/loop.hpp"

namespace {

using namespace lexican;

std::uint8_t error_register = 0;
std::uint16_t heartbeat = 0;
std::uint8_t output = 0;
std::int16_t temperature = -40;
std::uint32_t position = 1000;
float offset = 0.5F;
std::uint8_t is_enabled = 1;
std::uint8_t label[32] = "axis";
CO_OBJ_STR_RW label_text = {0, 4, sizeof label, label};
std::uint32_t cycles = 7;
std::uint32_t second_id = 0xC0000280;
std::uint8_t second_type = 255;
std::uint8_t second_number = 0;
std::uint32_t second_mapping[2]{};
std::uint32_t password = 0;
const std::uint32_t limit = 5;
CO_OBJ_STR name = {0, reinterpret_cast<const std::uint8_t*>("SD-400")};
CO_OBJ_STR version = {0, reinterpret_cast<const std::uint8_t*>("V1")};
std::vector<std::uint8_t> program(100'000);
std::vector<std::uint8_t> eds;
CO_OBJ_DOM stored_eds = {0, 0, nullptr};
std::uint8_t storage_format = 1;  // compressed, unless there is an EDS
CO_OBJ_DOM program_memory = {0, 100'000, program.data()};

std::uint32_t refusal = CO_SDO_ERR_TOS_STATE;

/// An object whose value cannot be transferred in this state of the device.
CO_ERR refuse(CO_OBJ* obj, CO_NODE* node, void*, std::uint32_t) {
  COObjTypeUserSDOAbort(obj, node, refusal);
  return CO_ERR_OBJ_WRITE;
}
const CO_OBJ_TYPE refusing = {[](CO_OBJ*, CO_NODE*, std::uint32_t) { return std::uint32_t{1}; }, nullptr, refuse,
                              refuse, nullptr};

/// An object that accepts any value and does not store it.
const CO_OBJ_TYPE forgetting = {[](CO_OBJ*, CO_NODE*, std::uint32_t) { return std::uint32_t{4}; }, nullptr,
                                [](CO_OBJ*, CO_NODE*, void* buffer, std::uint32_t size) {
                                  std::memcpy(buffer, &limit, size);
                                  return CO_ERR_NONE;
                                },
                                [](CO_OBJ*, CO_NODE*, void*, std::uint32_t) { return CO_ERR_NONE; }, nullptr};

CO_OBJ objects[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)0x00020192},
    {CO_KEY(0x1001, 0, CO_OBJ_____R_), CO_TUNSIGNED8, (CO_DATA)(&error_register)},
    {CO_KEY(0x1008, 0, CO_OBJ_____R_), CO_TSTRING, (CO_DATA)(&name)},
    {CO_KEY(0x1009, 0, CO_OBJ_____R_), CO_TSTRING, (CO_DATA)(&version)},
    {CO_KEY(0x1010, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)1},
    {CO_KEY(0x1010, 1, CO_OBJ_____RW), CO_TUNSIGNED32, (CO_DATA)(&password)},
    {CO_KEY(0x1011, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)1},
    {CO_KEY(0x1011, 1, CO_OBJ_____RW), CO_TUNSIGNED32, (CO_DATA)(&password)},
    {CO_KEY(0x1014, 0, CO_OBJ_DN__R_), CO_TEMCY_ID, (CO_DATA)0x80},
    {CO_KEY(0x1017, 0, CO_OBJ_____RW), CO_THB_PROD, (CO_DATA)(&heartbeat)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)4},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)0x100},
    {CO_KEY(0x1018, 2, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)0x402},
    {CO_KEY(0x1018, 3, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)0x10000},
    {CO_KEY(0x1018, 4, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)0x1A2},
    {CO_KEY(0x1021, 0, CO_OBJ_____R_), CO_TDOMAIN, (CO_DATA)(&stored_eds)},
    {CO_KEY(0x1022, 0, CO_OBJ_____R_), CO_TUNSIGNED8, (CO_DATA)(&storage_format)},
    {CO_KEY(0x1200, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)2},
    {CO_KEY(0x1200, 1, CO_OBJ_DN__R_), CO_TUNSIGNED32, (CO_DATA)0x600},
    {CO_KEY(0x1200, 2, CO_OBJ_DN__R_), CO_TUNSIGNED32, (CO_DATA)0x580},
    {CO_KEY(0x1400, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)2},
    {CO_KEY(0x1400, 1, CO_OBJ_DN__R_), CO_TPDO_ID, (CO_DATA)0x200},
    {CO_KEY(0x1400, 2, CO_OBJ_D___R_), CO_TPDO_TYPE, (CO_DATA)255},
    {CO_KEY(0x1600, 0, CO_OBJ_D___R_), CO_TPDO_NUM, (CO_DATA)1},
    {CO_KEY(0x1600, 1, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)CO_LINK(0x2000, 0, 8)},
    {CO_KEY(0x1800, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)2},
    {CO_KEY(0x1800, 1, CO_OBJ_DN__R_), CO_TPDO_ID, (CO_DATA)0x40000180},
    {CO_KEY(0x1800, 2, CO_OBJ_D___R_), CO_TPDO_TYPE, (CO_DATA)255},
    {CO_KEY(0x1801, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)2},
    {CO_KEY(0x1801, 1, CO_OBJ_____RW), CO_TPDO_ID, (CO_DATA)(&second_id)},
    {CO_KEY(0x1801, 2, CO_OBJ_____RW), CO_TPDO_TYPE, (CO_DATA)(&second_type)},
    {CO_KEY(0x1A00, 0, CO_OBJ_D___R_), CO_TPDO_NUM, (CO_DATA)2},
    {CO_KEY(0x1A00, 1, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)CO_LINK(0x2001, 0, 16)},
    {CO_KEY(0x1A00, 2, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)CO_LINK(0x2002, 0, 32)},
    {CO_KEY(0x1A01, 0, CO_OBJ_____RW), CO_TPDO_NUM, (CO_DATA)(&second_number)},
    {CO_KEY(0x1A01, 1, CO_OBJ_____RW), CO_TPDO_MAP, (CO_DATA)(&second_mapping[0])},
    {CO_KEY(0x1A01, 2, CO_OBJ_____RW), CO_TPDO_MAP, (CO_DATA)(&second_mapping[1])},
    {CO_KEY(0x2000, 0, CO_OBJ____PRW), CO_TUNSIGNED8, (CO_DATA)(&output)},
    {CO_KEY(0x2001, 0, CO_OBJ___APRW), CO_TSIGNED16, (CO_DATA)(&temperature)},
    {CO_KEY(0x2002, 0, CO_OBJ____PRW), CO_TUNSIGNED32, (CO_DATA)(&position)},
    {CO_KEY(0x2003, 0, CO_OBJ_____RW), CO_TREAL32, (CO_DATA)(&offset)},
    {CO_KEY(0x2004, 0, CO_OBJ_____RW), CO_TBOOLEAN, (CO_DATA)(&is_enabled)},
    {CO_KEY(0x2005, 0, CO_OBJ_____RW), CO_TVISIBLE_STRING, (CO_DATA)(&label_text)},
    {CO_KEY(0x2006, 0, CO_OBJ_____R_), CO_TUNSIGNED32, (CO_DATA)(&cycles)},
    {CO_KEY(0x2007, 0, CO_OBJ______W), CO_TUNSIGNED32, (CO_DATA)(&password)},
    {CO_KEY(0x2008, 0, CO_OBJ_____RW), &refusing, (CO_DATA)(&password)},
    {CO_KEY(0x2009, 0, CO_OBJ_____RW), CO_TDOMAIN, (CO_DATA)(&program_memory)},
    {CO_KEY(0x200A, 0, CO_OBJ_____RW), &forgetting, (CO_DATA)(&position)},
    CO_OBJ_DICT_ENDMARK,
};

void print_line(const char* text) {
  std::puts(text);
  std::fflush(stdout);
}

/// Prints the first request, and the aborts, of the client.
void report(std::uint8_t node, const CO_IF_FRM& frame) {
  static bool has_request = false;
  constexpr std::uint8_t abort = 0x80;
  if (frame.Identifier != 0x600U + node || frame.DLC != 8) {
    return;
  }
  if (frame.Data[0] == abort) {
    char text[32];
    std::snprintf(text, sizeof text, "abort %08lX", static_cast<unsigned long>(CO_GET_LONG(&frame, 4)));
    print_line(text);
  } else if (!has_request) {
    has_request = true;
    print_line("request");
  }
}

bool refuses_rate = false;
bool refuses_store = false;

std::uint8_t permit_lss(CO_NODE*, void*, CO_ACCESS_LSS* access) {
  if (access->Service != CO_LSS_SERVICE_BIT_TIMING || refuses_rate) {
    return access->Service == CO_LSS_SERVICE_BIT_TIMING ? 1 : 0;
  }
  print_line(("rate " + std::to_string(access->Baudrate)).c_str());
  return 0;
}

CO_ERR store_lss(CO_NODE*, void*, std::uint32_t bit_rate, std::uint8_t) {
  if (!refuses_store) {
    print_line(("stored " + std::to_string(bit_rate)).c_str());
  }
  return refuses_store ? CO_ERR_LSS_NO_STORE : CO_ERR_NONE;
}

const CO_CALLBACKS* callbacks() {
  static CO_CALLBACKS result{};
  result.LssStore = store_lss;
  result.AccessLss = permit_lss;
  return &result;
}

/// Answers each LSS request as a slave that is searched for.
int answer_lss(const std::string& bus_name) {
  std::string why;
  const std::unique_ptr<host_bus::Bus> bus = host_bus::open_bus(bus_name, {}, why);
  const Interruption interruption;
  if (bus == nullptr) {
    std::fprintf(stderr, "%s\n", why.c_str());
    return 1;
  }
  BusHost host(*bus, interruption, BusHost::Role::master);
  print_line("ready");
  while (!host.interrupted()) {
    while (const std::optional<host_bus::Entry> entry = bus->receive()) {
      if (entry->frame.Identifier == 0x7E5) {
        bus->send({0x7E4, {0x4F}, 8});
      }
    }
    host.wait(second);
  }
  return 0;
}

int run(const std::string& bus_name, std::uint8_t id, bool is_silent, bool is_slow) {
  std::string why;
  const std::unique_ptr<host_bus::Bus> bus = host_bus::open_bus(bus_name, {}, why);
  if (bus == nullptr) {
    std::fprintf(stderr, "%s\n", why.c_str());
    return 1;
  }
  for (std::size_t n = 0; n < program.size(); ++n) {
    program[n] = static_cast<std::uint8_t>(n * 7 + n / 256);
  }
  heartbeat = is_silent ? 100 : 0;
  second_id += id <= 127 ? id : 0U;
  for (CO_OBJ& object : objects) {
    const bool is_server = object.Key >> 8 == 0x120001 || object.Key >> 8 == 0x120002;
    if (is_silent && is_server) {
      object.Data = (CO_DATA)0x80000000;
    }
  }
  const Interruption interruption;
  BusHost host(*bus, interruption, BusHost::Role::master);
  const auto length = static_cast<std::uint16_t>(std::size(objects));
  Node node(
      {id, host.device_can(), host.device_timer(), {objects, length}, [id](bool is_received, const CO_IF_FRM& frame) {
         if (is_received) {
           report(id, frame);
         }
       }});
  const_cast<CO_NODE_EXT*>(node.stack().Ext)->Callbacks = callbacks();
  Loop loop(host, {&node});
  CONodeStart(&node.stack());
  loop.flush(second);
  const std::string fault = node.error_text();
  const bool is_twice = fault.find("CO_ERR_NODE_ID_TWICE") == 0;  // a test has two devices with one node-ID
  if (!fault.empty() && !is_twice) {
    std::fprintf(stderr, "%s\n", fault.c_str());
    return 1;
  }
  print_line("ready");
  while (!host.interrupted()) {
    loop.run_for(is_slow ? millisecond : second);
    if (is_slow) {
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
  }
  return 0;
}

}  // namespace

int main(int number, char** arguments) {
  const std::vector<std::string> words(arguments, arguments + number);
  const auto has = [&](const char* word) { return std::find(words.begin(), words.end(), word) != words.end(); };
  refusal = has("time-out") ? CO_SDO_ERR_TIMEOUT : refusal;
  for (CO_OBJ& object : objects) {
    if ((has("no-revision") && object.Key >> 8 == 0x101803) || (has("no-product") && object.Key >> 8 == 0x101802)) {
      object.Type = &refusing;
    }
  }
  for (const std::string& word : words) {
    if (word.compare(0, 7, "serial=") == 0) {
      std::find_if(std::begin(objects), std::end(objects), [](const CO_OBJ& object) {
        return object.Key >> 8 == 0x101804;
      })->Data = static_cast<CO_DATA>(std::strtoul(word.c_str() + 7, nullptr, 16));
    }
    if (word.compare(0, 4, "eds=") == 0) {
      std::ifstream file(word.substr(4), std::ios::binary);
      eds.assign(std::istreambuf_iterator<char>(file), {});
      stored_eds = {0, static_cast<std::uint32_t>(eds.size()), eds.data()};
      storage_format = 0;
    }
  }
  refuses_rate = has("refuses-rate");
  refuses_store = has("refuses-store");
  if (has("answers-lss")) {
    return answer_lss(words[1]);
  }
  return number < 3 ? 2 : run(words[1], static_cast<std::uint8_t>(std::atoi(arguments[2])), has("silent"), has("slow"));
}
