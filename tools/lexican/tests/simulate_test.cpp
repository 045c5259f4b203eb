// SPDX-License-Identifier: Apache-2.0
// Devices that are simulated from their descriptions, on a virtual bus with our own client.
#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/stat.h>

#include <filesystem>
#include <map>

#include "frame_bits.hpp"
#include "program_bench.hpp"
#include "simulated_devices.hpp"

namespace {

using namespace lexican;

const std::string clock_eds = LEXICAN_TOOL_DIR "/../../demo/clock/generated/clock.eds";
const std::string simulated_eds = LEXICAN_TOOL_DIR "/tests/fixtures/device.eds";

TEST_CASE("simulate: a device has the objects of its description") {
  SimulatedBus bus(simulated_eds);
  REQUIRE(bus.fault == "");
  CHECK(bus.device.dictionary().left_out().empty());
  CHECK(bus.read(0x1000) == "00020192h");
  CHECK(bus.read(0x1018, 2) == "00000402h");
  CHECK(bus.read(0x2001) == "-40");
  CHECK(bus.read(0x2003) == "0.5");
  CHECK(bus.read(0x2005) == "\"axis\"");
  CHECK(bus.read(0x2007) == "aborted with 0601 0001h object is write-only");
  CHECK(bus.write(0x2006, 0, {1, 0, 0, 0}) == "aborted with 0601 0002h object is read-only");
  CHECK(bus.write(0x2005, 0, {'a', 'b'}) == "done");
  CHECK(bus.read(0x2005) == "\"ab\"");
  CHECK(bus.read(0x5000) == "aborted with 0602 0000h object does not exist");
}

TEST_CASE("simulate: values that the network can write are stored, and reset") {
  const std::string storage = "/tmp/lexican-simulate-" + std::to_string(getpid());
  {
    SimulatedBus bus(clock_eds, storage);
    CHECK(bus.write(0x2201, 0, {'a', 'b'}) == "done");
    CHECK(bus.write(0x1017, 0, {0xF4, 0x01}) == "done");
    CHECK(bus.write(0x1010, 1, {'s', 'a', 'v', 'e'}) == "done");
    CHECK(bus.write(0x2201, 0, {'c'}) == "done");
    CHECK(bus.write(0x2101, 0, {60, 0}) == "done");
    CHECK(bus.read(0x2201) == "\"c\"");
  }
  SimulatedBus bus(clock_eds, storage);
  CHECK(bus.read(0x2201) == "\"ab\"");
  CHECK(bus.read(0x1017) == "500");
  CHECK(bus.read(0x2101) == "0");
  CHECK(bus.write(0x1011, 1, {'l', 'o', 'a', 'd'}) == "done");
  CHECK(bus.read(0x2201) == "\"ab\"");  // until the reset
  CONmtReset(&bus.device.node().stack().Nmt, CO_RESET_NODE);
  CHECK(bus.read(0x2201) == "\"\"");
  CHECK(bus.read(0x1017) == "1000");
  CHECK(bus.write(0x2101, 0, {60, 0}) == "done");
  CHECK(bus.write(0x1017, 0, {0xF4, 0x01}) == "done");
  CONmtReset(&bus.device.node().stack().Nmt, CO_RESET_COM);  // keeps the values of the application
  CHECK(bus.read(0x2101) == "60");
  CHECK(bus.read(0x1017) == "1000");
  std::filesystem::remove(storage);
}

TEST_CASE("simulate: values outside the limits of the description are refused") {
  SimulatedBus bus(clock_eds);
  CHECK(bus.write(0x2101, 0, {0x48, 0x03}) == "done");  // 840
  CHECK(bus.write(0x2101, 0, {0x49, 0x03}) == "aborted with 0609 0031h value too high");
  CHECK(bus.write(0x2101, 0, {0x30, 0xFD}) == "done");  // -720
  CHECK(bus.write(0x2101, 0, {0x2F, 0xFD}) == "aborted with 0609 0032h value too low");
  CHECK(bus.read(0x2101) == "-720");
}

TEST_CASE("simulate: the device sets its objects itself, and refuses an object") {
  SimulatedBus bus(simulated_eds);
  CHECK(bus.device.set(0x2006, 0, {9, 0, 0, 0}));  // read-only for the network
  CHECK(bus.read(0x2006) == "9");
  CHECK(bus.device.get(0x2001, 0) == Bytes{0xD8, 0xFF});
  CHECK(!bus.device.set(0x2006, 0, {9, 0}));
  CHECK(!bus.device.set(0x5000, 0, {9}));
  CHECK(!bus.device.set(0x1000, 0, {9, 0, 0, 0}));
  CHECK(bus.device.dictionary().refuse(0x2006, 0, 0x08000022));
  CHECK(bus.read(0x2006).substr(0, 27) == "aborted with 0800 0022h dat");
  CHECK(bus.device.dictionary().refuse(0x2006, 0, 0));
  CHECK(bus.read(0x2006) == "9");
}

TEST_CASE("simulate: services beyond those of the program are named, and the device runs without them") {
  const test::Directory directory;
  const std::string path = directory / "servers.eds";
  std::string text = bytes_of_file(simulated_eds);
  text.replace(text.find("SupportedObjects=9"), 18, "SupportedObjects=11\n10=0x1201\n11=0x127F");
  for (const std::string object : {"1201", "127F"}) {
    const std::string kind = "DataType=0x0007\nAccessType=ro\nObjectType=7\nDefaultValue=";
    text += "\n[" + object + "]\nParameterName=Server\nObjectType=9\nSubNumber=3\n[" + object +
            "sub0]\nParameterName=Number\nDataType=0x0005\nAccessType=ro\nObjectType=7\nDefaultValue=2\n[" + object +
            "sub1]\nParameterName=Request\n" + kind + "0x6" + object.substr(2) + "\n[" + object +
            "sub2]\nParameterName=Answer\n" + kind + "0x5" + object.substr(2) + '\n';
  }
  test::write_bytes(path, text);
  SimulatedBus bus(path);
  REQUIRE(bus.fault == "");
  REQUIRE(bus.device.dictionary().left_out().size() == 1);
  CHECK(bus.device.dictionary().left_out()[0].find("SDO servers left out: 1; this program has the first ") == 0);
  CHECK(bus.read(0x1201, 1) == "00000601h");
  CHECK(bus.read(0x127F, 1) == "aborted with 0602 0000h object does not exist");
  CHECK(bus.read(0x2001) == "-40");
}

TEST_CASE("simulate: commands set values, and let them change") {
  SimulatedDevices bus(simulated_eds, 5, 1);
  bus.run("set 2001 77");
  CHECK(bus.read(0x2001) == "77");
  bus.run("set 2003 -1.5");
  CHECK(bus.read(0x2003) == "-1.5");
  bus.run("set 2005 \"two words\"");
  CHECK(bus.read(0x2005) == "\"two words\"");
  bus.run("set 2001 ramp 0 100 1s");
  bus.pass(500 * millisecond);
  const int half = std::stoi(bus.read(0x2001));
  CHECK(half >= 48);
  CHECK(half <= 53);
  bus.pass(600 * millisecond);
  CHECK(bus.read(0x2001) == "100");
  bus.run("set 2001 sine -10 10 1s");
  int low = 0;
  int high = 0;
  for (int n = 0; n < 50; ++n) {
    bus.pass(20 * millisecond);
    const int value = std::stoi(bus.read(0x2001));
    low = std::min(low, value);
    high = std::max(high, value);
  }
  CHECK(low <= -9);
  CHECK(high >= 9);
  bus.run("set 2001 1");
  bus.pass(100 * millisecond);
  CHECK(bus.read(0x2001) == "1");
  bool is_fault = false;
  CHECK(bus.simulation.execute("get 2001", is_fault) == "2001h Temperature = 1");
  bus.run("quit");
  CHECK(bus.simulation.has_ended());
}

TEST_CASE("simulate: commands with faults change nothing") {
  SimulatedDevices bus(simulated_eds, 5, 1);
  const std::pair<const char*, const char*> wrong[] = {
      {"jump", "unknown command"},
      {"set 2001 70000", "2001h Temperature: "},
      {"set 2001 ramp 0 100", "needs two numbers and a time"},
      {"set 2001 ramp 0 100 5", "needs two numbers and a time"},
      {"set 2001 ramp 0 nan 5s", "needs two numbers and a time"},
      {"set 2005 ramp 0 100 5s", "2005h Label is no number"},
      {"set 1000 5", "is a constant of the device"},
      {"emcy 12345", "emcy needs"},
      {"emcy", "emcy needs"},
      {"abort 1000 08000022", "1000h"},
      {"drop 101%", "drop needs"},
      {"drop 5", "drop needs"},
      {"delay 5", "delay needs"},
      {"off soon", "off needs"},
      {"after 3 emcy 1000", "after needs"},
      {"node 6", "no device has the node-ID 6"},
      {"wrong-length 9", "wrong-length needs: nothing, a number of bytes"},
      {"hang-sdo soon", "hang-sdo needs: nothing, a time"},
      {"wrong-toggle on", "wrong-toggle needs: nothing, or off"},
      {"same-id 7", "same-id needs: nothing, or off"},
      {"busoff 5", "busoff needs: nothing, a time"},
      {"flood", "flood needs: a CAN-ID"},
      {"flood 20000000", "flood needs: a CAN-ID"},
      {"flood 185 10001", "flood needs: a CAN-ID"},
  };
  for (const auto& row : wrong) {
    const std::string line = row.first;
    const std::string answer = bus.fault_of(line);
    CHECK_MESSAGE(answer.find(row.second) != std::string::npos, line << ": " << answer);
  }
  bus.run("# a comment");
  bus.run("");
  CHECK(bus.read(0x2001) == "-40");
}

TEST_CASE("simulate: errors, refusals, a loss of power and lost frames") {
  SimulatedDevices bus(clock_eds, 5, 1);
  bus.run("emcy 4310");
  bus.run("after 50ms emcy 0");
  bus.pass(100 * millisecond);
  CHECK(bus.received(0x085) == std::vector<Bytes>{{0x10, 0x43, 0x09, 0, 0, 0, 0, 0}, {0, 0, 0, 0, 0, 0, 0, 0}});
  bus.run("abort 2101 08000022");
  CHECK(bus.read(0x2101).find("aborted with 0800 0022h") == 0);
  bus.run("abort 2101 off");
  CHECK(bus.read(0x2101) == "0");
  bus.frames.clear();
  bus.run("set 2101 30");
  bus.run("off 1s");
  CHECK(bus.read(0x2101) == "no answer");
  bus.pass(1200 * millisecond);
  CHECK(bus.received(0x705).front() == Bytes{0});  // boot-up
  CHECK(bus.read(0x2101) == "0");
  bus.run("reboot");
  bus.pass(10 * millisecond);
  bus.run("drop 100%");
  CHECK(bus.read(0x2101) == "no answer");
  bus.run("drop 0%");
  CHECK(bus.read(0x2101) == "0");
  bus.frames.clear();
  bus.run("double 100%");
  CHECK(bus.read(0x2101) == "0");
  bus.pass(5 * millisecond);
  CHECK(bus.received(0x585).size() >= 2);
  bus.run("double 0%");
  bus.run("delay 50ms");
  const Micros begin = bus.network.now();
  CHECK(bus.read(0x2101) == "0");
  CHECK(bus.network.now() - begin >= 50 * millisecond);
}

TEST_CASE("simulate: TPDOs of a wrong length, and a flood of frames") {
  SimulatedDevices bus(clock_eds, 5, 1);
  bus.network.bus().inject({0, {1, 0}, 2});  // NMT start
  bus.pass(10 * millisecond);
  const auto length = [&](const char* command) {
    bus.run(command);
    bus.frames.clear();
    bus.run("set 2100:1 1");
    bus.run("set 2100:1 2");
    bus.pass(1100 * millisecond);
    REQUIRE(!bus.received(0x185).empty());
    return bus.received(0x185).front().size();
  };
  const std::size_t mapped = length("wrong-length off");
  CHECK(length("wrong-length") == mapped - 1);
  CHECK(length("wrong-length 8") == 8);
  CHECK(length("wrong-length 0") == 0);
  CHECK(bus.received(0x705).front() == Bytes{5});  // other frames are as before
  CHECK(length("wrong-length off") == mapped);

  bus.run("flood 123 200");
  bus.frames.clear();
  bus.pass(second);
  const std::size_t frames = bus.received(0x123).size();
  CHECK(frames >= 199);
  CHECK(frames <= 201);
  CHECK(bus.received(0x123)[7][0] == static_cast<std::uint8_t>(bus.received(0x123)[6][0] + 1));
  CHECK(bus.read(0x2101) == "0");
  std::size_t sent = 0;
  bus.network.bus().set_trace([&](const co::VirtualBus::Traffic& frame) { sent += frame.frame.Identifier == 1; });
  bus.run("flood 1");
  const Micros begin = bus.network.now();
  while (bus.network.now() - begin < 100 * millisecond) {
    bus.network.wait(millisecond);
  }
  bus.network.bus().set_trace({});
  const std::size_t most = VirtualNetwork::bit_rate / 10 / 111;  // 8 bytes without stuff bits
  CHECK(sent > most * 80 / 100);
  bus.run("flood off");
  bus.pass(10 * millisecond);
  bus.frames.clear();
  bus.pass(50 * millisecond);
  CHECK(bus.received(0x001).empty());
}

TEST_CASE("simulate: SDO servers that hang, and wrong toggle bits") {
  SimulatedDevices bus(simulated_eds, 5, 1);
  bus.run("set 2005 \"a text of some segments\"");
  const std::string text = "\"a text of some segments\"";
  CHECK(bus.read(0x2005) == text);
  bus.run("hang-sdo");
  CHECK(bus.read(0x2005) == "no answer");
  bus.run("hang-sdo off");
  CHECK(bus.read(0x2005) == text);
  bus.run("hang-sdo 300ms");
  CHECK(bus.read(0x2005) == "no answer");
  bus.pass(300 * millisecond);
  CHECK(bus.read(0x2005) == text);

  bus.run("wrong-toggle");
  CHECK(bus.read(0x2001) == "-40");  // expedited
  bus.frames.clear();
  CHECK(bus.read(0x2005) == "aborted with 0503 0000h toggle bit not alternated");
  const std::vector<Bytes> answers = bus.received(0x585);
  REQUIRE(answers.size() == 3);
  CHECK(answers[1][0] == 0x00);  // the first segment is right
  CHECK(answers[2][0] == 0x00);
  bus.frames.clear();
  const Bytes longer(20, 'x');
  CHECK(bus.client->sdo().download(0x2005, 0, longer, {SdoClient::small, 100, {}}).outcome() ==
        "aborted with 0503 0000h toggle bit not alternated");
  CHECK(bus.received(0x585).size() == 3);
  CHECK(bus.received(0x585).back()[0] == 0x20);
  bus.run("wrong-toggle off");
  bus.run("set 2005 " + text);
  CHECK(bus.read(0x2005) == text);
}

TEST_CASE("simulate: two devices with one node-ID") {
  SimulatedDevices bus(clock_eds, 5, 1);
  const std::string serial = bus.read(0x1018, 4);
  std::map<std::uint32_t, std::vector<Bytes>> sent;
  bus.network.bus().set_trace([&](const co::VirtualBus::Traffic& traffic) {
    const CO_IF_FRM& frame = traffic.frame;
    sent[frame.Identifier].emplace_back(frame.Data, frame.Data + frame.DLC);
  });
  const auto sent_in = [&](Micros time, const std::string& command) {
    sent.clear();
    bus.run(command);
    for (const Micros end = bus.network.now() + time; bus.network.now() < end;) {
      bus.network.wait(millisecond);
    }
    return sent;
  };
  auto frames = sent_in(1500 * millisecond, "same-id");
  CHECK(frames[0x705] == std::vector<Bytes>{{0}, {127}, {127}});  // a boot-up, and two heartbeats
  CHECK(frames[0x085].front() == Bytes{0x50, 0x81, 0x11, 0, 0, 5, 0, 0});
  bus.network.bus().inject({0x605, {0x40, 0x18, 0x10, 4}, 8});
  frames = sent_in(10 * millisecond, "");
  REQUIRE(frames[0x585].size() == 2);
  CHECK(frames[0x585][0][4] + 1 == frames[0x585][1][4]);  // serial numbers
  frames = sent_in(1500 * millisecond, "same-id off");
  CHECK(frames[0x705].size() <= 2);
  frames = sent_in(1500 * millisecond, "same-id");
  CHECK(frames[0x705].size() == 3);
  CHECK(bus.simulation.devices() == 2);
  sent_in(1500 * millisecond, "same-id off");
  bus.network.bus().set_trace({});
  CHECK(bus.read(0x1018, 4) == serial);
}

TEST_CASE("simulate: bus-off, and the recovery from it") {
  SimulatedDevices bus(clock_eds, 5, 1);
  bus.network.bus().inject({0, {1, 0}, 2});  // NMT start
  bus.pass(10 * millisecond);
  bus.frames.clear();
  bus.run("busoff 500ms");
  CHECK(bus.read(0x2101) == "no answer");
  CHECK(bus.received(CO_IF_FRM_ERROR | 0x088).size() == 32);
  CHECK(bus.received(0x585).empty());
  bus.frames.clear();
  bus.pass(600 * millisecond);
  CHECK(bus.received(0x085) == std::vector<Bytes>{{0x40, 0x81, 0x11, 0, 0, 0, 0, 0}, {0, 0, 0, 0, 0, 0, 0, 0}});
  CHECK(bus.read(0x2101) == "0");
  CHECK(CONmtGetMode(&bus.simulation.device(0).node().stack().Nmt) == CO_PREOP);
  bus.run("busoff");
  bus.pass(2 * second);
  CHECK(bus.read(0x2101) == "no answer");
  bus.run("busoff off");
  CHECK(bus.read(0x2101) == "0");
  bus.run("busoff");
  bus.run("reboot");
  bus.pass(10 * millisecond);
  CHECK(bus.read(0x2101) == "0");
}

TEST_CASE("simulate: a CSV is played") {
  const test::Directory directory;
  const std::string csv = directory / "speed.csv";
  const std::string set = "set 2001 csv " + csv;
  SimulatedDevices bus(simulated_eds, 5, 1);
  test::write_bytes(csv, "time,speed,\"of, all\"\r\n0,10,1\r\n0.1,20.6,\r\n\r\n2e-1,,3\n0.3,30,4");
  bus.run(set);
  bus.pass(50 * millisecond);
  CHECK(bus.read(0x2001) == "10");
  bus.pass(150 * millisecond);
  CHECK(bus.read(0x2001) == "21");  // rounded; the row without a value changes nothing
  bus.pass(150 * millisecond);
  CHECK(bus.read(0x2001) == "30");
  bus.run("set 2001 7");
  bus.pass(400 * millisecond);
  CHECK(bus.read(0x2001) == "7");  // it has ended
  for (const char* const column : {" \"of, all\" repeat", " 3 repeat"}) {
    bus.run(set + column);
    bus.pass(50 * millisecond);
    CHECK(bus.read(0x2001) == "1");
    bus.pass(200 * millisecond);
    CHECK(bus.read(0x2001) == "3");
    bus.pass(100 * millisecond);
    CHECK(bus.read(0x2001) == "1");
  }
  test::write_bytes(csv, "Zeit;Wert\n0;0,5\n0,1;-2,5\n");
  bus.run("set 2003 csv " + csv + " Wert");
  bus.run("set 2001 -40");
  bus.pass(50 * millisecond);
  CHECK(bus.read(0x2003) == "0.5");
  bus.pass(100 * millisecond);
  CHECK(bus.read(0x2003) == "-2.5");

  const std::pair<const char*, const char*> wrong[] = {
      {"", " has no values"},
      {"time\n0\n", ": the first line has no titles of two columns"},
      {"time,a\n", " has no values"},
      {"time,a\n0,1\n1\n", ", line 3: has no column 2"},
      {"time,a\n0,1\nx,1\n", ", line 3: 'x' is no time in s"},
      {"time,a\n-1,1\n", ", line 2: '-1' is no time in s"},
      {"time,a\n2,1\n1,1\n", ", line 3: '1' is less than the time before"},
      {"time,a\n2,one\n", ", line 2: 'one' is no integer"},
      {"time,a\n2,1e9\n", ", line 2: 1000000000 is out of range"},
  };
  for (const auto& row : wrong) {
    test::write_bytes(csv, row.first);
    const std::string answer = bus.fault_of(set);
    CHECK_MESSAGE(answer.find(csv + row.second) == 0, row.first << ": " << answer);
  }
  test::write_bytes(csv, "time,a\n0,1\n");
  CHECK(bus.fault_of(set + " b") == csv + " has no column b");
  CHECK(bus.fault_of(set + " 1") == csv + " has no column 1");
  CHECK(bus.fault_of(set + " repeat") == csv + " cannot be repeated: it lasts less than 10 ms");
  CHECK(bus.fault_of(set + " 2 3").find("set OBJECT csv needs") == 0);
  CHECK(bus.fault_of("set 2001 csv /").find("/ is a directory") == 0);
  CHECK(bus.fault_of("set 2001 csv /nonexistent").find("/nonexistent: No such file") == 0);
  test::write_bytes(csv, "time,a\n" + std::string(9U << 20, '\n'));
  CHECK(bus.fault_of(set).find(csv + " has more than 8 MiB") == 0);
  CHECK(bus.read(0x2001) == "-40");
}

TEST_CASE("simulate: JSON lines of a file and of a FIFO are played") {
  const test::Directory directory;
  const std::string file = directory / "lines";
  SimulatedDevices bus(simulated_eds, 5, 2);
  std::vector<std::string> notes;
  bus.simulation.on_note([&](const std::string& text) { notes.push_back(text); });
  test::write_bytes(file,
                    "{\"2001\": 5, \"2005\": \"two words\"}\n"
                    "\n"
                    "{\"2001\": 6.4, \"time\": 0.1, \"2003\": -1.5}\r\n"
                    "{\"node\": 6, \"2001\": 66}\n"
                    "{\"time\": 0.2, \"command\": \"set 2001 8\"}");
  bus.run("play " + file);
  bus.pass(50 * millisecond);
  CHECK(bus.read(0x2001) == "5");
  CHECK(bus.read(0x2005) == "\"two words\"");
  bus.pass(100 * millisecond);
  CHECK(bus.read(0x2001) == "6");
  CHECK(bus.read(0x2003) == "-1.5");
  CHECK(bus.simulation.device(1).get(0x2001, 0) == Bytes{66, 0});
  bus.pass(100 * millisecond);
  CHECK(bus.read(0x2001) == "8");
  CHECK(notes.empty());

  const std::string start = "{\"2001\": ";
  test::write_bytes(file, "x\n[1]\n" + start + "null}\n" + start + "70000}\n{\"time\": -1}\n{\"node\": 300}\n" +
                              "{\"node\": 9}\n" + std::string(70000, ' ') + "\n" + start + "9}\n" +
                              std::string(200000, 'x'));
  bus.run("play " + file);
  bus.pass(20 * millisecond);
  CHECK(bus.read(0x2001) == "9");
  const std::string place = file + ", line ";
  CHECK(notes == std::vector<std::string>{
                     place + "1: is no JSON object, such as {\"6064\": 1000}",
                     place + "2: is no JSON object, such as {\"6064\": 1000}",
                     place + "3: '2001' is no number, text, true or false",
                     place + "4: 2001h Temperature: 70000 is out of range, -32768...32767",
                     place + "5: \"time\" is no time in s",
                     place + "6: \"node\" is no node-ID",
                     place + "7: no device has the node-ID 9",
                     place + "8: is longer than 64 KiB",
                     place + "10: is longer than 64 KiB",
                 });
  notes.clear();

  const std::string fifo = directory / "fifo";
  REQUIRE(mkfifo(fifo.c_str(), 0600) == 0);
  bus.run("play " + fifo);
  bus.pass(20 * millisecond);
  for (const char* const value : {"11", "12"}) {
    const int writer = open(fifo.c_str(), O_WRONLY | O_CLOEXEC);
    const auto put = [&](const std::string& text) { REQUIRE(write(writer, text.data(), text.size()) > 0); };
    put(start);
    bus.pass(20 * millisecond);
    CHECK(bus.read(0x2001) != value);
    put(value + std::string("}"));
    close(writer);
    bus.pass(20 * millisecond);
    CHECK(bus.read(0x2001) == value);
  }
  bus.run("play off");
  CHECK(notes.empty());
  CHECK(bus.fault_of("play /nonexistent").find("/nonexistent: No such file") == 0);
  CHECK(bus.fault_of("play").find("unknown command") == 0);
}

TEST_CASE("simulate: lost frames depend on the seed only") {
  const auto answers = [](std::uint64_t seed) {
    SimulatedDevices bus(clock_eds, 5, 1, seed);
    bus.run("drop 30%");
    std::string text;
    for (int n = 0; n < 40; ++n) {
      text += bus.read(0x2101) == "0" ? '1' : '0';
    }
    return text;
  };
  const std::string first = answers(7);
  CHECK(first == answers(7));
  CHECK(first != answers(8));
}

TEST_CASE("simulate: several devices in one process") {
  SimulatedDevices bus(clock_eds, 10, 3);
  bus.run("node 12");
  bus.run("set 2101 30");
  CHECK(bus.read(0x2101) == "0");  // of node 10
  CHECK(bus.simulation.device(2).get(0x2101, 0) == Bytes{30, 0});
  CHECK(bus.simulation.device(1).get(0x1018, 4) != bus.simulation.device(2).get(0x1018, 4));
  bus.pass(1500 * millisecond);
  for (const std::uint32_t node : {10U, 11U, 12U}) {
    CHECK(!bus.received(0x700U + node).empty());
  }
}

}  // namespace

