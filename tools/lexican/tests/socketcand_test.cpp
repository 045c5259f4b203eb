// SPDX-License-Identifier: Apache-2.0
// socketcand:HOST:PORT/BUS: messages byte by byte, a server and clients on real sockets, and hostile ones.
#include "bus/socketcand.hpp"

#include <arpa/inet.h>
#include <doctest/doctest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <functional>
#include <future>
#include <random>
#include <string>
#include <vector>

namespace {

using namespace lexican::host_bus;
using Kind = SocketcandMessage::Kind;
using Texts = std::vector<std::string>;

CO_IF_FRM frame(const char* text) {
  CO_IF_FRM result{};
  REQUIRE(parse_frame(text, result) == Parsed::frame);
  return result;
}

/// Calls a function until it returns true.
/// \retval false  it has not done so within 10 s
bool until(const std::function<bool()>& is_done) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (!is_done()) {
    if (std::chrono::steady_clock::now() > end) {
      return false;
    }
  }
  return true;
}

/// Waits at most 10 ms for an event.
void wait(std::vector<pollfd> wanted) { poll(wanted.data(), wanted.size(), 10); }

int listen_on(std::uint16_t& port) {
  const int fd = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const int reuse = 1;
  setsockopt(fd, SOL_SOCKET, SO_REUSEADDR, &reuse, sizeof reuse);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  REQUIRE(bind(fd, reinterpret_cast<const sockaddr*>(&address), size) == 0);
  REQUIRE(listen(fd, 4) == 0);
  REQUIRE(getsockname(fd, reinterpret_cast<sockaddr*>(&address), &size) == 0);
  port = ntohs(address.sin_port);
  return fd;
}

/// A connection with typed bytes.
class Peer {
 public:
  explicit Peer(int fd) : fd_(fd) { REQUIRE(fd >= 0); }
  ~Peer() { close(); }
  Peer(const Peer&) = delete;
  Peer& operator=(const Peer&) = delete;

  void close() {
    if (fd_ >= 0) {
      ::close(fd_);
    }
    fd_ = -1;
  }
  void send(const std::string& bytes) {
    REQUIRE(::send(fd_, bytes.data(), bytes.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(bytes.size()));
  }
  /// Reads what has arrived. \a is_ended: the other side has closed the connection.
  void read() {
    char bytes[65536];
    ssize_t size = 0;
    while ((size = recv(fd_, bytes, sizeof bytes, MSG_DONTWAIT)) > 0) {
      received.append(bytes, static_cast<std::size_t>(size));
    }
    is_ended = is_ended || size == 0 || errno == ECONNRESET;
  }
  /// Waits for bytes, and removes them. Other bytes are a failure.
  void expect(const std::string& bytes) {
    until([&] {
      wait({{fd_, POLLIN, 0}});
      read();
      return received.size() >= bytes.size() || is_ended;
    });
    CHECK(received.substr(0, bytes.size()) == bytes);
    received.erase(0, bytes.size());
  }

  std::string received;
  bool is_ended = false;

 private:
  int fd_;
};

/// A server in this process, for the bus can0.
struct Server {
  explicit Server(std::uint16_t port = 0) {
    std::string why;
    REQUIRE_MESSAGE(server.open("", port, why), why);
    REQUIRE(server.port() != 0);
  }

  void process() {
    wait(server.wanted());
    server.process(23424242);
  }

