// SPDX-License-Identifier: Apache-2.0
// lexican pdo from outside. The device sends TPDO1 when its temperature (2001h) is written.
#include <doctest/doctest.h>

#include <atomic>
#include <map>
#include <optional>
#include <set>
#include <thread>

#include "bus/open.hpp"
#include "program_bench.hpp"

using namespace test;

namespace {

const std::string first_two =
    "RPDO1  205h, event-driven (255)\n"
    "  2000h Output, 8 bits\n"
    "TPDO1  185h, event-driven (255)\n"
    "  2001h Temperature, 16 bits\n"
    "  2002h Position, 32 bits\n";
const std::string third_off = "TPDO2  285h off, event-driven (255)\n  maps nothing\n";
const std::string third =
    "TPDO2  285h, event-driven (255)\n"
    "  2002h Position, 32 bits\n"
    "  2001h Temperature, 16 bits\n";

/// An operational device with its description.
struct PdoBench : Bench {
  PdoBench() : Bench{5} {
    CHECK(run("write", {"5", "1017", "50"}).status == 0);
    CHECK(run("nmt", {"start", "5"}).status == 0);
  }
  Ran pdo(Words words) const {
    words.insert(words.end(), {"--eds", eds, "--timeout", "60000"});
    return run("pdo", words);
  }
  /// Starts watch, and writes temperatures as soon as it has read the PDOs.
  Ran watch(Words words, const Words& temperatures) const {
    words.insert(words.begin(), {"watch", "5"});
    words.insert(words.end(), {"--eds", eds, "--timeout", "60000"});
    Process mon(line("mon", {"-n", "5"}), environment());
    mon.wait_for("heartbeat");
    Process process(line("pdo", words), environment());
    mon.wait_for("read 1A01h:00");
    for (const std::string& temperature : temperatures) {
      CHECK(run("write", {"5", "2001", temperature, "--type", "i16"}).status == 0);
      CHECK(run("read", {"5", "2001"}).status == 0);
    }
    mon.wait_for("2001h:00 = 001Eh");  // the last one
    process.send(SIGINT);
    Ran ran = process.finish();
    ran.out = std::regex_replace(without_times(ran.out), std::regex("\n +[0-9]+\\.[0-9]{3}  |^ +[0-9.]+  "), "\nT  ");
    return ran;
  }
};

TEST_CASE("lexican pdo show: the PDOs of a device, with and without a description") {
  Bench bench{5};
  check(bench.run("pdo", {"show", "5", "--eds", eds}), 0, first_two + third_off, "");
  const Ran unnamed = bench.run("pdo", {"show", "-n", "5", "tpdo1"});
  check(unnamed, 0, "TPDO1  185h, event-driven (255)\n  2001h:00, 16 bits\n  2002h:00, 32 bits\n", "");
  CHECK(lines_of(bench.run("pdo", {"show", "5"}).out).size() == 7);
  const Ran json = bench.run("pdo", {"show", "5", "TPDO1", "RPDO1", "--eds", eds, "--json"});
  CHECK(fault_of(json.out, "pdo") == "");
  CHECK(Json::parse(lines_of(json.out).front())["mapped"][0]["object"] == "2001h Temperature");
  check(bench.run("pdo", {"show", "5", "tpdo9"}), 1, "", "lexican: node 5 has no TPDO9\n");
  for (const char* word : {"tpdo0", "tpdo513", "tpdo", "xpdo1", "2001", "tpdo1x"}) {
    CHECK(bench.run("pdo", {"show", "5", word}).status == 2);
  }
  CHECK(bench.run("pdo", {"show"}).status == 2);
  CHECK(bench.run("pdo", {"show", "128"}).status == 2);
  CHECK(bench.run("pdo", {"show", "7", "--timeout", "50"}).status == 3);
}

TEST_CASE("lexican pdo map: a PDO is off while its mapping changes") {
  PdoBench bench;
  Process mon(bench.line("mon", {}), bench.environment());
  mon.wait_for("heartbeat");
  check(bench.pdo({"map", "5", "tpdo2", "position", "temperature"}), 0, third, "");
  mon.wait_for("write 1801h:01 TPDO communication parameter = 40000285h");
  check(bench.pdo({"map", "5", "tpdo2", "2001", "--cob-id", "2a5", "--type", "1"}), 0,
        "TPDO2  2A5h, every SYNC (1)\n  2001h Temperature, 16 bits\n", "");
  mon.wait_for("write 1801h:01 TPDO communication parameter = 400002A5h");
  std::string writes;
  for (const std::string& event : lines_of(mon.out())) {
    const std::size_t begin = event.find("write ");
    if (begin != std::string::npos) {
      const std::size_t value = event.find(" = ");
      writes += event.substr(begin + 6, 9) + event.substr(value, event.find("  ", value) - value) + '\n';
    }
  }
  CHECK(writes ==
        "1A01h:00  = 0\n1A01h:01  = 20020020h\n1A01h:02  = 20010010h\n1A01h:00  = 2\n1801h:01  = 40000285h\n"
        "1801h:01  = C0000285h\n1801h:02  = 1\n1A01h:00  = 0\n1A01h:01  = 20010010h\n1A01h:00  = 1\n"
        "1801h:01  = 400002A5h\n");
  check(bench.pdo({"map", "5", "tpdo2", "--off"}), 0, "TPDO2  2A5h off, every SYNC (1)\n  2001h Temperature, 16 bits\n",
        "");
  CHECK(has(bench.pdo({"map", "5", "tpdo2", "5"}).err, "the value that it has refused is 00050008h"));  // no dummies
  const Ran json = bench.pdo({"map", "5", "tpdo2", "2001", "--json"});
  CHECK(fault_of(json.out, "pdo") == "");
}

TEST_CASE("lexican pdo map: a mapping that the device refuses is undone") {
  PdoBench bench;
  CHECK(bench.pdo({"map", "5", "tpdo2", "position", "temperature"}).status == 0);
  const Ran ran = bench.pdo({"map", "5", "tpdo2", "temperature", "temperature offset"});
  check(ran, 1, "",
        "lexican: node 5, 1A01h:02 Second TPDO mapping parameter, Second object: aborted with 0604 0041h object cannot "
        "be mapped to a PDO; the description (PDOMapping) or the manual says which objects can be mapped, and in which "
        "direction\n"
        "lexican: the value that it has refused is 20030020h\n"
        "lexican: TPDO2 is as it was before\n");
  check(bench.pdo({"show", "5", "tpdo2"}), 0, third, "");
  const Ran fixed = bench.pdo({"map", "5", "tpdo1", "temperature"});
  CHECK(fixed.status == 1);
  CHECK(has(fixed.err, "1800h:01 TPDO communication parameter, COB-ID: aborted with 0601 0002h"));
  CHECK(!has(fixed.err, "before"));  // nothing was written
  const Ran timer = bench.pdo({"map", "5", "tpdo2", "--event", "100"});
  CHECK(timer.status == 1);
  CHECK(has(timer.err, "lexican: TPDO2 is as it was before\n"));
  check(bench.pdo({"show", "5", "tpdo2"}), 0, third, "");
}

TEST_CASE("lexican pdo map: wrong use, before anything is written") {
  PdoBench bench;
  const std::pair<Words, const char*> wrong[] = {
      {{"map", "5"}, "which PDO?"},
      {{"map", "5", "2001"}, "which PDO?"},
      {{"map", "5", "tpdo2", "label"}, "the length of 2005h Label is unknown; give it in bits, such as label/16"},
      {{"map", "5", "tpdo2", "2001/65"}, "no object is called '2001/65'"},
      {{"map", "5", "tpdo2", "2002", "2002", "2001"}, "the objects have 80 bits, and a PDO has 64"},
      {{"map", "5", "tpdo2", "--type", "256"}, "--type '256' is no number from 0 to 255"},
      {{"map", "5", "tpdo2", "--inhibit", "6553.6"}, "--inhibit '6553.6' is no number from 0 to 6553.5"},
      {{"map", "5", "tpdo2", "--event", "1s"}, "--event '1s' is no number"},
      {{"map", "5", "tpdo2", "--cob-id", "20000000"}, "--cob-id '20000000' is no CAN identifier"},
      {{"map", "5", "tpdo2", "--cob-id", "0"}, "--cob-id '0' is no CAN identifier"},
  };
  for (const auto& [words, message] : wrong) {
    const Ran ran = bench.pdo(words);
    CHECK(ran.status == 2);
    CHECK_MESSAGE(has(ran.err, message), ran.err);
  }
  check(bench.pdo({"show", "5"}), 0, first_two + third_off, "");
}

TEST_CASE("lexican pdo watch: a line for each PDO with a change, and a summary") {
  PdoBench bench;
  const Ran ran = bench.watch({}, {"-20", "15", "15", "30"});
  CHECK(ran.err == "");
  CHECK(ran.status == 0);
  CHECK(ran.out ==
        "\nT  TPDO1  Temperature = -20, Position = 1000\nT  TPDO1  Temperature = 15, Position = 1000\n"
        "T  TPDO1  Temperature = 30, Position = 1000\n\n3 PDOs in T s\n  Output       no value\n"
        "  Temperature  30, -20 to 30\n  Position     1000, 1000 to 1000\n");
  const std::string csv = bench.directory / "values.csv";
  const std::string svg = bench.directory / "values.svg";
  const Ran files = bench.watch({"temperature", "--csv", csv, "--svg", svg}, {"-20", "30"});
  CHECK(files.status == 0);
  CHECK(std::regex_replace(bytes_of(csv), std::regex("\n[0-9.]+,"), "\nT,") == "time,Temperature\nT,-20\nT,30\n");
  CHECK(has(bytes_of(svg), ">Temperature</text>"));
  const Ran table = bench.watch({"tpdo1", "--csv", "-"}, {"-20", "30"});
  CHECK(std::regex_replace(table.out, std::regex("\n[0-9.]+,"), "\nT,") ==
        "time,Temperature,Position\nT,-20,1000\nT,30,1000\n");
  const Ran json = bench.watch({"temperature", "--json"}, {"-20", "30"});
  CHECK(fault_of(json.out, "pdo") == "");
  CHECK(Json::parse(lines_of(json.out).front())["values"][0]["value"] == -20);
  const Ran plot = bench.watch({"temperature", "--plot"}, {"-20", "30"});
  CHECK(has(plot.out, "Temperature = 30  (-20 to 30)\n"));
  CHECK(has(plot.out, "⣀"));
}

TEST_CASE("lexican pdo watch: nothing to watch") {
  PdoBench bench;
  check(bench.pdo({"watch", "5", "offset"}), 1, "",
        "lexican: 2003h Temperature offset is in no PDO of node 5 that is on; lexican pdo show 5 has all\n");
  CHECK(has(bench.pdo({"watch", "5", "tpdo2"}).err, "node 5 has no TPDO2 that is on"));
  CHECK(bench.pdo({"watch", "5", "no such object"}).status == 2);
  CHECK(bench.pdo({"watch", "5", "--json", "--plot"}).status == 2);
  CHECK(bench.pdo({"watch", "5", "--csv", "/nonexistent/values.csv"}).status == 2);
  check(bench.pdo({"watch", "5", "--for", "1"}), 3, "", "lexican: no PDO of node 5 with these values was sent\n");
}

TEST_CASE("lexican pdo watch: the values of a log") {
  PdoBench bench;
  const std::string log = bench.directory / "values.log";
  write_bytes(log,
              "(10.0) can0 185#E8FF01000000\n(10.5) can0 205#07\n(10.6) can0 185#05\n(11.0) can0 186#0000\n"
              "(12.0) can0 185#1E0002000000\n");
  const Ran ran = bench.pdo({"watch", "5", "-i", "replay:" + log, "--csv", "-"});
  check(ran, 0, "time,Output,Temperature,Position\n0.000000,,-24,1\n0.500000,7,,\n2.000000,,30,2\n", "");
  check(bench.pdo({"watch", "5", "position", "-i", "replay:" + log}), 0,
        "    0.000  TPDO1  Position = 1\n    2.000  TPDO1  Position = 2\n\n2 PDOs in 2.000 s\n  Position  2, 1 to 2\n",
        "");
}

TEST_CASE("lexican pdo send: values by name; the other objects keep theirs") {
  PdoBench bench;
  check(bench.pdo({"send", "5", "output=7"}), 0, "RPDO1 (205h) Output = 7\n", "");
  check(bench.run("read", {"5", "2000", "--type", "u8"}), 0, "2000h:00 = 7 (u8)\n", "");
  const Ran json = bench.pdo({"send", "5", "rpdo1", "2000=8", "--json", "--sync"});
  CHECK(fault_of(json.out, "pdo") == "");
  const std::pair<Words, const char*> wrong[] = {
      {{"send", "5"}, "give the values"},
      {{"send", "5", "output"}, "'output' is not OBJECT=VALUE"},
      {{"send", "5", "=7"}, "'=7' is not OBJECT=VALUE"},
      {{"send", "5", "output=256"}, "2000h Output: "},
      {{"send", "5", "output=x"}, "2000h Output: "},
      {{"send", "5", "tpdo1", "output=1"}, "TPDO1 is sent by the device"},
  };
  for (const auto& [words, message] : wrong) {
    const Ran ran = bench.pdo(words);
    CHECK(ran.status == 2);
    CHECK_MESSAGE(has(ran.err, message), ran.err);
  }
  check(bench.pdo({"send", "5", "temperature=1"}), 1, "",
        "lexican: no RPDO of node 5 that is on maps 2001h Temperature; lexican pdo map 5 rpdo1 ... changes one\n");
  CHECK(has(bench.pdo({"send", "5", "rpdo1", "temperature=1"}).err, "RPDO1 does not map all of these objects"));
  CHECK(bench.pdo({"send", "5", "rpdo2", "temperature=1"}).status == 1);
  Process repeated(bench.line("pdo", {"send", "5", "output=9", "--every", "5", "--eds", eds}), bench.environment());
  repeated.wait_for("RPDO1");
  Process mon(bench.line("mon", {}), bench.environment());
  mon.wait_for("RPDO1");
  repeated.send(SIGINT);
  CHECK(has(repeated.finish().out, " times\n"));
}

/// An SDO server as node 7 with faults: it has objects of at most 4 bytes, and answers expedited transfers.
class FaultyServer {
 public:
  struct Object {
    std::uint32_t value;
    std::uint8_t bytes;
  };
  using Key = std::uint32_t;  // index and sub-index, 180001h

