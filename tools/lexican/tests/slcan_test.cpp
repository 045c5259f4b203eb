// SPDX-License-Identifier: Apache-2.0
// slcan adapters on Unix sockets, TCP and pseudo-terminals of this process, and the pseudo-terminal that is an adapter.
#include <doctest/doctest.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <poll.h>
#include <stdlib.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <termios.h>
#include <unistd.h>

#include <chrono>
#include <cstring>
#include <filesystem>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "bus/open.hpp"
#include "host/bus_host.hpp"

namespace {

using namespace lexican::host_bus;
using Texts = std::vector<std::string>;

constexpr const char* gone = ": it is unplugged, or its other end is closed";
constexpr int timeout = 5000;  // ms; reached in a failing case only

CO_IF_FRM frame(const char* text) {
  CO_IF_FRM result{};
  REQUIRE(parse_frame(text, result) == Parsed::frame);
  return result;
}

/// Descriptor that is closed.
class Fd {
 public:
  Fd(int fd = -1) : fd_(fd) {}
  Fd(Fd&& from) noexcept : fd_(std::exchange(from.fd_, -1)) {}
  Fd& operator=(Fd&& from) noexcept {
    std::swap(fd_, from.fd_);
    from.reset();
    return *this;
  }
  ~Fd() { reset(); }
  void reset() {
    if (fd_ >= 0) {
      close(fd_);
    }
    fd_ = -1;
  }
  operator int() const { return fd_; }

 private:
  int fd_;
};

bool is_ready(pollfd wanted, int time) { return poll(&wanted, 1, time) > 0; }

/// Returns the bytes that can be read at once.
std::string read_now(int fd) {
  std::string text;
  char bytes[4096];
  while (is_ready({fd, POLLIN, 0}, 0)) {
    const ssize_t size = ::read(fd, bytes, sizeof bytes);
    if (size <= 0) {
      break;
    }
    text.append(bytes, static_cast<std::size_t>(size));
  }
  return text;
}

/// Reads until \a size bytes have come, and those that can be read at once.
std::string read_text(int fd, std::size_t size) {
  std::string text;
  while (text.size() < size && is_ready({fd, POLLIN, 0}, timeout)) {
    const std::string more = read_now(fd);
    if (more.empty()) {
      break;
    }
    text += more;
  }
  return text;
}

/// Sends text to a bus, and lets it read meanwhile. Returns all frames that the bus has received.
Texts write_text(int fd, const std::string& text, Bus& bus) {
  Texts frames;
  const auto read = [&] {
    while (const std::optional<Entry> entry = bus.receive()) {
      CHECK(entry->direction == Direction::received);
      frames.push_back(to_text(entry->frame));
    }
  };
  for (std::size_t begin = 0; begin < text.size();) {
    const ssize_t size = ::write(fd, text.data() + begin, std::min<std::size_t>(text.size() - begin, 1000));
    REQUIRE(size > 0);
    begin += static_cast<std::size_t>(size);
    REQUIRE(is_ready(bus.wanted(), timeout));
    read();
  }
  read();
  return frames;
}

std::unique_ptr<Bus> open_good(const std::string& name, const BusOptions& options = {}) {
  std::string why;
  std::unique_ptr<Bus> bus = open_bus(name, options, why);
  REQUIRE_MESSAGE(bus != nullptr, why);
  CHECK(bus->fault().empty());
  CHECK(bus->is_physical());
  return bus;
}

std::string error_of(const std::string& name, const BusOptions& options = {}) {
  std::string why;
  CHECK(open_bus(name, options, why) == nullptr);
  return why;
}

/// A Unix socket that accepts a program as its adapter.
class Adapter {
 public:
  Adapter() {
    char name[] = "/tmp/lexican-test-XXXXXX";
    directory_ = mkdtemp(name);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strcpy(address.sun_path, path().c_str());
    listener_ = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    REQUIRE(bind(listener_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0);
    REQUIRE(listen(listener_, 1) == 0);
  }
  ~Adapter() { std::filesystem::remove_all(directory_); }
  Adapter(const Adapter&) = delete;
  Adapter& operator=(const Adapter&) = delete;

  std::string path() const { return directory_ + "/socket"; }
  Fd accept() const {
    REQUIRE(is_ready({listener_, POLLIN, 0}, timeout));
    return ::accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC);
  }

 private:
  std::string directory_;
  Fd listener_;
};

/// A bus with an adapter that has received the commands.
struct Connected {
  explicit Connected(const BusOptions& options = {}) : bus(open_good("slcan:" + adapter.path(), options)) {
    peer = adapter.accept();
    commands = read_text(peer, 4);
  }

  Texts receive(const std::string& text) { return write_text(peer, text, *bus); }

