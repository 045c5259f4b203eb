// SPDX-License-Identifier: Apache-2.0
// SDO server: segments in sequence of a domain, which the server processes without its state machine and without type
// functions. They have the same effect as those of a type that the state machine processes. [301:7.2.4.3]
#include <random>

#include "support/block_frames.hpp"
#include "support/fixture.hpp"

namespace {

using namespace test;

// Type with the functions of a domain, but at another address: the state machine processes all segments.
const CO_OBJ_TYPE same_functions = COTDomain;

constexpr std::uint32_t domain_bytes = 100;

struct Domain {
  Bytes memory = counting(domain_bytes);
  CO_OBJ_DOM domain{0, domain_bytes, memory.data()};
};

// A node whose object 3100h is a domain of the type.
struct Server : Domain, Fixture {
  explicit Server(const CO_OBJ_TYPE* type, Setup setup = Setup().only_small())
      : Fixture(setup.with({CO_KEY(0x3100, 0, CO_OBJ_____RW), type, CO_DATA(&domain)})) {}
};

// Two nodes that receive the same frames, and whose objects are changed in the same way.
class Pair {
 public:
  void rx(const CO_IF_FRM& request) {
    straight_.rx(request);
    machine_.rx(request);
    compare(notation(request));
  }
  void after(Time time) {
    straight_.after(time);
    machine_.after(time);
    compare("time");
  }
  void resize(std::uint32_t size) {
    straight_.domain.Size = size;
    machine_.domain.Size = size;
  }
  void move(std::uint32_t position) {
    straight_.domain.Offset = position;
    machine_.domain.Offset = position;
  }
  // Takes the memory of the domain away, or gives it back.
  void turn_memory() {
    straight_.domain.Start = straight_.domain.Start == nullptr ? straight_.memory.data() : nullptr;
    machine_.domain.Start = machine_.domain.Start == nullptr ? machine_.memory.data() : nullptr;
  }
  bool is_open() { return straight_->Sdo[0].Flow.State != 0; }
  const std::string& difference() const { return difference_; }

 private:
  void compare(const std::string& what) {
    const bool same = straight_.frames() == machine_.frames() && straight_.memory == machine_.memory &&
                      straight_.domain.Offset == machine_.domain.Offset &&
                      straight_->Sdo[0].Flow.State == machine_->Sdo[0].Flow.State;
    if (!same && difference_.empty()) {
      difference_ = "after " + what;
    }
  }

  Server straight_{CO_TDOMAIN};
  Server machine_{&same_functions};
  std::string difference_;
};

// Sends mostly segments in sequence, and between them everything that ends a sequence.
class Client {
 public:
  explicit Client(unsigned seed) : random_(seed) {}

  void step(Pair& servers) {
    switch (below(40)) {
      case 0: begin(servers, 0x40, 0); break;
      case 1: begin(servers, 0x21, below(4) == 0 ? below(120) : domain_bytes); break;
      case 2: begin(servers, 0x20, 0); break;
      case 3: send(servers, command_ | toggle_ | 0x01); break;  // last segment
      case 4: send(servers, command_ | (toggle_ ^ 0x10U)); break;
      case 5: send(servers, command_ | toggle_ | below(16)); break;
      case 6: send(servers, below(256)); break;
      case 7: servers.after(std::chrono::milliseconds{below(CO_SDO_TIMEOUT)}); break;
      case 8: servers.resize(below(domain_bytes + 1)); break;
      case 9: servers.move(below(domain_bytes + 20)); break;
      case 10: servers.turn_memory(); break;
#if USE_SDO_BLOCK
      case 11: servers.rx(frame("601#A400310005000000")); break;
      case 12: servers.rx(frame("601#A300000000000000")); break;
      case 13: servers.rx(frame("601#A205050000000000")); break;
      case 14: servers.rx(frame("601#C600310064000000")); break;
#endif
      case 15: servers.resize(domain_bytes); break;
      default: segment(servers);
    }
  }

 private:
  unsigned below(unsigned end) { return static_cast<unsigned>(random_() % end); }

