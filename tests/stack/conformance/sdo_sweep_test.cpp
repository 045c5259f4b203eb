// SPDX-License-Identifier: Apache-2.0
// SDO server: each of the 256 command bytes in each state of the server, for each kind of object, at each length. [T6]
// The expected reactions are in sdo_sweep_golden.txt; the model of the server is compared with them, too.
#include <algorithm>
#include <cstring>

#include "support/fixture.hpp"
#include "support/sdo_reactions.hpp"
#include "support/sdo_server_model.hpp"

namespace {

using namespace test;

constexpr char golden[] =
#include "sdo_sweep_golden.inc"
    ;

// Two streams of the application, of 15 bytes each.
struct Stream {
  std::uint32_t offset;
  std::uint8_t memory[15];
} streams[2];

Stream& stream_of(const CO_OBJ* obj) { return *static_cast<Stream*>(static_cast<void*>(obj->Data)); }

uint32_t stream_size(CO_OBJ*, CO_NODE*, uint32_t width) { return width == 0 || width > 15 ? 15 : width; }
CO_ERR stream_reset(CO_OBJ* obj, CO_NODE*, uint32_t position) {
  stream_of(obj).offset = position;
  return CO_ERR_NONE;
}
CO_ERR stream_read(CO_OBJ* obj, CO_NODE*, void* buffer, uint32_t size) {
  Stream& stream = stream_of(obj);
  std::memcpy(buffer, stream.memory + stream.offset, size);
  stream.offset += size;
  return CO_ERR_NONE;
}
CO_ERR stream_write(CO_OBJ* obj, CO_NODE*, void* buffer, uint32_t size) {
  Stream& stream = stream_of(obj);
  std::memcpy(stream.memory + stream.offset, buffer, size);
  stream.offset += size;
  return CO_ERR_NONE;
}
const CO_OBJ_TYPE stream_type = {stream_size, nullptr, stream_read, stream_write, stream_reset};

// Two domains that are larger than the buffer of the server.
constexpr std::uint32_t large_size = 1000;
std::uint8_t large_memory[2][large_size];
CO_OBJ_DOM large[2] = {{0, large_size, large_memory[0]}, {0, large_size, large_memory[1]}};

// The states of block transfers in the table require a server with a buffer of 127 segments.
constexpr bool has_block = USE_SDO_BLOCK != 0 && CO_SDO_BUF_SEG == 127;

// Returns the memory of all objects of the table.
Bytes image(const Objects& o) {
  Bytes all;
  const auto add = [&](const void* memory, std::size_t size) {
    const auto* first = static_cast<const std::uint8_t*>(memory);
    all.insert(all.end(), first, first + size);
  };
  add(&o.record, sizeof o.record);
  add(&o.u32, sizeof o.u32);
  add(&o.u64, sizeof o.u64);
  add(&o.real64, sizeof o.real64);
  add(o.memory.at(9).data(), 9);
  add(o.memory.at(15).data(), 15);
  add(streams[0].memory, 15);
  add(streams[1].memory, 15);
  add(large_memory, sizeof large_memory);
  return all;
}

void fill(Objects& o) {
  o.record = 0x01010101;
  o.u32 = 0x44332211;
  o.u64 = 0x8877665544332211;
  o.real64 = 1.0;
  for (const std::uint32_t size : {9U, 15U}) {
    for (std::uint32_t i = 0; i < size; ++i) o.memory[size][i] = static_cast<std::uint8_t>(i + 1);
  }
  for (Stream& stream : streams) std::memset(stream.memory, 0x55, sizeof stream.memory);
  std::memset(large_memory, 0x55, sizeof large_memory);
}

Setup setup_with(bool block) {
  Setup setup;
  setup.only_small()
      .with({CO_KEY(0x3001, 0, CO_OBJ_____RW), &stream_type, static_cast<void*>(&streams[0])})
      .with({CO_KEY(0x3002, 0, CO_OBJ_____RW), &stream_type, static_cast<void*>(&streams[1])})
      .with({CO_KEY(0x4000, 0, CO_OBJ_____RW), CO_TDOMAIN, static_cast<void*>(&large[0])})
      .with({CO_KEY(0x4001, 0, CO_OBJ_____RW), CO_TDOMAIN, static_cast<void*>(&large[1])});
  return block ? setup : setup.without_sdo_buffer();
}

CO_IF_FRM request_in(const SdoState& state, unsigned command, unsigned dlc = 8) {
  CO_IF_FRM frm = frame("601#00" + state.request + "04000000");
  frm.Data[0] = static_cast<std::uint8_t>(command);
  frm.DLC = static_cast<std::uint8_t>(dlc);
  return frm;
}

using Frames = std::vector<std::string>;

class Sweep : public Fixture {
 public:
  explicit Sweep(const SdoState& of, bool block = has_block) : Fixture(setup_with(block)), state(of) {
    watch(0x3001, 0, streams[0].memory, sizeof streams[0].memory, true);
    watch(0x3002, 0, streams[1].memory, sizeof streams[1].memory, true);
  }
  void enter() {
    fill(objects);
    for (const auto& step : state.enter) {
      rx(step.request);
      const Frames sent = frames();
      CHECK_MESSAGE(sent == step.answers, state.name, ": cannot be entered, ", step.request, " is answered ", sent);
    }
  }
  // Returns the multiplexer of the open transfer, from the abort after its time-out; empty: no transfer is open. [D18]
  std::string open_transfer() {
    after(sdo_time_out());
    const Frames sent = frames();
    return !sent.empty() && sent.back().substr(0, 6) == "581#80" ? sent.back().substr(6, 6) : "";
  }
  const SdoState& state;
};

std::string listed(const Frames& frames) { return frames.empty() ? "-" : doctest::toString(frames).c_str(); }

// Returns the difference between the server's reaction and the table; empty: none.
std::string deviation(const SdoState& state, unsigned command, const Frames& answers, const std::string& open,
                      bool changed) {
  const SdoReaction& expected = state.reactions[command][0];
  std::string what;
  if (answers != expected.answers) what += " answer " + listed(answers) + ", not " + listed(expected.answers);
  if (open != expected.open) what += " open " + open + ", not " + expected.open;
  if (changed == expected.written.empty()) what += changed ? " written" : " not written";
  return what.empty() ? "" : notation(request_in(state, command)) + ":" + what;
}

std::string deviation(Sweep& node, unsigned command) {
  node.enter();
  const Bytes before = image(node.objects);
  node.rx(request_in(node.state, command));
  const Frames answers = node.frames();
  const bool changed = image(node.objects) != before;
  return deviation(node.state, command, answers, node.open_transfer(), changed);
}

std::string at(const Frames& lines, std::size_t n) { return n < lines.size() ? lines[n] : ""; }

void check_reactions(const std::vector<SdoState>& states, bool block) {
  unsigned round = 0;
  for (const SdoState& state : states) {
    Sweep node(state, block);
    Frames wrong;
    for (unsigned command = round++ % stride(61); command < 256; command += stride(61)) {
      const std::string deviates = deviation(node, command);
      if (!deviates.empty()) wrong.push_back(deviates);
    }
    CHECK_MESSAGE(wrong.empty(), state.name, ": ", wrong.size(), " wrong, e.g. ", at(wrong, 0), " and ", at(wrong, 1));
  }
}

// Model ---------------------------------------------------------------------------------------------------------------

Bytes text(const char* all) { return Bytes(all, all + std::strlen(all)); }

Bytes counting(std::uint8_t last) {
  Bytes bytes;
  for (std::uint8_t n = 1; n <= last; ++n) bytes.push_back(n);
  return bytes;
}

std::vector<SdoObject> objects_of_model() {
  using Kind = SdoObject::Kind;
  return {
      {0x2004, 0, true, true, Kind::number, 4, {0x11, 0x22, 0x33, 0x44}},
      {0x2033, 1, true, true, Kind::number, 4, {1, 1, 1, 1}},
      {0x2008, 0, true, true, Kind::number, 8, {0x11, 0x22, 0x33, 0x44, 0x55, 0x66, 0x77, 0x88}},
      {0x2028, 0, true, true, Kind::number, 8, {0, 0, 0, 0, 0, 0, 0xF0, 0x3F}},
      {0x2100, 9, true, true, Kind::domain, 9, counting(9)},
      {0x2100, 15, true, true, Kind::domain, 15, counting(15)},
      {0x1008, 0, true, false, Kind::text, 17, text("Lexican test node")},
      {0x100A, 0, true, false, Kind::text, 3, text("1.0")},
      {0x3001, 0, true, true, Kind::domain, 15, Bytes(15, 0x55)},
      {0x3002, 0, true, true, Kind::domain, 15, Bytes(15, 0x55)},
      {0x4000, 0, true, true, Kind::domain, large_size, Bytes(large_size, 0x55)},
      {0x4001, 0, true, true, Kind::domain, large_size, Bytes(large_size, 0x55)},
  };
}

// Returns the values of the table's objects in the model.
std::vector<Bytes> values(const SdoServerModel& model) {
  std::vector<Bytes> all;
  for (const SdoObject& object : model.objects()) all.push_back(object.value);
  return all;
}

Frames answers_of(SdoServerModel& model, const CO_IF_FRM& request) {
  SdoBytes bytes{};
  std::copy_n(request.Data, bytes.size(), bytes.begin());
  Frames all;
  for (const SdoBytes& answer : model.answers(bytes)) {
    CO_IF_FRM frm{0x581, {}, 8};
    std::copy_n(answer.begin(), answer.size(), frm.Data);
    all.push_back(notation(frm));
  }
  return all;
}

std::string open_transfer(const SdoServerModel& model) {
  const SdoKey& key = model.key();
  return model.is_open() ? notation(CO_IF_FRM{0, {key[0], key[1], key[2]}, 3}).substr(4) : "";
}

std::string deviation_of_model(const SdoState& state, unsigned command, bool block) {
  SdoServerModel model(objects_of_model(), block ? 127 : 0);
  for (const auto& [request, answers] : state.enter) CHECK(answers_of(model, frame(request)) == answers);
  const std::vector<Bytes> before = values(model);
  const Frames answers = answers_of(model, request_in(state, command));
  const std::string deviates = deviation(state, command, answers, open_transfer(model), values(model) != before);
  CHECK(model.is_in_block() == state.reactions[command][0].in_block);
  return deviates;
}

// Test cases ----------------------------------------------------------------------------------------------------------

TEST_CASE("SDO server: the table of reactions has 61 states and one reaction for each command byte [T6]") {
  const std::vector<SdoState> states = sdo_states(golden, true);
  CHECK(states.size() == 61);
  CHECK(sdo_states(golden, false).size() == 21);
  for (const SdoState& state : states) {
    CAPTURE(state.name);
    for (unsigned command = 0; command < 256; ++command) {
      CAPTURE(command);
      CHECK(state.reactions[command].size() == 1);
    }
  }
}

TEST_CASE("SDO server: the table of reactions equals the model with and without block transfer [T6]") {
  unsigned round = 0;
  for (const bool block : {true, false}) {
    for (const SdoState& state : sdo_states(golden, block)) {
      CAPTURE(state.name);
      for (unsigned command = round++ % stride(61); command < 256; command += stride(61)) {
        CHECK(deviation_of_model(state, command, block) == "");
      }
    }
  }
}

TEST_CASE("SDO server: every command byte in every state has its reaction for every kind of object [T6] [D1]-[D13]") {
  check_reactions(sdo_states(golden, has_block), has_block);
}

TEST_CASE("SDO server: without a buffer every command byte has the reaction without block transfer [T6]") {
  check_reactions(sdo_states(golden, false), false);
}

TEST_CASE("SDO server: frames of another length than 8 have no effect in any state [T6] [D1]") {
  unsigned round = 0;
  for (const SdoState& state : sdo_states(golden, has_block)) {
    CAPTURE(state.name);
    Sweep node(state);
    node.enter();
    const std::uint32_t malformed = node.counters().Malformed;
    const Bytes before = image(node.objects);
    unsigned answered = 0;
    std::uint32_t number = 0;
    for (unsigned command = round++ % stride(61); command < 256; command += stride(61)) {
      for (unsigned dlc = 0; dlc < 8; ++dlc, ++number) {
        node.rx(request_in(state, command, dlc));
        answered += node.frames().empty() ? 0U : 1U;
      }
    }
    CHECK(answered == 0);
    CHECK(node.counters().Malformed == malformed + number);
    CHECK(image(node.objects) == before);
    CHECK(node.open_transfer() == (state.enter.empty() ? "" : state.transfer));
  }
}

// Within a sub-block, the server would treat an upload request as a segment: the client has to abort first. [D23]
TEST_CASE("SDO server: after any command byte in any state the next upload is answered [T6] [D8]") {
  unsigned round = 0;
  for (const SdoState& state : sdo_states(golden, has_block)) {
    CAPTURE(state.name);
    Sweep node(state);
    for (unsigned command = round++ % stride(61); command < 256; command += stride(61)) {
      node.enter();
      node.rx(request_in(state, command));
      node.frames();
      if (state.reactions[command][0].in_block) {
        node.rx("601#8000000000000000");
        node.silent();
      }
      node.ask("601#4000100000000000", "581#4300100091010F00");
    }
  }
}

}  // namespace
