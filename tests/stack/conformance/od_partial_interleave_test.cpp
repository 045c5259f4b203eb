// SPDX-License-Identifier: Apache-2.0
// Simultaneous partial accesses to the same objects (co_od.h) by two SDO servers, two OD_IO_t and COObj functions. Each
// access reads and writes the same bytes as without the others, in every order of the pieces.
#include <algorithm>

#include "support/block_frames.hpp"
#include "support/logged_extension.hpp"
#include "support/stride.hpp"

#if USE_OD && CO_SSDO_N >= 2

namespace {

using namespace test;

// A participant that accesses the object in three pieces.
class Actor {
 public:
  virtual ~Actor() = default;
  virtual void begin() = 0;
  virtual void go_on() = 0;
  virtual void end() = 0;

  void step(unsigned n) { n == 0 ? begin() : n == 1 ? go_on() : end(); }
};

// A node with two streams of 12 bytes that exist only in extensions (3000h, 3001h), a domain without an extension
// (3002h) and a text with an extension (3003h). The second SDO server uses 690h/6A0h.
struct Node {
  Bytes domain_memory = counting(12, 101);
  CO_OBJ_DOM domain{0, 12, domain_memory.data()};
  std::uint8_t text_memory[12] = {};
  CO_OBJ_STR_RW text_string{0, 0, 12, text_memory};
  LoggedExtension one;
  LoggedExtension other;
  LoggedExtension text;
  Fixture fixture{Setup()
                      .only_small()
                      .with({CO_KEY(0x3000, 0, CO_OBJ_____RW), OD_TSTREAM, CO_DATA(0)})
                      .with({CO_KEY(0x3001, 0, CO_OBJ_____RW), OD_TSTREAM, CO_DATA(12)})
                      .with({CO_KEY(0x3002, 0, CO_OBJ_____RW), OD_TDOMAIN, CO_DATA(&domain)})
                      .with({CO_KEY(0x3003, 0, CO_OBJ_____RW), OD_TVISIBLE_STRING, CO_DATA(&text_string)})
                      .before_init([](Objects& o) {
                        o.sdo2_rx = 0x690;
                        o.sdo2_tx = 0x6A0;
                      })};

  Node() {
    one.put_at(fixture, 0x3000);
    other.put_at(fixture, 0x3001);
    text.put_at(fixture, 0x3003);
    one.data = counting(12);
    other.data = counting(12, 51);
    text.data = counting(12, 'a');
  }

  CO_OBJ* find(std::uint16_t index) { return fixture.find(index, 0); }
  // Returns the first byte of the object's initial value.
  std::uint8_t first(std::uint16_t index) const {
    return index == 0x3000 ? 1 : index == 0x3001 ? 51 : index == 0x3002 ? 101 : 'a';
  }
};

// An SDO client that sends and checks frames. [301:7.2.4.3]
class Client : public Actor {
 public:
  Client(Node& node, unsigned server, std::uint16_t index)
      : node_(node), rx_(server == 1 ? 0x601 : 0x690), tx_(server == 1 ? 0x581 : 0x6A0), index_(index) {}

 protected:
  void ask(const Bytes& request, const Bytes& answer) {
    node_.fixture.rx(frame_of(rx_, request));
    node_.fixture.tx(notation(frame_of(tx_, answer)));
  }
  std::uint8_t low() const { return static_cast<std::uint8_t>(index_); }
  Node& node_;

 private:
  static CO_IF_FRM frame_of(std::uint32_t id, Bytes bytes) {
    CO_IF_FRM frm{id, {}, 8};
    bytes.resize(8);
    std::copy(bytes.begin(), bytes.end(), frm.Data);
    return frm;
  }
  std::uint32_t rx_;
  std::uint32_t tx_;

 protected:
  std::uint16_t index_;
};

class Upload : public Client {
 public:
  using Client::Client;
  void begin() override {
    const bool known = index_ == 0x3001 || index_ == 0x3002;
    ask({0x40, low(), 0x30},
        {static_cast<std::uint8_t>(known ? 0x41 : 0x40), low(), 0x30, 0, static_cast<std::uint8_t>(known ? 12 : 0)});
  }
  void go_on() override {
    Bytes answer = counting(7, node_.first(index_));
    answer.insert(answer.begin(), std::uint8_t{0x00});
    ask({0x60}, answer);
  }
  void end() override {
    Bytes answer = counting(5, node_.first(index_) + 7U);
    answer.insert(answer.begin(), std::uint8_t{0x15});
    ask({0x70}, answer);
  }
};

// A segmented download of 12 bytes.
class Download : public Client {
 public:
  using Client::Client;
  void begin() override { ask({0x21, low(), 0x30, 0, 12}, {0x60, low(), 0x30, 0}); }
  void go_on() override {
    Bytes request = counting(7, node_.first(index_));
    request.insert(request.begin(), std::uint8_t{0x00});
    ask(request, {0x20});
  }
  void end() override {
    Bytes request = counting(5, node_.first(index_) + 7U);
    request.insert(request.begin(), std::uint8_t{0x15});
    ask(request, {0x30});
  }
};

class Io : public Actor {
 public:
  Io(Node& node, std::uint16_t index, bool original = false) : node_(node), index_(index) {
    node.fixture.call([&] { REQUIRE(OD_getSub(OD_find(&node.fixture.od, index), 0, &io_, original) == ODR_OK); });
  }

