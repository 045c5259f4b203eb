// SPDX-License-Identifier: Apache-2.0
// SocketCAN on a real kernel, with a virtual interface that these tests create, take down and remove. They require root
// and AF_CAN, and are skipped otherwise; tests/drivers/vcan runs them in a guest.
#include <doctest/doctest.h>

#ifdef __linux__

#include <linux/can/raw.h>
#include <linux/tty.h>
#include <net/if.h>
#include <poll.h>
#include <pty.h>
#include <spawn.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <vector>

#include "socketcan.hpp"
#include "support/notation.hpp"

namespace {

using co::SocketCan;
using Texts = std::vector<std::string>;

constexpr std::int16_t accepted = sizeof(CO_IF_FRM);  // result of Send and Read for a frame
const std::string interface = "lexicantest0";

// Runs the program ip of iproute2. Returns true if it succeeds.
bool ip(std::vector<std::string> words) {
  words.insert(words.begin(), "ip");
  std::vector<char*> arguments;
  for (std::string& word : words) {
    arguments.push_back(word.data());
  }
  arguments.push_back(nullptr);
  pid_t child = 0;
  int status = -1;
  return posix_spawnp(&child, "ip", nullptr, nullptr, arguments.data(), environ) == 0 &&
         waitpid(child, &status, 0) == child && status == 0;
}

// Returns true if the process is root and the kernel supports CAN.
bool has_can() {
  const int fd = ::socket(PF_CAN, SOCK_RAW, CAN_RAW);
  if (fd >= 0) {
    ::close(fd);
  }
  return fd >= 0 && ::geteuid() == 0;
}

// The virtual interface, which exists as long as the object.
class Interface {
 public:
  Interface() { add(); }
  ~Interface() { ip({"link", "del", interface}); }  // fails if the test has removed it
  Interface(const Interface&) = delete;
  Interface& operator=(const Interface&) = delete;
  void add() {
    REQUIRE(ip({"link", "add", "dev", interface, "type", "vcan"}));
    up();
  }
  void remove() { REQUIRE(ip({"link", "del", interface})); }
  void down() { REQUIRE(ip({"link", "set", interface, "down"})); }
  void up() { REQUIRE(ip({"link", "set", interface, "up"})); }
};

// A CAN adapter at a serial line (slcan) whose other end is not read: a blocked bus.
class StuckAdapter {
 public:
  StuckAdapter() {
    const int protocol = N_SLCAN;
    char name[IFNAMSIZ] = {};
    if (openpty(&master_, &line_, nullptr, nullptr, nullptr) == 0 && ::ioctl(line_, TIOCSETD, &protocol) == 0 &&
        ::ioctl(line_, SIOCGIFNAME, name) >= 0) {
      name_ = name;
    }
  }
  ~StuckAdapter() {
    ::close(line_);
    ::close(master_);
  }
  StuckAdapter(const StuckAdapter&) = delete;
  StuckAdapter& operator=(const StuckAdapter&) = delete;
  const std::string& name() const { return name_; }  // empty: the kernel does not support slcan

 private:
  int master_ = -1;
  int line_ = -1;
  std::string name_;
};

bool has_slcan() { return has_can() && !StuckAdapter().name().empty(); }

std::int16_t send(SocketCan& can, const char* text) { return can.send(test::frame(text)); }

// Waits until a frame can be read, at most 10 s: the kernel may deliver frames after Send has returned (ksoftirqd).
bool is_delivered(SocketCan& can) {
  pollfd wait{can.fd(), POLLIN, 0};
  return poll(&wait, 1, 10000) == 1;
}

// Reads all frames, and waits until a number of them is received.
Texts received(SocketCan& can, std::size_t expected = 0) {
  Texts texts;
  CO_IF_FRM frame{};
  do {
    while (can.read(frame) == accepted) {
      texts.push_back(test::notation(frame));
    }
  } while (texts.size() < expected && is_delivered(can));
  return texts;
}

}  // namespace

