// SPDX-License-Identifier: Apache-2.0
// Extensions (co_od.h) that call functions of the node during an access: they stop it, remove themselves, read their
// object, change the dictionary. The access continues or is refused, and later accesses work.
#include <algorithm>

#include "support/block_frames.hpp"
#include "support/logged_extension.hpp"
#include "support/pdo_fixture.hpp"
#include "support/sdo_client_fixture.hpp"

#if USE_OD

namespace {

using namespace test;

// Objects 3000h UNSIGNED64, 3001h of unknown length, 3002h VISIBLE_STRING of 30 bytes, 3003h 20 bytes that exist only
// in the extension. All have the same extension.
struct Variables {
  std::uint64_t number = 0;
  std::uint8_t text_memory[30] = {};
  CO_OBJ_STR_RW text{0, 0, 30, text_memory};
};

struct Node : Variables, Fixture {
  LoggedExtension extension;
  unsigned calls_seen = 0;  // calls of the extension since do_at()

  Node() : Fixture(setup(*this)) { extend(); }

  static Setup setup(Variables& v) {
    return Setup()
        .only_small()
        .with({CO_KEY(0x3000, 0, CO_OBJ_____RW), OD_TUNSIGNED64, CO_DATA(&v.number)})
        .with({CO_KEY(0x3001, 0, CO_OBJ_____RW), OD_TSTREAM, CO_DATA(0)})
        .with({CO_KEY(0x3002, 0, CO_OBJ_____RW), OD_TVISIBLE_STRING, CO_DATA(&v.text)})
        .with({CO_KEY(0x3003, 0, CO_OBJ_____RW), OD_TSTREAM, CO_DATA(20)});
  }
  void extend() {
    extension.data = counting(20);
    for (std::uint16_t index = 0x3000; index <= 0x3003; ++index) {
      extension.put_at(*this, index);
    }
  }
};

using Act = std::function<void(Node&, OD_stream_t*)>;

OD_entry_t* entry_of(Node& node, const OD_stream_t* stream) { return OD_find(&node.od, stream->index); }

std::int16_t init_dictionary(Node& node) {
  return CODictInit(&node->Dict, &node.node, node->Dict.Root, static_cast<std::uint16_t>(node->Dict.Num));
}

void index_anew(Node& node) {
  CHECK(OD_init(&node.od, node.od.list, static_cast<std::uint16_t>(node.od.size + 1U), &node.node, node->Dict.Root,
                static_cast<std::uint16_t>(node->Dict.Num)) == ODR_OK);
}

void read_own(Node& node, const OD_stream_t* stream) {
  std::uint8_t bytes[20] = {};
  CODictRdBuffer(&node->Dict, CO_DEV(stream->index, stream->subIndex), bytes, 20);
  std::uint64_t number = 0;
  OD_get_u64(entry_of(node, stream), stream->subIndex, &number, false);
  OD_IO_t io;
  OD_size_t n = 0;
  if (OD_getSub(entry_of(node, stream), stream->subIndex, &io, false) == ODR_OK) {
    io.read(&io.stream, bytes, 5, &n);
  }
}

struct Named {
  const char* name;
  Act act;
  bool serves;  // the node serves requests afterwards without a reset
};

const std::vector<Named>& acts() {
  static const std::vector<Named> all = {
      {"stops the node", [](Node& n, OD_stream_t*) { CONodeStop(&n.node); }, false},
      {"stops SDO", [](Node& n, OD_stream_t*) { CONmtSetMode(&n->Nmt, CO_STOP); }, false},
      {"resets", [](Node& n, OD_stream_t*) { CONmtReset(&n->Nmt, CO_RESET_NODE); }, true},
      {"resets communication", [](Node& n, OD_stream_t*) { CONmtReset(&n->Nmt, CO_RESET_COM); }, true},
      {"takes itself away",
       [](Node& n, OD_stream_t* s) { CHECK(OD_extension_init(entry_of(n, s), nullptr) == ODR_OK); }, true},
      {"comes anew",
       [](Node& n, OD_stream_t* s) {
         OD_extension_t* const own = entry_of(n, s)->extension;
         CHECK(OD_extension_init(entry_of(n, s), nullptr) == ODR_OK);
         CHECK(OD_extension_init(entry_of(n, s), own) == ODR_OK);
       },
       true},
      {"reads its own object", [](Node& n, OD_stream_t* s) { read_own(n, s); }, true},
      {"CODictInit()", [](Node& n, OD_stream_t*) { (void)init_dictionary(n); }, true},
      {"OD_init()", [](Node& n, OD_stream_t*) { index_anew(n); }, true},
      {"CODictObjInit()", [](Node& n, OD_stream_t*) { CODictObjInit(&n->Dict, &n.node); }, true},
      {"CONodeProcess(), COTmrProcess()",
       [](Node& n, OD_stream_t*) {
         CONodeProcess(&n.node);
         COTmrService(&n->Tmr);
         COTmrProcess(&n->Tmr);
       },
       true},
      {"names an abort code",
       [](Node& n, OD_stream_t* s) { COObjTypeUserSDOAbort(n.find(s->index, s->subIndex), &n.node, 0x05040001); },
       true},
  };
  return all;
}

// Makes the extension run \a act once, in the call with this number, from 0.
void do_at(Node& node, unsigned call, const Act& act) {
  node.calls_seen = 0;
  const auto once = [&node, call, act](OD_stream_t* stream) {
    if (node.calls_seen++ == call) {
      act(node, stream);
    }
    return ODR_OK;
  };
  node.extension.on_read = once;
  node.extension.on_write = once;
}

void check_serves(Node& node) {
  node.extension.on_read = nullptr;
  node.extension.on_write = nullptr;
  node.extend();
  for (std::uint16_t index = 0x3001; index <= 0x3003; ++index) {
    CHECK(node.upload(index, 0) == counting(20));
    CHECK(node.download(index, 0, counting(20, 30)) == 0);
    Bytes expected = counting(20, 30);
    if (index == 0x3002) {
      expected.push_back(0);
    }
    CHECK(node.extension.data == expected);
    node.extension.data = counting(20);
  }
  node.extension.data = number_of(counting(8));
  CHECK(node.upload(0x3000, 0) == counting(8));
  if (USE_SDO_BLOCK != 0) {
    node.extension.data = counting(20);
    CHECK(node.block_upload(0x3001, 0).data == counting(20));
  }
  node.extension.data = counting(20);
  std::uint8_t bytes[20] = {};
  node.call([&] { CHECK(CODictRdBuffer(&node->Dict, CO_DEV(0x3001, 0), bytes, 20) == CO_ERR_NONE); });
  CHECK(Bytes(bytes, bytes + 20) == counting(20));
}

// Sends the frames of a transfer, and ignores the answers.
void run_frames(Node& node, const std::vector<std::string>& frames) {
  for (const std::string& text : frames) {
    node.rx(text);
    node.frames();
  }
}

const std::vector<std::vector<std::string>>& transfers() {
  static const std::vector<std::vector<std::string>> all = {
      {"601#4000300000000000", "601#6000000000000000", "601#7000000000000000"},
      {"601#2100300008000000", "601#0001020304050607", "601#1D08000000000000"},
      {"601#4001300000000000", "601#6000000000000000", "601#7000000000000000", "601#6000000000000000"},
      {"601#4002300000000000", "601#6000000000000000", "601#7000000000000000", "601#6000000000000000"},
      {"601#4003300000000000", "601#6000000000000000", "601#7000000000000000", "601#6000000000000000"},
      {"601#2301300001020304"},
      {"601#2302300001020304"},
      {"601#2001300000000000", "601#0001020304050607", "601#1001020304050607", "601#0F00000000000000"},
      {"601#2102300014000000", "601#0001020304050607", "601#1001020304050607", "601#0301020304050600"},
      {"601#2103300014000000", "601#0001020304050607", "601#1001020304050607", "601#0301020304050600"},
      {"601#A401300002000000", "601#A300000000000000", "601#A200020000000000", "601#A202010000000000",
       "601#A201010000000000", "601#A100000000000000"},
      {"601#C201300014000000", "601#0101020304050607", "601#0201020304050607", "601#8301020304050600",
       "601#C500000000000000"},
  };
  return all;
}

TEST_CASE("OD re-entrance: an extension may act in any call of any transfer, and the following transfers are right") {
  for (const Named& one : acts()) {
    for (const std::vector<std::string>& frames : transfers()) {
      for (unsigned call = 0; call < 4; ++call) {
        CAPTURE(std::string(one.name));
        CAPTURE(frames.front());
        CAPTURE(call);
        Node node;
        node.frames_per_call(4);
        do_at(node, call, one.act);
        run_frames(node, frames);
        if (!one.serves) {
          node.extension.on_read = nullptr;
          node.extension.on_write = nullptr;
          node.call([&] {
            if (node.mode() == CO_INVALID) {
              CONodeStart(&node.node);
            }
            CONmtSetMode(&node->Nmt, CO_PREOP);
          });
          if (node.mode() == CO_INVALID) {
            node.init_again();
            node.call([&] { CONodeStart(&node.node); });
          }
        }
        node.frames();
        node.rx("601#8000000000000008");
        node.loop();
        node.frames();
        check_serves(node);
      }
    }
  }
}

TEST_CASE("OD re-entrance: an extension may act in calls of the application") {
  for (const Named& one : acts()) {
    for (unsigned call = 0; call < 3; ++call) {
      CAPTURE(std::string(one.name));
      CAPTURE(call);
      Node node;
      do_at(node, call, one.act);
      std::uint8_t bytes[20] = {};
      node.call([&] {
        CO_OBJ* const obj = node.find(0x3003, 0);
        COObjRdBufStart(obj, &node.node, bytes, 6);
        COObjRdBufCont(obj, &node.node, bytes, 6);
        COObjRdBufCont(obj, &node.node, bytes, 8);
        COObjWrBufStart(obj, &node.node, bytes, 6);
        COObjWrBufCont(obj, &node.node, bytes, 14);
        std::uint64_t number = 0;
        OD_get_u64(OD_find(&node.od, 0x3000), 0, &number, false);
        OD_set_u64(OD_find(&node.od, 0x3000), 0, number, false);
      });
      if (node.mode() == CO_INVALID) {
        node.init_again();
        node.call([&] { CONodeStart(&node.node); });
      }
      node.call([&] { CONmtSetMode(&node->Nmt, CO_PREOP); });
      node.loop();
      node.frames();
      check_serves(node);
    }
  }
}

TEST_CASE("OD re-entrance: it may read its own object within a transfer, which continues at its position") {
  Node node;
  node.extension.on_read = [&, depth = 0](OD_stream_t* stream) mutable {
    if (depth++ == 0) {
      read_own(node, stream);
    }
    --depth;
    return ODR_OK;
  };
  for (std::uint16_t index = 0x3001; index <= 0x3003; ++index) {
    CHECK(node.upload(index, 0) == counting(20));
  }
  std::uint8_t bytes[20] = {};
  node.call([&] {
    CO_OBJ* const obj = node.find(0x3001, 0);
    CHECK(COObjRdBufStart(obj, &node.node, bytes, 6) == CO_ERR_NONE);
    CHECK(COObjRdBufCont(obj, &node.node, bytes + 6, 6) == CO_ERR_NONE);
    CHECK(COObjRdBufCont(obj, &node.node, bytes + 12, 8) == CO_ERR_NONE);
  });
  CHECK(Bytes(bytes, bytes + 20) == counting(20));
}

TEST_CASE("OD re-entrance: it may read another extended object within a transfer; both continue at their positions") {
  Node node;
  node.extension.on_read = [&, depth = 0](OD_stream_t* stream) mutable {
    if (depth++ == 0 && stream->index == 0x3001) {
      std::uint8_t other[20] = {};
      CHECK(CODictRdBuffer(&node->Dict, CO_DEV(0x3003, 0), other, 20) == CO_ERR_NONE);
      CHECK(std::equal(other, other + 20, counting(20).data()));
    }
    --depth;
    return ODR_OK;
  };
  CHECK(node.upload(0x3001, 0) == counting(20));
  std::uint8_t bytes[20] = {};
  node.call([&] {
    CO_OBJ* const obj = node.find(0x3001, 0);
    CHECK(COObjRdBufStart(obj, &node.node, bytes, 6) == CO_ERR_NONE);
    CHECK(COObjRdBufCont(obj, &node.node, bytes + 6, 14) == CO_ERR_NONE);
  });
  CHECK(Bytes(bytes, bytes + 20) == counting(20));
}

TEST_CASE("OD re-entrance: it may write its own object within a download: both are complete") {
  Node node;
  unsigned depth = 0;
  Log inner;
  node.extension.on_write = [&](OD_stream_t* stream) {
    if (depth++ == 0 && stream->dataOffset == 7) {
      std::uint8_t bytes[] = {'a', 'b', 'c'};
      node.extension.take_log();
      CHECK(CODictWrBuffer(&node->Dict, CO_DEV(0x3001, 0), bytes, 3) == CO_ERR_NONE);
      inner = node.extension.take_log();
    }
    --depth;
    return ODR_OK;
  };
  node.ask("601#2001300000000000", "581#6001300000000000");
  node.ask("601#0001020304050607", "581#2000000000000000");
  node.ask("601#1001020304050607", "581#3000000000000000");
  CHECK(inner == Log{"write 3 at 0 of 3"});
  node.ask("601#0D01000000000000", "581#2000000000000000");
  CHECK(node.extension.take_log() == Log{"write 1 at 14 of 15"});
}

TEST_CASE("OD re-entrance: an extension that has removed itself is not called again, also not within a piece") {
  Node node;
  node.extension.at_once = 3;
  do_at(node, 0, acts()[4].act);
  node.ask("601#4003300000000000", "581#4103300014000000");
  node.ask("601#6000000000000000", "581#8003300022000008");
  CHECK(node.extension.take_log() == Log{"read 7 at 0 of 20"});
}

TEST_CASE("OD re-entrance: an extension that removes itself within a transfer aborts it with 0800 0022h") {
  Node node;
  do_at(node, 0, acts()[4].act);
  node.ask("601#4001300000000000", "581#4001300000000000");
  node.ask("601#6000000000000000", "581#8001300022000008");
  do_at(node, 0, acts()[4].act);
  node.ask("601#4003300000000000", "581#4103300014000000");
  node.ask("601#6000000000000000", "581#8003300022000008");
  node.extend();
  node.ask("601#4001300000000000", "581#4001300000000000");
  node.ask("601#6000000000000000", "581#0001020304050607");
  node.rx("601#8001300000000008");
}

TEST_CASE("OD re-entrance: OD_extension_init aborts open transfers of the object and no others") {
  Node node;
  node.ask("601#4001300000000000", "581#4001300000000000");
  node.ask("601#6000000000000000", "581#0001020304050607");
  LoggedExtension other;
  other.put_at(node, 0x3002);
  node.ask("601#7000000000000000", "581#1008090A0B0C0D0E");
  other.put_at(node, 0x3001);
  node.ask("601#6000000000000000", "581#8001300022000008");
  other.data = counting(9);
  CHECK(node.upload(0x3001, 0) == counting(9));
  other.put_at(node, 0x3001);  // the same extension: no effect
  node.ask("601#4001300000000000", "581#4001300000000000");
  other.put_at(node, 0x3001);
  node.ask("601#6000000000000000", "581#0001020304050607");
  node.rx("601#8001300000000008");
}

TEST_CASE("OD re-entrance: OD_extension_init does not change entries of the object that cannot be extended") {
  Bytes memory = counting(20);
  CO_OBJ_DOM domain{0, 20, memory.data()};
  Fixture node(Setup()
                   .only_small()
                   .with({CO_KEY(0x3000, 1, CO_OBJ_____RW), OD_TSTREAM, CO_DATA(0)})
                   .with({CO_KEY(0x3000, 2, CO_OBJ_____RW), CO_TDOMAIN, CO_DATA(&domain)}));
  node.ask("601#4000300200000000", "581#4100300214000000");
  node.ask("601#6000000000000000", "581#0001020304050607");
  LoggedExtension extension;
  extension.put_at(node, 0x3000);
  node.ask("601#7000000000000000", "581#1008090A0B0C0D0E");
  node.ask("601#6000000000000000", "581#030F101112131400");
}

TEST_CASE("OD re-entrance: OD_init during transfers lets those of unmoved entries continue") {
  Node node;
  node.ask("601#4001300000000000", "581#4001300000000000");
  node.ask("601#6000000000000000", "581#0001020304050607");
  node.call([&] {
    CHECK(init_dictionary(node) > 0);
    index_anew(node);
  });
  node.ask("601#7000000000000000", "581#1008090A0B0C0D0E");
  node.ask("601#6000000000000000", "581#030F101112131400");
}

TEST_CASE("OD re-entrance: CONodeInit discards an open transfer; the next one has the right data") {
  Node node;
  node.extension.data = counting(5);
  node.ask("601#4001300000000000", "581#4001300000000000");
  node.call([&] { CONodeStop(&node.node); });
  node.init_again();
  node.call([&] { CONodeStart(&node.node); });
  node.frames();
  node.extension.data = counting(20);
  CHECK(node.upload(0x3001, 0) == counting(20));
}

#if CO_RPDO_N > 0 && CO_TPDO_N > 0

// The download of an extended stream with flag A (4 bytes, mapped to an event-driven TPDO) sends the TPDO.
TEST_CASE("OD re-entrance: a TPDO may read the stream within End of its download, which is called once") {
  LoggedExtension extension;
  PdoTable table;
  table.tpdo[0].on(0x40000181, 255, {0x30000020});
  PdoNode node(table, [](Setup& setup) { setup.with({CO_KEY(0x3000, 0, CO_OBJ___APRW), OD_TSTREAM, CO_DATA(4)}); });
  extension.put_at(node, 0x3000);
  extension.data = {9, 9, 9, 9};
  node.frames_per_call(3);
  node.start();
  node.rx("601#2300300001020304");
  node.tx({"581#6000300000000000", "181#01020304"});
  node.ask("601#2100300004000000", "581#6000300000000000");
  extension.take_log();
  node.rx("601#0705060708000000");
  node.tx({"581#2000000000000000", "181#05060708"});
  CHECK(extension.take_log() == Log{"write 4 at 0 of 4", "read 4 at 0 of 4"});
}

#endif

#if USE_CSDO && USE_CSDO_OWN

TEST_CASE("OD re-entrance: within an access of an SDO client to its own node the application may read the object") {
  LoggedExtension extension;
  SdoClient node(Setup().only_small().with({CO_KEY(0x3000, 0, CO_OBJ_____RW), OD_TSTREAM, CO_DATA(0)}),
                 local_entries());
  extension.put_at(node, 0x3000);
  extension.data = counting(20);
  extension.on_read = [&, depth = 0](OD_stream_t*) mutable {
    std::uint8_t other[5] = {};
    if (depth++ == 0) {
      CHECK(CODictRdBuffer(&node->Dict, CO_DEV(0x3000, 0), other, 5) == CO_ERR_NONE);
    }
    --depth;
    return ODR_OK;
  };
  node.start_upload(0x3000, 0, 30);
  node.after(1ms);
  node.has_read(counting(20));
  node.start_download(0x3000, 0, counting(9, 60));
  node.after(1ms);
  node.has_written();
  CHECK(extension.data == counting(9, 60));
}

#endif

}  // namespace

#endif
