// SPDX-License-Identifier: Apache-2.0
// SDO client whose server is the same node: access to its dictionary, with the rights of the network, without
// frames.
#include <cstring>

#include "support/heap_watch.hpp"
#include "support/sdo_client_fixture.hpp"

#if USE_CSDO && USE_CSDO_OWN

namespace {

using namespace test;

class Local : public SdoClient {
 public:
  explicit Local(Setup setup = Setup().only_small()) : SdoClient(std::move(setup), local_entries()) {}

  // Runs the loop until the callback is called, without a frame. Returns its arguments.
  ClientEnd settle() {
    loop();
    after(1ms);
    silent();
    CHECK(ends.size() == 1);
    const ClientEnd end = ends.empty() ? ClientEnd{} : ends.front();
    ends.clear();
    return end;
  }
  ClientEnd read(std::uint16_t index, std::uint8_t sub, std::uint32_t size) {
    start_upload(index, sub, size);
    return settle();
  }
  ClientEnd write(std::uint16_t index, std::uint8_t sub, const Bytes& data) {
    may_change(index, sub);
    start_download(index, sub, data);
    return settle();
  }
};

TEST_CASE("SDO client, own node: a value is read in the byte order of the bus") {
  Local node;
  CHECK(node.read(0x2001, 0, 1).data == Bytes{0x11});
  CHECK(node.read(0x2002, 0, 2).data == Bytes{0x11, 0x22});
  CHECK(node.read(0x2003, 0, 3).data == Bytes{0x11, 0x22, 0x33});
  CHECK(node.read(0x2004, 0, 4).data == Bytes{0x11, 0x22, 0x33, 0x44});
  CHECK(node.read(0x2005, 0, 5).data == Bytes{0x11, 0x22, 0x33, 0x44, 0x55});
  CHECK(node.read(0x2008, 0, 8).data == Bytes{0x11, 0x22, 0x33, 0x44, 0x55, 0x66, 0x77, 0x88});
  const ClientEnd end = node.read(0x2004, 0, 100);
  CHECK(end.code == 0);
  CHECK(end.num == 4);
  CHECK(end.index == 0x2004);
}

TEST_CASE("SDO client, own node: a value is written in the byte order of the bus") {
  Local node;
  CHECK(node.write(0x2001, 0, {0xA1}).code == 0);
  CHECK(node.objects.u8 == 0xA1);
  CHECK(node.write(0x2002, 0, {0xA1, 0xB2}).code == 0);
  CHECK(node.objects.u16 == 0xB2A1);
  CHECK(node.write(0x2004, 0, {1, 2, 3, 4}).code == 0);
  CHECK(node.objects.u32 == 0x04030201);
  const ClientEnd end = node.write(0x2008, 0, {1, 2, 3, 4, 5, 6, 7, 8});
  CHECK(end.code == 0);
  CHECK(end.num == 8);
  CHECK(end.total == 8);
  CHECK(node.objects.u64 == 0x0807060504030201);
}

#if USE_PARA

TEST_CASE("SDO client, own node: a write to an object of a parameter group makes 1020h 0, as one by the network [S7]") {
  std::uint32_t date = 5;
  std::uint32_t time = 6;
  std::uint32_t grouped = 1;
  CO_PARA group = {0, sizeof grouped, &grouped, nullptr, CO_RESET_NODE, nullptr, CO_PARA___E};
  const auto data = [](const void* address) { return CO_DATA{reinterpret_cast<std::uintptr_t>(address)}; };
  Setup setup = Setup().only_small().may_change(0x1020, 1).may_change(0x1020, 2);
  setup.with({CO_KEY(0x1010, 1, CO_OBJ_____RW), CO_TPARA_STORE, data(&group)})
      .with({CO_KEY(0x1020, 1, CO_OBJ_____RW), CO_TVERIFY_CONFIG, data(&date)})
      .with({CO_KEY(0x1020, 2, CO_OBJ_____RW), CO_TVERIFY_CONFIG, data(&time)})
      .with({CO_KEY(0x2300, 1, CO_OBJ_____RW), CO_TUNSIGNED32, data(&grouped)});
  Local node(std::move(setup));
  CHECK(node.write(0x2004, 0, {1, 2, 3, 4}).code == 0);
  CHECK(date == 5);
  CHECK(node.write(0x2300, 1, {7, 0, 0, 0}).code == 0);
  CHECK(grouped == 7);
  CHECK(date == 0);
  CHECK(time == 0);
}

#endif

TEST_CASE("SDO client, own node: node-ID relative objects have the values that SDO transfers have") {
  Local node;
  CHECK(node.read(0x2034, 0, 4).data == Bytes{0x81, 0x01, 0x00, 0x00});
  CHECK(node.read(0x1014, 0, 4).data == Bytes{0x81, 0x00, 0x00, 0x00});
  CHECK(node.read(0x1200, 1, 4).data == Bytes{0x01, 0x06, 0x00, 0x00});
}

TEST_CASE("SDO client, own node: the callback is called after the request returns; the client is busy until then") {
  Local node;
  node.start_upload(0x2004, 0, 4);
  node.goes_on();
  CHECK(node.try_upload(0x2004, 0, 4) == CO_ERR_SDO_BUSY);
  node.goes_on();
  node.loop();
  node.after(1ms);
  node.has_read({0x11, 0x22, 0x33, 0x44});
}

TEST_CASE("SDO client, own node: CONodeNextDeadline is 0 while a request is pending") {
  Local node(Setup().only_small().wake(Wake::deadline));
  node.start_upload(0x2004, 0, 4);
  CHECK(CONodeNextDeadline(&node.node) <= 1);
  node.after(5ms);
  node.has_read({0x11, 0x22, 0x33, 0x44});
  CHECK(CONodeNextDeadline(&node.node) == 0xFFFFFFFF);
}

TEST_CASE("SDO client, own node: access rights and missing objects give the abort codes of an SDO server [5.2]") {
  Local node;
  CHECK(node.read(0x2030, 0, 4).code == CO_SDO_ERR_RD);
  CHECK(node.write(0x2031, 0, {1, 2, 3, 4}).code == CO_SDO_ERR_WR);
  CHECK(node.read(0x2032, 0, 4).code == CO_SDO_ERR_UNSUP);
  CHECK(node.write(0x2032, 0, {1, 2, 3, 4}).code == CO_SDO_ERR_UNSUP);
  CHECK(node.read(0x3000, 0, 4).code == CO_SDO_ERR_OBJ);
  CHECK(node.write(0x3000, 0, {1}).code == CO_SDO_ERR_OBJ);
  CHECK(node.read(0x2033, 7, 4).code == CO_SDO_ERR_SUB);
  CHECK(node.write(0x2033, 7, {1}).code == CO_SDO_ERR_SUB);
  CHECK(node.write(0x2004, 0, {1, 2, 3}).code == CO_SDO_ERR_LEN_SMALL);
  CHECK(node.write(0x2004, 0, {1, 2, 3, 4, 5}).code == CO_SDO_ERR_LEN_HIGH);
  CHECK(node.objects.u32 == 0x44332211);
}

TEST_CASE("SDO client, own node: an object that does not fit into the buffer ends with 0504 0005h") {
  Local node;
  for (std::uint32_t size = 1; size < 4; ++size) {
    CHECK(node.read(0x2004, 0, size).code == CO_SDO_ERR_MEM);
  }
  CHECK(node.read(0x2100, 15, 14).code == CO_SDO_ERR_MEM);
  CHECK(node.read(0x1008, 0, 16).code == CO_SDO_ERR_MEM);
  CHECK(node.read(0x1008, 0, 17).code == 0);
}

TEST_CASE("SDO client, own node: strings and domains of every length are read into buffers of that size and more") {
  Local node(Setup().with_70000());
  for (const unsigned length : {0U, 1U, 2U, 3U, 4U, 5U, 6U, 7U, 8U, 9U, 14U, 15U}) {
    for (const unsigned more : {0U, 1U, 20U}) {
      CAPTURE(length);
      CAPTURE(more);
      if (length + more == 0) continue;
      const ClientEnd end = node.read(0x2100, static_cast<std::uint8_t>(length), length + more);
      CHECK(end.code == 0);
      CHECK(end.data == counted(length));
    }
  }
  CHECK(node.read(0x2101, 0, 889).data == counted(889));
  CHECK(node.read(0x2102, 0, 70000).data == counted(70000));
  CHECK(node.read(0x2110, 0, 100).data == Bytes{'t', 'e', 'x', 't'});
  CHECK(node.read(0x2111, 0, 100).data == Bytes{1, 2, 3, 4, 5, 6});
  CHECK(node.read(0x2112, 0, 100).data == Bytes{0x41, 0x00, 0xE4, 0x00, 0xAC, 0x20});
}

TEST_CASE("SDO client, own node: strings and domains are written") {
  Local node(Setup().with_70000());
  CHECK(node.write(0x2110, 0, {'l', 'o', 'n', 'g', 'e', 'r'}).code == 0);
  CHECK(node.read(0x2110, 0, 100).data == Bytes{'l', 'o', 'n', 'g', 'e', 'r'});
  CHECK(node.write(0x2111, 0, {9, 8}).code == 0);
  CHECK(node.objects.octets.Size == 2);
  CHECK(node.write(0x2112, 0, {0x42, 0x00}).code == 0);
  CHECK(node.objects.unicode_memory[0] == 0x0042);
  CHECK(node.write(0x2101, 0, counted(889, 77)).code == 0);
  CHECK((node.objects.memory[889] == counted(889, 77)));
  CHECK(node.write(0x2102, 0, counted(70000, 5)).num == 70000);
  CHECK((node.objects.memory[70000] == counted(70000, 5)));
  CHECK(node.write(0x2110, 0, counted(17)).code == CO_SDO_ERR_LEN_HIGH);
  CHECK(node.write(0x2112, 0, counted(3)).code != 0);
}

// Reads an object by SDO frames. Returns the abort code.
std::uint32_t code_over_the_bus(Fixture& node, std::uint16_t index, std::uint8_t sub, Bytes& data) {
  CO_IF_FRM request = frame("601#4000000000000000");
  CO_SET_WORD(&request, index, 1);
  CO_SET_BYTE(&request, sub, 3);
  node.rx(request);
  REQUIRE(node.can.sent.size() == 1);
  const CO_IF_FRM answer = node.can.sent.front().frm;
  node.can.sent.clear();
  if (answer.Data[0] == 0x80) return CO_GET_LONG(&answer, 4);
  data = node.upload(index, sub);
  return 0;
}

TEST_CASE("SDO client, own node: every entry of the dictionary reads as over the bus") {
  Local own;
  Fixture remote{Setup().only_small()};
  for (unsigned n = 0; n < remote->Dict.Num; ++n) {
    const std::uint32_t key = remote->Dict.Root[n].Key;
    for (const unsigned beyond : {0U, 1U}) {
      const std::uint16_t index = CO_GET_IDX(key);
      const auto sub = static_cast<std::uint8_t>(CO_GET_SUB(key) + beyond);
      CAPTURE(index);
      CAPTURE(sub);
      Bytes expected;
      const std::uint32_t code = code_over_the_bus(remote, index, sub, expected);
      const ClientEnd end = own.read(index, sub, 100);
      CHECK(end.code == code);
      CHECK(end.data == expected);
    }
  }
}

TEST_CASE("SDO client, own node: every length is written to every kind of object as over the bus") {
  for (const std::uint16_t index :
       {std::uint16_t{0x1000}, std::uint16_t{0x1017}, std::uint16_t{0x2001}, std::uint16_t{0x2002},
        std::uint16_t{0x2003}, std::uint16_t{0x2004}, std::uint16_t{0x2007}, std::uint16_t{0x2008},
        std::uint16_t{0x2020}, std::uint16_t{0x2024}, std::uint16_t{0x2026}, std::uint16_t{0x2030},
        std::uint16_t{0x2031}, std::uint16_t{0x2034}, std::uint16_t{0x2110}, std::uint16_t{0x2111},
        std::uint16_t{0x2112}}) {
    for (std::size_t length = 1; length <= 18; ++length) {
      CAPTURE(index);
      CAPTURE(length);
      Local own;
      Fixture remote{Setup().only_small()};
      CHECK(own.write(index, 0, counted(length)).code == remote.download(index, 0, counted(length)));
      Bytes expected;
      const std::uint32_t code = code_over_the_bus(remote, index, 0, expected);
      const ClientEnd end = own.read(index, 0, 100);
      CHECK(end.code == code);
      CHECK(end.data == expected);
    }
  }
}

TEST_CASE("SDO client, own node: a thousand accesses started in the callback of the previous one do not nest") {
  Local node;
  unsigned ended = 0;
  unsigned depth = 0;
  node.on_end = [&](const ClientEnd& end) {
    ++depth;
    CHECK(depth == 1);
    CHECK(end.code == 0);
    if (++ended < 1000) CHECK(node.try_upload(0x2004, 0, 4) == CO_ERR_NONE);
    CHECK(node.ends.size() == ended);
    --depth;
  };
  node.start_upload(0x2004, 0, 4);
  for (unsigned rounds = 0; rounds < 2000 && ended < 1000; ++rounds) {
    node.loop();
    node.after(1ms);
  }
  node.silent();
  CHECK(ended == 1000);
  node.ends.clear();
  CHECK(node.armed_timers() == 0);
}

TEST_CASE("SDO client, own node: COCSdoCancel before the callback gives 0800 0021h, no frame and one callback") {
  Local node;
  node.start_upload(0x2004, 0, 4);
  CHECK(node.cancel() == CO_ERR_NONE);
  node.ended(CO_SDO_ERR_TOS_LOCAL);
  node.loop();
  node.after(1000ms);
  node.silent();
  CHECK(node.ends.empty());
}

TEST_CASE(
    "SDO client, own node: NMT stop, resets and CONodeStop before the callback give 0800 0022h and one callback") {
  const std::vector<std::function<void(CO_NODE*)>> actions = {
      [](CO_NODE* n) { CONmtSetMode(&n->Nmt, CO_STOP); }, [](CO_NODE* n) { CONmtReset(&n->Nmt, CO_RESET_NODE); },
      [](CO_NODE* n) { CONmtReset(&n->Nmt, CO_RESET_COM); }, [](CO_NODE* n) { CONodeStop(n); }};
  for (std::size_t n = 0; n < actions.size(); ++n) {
    CAPTURE(n);
    Local node;
    node.start_upload(0x2004, 0, 4);
    node.call([&] { actions[n](&node.node); });
    node.loop();
    node.after(1000ms);
    node.frames();
    node.ended(CO_SDO_ERR_TOS_STATE);
  }
}

TEST_CASE("SDO client, own node: requests are refused in states without SDO [N3]") {
  Local node;
  node.rx("000#0201");
  CHECK(node.try_upload(0x2004, 0, 4) == CO_ERR_SDO_OFF);
  node.rx("000#8001");
  CHECK(node.read(0x2004, 0, 4).code == 0);
}

TEST_CASE("SDO client, own node: a full transmit queue has no effect") {
  Local node(Setup().only_small().tx_queue(1));
  node.can.refuse_all();
  CO_IF_FRM urgent = frame("091#01");
  node.call([&] { REQUIRE(COIfCanSend(&node->If, &urgent) == sizeof(CO_IF_FRM)); });
  CHECK(node.read(0x2004, 0, 4).code == 0);
  node.can.accept_all();
  node.loop();
  node.tx("091#01");
}

TEST_CASE("SDO client, own node: frames with the CAN-IDs of the client have no effect") {
  Local node;
  node.start_upload(0x2004, 0, 4);
  node.rx("581#4F00200511000000");
  node.rx("581#8004200000000405");
  node.after(1ms);
  node.silent();
  node.has_read({0x11, 0x22, 0x33, 0x44});
}

TEST_CASE("SDO client, own node: sub 3 selects at each request whether the own node is accessed") {
  ClientEntries entries;
  entries.entry[0] = {0x600, 0x580, 1};
  SdoClient node(Setup().only_small(), entries);
  node.start_upload(0x2001, 0, 1);
  node.loop();
  node.after(1ms);
  node.silent();
  node.has_read({0x11});
  node.entry[0].node_id = 5;
  node.start_upload(0x2001, 0, 1);
  node.tx("605#4001200000000000");
  node.rx("585#4F01200099000000");
  node.has_read({0x99});
}

TEST_CASE("SDO client, own node: bit 31 of a COB-ID disables the client [301:7.5.2.34]") {
  ClientEntries entries = local_entries();
  entries.entry[0].tx = 0x80000000;
  SdoClient node(Setup().only_small(), entries);
  CHECK(COCSdoFind(&node.node, 0) == nullptr);
  CHECK(node.try_upload(0x2004, 0, 4) == CO_ERR_SDO_OFF);
  node.entry[0].tx = 0x601;
  CHECK(COCSdoFind(&node.node, 0) == node.csdo());
  node.start_upload(0x2001, 0, 1);
  node.after(1ms);
  node.silent();
  node.has_read({0x11});
  node.entry[0].rx = 0x80000581;
  CHECK(COCSdoFind(&node.node, 0) == nullptr);
}

TEST_CASE("SDO client, own node: a value in a transfer of a remote client can be accessed") {
  Local node;
  node.ask("601#4008200000000000", "581#4108200008000000");
  CHECK(node.read(0x2008, 0, 8).code == 0);
  CHECK(node.write(0x2008, 0, {8, 7, 6, 5, 4, 3, 2, 1}).code == 0);
  node.ask("601#6000000000000000", "581#0011223344556677");
  node.ask("601#7000000000000000", "581#1D88000000000000");
  CHECK(node.objects.u64 == 0x0102030405060708);
}

// Settings of type functions that use the node's SDO client while a transfer of the network calls them.
struct Nested {
  Local* node;
  std::uint16_t index;  // object that the node's client reads
  std::uint32_t code;   // abort code for the transfer of the network; 0: none
  bool is_early;        // the code is set before the client's access
};
Nested nested;

void give_code(CO_OBJ* obj, CO_NODE* node) {
  if (nested.code != 0) {
    COObjTypeUserSDOAbort(obj, node, nested.code);
  }
}

CO_ERR write_nested(CO_OBJ* obj, CO_NODE* node, void*, std::uint32_t) {
  const test::OutsideStack outside;
  if (nested.is_early) {
    give_code(obj, node);
  }
  CHECK(nested.node->try_upload(nested.index, 0, 4) == CO_ERR_NONE);
  if (!nested.is_early) {
    give_code(obj, node);
  }
  return CO_ERR_TYPE_WR;
}

CO_ERR refuse_read(CO_OBJ* obj, CO_NODE* node, void*, std::uint32_t) {
  COObjTypeUserSDOAbort(obj, node, 0x08007777);
  return CO_ERR_TYPE_RD;
}

TEST_CASE("SDO client, own node: a request within a transfer over the network does not change its abort code") {
  const auto four = [](CO_OBJ*, CO_NODE*, std::uint32_t) { return std::uint32_t{4}; };
  const CO_OBJ_TYPE nesting = {four, nullptr, nullptr, write_nested, nullptr};
  const CO_OBJ_TYPE refusing = {four, nullptr, refuse_read, nullptr, nullptr};
  Local node(Setup()
                 .only_small()
                 .with({CO_KEY(0x3000, 0, CO_OBJ______W), &nesting, 0})
                 .with({CO_KEY(0x3001, 0, CO_OBJ_____R_), &refusing, 0}));
  const auto write = [&](std::uint16_t index, std::uint32_t code, bool is_early, std::uint32_t read_code) {
    nested = {&node, index, code, is_early};
    node.rx("601#2300300001000000");
    node.after(1ms);
    REQUIRE(node.ends.size() == 1);
    CHECK(node.ends.front().code == read_code);
    node.ends.clear();
  };
  for (const bool is_early : {false, true}) {
    CAPTURE(is_early);
    write(0x2001, 0x08001234, is_early, 0);
    node.tx("581#8000300034120008");
    write(0x3001, 0x08001234, is_early, 0x08007777);
    node.tx("581#8000300034120008");
  }
  write(0x2001, 0, false, 0);
  node.tx("581#8000300020000008");
  write(0x3001, 0, false, 0x08007777);
  node.tx("581#8000300020000008");
}

// SDO client whose server is the same node: streams, including those with Begin and End (CO_OBJ_TYPE_EX).

// The object at 3000h: logged calls of its type functions, and their results.
struct Image {
  std::vector<std::string> calls;
  Bytes data;
  std::uint32_t position = 0;
  bool knows_size = true;
  std::uint32_t read_total = 0;
  bool at_end = false;
  CO_ERR begin = CO_ERR_NONE;
  CO_ERR end = CO_ERR_NONE;
  CO_ERR access = CO_ERR_NONE;
  std::uint32_t user_abort = 0;
  std::function<void(CO_NODE*)> on_access;