TEST_SUITE("needs root and a kernel with CAN, as in lane vcan" * doctest::skip(!has_can())) {
  TEST_CASE("socketcan on a bus: frames are sent with all flags and not received by their sender") {
    const Interface vcan;
    SocketCan a;
    SocketCan b;
    REQUIRE_MESSAGE(a.open(interface), a.error());
    REQUIRE(b.open(interface));
    CHECK(a.up());
    const Texts all = {"601#4008100000000000", "1ABCDEF0#01", "701#R", "000#", "20000040#0000000000000000"};
    for (const std::string& text : all) {
      CHECK(send(a, text.c_str()) == accepted);
    }
    CHECK(received(b, all.size()) == all);
    CHECK(received(a).empty());
    pollfd wait{b.fd(), POLLIN, 0};
    CHECK(poll(&wait, 1, 0) == 0);
    send(a, "123#");
    CHECK(is_delivered(b));
  }

  TEST_CASE("socketcan on a bus: only frames with an identifier of the filter and all error frames are received") {
    const Interface vcan;
    SocketCan a;
    SocketCan b;
    REQUIRE(a.open(interface));
    REQUIRE(b.open(interface));
    const std::uint32_t ids[] = {0x000, 0x605, CO_IF_FRM_EXT | 0x181u, 0x705};
    b.filter(ids, 4);
    for (const char* text : {"000#0101", "605#40", "606#40", "00000605#40", "181#", "00000181#", "705#", "705#R",
                             "20000040#0000000000000000", "20000080#0000000000000000"}) {
      send(a, text);
    }
    CHECK(received(b, 6) == Texts{"000#0101", "605#40", "00000181#", "705#", "705#R", "20000040#0000000000000000"});
    b.filter(ids, 0);
    send(a, "000#0101");
    send(a, "20000100#0000000000000000");
    CHECK(received(b, 1) == Texts{"20000100#0000000000000000"});
    b.close();
    b.enable();  // a new socket, the same filter
    send(a, "000#0101");
    CHECK(received(b).empty());
  }

  TEST_CASE("socketcan on a bus: with more identifiers than the kernel accepts all frames are received") {
    const Interface vcan;
    SocketCan a;
    SocketCan b;
    REQUIRE(a.open(interface));
    REQUIRE(b.open(interface));
    std::vector<std::uint32_t> ids;
    for (std::uint32_t id = 0; id < 512; ++id) {
      ids.push_back(id);
    }
    b.filter(ids.data(), 512);
    send(a, "1FF#");
    send(a, "200#");
    CHECK(received(b, 1) == Texts{"1FF#"});
    ids.push_back(512);
    b.filter(ids.data(), 513);
    send(a, "7FF#");
    CHECK(received(b, 1) == Texts{"7FF#"});
    CHECK(b.code() == 0);
  }

  TEST_CASE("socketcan on a bus: an interface going down is reported once and the socket works when it is up again") {
    Interface vcan;
    SocketCan a;
    SocketCan b;
    REQUIRE(a.open(interface));
    REQUIRE(b.open(interface));
    const std::uint32_t id = 0x605;
    b.filter(&id, 1);
    const int fd = b.fd();
    vcan.down();
    CO_IF_FRM frame{};
    CHECK_FALSE(b.up());
    CHECK(b.read(frame) == -1);
    CHECK(b.code() == ENETDOWN);
    CHECK(b.error() == "CAN interface 'lexicantest0': receiving failed: Network is down");
    CHECK(b.read(frame) == 0);
    CHECK(send(b, "585#60") == -1);
    CHECK(b.code() == ENETDOWN);
    vcan.up();
    received(a);
    CHECK(b.up());
    CHECK(b.fd() == fd);
    CHECK(send(b, "585#60") == accepted);
    CHECK(received(a, 1) == Texts{"585#60"});
    send(a, "606#40");
    send(a, "605#40");
    CHECK(received(b, 1) == Texts{"605#40"});
  }

  TEST_CASE("socketcan on a bus: an interface that is down can be opened and frames are sent when it is up") {
    Interface vcan;
    vcan.down();
    SocketCan can;
    CHECK(can.open(interface));
    CHECK_FALSE(can.up());
    can.enable();
    CHECK(send(can, "701#00") == -1);
    vcan.up();
    CHECK(send(can, "701#00") == accepted);
  }

  TEST_CASE("socketcan on a bus: a removed interface is reported and is opened with its filter when it is back") {
    Interface vcan;
    SocketCan b;
    REQUIRE(b.open(interface));
    const std::uint32_t id = 0x605;
    b.filter(&id, 1);
    vcan.remove();
    CO_IF_FRM frame{};
    int errors = 0;
    for (int i = 0; i < 10; ++i) {
      errors += (b.read(frame) == -1) ? 1 : 0;
    }
    const bool is_reported = errors == 1 || errors == 2;  // interface down, then removed
    CHECK(is_reported);
    CHECK(b.fd() == -1);
    CHECK(send(b, "585#60") == -1);
    CHECK(b.code() == ENODEV);
    vcan.add();
    SocketCan a;
    REQUIRE(a.open(interface));
    CHECK(b.read(frame) == 0);
    CHECK(b.fd() >= 0);
    send(a, "606#40");
    send(a, "605#40");
    CHECK(received(b, 1) == Texts{"605#40"});
    CHECK(send(b, "585#60") == accepted);
  }

  TEST_CASE("socketcan on a bus: frames dropped by the kernel are counted and reported as overrun") {
    const Interface vcan;
    SocketCan a;
    SocketCan b;
    REQUIRE(a.open(interface));
    REQUIRE(b.open(interface));
    const int small = 1;  // bytes; the kernel uses its minimum
    REQUIRE(::setsockopt(b.fd(), SOL_SOCKET, SO_RCVBUF, &small, sizeof small) == 0);
    SocketCan c;
    REQUIRE(c.open(interface));
    for (int i = 0; i < 200; ++i) {
      CHECK(send(a, "201#01") == accepted);
    }
    CHECK(received(c, 200).size() == 200);  // the kernel has delivered all frames, or dropped them
    const Texts before = received(b);
    CHECK(before.size() < 200);
    CHECK(b.lost() == 0);  // the kernel reports it with the next frame
    send(a, "201#02");
    CHECK(received(b, 2) == Texts{"201#02", "20000004#0001000000000000"});
    CHECK(b.lost() == 200 - before.size());
    send(a, "201#03");
    CHECK(received(b, 1) == Texts{"201#03"});
  }

  TEST_CASE("socketcan on a bus: a full transmit queue makes Send return 0 without an error" *
            doctest::skip(!has_slcan())) {
    const StuckAdapter adapter;
    REQUIRE(ip({"link", "set", adapter.name(), "up"}));
    SocketCan can;
    REQUIRE_MESSAGE(can.open(adapter.name()), can.error());
    std::int16_t result = accepted;
    for (int i = 0; i < 100000 && result == accepted; ++i) {
      result = send(can, "201#1122334455667788");
    }
    CHECK(result == 0);
    CHECK(can.code() == 0);
    CHECK(can.error().empty());
  }

  TEST_CASE("socketcan on a bus: Enable and Reset discard the frames received before") {
    const Interface vcan;
    SocketCan a;
    SocketCan b;
    REQUIRE(a.open(interface));
    REQUIRE(b.open(interface));
    send(a, "000#0101");
    CHECK(is_delivered(b));
    b.init();
    b.enable();
    CHECK(received(b).empty());
    send(a, "000#0101");
    CHECK(is_delivered(b));
    b.reset();
    CHECK(received(b).empty());
    send(a, "000#0201");
    CHECK(received(b, 1) == Texts{"000#0201"});
    b.close();
    CHECK(b.fd() == -1);
    CHECK(send(b, "705#00") == -1);
    CHECK(send(a, "000#0101") == accepted);
    b.enable();
    CHECK(received(b).empty());
    CHECK(send(b, "705#00") == accepted);
    CHECK(received(a, 1) == Texts{"705#00"});
  }

  TEST_CASE("socketcan on a bus: a failure to open is reported as text") {
    SocketCan can;
    CHECK_FALSE(can.open("lo"));
    CHECK(can.error() == "CAN interface 'lo': not a CAN interface");
    CHECK_FALSE(can.open("lexicannone0"));
    CHECK(can.error().find("no such interface") != std::string::npos);
    CHECK(can.code() == ENODEV);
  }
}

#endif