 protected:
  Node& node_;
  std::uint16_t index_;
  OD_IO_t io_{};
};

class Reader : public Io {
 public:
  using Io::Io;
  void begin() override { read(5, 0, ODR_PARTIAL); }
  void go_on() override { read(4, 5, ODR_PARTIAL); }
  void end() override { read(3, 9, ODR_OK); }

 private:
  void read(OD_size_t count, unsigned position, ODR_t expected) {
    std::uint8_t buffer[5] = {};
    node_.fixture.call([&] {
      OD_size_t n = 0;
      CHECK(io_.read(&io_.stream, buffer, count, &n) == expected);
      CHECK(n == count);
    });
    CHECK(Bytes(buffer, buffer + count) == counting(count, node_.first(index_) + position));
  }
};

class Writer : public Io {
 public:
  using Io::Io;
  void begin() override { write(4, 0, ODR_PARTIAL); }
  void go_on() override { write(4, 4, ODR_PARTIAL); }
  void end() override { write(4, 8, ODR_OK); }

 private:
  void write(OD_size_t count, unsigned position, ODR_t expected) {
    const Bytes data = counting(count, node_.first(index_) + position);
    node_.fixture.call([&] {
      OD_size_t n = 0;
      CHECK(io_.write(&io_.stream, data.data(), count, &n) == expected);
    });
  }
};

class ObjReader : public Actor {
 public:
  ObjReader(Node& node, std::uint16_t index) : node_(node), index_(index) {}
  void begin() override { read(5, 0); }
  void go_on() override { read(4, 5); }
  void end() override { read(3, 9); }

 private:
  void read(std::uint32_t count, unsigned position) {
    std::uint8_t buffer[5] = {};
    node_.fixture.call([&] {
      CO_OBJ* const obj = node_.find(index_);
      const auto function = position == 0 ? COObjRdBufStart : COObjRdBufCont;
      CHECK(function(obj, &node_.fixture.node, buffer, count) == CO_ERR_NONE);
    });
    CHECK(Bytes(buffer, buffer + count) == counting(count, node_.first(index_) + position));
  }
  Node& node_;
  std::uint16_t index_;
};

class ObjWriter : public Actor {
 public:
  ObjWriter(Node& node, std::uint16_t index) : node_(node), index_(index) {}
  void begin() override { write(4, 0); }
  void go_on() override { write(4, 4); }
  void end() override { write(4, 8); }