  std::unique_ptr<Peer> connect() {
    const int fd = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(server.port());
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    REQUIRE(::connect(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0);
    auto peer = std::make_unique<Peer>(fd);
    expect(*peer, "< hi >");
    return peer;
  }

  std::unique_ptr<Peer> connect_raw() {
    std::unique_ptr<Peer> peer = connect();
    peer->send("< open can0 >< rawmode >");
    expect(*peer, "< ok >< ok >");
    return peer;
  }

  /// Waits until a client has received exactly these bytes.
  void expect(Peer& peer, const std::string& bytes) {
    until([&] {
      process();
      peer.read();
      return peer.received.size() >= bytes.size() || peer.is_ended;
    });
    CHECK(peer.received == bytes);
    peer.received.clear();
  }

  bool disconnects(Peer& peer) {
    return until([&] {
      process();
      peer.read();
      return peer.is_ended;
    });
  }

  std::string name() const { return "127.0.0.1:" + std::to_string(server.port()) + "/can0"; }

  std::unique_ptr<Bus> open_bus(const std::string& bus, std::string& why) {
    auto opening = std::async(std::launch::async, [&] { return lexican::host_bus::open_bus(bus, {}, why); });
    until([&] {
      process();
      return opening.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
    });
    return opening.get();
  }

  std::unique_ptr<Bus> open_bus() {
    std::string why;
    std::unique_ptr<Bus> bus = open_bus("socketcand:" + name(), why);
    REQUIRE_MESSAGE(bus != nullptr, why);
    return bus;
  }

  /// Returns the frames that clients have sent, as soon as there are as many.
  Texts frames(std::size_t number) {
    Texts all;
    until([&] {
      process();
      while (const std::optional<CO_IF_FRM> received = server.receive()) {
        all.push_back(to_text(*received));
      }
      return all.size() >= number;
    });
    return all;
  }

  SocketcandServer server{"can0"};
};

/// Waits for a number of entries of a bus: "time frame".
Texts read(Bus& bus, std::size_t number, Server* server = nullptr) {
  Texts all;
  until([&] {
    if (server != nullptr) {
      server->process();
    } else {
      wait({bus.wanted()});
    }
    while (const std::optional<Entry> entry = bus.receive()) {
      CHECK(entry->direction == Direction::received);
      all.push_back(std::to_string(entry->time) + ' ' + to_text(entry->frame));
    }
    return all.size() >= number || !bus.fault().empty();
  });
  return all;
}

/// A client, and a server of typed bytes.
struct Client {
  Client() : listener(listen_on(port)) {}
  ~Client() { close(listener); }
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  void accept() { peer = std::make_unique<Peer>(::accept4(listener, nullptr, nullptr, SOCK_CLOEXEC)); }

  /// Opens the bus while the server talks. Returns the reason of a failure.
  std::string open(const std::function<void()>& talk) {
    std::string why;
    auto opening = std::async(std::launch::async, [&] {
      return lexican::host_bus::open_bus("socketcand:127.0.0.1:" + std::to_string(port) + "/can0", {}, why);
    });
    accept();
    talk();
    bus = opening.get();
    const std::string address = "127.0.0.1:" + std::to_string(port) + ": ";
    CHECK(why.substr(0, address.size()) == (why.empty() ? "" : address));
    return why.substr(std::min(why.size(), address.size()));
  }

  void greet() {
    peer->send("< hi >");
    peer->expect("< open can0 >");
    peer->send("< ok >");
    peer->expect("< rawmode >");
    peer->send("< ok >");
  }

  void open() {
    REQUIRE(open([&] { greet(); }).empty());
  }