  void begin(Pair& servers, unsigned specifier, std::uint32_t size) {
    CO_IF_FRM request = frame("601#0000310000000000");
    request.Data[0] = static_cast<std::uint8_t>(specifier);
    request.Data[4] = static_cast<std::uint8_t>(size);
    command_ = specifier == 0x40 ? 0x60 : 0x00;
    toggle_ = 0;
    number_ = 0;
    servers.rx(request);
  }
  void segment(Pair& servers) {
    number_ = static_cast<std::uint8_t>(number_ + 1);
    send(servers, below(8) == 0 ? number_ : command_ | toggle_);  // number_: segment of a block
    toggle_ ^= 0x10U;
  }
  void send(Pair& servers, unsigned specifier) {
    CO_IF_FRM request = frame("601#0000000000000000");
    request.Data[0] = static_cast<std::uint8_t>(specifier);
    for (unsigned n = 1; n < 8; ++n) {
      request.Data[n] = static_cast<std::uint8_t>(random_());
    }
    servers.rx(request);
  }

  std::mt19937 random_;
  unsigned command_ = 0;
  unsigned toggle_ = 0;
  std::uint8_t number_ = 0;
};

TEST_CASE("SDO server: segments of a domain have the effects of segments of any other type [D3] [D4]") {
  const unsigned transfers = stride(4) == 1 ? 400 : 100;
  unsigned open = 0;
  for (unsigned seed = 0; seed < transfers; ++seed) {
    Pair servers;
    Client client(seed);
    for (unsigned n = 0; n < 60 && servers.difference().empty(); ++n) {
      client.step(servers);
      open += servers.is_open() ? 1U : 0U;
    }
    CAPTURE(seed);
    CHECK(servers.difference() == "");
  }
  CHECK(open > 10 * transfers);  // most frames belong to an open transfer
}

TEST_CASE("SDO server: each segment of a domain restarts the time-out") {
  for (const bool uploads : {true, false}) {
    CAPTURE(uploads);
    Server node(CO_TDOMAIN);
    node.ask(uploads ? "601#4000310000000000" : "601#2100310064000000",
             uploads ? "581#4100310064000000" : "581#6000310000000000");
    for (unsigned n = 0; n < 12; ++n) {
      node.after(std::chrono::milliseconds{CO_SDO_TIMEOUT / 2});
      CO_IF_FRM request = frame(uploads ? "601#6000000000000000" : "601#0001020304050607");
      request.Data[0] = static_cast<std::uint8_t>(request.Data[0] | (n % 2 == 0 ? 0x00 : 0x10));
      node.rx(request);
      CHECK(node.frames().size() == 1);
    }
    CHECK(node->Sdo[0].Flow.Num == 84);
    node.after(node.sdo_time_out());
    node.tx("581#8000310000000405");
  }
}

TEST_CASE("SDO server: a segment for memory that CO_NODE_EXT.Writable refuses aborts the download") {
  bool is_writable = true;
  Server node(CO_TDOMAIN, Setup().only_small().writable([&](const void*, std::uint32_t) { return is_writable; }));
  node.ask("601#2100310064000000", "581#6000310000000000");
  is_writable = false;
  node.ask("601#0001020304050607", "581#8000310000000106");
  CHECK(node.memory == counting(domain_bytes));
}

#if USE_SDO_BLOCK && CO_SDO_BUF_SEG >= 8
TEST_CASE("SDO server: segments of a block beyond the size of the object are not stored") {
  Server node(CO_TDOMAIN);
  node.rx("601#C600310010000000");
  node.frames();
  for (unsigned n = 1; n <= 3; ++n) {
    CO_IF_FRM segment = frame("601#0001020304050607");
    segment.Data[0] = static_cast<std::uint8_t>(n);
    node.rx(segment);
  }
  CHECK(node->Sdo[0].Flow.Fill == 14);
  CHECK(node->Sdo[0].Flow.Seq == 2);
  node.after(node.sdo_time_out());
  node.tx("581#8000310012000706");
}
#endif

}  // namespace
