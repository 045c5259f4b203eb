// SPDX-License-Identifier: Apache-2.0
// SDO server: each of the 256 command bytes in each state that the server can be in, for each kind of object, at each
// length. [T6] The reactions are those of sdo_sweep_golden.txt.
#include <cstring>

#include "support/fixture.hpp"
#include "support/sdo_reactions.hpp"

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

// The memory of all objects that the table names.
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
}

class Sweep : public Fixture {
 public:
  explicit Sweep(const SdoState& of)
      : Fixture(Setup()
                    .only_small()
                    .with({CO_KEY(0x3001, 0, CO_OBJ_____RW), &stream_type, static_cast<void*>(&streams[0])})
                    .with({CO_KEY(0x3002, 0, CO_OBJ_____RW), &stream_type, static_cast<void*>(&streams[1])})),
        state(of) {
    watch(0x3001, 0, streams[0].memory, sizeof streams[0].memory, true);
    watch(0x3002, 0, streams[1].memory, sizeof streams[1].memory, true);
  }
  void enter() {
    fill(objects);
    for (const auto& [request, answer] : state.enter) ask(request, answer);
  }
  CO_IF_FRM request(unsigned command, unsigned dlc) const {
    CO_IF_FRM frm = frame("601#00" + state.request + "04000000");
    frm.Data[0] = static_cast<std::uint8_t>(command);
    frm.DLC = static_cast<std::uint8_t>(dlc);
    return frm;
  }
  // An unknown command is answered with the multiplexer of the open transfer, else with its own bytes. [D7]
  std::string open_transfer() {
    rx("601#E0AABBCC00000000");
    const std::vector<std::string> sent = frames();
    const std::string told = sent.size() == 1 ? sent[0].substr(6, 6) : "none";
    return told == "AABBCC" ? "" : told;
  }
  const SdoState& state;
};

std::string at(const std::vector<std::string>& lines, std::size_t n) { return n < lines.size() ? lines[n] : ""; }

// Empty if the server reacts as the table says, else what is different.
std::string deviation(Sweep& node, unsigned command) {
  const SdoReaction& expected = node.state.reactions[command][0];
  node.enter();
  const Bytes before = image(node.objects);
  node.rx(node.request(command, 8));
  const std::vector<std::string> sent = node.frames();
  const bool changed = image(node.objects) != before;
  const std::string open = node.open_transfer();
  std::string what;
  if (sent.size() > 1 || at(sent, 0) != expected.answer) what += " answer " + at(sent, 0) + ", not " + expected.answer;
  if (open != expected.open) what += " open " + open + ", not " + expected.open;
  if (changed == expected.written.empty()) what += changed ? " written" : " not written";
  return what.empty() ? "" : notation(node.request(command, 8)) + ":" + what;
}

TEST_CASE("SDO server: the table of reactions names 21 states, and one reaction to each command byte [T6]") {
  const std::vector<SdoState> states = sdo_states(golden);
  CHECK(states.size() == 21);
  for (const SdoState& state : states) {
    CAPTURE(state.name);
    for (unsigned command = 0; command < 256; ++command) {
      CAPTURE(command);
      CHECK(state.reactions[command].size() == 1);
    }
  }
}

TEST_CASE("SDO server: the reaction to every command byte in every state for every kind of object [T6] [D1]-[D9]") {
  for (const SdoState& state : sdo_states(golden)) {
    Sweep node(state);
    std::vector<std::string> wrong;
    for (unsigned command = 0; command < 256; ++command) {
      const std::string deviates = deviation(node, command);
      if (!deviates.empty()) wrong.push_back(deviates);
    }
    CHECK_MESSAGE(wrong.empty(), state.name, ": ", wrong.size(), " wrong, e.g. ", at(wrong, 0), " and ", at(wrong, 1));
  }
}

TEST_CASE("SDO server: no frame of another length than 8 has any effect, in any state [T6] [D1]") {
  for (const SdoState& state : sdo_states(golden)) {
    CAPTURE(state.name);
    Sweep node(state);
    node.enter();
    const std::uint32_t malformed = node.counters().Malformed;
    const Bytes before = image(node.objects);
    unsigned answered = 0;
    for (unsigned command = 0; command < 256; ++command) {
      for (unsigned dlc = 0; dlc < 8; ++dlc) {
        node.rx(node.request(command, dlc));
        answered += node.frames().empty() ? 0U : 1U;
      }
    }
    CHECK(answered == 0);
    CHECK(node.counters().Malformed == malformed + 256 * 8);
    CHECK(image(node.objects) == before);
    CHECK(node.open_transfer() == state.transfer);
  }
}

TEST_CASE("SDO server: whatever the command byte was, in whatever state, the next read is answered [T6] [D8]") {
  for (const SdoState& state : sdo_states(golden)) {
    CAPTURE(state.name);
    Sweep node(state);
    for (unsigned command = 0; command < 256; ++command) {
      node.enter();
      node.rx(node.request(command, 8));
      node.frames();
      node.ask("601#4000100000000000", "581#4300100091010F00");
    }
  }
}

}  // namespace