  explicit FaultyServer(const Bench& bench) {
    setenv("XDG_RUNTIME_DIR", bench.directory.path().c_str(), 1);
    std::string why;
    bus_ = lexican::host_bus::open_bus(bench.hub(), {}, why);
    REQUIRE_MESSAGE(bus_ != nullptr, why);
  }
  ~FaultyServer() { stop(); }
  FaultyServer(const FaultyServer&) = delete;
  FaultyServer& operator=(const FaultyServer&) = delete;

  void start() {
    thread_ = std::thread([this] {
      while (!has_ended_) {
        pollfd wanted = bus_->wanted();
        poll(&wanted, 1, 10);
        while (const auto entry = bus_->receive()) {
          if (entry->frame.Identifier == 0x607 && entry->frame.DLC == 8) {
            answer(entry->frame);
          }
        }
      }
    });
  }
  void stop() {
    has_ended_ = true;
    if (thread_.joinable()) {
      thread_.join();
    }
  }

  std::map<Key, Object> objects;
  std::set<Key> refuses;            ///< to be written
  std::optional<CO_IF_FRM> pdo;     ///< sent before each answer
  unsigned silent_from = 1000;      ///< the answer to this write, and all that follow, are lost
  std::vector<std::string> writes;  ///< "180001=80000187"