TEST_CASE("simulate: twenty devices at 60 % load of a wire of 500 kbit/s lose no frame") {
  constexpr unsigned devices = 20;
  constexpr std::uint8_t first = 10;
  SimulatedDevices bus(LEXICAN_FIXTURES "/network/io.eds", first, devices);
  for (std::size_t n = 0; n < devices; ++n) {
    REQUIRE(bus.simulation.device(n).set(0x1800, 5, {4, 0}));  // event timer, ms
  }
  std::map<std::uint32_t, unsigned> sent;
  std::uint64_t bits = 0;
  bus.network.bus().set_trace([&](const co::VirtualBus::Traffic& traffic) {
    ++sent[traffic.frame.Identifier];
    bits += co::frame_bits(traffic.frame) + co::intermission_bits;
  });
  bus.network.bus().inject({0, {1, 0}, 2});  // NMT start
  const Micros begin = bus.network.now();
  constexpr Micros time = 2 * second;
  while (bus.network.now() - begin < time) {
    bus.network.wait(time - (bus.network.now() - begin));
  }
  bus.network.bus().set_trace({});
  const double load = static_cast<double>(bits) / (VirtualNetwork::bit_rate * 2.0);
  CHECK(load > 0.55);
  CHECK(load < 0.70);
  for (unsigned n = 0; n < devices; ++n) {
    const unsigned frames = sent[0x180U + first + n];
    CAPTURE(n);
    CHECK(frames >= 499);
    CHECK(frames <= 501);
    CHECK(bus.simulation.device(n).node().counters().Dropped == 0);
  }
}

