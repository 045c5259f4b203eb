// SPDX-License-Identifier: Apache-2.0
// Fuzzes an SDO server with random requests, silences and a controller that refuses frames. A model written from the
// standard alone predicts every response and all data. [301:7.2.4.3]
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <deque>
#include <iterator>
#include <limits>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "co_core.h"
#include "fuzz/fuzz.hpp"
#include "support/sdo_server_model.hpp"

namespace {

using test::Bytes;
using test::SdoBytes;
using test::SdoObject;
using test::SdoServerModel;

constexpr std::uint8_t node_id = 5;
constexpr std::uint32_t large_size = 2000;           // larger than two buffers
constexpr std::uint32_t slice = CO_SDO_TIMEOUT / 8;  // an eighth of the time-out, in ticks of 1 ms
constexpr unsigned always = std::numeric_limits<unsigned>::max();

CO_IF_FRM frame_of(std::uint32_t identifier, const SdoBytes& bytes) {
  CO_IF_FRM frame{identifier, {}, 8};
  std::copy(bytes.begin(), bytes.end(), frame.Data);
  return frame;
}

// The server under test ------------------------------------------------

class Device {
 public:
  Device() {
    ext_.Size = sizeof ext_;
    ext_.Can = &can;
    ext_.Timer = &timer;
    ext_.CanCtx = this;
    ext_.TimerCtx = this;
    constexpr std::uint16_t entries = std::extent_v<decltype(table_)>;
    CO_NODE_SPEC spec{node_id, 250000, table_, entries, nullptr, nullptr, 0, 1000, nullptr, buffer_.get()};
    CONodeInitEx(&node_, &spec, &ext_);
    fuzz::require(CONodeGetErr(&node_) == CO_ERR_NONE, "the node starts");
    CONodeStart(&node_);
    sent_.clear();
  }
  ~Device() { CONodeStop(&node_); }
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  void receive(const CO_IF_FRM& request) { received_ = request; }
  void process() { fuzz::process(node_); }
  void pass(std::uint32_t ticks) {
    now_ += ticks;
    COTmrService(&node_.Tmr);
    COTmrProcess(&node_.Tmr);
  }
  // Returns the frames sent since the last call.
  std::vector<CO_IF_FRM> take_sent() { return std::exchange(sent_, {}); }

  unsigned accepts = always;  // number of frames that the controller still accepts

  // Returns the objects before any download.
  static std::vector<SdoObject> objects() {
    using Kind = SdoObject::Kind;
    const char* const text = "a text that is long";
    return {
        {0x1001, 0, true, false, Kind::number, 1, {0}},
        {0x1018, 1, true, false, Kind::number, 4, {9, 0, 0, 0}},
        {0x2000, 0, true, true, Kind::number, 1, {1}},
        {0x2000, 1, true, true, Kind::number, 2, {2, 0}},
        {0x2000, 2, true, true, Kind::number, 3, {3, 0, 0}},
        {0x2000, 3, true, true, Kind::number, 8, {4, 0, 0, 0, 0, 0, 0, 0}},
        {0x2000, 4, false, true, Kind::number, 1, {5}},
        {0x2000, 5, true, true, Kind::boolean, 1, {0}},
        {0x2000, 6, true, true, Kind::number, 4, {node_id, 1, 0, 0}},
        {0x2000, 7, false, false, Kind::number, 2, {7, 0}},
        {0x2000, 8, true, true, Kind::number, 3, {0xFF, 0xFF, 0xFF}},
        {0x2000, 9, true, true, Kind::number, 5, {8, 0, 0, 0, 0}},
        {0x2001, 0, true, true, Kind::domain, 30, Bytes(30)},
        {0x2001, 1, true, true, Kind::text, 12, {'h', 'e', 'l', 'l', 'o'}},
        {0x2001, 2, true, true, Kind::octets, 9, Bytes(9)},
        {0x2001, 3, true, true, Kind::characters, 8, {0x41, 0x00, 0xAC, 0x20}},
        {0x2001, 4, true, true, Kind::octets, 3, {1}},
        {0x2001, 5, true, false, Kind::text, 0, Bytes(text, text + std::strlen(text))},
        {0x2001, 6, true, true, Kind::domain, large_size, Bytes(large_size)},
    };
  }