 private:
  void answer(const CO_IF_FRM& request) {
    const Key key = static_cast<Key>(request.Data[2]) << 16 | static_cast<Key>(request.Data[1]) << 8 | request.Data[3];
    const bool is_write = (request.Data[0] & 0xE0U) == 0x20;
    CO_IF_FRM frame{0x587, {0, request.Data[1], request.Data[2], request.Data[3]}, 8};
    const auto found = objects.find(key);
    const std::uint32_t abort = found == objects.end()                ? 0x06020000U
                                : is_write && refuses.count(key) != 0 ? 0x08000022U
                                                                      : 0U;
    std::uint32_t value = 0;
    std::memcpy(&value, request.Data + 4, sizeof value);
    if (request.Data[0] == 0x80) {
      return;
    }
    if (is_write) {
      char text[32];
      std::snprintf(text, sizeof text, "%06X=%X%s", key, value, abort != 0 ? "!" : "");
      writes.emplace_back(text);
    }
    if (abort != 0) {
      frame.Data[0] = 0x80;
      value = abort;
    } else if (is_write) {
      frame.Data[0] = 0x60;
      found->second.value = value;
      value = 0;
    } else {
      frame.Data[0] = static_cast<std::uint8_t>(0x43U | (4U - found->second.bytes) << 2);
      value = found->second.value;
    }
    std::memcpy(frame.Data + 4, &value, sizeof value);
    if (pdo) {
      bus_->send(*pdo);
    }
    if (writes.size() < silent_from) {
      bus_->send(frame);
    }
  }

