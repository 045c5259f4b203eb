// SPDX-License-Identifier: Apache-2.0
// Access to a bus by an slcan adapter on a socket or a terminal, and their faults.
#include "co_cfg.h"

#if USE_CSDO && defined(__linux__)  // the demo's master requires USE_CSDO; terminals and sockets require Linux
#include <doctest/doctest.h>
#include <fcntl.h>
#include <stdlib.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <filesystem>
#include <memory>
#include <string>
#include <thread>

#include "host/slcan_host.hpp"
#include "support/notation.hpp"

namespace {

using lexican::Interruption;
using lexican::demo::SlcanHost;

constexpr std::int16_t taken = sizeof(CO_IF_FRM);

constexpr const char* needs_terminals = "needs pseudo-terminals: mount -t devpts devpts /dev/pts";
/// Returns true if pseudo-terminals exist. A chroot without the file system devpts has none.
bool has_terminals() {
  const int fd = ::posix_openpt(O_RDWR | O_NOCTTY);
  return fd >= 0 && ::close(fd) == 0;
}

/// Test side of the connection between a host and its adapter.
class Adapter {
 public:
  explicit Adapter(int fd) : fd_(fd) {}
  ~Adapter() { close(); }
  Adapter(const Adapter&) = delete;
  Adapter& operator=(const Adapter&) = delete;

  void send(const std::string& text) const { REQUIRE(::write(fd_, text.data(), text.size()) == ssize_t(text.size())); }
  /// Waits for at least \a least bytes, and returns all that have been received. Returns fewer if the connection ends.
  std::string receive(std::size_t least = 1) const {
    std::string received;
    char text[4096];
    while (received.size() < least) {
      const ssize_t size = ::read(fd_, text, sizeof text);
      if (size <= 0) {
        break;
      }
      received.append(text, static_cast<std::size_t>(size));
    }
    return received;
  }
  void close() {
    if (fd_ >= 0) {
      ::close(fd_);
    }
    fd_ = -1;
  }

