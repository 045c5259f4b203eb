// SPDX-License-Identifier: Apache-2.0
// hub:NAME: a server in this process and clients on real sockets, hostile clients, and a server in a process.
#include "bus/hub.hpp"

#include <doctest/doctest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <random>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "frame_bits.hpp"

namespace {

using namespace lexican::host_bus;

/// Directory that exists during a test, as XDG_RUNTIME_DIR.
class Runtime {
 public:
  Runtime() {
    char name[] = "/tmp/lexican-test-XXXXXX";
    path_ = mkdtemp(name);
    setenv("XDG_RUNTIME_DIR", path_.c_str(), 1);
  }
  ~Runtime() {
    unsetenv("XDG_RUNTIME_DIR");
    std::filesystem::remove_all(path_);
  }
  Runtime(const Runtime&) = delete;
  Runtime& operator=(const Runtime&) = delete;
  const std::string& path() const { return path_; }
  std::string socket() const { return path_ + "/socket"; }

 private:
  std::string path_;
};

CO_IF_FRM frame(const char* text) {
  CO_IF_FRM result{};
  REQUIRE(parse_frame(text, result) == Parsed::frame);
  return result;
}

/// Returns all frames that a bus has received, without their times.
std::vector<std::string> read(Bus& bus) {
  std::vector<std::string> frames;
  while (const std::optional<Entry> entry = bus.receive()) {
    frames.push_back(to_text(entry->frame));
  }
  return frames;
}

using Texts = std::vector<std::string>;

/// Returns all frames that a bus has received, with the time of each.
std::vector<std::pair<Micros, std::string>> read_with_times(Bus& bus) {
  std::vector<std::pair<Micros, std::string>> frames;
  while (const std::optional<Entry> entry = bus.receive()) {
    frames.emplace_back(entry->time, to_text(entry->frame));
  }
  return frames;
}

constexpr std::uint32_t paced_rate = 500'000;

/// Returns the time of a frame of \a text, in bits on the wire.
unsigned bits(const char* text) { return co::frame_bits(frame(text)); }

constexpr Micros micros_of(unsigned bits) { return Micros{bits} * 1'000'000 / paced_rate; }

/// A server in this process with some clients, which know its greeting.
struct Hub {
  explicit Hub(unsigned clients, const std::string& greeting = "simulated", std::uint32_t bit_rate = 0)
      : server(greeting, bit_rate) {
    std::string why;
    REQUIRE_MESSAGE(server.open(runtime.socket(), why), why);
    for (unsigned n = 0; n < clients; ++n) {
      buses.push_back(connect());
    }
    server.process(0);
    for (const std::unique_ptr<Bus>& bus : buses) {
      CHECK(read(*bus).empty());
    }
  }

  std::unique_ptr<Bus> connect() {
    std::string why;
    std::unique_ptr<Bus> bus = connect_to_hub(runtime.socket(), why);
    REQUIRE_MESSAGE(bus != nullptr, why);
    return bus;
  }

  /// Returns a socket that is connected to the server.
  int connect_raw() {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strcpy(address.sun_path, runtime.socket().c_str());
    const int fd = socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0);
    REQUIRE(::connect(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0);
    return fd;
  }

