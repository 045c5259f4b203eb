// SPDX-License-Identifier: Apache-2.0
// A change of the extension (co_od.h) during a transfer aborts the transfer. If Begin of the original type was called,
// its End is called once.
#include <algorithm>

#include "support/block_frames.hpp"
#include "support/logged_extension.hpp"
#include "support/logged_stream.hpp"
#include "support/sdo_client_fixture.hpp"

#if USE_OD

namespace {

using namespace test;

CO_OBJ extensible(LoggedStream& stream) {
  static const CO_OBJ_TYPE* const original = LoggedStream().extended(0x3000).Type;
  static const OD_TYPE type = OD_STREAM(original, OD_ORIGINAL);
  return {CO_KEY(0x3000, 0, CO_OBJ_____RW), &type.Ex.Type, CO_DATA(&stream)};
}

struct Variables {
  LoggedStream image;
  LoggedExtension extension;
  LoggedExtension other;

  Variables() {
    image.data = counting(20);
    extension.data = counting(20);
    other.data = counting(20);
  }
  Setup setup() { return Setup().only_small().with(extensible(image)); }
};

struct Node : Variables, Fixture {
  Node() : Fixture(setup()) {}

  void give(OD_extension_t* to) {
    call([&] { CHECK(OD_extension_init(OD_find(&od, 0x3000), to) == ODR_OK); });
  }
};

// Logged calls of Begin (number) and of End.
struct TransferCalls {
  unsigned begins = 0;
  Log ends;
};

TransferCalls transfer_calls(const Log& log) {
  TransferCalls calls;
  for (const std::string& line : log) {
    calls.begins += line.substr(0, 5) == "begin" ? 1U : 0U;
    if (line.substr(0, 3) == "end") {
      calls.ends.push_back(line);
    }
  }
  return calls;
}

// A segmented or block transfer that is not complete.
struct Open {
  const char* name;
  std::vector<std::string> frames;
  std::string next;  // next frame of the client
  bool uploads;
};

const std::vector<Open>& open_transfers() {
  static const std::vector<Open> all = {
    {"upload, initiated", {"601#4000300000000000"}, "601#6000000000000000", true},
    {"upload", {"601#4000300000000000", "601#6000000000000000"}, "601#7000000000000000", true},
    {"download, initiated", {"601#2100300014000000"}, "601#0001020304050607", false},
    {"download", {"601#2100300014000000", "601#0001020304050607"}, "601#1001020304050607", false},
#if USE_SDO_BLOCK
    {"block upload, initiated", {"601#A000300004000000"}, "601#A300000000000000", true},
    {"block download, within", {"601#C200300014000000", "601#0101020304050607"}, "601#8201020304050607", false},
#endif
  };
  return all;
}

TEST_CASE(
    "OD end: replacing the extension aborts an open transfer at its next frame and calls End of the type at once") {
  for (const Open& open : open_transfers()) {
    for (const unsigned from : {0U, 1U, 2U}) {  // extension replaced, removed, set for the first time
      CAPTURE(std::string(open.name));
      CAPTURE(from);
      Node node;
      node.give(from < 2 ? &node.extension.extension : nullptr);
      for (const std::string& frame : open.frames) {
        node.rx(frame);
        node.frames();
      }
      node.image.take_log();
      node.extension.take_log();
      node.give(from == 1 ? nullptr : &node.other.extension);
      CHECK(node.image.take_log() == Log{open.uploads ? "end up 08000022" : "end down 08000022"});
      node.rx(open.next);
      const std::vector<std::string> answer = node.frames();
      if (open.next != "601#8201020304050607") {
        CHECK(answer == std::vector<std::string>{"581#8000300022000008"});
      }
      node.rx("601#8000300000000008");
      CHECK(node.image.take_log().empty());
      CHECK(node.extension.take_log().empty());
      node.image.data = counting(20);
      CHECK(node.download(0x3000, 0, counting(20)) == 0);
      CHECK(node.upload(0x3000, 0) == counting(20));
      const TransferCalls after = transfer_calls(node.image.take_log());
      CHECK(after.begins == 2);
      CHECK(after.ends == Log{"end down 0", "end up 0"});
    }
  }
}

TEST_CASE("OD end: after the time-out of such a transfer End is not called again") {
  Node node;
  node.give(&node.extension.extension);
  node.ask("601#2100300014000000", "581#6000300000000000");
  node.give(nullptr);
  CHECK(transfer_calls(node.image.take_log()).ends == Log{"end down 08000022"});
  node.after(std::chrono::milliseconds(2 * CO_SDO_TIMEOUT));
  node.frames();
  CHECK(node.image.take_log().empty());
}

// Returns the client's frames of complete transfers.
const std::vector<std::vector<std::string>>& transfers() {
  static const std::vector<std::vector<std::string>> all = {
    {"601#4000300000000000", "601#6000000000000000", "601#7000000000000000", "601#6000000000000000"},
    {"601#2100300014000000", "601#0001020304050607", "601#1001020304050607", "601#0301020304050600"},
    {"601#2000300000000000", "601#0001020304050607", "601#1001020304050607", "601#0F00000000000000"},
    {"601#2300300001020304"},
#if USE_SDO_BLOCK
    {"601#A000300004000000", "601#A300000000000000", "601#A203040000000000", "601#A100000000000000"},
    {"601#C000300014000000", "601#0101020304050607", "601#0201020304050607", "601#8301020304050600",
     "601#C500000000000000"},
#endif
  };
  return all;
}

// Sends the frames. Returns the number of aborts in the answers.
unsigned run_frames(Node& node, const std::vector<std::string>& frames) {
  unsigned aborts = 0;
  for (const std::string& frame : frames) {
    node.rx(frame);
    for (const std::string& sent : node.frames()) {
      aborts += sent.substr(4, 2) == "80" ? 1U : 0U;
    }
  }
  return aborts;
}

TEST_CASE("OD end: an extension that replaces itself in any call causes one abort and one End with its code") {
  for (const std::vector<std::string>& frames : transfers()) {
    for (unsigned call = 0; call < 3; ++call) {
      for (const bool back : {false, true}) {
        CAPTURE(frames.front());
        CAPTURE(call);
        CAPTURE(back);
        Node node;
        node.frames_per_call(4);
        node.extension.at_once = 7;
        node.give(&node.extension.extension);
        bool acted = false;
        const auto act = [&, calls = 0U](OD_stream_t*) mutable {
          if (calls++ == call) {
            acted = true;
            CHECK(OD_extension_init(OD_find(&node.od, 0x3000), &node.other.extension) == ODR_OK);
            if (back) {
              CHECK(OD_extension_init(OD_find(&node.od, 0x3000), &node.extension.extension) == ODR_OK);
            }
          }
          return ODR_OK;
        };
        node.extension.on_read = act;
        node.extension.on_write = act;
        const unsigned aborts = run_frames(node, frames);
        node.rx("601#8000300000000008");
        node.frames();
        const TransferCalls after = transfer_calls(node.image.take_log());
        CHECK(after.begins == 1);
        CHECK(after.ends.size() == 1);
        if (acted) {
          CHECK(aborts != 0);
          CHECK(after.ends.front().find("08000022") != std::string::npos);
          CHECK(node.other.take_log().empty());
        }
        node.extension.on_read = nullptr;
        node.extension.on_write = nullptr;
        node.extension.data = counting(20);
        CHECK(node.upload(0x3000, 0) == counting(20));
      }
    }
  }
}

TEST_CASE("OD end: the original type may replace the extension of the object in any of its calls") {
  for (const std::vector<std::string>& frames : transfers()) {
    for (unsigned which = 0; which < 5; ++which) {
      CAPTURE(frames.front());
      CAPTURE(which);
      Node node;
      node.frames_per_call(4);
      unsigned acted = 0;
      const auto act = [&](CO_OBJ*, CO_NODE*) {
        if (acted++ == 0) {
          CHECK(OD_extension_init(OD_find(&node.od, 0x3000), &node.other.extension) == ODR_OK);
        }
        return CO_ERR_NONE;
      };
      LoggedStream& image = node.image;
      (which == 0   ? image.on_begin
       : which == 1 ? image.on_reset
       : which == 2 ? image.on_open
       : which == 3 ? image.on_piece
                    : image.on_end) = act;
      run_frames(node, frames);
      node.rx("601#8000300000000008");
      node.frames();
      const TransferCalls after = transfer_calls(image.take_log());
      CHECK(after.begins == 1);
      CHECK(after.ends.size() == 1);
      if (which < 4 && acted != 0) {
        CHECK(after.ends.front().find("08000022") != std::string::npos);
      }
      acted = 1;
      image.data = counting(20);
      node.other.data = counting(20);
      CHECK(node.upload(0x3000, 0) == counting(20));
    }
  }
}

TEST_CASE("OD end: a partial access of the application ends when its extension is replaced") {
  Node node;
  node.give(&node.extension.extension);
  std::uint8_t bytes[20] = {};
  CO_OBJ* const obj = node.find(0x3000, 0);
  node.call([&] { CHECK(COObjRdBufStart(obj, &node.node, bytes, 6) == CO_ERR_NONE); });
  node.give(&node.other.extension);
  node.call([&] { CHECK(COObjRdBufCont(obj, &node.node, bytes, 6) == CO_ERR_OBJ_STATE); });
  CHECK(node.other.take_log().empty());
  node.call([&] {
    CHECK(COObjRdBufStart(obj, &node.node, bytes, 6) == CO_ERR_NONE);
    CHECK(COObjRdBufCont(obj, &node.node, bytes + 6, 14) == CO_ERR_NONE);
  });
  CHECK(Bytes(bytes, bytes + 20) == counting(20));
}

#if USE_CSDO && USE_CSDO_OWN

TEST_CASE("OD end: an access of an SDO client to its own node is aborted, and End of the type is called") {
  for (const bool uploads : {true, false}) {
    Variables variables;
    SdoClient node(variables.setup(), local_entries());
    variables.extension.put_at(node, 0x3000);
    const auto act = [&](OD_stream_t*) {
      CHECK(OD_extension_init(OD_find(&node.od, 0x3000), &variables.other.extension) == ODR_OK);
      return ODR_OK;
    };
    variables.extension.on_read = act;
    variables.extension.on_write = act;
    if (uploads) {
      node.start_upload(0x3000, 0, 30);
    } else {
      node.start_download(0x3000, 0, counting(20));
    }
    node.after(1ms);
    node.ended(0x08000022);
    CHECK(transfer_calls(variables.image.take_log()).ends == Log{uploads ? "end up 08000022" : "end down 08000022"});
    CHECK(variables.other.take_log().empty());
  }
}

#endif

}  // namespace

#endif