  // Returns the present values of the variables in the order of objects(), except the last two.
  std::vector<Bytes> values() const {
    std::vector<Bytes> all = {Bytes{error_register_}, Bytes{9, 0, 0, 0}};
    all.insert(all.end(), {number(u8_, 1), number(u16_, 2), number(u24_, 3), number(u64_, 8)});
    all.insert(all.end(), {number(write_only_, 1), number(boolean_, 1), number(relative_ + node_id, 4)});
    all.insert(all.end(), {number(no_access_, 2), number(static_cast<std::uint32_t>(s24_), 3), number(u40_, 5)});
    all.push_back(Bytes(std::begin(domain_memory_), std::end(domain_memory_)));
    for (const CO_OBJ_STR_RW* string : {&text_, &octets_, &unicode_, &small_}) {
      fuzz::require(string->Size <= string->Capacity, "a string fits its memory");
      all.push_back(Bytes(string->Start, string->Start + string->Size));
    }
    return all;
  }

  // Checks that a value is extended correctly in a variable that is wider than the value.
  bool is_extended() const {
    const bool has_sign = s24_ >= -0x800000 && s24_ <= 0x7FFFFF;
    return u24_ <= 0xFFFFFF && u40_ <= 0xFFFFFFFFFF && has_sign;
  }

  bool holds(const Bytes& large) const { return std::equal(large.begin(), large.end(), large_memory_); }

 private:
  static Bytes number(std::uint64_t value, unsigned width) {
    Bytes bytes;
    for (unsigned n = 0; n < width; ++n) {
      bytes.push_back(static_cast<std::uint8_t>(value >> (8 * n)));
    }
    return bytes;
  }

  static Device& of(void* ctx) { return *static_cast<Device*>(ctx); }
  static void nothing(void*) {}
  static void no_number(void*, std::uint32_t) {}
  static std::uint32_t time(void* ctx) { return of(ctx).now_; }
  static std::int16_t read(void* ctx, CO_IF_FRM* frame) {
    std::optional<CO_IF_FRM>& received = of(ctx).received_;
    if (!received) {
      return 0;
    }
    *frame = *received;
    received.reset();
    return sizeof *frame;
  }
  static std::int16_t send(void* ctx, const CO_IF_FRM* frame) {
    Device& device = of(ctx);
    if (device.accepts == 0) {
      return 0;
    }
    device.accepts -= device.accepts == always ? 0 : 1;
    device.sent_.push_back(*frame);
    return sizeof *frame;
  }
  static constexpr CO_IF_CAN_DRV_EX can = {nothing, no_number, read, send, nothing, nothing, nullptr, nullptr};
  static constexpr CO_IF_TIMER_DRV_EX timer = {no_number, time, nullptr};

