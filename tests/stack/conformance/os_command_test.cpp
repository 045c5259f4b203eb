// SPDX-License-Identifier: Apache-2.0
// 1023h, OS command, 1024h, its mode, and 1025h, debugger interface. [301:7.5.2.26, 7.5.2.27, 7.5.2.28]
#include <utility>

#include "support/fixture.hpp"

#if USE_OBJ_EX

namespace {

using namespace test;

Bytes text(const std::string& characters) { return Bytes(characters.begin(), characters.end()); }

/// A shell: "=…" replies with the rest, "!…" does the same and fails, "-" does not end, anything else ends without a
/// reply.
class Shell {
 public:
  explicit Shell(Setup setup = {}, std::uint16_t command_size = sizeof command_)
      : os(CO_OS_COMMAND CO_OS_COMMAND_OF(command_, reply_, execute, abort)), node(add_to(setup)) {
    os.CommandSize = command_size;
    shell() = this;
  }
  ~Shell() { shell() = nullptr; }
  Shell(const Shell&) = delete;
  Shell& operator=(const Shell&) = delete;

  std::uint32_t send(const std::string& command) { return node.download(0x1023, 1, text(command)); }
  std::uint32_t mode(std::uint8_t value) { return node.download(0x1024, 0, {value}); }
  unsigned status() { return node.upload(0x1023, 2).at(0); }
  Bytes reply() { return node.upload(0x1023, 3); }
  CO_ERR end(bool failed) {
    CO_ERR err = CO_ERR_NONE;
    node.call([&] { err = COOsEnd(&node.node, &os, failed); });
    return err;
  }
  /// Returns the commands that were executed, "^" for an abort, and forgets them.
  std::string log() { return std::exchange(log_, ""); }