  std::unique_ptr<lexican::host_bus::Bus> bus_;
  std::atomic<bool> has_ended_{false};
  std::thread thread_;
};

/// TPDO1 that maps one object.
std::map<FaultyServer::Key, FaultyServer::Object> first_tpdo() {
  return {{0x101801, {1, 4}},   {0x101802, {2, 4}}, {0x101803, {3, 4}},         {0x180001, {0x187, 4}},
          {0x180002, {255, 1}}, {0x1A0000, {1, 1}}, {0x1A0001, {0x20010010, 4}}};
}

TEST_CASE("lexican pdo watch: PDOs that arrive before the mapping is read have the mapping of the device") {
  Bench bench;
  FaultyServer server(bench);
  server.objects = first_tpdo();
  server.objects[0x101801] = {0x100, 4};
  server.objects[0x101802] = {0x402, 4};
  server.objects[0x1A0000] = {2, 1};
  server.objects[0x1A0001] = {0x20020020, 4};  // the description has the temperature first
  server.objects[0x1A0002] = {0x20010010, 4};
  server.pdo = CO_IF_FRM{0x187, {7, 0, 0, 0, 30, 0}, 6};
  server.start();
  const Ran ran = bench.run("pdo", {"watch", "7", "--for", "1", "--csv", "-", "--eds", eds});
  server.stop();
  const std::vector<std::string> lines = lines_of(ran.out);
  REQUIRE(lines.size() > 2);
  CHECK(lines.front() == "time,Position,Temperature");
  CHECK(std::all_of(lines.begin() + 1, lines.end(),
                    [](const std::string& row) { return row.substr(row.find(',')) == ",7,30"; }));
  CHECK(ran.status == 0);
}

TEST_CASE("lexican pdo map: only what was written is restored") {
  Bench bench;
  FaultyServer server(bench);
  server.objects = first_tpdo();
  server.objects[0x1A0000] = {0xFE, 1};  // multiplexed
  server.refuses = {0x180002, 0x1A0000};
  server.start();
  const Ran ran = bench.run("pdo", {"map", "7", "tpdo1", "--type", "1"});
  server.stop();
  CHECK(ran.status == 1);
  CHECK(has(ran.err, "lexican: TPDO1 is as it was before\n"));
  CHECK(server.writes == Words{"180001=80000187", "180002=1!", "180001=187"});
}

TEST_CASE("lexican pdo map: a lost answer, and what the PDO was before") {
  for (const unsigned silent_from : {1U, 3U, 5U, 7U}) {
    CAPTURE(silent_from);
    Bench bench;
    FaultyServer server(bench);
    server.objects = first_tpdo();
    server.silent_from = silent_from;
    server.start();
    const Ran ran = bench.run("pdo", {"map", "7", "tpdo1", "2002/32", "--timeout", "100"});
    CHECK(ran.status == (silent_from < 6 ? 3 : 0));
    CHECK(has(ran.err, "Before: lexican pdo map 7 TPDO1 2001:0/16\n") == (silent_from < 6));
  }
}

TEST_CASE("lexican pdo map: a CAN identifier with another use, and a mapping that has less than it says") {
  PdoBench bench;
  const std::pair<const char*, const char*> others[] = {{"80", "080h is for SYNC"},
                                                        {"85", "085h is for EMCY"},
                                                        {"601", "601h is for SDO"},
                                                        {"705", "705h is for error control"},
                                                        {"185", "TPDO1 has 185h"}};
  for (const auto& [id, use] : others) {
    check(bench.pdo({"map", "5", "tpdo2", "2001", "--cob-id", id}), 2, "",
          "lexican: " + std::string(use) + "; --force uses it all the same\n");
  }
  check(bench.pdo({"show", "5", "tpdo2"}), 0, third_off, "");
  CHECK(bench.pdo({"map", "5", "tpdo2", "2001", "--cob-id", "185", "--force"}).status == 0);
  CHECK(bench.pdo({"map", "5", "tpdo2", "--type", "1.6"}).status == 2);
  CHECK(bench.pdo({"show", "5", "--off"}).status == 2);
  FaultyServer server(bench);
  server.objects = first_tpdo();
  server.objects[0x1A0000] = {4, 1};
  server.start();
  const Ran ran = bench.run("pdo", {"show", "7", "tpdo1"});
  check(ran, 1, "", "lexican: 1A00h:00 says 4 objects, but there is no 1A00h:02\n");
}

TEST_CASE("lexican pdo send: a device that is not operational, and an object of no bits") {
  PdoBench bench;
  CHECK(bench.run("nmt", {"preop", "5"}).status == 0);
  check(bench.pdo({"send", "5", "output=7"}), 1, "",
        "lexican: node 5 is pre-operational and receives no PDOs: lexican nmt start 5\n");
  CHECK(bench.pdo({"send", "5", "output=7", "2000=8"}).status == 2);
  FaultyServer server(bench);
  server.objects = {{0x101801, {1, 4}},     {0x101802, {2, 4}}, {0x101803, {3, 4}},         {0x101700, {0, 2}},
                    {0x140001, {0x207, 4}}, {0x160000, {1, 1}}, {0x160001, {0x20000000, 4}}};
  server.start();
  check(bench.run("pdo", {"send", "7", "rpdo1", "2000=1"}), 1, "",
        "lexican: RPDO1 maps 2000h:00 with a length of 0 bits\n");
}

TEST_CASE("lexican apply: a device that stops answering in the middle of a PDO") {
  Bench bench{5};
  const std::string dcf = bench.directory / "5.dcf";
  CHECK(bench.run("dump", {"5", "-o", dcf, "--eds", eds}).status == 0);
  std::string text = bytes_of(dcf);
  const std::pair<const char*, const char*> changes[] = {{"[1801sub1]", "$NODEID+0x40000280"}, {"[1801sub2]", "1"}};
  for (const auto& [section, value] : changes) {
    const std::size_t begin = text.find("ParameterValue=", text.find(section)) + 15;
    text.replace(begin, text.find('\r', begin) - begin, value);
  }
  write_bytes(dcf, text);
  FaultyServer server(bench);
  server.objects = {{0x100000, {0x00020192, 4}}, {0x101700, {0, 2}},          {0x101801, {0x100, 4}},
                    {0x101802, {0x402, 4}},      {0x101803, {0x10000, 4}},    {0x101804, {1, 4}},
                    {0x180101, {0x40000287, 4}}, {0x180102, {255, 1}},        {0x1A0100, {0, 1}},
                    {0x1A0101, {0, 4}},          {0x1A0102, {0, 4}},          {0x200300, {0x3F000000, 4}},
                    {0x200400, {1, 1}},          {0x200500, {0x73697861, 4}}, {0x200A00, {5, 4}}};
  server.silent_from = 2;
  server.pdo = CO_IF_FRM{0x187, {0}, 1};
  server.start();
  check(
      bench.run("apply", {dcf, "-n", "7", "--store", "--json"}), 1,
      R"({"error":"node 7 cannot store parameters, as it has no 1010h:01: apply the file after each power-up, without )"
      R"(--store\nnothing was written","status":1})"
      "\n",
      "lexican: node 7 cannot store parameters, as it has no 1010h:01: apply the file after each power-up, without "
      "--store\nlexican: nothing was written\n");
  CHECK(server.writes.empty());
  const Ran ran = bench.run("apply", {dcf, "-n", "7", "--timeout", "200"});
  CHECK(ran.status == 3);
  CHECK(has(ran.err, "lexican: node 7 sends PDOs, but does not answer SDO requests; "));
  CHECK(has(ran.err, "lexican: 0 values were written, and TPDO2 may be switched off; the same command goes on\n"));
}

}  // namespace