  Adapter adapter;
  std::unique_ptr<Bus> bus;
  Fd peer;
  std::string commands;
};

/// slcan-pty, and another program that has opened it.
struct Pty {
  Pty() : bus(open_good("slcan-pty")) {
    const std::string begin = "slcan adapter at ";
    REQUIRE(bus->note().substr(0, begin.size()) == begin);
    path = bus->note().substr(begin.size());
  }

  void open() {
    peer = ::open(path.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
    REQUIRE(peer >= 0);
  }

  /// Sends text as the other program, and returns the answer, of \a size bytes.
  std::string ask(const std::string& text, std::size_t size) {
    frames = write_text(peer, text, *bus);
    return read_text(peer, size);
  }

  std::unique_ptr<Bus> bus;
  std::string path;
  Fd peer;
  Texts frames;
};

/// A listening TCP socket.
struct TcpAdapter {
  explicit TcpAdapter(int family = AF_INET) : listener(socket(family, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in6 address{};
    address.sin6_family = static_cast<sa_family_t>(family);
    address.sin6_addr = in6addr_loopback;
    socklen_t size = sizeof address;
    if (family == AF_INET) {
      auto& v4 = reinterpret_cast<sockaddr_in&>(address);
      v4 = {};
      v4.sin_family = AF_INET;
      v4.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
      size = sizeof v4;
    }
    is_available = listener >= 0 && bind(listener, reinterpret_cast<const sockaddr*>(&address), size) == 0;
    REQUIRE((!is_available || listen(listener, 1) == 0));
    getsockname(listener, reinterpret_cast<sockaddr*>(&address), &size);
    port = std::to_string(ntohs(address.sin6_port));  // sin_port has the same place
  }

  Fd accept() const {
    REQUIRE(is_ready({listener, POLLIN, 0}, timeout));
    return ::accept4(listener, nullptr, nullptr, SOCK_CLOEXEC);
  }

  Fd listener;
  bool is_available = false;
  std::string port;
};

}  // namespace

TEST_CASE("slcan: the commands of opening, with the rate of the options, of the name, or none") {
  const std::pair<const char*, const char*> names[] = {
      {"", "C\rO\r"},          {"@10k", "C\rS0\rO\r"},  {"@20k", "C\rS1\rO\r"},   {"@50k", "C\rS2\rO\r"},
      {"@100k", "C\rS3\rO\r"}, {"@125k", "C\rS4\rO\r"}, {"@250k", "C\rS5\rO\r"},  {"@500k", "C\rS6\rO\r"},
      {"@800k", "C\rS7\rO\r"}, {"@1M", "C\rS8\rO\r"},   {"@500000", "C\rS6\rO\r"}};
  const Adapter adapter;
  for (const auto& [rate, commands] : names) {
    const std::unique_ptr<Bus> bus = open_good("slcan:" + adapter.path() + rate);
    CHECK(read_text(adapter.accept(), std::strlen(commands)) == commands);
  }
  const std::unique_ptr<Bus> bus = open_good("slcan:" + adapter.path() + "@500k", {250000, false});
  CHECK(bus->bit_rate() == 250000);
  CHECK(read_text(adapter.accept(), 7) == "C\rS5\rO\r");
  CHECK(open_good("slcan:" + adapter.path() + "@1M")->bit_rate() == 1000000);
}

TEST_CASE("slcan: the command L for a bus that listens only, and nothing is sent") {
  Connected at({500000, true});
  CHECK(at.commands == "C\rS6\rL\r");
  CHECK_FALSE(at.bus->send(frame("123#")));
  CHECK(at.receive("t1230\r") == Texts{"123#"});
  at.bus.reset();
  CHECK(read_text(at.peer, 2) == "C\r");
}

TEST_CASE("slcan: rate and mode are set again") {
  Connected at({0, true});
  CHECK(at.commands == "C\rL\r");
  CHECK(at.bus->configure({250000, true}));
  CHECK(read_text(at.peer, 7) == "C\rS5\rL\r");
  CHECK(at.bus->bit_rate() == 250000);
  CHECK(at.bus->configure({250000, true, true}));
  CHECK(read_text(at.peer, 7) == "C\rS5\rO\r");
  CHECK_FALSE(at.bus->send(frame("123#")));
  CHECK(at.bus->configure({125000, false}));
  CHECK(read_text(at.peer, 7) == "C\rS4\rO\r");
  CHECK(at.bus->send(frame("123#")));
  CHECK(read_text(at.peer, 6) == "t1230\r");
  CHECK_FALSE(at.bus->configure({83333, false}));
  CHECK(at.bus->bit_rate() == 125000);
  CHECK(needs_rate("slcan:/dev/x", {}));
  CHECK_FALSE(needs_rate("slcan:/dev/x@500k", {}));
  CHECK_FALSE(needs_rate("slcan:/dev/x", {500000}));
  CHECK_FALSE(needs_rate("hub:x", {}));
}

TEST_CASE("slcan: a rate that the protocol does not have") {
  const std::string has = "; it has 10, 20, 50, 100, 125, 250, 500, 800 and 1000 kbit/s";
  CHECK(error_of("slcan:/dev/null@300k") == "slcan does not have 300000 bit/s" + has);
  CHECK(error_of("slcan:/dev/null", {83333, false}) == "slcan does not have 83333 bit/s" + has);
  for (const std::string name : {"", "k", "0", "-1", "5G", "500kk", "4295M", "99999999999"}) {
    CHECK(error_of("slcan:/dev/null@" + name) == "'" + name + "' is not a bit rate, such as 500k, 1M or 500000");
  }
}

TEST_CASE("slcan: a device that cannot be opened") {
  CHECK(error_of("slcan:/no/such") == "slcan adapter /no/such: No such file or directory");
  CHECK(error_of("slcan:/no@500k/such") == "slcan adapter /no@500k/such: No such file or directory");
  CHECK(error_of("slcan:") == "slcan needs a device, such as /dev/ttyACM0");
  CHECK(error_of("slcan:/dev/null") == "slcan adapter /dev/null: it is not a serial device");
}

TEST_CASE("slcan: frames in both directions, with the time of reading") {
  Connected at;
  CHECK(at.commands == "C\rO\r");
  CHECK(at.bus->bit_rate() == 0);
  const auto now = [] {
    return static_cast<Micros>(
        std::chrono::duration_cast<std::chrono::microseconds>(std::chrono::system_clock::now().time_since_epoch())
            .count());
  };
  const Micros before = now();
  REQUIRE(::write(at.peer, "t1232AABB\r", 10) == 10);
  REQUIRE(is_ready(at.bus->wanted(), timeout));
  const std::optional<Entry> entry = at.bus->receive();
  REQUIRE(entry);
  CHECK(to_text(entry->frame) == "123#AABB");
  CHECK(entry->time >= before);
  CHECK(entry->time <= now());
  CHECK(at.receive("\r\rz\rT1234567881122334455667788\rr7FF4\rR000000010\rt10011F12A0\r") ==
        Texts{"12345678#1122334455667788", "7FF#R4", "00000001#R", "100#1F"});
  CHECK(at.receive("t12") == Texts{});
  CHECK(at.receive("30\rt4") == Texts{"123#"});
  CHECK(at.bus->lost() == 0);
  for (const char* text :
       {"123#AABB", "12345678#1122334455667788", "7FF#R4", "00000001#R", "20000004#0000000000000000"}) {
    CHECK(at.bus->send(frame(text)));
  }
  CHECK(read_text(at.peer, 54) == "t1232AABB\rT1234567881122334455667788\rr7FF4\rR000000010\r");
}

TEST_CASE("slcan: lines that are not a frame are counted, and the frames after them are received") {
  Connected at;
  const std::string nul(
      "t1\0"
      "30\r",
      6);
  std::uint64_t lost = 0;
  for (const std::string& line :
       {std::string(10000, '0') + "\r", std::string(10000, 't') + "\r", nul, std::string(1, '\0') + "\r",
        std::string("tXYZ0\r"), std::string("t1239112233445566778899\r"), std::string("t8000\r"),
        std::string("T200000000\r"), std::string("TFFFFFFFF0\r"), std::string("t1231\r"), std::string("t12311\n\r"),
        std::string("t12\xFF\x80\r"), std::string("t\r"), std::string("W\r"), std::string("r12311\r")}) {
    CAPTURE(line.substr(0, 40));
    CHECK(at.receive(line + "t1230\r") == Texts{"123#"});
    CHECK(at.bus->lost() == ++lost);
  }
  constexpr char characters[] = "tTrRzZ0123456789abcdefV\r\r\a\n";
  std::mt19937 random(1);
  for (unsigned n = 0; n < 200; ++n) {
    std::string bytes(1000, ' ');
    for (char& byte : bytes) {
      byte = characters[random() % sizeof characters];
    }
    at.receive(bytes);
  }
  CHECK(at.bus->fault().empty());
  const Texts last = at.receive("\rt1230\r");
  REQUIRE(!last.empty());
  CHECK(last.back() == "123#");
}

TEST_CASE("slcan: a call of receive() returns after 16 KiB without a frame, and no frame waits for further bytes") {
  Connected at;
  const std::string filler(64 * 256 - 6, '\r');
  const std::string text = filler + "t1230\r";
  REQUIRE(::write(at.peer, text.data(), text.size()) == static_cast<ssize_t>(text.size()));
  const std::optional<Entry> entry = at.bus->receive();
  REQUIRE(entry);
  CHECK(entry->frame.Identifier == 0x123);
  const std::string longer = filler + text;
  REQUIRE(::write(at.peer, longer.data(), longer.size()) == static_cast<ssize_t>(longer.size()));
  CHECK(!at.bus->receive());
  CHECK(is_ready(at.bus->wanted(), 0));
  CHECK(at.bus->receive());
}

TEST_CASE("slcan: an adapter that does not read: frames wait, and none is lost") {
  Connected at;
  std::string expected;
  unsigned sent = 0;
  const auto send = [&] {
    const unsigned before = sent;
    for (; sent < 100000; ++sent) {
      CO_IF_FRM next = frame("123#00000000");
      std::memcpy(next.Data, &sent, sizeof sent);
      if (!at.bus->send(next)) {
        break;
      }
      char line[20];
      snprintf(line, sizeof line, "t1234%02X%02X%02X%02X\r", next.Data[0], next.Data[1], next.Data[2], next.Data[3]);
      expected += line;
    }
    return sent - before;
  };
  REQUIRE(send() > 100);
  REQUIRE(sent < 100000);
  CHECK((at.bus->wanted().events & POLLOUT) != 0);
  CHECK_FALSE(is_ready({at.bus->wanted().fd, POLLOUT, 0}, 0));
  CHECK(at.receive("t4560\r") == Texts{"456#"});
  CHECK_FALSE(at.bus->send(frame("123#00000000")));
  std::string text = read_now(at.peer);
  REQUIRE(is_ready({at.bus->wanted().fd, POLLOUT, 0}, timeout));
  at.bus->receive();
  CHECK((at.bus->wanted().events & POLLOUT) != 0);  // for the frame that was refused
  CHECK(send() > 100);
  text += read_now(at.peer);
  at.bus->receive();
  text += read_text(at.peer, expected.size() - text.size());
  CHECK(text == expected);
  CHECK(at.bus->fault().empty());
}

TEST_CASE("slcan: an adapter that goes and comes back") {
  Connected at({125000, false});
  CHECK(at.commands == "C\rS4\rO\r");
  CHECK(at.receive("t1239\rt1230\r") == Texts{"123#"});
  REQUIRE(::write(at.peer, "t4560\r", 6) == 6);
  at.peer.reset();
  std::optional<Entry> entry = at.bus->receive();
  REQUIRE(entry);
  CHECK(entry->frame.Identifier == 0x456);
  CHECK(!at.bus->receive());
  CHECK(at.bus->fault() == "slcan adapter " + at.adapter.path() + gone);
  CHECK(at.bus->wanted().fd == -1);
  CHECK_FALSE(at.bus->send(frame("123#")));
  CHECK(!at.bus->receive());
  const std::string moved = at.adapter.path() + "2";
  std::filesystem::rename(at.adapter.path(), moved);
  CHECK_FALSE(at.bus->restore());
  CHECK(at.bus->fault() == "slcan adapter " + at.adapter.path() + ": No such file or directory");
  std::filesystem::rename(moved, at.adapter.path());
  CHECK(at.bus->restore());
  CHECK(at.bus->restore());
  CHECK(at.bus->fault().empty());
  at.peer = at.adapter.accept();
  CHECK(read_text(at.peer, 7) == "C\rS4\rO\r");
  CHECK(at.bus->send(frame("123#")));
  CHECK(read_text(at.peer, 6) == "t1230\r");
  CHECK(at.receive("t1239\rt7FF0\r") == Texts{"7FF#"});
  CHECK(at.bus->lost() == 2);
}

TEST_CASE("slcan: a write reports that the adapter has gone") {
  Connected at;
  at.peer.reset();
  CHECK_FALSE(at.bus->send(frame("123#")));
  CHECK(at.bus->fault() == "slcan adapter " + at.adapter.path() + gone);
  CHECK(at.bus->wanted().fd == -1);
}

TEST_CASE("slcan: the name of a command or a frame that the adapter has refused") {
  const std::pair<const char*, const char*> answers[] = {{"\r\r\r", ""},
                                                         {"\a\r\r", ""},
                                                         {"\r\a\r", "the command S6"},
                                                         {"\r\r\a", "the command L"},
                                                         {"\r\r\rz\r\a", "a frame"},
                                                         {"\a\r\rt1230\r", ""},
                                                         {"\a\r\a\a", "the command L"}};
  for (const auto& [answer, refused] : answers) {
    Connected at({500000, true});
    CHECK(at.bus->refusal().empty());
    at.receive(answer);
    const std::string begin = *refused == '\0' ? "" : "slcan adapter " + at.adapter.path() + " has refused ";
    CHECK(at.bus->refusal() == begin + refused);
  }
}

TEST_CASE("slcan: a node of the stack uses a bus: a wait ends with a frame, refusals and the end are faults") {
  using lexican::BusHost;
  const lexican::Interruption interruption;
  for (const BusHost::Role role : {BusHost::Role::master, BusHost::Role::device}) {
    Connected at;
    BusHost host(*at.bus, interruption, role);
    const lexican::Can can = host.master_can();
    CO_IF_FRM received{};
    CHECK(can.driver->Read(can.context, &received) == 0);
    REQUIRE(::write(at.peer, "t0800\r", 6) == 6);
    while (can.driver->Read(can.context, &received) == 0) {
      host.wait(lexican::for_ever);
    }
    CHECK(to_text(received) == "080#");
    const CO_IF_FRM boot_up = frame("705#00");
    CHECK(can.driver->Send(can.context, &boot_up) == sizeof boot_up);
    CHECK(read_text(at.peer, 8) == "t705100\r");
    CHECK(host.bus_fault().empty());
    at.receive("\r\r\a");
    CHECK(host.bus_fault() ==
          "slcan adapter " + at.adapter.path() + " has refused a frame; it may need a bit rate: @500k");
    CHECK_FALSE(host.bus_lost());
    at.peer.reset();
    CHECK(can.driver->Read(can.context, &received) == -1);
    CHECK(can.driver->Send(can.context, &boot_up) == -1);
    CHECK(host.bus_fault() == "slcan adapter " + at.adapter.path() + gone);
    CHECK(host.bus_lost());
    CHECK(host.interrupted() == (role == BusHost::Role::master));
    host.wait(0);
    CHECK_FALSE(host.bus_lost());  // opened again
  }
}

TEST_CASE("slcan: a serial device, pulled out and plugged in again") {
  char name[] = "/tmp/lexican-test-XXXXXX";
  const std::string directory = mkdtemp(name);
  const std::string path = directory + "/tty";
  const auto plug_in = [&] {
    Fd device = posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
    REQUIRE(grantpt(device) == 0);
    REQUIRE(unlockpt(device) == 0);
    termios settings{};
    REQUIRE(tcgetattr(device, &settings) == 0);
    cfmakeraw(&settings);  // no echo
    REQUIRE(tcsetattr(device, TCSANOW, &settings) == 0);
    REQUIRE(::write(device, "t0010\r", 6) == 6);  // before it is opened
    std::filesystem::remove(path);
    std::filesystem::create_symlink(ptsname(device), path);
    return device;
  };
  Fd device = plug_in();
  const std::unique_ptr<Bus> bus = open_good("slcan:" + path + "@500k");
  CHECK(read_text(device, 7) == "C\rS6\rO\r");
  CHECK(bus->send(frame("123#0D0A")));
  CHECK(read_text(device, 10) ==
        "t1232"
        "0D0A\r");
  CHECK(write_text(device, "z\rt1232AABB\r", *bus) == Texts{"123#AABB"});
  device.reset();
  CHECK(is_ready(bus->wanted(), timeout));
  CHECK(!bus->receive());
  CHECK(bus->fault() == "slcan adapter " + path + gone);
  CHECK(bus->wanted().fd == -1);
  CHECK_FALSE(bus->restore());
  device = plug_in();
  CHECK(bus->restore());
  CHECK(read_text(device, 7) == "C\rS6\rO\r");
  CHECK(write_text(device, "t1230\r", *bus) == Texts{"123#"});
  std::filesystem::remove_all(directory);
}

TEST_CASE("slcan: a serial device is used by one program at a time") {
  const Pty pty;
  const std::string name = "slcan:" + pty.path;
  std::unique_ptr<Bus> bus = open_good(name);
  CHECK(error_of(name) == "slcan adapter " + pty.path + ": another program uses it; lexican share hands it to several");
  bus.reset();
  open_good(name);
}

TEST_CASE("slcan: a serial device that does not read does not delay the end of the program for long") {
  Fd device = posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
  REQUIRE(grantpt(device) == 0);
  REQUIRE(unlockpt(device) == 0);
  std::unique_ptr<Bus> bus = open_good(std::string("slcan:") + ptsname(device));
  unsigned sent = 0;
  while (sent < 100000 && bus->send(frame("12345678#1122334455667788"))) {
    ++sent;
  }
  REQUIRE(sent < 100000);
  const auto begin = std::chrono::steady_clock::now();
  bus.reset();
  CHECK(std::chrono::steady_clock::now() - begin < std::chrono::seconds(3));
}

TEST_CASE("slcan-tcp: an adapter behind TCP goes and comes back") {
  TcpAdapter adapter;
  REQUIRE(adapter.is_available);
  const std::string address = "127.0.0.1:" + adapter.port;
  const std::unique_ptr<Bus> bus = open_good("slcan-tcp:" + address + "@500k", {0, true});
  CHECK(bus->bit_rate() == 500000);
  Fd peer = adapter.accept();
  CHECK(read_text(peer, 7) == "C\rS6\rL\r");
  CHECK(write_text(peer, "t1232AABB\r", *bus) == Texts{"123#AABB"});
  peer.reset();
  CHECK(is_ready(bus->wanted(), timeout));
  CHECK(!bus->receive());
  CHECK(bus->fault() == "slcan adapter " + address + gone);
  CHECK(bus->wanted().fd == -1);
  for (unsigned n = 0; n < 1000 && !bus->restore(); ++n) {
    CHECK(bus->wanted().fd == -1);
    poll(nullptr, 0, 5);
  }
  CHECK(bus->fault().empty());
  peer = adapter.accept();
  CHECK(read_text(peer, 7) == "C\rS6\rL\r");
  CHECK(write_text(peer, "t1230\r", *bus) == Texts{"123#"});
}

TEST_CASE("slcan-tcp: names and IPv6 addresses") {
  TcpAdapter adapter;
  const std::unique_ptr<Bus> bus = open_good("slcan-tcp:localhost:" + adapter.port);
  Fd peer = adapter.accept();
  CHECK(read_text(peer, 4) == "C\rO\r");
  CHECK(bus->send(frame("123#")));
  CHECK(read_text(peer, 6) == "t1230\r");
  TcpAdapter v6(AF_INET6);
  if (v6.is_available) {
    const std::unique_ptr<Bus> other = open_good("slcan-tcp:[::1]:" + v6.port + "@1M");
    CHECK(read_text(v6.accept(), 7) == "C\rS8\rO\r");
  }
}

TEST_CASE("slcan-tcp: an adapter that cannot be reached, and names that are not an address") {
  std::string port;
  {
    const TcpAdapter closed;
    port = closed.port;
  }
  CHECK(error_of("slcan-tcp:127.0.0.1:" + port) == "slcan adapter 127.0.0.1:" + port + ": Connection refused");
  for (const char* name : {"", "host", ":1", "host:", "host:x", "host:0", "host:65536", "host:-1", "::1:5", "[]:5"}) {
    CHECK(error_of(std::string("slcan-tcp:") + name) ==
          "'" + std::string(name) + "' is not HOST:PORT, such as 127.0.0.1:29537 or [::1]:29537");
  }
  CHECK(error_of("slcan-tcp:127.0.0.1:5@7k").find("slcan does not have 7000 bit/s") == 0);
}

TEST_CASE("slcan-tcp: opening ends after two seconds") {
  // A queue of connections that is full: further ones are not answered.
  const Fd listener = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  REQUIRE(bind(listener, reinterpret_cast<const sockaddr*>(&address), size) == 0);
  REQUIRE(listen(listener, 0) == 0);
  REQUIRE(getsockname(listener, reinterpret_cast<sockaddr*>(&address), &size) == 0);
  std::vector<Fd> clients;
  for (unsigned n = 0; n < 4; ++n) {
    clients.emplace_back(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
    connect(clients.back(), reinterpret_cast<const sockaddr*>(&address), size);
  }
  const std::string name = "127.0.0.1:" + std::to_string(ntohs(address.sin_port));
  const auto begin = std::chrono::steady_clock::now();
  CHECK(error_of("slcan-tcp:" + name) == "slcan adapter " + name + ": Connection timed out");
  const auto time = std::chrono::steady_clock::now() - begin;
  CHECK(time >= std::chrono::milliseconds(1900));
  CHECK(time < std::chrono::seconds(10));
}

TEST_CASE("slcan-pty: answers to the commands of another program") {
  Pty pty;
  pty.open();
  const std::pair<const char*, const char*> lines[] = {{"C\r", "\r"},
                                                       {"V\r", "V1013\r"},
                                                       {"N\r", "N0001\r"},
                                                       {"F\r", "F00\r"},
                                                       {"S0\r", "\r"},
                                                       {"S8\r", "\r"},
                                                       {"S9\r", "\a"},
                                                       {"S\r", "\a"},
                                                       {"S66\r", "\a"},
                                                       {"SX\r", "\a"},
                                                       {"S-\r", "\a"},
                                                       {"S6\r", "\r"},
                                                       {"t1230\r", "\a"},
                                                       {"O\r", "\r"},
                                                       {"S5\r", "\a"},
                                                       {"t1230\r", "z\r"},
                                                       {"r1230\r", "z\r"},
                                                       {"T00000001"
                                                        "0\r",
                                                        "Z\r"},
                                                       {"R000000010\r", "Z\r"},
                                                       {"t1239\r", "\a"},
                                                       {"t8000\r", "\a"},
                                                       {"X\r", "\a"},
                                                       {"\r", "\r"},
                                                       {"Ox\r", "\a"},
                                                       {"V\n\r", "\a"},
                                                       {"\nV\r", "V1013\r"},
                                                       {"F\r", "F00\r"},
                                                       {"C\r", "\r"},
                                                       {"t1230\r", "\a"},
                                                       {"L\r", "\r"},
                                                       {"t1230\r", "\a"},
                                                       {"C\r", "\r"},
                                                       {"C\r", "\r"}};
  for (const auto& line : lines) {
    CAPTURE(line.first);
    CHECK(pty.ask(line.first, std::strlen(line.second)) == line.second);
  }
  CHECK(pty.ask("V\rN\rO\rt1230\r", 15) == "V1013\rN0001\r\rz\r");
  CHECK(pty.ask(std::string(1, '\0') + "\r", 1) == "\a");
  CHECK(pty.bus->bit_rate() == 500000);
  CHECK(pty.bus->fault().empty());
}

TEST_CASE("slcan-pty: frames are sent after O or L, and received after O") {
  Pty pty;
  CHECK(pty.bus->send(frame("001#")));
  pty.open();
  CHECK(pty.bus->send(frame("002#")));
  CHECK(pty.ask("t0030\rL\rt0040\r", 3) == "\a\r\a");
  CHECK(pty.frames.empty());
  CHECK(pty.bus->send(frame("005#R2")));
  CHECK(read_text(pty.peer, 6) == "r0052\r");
  CHECK(pty.ask("C\rO\rt006211"
                "22\rR123456788\r",
                6) == "\r\rz\rZ\r");
  CHECK(pty.frames == Texts{"006#1122", "12345678#R8"});
  CHECK(pty.bus->send(frame("12345678#01")));
  CHECK(read_text(pty.peer, 13) == "T12345678101\r");
  CHECK(pty.ask("C\r", 1) == "\r");
  CHECK(pty.bus->send(frame("007#")));
  CHECK(pty.ask("V\r", 6) == "V1013\r");
  CHECK(pty.bus->lost() == 0);
}

TEST_CASE("slcan-pty: a program that ends is not a fault, and the next one begins with a closed channel") {
  Pty pty;
  CHECK(pty.bus->wanted().fd >= 0);
  CHECK_FALSE(is_ready(pty.bus->wanted(), 0));  // a hang-up would be reported at once
  for (unsigned n = 0; n < 3; ++n) {
    const pollfd idle = pty.bus->wanted();
    pty.open();
    CHECK(is_ready(idle, timeout));
    CHECK(!pty.bus->receive());
    CHECK_FALSE(is_ready(pty.bus->wanted(), 0));
    CHECK(pty.ask("t0000\r", 1) == "\a");
    CHECK(pty.ask("O\rt12", 1) == "\r");
    CHECK(pty.bus->send(frame("123#")));
    CHECK(read_text(pty.peer, 6) == "t1230\r");
    REQUIRE(::write(pty.peer, "30\rt45", 6) == 6);
    pty.peer.reset();
    CHECK(is_ready(pty.bus->wanted(), timeout));
    const std::optional<Entry> entry = pty.bus->receive();
    REQUIRE(entry);
    CHECK(to_text(entry->frame) == "123#");
    CHECK(!pty.bus->receive());
    CHECK(pty.bus->fault().empty());
    CHECK(pty.bus->wanted().fd >= 0);
    CHECK(pty.bus->restore());
    CHECK(pty.bus->send(frame("124#")));
    CHECK(!pty.bus->receive());  // the bus has opened the pseudo-terminal once, to discard bytes
    CHECK_FALSE(is_ready(pty.bus->wanted(), 0));
  }
}

TEST_CASE("slcan-pty: a program that does not read: frames wait, and are discarded when it ends") {
  Pty pty;
  pty.open();
  CHECK(pty.ask("O\r", 1) == "\r");
  unsigned sent = 0;
  while (sent < 100000 && pty.bus->send(frame("12345678#1122334455667788"))) {
    ++sent;
  }
  REQUIRE(sent < 100000);
  CHECK((pty.bus->wanted().events & POLLOUT) != 0);
  CHECK_FALSE(is_ready({pty.bus->wanted().fd, POLLOUT, 0}, 0));
  pty.peer.reset();
  CHECK(is_ready(pty.bus->wanted(), timeout));
  CHECK(!pty.bus->receive());
  CHECK(is_ready({pty.bus->wanted().fd, POLLOUT, 0}, timeout));
  CHECK(pty.bus->send(frame("123#")));
  CHECK(pty.bus->fault().empty());
  CHECK(!pty.bus->receive());
  CHECK_FALSE(is_ready(pty.bus->wanted(), 0));
}

TEST_CASE("slcan-pty: the next program does not receive frames that the last one has not read") {
  Pty pty;
  pty.open();
  CHECK(pty.ask("O\r", 1) == "\r");
  for (unsigned n = 0; n < 100; ++n) {
    CHECK(pty.bus->send(frame("123#")));
  }
  pty.peer.reset();
  CHECK(!pty.bus->receive());
  pty.open();
  CHECK(pty.ask("V\r", 6) == "V1013\r");
}

TEST_CASE("slcan-pty: a bus of the kind slcan opens it") {
  Pty pty;
  const std::unique_ptr<Bus> other = open_good("slcan:" + pty.path + "@250k");
  CHECK(is_ready(pty.bus->wanted(), timeout));
  CHECK(!pty.bus->receive());
  CHECK(pty.bus->bit_rate() == 250000);
  const auto transfer = [](Bus& from, Bus& to) {
    unsigned received = 0;
    for (unsigned sent = 0; received < 2000;) {
      sent += sent < 2000 && from.send({0x10000000 + sent, {1, 2, 3, 4, 5, 6, 7, 8}, 8}) ? 1U : 0U;
      const std::optional<Entry> entry = to.receive();
      CHECK(!from.receive());
      if (entry) {
        CHECK(entry->frame.Identifier == ((0x10000000 + received) | CO_IF_FRM_EXT));
        ++received;
      }
      if (!entry && sent == 2000 && !is_ready(to.wanted(), timeout)) {
        break;
      }
    }
    return received;
  };
  CHECK(transfer(*other, *pty.bus) == 2000);
  CHECK(transfer(*pty.bus, *other) == 2000);
  CHECK(other->lost() == 0);
  CHECK(pty.bus->lost() == 0);
  CHECK(other->refusal().empty());
}

TEST_CASE("slcan-pty: a program that asks and does not read the answers") {
  Pty pty;
  pty.open();
  REQUIRE(fcntl(pty.peer, F_SETFL, O_NONBLOCK) == 0);
  const std::string questions(1000, 'V');
  std::string lines;
  for (const char letter : questions) {
    lines += {letter, '\r'};
  }
  unsigned written = 0;
  for (ssize_t size = 1; size > 0 && written < 100000000; written += static_cast<unsigned>(size)) {
    size = std::max<ssize_t>(::write(pty.peer, lines.data(), lines.size()), 0);
    CHECK(!pty.bus->receive());
  }
  REQUIRE(written < 100000000);
  CHECK(pty.bus->wanted().events == POLLOUT);
  std::string answers;
  while (is_ready({pty.peer, POLLIN, 0}, 0)) {
    answers += read_now(pty.peer);
    CHECK(!pty.bus->receive());
  }
  CHECK(answers.size() == written / 2 * 6);
  CHECK(pty.bus->fault().empty());
}

TEST_CASE("slcan-pty: hostile lines") {
  Pty pty;
  pty.open();
  CHECK(pty.ask("O\r", 1) == "\r");
  std::uint64_t lost = 0;
  for (const std::string& line : {"t" + std::string(10000, '0'), std::string("tXYZ0"), std::string("t1239"),
                                  std::string("t8000"), std::string("T200000000"),
                                  std::string("t1\0"
                                              "30",
                                              5),
                                  std::string("R12")}) {
    CHECK(pty.ask(line + "\r", 1) == "\a");
    CHECK(pty.frames.empty());
    CHECK(pty.bus->lost() == ++lost);
  }
  CHECK(pty.ask(std::string(10000, 'V') + "\r", 1) == "\a");
  CHECK(pty.ask(std::string(10000, '\0') + "\r", 1) == "\a");
  CHECK(pty.ask("t1230\r", 2) == "z\r");
  CHECK(pty.frames == Texts{"123#"});
  CHECK(pty.bus->lost() == lost);
}

TEST_CASE("slcan-pty: it has no further name, and may listen only") {
  CHECK(error_of("slcan-pty:x") == "slcan-pty has no further name: ':x'");
  const std::unique_ptr<Bus> bus = open_good("slcan-pty", {250000, true});
  CHECK(bus->bit_rate() == 250000);
  CHECK(bus->note().find("slcan adapter at /dev/") == 0);
  CHECK_FALSE(bus->send(frame("123#")));
}

TEST_CASE("slcan server: answers the commands of a program that has connected, and ends with it") {
  int ends[2]{};
  REQUIRE(socketpair(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0, ends) == 0);
  Fd peer;
  peer = ends[0];
  const std::unique_ptr<Bus> bus = serve_slcan(ends[1], 500000);
  CHECK(bus->bit_rate() == 500000);
  CHECK(bus->send(frame("123#")));  // discarded: the channel is closed
  CHECK(write_text(peer, "C\rS5\rS6\rO\rt1230\rT12345678101\rQ\r" + std::string(300, 'x') + '\r', *bus) ==
        Texts{"123#", "12345678#01"});
  CHECK(read_text(peer, 10) == "\r\a\r\rz\rZ\r\a\a");
  CHECK(bus->send(frame("124#R2")));
  CHECK(read_text(peer, 6) == "r1242\r");
  unsigned sent = 0;
  while (sent < 100000 && bus->send(frame("12345678#1122334455667788"))) {
    ++sent;
  }
  REQUIRE(sent < 100000);
  CHECK((bus->wanted().events & POLLOUT) != 0);
  while (!bus->receive() && (bus->wanted().events & POLLOUT) != 0) {
    CHECK(!read_text(peer, 1).empty());
  }
  CHECK_FALSE(is_ready(bus->wanted(), 0));  // poll() must not report a frame that its sender has given up
  peer.reset();
  CHECK(!bus->receive());
  CHECK(bus->wanted().fd == -1);
  CHECK(bus->fault() == "slcan program" + std::string(gone));
  CHECK(!bus->restore());
}