 private:
  static Shell*& shell() {
    static Shell* present = nullptr;
    return present;
  }
  static void execute(CO_NODE* node, void*, CO_OS_COMMAND* os, const std::uint8_t* command, std::uint16_t length) {
    const OutsideStack outside;
    const std::string line(command, command + length);
    CHECK(os == &shell()->os);
    shell()->log_ += line + ";";
    if (line == "-") return;
    if (!line.empty() && (line[0] == '=' || line[0] == '!')) {
      const CO_ERR err = COOsReply(os, command + 1, static_cast<std::uint16_t>(length - 1U));
      CHECK((err == CO_ERR_NONE || err == CO_ERR_OBJ_SIZE));
    }
    CHECK(COOsEnd(node, os, !line.empty() && line[0] == '!') == CO_ERR_NONE);
  }
  static void abort(CO_NODE*, void*, CO_OS_COMMAND*) {
    const OutsideStack outside;
    shell()->log_ += "^";
  }
  Setup add_to(Setup& setup) {
    return setup.with({CO_KEY(0x1023, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, 3})
        .with({CO_KEY(0x1023, 1, CO_OBJ_____RW), CO_TOS_COMMAND, &os})
        .with({CO_KEY(0x1023, 2, CO_OBJ_____R_), CO_TOS_STATUS, &os})
        .with({CO_KEY(0x1023, 3, CO_OBJ_____R_), CO_TOS_REPLY, &os})
        .with({CO_KEY(0x1024, 0, CO_OBJ______W), CO_TOS_MODE, &os});
  }

  std::uint8_t command_[40] = {};
  std::uint8_t reply_[24] = {};
  std::string log_;

 public:
  CO_OS_COMMAND os;
  Fixture node;
};

TEST_CASE("1023h: an expedited command is executed and its reply is read [O4]") {
  Shell shell;
  shell.node.ask("601#2B2310013D680000", "581#6023100100000000");  // "=h"
  CHECK(shell.log() == "=h;");
  shell.node.ask("601#4023100200000000", "581#4F23100201000000");
  shell.node.ask("601#4023100300000000", "581#4F23100368000000");
}

TEST_CASE("1023h: the status is 0 to 3 for success and failure with and without a reply [O4]") {
  Shell shell;
  CHECK(shell.status() == 0);
  const std::pair<const char*, unsigned> all[] = {{"run", 0}, {"=yes", 1}, {"!", 2}, {"!no", 3}, {"", 0}};
  for (const auto& row : all) {
    CAPTURE(row.first);
    CHECK(shell.send(row.first) == 0);
    CHECK(shell.status() == row.second);
  }
  CHECK(shell.log() == "run;=yes;!;!no;;");
}

TEST_CASE("1023h: a command of several segments is executed once it is complete [O4]") {
  Shell shell;
  shell.node.ask("601#2123100109000000", "581#6023100100000000");
  shell.node.ask("601#003D696464646464", "581#2000000000000000");
  CHECK(shell.log().empty());
  shell.node.ask("601#1B64650000000000", "581#3000000000000000");
  CHECK(shell.log() == "=idddddde;");
  CHECK(shell.reply() == text("idddddde"));
}

#if USE_SDO_BLOCK
TEST_CASE("1023h: command and reply are transferred in blocks [O4]") {
  Shell shell;
  CHECK(shell.node.block_download(0x1023, 1, text("=by the block")).abort == 0);
  CHECK(shell.log() == "=by the block;");
  CHECK(shell.node.block_upload(0x1023, 3).data == text("by the block"));
  BlockOptions wrong;
  wrong.crc_error = 1;
  CHECK(shell.node.block_download(0x1023, 1, text("=wrong"), wrong).abort != 0);
  CHECK(shell.log().empty());
}
#endif

TEST_CASE("1023h: an aborted download executes nothing [O4]") {
  Shell shell;
  shell.node.ask("601#2123100109000000", "581#6023100100000000");
  shell.node.ask("601#003D696464646464", "581#2000000000000000");
  shell.node.rx("601#8023100100000008");
  shell.node.silent();
  CHECK(shell.log().empty());
  shell.node.ask("601#2123100109000000", "581#6023100100000000");
  shell.node.ask("601#003D696464646464", "581#2000000000000000");
  shell.node.after(shell.node.sdo_time_out());
  shell.node.trace();
  CHECK(shell.log().empty());
  CHECK(shell.send("=a") == 0);
  CHECK(shell.log() == "=a;");
}

TEST_CASE("1023h: the command that was written last is read back [O4]") {
  Shell shell;
  CHECK(shell.node.upload(0x1023, 1).empty());
  CHECK(shell.send("=remember") == 0);
  CHECK(shell.node.upload(0x1023, 1) == text("=remember"));
  CHECK(shell.mode(CO_OS_MODE_BUFFERED) == 0);
  CHECK(shell.send("one") == 0);
  CHECK(shell.send("two") == 0);
  CHECK(shell.node.upload(0x1023, 1) == text("two"));
}

TEST_CASE("1023h: after an aborted download the last complete command is read back [O4]") {
  for (const bool is_buffered : {false, true}) {
    Shell shell;
    CHECK(shell.mode(is_buffered ? CO_OS_MODE_BUFFERED : CO_OS_MODE_IMMEDIATE) == 0);
    CHECK(shell.send("=first") == 0);
    CHECK(shell.send("=last") == 0);
    for (const bool has_segment : {false, true}) {
      shell.node.ask("601#2123100109000000", "581#6023100100000000");
      if (has_segment) shell.node.ask("601#003D696464646464", "581#2000000000000000");
      shell.node.rx("601#8023100100000008");
      CHECK(shell.node.upload(0x1023, 1) == text("=last"));
    }
    CHECK(shell.send("=next") == 0);
    CHECK(shell.node.upload(0x1023, 1) == text("=next"));
    if (is_buffered) CHECK(shell.mode(CO_OS_MODE_EXECUTE) == 0);
    CHECK(shell.log() == "=first;=last;=next;");
    CHECK(shell.node.upload(0x1023, 1) == text("=next"));
  }
}

TEST_CASE("1023h: a command that needs the memory of the last one replaces it [O4]") {
  Shell shell;
  CHECK(shell.send("=0123456789abcdef") == 0);
  const std::string longest = "=" + std::string(37, 'x');
  shell.node.ask("601#2123100126000000", "581#6023100100000000");
  for (unsigned n = 0; n < 4; ++n) {
    shell.node.ask(n % 2 == 0 ? "601#0078787878787878" : "601#1078787878787878",
                   n % 2 == 0 ? "581#2000000000000000" : "581#3000000000000000");
  }
  shell.node.rx("601#8023100100000008");
  CHECK(shell.node.upload(0x1023, 1).empty());
  CHECK(shell.send(longest) == 0);
  CHECK(shell.node.upload(0x1023, 1) == text(longest));
  CHECK(shell.log() == "=0123456789abcdef;" + longest + ";");
}

TEST_CASE("1023h: a command of 0 bytes is executed as such [O4]") {
  Shell shell;
  CHECK(shell.send("=abc") == 0);
  CHECK(shell.send("") == 0);
  CHECK(shell.log() == "=abc;;");
  CHECK(shell.node.upload(0x1023, 1).empty());
}

TEST_CASE("1023h: a command that takes longer has status 255 until COOsEnd [O4]") {
  Shell shell;
  CHECK(shell.send("=old") == 0);
  CHECK(shell.send("-") == 0);
  CHECK(shell.status() == 0xFF);
  shell.node.ask("601#4023100300000000", "581#8023100322000008");
  const std::uint8_t part[] = {'d', 'o', 'n', 'e'};
  CHECK(COOsReply(&shell.os, part, 2) == CO_ERR_NONE);
  CHECK(COOsReply(&shell.os, part + 2, 2) == CO_ERR_NONE);
  CHECK(shell.status() == 0xFF);
  CHECK(shell.end(false) == CO_ERR_NONE);
  CHECK(shell.status() == 1);
  CHECK(shell.reply() == text("done"));
}

TEST_CASE("1023h: a command during the execution of another one is refused [O4]") {
  Shell shell;
  CHECK(shell.send("-") == 0);
  shell.node.ask("601#2F23100161000000", "581#8023100122000008");
  shell.node.ask("601#2123100109000000", "581#8023100122000008");
#if USE_SDO_BLOCK
  shell.node.ask("601#C223100109000000", "581#8023100122000008");
#endif
  CHECK(shell.mode(CO_OS_MODE_EXECUTE) == CO_SDO_ERR_TOS_STATE);
  CHECK(shell.log() == "-;");
  CHECK(shell.end(true) == CO_ERR_NONE);
  CHECK(shell.status() == 2);
  CHECK(shell.send("next") == 0);
  CHECK(shell.log() == "next;");
}

TEST_CASE("1023h: without a reply there is no data and status and reply cannot be written [O4]") {
  Shell shell;
  shell.node.ask("601#4023100300000000", "581#8023100324000008");
  shell.node.ask("601#2F23100201000000", "581#8023100202000106");
  shell.node.ask("601#2F23100301000000", "581#8023100302000106");
}

TEST_CASE("1023h: a command is at most two bytes shorter than its memory [O4]") {
  Shell shell(Setup(), 12);
  CHECK(shell.send("=123456789") == 0);
  CHECK(shell.reply() == text("123456789"));
  CHECK(shell.send("=123456789a") == CO_SDO_ERR_LEN_HIGH);
  CHECK(shell.node.download(0x1023, 1, text("=123456789a"), false) == CO_SDO_ERR_LEN_HIGH);
  CHECK(shell.log() == "=123456789;");
}

TEST_CASE("1023h: a reply that does not fit is not shortened [O4]") {
  Shell shell;
  CHECK(shell.send("=123456789012345678901234") == 0);
  CHECK(shell.reply().size() == 24);
  CHECK(shell.send("=1234567890123456789012345") == 0);
  CHECK(shell.status() == 0);
}

TEST_CASE("1024h: stored commands are executed in their order and once [O5]") {
  Shell shell;
  CHECK(shell.mode(CO_OS_MODE_BUFFERED) == 0);
  CHECK(shell.send("=a") == 0);
  CHECK(shell.send("b") == 0);
  CHECK(shell.send("=c") == 0);
  CHECK(shell.log().empty());
  CHECK(shell.status() == 0);
  CHECK(shell.mode(CO_OS_MODE_EXECUTE) == 0);
  CHECK(shell.log() == "=a;b;=c;");
  CHECK(shell.status() == 1);
  CHECK(shell.reply() == text("ac"));
  CHECK(shell.mode(CO_OS_MODE_EXECUTE) == 0);
  CHECK(shell.log().empty());
  CHECK(shell.status() == 0);
  CHECK(shell.send("d") == 0);
  CHECK(shell.log().empty());
  CHECK(shell.mode(CO_OS_MODE_IMMEDIATE) == 0);
  CHECK(shell.send("e") == 0);
  CHECK(shell.log() == "e;");
  CHECK(shell.mode(CO_OS_MODE_EXECUTE) == 0);
  CHECK(shell.log() == "d;");
}

TEST_CASE("1024h: the first stored command that fails ends the execution [O5]") {
  Shell shell;
  CHECK(shell.mode(CO_OS_MODE_BUFFERED) == 0);
  for (const char* const command : {"=a", "!b", "=c"}) CHECK(shell.send(command) == 0);
  CHECK(shell.mode(CO_OS_MODE_EXECUTE) == 0);
  CHECK(shell.log() == "=a;!b;");
  CHECK(shell.status() == 3);
  CHECK(shell.reply() == text("ab"));
  CHECK(shell.mode(CO_OS_MODE_EXECUTE) == 0);
  CHECK(shell.log().empty());
}

TEST_CASE("1024h: stored commands that take longer are executed one after the other [O5]") {
  Shell shell;
  CHECK(shell.mode(CO_OS_MODE_BUFFERED) == 0);
  for (const char* const command : {"-", "=x", "-", "-"}) CHECK(shell.send(command) == 0);
  CHECK(shell.mode(CO_OS_MODE_EXECUTE) == 0);
  CHECK(shell.log() == "-;");
  CHECK(shell.end(false) == CO_ERR_NONE);
  CHECK(shell.log() == "=x;-;");
  CHECK(shell.status() == 0xFF);
  CHECK(shell.end(false) == CO_ERR_NONE);
  CHECK(shell.log() == "-;");
  CHECK(shell.end(true) == CO_ERR_NONE);
  CHECK(shell.log().empty());
  CHECK(shell.status() == 3);
  CHECK(shell.end(false) == CO_ERR_OBJ_STATE);
}

TEST_CASE("1024h: an abort ends the command and removes the stored ones [O5]") {
  Shell shell;
  CHECK(shell.mode(CO_OS_MODE_BUFFERED) == 0);
  CHECK(shell.send("-") == 0);
  CHECK(shell.send("b") == 0);
  CHECK(shell.mode(CO_OS_MODE_EXECUTE) == 0);
  CHECK(shell.mode(CO_OS_MODE_ABORT) == 0);
  CHECK(shell.log() == "-;^");
  CHECK(shell.status() == 2);
  CHECK(shell.end(false) == CO_ERR_OBJ_STATE);
  CHECK(COOsReply(&shell.os, text("x").data(), 1) == CO_ERR_OBJ_STATE);
  CHECK(shell.mode(CO_OS_MODE_EXECUTE) == 0);
  CHECK(shell.log().empty());
  CHECK(shell.mode(CO_OS_MODE_ABORT) == 0);
  CHECK(shell.log().empty());
  CHECK(shell.mode(CO_OS_MODE_IMMEDIATE) == 0);
  CHECK(shell.send("c") == 0);
  CHECK(shell.log() == "c;");
}

TEST_CASE("1024h: every other value is refused and the mode cannot be read [O5]") {
  Shell shell(Setup().only_small());
  for (unsigned value = 4; value < 256; ++value) {
    CAPTURE(value);
    CHECK(shell.mode(static_cast<std::uint8_t>(value)) == CO_SDO_ERR_RANGE);
  }
  shell.node.ask("601#4024100000000000", "581#8024100001000106");
  shell.node.ask("601#2B24100001000000", "581#8024100012000706");
}

TEST_CASE("1024h: stored commands that fill the memory leave no space and lose nothing [O5]") {
  Shell shell(Setup(), 12);
  CHECK(shell.mode(CO_OS_MODE_BUFFERED) == 0);
  CHECK(shell.send("1234") == 0);
  CHECK(shell.send("12345") == CO_SDO_ERR_LEN_HIGH);
  CHECK(shell.send("5678") == 0);
  CHECK(shell.send("9") == CO_SDO_ERR_LEN_HIGH);
  CHECK(shell.send("") != 0);
  CHECK(shell.mode(CO_OS_MODE_EXECUTE) == 0);
  CHECK(shell.log() == "1234;5678;");
}

#if CO_SSDO_N > 1
TEST_CASE("1024h: an execution during a download of another client ends the download [O5]") {
  Shell shell(Setup().before_init([](Objects& objects) {
    objects.sdo2_rx = 0x690;
    objects.sdo2_tx = 0x6A0;
  }));
  CHECK(shell.mode(CO_OS_MODE_BUFFERED) == 0);
  CHECK(shell.send("a") == 0);
  shell.node.ask("601#2123100109000000", "581#6023100100000000");
  shell.node.ask("601#003D696464646464", "581#2000000000000000");
  shell.node.ask("690#2F24100002000000", "6A0#6024100000000000");
  CHECK(shell.log() == "a;");
  shell.node.ask("601#1B64650000000000", "581#8023100122000008");
  CHECK(shell.log().empty());
}
#endif

TEST_CASE("1023h: a reset aborts the command and removes the stored ones [O4] [T14]") {
  for (const char* const reset : {"000#8101", "000#8201"}) {
    Shell shell;
    CHECK(shell.mode(CO_OS_MODE_BUFFERED) == 0);
    CHECK(shell.send("-") == 0);
    CHECK(shell.send("b") == 0);
    CHECK(shell.mode(CO_OS_MODE_EXECUTE) == 0);
    shell.node.rx(reset);
    shell.node.trace();
    CHECK(shell.log() == "-;^");
    CHECK(shell.status() == 0);
    CHECK(shell.node.upload(0x1023, 1).empty());
    CHECK(shell.send("c") == 0);
    CHECK(shell.log() == "c;");
  }
}

TEST_CASE("1023h: without a function every command fails [O4]") {
  Shell shell;
  shell.os.Execute = nullptr;
  CHECK(shell.send("a") == 0);
  CHECK(shell.status() == 2);
  shell.os.Execute = [](CO_NODE*, void*, CO_OS_COMMAND*, const std::uint8_t*, std::uint16_t) {};
  shell.os.Abort = nullptr;
  CHECK(shell.send("a") == 0);
  CHECK(shell.mode(CO_OS_MODE_ABORT) == 0);
  CHECK(shell.status() == 2);
}

TEST_CASE("1023h: without memory every command is refused [O4]") {
  Shell shell;
  shell.os.Command = nullptr;
  CHECK(shell.send("a") == CO_SDO_ERR_LEN_HIGH);
  CHECK(shell.send("") != 0);
  CHECK(shell.log().empty());
  shell.os.Reply = nullptr;
  CHECK(COOsReply(nullptr, nullptr, 0) == CO_ERR_BAD_ARG);
  CHECK(COOsEnd(&shell.node.node, nullptr, false) == CO_ERR_BAD_ARG);
  CHECK(COOsEnd(nullptr, &shell.os, false) == CO_ERR_BAD_ARG);
}

TEST_CASE("1023h: without data every transfer is refused [O4]") {
  Fixture node(Setup()
                   .with({CO_KEY(0x1023, 1, CO_OBJ_____RW), CO_TOS_COMMAND, 0})
                   .with({CO_KEY(0x1023, 2, CO_OBJ_____R_), CO_TOS_STATUS, 0})
                   .with({CO_KEY(0x1023, 3, CO_OBJ_____R_), CO_TOS_REPLY, 0})
                   .with({CO_KEY(0x1024, 0, CO_OBJ______W), CO_TOS_MODE, 0}));
  node.ask("601#4023100100000000", "581#8023100120000008");
  node.ask("601#2F23100161000000", "581#8023100120000008");
  node.ask("601#2123100109000000", "581#8023100112000706");
  node.ask("601#4023100200000000", "581#8023100220000008");
  node.ask("601#4023100300000000", "581#8023100320000008");
  node.ask("601#2F24100001000000", "581#8024100020000008");
}

TEST_CASE("1025h: the debugger interface works like 1023h and is separate from it [O4]") {
  CO_OS_COMMAND debugger{};
  std::uint8_t command[8] = {};
  std::uint8_t reply[8] = {};
  debugger.Command = command;
  debugger.CommandSize = sizeof command;
  debugger.Reply = reply;
  debugger.ReplySize = sizeof reply;
  debugger.Execute = [](CO_NODE* node, void*, CO_OS_COMMAND* os, const std::uint8_t*, std::uint16_t length) {
    const auto answer = static_cast<std::uint8_t>(length);
    CHECK(COOsReply(os, &answer, 1) == CO_ERR_NONE);
    CHECK(COOsEnd(node, os, false) == CO_ERR_NONE);
  };
  Shell shell(Setup()
                  .with({CO_KEY(0x1025, 1, CO_OBJ_____RW), CO_TOS_COMMAND, &debugger})
                  .with({CO_KEY(0x1025, 2, CO_OBJ_____R_), CO_TOS_STATUS, &debugger})
                  .with({CO_KEY(0x1025, 3, CO_OBJ_____R_), CO_TOS_REPLY, &debugger}));
  CHECK(shell.send("-") == 0);
  shell.node.ask("601#2B25100162700000", "581#6025100100000000");
  shell.node.ask("601#4025100200000000", "581#4F25100201000000");
  shell.node.ask("601#4025100300000000", "581#4F25100302000000");
  CHECK(shell.status() == 0xFF);
}

TEST_CASE("1023h: random requests never execute a command that was not sent [O4]") {
  Shell shell(Setup().only_small(), 20);
  std::uint32_t seed = 1;
  const auto random = [&](std::uint32_t below) {
    seed = seed * 1664525U + 1013904223U;
    return (seed >> 16U) % below;
  };
  for (unsigned n = 0; n < 3000; ++n) {
    switch (random(6)) {
      case 0: shell.node.rx("601#2123100109000000"); break;
      case 1: shell.node.rx("601#0061626364656667"); break;
      case 2: shell.node.rx("601#1B68690000000000"); break;
      case 3: shell.node.rx("601#2F23100161000000"); break;
      case 4: shell.node.rx("601#8023100100000008"); break;
      default: (void)shell.mode(static_cast<std::uint8_t>(random(5))); break;
    }
    shell.node.trace();
  }
  std::string all = shell.log();
  for (std::size_t end = all.find(';'); end != std::string::npos; end = all.find(';')) {
    const std::string command = all.substr(0, end);
    CHECK((command == "a" || command == "abcdefghi"));
    all.erase(0, end + 1);
  }
}

#if USE_DICT_CHECK
TEST_CASE("1023h: its types are accepted in their places only [O4] [O5]") {
  CO_OS_COMMAND os{};
  const CO_OBJ wrong[] = {{CO_KEY(0x1023, 2, CO_OBJ_____RW), CO_TOS_COMMAND, &os},
                          {CO_KEY(0x1023, 1, CO_OBJ_____R_), CO_TOS_STATUS, &os},
                          {CO_KEY(0x1025, 2, CO_OBJ_____R_), CO_TOS_REPLY, &os},
                          {CO_KEY(0x1023, 0, CO_OBJ______W), CO_TOS_MODE, &os},
                          {CO_KEY(0x2000, 1, CO_OBJ_____RW), CO_TOS_COMMAND, &os}};
  for (const CO_OBJ& entry : wrong) {
    Fixture node(Setup().with(entry).stay_in_init());
    CHECK(CODictGetFault(&node->Dict, nullptr) == CO_DICT_WRONG_PLACE);
  }
}
#endif

}  // namespace

#endif