TEST_CASE("lexican sim: a device of a description on a hub, with commands of a script and of a pipe") {
  test::Bench bench;
  const std::string script = bench.directory / "script";
  test::write_bytes(script, "# start\nset temperature 21\nabort label 08000022\n");
  int input[2] = {-1, -1};
  REQUIRE(pipe(input) == 0);
  test::Process sim(bench.line("sim", {test::eds, "--node", "5", "--script", script}), bench.environment(), input[0]);
  close(input[0]);
  sim.wait_for("node 5");
  sim.wait_for(" entries, 2 TPDOs, 1 RPDOs");
  test::check(bench.run("read", {"5", "temperature", "--eds", test::eds}), 0, "2001h Temperature = 21 (i16)\n", "");
  CHECK(bench.run("read", {"5", "label", "--eds", test::eds}).status == 1);
  const std::string commands = "get temperature\nset temperature\nquit\n";
  CHECK(write(input[1], commands.data(), commands.size()) == static_cast<ssize_t>(commands.size()));
  const test::Ran ran = sim.finish();
  close(input[1]);
  CHECK(ran.status == 0);
  CHECK(test::has(ran.out, "2001h Temperature = 21\n"));
  CHECK(test::has(ran.err, "lexican: unknown command, or wrong arguments: set\n"));
}