  std::uint8_t error_register_ = 0;
  std::uint8_t u8_ = 1;
  std::uint16_t u16_ = 2;
  std::uint32_t u24_ = 3;
  std::uint64_t u64_ = 4;
  std::uint8_t write_only_ = 5;
  std::uint8_t boolean_ = 0;
  std::uint32_t relative_ = 0x100;
  std::uint16_t no_access_ = 7;
  std::int32_t s24_ = -1;
  std::uint64_t u40_ = 8;
  std::uint8_t domain_memory_[30] = {};
  std::uint8_t text_memory_[12] = {'h', 'e', 'l', 'l', 'o'};
  std::uint8_t octets_memory_[9] = {};
  std::uint16_t unicode_memory_[4] = {0x0041, 0x20AC};
  std::uint8_t small_memory_[3] = {1};
  std::uint8_t large_memory_[large_size] = {};
  CO_OBJ_DOM domain_{0, 30, domain_memory_};
  CO_OBJ_STR_RW text_{0, 5, 12, text_memory_};
  CO_OBJ_STR_RW octets_{0, 9, 9, octets_memory_};
  CO_OBJ_STR_RW unicode_{0, 4, 8, reinterpret_cast<std::uint8_t*>(unicode_memory_)};
  CO_OBJ_STR_RW small_{0, 1, 3, small_memory_};
  CO_OBJ_DOM large_{0, large_size, large_memory_};
  CO_OBJ_STR name_{0, reinterpret_cast<const std::uint8_t*>("a text that is long")};
  CO_OBJ table_[19] = {
      {CO_KEY(0x1001, 0, CO_OBJ_____R_), CO_TUNSIGNED8, (CO_DATA)(&error_register_)},
      {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(9)},
      {CO_KEY(0x2000, 0, CO_OBJ_____RW), CO_TUNSIGNED8, (CO_DATA)(&u8_)},
      {CO_KEY(0x2000, 1, CO_OBJ_____RW), CO_TUNSIGNED16, (CO_DATA)(&u16_)},
      {CO_KEY(0x2000, 2, CO_OBJ_____RW), CO_TUNSIGNED24, (CO_DATA)(&u24_)},
      {CO_KEY(0x2000, 3, CO_OBJ_____RW), CO_TUNSIGNED64, (CO_DATA)(&u64_)},
      {CO_KEY(0x2000, 4, CO_OBJ______W), CO_TUNSIGNED8, (CO_DATA)(&write_only_)},
      {CO_KEY(0x2000, 5, CO_OBJ_____RW), CO_TBOOLEAN, (CO_DATA)(&boolean_)},
      {CO_KEY(0x2000, 6, CO_OBJ__N__RW), CO_TUNSIGNED32, (CO_DATA)(&relative_)},
      {CO_KEY(0x2000, 7, CO_OBJ_______), CO_TUNSIGNED16, (CO_DATA)(&no_access_)},
      {CO_KEY(0x2000, 8, CO_OBJ_____RW), CO_TSIGNED24, (CO_DATA)(&s24_)},
      {CO_KEY(0x2000, 9, CO_OBJ_____RW), CO_TUNSIGNED40, (CO_DATA)(&u40_)},
      {CO_KEY(0x2001, 0, CO_OBJ_____RW), CO_TDOMAIN, (CO_DATA)(&domain_)},
      {CO_KEY(0x2001, 1, CO_OBJ_____RW), CO_TVISIBLE_STRING, (CO_DATA)(&text_)},
      {CO_KEY(0x2001, 2, CO_OBJ_____RW), CO_TOCTET_STRING, (CO_DATA)(&octets_)},
      {CO_KEY(0x2001, 3, CO_OBJ_____RW), CO_TUNICODE_STRING, (CO_DATA)(&unicode_)},
      {CO_KEY(0x2001, 4, CO_OBJ_____RW), CO_TOCTET_STRING, (CO_DATA)(&small_)},
      {CO_KEY(0x2001, 5, CO_OBJ_____R_), CO_TSTRING, (CO_DATA)(&name_)},
      {CO_KEY(0x2001, 6, CO_OBJ_____RW), CO_TDOMAIN, (CO_DATA)(&large_)},
  };
  std::optional<CO_IF_FRM> received_;
  std::vector<CO_IF_FRM> sent_;
  std::uint32_t now_ = 0xFFFFF000;  // wraps after 4096 ms
  // Allocated separately, so that the address sanitizer detects accesses beyond the end.
  std::unique_ptr<std::uint8_t[]> buffer_ = std::make_unique<std::uint8_t[]>(CO_SSDO_N * CO_SDO_BUF_BYTE);
  CO_NODE_EXT ext_{};
  CO_NODE node_{};
};

// The requests ---------------------------------------------------------

class Client {
 public:
  explicit Client(fuzz::Input input) : input_(input) {}

  void run() {
    for (unsigned n = 1; !input_.is_empty(); ++n) {
      step(input_.byte());
      if (n % steps_between_looks == 0) {
        check_objects();
      }
    }
    check_objects();
  }

 private:
  static constexpr std::size_t longest_queue = CO_TX_QUEUE_N - 2;
  static constexpr unsigned steps_between_looks = 16;  // checking all objects takes longer than a step

  void fill(SdoBytes& bytes, std::size_t first) {
    std::generate(bytes.begin() + static_cast<std::ptrdiff_t>(first), bytes.end(), [this] { return input_.byte(); });
  }

  SdoBytes initiate() {
    constexpr std::uint8_t commands[] = {0x40, 0x21, 0x20, 0x2F, 0x2B, 0x27, 0x23, 0x22,
                                         0xC0, 0xC2, 0xC4, 0xC6, 0xC6, 0xA0, 0xA4, 0xA4};
    const SdoObject& object = model_.objects()[input_.below(model_.objects().size())];
    const auto low = static_cast<std::uint8_t>(object.index);
    const auto high = static_cast<std::uint8_t>(object.index >> 8);
    SdoBytes bytes = {commands[input_.below(std::size(commands))], low, high, object.sub};
    const bool tells_size = bytes[0] == 0x21 || bytes[0] == 0xC2 || bytes[0] == 0xC6;
    if (tells_size) {
      const std::uint32_t size = input_.flag() ? object.capacity : input_.byte();
      bytes[4] = static_cast<std::uint8_t>(size);
      bytes[5] = static_cast<std::uint8_t>(size >> 8);
    } else {
      fill(bytes, 4);
    }
    return bytes;
  }

  SdoBytes continued(bool shorter) {
    SdoBytes bytes = model_.continued(shorter);
    if (bytes[0] < 0x20 || model_.is_in_block()) {
      fill(bytes, 1);
    }
    return bytes;
  }