 private:
  int fd_;
};

/// Waits minutes for a frame, for a busy machine: a terminal transfers bytes some time after they are sent, and a frame
/// in several parts. Returns its notation; empty: there was none.
std::string next_frame(SlcanHost& host, const lexican::Can& can) {
  CO_IF_FRM frame{};
  for (unsigned tries = 0; tries < 12000; ++tries) {
    if (can.driver->Read(can.context, &frame) > 0) {
      return test::notation(frame);
    }
    host.wait(50 * lexican::millisecond);
  }
  return {};
}

int listening_socket(const std::string& path) {
  std::filesystem::remove(path);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  path.copy(address.sun_path, sizeof address.sun_path - 1);
  const int fd = ::socket(AF_UNIX, SOCK_STREAM, 0);
  REQUIRE(::bind(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0);
  REQUIRE(::listen(fd, 1) == 0);
  return fd;
}

struct Line {
  Line() {
    const int fd = listening_socket(path);
    REQUIRE(host.open(path, 500000) == "");
    adapter = std::make_unique<Adapter>(::accept(fd, nullptr, nullptr));
    ::close(fd);
    std::filesystem::remove(path);
  }
  std::string read() {
    CO_IF_FRM frame{};
    return can.driver->Read(can.context, &frame) > 0 ? test::notation(frame) : std::string();
  }
  std::int16_t send(const char* text) {
    const CO_IF_FRM frame = test::frame(text);
    return can.driver->Send(can.context, &frame);
  }

  std::string path =
      (std::filesystem::temp_directory_path() / ("lexican_slcan_" + std::to_string(::getpid()))).string();
  Interruption interruption;
  SlcanHost host{interruption};
  lexican::Can can = host.master_can();
  std::unique_ptr<Adapter> adapter;
};

}  // namespace

TEST_CASE("slcan host: frames are sent over a socket in both directions after the commands that open the adapter") {
  Line line;
  line.can.driver->Init(line.can.context);
  line.can.driver->Enable(line.can.context, 0);
  CHECK(line.send("601#4000100000000000") == taken);
  CHECK(line.adapter->receive() == "C\rS6\rO\rt60184000100000000000\r");
  line.adapter->send("\r\r\rz\rt5818430010000");
  CHECK(line.read().empty());
  line.adapter->send("0000000\rt70117F\r");
  CHECK(line.read() == "581#4300100000000000");
  CHECK(line.read() == "701#7F");
  CHECK(line.read().empty());
  line.can.driver->Close(line.can.context);
  CHECK(line.adapter->receive() == "C\r");
  CHECK(line.host.bus_fault().empty());
}

TEST_CASE("slcan host: received bytes end a wait") {
  Line line;
  line.can.driver->Enable(line.can.context, 0);
  line.adapter->send("t0800\r");
  line.host.wait(lexican::for_ever / 1000000);
  CHECK(line.read() == "080#");
}

TEST_CASE("slcan host: no frame is lost when more are received than fit into the buffer") {
  Line line;
  line.can.driver->Enable(line.can.context, 0);
  constexpr unsigned number = 5000;
  std::thread adapter([&] {
    for (unsigned n = 0; n < number; ++n) {
      const std::string text = "t0010\r";
      line.adapter->send(text);
    }
  });
  unsigned received = 0;
  while (received < number) {
    const std::string frame = line.read();
    received += frame.empty() ? 0u : 1u;
    REQUIRE((frame.empty() || frame == "001#"));
  }
  adapter.join();
  CHECK(received == number);
}

TEST_CASE("slcan host: Send returns 0 for an adapter that accepts nothing, and sends all later") {
  Line line;
  std::string expected = "C\rS6\rO\r";
  line.can.driver->Enable(line.can.context, 0);
  unsigned sent = 0;
  for (; sent < 1000000 && line.send("601#4000100000000000") == taken; ++sent) {
    expected += "t60184000100000000000\r";
  }
  REQUIRE(sent < 1000000);
  std::string text;
  while (text.size() < expected.size()) {
    const std::string more = line.adapter->receive();
    REQUIRE(!more.empty());
    text += more;
    line.read();  // also continues the transmission
  }
  CHECK(text == expected);
  CHECK(line.send("080#") == taken);
}

TEST_CASE("slcan host: a removed adapter is reported as text, and no call blocks") {
  Line line;
  line.can.driver->Enable(line.can.context, 0);
  CHECK_FALSE(line.host.interrupted());
  line.adapter->close();
  CHECK(line.read().empty());
  CHECK(line.send("080#") == -1);
  CHECK(line.host.bus_fault().find("slcan adapter '" + line.path + "': ") == 0);
  CHECK(line.host.interrupted());
}

TEST_CASE("slcan host: a refusal of the adapter is reported") {
  Line line;
  line.can.driver->Enable(line.can.context, 0);
  line.adapter->send("\a");
  line.read();
  CHECK(line.host.bus_fault().find("has refused a command or a frame") != std::string::npos);
}

TEST_CASE("slcan host: a terminal transfers bytes unchanged" * doctest::test_suite(needs_terminals) *
          doctest::skip(!has_terminals())) {
  const int fd = ::posix_openpt(O_RDWR | O_NOCTTY);
  REQUIRE(fd >= 0);
  REQUIRE(::grantpt(fd) == 0);
  REQUIRE(::unlockpt(fd) == 0);
  char name[64];
  REQUIRE(::ptsname_r(fd, name, sizeof name) == 0);
  const Adapter adapter(fd);
  const Interruption interruption;
  SlcanHost host(interruption);
  REQUIRE(host.open(name, 0) == "");
  const lexican::Can can = host.master_can();
  can.driver->Enable(can.context, 0);
  CHECK(adapter.receive(4) == "C\rO\r");
  adapter.send("\rt70117F\r");
  CHECK(next_frame(host, can) == "701#7F");
}

TEST_CASE("slcan host: a failure to open is reported as text") {
  const Interruption interruption;
  SlcanHost host(interruption);
  CHECK(host.open("/no/such/adapter", 0) == "slcan adapter '/no/such/adapter': No such file or directory");
  CHECK(host.open("/", 0).find("slcan adapter '/': ") == 0);
}

TEST_CASE("slcan host: a pseudo-terminal transfers frames while another program has it open" *
          doctest::test_suite(needs_terminals) * doctest::skip(!has_terminals())) {
  const Interruption interruption;
  SlcanHost device(interruption);
  REQUIRE(device.open_pseudo_terminal() == "");
  const lexican::Can can = device.device_can();
  can.driver->Init(can.context);
  can.driver->Enable(can.context, 0);
  const CO_IF_FRM nobody = test::frame("705#00");
  for (unsigned n = 0; n < 10000; ++n) {
    REQUIRE(can.driver->Send(can.context, &nobody) == taken);  // discarded, so that no buffer overflows
  }
  for (const char* request : {"605#4000100000000000", "605#4008100000000000"}) {
    SlcanHost master(interruption);
    REQUIRE(master.open(device.path(), 0) == "");
    const lexican::Can other = master.master_can();
    other.driver->Init(other.context);
    other.driver->Enable(other.context, 0);
    const CO_IF_FRM frame = test::frame(request);
    REQUIRE(other.driver->Send(other.context, &frame) == taken);
    CHECK(next_frame(device, can) == request);
    const CO_IF_FRM answer = test::frame("585#4300100000000000");
    REQUIRE(can.driver->Send(can.context, &answer) == taken);
    CHECK(next_frame(master, other) == "585#4300100000000000");
  }
  CHECK(device.bus_fault().empty());
}

TEST_CASE("linux host: the time of the built-in bus advances only while the program waits") {
  const Interruption interruption;
  lexican::demo::VirtualBusHost host(interruption);
  const lexican::Timer timer = host.device_timer();
  timer.driver->Init(timer.context, 1000000);
  CHECK(host.now() == 0);
  ::usleep(20000);
  CHECK(host.now() == 0);
  host.wait(250 * lexican::millisecond);
  CHECK(host.now() == 250 * lexican::millisecond);
  host.wait(lexican::for_ever);  // no event can end it earlier
  CHECK(host.now() == 250 * lexican::millisecond + lexican::second);
}
#endif