TEST_CASE("lexican sim: from an unknown adapter to a trace with names") {
  const std::string servo = LEXICAN_TOOL_DIR "/tests/fixtures/servo.eds";
  test::Bench bench;
  const std::string script = bench.directory / "script";
  test::write_bytes(script, "set 1017 50\n");
  test::Process sim(bench.line("sim", {servo, "--node", "5", "--script", script}), bench.environment());
  sim.wait_for("node 5");
  test::Process share(bench.line("share", {"--name", "adapter", "--port", "0", "--slcan-port", "0", "--pty", "--json"}),
                      bench.environment());
  share.wait_for("}\n");
  const std::string adapter = "slcan:" + nlohmann::json::parse(share.out())["slcan"].get<std::string>();
  const test::Ran scan = bench.run("scan", {"-i", adapter});
  CHECK(scan.status == 0);
  CHECK(test::has(scan.err + scan.out, "rate: "));
  CHECK(test::has(scan.out, "   5  pre-operational  402 drive "));
  test::Process mon(bench.line("mon", {"-i", adapter + "@500k", "--eds", servo}), bench.environment());
  mon.wait_for("heartbeat: pre-operational");
  CHECK(bench.run("nmt", {"start", "5"}).status == 0);
  mon.wait_for("heartbeat: operational");
  CHECK(bench.run("write", {"5", "6040", "6", "--eds", servo}).status == 0);
  mon.wait_for("TPDO1 Statusword = ");
}

TEST_CASE("lexican sim: wrong use") {
  test::Bench bench;
  const std::string script = bench.directory / "script";
  test::write_bytes(script, "jump\n");
  CHECK(bench.run("sim", {"/nonexistent.eds"}).status == 2);
  CHECK(bench.run("sim", {test::eds, "--node", "128"}).status == 2);
  CHECK(bench.run("sim", {test::eds, "--node", "120", "--count", "9"}).status == 2);
  CHECK(bench.run("sim", {test::eds, "--store", "/nonexistent/file"}).status == 2);
  const test::Ran ran = bench.run("sim", {test::eds, "--script", script});
  CHECK(ran.status == 2);
  CHECK(test::has(ran.err, "script, line 1: jump\n"));
}
