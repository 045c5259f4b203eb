// SPDX-License-Identifier: Apache-2.0
// 1026h, OS prompt: single characters by SDO and PDO. [301:7.5.2.29]
#include "support/pdo_fixture.hpp"

namespace {

using namespace test;

std::string received;

struct Prompt {
  std::uint8_t out[8] = {};
  std::uint8_t err[4] = {};
  CO_OS_PROMPT prompt = CO_OS_PROMPT_OF(input, out, err);

  Prompt() { received.clear(); }
  static void input(CO_NODE*, void*, std::uint8_t character) {
    const OutsideStack outside;
    received += static_cast<char>(character);
  }
  void add_to(Setup& setup) {
    setup.with({CO_KEY(0x1026, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, 3})
        .with({CO_KEY(0x1026, 1, CO_OBJ____P_W), CO_TOS_STDIN, &prompt})
        .with({CO_KEY(0x1026, 2, CO_OBJ____PR_), CO_TOS_STDOUT, &prompt})
        .with({CO_KEY(0x1026, 3, CO_OBJ____PR_), CO_TOS_STDOUT, &prompt});
  }
};

CO_ERR print(Fixture& node, std::uint8_t sub, const std::string& text) {
  CO_ERR err = CO_ERR_NONE;
  node.call([&] {
    err = COOsPrint(&node.node, sub, reinterpret_cast<const std::uint8_t*>(text.data()),
                    static_cast<std::uint16_t>(text.size()));
  });
  return err;
}

struct SdoPrompt : Prompt {
  SdoPrompt() : node(setup()) {}
  Setup setup() {
    Setup all;
    add_to(all);
    return all;
  }
  Fixture node;
};

TEST_CASE("1026h: each character that is written to StdIn is passed to the application [O6]") {
  SdoPrompt device;
  device.node.ask("601#2F2610016C000000", "581#6026100100000000");
  device.node.ask("601#2F26100173000000", "581#6026100100000000");
  device.node.ask("601#2F2610010D000000", "581#6026100100000000");
  CHECK(received == "ls\r");
}

TEST_CASE("1026h: StdIn accepts one byte and cannot be read [O6]") {
  SdoPrompt device;
  device.node.ask("601#2B26100161620000", "581#8026100112000706");
  device.node.ask("601#2126100102000000", "581#8026100112000706");
  device.node.ask("601#4026100100000000", "581#8026100101000106");
  CHECK(received.empty());
}

TEST_CASE("1026h: StdIn without a function is refused [O6]") {
  SdoPrompt device;
  device.prompt.Input = nullptr;
  device.node.ask("601#2F26100161000000", "581#8026100120000008");
}

TEST_CASE("1026h: uploads of StdOut and StdErr take the characters in their order [O6]") {
  SdoPrompt device;
  CHECK(print(device.node, 2, "ok") == CO_ERR_NONE);
  CHECK(print(device.node, 3, "!") == CO_ERR_NONE);
  device.node.silent();
  device.node.ask("601#4026100200000000", "581#4F2610026F000000");
  device.node.ask("601#4026100300000000", "581#4F26100321000000");
  device.node.ask("601#4026100300000000", "581#8026100324000008");
  device.node.ask("601#4026100200000000", "581#4F2610026B000000");
  device.node.ask("601#4026100200000000", "581#8026100224000008");
}

TEST_CASE("1026h: StdOut and StdErr cannot be written [O6]") {
  SdoPrompt device;
  device.node.ask("601#2F26100261000000", "581#8026100202000106");
  device.node.ask("601#2F26100361000000", "581#8026100302000106");
}

TEST_CASE("1026h: the ring keeps the order where it wraps and accepts all or none [O6]") {
  SdoPrompt device;
  CHECK(print(device.node, 2, "12345678") == CO_ERR_NONE);
  CHECK(print(device.node, 2, "9") == CO_ERR_OBJ_SIZE);
  for (const char* const digit : {"31", "32", "33"}) {
    device.node.ask("601#4026100200000000", std::string("581#4F261002") + digit + "000000");
  }
  CHECK(print(device.node, 2, "abcd") == CO_ERR_OBJ_SIZE);
  CHECK(print(device.node, 2, "abc") == CO_ERR_NONE);
  CHECK(print(device.node, 2, "") == CO_ERR_NONE);
  for (const char* const code : {"34", "35", "36", "37", "38", "61", "62", "63"}) {
    device.node.ask("601#4026100200000000", std::string("581#4F261002") + code + "000000");
  }
  device.node.ask("601#4026100200000000", "581#8026100224000008");
}

TEST_CASE("1026h: COOsPrint refuses wrong arguments and missing entries [O6]") {
  SdoPrompt device;
  const std::uint8_t text[] = {'a'};
  CHECK(COOsPrint(nullptr, 2, text, 1) == CO_ERR_BAD_ARG);
  CHECK(COOsPrint(&device.node.node, 2, nullptr, 1) == CO_ERR_BAD_ARG);
  CHECK(COOsPrint(&device.node.node, 1, text, 1) == CO_ERR_BAD_ARG);
  CHECK(COOsPrint(&device.node.node, 4, text, 1) == CO_ERR_BAD_ARG);
  CO_NODE fresh{};
  CHECK(COOsPrint(&fresh, 2, text, 1) == CO_ERR_BAD_ARG);
  Fixture without;
  CHECK(COOsPrint(&without.node, 2, text, 1) == CO_ERR_OBJ_NOT_FOUND);
  device.prompt.Out.Start = nullptr;
  CHECK(COOsPrint(&device.node.node, 2, text, 1) == CO_ERR_OBJ_SIZE);
  Fixture null(Setup().with({CO_KEY(0x1026, 2, CO_OBJ_____R_), CO_TOS_STDOUT, 0}));
  CHECK(COOsPrint(&null.node, 2, text, 1) == CO_ERR_OBJ_NOT_FOUND);
  null.ask("601#4026100200000000", "581#8026100220000008");
}

TEST_CASE("1026h: a reset empties the outputs [O6]") {
  for (const char* const reset : {"000#8101", "000#8201"}) {
    SdoPrompt device;
    CHECK(print(device.node, 2, "abc") == CO_ERR_NONE);
    device.node.rx(reset);
    device.node.trace();
    device.node.ask("601#4026100200000000", "581#8026100224000008");
  }
}

#if USE_DICT_CHECK
TEST_CASE("1026h: its types are accepted in their places only [O6]") {
  Prompt prompt;
  const CO_OBJ wrong[] = {{CO_KEY(0x1026, 2, CO_OBJ______W), CO_TOS_STDIN, &prompt.prompt},
                          {CO_KEY(0x1026, 1, CO_OBJ_____R_), CO_TOS_STDOUT, &prompt.prompt},
                          {CO_KEY(0x2000, 1, CO_OBJ______W), CO_TOS_STDIN, &prompt.prompt}};
  for (const CO_OBJ& entry : wrong) {
    Fixture node(Setup().with(entry).stay_in_init());
    CHECK(CODictGetFault(&node->Dict, nullptr) == CO_DICT_WRONG_PLACE);
  }
}
#endif

#if CO_RPDO_N > 0 && CO_TPDO_N > 1

struct PdoPrompt : Prompt {
  explicit PdoPrompt(std::uint16_t inhibit, std::uint8_t type = 255)
      : node(table(inhibit, type), [&](Setup& setup) { add_to(setup); }) {
    node.frames_per_call(4);
    node.start();
  }
  static PdoTable table(std::uint16_t inhibit, std::uint8_t type) {
    PdoTable table;
    table.rpdo[0].on(0x201, 255, {0x10260108});
    table.tpdo[0].on(0x40000181, type, {0x10260208});
    table.tpdo[0].inhibit = inhibit;
    table.tpdo[1].on(0x40000281, 255, {0x10260308});
    table.tpdo[1].inhibit = inhibit;
    return table;
  }
  PdoNode node;
};

TEST_CASE("1026h: an RPDO passes a character to StdIn [O6]") {
  PdoPrompt device(0);
  device.node.rx("201#61");
  device.node.rx("201#61");
  device.node.rx("201#62");
  CHECK(received == "aab");
}

TEST_CASE("1026h: event-driven TPDOs transmit one character in each inhibit time [O6]") {
  PdoPrompt device(100);  // 10 ms
  CHECK(print(device.node, 2, "abc") == CO_ERR_NONE);
  device.node.tx("181#61");
  CHECK(print(device.node, 3, "!") == CO_ERR_NONE);
  device.node.tx("281#21");
  device.node.after(10ms);
  device.node.tx("181#62");
  device.node.after(10ms);
  device.node.tx("181#63");
  device.node.after(1000ms);
  device.node.silent();
  CHECK(print(device.node, 2, "d") == CO_ERR_NONE);
  device.node.tx("181#64");
}

TEST_CASE("1026h: a TPDO without a character contains 0 [O6]") {
  PdoPrompt device(0);
  device.node.trigger(0);
  device.node.tx("181#00");
  CHECK(device.node.error() == CO_ERR_NONE);
}

TEST_CASE("1026h: text that arrives during the inhibit time follows in order [O6]") {
  PdoPrompt device(100);
  CHECK(print(device.node, 2, "ab") == CO_ERR_NONE);
  CHECK(print(device.node, 2, "cd") == CO_ERR_NONE);
  std::string all;
  for (unsigned n = 0; n < 20; ++n) {
    device.node.after(10ms);
    for (const std::string& line : device.node.frames()) all += line + " ";
  }
  CHECK(all == "181#61 181#62 181#63 181#64 ");
}

TEST_CASE("1026h: without an inhibit time a character is transmitted each millisecond [O6]") {
  PdoPrompt device(0);
  CHECK(print(device.node, 2, "abc") == CO_ERR_NONE);
  device.node.tx("181#61");
  CHECK(print(device.node, 2, "d") == CO_ERR_NONE);
  device.node.silent();
  for (const char* const next : {"181#62", "181#63", "181#64"}) {
    device.node.after(1ms);
    device.node.tx(next);
  }
  device.node.after(100ms);
  device.node.silent();
}

TEST_CASE("1026h: SDO and TPDO take each character once [O6]") {
  PdoPrompt device(0);
  CHECK(print(device.node, 2, "abc") == CO_ERR_NONE);
  device.node.tx("181#61");
  device.node.ask("601#4026100200000000", "581#4F26100262000000");
  device.node.after(1ms);
  device.node.tx("181#63");
  device.node.after(10ms);
  device.node.silent();
}

TEST_CASE("1026h: a reset or another initialisation during the output ends it [O6] [T14]") {
  for (const char* const reset : {"000#8101", "000#8201", ""}) {
    PdoPrompt device(0);
    CHECK(print(device.node, 2, "abc") == CO_ERR_NONE);
    device.node.tx("181#61");
    if (*reset != 0) {
      device.node.rx(reset);
    } else {
      device.node.init_again();
    }
    device.node.trace();
    device.node.rx("000#0101");
    device.node.after(100ms);
    device.node.silent();
  }
}

TEST_CASE("1026h: characters that wait for Operational are sent when it is entered [O6]") {
  PdoPrompt device(0);
  CHECK(print(device.node, 2, "ab") == CO_ERR_NONE);
  device.node.tx("181#61");
  device.node.rx("000#8001");
  device.node.after(10ms);
  CHECK(print(device.node, 2, "c") == CO_ERR_NONE);
  device.node.silent();
  device.node.rx("000#0101");
  for (const char* const next : {"181#62", "181#63"}) {
    device.node.after(1ms);
    device.node.tx(next);
  }
  device.node.after(100ms);
  device.node.silent();
}

// Returns the characters in the frames that TPDO 1 has sent.
std::string output(Fixture& node) {
  std::string all;
  for (const std::string& line : node.frames()) {
    if (line.compare(0, 4, "181#") == 0) all += static_cast<char>(std::stoi(line.substr(4), nullptr, 16));
  }
  return all;
}

TEST_CASE("1026h: text that is printed before its TPDO exists is sent once it does [O6]") {
  PdoPrompt device(0);
  device.node.rx("000#8001");
  CHECK(device.node.set(0x1800, 1, 4, 0xC0000181) == 0);
  CHECK(print(device.node, 2, "boot") == CO_ERR_NONE);
  device.node.after(100ms);
  device.node.silent();
  CHECK(device.node.set(0x1800, 1, 4, 0x40000181) == 0);
  device.node.rx("000#0101");
  device.node.after(20ms);
  CHECK(output(device.node) == "boot");
}

TEST_CASE("1026h: no character is lost on a bus that is full for a while, or that is left meanwhile [O6]") {
  for (const bool is_left : {false, true}) {
    PdoPrompt device(0);
    std::string printed;
    std::string sent;
    for (unsigned ms = 0; ms < 300; ++ms) {
      if (ms == 20) device.node.can.refuse_all();
      if (ms == 60 && is_left) device.node.rx("000#8001");
      if (ms == 120) device.node.can.accept_all();
      if (ms == 130 && is_left) device.node.rx("000#0101");
      const char next[] = {static_cast<char>('A' + ms % 26), 0};
      if (ms < 200 && print(device.node, 2, next) == CO_ERR_NONE) printed += next;
      device.node.after(1ms);
      sent += output(device.node);
    }
    CHECK(printed.size() > 80);
    CHECK(sent == printed);
  }
}

TEST_CASE("1026h: no character is lost while the transmit queue is full of other frames [O6]") {
  PdoPrompt device(0);
  device.node.can.refuse_all();
  for (unsigned n = 0; n < 40; ++n) {
    device.node.call([&] {
      CO_IF_FRM frm = {0x100, {}, 1};
      COIfCanSend(&device.node.node.If, &frm);
    });
  }
  CHECK(print(device.node, 2, "abc") == CO_ERR_NONE);
  device.node.trigger(0);
  device.node.can.accept_all();
  std::string sent;
  for (unsigned n = 0; n < 10; ++n) {
    device.node.after(1ms);
    sent += output(device.node);
  }
  sent.erase(std::remove(sent.begin(), sent.end(), 0), sent.end());
  CHECK(sent == "abc");
}

#endif

}  // namespace