  Runtime runtime;
  HubServer server;
  std::vector<std::unique_ptr<Bus>> buses;
};

/// Sends bytes to a server by a client that nothing else does.
void send_hostile(Hub& hub, const std::string& bytes) {
  const int fd = hub.connect_raw();
  hub.server.process(0);
  REQUIRE(::send(fd, bytes.data(), bytes.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(bytes.size()));
  hub.server.process(0);
  close(fd);
}

}  // namespace

TEST_CASE("hub: the last frames of a client that has closed its socket are forwarded") {
  Hub hub(3);
  CHECK(hub.buses[0]->send(frame("123#AABB")));
  SUBCASE("with unread frames") {
    hub.server.process(1);
    CHECK(hub.buses[1]->send(frame("000#0105")));
    hub.buses.erase(hub.buses.begin() + 1);
  }
  SUBCASE("while frames wait for it") {
    CHECK(hub.buses[1]->send(frame("000#0105")));
    hub.buses.erase(hub.buses.begin() + 1);
  }
  for (unsigned n = 0; n < 3; ++n) {
    hub.server.process(2);
  }
  CHECK(read(*hub.buses[1]) == Texts{"123#AABB", "000#0105"});
  CHECK(hub.server.clients() == 2);
}

TEST_CASE("hub: a frame reaches all other clients, with the time of the server") {
  Hub hub(3);
  CHECK(hub.buses[0]->send(frame("123#AABB")));
  CHECK(hub.buses[0]->send(frame("12345678#R8")));
  hub.server.process(0x0123456789ABCDEF);
  for (const unsigned n : {1U, 2U}) {
    const std::optional<Entry> entry = hub.buses[n]->receive();
    REQUIRE(entry.has_value());
    CHECK(entry->time == 0x0123456789ABCDEF);
    CHECK(entry->direction == Direction::received);
    CHECK(to_text(entry->frame) == "123#AABB");
    CHECK(read(*hub.buses[n]) == Texts{"12345678#R8"});
  }
  CHECK(read(*hub.buses[0]).empty());
}

TEST_CASE("hub: the greeting says whether the bus is simulated") {
  Hub simulated(1);
  CHECK_FALSE(simulated.buses[0]->is_physical());
  CHECK(simulated.buses[0]->bit_rate() == 0);
  Hub physical(1, "physical 500000");
  CHECK(physical.buses[0]->is_physical());
  CHECK(physical.buses[0]->bit_rate() == 500000);
  const std::unique_ptr<Bus> unknown = physical.connect();
  CHECK(unknown->is_physical());
}

TEST_CASE("hub: a simulated bus carries the error frames of a wrong frame, an adapter does not") {
  const CO_IF_FRM error = {CO_IF_FRM_ERROR | 0x088, {0, 0, 0x81}, 8};
  Hub simulated(2);
  CHECK(simulated.buses[0]->send(error));
  simulated.server.process(0);
  const std::optional<Entry> entry = simulated.buses[1]->receive();
  REQUIRE(entry.has_value());
  CHECK(entry->frame.Identifier == error.Identifier);
  Hub physical(2, "physical 500000");
  CHECK(physical.buses[0]->send(error));
  physical.server.process(0);
  CHECK(physical.server.clients() == 1);
}

TEST_CASE("hub: the messages on the socket") {
  Hub hub(1);
  const int fd = hub.connect_raw();
  hub.server.process(0);
  char bytes[100];
  REQUIRE(recv(fd, bytes, sizeof bytes, 0) == 23);
  CHECK(std::string(bytes, 23) == "lexican-hub 1 simulated");
  hub.buses[0]->send(frame("12345678#0102030405060708"));
  hub.server.process(1);
  REQUIRE(recv(fd, bytes, sizeof bytes, 0) == 24);
  CHECK(std::string(bytes, 24) == std::string("F\x08\x00\x00\x78\x56\x34\x92\x01\x00\x00\x00\x00\x00\x00\x00"
                                              "\x01\x02\x03\x04\x05\x06\x07\x08",
                                              24));
  close(fd);
}

TEST_CASE("hub: a client that sends something else than a frame is disconnected, the others are not") {
  Hub hub(2);
  const std::string good(
      "F\x01\x00\x00\x23\x01\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00", 24);
  send_hostile(hub, good);
  CHECK(read(*hub.buses[0]) == Texts{"123#00"});
  std::vector<std::string> hostile = {"x", good.substr(0, 23), good + "x", "L" + good.substr(1),
                                      std::string(65000, 'F')};
  std::string changed = good;
  changed[1] = 9;  // length
  hostile.push_back(changed);
  changed = good;
  changed[5] = 8;  // beyond 11 bits
  hostile.push_back(changed);
  changed = good;
  changed[7] = 0x20;  // an error frame
  hostile.push_back(changed);
  for (const std::string& bytes : hostile) {
    send_hostile(hub, bytes);
    CHECK(hub.server.clients() == 2);
    CHECK(read(*hub.buses[0]).empty());
  }
  std::mt19937 random(1);
  for (unsigned n = 0; n < 1000; ++n) {
    std::string bytes(1 + random() % 40, '\0');
    for (char& byte : bytes) {
      byte = static_cast<char>(random());
    }
    send_hostile(hub, bytes);
  }
  read(*hub.buses[1]);
  CHECK(hub.buses[0]->send(frame("001#")));
  hub.server.process(0);
  CHECK(read(*hub.buses[1]) == Texts{"001#"});
}

TEST_CASE("hub: a client that does not read loses frames, which are counted, and does not delay the others") {
  Hub hub(3);
  constexpr unsigned number = 40000;
  unsigned received = 0;
  for (unsigned n = 0; n < number; ++n) {
    REQUIRE(hub.buses[0]->send(frame("123#")));
    hub.server.process(n);
    received += static_cast<unsigned>(read(*hub.buses[1]).size());
  }
  CHECK(received == number);
  CHECK(hub.buses[1]->lost() == 0);
  received = 0;
  for (unsigned n = 0; n < number; ++n) {
    received += static_cast<unsigned>(read(*hub.buses[2]).size());
    hub.server.process(0);
  }
  CHECK(received >= HubServer::most_waiting);
  CHECK(hub.buses[2]->lost() > 0);
  CHECK(received + hub.buses[2]->lost() == number);
  REQUIRE(hub.buses[0]->send(frame("124#")));
  hub.server.process(0);
  CHECK(read(*hub.buses[2]) == Texts{"124#"});
}

TEST_CASE("hub: a client that sends too fast waits, and loses nothing") {
  Hub hub(2);
  constexpr unsigned number = 20000;
  unsigned received = 0;
  unsigned waits = 0;
  for (unsigned n = 0; n < number;) {
    if (hub.buses[0]->send(frame("123#"))) {
      ++n;
      CHECK(hub.buses[0]->wanted().events == POLLIN);
      continue;
    }
    ++waits;
    CHECK(hub.buses[0]->wanted().events == (POLLIN | POLLOUT));
    CHECK(hub.buses[0]->fault().empty());
    hub.server.process(0);
    received += static_cast<unsigned>(read(*hub.buses[1]).size());
  }
  for (unsigned n = 0; n < number; ++n) {
    hub.server.process(0);
    received += static_cast<unsigned>(read(*hub.buses[1]).size());
  }
  CHECK(waits > 0);
  CHECK(received == number);
}

TEST_CASE("hub: further clients wait until one of the 64 has left") {
  Hub hub(HubServer::most_clients);
  const std::unique_ptr<Bus> another = hub.connect();
  hub.server.process(0);
  CHECK(hub.server.clients() == HubServer::most_clients);
  CHECK(hub.server.wanted().front().fd == -1);
  hub.buses.pop_back();
  hub.server.process(0);
  hub.server.process(0);
  CHECK(hub.server.clients() == HubServer::most_clients);
  hub.buses[0]->send(frame("123#"));
  hub.server.process(0);
  CHECK(read(*another) == Texts{"123#"});
}

TEST_CASE("hub: when the server ends, clients say so, and connect to the next one") {
  Runtime runtime;
  std::string why;
  auto server = std::make_unique<HubServer>("simulated");
  REQUIRE(server->open(runtime.socket(), why));
  const std::unique_ptr<Bus> bus = connect_to_hub(runtime.socket(), why);
  server->process(0);
  CHECK(read(*bus).empty());
  server.reset();
  CHECK(read(*bus).empty());
  CHECK(bus->fault() == "the hub has ended");
  CHECK(bus->wanted().fd == -1);
  CHECK_FALSE(bus->send(frame("123#")));
  CHECK_FALSE(bus->restore());
  CHECK(bus->fault() == runtime.socket() + ": Connection refused");
  std::filesystem::remove(runtime.socket());
  HubServer next("simulated");
  REQUIRE(next.open(runtime.socket(), why));
  CHECK(bus->restore());
  CHECK(bus->fault().empty());
  CHECK(bus->send(frame("123#")));
}

TEST_CASE("hub: a client of an adapter starts no hub in its place, and uses no simulated one") {
  Runtime runtime;
  std::string why;
  const std::string path = hub_path("adapter", why);
  auto server = std::make_unique<HubServer>("physical 500000");
  REQUIRE_MESSAGE(server->open(path, why), why);
  std::unique_ptr<Bus> bus;
  std::thread opening([&] {
    std::string reason;
    bus = open_hub("adapter", reason);
  });
  for (unsigned n = 0; server->clients() == 0 && n < 10'000; ++n) {
    server->process(0);
    usleep(1000);
  }
  opening.join();
  REQUIRE(bus != nullptr);
  CHECK(bus->is_physical());
  server.reset();
  CHECK(read(*bus).empty());
  CHECK(bus->fault() == "the hub has ended");
  CHECK_FALSE(bus->restore());
  CHECK(bus->wanted().fd == -1);
  CHECK(bus->is_physical());
  std::filesystem::remove(path);
  HubServer simulated("simulated");
  REQUIRE(simulated.open(path, why));
  CHECK(bus->restore());
  simulated.process(0);
  CHECK(read(*bus).empty());
  CHECK(bus->fault() == "the hub is a simulated one now, and was an adapter");
  CHECK(bus->is_physical());
}

TEST_CASE("hub: another program at the socket is refused") {
  Runtime runtime;
  std::string why;
  for (const char* const greeting : {"2 simulated", ""}) {
    CAPTURE(greeting);
    const int listener = socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strcpy(address.sun_path, runtime.socket().c_str());
    REQUIRE(bind(listener, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0);
    REQUIRE(listen(listener, 1) == 0);
    const std::unique_ptr<Bus> bus = connect_to_hub(runtime.socket(), why);
    REQUIRE(bus != nullptr);
    const int fd = accept(listener, nullptr, nullptr);
    const std::string text = std::string("lexican-hub ") + greeting;
    CHECK(::send(fd, text.data(), text.size(), MSG_NOSIGNAL) > 0);
    CHECK(read(*bus).empty());
    CHECK(bus->fault() == "the program at this socket is not a hub of this version of lexican");
    close(fd);
    close(listener);
    std::filesystem::remove(runtime.socket());
  }
}

TEST_CASE("hub: names and directories that are not safe are refused") {
  Runtime runtime;
  for (const char* const name : {"", "a/b", "..", "a b", "a\n", "12345678901234567890123456789012345678901"}) {
    CAPTURE(name);
    std::string why;
    CHECK(hub_path(name, why).empty());
    CHECK(why == "the name of a hub has 1 to 40 letters, digits, - and _");
  }
  std::string why;
  CHECK(hub_path("bench-1_A", why) == runtime.path() + "/lexican/bench-1_A.hub");
  struct stat found {};
  CHECK(stat((runtime.path() + "/lexican").c_str(), &found) == 0);
  CHECK((found.st_mode & 0777) == 0700);
  REQUIRE(chmod((runtime.path() + "/lexican").c_str(), 0750) == 0);
  CHECK(hub_path("bench", why).empty());
  CHECK(why == runtime.path() + "/lexican has to be a directory of this user that others may not enter (chmod 700)");
  std::filesystem::remove_all(runtime.path() + "/lexican");
  std::filesystem::create_directory_symlink("/tmp", runtime.path() + "/lexican");
  CHECK(hub_path("bench", why).empty());
  why.clear();
  setenv("XDG_RUNTIME_DIR", ("/tmp/" + std::string(100, 'x')).c_str(), 1);
  CHECK(open_hub("bench", why) == nullptr);
  CHECK_FALSE(why.empty());
}

TEST_CASE("hub: the first program starts the server, which ends after the last one") {
  Runtime runtime;
  std::string why;
  std::unique_ptr<Bus> first = open_hub("bench", why);
  REQUIRE_MESSAGE(first != nullptr, why);
  std::unique_ptr<Bus> second = open_hub("bench", why);
  REQUIRE_MESSAGE(second != nullptr, why);
  std::unique_ptr<Bus> other = open_hub("other", why);
  REQUIRE_MESSAGE(other != nullptr, why);
  CHECK_FALSE(first->is_physical());
  CHECK(first->send(frame("123#01")));
  Texts received;
  while (received.empty() && second->fault().empty()) {
    pollfd wanted = second->wanted();
    poll(&wanted, 1, 100);
    received = read(*second);
  }
  CHECK(received == Texts{"123#01"});
  CHECK(read(*other).empty());
  first.reset();
  second.reset();
  other.reset();
  const std::string directory = runtime.path() + "/lexican/";
  while (std::filesystem::exists(directory + "bench.hub") || std::filesystem::exists(directory + "other.hub")) {
    usleep(10000);
  }
  const std::unique_ptr<Bus> again = open_hub("bench", why);
  CHECK(again != nullptr);
}

TEST_CASE("hub: on a paced hub a frame arrives when its last bit has ended") {
  Hub hub(2, "simulated 500000", paced_rate);
  CHECK_FALSE(hub.buses[0]->is_physical());
  CHECK(hub.buses[0]->bit_rate() == paced_rate);
  CHECK_FALSE(hub.server.due());
  CHECK(hub.buses[0]->send(frame("123#AABB")));
  CHECK(hub.buses[0]->send(frame("12345678#R8")));
  hub.server.process(1000);
  CHECK(read(*hub.buses[1]).empty());
  const Micros first = 1000 + micros_of(bits("123#AABB"));
  CHECK(hub.server.due() == first);
  hub.server.process(first - 1);
  CHECK(read(*hub.buses[1]).empty());
  hub.server.process(first);
  CHECK(read_with_times(*hub.buses[1]) == std::vector<std::pair<Micros, std::string>>{{first, "123#AABB"}});
  const Micros second = first + micros_of(co::intermission_bits + bits("12345678#R8"));
  hub.server.process(second + 5000);
  CHECK(read_with_times(*hub.buses[1]) == std::vector<std::pair<Micros, std::string>>{{second, "12345678#R8"}});
  CHECK_FALSE(hub.server.due());
}

TEST_CASE("hub: on a paced hub the frame with the highest priority is next, of the first frame of each program") {
  Hub hub(6, "simulated 500000", paced_rate);
  CHECK(hub.buses[0]->send(frame("700#")));  // idle bus: it starts at once
  hub.server.process(0);
  CHECK(hub.buses[0]->send(frame("001#")));
  CHECK(hub.buses[1]->send(frame("123#R")));
  CHECK(hub.buses[1]->send(frame("000#")));  // behind 123#R
  CHECK(hub.buses[2]->send(frame("123#01")));
  CHECK(hub.buses[3]->send(frame("048D0000#")));  // base ID 123h
  CHECK(hub.buses[4]->send(frame("04880000#")));  // base ID 122h
  hub.server.process(10);
  hub.server.process(1'000'000);
  CHECK(read(*hub.buses[5]) == Texts{"700#", "001#", "04880000#", "123#01", "123#R", "000#", "048D0000#"});
}

TEST_CASE("hub: a client that sends faster than a paced hub waits, and loses nothing") {
  Hub hub(2, "simulated 500000", paced_rate);
  constexpr unsigned number = 2000;
  unsigned received = 0;
  unsigned waits = 0;
  Micros now = 0;
  Micros last = 0;
  for (unsigned n = 0; received < number;) {
    if (n < number && hub.buses[0]->send(frame("123#"))) {
      ++n;
      continue;
    }
    waits += n < number ? 1U : 0U;
    hub.server.process(now);
    for (const auto& [time, text] : read_with_times(*hub.buses[1])) {
      CHECK(time - last >= micros_of(bits("123#")));
      last = time;
      ++received;
    }
    now = hub.server.due().value_or(now);
  }
  CHECK(waits > 0);
  CHECK(last == micros_of(number * (bits("123#") + co::intermission_bits) - co::intermission_bits));
}

TEST_CASE("hub: the frames of a program that has closed a paced hub are sent") {
  Hub hub(2, "simulated 500000", paced_rate);
  CHECK(hub.buses[0]->send(frame("123#01")));
  CHECK(hub.buses[0]->send(frame("123#02")));
  hub.buses.erase(hub.buses.begin());
  hub.server.process(0);
  CHECK(hub.server.clients() == 2);
  CHECK(hub.server.wanted()[1].fd == -1);  // poll() would return at once
  const std::unique_ptr<Bus> next = hub.connect();
  hub.server.process(1000);
  hub.server.process(2000);
  CHECK(read(*hub.buses[0]) == Texts{"123#01", "123#02"});
  CHECK(hub.server.clients() == 2);
  CHECK(read(*next) == Texts{"123#01", "123#02"});
}

TEST_CASE("hub: a paced hub continues when the clock is set back") {
  Hub hub(2, "simulated 500000", paced_rate);
  constexpr Micros late = 10'000'000'000;
  for (const char* const text : {"123#01", "123#02"}) {
    CHECK(hub.buses[0]->send(frame(text)));
  }
  hub.server.process(late);
  hub.server.process(50);
  hub.server.process(1000);
  CHECK(read_with_times(*hub.buses[1]) ==
        std::vector<std::pair<Micros, std::string>>{
            {50 + micros_of(bits("123#01")), "123#01"},
            {50 + micros_of(bits("123#01") + co::intermission_bits + bits("123#02")), "123#02"}});
}

TEST_CASE("hub: the first program decides the bit rate, and another one is refused") {
  Runtime runtime;
  std::string why;
  const std::unique_ptr<Bus> first = open_hub("paced@500k", why);
  REQUIRE_MESSAGE(first != nullptr, why);
  CHECK(first->bit_rate() == 500'000);
  const std::unique_ptr<Bus> any = open_hub("paced", why);
  REQUIRE_MESSAGE(any != nullptr, why);
  CHECK(any->bit_rate() == 500'000);
  CHECK_FALSE(any->is_physical());
  CHECK(open_hub("paced@500000", why) != nullptr);
  CHECK(open_hub("paced@250k", why) == nullptr);
  CHECK(why == "the hub has 500000 bit/s, not 250000 bit/s: open it without @, or end the programs that use it");
  const std::unique_ptr<Bus> without = open_hub("unpaced", why);
  REQUIRE_MESSAGE(without != nullptr, why);
  CHECK(without->bit_rate() == 0);
  CHECK(open_hub("unpaced@500k", why) == nullptr);
  CHECK(why == "the hub has no bit rate, not 500000 bit/s: open it without @, or end the programs that use it");
  CHECK(open_hub("paced@", why) == nullptr);
  CHECK(why == "'' is not a bit rate, such as 500k, 1M or 500000");
  for (const char* const name : {"paced@9999", "paced@1000001"}) {
    CHECK(open_hub(name, why) == nullptr);
    CHECK(why == "the bit rate of a hub is 10k to 1M");
  }
}