  unsigned count(const std::string& call) const {
    return static_cast<unsigned>(std::count(calls.begin(), calls.end(), call));
  }
} image;

uint32_t image_size(CO_OBJ*, CO_NODE*, uint32_t width) {
  if (width != 0) return width;
  if (image.knows_size || image.at_end) return static_cast<uint32_t>(image.data.size());
  return CO_OBJ_SIZE_UNKNOWN;
}

CO_ERR image_access(CO_OBJ* obj, CO_NODE* node) {
  if (image.on_access) image.on_access(node);
  if (image.user_abort != 0) COObjTypeUserSDOAbort(obj, node, image.user_abort);
  return image.access;
}

CO_ERR image_read(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  const OutsideStack outside;
  if (size == 0) return CO_ERR_NONE;
  const std::size_t left = image.data.size() - image.position;
  const std::size_t n = std::min<std::size_t>(size, left);
  if (n > 0) std::memcpy(buffer, image.data.data() + image.position, n);
  image.position += static_cast<std::uint32_t>(n);
  image.at_end = n < size;
  return image_access(obj, node);
}

CO_ERR image_write(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  const OutsideStack outside;
  if (size == 0) return CO_ERR_NONE;
  const auto* bytes = static_cast<const std::uint8_t*>(buffer);
  image.data.resize(image.position);
  image.data.insert(image.data.end(), bytes, bytes + size);
  image.position += size;
  return image_access(obj, node);
}

CO_ERR image_seek(CO_OBJ*, CO_NODE*, uint32_t position) {
  const OutsideStack outside;
  image.position = position;
  return CO_ERR_NONE;
}

CO_ERR image_begin(CO_OBJ*, CO_NODE*, CO_OBJ_TRANSFER transfer, uint32_t size) {
  const OutsideStack outside;
  image.calls.push_back(std::string(transfer == CO_OBJ_UPLOAD ? "begin upload " : "begin download ") +
                        (size == CO_OBJ_SIZE_UNKNOWN ? "?" : std::to_string(size)));
  return image.begin;
}

CO_ERR image_end(CO_OBJ*, CO_NODE*, CO_OBJ_TRANSFER transfer, uint32_t abort) {
  const OutsideStack outside;
  char code[16];
  std::snprintf(code, sizeof code, "%08X", static_cast<unsigned>(abort));
  image.calls.push_back(std::string(transfer == CO_OBJ_UPLOAD ? "end upload " : "end download ") + code);
  return image.end;
}

const CO_OBJ_TYPE_EX image_type = {
    {image_size, nullptr, image_read, image_write, COObjTypeExReset}, image_seek, image_begin, image_end};

class LocalImage : public SdoClient {
 public:
  LocalImage()
      : SdoClient(Setup().only_small().with({CO_KEY(0x3000, 0, CO_OBJ_____RW), &image_type.Type, 0}), local_entries()) {
    image = Image{};
    image.data = counted(40);
  }
  ClientEnd settle() {
    loop();
    after(1ms);
    silent();
    CHECK(ends.size() == 1);
    const ClientEnd end = ends.empty() ? ClientEnd{} : ends.front();
    ends.clear();
    return end;
  }
  ClientEnd read(std::uint32_t size) {
    start_upload(0x3000, 0, size);
    return settle();
  }
  ClientEnd write(const Bytes& data) {
    start_download(0x3000, 0, data);
    return settle();
  }
};

using Calls = std::vector<std::string>;

TEST_CASE("SDO client, own node: Begin and End of a CO_OBJ_TYPE_EX are called for a read") {
  for (const std::size_t length : {1U, 4U, 7U, 29U, 889U, 2000U}) {
    CAPTURE(length);
    LocalImage node;
    image.data = counted(length);
    const ClientEnd end = node.read(2000);
    CHECK(end.code == 0);
    CHECK(end.data == counted(length));
    CHECK(image.calls == Calls{"begin upload " + std::to_string(length), "end upload 00000000"});
  }
}

TEST_CASE("SDO client, own node: Begin and End of a CO_OBJ_TYPE_EX are called for a write") {
  for (const std::size_t length : {1U, 4U, 7U, 29U, 889U, 2000U}) {
    CAPTURE(length);
    LocalImage node;
    CHECK(node.write(counted(length, 9)).code == 0);
    CHECK(image.data == counted(length, 9));
    CHECK(image.calls == Calls{"begin download " + std::to_string(length), "end download 00000000"});
  }
}

TEST_CASE("SDO client, own node: a stream of unknown size is read to its end") {
  for (const std::size_t length : {0U, 1U, 6U, 7U, 8U, 40U, 889U, 1000U}) {
    for (const std::uint32_t more : {0U, 1U, 500U}) {
      CAPTURE(length);
      CAPTURE(more);
      const auto size = static_cast<std::uint32_t>(length) + more;
      if (size == 0) continue;
      LocalImage node;
      image.knows_size = false;
      image.data = counted(length);
      const ClientEnd end = node.read(size);
      CHECK(end.code == 0);
      CHECK(end.data == counted(length));
      CHECK(image.calls == Calls{"begin upload ?", "end upload 00000000"});
    }
  }
}

TEST_CASE("SDO client, own node: a stream larger than the buffer ends with 0504 0005h, which is passed to End") {
  LocalImage node;
  image.knows_size = false;
  CHECK(node.read(39).code == CO_SDO_ERR_MEM);
  CHECK(image.calls == Calls{"begin upload ?", "end upload 05040005"});
}

TEST_CASE("SDO client, own node: a stream larger than the buffer has one End for each Begin") {
  LocalImage node;
  CHECK(node.read(39).code == CO_SDO_ERR_MEM);
  CHECK(image.count("begin upload 40") == image.count("end upload 05040005"));
}

TEST_CASE("SDO client, own node: a Begin that fails ends the transfer without End") {
  LocalImage node;
  image.begin = CO_ERR_OBJ_STATE;
  CHECK(node.read(40).code == CO_SDO_ERR_TOS_STATE);
  CHECK(image.calls == Calls{"begin upload 40"});
  image.calls.clear();
  CHECK(node.write({1, 2, 3}).code == CO_SDO_ERR_TOS_STATE);
  CHECK(image.calls == Calls{"begin download 3"});
  CHECK(image.data == counted(40));
}

TEST_CASE("SDO client, own node: the error of a read or write is its abort code, and End is called") {
  LocalImage node;
  image.access = CO_ERR_OBJ_NO_DATA;
  CHECK(node.read(40).code == CO_SDO_ERR_NO_DATA);
  CHECK(image.calls == Calls{"begin upload 40", "end upload 08000024"});
  image.calls.clear();
  image.access = CO_ERR_OBJ_RANGE;
  CHECK(node.write(counted(3)).code == CO_SDO_ERR_RANGE);
  CHECK(image.calls == Calls{"begin download 3", "end download 06090030"});
}

TEST_CASE("SDO client, own node: COObjTypeUserSDOAbort sets the abort code as over the bus") {
  LocalImage node;
  image.access = CO_ERR_TYPE_WR;
  image.user_abort = 0x06090031;
  CHECK(node.write(counted(3)).code == 0x06090031);
  CHECK(image.calls.back() == "end download 06090031");
  CHECK(node.read(40).code == 0x06090031);
  image.user_abort = 0;
  CHECK(node.write(counted(3)).code == CO_SDO_ERR_TOS);
}

TEST_CASE("SDO client, own node: the error of End is the result of a download, not of an upload") {
  LocalImage node;
  image.end = CO_ERR_OBJ_INCOMPATIBLE;
  CHECK(node.write(counted(3)).code == CO_SDO_ERR_PARA_INCOMP);
  CHECK(node.read(40).code == 0);
}

TEST_CASE("SDO client, own node: a stream that a remote client has open is refused with 0800 0022h") {
  LocalImage node;
  node.ask("601#4000300000000000", "581#4100300028000000");
  CHECK(node.read(40).code == CO_SDO_ERR_TOS_STATE);
  CHECK(node.write({1, 2, 3}).code == CO_SDO_ERR_TOS_STATE);
  CHECK(image.calls == Calls{"begin upload 40"});
  node.ask("601#6000000000000000", "581#0001020304050607");
  node.rx("601#8000300000000405");
  CHECK(node.read(40).data == counted(40));
}

TEST_CASE("SDO client, own node: a domain open in a remote transfer is refused with 0800 0022h; that one continues") {
  for (const bool upload : {true, false}) {
    CAPTURE(upload);
    LocalImage node;
    node.ask(upload ? "601#4000210F00000000" : "601#2100210F0F000000",
             upload ? "581#4100210F0F000000" : "581#6000210F00000000");
    node.start_upload(0x2100, 15, 15);
    CHECK(node.settle().code == CO_SDO_ERR_TOS_STATE);
    node.start_download(0x2100, 15, counted(15, 90));
    CHECK(node.settle().code == CO_SDO_ERR_TOS_STATE);
    node.ask(upload ? "601#6000000000000000" : "601#0001020304050607",
             upload ? "581#0001020304050607" : "581#2000000000000000");
  }
}

TEST_CASE("SDO client, own node: a type function called for a remote client may start a local transfer [Q9]") {
  LocalImage node;
  CO_ERR err = CO_ERR_BAD_ARG;
  image.on_access = [&](CO_NODE*) {
    if (err != CO_ERR_NONE)
      err = COCSdoRequestUpload(
          node.csdo(), CO_DEV(0x2001, 0), image.data.data(), 1,
          [](CO_CSDO*, std::uint16_t, std::uint8_t, std::uint32_t code) {
            const OutsideStack outside;
            image.calls.push_back("callback " + std::to_string(code));
          },
          0);
  };
  node.rx("601#2F00300042000000");
  node.tx("581#6000300000000000");
  CHECK(err == CO_ERR_NONE);
  node.loop();
  node.after(1ms);
  CHECK(image.calls == Calls{"begin download 1", "end download 00000000", "callback 0"});
  CHECK(image.data == Bytes{0x11});
}

TEST_CASE("SDO client, own node: a reset that a type function requests follows the access and its callback [Q9]") {
  for (const CO_NMT_RESET type : {CO_RESET_NODE, CO_RESET_COM}) {
    LocalImage node;
    image.on_access = [=](CO_NODE* n) { CONmtReset(&n->Nmt, type); };
    node.start_upload(0x3000, 0, 40);
    node.loop();
    node.after(1ms);
    node.tx("701#00");
    node.has_read(counted(40));
    CHECK(image.calls == Calls{"begin upload 40", "end upload 00000000"});
    CHECK(node.csdo()->State == CO_CSDO_STATE_IDLE);
  }
}

TEST_CASE("SDO client, own node: COObjTypeUserSDOAbort between two accesses has no effect") {
  LocalImage node;
  CHECK(node.read(40).code == 0);
  node.call([&] { COObjTypeUserSDOAbort(node.find(0x3000, 0), &node.node, 0x06090031); });
  image.access = CO_ERR_OBJ_NO_DATA;
  CHECK(node.read(40).code == CO_SDO_ERR_NO_DATA);
  node.ask("601#2F00300001000000", "581#8000300024000008");
}

TEST_CASE("SDO client, own node: a type function that stops SDO during the access causes one callback and one End") {
  for (const CO_MODE mode : {CO_STOP, CO_INVALID}) {
    CAPTURE(mode);
    LocalImage node;
    image.on_access = [=](CO_NODE* n) {
      if (mode == CO_STOP) CONmtSetMode(&n->Nmt, CO_STOP);
      if (mode == CO_INVALID) CONodeStop(n);
    };
    node.start_upload(0x3000, 0, 40);
    node.loop();
    node.after(1ms);
    node.silent();
    CHECK(node.ends.size() == 1);
    node.ends.clear();
    CHECK(image.calls.size() == 2);
    CHECK_FALSE(node.is_busy());
  }
}

}  // namespace

#endif