  void step(std::uint8_t kind) {
    switch (kind & 0x1FU) {
      case 0:
      case 1: {
        SdoBytes bytes{};
        fill(bytes, 0);
        ask(bytes);
        break;
      }
      case 2:
      case 3:
      case 4:
      case 5: ask(initiate()); break;
      case 6:
      case 7: ask(continued(true)); break;
      case 8: ask(initiate(), static_cast<std::uint8_t>(input_.below(16))); break;
      case 9: be_silent(1 + input_.below(9)); break;
      case 10: be_silent(2); break;
      case 11: refuse(input_.below(16)); break;
      case 12: refuse(always); break;
      case 13: repeat(); break;
      case 14: acknowledge(); break;
      case 15: ask({static_cast<std::uint8_t>(0x80U | (input_.byte() & 0x7FU))}); break;
      case 16:
      case 17: go_on(input_.below(160)); break;
      default: ask(continued(false)); break;
    }
  }

  // Sends up to \a number segments of a block, all with the same data.
  void go_on(unsigned number) {
    const std::uint8_t data = input_.byte();
    for (; number > 0 && model_.is_in_block(); --number) {
      SdoBytes bytes = model_.continued(false);
      std::fill(bytes.begin() + 1, bytes.end(), data);
      ask(bytes);
    }
  }

  void repeat() { ask(latest_); }

  void acknowledge() { ask({0xA2, input_.byte(), input_.byte()}); }

  // Sends a request. DLC codes above 8 mean 8 bytes [ISO 11898-1]; shorter frames are not requests.
  void ask(const SdoBytes& bytes, std::uint8_t length = 8) {
    latest_ = bytes;
    CO_IF_FRM request = frame_of(0x600U + node_id, bytes);
    request.DLC = length;
    expect_waiting();
    device_.receive(request);
    fuzz::given = {request.Identifier, request.DLC, request.Data, true};
    device_.process();
    if (length >= 8) {
      expect(model_.answer(bytes));
    }
    check_sent();
  }

  void be_silent(std::uint32_t slices) {
    for (; slices > 0; --slices) {
      device_.pass(slice);
      expect(model_.slice());
      check_sent();
    }
  }

  void refuse(unsigned after) {
    device_.accepts = after;
    accepts_ = after;
    expect_waiting();
    device_.process();
    check_sent();
  }

  // Queues an expected response while the controller refuses frames. Segments are produced only when it accepts them.
  void expect(const std::optional<SdoBytes>& answer) {
    if (answer) {
      waiting_.push_back(*answer);
    }
    expect_waiting();
  }

  void expect_waiting() {
    while (accepts_ > 0) {
      std::optional<SdoBytes> next;
      if (waiting_.empty()) {
        next = model_.segment();
      } else {
        next = waiting_.front();
        waiting_.pop_front();
      }
      if (!next) {
        return;
      }
      expected_.push_back(*next);
      accepts_ -= accepts_ == always ? 0 : 1;
    }
  }

  void check_sent() {
    const std::vector<CO_IF_FRM> sent = device_.take_sent();
    fuzz::require(sent.size() == expected_.size(), "as many frames as the standard says");
    for (std::size_t n = 0; n < sent.size(); ++n) {
      const bool is_answer = sent[n].Identifier == 0x580U + node_id && sent[n].DLC == 8;
      const bool same = std::equal(expected_[n].begin(), expected_[n].end(), sent[n].Data);
      fuzz::require(is_answer && same, "a frame is that of the standard");
    }
    expected_.clear();
    if (waiting_.size() >= longest_queue) {
      refuse(always);
    }
  }

  void check_objects() const {
    const std::vector<Bytes> values = device_.values();
    for (std::size_t n = 0; n < values.size(); ++n) {
      fuzz::require(values[n] == model_.objects()[n].value, "an object has the value that was downloaded");
    }
    fuzz::require(device_.holds(model_.objects().back().value), "a domain has the bytes that were downloaded");
    fuzz::require(device_.is_extended(), "a variable that is wider than its value has its sign");
  }

  fuzz::Input input_;
  SdoServerModel model_{Device::objects(), CO_SDO_BUF_SEG};
  Device device_;
  SdoBytes latest_{};
  unsigned accepts_ = always;       // number of frames that the controller still accepts
  std::deque<SdoBytes> waiting_;    // responses that the controller has not accepted yet
  std::vector<SdoBytes> expected_;  // frames that the device must have sent
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Client(fuzz::Input(data, size)).run();
  return 0;
}