 private:
  void write(std::uint32_t count, unsigned position) {
    Bytes data = counting(count, node_.first(index_) + position);
    node_.fixture.call([&] {
      CO_OBJ* const obj = node_.find(index_);
      const auto function = position == 0 ? COObjWrBufStart : COObjWrBufCont;
      CHECK(function(obj, &node_.fixture.node, data.data(), count) == CO_ERR_NONE);
    });
  }
  Node& node_;
  std::uint16_t index_;
};

// Runs the actors, three pieces each, in every order, or every 13th of a thin sweep. Returns the number of orders.
unsigned run_all_orders(const std::vector<Actor*>& actors) {
  std::vector<unsigned> order;
  for (unsigned n = 0; n < actors.size(); ++n) {
    order.insert(order.end(), 3, n);
  }
  unsigned orders = 0;
  do {
    if (orders++ % stride(13) != 0) {
      continue;
    }
    std::vector<unsigned> done(actors.size(), 0);
    for (const unsigned n : order) {
      actors[n]->step(done[n]++);
    }
  } while (std::next_permutation(order.begin(), order.end()));
  return orders;
}

constexpr unsigned orders_of_three = 1680;  // 9! / 3!^3

// Replaces the write function by one that discards the data: the extension would store the pieces of several writers in
// one buffer.
void forget_pieces(LoggedExtension& extension) {
  extension.extension.write = [](OD_stream_t* stream, const void*, OD_size_t count, OD_size_t* passed) {
    *passed = count;
    const bool last = stream->dataOffset + count == stream->dataLength;
    stream->dataOffset = last ? 0 : stream->dataOffset + count;
    return last ? ODR_OK : ODR_PARTIAL;
  };
}

TEST_CASE("OD interleaved: an upload and readers of one extended stream get all bytes in every order of the pieces") {
  Node node;
  Upload upload(node, 1, 0x3000);
  Reader first(node, 0x3000);
  Reader second(node, 0x3000);
  ObjReader obj(node, 0x3000);
  CHECK(run_all_orders({&upload, &first, &second}) == orders_of_three);
  CHECK(run_all_orders({&upload, &first, &obj}) == orders_of_three);
  CHECK(run_all_orders({&first, &second, &obj}) == orders_of_three);
}

TEST_CASE("OD interleaved: uploads of two streams and readers of both get all bytes in every order of the pieces") {
  Node node;
  Upload upload(node, 1, 0x3000);
  Upload other_upload(node, 2, 0x3001);
  Reader reader(node, 0x3001);
  ObjReader obj(node, 0x3001);
  CHECK(run_all_orders({&upload, &other_upload, &reader}) == orders_of_three);
  CHECK(run_all_orders({&upload, &other_upload, &obj}) == orders_of_three);
  CHECK(run_all_orders({&other_upload, &reader, &obj}) == orders_of_three);
}

TEST_CASE("OD interleaved: a download and an upload and readers of both are complete in every order of the pieces") {
  Node node;
  Upload upload(node, 2, 0x3000);
  Download download(node, 1, 0x3001);
  Reader reader(node, 0x3000);
  Reader other_reader(node, 0x3001);
  ObjReader obj(node, 0x3001);
  CHECK(run_all_orders({&upload, &download, &reader}) == orders_of_three);
  CHECK(run_all_orders({&upload, &download, &other_reader}) == orders_of_three);
  CHECK(run_all_orders({&download, &other_reader, &obj}) == orders_of_three);
  CHECK(node.other.data == counting(12, 51));
}

TEST_CASE("OD interleaved: a download and two writers of one stream are complete in every order of the pieces") {
  Node node;
  forget_pieces(node.other);
  Download download(node, 1, 0x3001);
  Writer writer(node, 0x3001);
  Writer second(node, 0x3001);
  ObjWriter obj(node, 0x3001);
  CHECK(run_all_orders({&download, &writer, &obj}) == orders_of_three);
  CHECK(run_all_orders({&download, &writer, &second}) == orders_of_three);
}

TEST_CASE("OD interleaved: uploads and readers of a text with its zero are complete in every order of the pieces") {
  Node node;
  Upload upload(node, 1, 0x3003);
  Upload other(node, 2, 0x3000);
  Reader reader(node, 0x3003);
  ObjReader obj(node, 0x3003);
  CHECK(run_all_orders({&upload, &other, &reader}) == orders_of_three);
  CHECK(run_all_orders({&upload, &reader, &obj}) == orders_of_three);
}

TEST_CASE("OD interleaved: accesses to a domain without extension are complete in every order of the pieces") {
  Node node;
  Upload upload(node, 1, 0x3002);
  Upload other(node, 2, 0x3001);
  Download download(node, 2, 0x3002);
  Reader reader(node, 0x3002);
  Reader second(node, 0x3002, true);
  ObjReader obj(node, 0x3002);
  Writer writer(node, 0x3002);
  CHECK(run_all_orders({&upload, &reader, &second}) == orders_of_three);
  CHECK(run_all_orders({&upload, &other, &obj}) == orders_of_three);
  CHECK(run_all_orders({&upload, &reader, &obj}) == orders_of_three);
  CHECK(run_all_orders({&download, &writer, &reader}) == orders_of_three);
  CHECK(run_all_orders({&download, &reader, &obj}) == orders_of_three);
}

TEST_CASE("OD interleaved: all accesses at once, in many orders") {
  Node node;
  Upload upload(node, 1, 0x3000);
  Download download(node, 2, 0x3001);
  Reader reader(node, 0x3000);
  Reader second(node, 0x3001);
  Reader original(node, 0x3002);
  ObjReader obj(node, 0x3003);
  const std::vector<Actor*> actors = {&upload, &download, &reader, &second, &original, &obj};
  std::uint32_t random = 1;
  for (unsigned round = 0; round < 500; ++round) {
    std::vector<unsigned> order;
    for (unsigned n = 0; n < 3 * actors.size(); ++n) {
      order.push_back(n % static_cast<unsigned>(actors.size()));
    }
    for (std::size_t n = order.size() - 1; n > 0; --n) {
      random = random * 1664525U + 1013904223U;
      std::swap(order[n], order[(random >> 16) % (n + 1)]);
    }
    std::vector<unsigned> done(actors.size(), 0);
    for (const unsigned n : order) {
      actors[n]->step(done[n]++);
    }
  }
}

TEST_CASE("OD interleaved: a stream that is open on one server is refused to the second with 0800 0022h") {
  Node node;
  Upload upload(node, 1, 0x3000);
  upload.begin();
  node.fixture.ask("690#4000300000000000", "6A0#8000300022000008");
  node.fixture.ask("690#2300300001020304", "6A0#8000300022000008");
  upload.go_on();
  upload.end();
  node.fixture.ask("690#4000300000000000", "6A0#4000300000000000");
  node.fixture.rx("690#8000300000000008");
}

}  // namespace

#endif