  std::uint16_t port = 0;
  int listener;
  std::unique_ptr<Peer> peer;
  std::unique_ptr<Bus> bus;
};

/// Returns "kind frame", or "kind".
std::string parsed(const std::string& text) {
  const SocketcandMessage message = parse_socketcand(text);
  const char* const names[] = {"hi",   "ok",    "error", "open",      "rawmode", "bcmmode",
                               "echo", "frame", "send",  "malformed", "unknown"};
  const std::string name = names[static_cast<unsigned>(message.kind)];
  const bool is_frame = message.kind == Kind::frame || message.kind == Kind::send;
  return is_frame ? name + ' ' + std::to_string(message.entry.time) + ' ' + to_text(message.entry.frame)
                  : name + (message.text.empty() ? "" : " " + std::string(message.text));
}

}  // namespace

TEST_CASE("socketcand: messages that are parsed") {
  CHECK(parsed(" hi ") == "hi");
  CHECK(parsed("ok") == "ok");
  CHECK(parsed(" error could not  open bus ") == "error could not  open bus ");
  CHECK(parsed(" error ") == "error");
  CHECK(parsed("open can0") == "open can0");
  CHECK(parsed(" rawmode ") == "rawmode");
  CHECK(parsed(" bcmmode ") == "bcmmode");
  CHECK(parsed(" echo ") == "echo");
  CHECK(parsed(" frame 123 23.424242 11 22 33 44 ") == "frame 23424242 123#11223344");
  CHECK(parsed(" frame 123 23.424242 11223344 ") == "frame 23424242 123#11223344");
  CHECK(parsed(" frame 123 23.424242  ") == "frame 23424242 123#");
  CHECK(parsed(" frame 00000123 0.000001 0102030405060708 ") == "frame 1 00000123#0102030405060708");
  CHECK(parsed(" frame 1FFFFFFF 1 a F ") == "frame 1000000 1FFFFFFF#0A0F");
  CHECK(parsed(" send 123 8 11 22 33 44 55 66 77 88 ") == "send 0 123#1122334455667788");
  CHECK(parsed(" send 123 0 ") == "send 0 123#");
  CHECK(parsed(" send 1AAAAAAA 2 1 F1 ") == "send 0 1AAAAAAA#01F1");
  CHECK(parsed(" send 5 1 0 ") == "send 0 005#00");
  CHECK(parsed(" send 800 1 0 ") == "send 0 00000800#00");
  CHECK(parsed(" rtr 123 23.424242 4 ") == "frame 23424242 123#R4");
  CHECK(parsed(" sendrtr 1AAAAAAA 2 ") == "send 0 1AAAAAAA#R2");
  CHECK(parsed(" error 004 23.424242 ") == "frame 23424242 20000004#0000000000000000");
  CHECK(parsed(" error 4 ") == "frame 0 20000004#0000000000000000");
}

TEST_CASE("socketcand: messages that are refused") {
  for (const char* const text : {"frame",
                                 "frame 123",
                                 "frame 123 x",
                                 "frame x 1 00",
                                 "frame 20000000 1 00",
                                 "frame 123456789 1 00",
                                 "frame -1 1 00",
                                 "frame 123 1 123",
                                 "frame 123 1 0g",
                                 "frame 123 1 010203040506070809",
                                 "frame 123 1 1 2 3 4 5 6 7 8 9",
                                 "send 123 9 1 2 3 4 5 6 7 8 9",
                                 "send 123 8 1 2 3 4 5 6 7 8 9 10 11",
                                 "send 123 1",
                                 "send 123 0 1",
                                 "send 123 4 ",
                                 "send 123 -1",
                                 "send",
                                 "sendrtr 123",
                                 "sendrtr 123 9",
                                 "sendrtr 123 1 1",
                                 "rtr 123 1",
                                 "rtr 123 1 9"}) {
    CAPTURE(text);
    CHECK(parsed(text) == "malformed");
  }
  for (const char* const text : {"", "  ", "HI", "hi there", "open", "open a b", "fdframe 123", "subscribe 0 0 1"}) {
    CAPTURE(text);
    CHECK(parsed(text) == "unknown");
  }
}

TEST_CASE("socketcand: frames as messages, and python-can needs a space before them") {
  const auto text = [](const char* notation) {
    return to_socketcand_frame({23'424'242, frame(notation), Direction::received, 0});
  };
  CHECK(text("123#11223344") == " < frame 123 23.424242 11223344 >");
  CHECK(text("00000123#0102030405060708") == " < frame 00000123 23.424242 0102030405060708 >");
  CHECK(text("001#") == " < frame 001 23.424242  >");
  CHECK(to_socketcand_send(frame("123#1122334455667788")) == "< send 123 8 11 22 33 44 55 66 77 88 >");
  CHECK(to_socketcand_send(frame("1FFFFFFF#0A")) == "< send 1FFFFFFF 1 0A >");
  CHECK(to_socketcand_send(frame("7FF#")) == "< send 7FF 0 >");
}

TEST_CASE("socketcand: messages are found in pieces of a stream") {
  SocketcandInput input;
  Texts found;
  for (const char byte : std::string("x< hi >\n<a<ok>>> < echo")) {
    REQUIRE(input.append({&byte, 1}) == 1);
    while (const std::optional<std::string_view> text = input.next()) {
      found.emplace_back(*text);
    }
  }
  CHECK(found == Texts{" hi ", "ok"});
  const std::string filling(SocketcandInput::max_size, ' ');
  CHECK(input.append(filling) < filling.size());
  CHECK_FALSE(input.next());
  CHECK(input.is_full());
  CHECK(input.append(">") == 0);
}

TEST_CASE("socketcand server: greets, opens and answers") {
  Server server;
  const std::unique_ptr<Peer> peer = server.connect();
  peer->send("< echo >< rawmode >< send 123 0 >");
  server.expect(*peer, "< echo >< error unknown command >< error unknown command >");
  peer->send("< op");
  server.process();
  peer->send("en can0 >");
  server.expect(*peer, "< ok >");
  server.server.send({1, frame("123#"), Direction::received, 0});  // before raw mode
  peer->send("<rawmode><echo>< open can0 >< subscribe 0 0 123 >< send 123 2 1 >< >");
  server.expect(*peer,
                "< ok >< echo >< error unknown command >< error unknown command >< error syntax error >"
                "< error unknown command >");
  server.server.send({1'000'001, frame("123#AABB"), Direction::received, 0});
  server.server.send({2'000'000, frame("12345678#"), Direction::sent, 0});
  server.server.send({2'000'000, frame("20000004#0000000000000000"), Direction::received, 0});
  server.expect(*peer, " < frame 123 1.000001 AABB > < frame 12345678 2.000000  >");
  CHECK(server.server.lost() == 0);
  server.server.send({2'000'000, frame("123#R"), Direction::sent, 0});
  CHECK(server.server.lost() == 1);
  peer->send("< bcmmode >");
  server.expect(*peer, "< ok >");
  server.server.send({1, frame("123#"), Direction::received, 0});
  peer->send("< echo >");
  server.expect(*peer, "< echo >");
}

TEST_CASE("socketcand server: another bus is refused, and the connection ends") {
  Server server;
  const std::unique_ptr<Peer> peer = server.connect();
  peer->send("< open can1 >< rawmode >");
  server.expect(*peer, "< error could not open bus >");
  CHECK(server.disconnects(*peer));
  CHECK(server.server.clients() == 0);
}

TEST_CASE("socketcand server: a frame of a client reaches the bus and the other clients") {
  Server server;
  const std::unique_ptr<Peer> first = server.connect_raw();
  const std::unique_ptr<Peer> second = server.connect_raw();
  const std::unique_ptr<Peer> third = server.connect_raw();
  first->send("< send 123 8 11 22 33 44 55 66 77 88 >< send 1AAAAAAA 0 >< sendrtr 701 1 >");
  CHECK(server.frames(3) == Texts{"123#1122334455667788", "1AAAAAAA#", "701#R1"});
  for (Peer* const other : {second.get(), third.get()}) {
    server.expect(*other, " < frame 123 23.424242 1122334455667788 > < frame 1AAAAAAA 23.424242  >");
  }
  CHECK(server.server.lost() == 2);
  first->send("< echo >");
  server.expect(*first, "< echo >");
}

TEST_CASE("socketcand server: a client that sends 4096 bytes without a message is disconnected, the others are not") {
  Server server;
  const std::unique_ptr<Peer> good = server.connect_raw();
  const std::unique_ptr<Peer> almost = server.connect();
  almost->send("< echo" + std::string(SocketcandInput::max_size - 7, ' ') + ">");
  server.expect(*almost, "< echo >");
  const std::unique_ptr<Peer> hostile = server.connect();
  hostile->send("<" + std::string(SocketcandInput::max_size - 1, 'x'));
  CHECK(server.disconnects(*hostile));
  std::mt19937 random(1);
  for (unsigned n = 0; n < 200; ++n) {
    const std::unique_ptr<Peer> other = server.connect();
    std::string bytes(1 + random() % 60, '\0');
    for (char& byte : bytes) {
      byte = " <>se0nd\xFF"[random() % 9];
    }
    other->send((n % 2 == 0 ? "< open can0 >" : "") + bytes);
    server.process();
  }
  CHECK(until([&] {
    server.process();
    return server.server.clients() == 2;
  }));
  while (server.server.receive()) {
  }
  good->send("< send 001 0 >");
  CHECK(server.frames(1) == Texts{"001#"});
}

TEST_CASE("socketcand server: a client that does not read loses whole frames, and does not delay the others") {
  Server server;
  const std::unique_ptr<Peer> slow = server.connect_raw();
  const std::unique_ptr<Peer> fast = server.connect_raw();
  const Entry entry{1, frame("123#0102030405060708"), Direction::received, 0};
  const std::string message = to_socketcand_frame(entry);
  std::size_t sent = 0;
  std::size_t received = 0;
  CHECK(until([&] {
    for (unsigned n = 0; n < 100; ++n, ++sent) {
      server.server.send(entry);
    }
    server.server.process(0);
    const bool has_all = until([&] {
      fast->read();
      received += fast->received.size();
      fast->received.clear();
      server.server.process(0);
      return received == sent * message.size();
    });
    return server.server.lost() >= 1000 || !has_all;
  }));
  CHECK(received == sent * message.size());
  std::string all;
  CHECK(until([&] {
    server.server.process(0);
    slow->read();
    all += slow->received;
    slow->received.clear();
    return all.size() >= (sent - server.server.lost()) * message.size();
  }));
  std::string expected;
  for (std::size_t n = 0; n < sent - server.server.lost(); ++n) {
    expected += message;
  }
  CHECK((all == expected));
  server.server.send(entry);
  server.expect(*slow, message);
}

TEST_CASE("socketcand server: a client whose answers wait is not read, and one that sends too fast waits") {
  Server server;
  const std::unique_ptr<Peer> fast = server.connect_raw();
  std::string bytes;
  constexpr std::size_t number = 2000;
  for (std::size_t n = 0; n < number; ++n) {
    bytes += "<send 1 0>";
  }
  fast->send(bytes);
  for (unsigned n = 0; n < 20; ++n) {
    server.server.process(0);
  }
  CHECK(server.server.wanted().back().fd == -1);
  CHECK(server.frames(number).size() == number);
  CHECK(server.server.wanted().back().events == POLLIN);

  const std::unique_ptr<Peer> deaf = server.connect();
  std::string flood;
  while (flood.size() < 4000) {
    flood += "<>";
  }
  CHECK(until([&] {
    server.server.process(0);
    const bool is_read = (server.server.wanted().back().events & POLLIN) != 0;
    if (is_read) {
      deaf->send(flood);
    }
    return !is_read;
  }));
  CHECK(server.server.clients() == 2);
}

TEST_CASE("socketcand server: further clients wait until one of the 16 has left") {
  Server server;
  std::vector<std::unique_ptr<Peer>> peers;
  for (std::size_t n = 0; n < Listener::most_clients; ++n) {
    peers.push_back(server.connect());
  }
  CHECK(server.server.wanted().front().fd == -1);
  CHECK(server.server.clients() == Listener::most_clients);
  peers.pop_back();
  const std::unique_ptr<Peer> another = server.connect();
  CHECK(server.server.clients() == Listener::most_clients);
}

TEST_CASE("socketcand server: addresses and ports that it cannot use are named") {
  Server server;
  std::string why;
  SocketcandServer second("can0");
  CHECK_FALSE(second.open("127.0.0.1", server.server.port(), why));
  CHECK(why ==
        "the server cannot use port " + std::to_string(server.server.port()) + " of 127.0.0.1: Address already in use");
  SocketcandServer third("can0");
  CHECK_FALSE(third.open("localhost", 0, why));
  CHECK_MESSAGE(why.find("the server cannot use the address localhost: ") == 0, why);
}

TEST_CASE("socketcand client: a connection, byte by byte") {
  Client client;
  client.open();
  CHECK(client.bus->is_physical());
  CHECK(client.bus->bit_rate() == 0);
  CHECK(client.bus->wanted().events == POLLIN);
  CHECK_FALSE(client.bus->receive());
  CHECK(client.bus->send(frame("123#1122334455667788")));
  CHECK(client.bus->send(frame("12345678#")));
  client.peer->expect("< send 123 8 11 22 33 44 55 66 77 88 >< send 12345678 0 >");
  client.peer->send("< frame 123 23.424242 11 22 33 44 ><frame 12345678 1.5 >\n< frame 7FF 2.0 0102030405060708 >");
  CHECK(read(*client.bus, 3) == Texts{"23424242 123#11223344", "1500000 12345678#", "2000000 7FF#0102030405060708"});
  client.peer->send("< rtr 701 3.0 1 >< error 004 4.0 >< stat 1 2 3 4 >< echo >");
  CHECK(read(*client.bus, 2) == Texts{"3000000 701#R1", "4000000 20000004#0000000000000000"});
  CHECK(client.bus->lost() == 0);
}

TEST_CASE("socketcand client: a frame in pieces, malformed frames, and remote frames to send") {
  Client client;
  client.open();
  for (const char byte : std::string(" < frame 123 23.424242 11 2")) {
    client.peer->send(std::string(1, byte));
    CHECK_FALSE(client.bus->receive());
  }
  client.peer->send("2 >< frame 123 1.0 010203040506070809 >< frame 800x 1.0 >< frame 124 1.0 >");
  CHECK(read(*client.bus, 2) == Texts{"23424242 123#1122", "1000000 124#"});
  CHECK(client.bus->lost() == 2);
  CHECK(client.bus->send(frame("123#R8")));
  CHECK(client.bus->lost() == 3);
  CHECK(client.bus->send(frame("123#")));
  client.peer->expect("< send 123 0 >");
  CHECK(client.bus->fault().empty());
}

TEST_CASE("socketcand client: frames that follow the last answer are received") {
  Client client;
  REQUIRE(client
              .open([&] {
                client.peer->send("< hi >< ok >< ok > < frame 123 1.0  > < frame 124 1.0  >");
                client.peer->expect("< open can0 >< rawmode >");
              })
              .empty());
  pollfd wanted = client.bus->wanted();
  CHECK(poll(&wanted, 1, 10000) == 1);
  CHECK(read(*client.bus, 2) == Texts{"1000000 123#", "1000000 124#"});
}

TEST_CASE("socketcand client: a server that refuses, or is another program, is named") {
  Client client;
  CHECK(client.open([&] {
    client.peer->send("< hi >");
    client.peer->expect("< open can0 >");
    client.peer->send("< error could not \x1B[2J open >");
  }) == "the server refuses can0: could not ?[2J open ");
  CHECK(client.open([&] { client.peer->send("< hello >"); }) ==
        "the program at this port does not follow the protocol of socketcand");
  CHECK(client.open([&] { client.peer->send(std::string(SocketcandInput::max_size, '<')); }) ==
        "the program at this port does not follow the protocol of socketcand");
  CHECK(client.open([&] { client.peer->close(); }) == "the server has ended the connection");
  CHECK(client.open([&] {}) == "no answer within 2 s");
}

TEST_CASE("socketcand client: a server that reports an error, sends no message, or ends") {
  Client client;
  const std::string address = "127.0.0.1:" + std::to_string(client.port) + ": ";
  const auto fault_after = [&](const std::string& bytes) {
    client.open();
    client.peer->send(bytes);
    client.peer->close();
    read(*client.bus, 1000);
    CHECK(client.bus->wanted().fd == -1);
    CHECK_FALSE(client.bus->send(frame("123#")));
    CHECK_FALSE(client.bus->receive());
    return client.bus->fault();
  };
  CHECK(fault_after("< error unknown command >") == address + "the server reports: unknown command ");
  CHECK(fault_after(std::string(SocketcandInput::max_size, 'x')) ==
        address + "the program at this port does not follow the protocol of socketcand");
  CHECK(fault_after("") == address + "the server has ended the connection");
}

TEST_CASE("socketcand client: the bus is restored when the server has come back") {
  auto server = std::make_unique<Server>();
  const std::uint16_t port = server->server.port();
  const std::unique_ptr<Bus> bus = server->open_bus();
  CHECK(bus->restore());
  server.reset();
  CHECK(read(*bus, 1).empty());
  CHECK(bus->fault() == "127.0.0.1:" + std::to_string(port) + ": the server has ended the connection");
  CHECK_FALSE(bus->restore());
  CHECK(bus->fault() == "127.0.0.1:" + std::to_string(port) + ": Connection refused");
  Server next(port);
  auto restoring = std::async(std::launch::async, [&] { return bus->restore(); });
  until([&] {
    next.process();
    return restoring.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
  });
  CHECK(restoring.get());
  CHECK(bus->fault().empty());
  next.server.send({1, frame("123#"), Direction::received, 0});
  CHECK(read(*bus, 1, &next) == Texts{"1 123#"});
}

TEST_CASE("socketcand client: against the server, with all lengths") {
  Server server;
  const std::unique_ptr<Bus> first = server.open_bus();
  const std::unique_ptr<Bus> second = server.open_bus();
  Texts sent;
  Texts received;
  for (unsigned n = 0; n <= 8; ++n) {
    const std::string text = (n % 2 == 0 ? "12A#" : "0000012A#") + std::string("0102030405060708").substr(0, 2 * n);
    sent.push_back(text);
    received.push_back("23424242 " + text);
    REQUIRE(first->send(frame(text.c_str())));
  }
  CHECK(server.frames(sent.size()) == sent);
  CHECK(read(*second, received.size(), &server) == received);
  CHECK_FALSE(first->receive());
}

TEST_CASE("socketcand client: sending faster than the server reads has to wait, and loses nothing") {
  Server server;
  const std::unique_ptr<Bus> bus = server.open_bus();
  const CO_IF_FRM queued = frame("123#0102030405060708");
  std::size_t sent = 0;
  CHECK(until([&] {
    const bool is_sent = bus->send(queued);
    sent += is_sent ? 1 : 0;
    return !is_sent;
  }));
  CHECK(bus->fault().empty());
  CHECK(bus->wanted().events == (POLLIN | POLLOUT));
  std::size_t received = 0;
  CHECK(until([&] {
    CHECK_FALSE(bus->receive());
    server.process();
    while (server.server.receive()) {
      ++received;
    }
    return received >= sent;
  }));
  CHECK(received == sent);
  CHECK(bus->wanted().events == POLLIN);
  CHECK(bus->send(frame("124#")));
  CHECK(server.frames(1) == Texts{"124#"});
}

TEST_CASE("socketcand client: names that are not valid are refused") {
  for (const char* const name :
       {"", "127.0.0.1", "127.0.0.1:1", "127.0.0.1/can0", "127.0.0.1:/can0", "127.0.0.1:0/can0", "127.0.0.1:65536/can0",
        "127.0.0.1:x/can0", ":1/can0", "127.0.0.1:1/", "127.0.0.1:1/a b", "127.0.0.1:1/a>",
        "127.0.0.1:1/12345678901234567"}) {
    CAPTURE(name);
    std::string why;
    CHECK(open_bus(std::string("socketcand:") + name, {}, why) == nullptr);
    CHECK(why == "socketcand needs HOST:PORT/BUS, such as 127.0.0.1:29536/can0");
  }
}

TEST_CASE("socketcand client: an address of IPv6 in brackets") {
  SocketcandServer server("can0");
  std::string why;
  if (!server.open("::1", 0, why)) {
    MESSAGE(why);
    return;
  }
  auto opening = std::async(std::launch::async, [&] {
    return open_bus("socketcand:[::1]:" + std::to_string(server.port()) + "/can0", {}, why);
  });
  until([&] {
    wait(server.wanted());
    server.process(0);
    return opening.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
  });
  CHECK_MESSAGE(opening.get() != nullptr, why);
}
