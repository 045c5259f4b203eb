// SPDX-License-Identifier: Apache-2.0
// Requests of chance to an SDO server, beside a model that knows the protocol of the standard and nothing of the stack:
// every answer and all data must be the same. [301:7.2.4.3]
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <optional>
#include <type_traits>
#include <vector>

#include "co_core.h"
#include "fuzz/fuzz.hpp"
#include "support/invariants.hpp"

namespace {

using Bytes = std::vector<std::uint8_t>;
using Frame = std::array<std::uint8_t, 8>;

constexpr std::uint8_t node_id = 5;

// What an object looks like from the network.
struct Object {
  enum class Kind { number, boolean, domain, octets, text, characters };
  std::uint16_t index;
  std::uint8_t sub;
  bool readable;
  bool writable;
  Kind kind;
  std::uint32_t capacity;
  Bytes value;

  bool is_stream() const { return kind != Kind::number && kind != Kind::boolean; }

  // A text ends at its first NUL. A transfer that was cut off within a character leaves only whole ones.
  Bytes shown() const {
    auto end = kind == Kind::text ? std::find(value.begin(), value.end(), 0) : value.end();
    end -= kind == Kind::characters ? static_cast<std::ptrdiff_t>(value.size() % 2) : 0;
    return Bytes(value.begin(), end);
  }
  void set(const Bytes& bytes) {
    if (kind == Kind::domain) {
      std::copy(bytes.begin(), bytes.end(), value.begin());
    } else {
      value = bytes;
    }
  }
};

// The server of the standard.
// ------------------------------------------------------------------------------------------

class Model {
 public:
  explicit Model(std::vector<Object> objects) : objects_(std::move(objects)) {}

  // Nothing: the request is not answered.
  std::optional<Frame> answer(const Frame& request) {
    const unsigned specifier = request[0] >> 5;
    if ((request[0] & reserved[specifier]) != 0) {
      return refuse(request, 0x05040001);
    }
    switch (specifier) {
      case 0: return state_ == State::download ? take(request) : refuse(request, 0x05040001);
      case 1:
      case 2: return initiate(request);
      case 3: return state_ == State::upload ? give(request) : refuse(request, 0x05040001);
      case 4: state_ = State::idle; return std::nullopt;
      default: return refuse(request, 0x05040001);
    }
  }

  const std::vector<Object>& objects() const { return objects_; }

  // A request that goes on with what is open, for inputs that get far.
  Frame continued(bool shorter) const {
    if (state_ != State::download) {
      return {static_cast<std::uint8_t>(0x60 | toggle_)};
    }
    const std::size_t left = size_ - data_.size();
    const std::size_t length = std::min<std::size_t>(7, left > 0 && shorter ? left - 1 : left);
    const unsigned last = length == left || shorter ? 1 : 0;
    return {static_cast<std::uint8_t>(toggle_ | ((7 - length) << 1) | last)};
  }

 private:
  enum class State { idle, download, upload };
  static constexpr std::uint8_t reserved[8] = {0x00, 0x10, 0x1F, 0x0F, 0x00, 0x00, 0x00, 0x00};

  static Frame abort(const std::uint8_t* key, std::uint32_t code) {
    return {0x80,
            key[0],
            key[1],
            key[2],
            static_cast<std::uint8_t>(code),
            static_cast<std::uint8_t>(code >> 8),
            static_cast<std::uint8_t>(code >> 16),
            static_cast<std::uint8_t>(code >> 24)};
  }

  // Ends what is open; the abort names that, or else what the request names.
  Frame refuse(const Frame& request, std::uint32_t code) {
    const bool within = state_ != State::idle;
    state_ = State::idle;
    return abort(within ? key_.data() : &request[1], code);
  }

  bool has_index(std::uint16_t index) const {
    return std::any_of(objects_.begin(), objects_.end(), [=](const Object& object) { return object.index == index; });
  }

  std::optional<Frame> initiate(const Frame& request) {
    state_ = State::idle;
    std::copy_n(request.begin() + 1, 3, key_.begin());
    const auto index = static_cast<std::uint16_t>(request[1] | (request[2] << 8));
    const bool upload = request[0] == 0x40;
    const auto found = std::find_if(objects_.begin(), objects_.end(), [&](const Object& object) {
      return object.index == index && object.sub == request[3];
    });
    if (found == objects_.end()) {
      return refuse(request, has_index(index) ? 0x06090011 : 0x06020000);
    }
    object_ = &*found;
    if (!(upload ? object_->readable : object_->writable)) {
      const bool none = !object_->readable && !object_->writable;
      return refuse(request, none ? 0x06010000 : upload ? 0x06010001 : 0x06010002);
    }
    toggle_ = 0;
    data_.clear();
    return upload ? begin_upload() : begin_download(request);
  }

  Frame head(unsigned command) const { return {static_cast<std::uint8_t>(command), key_[0], key_[1], key_[2]}; }

  Frame begin_upload() {
    data_ = object_->shown();
    done_ = 0;
    const std::size_t size = data_.size();
    if (size >= 1 && size <= 4) {
      Frame frame = head(0x43 | static_cast<unsigned>((4 - size) << 2));
      std::copy(data_.begin(), data_.end(), frame.begin() + 4);
      return frame;
    }
    state_ = State::upload;
    Frame frame = head(0x41);
    frame[4] = static_cast<std::uint8_t>(size);
    return frame;
  }

  // 0: a download may have this length.
  std::uint32_t fault_of_length(std::size_t length) const {
    const bool half_character = object_->kind == Object::Kind::characters && length % 2 != 0;
    if (length > object_->capacity || half_character) {
      return 0x06070012;
    }
    return length < object_->capacity && !object_->is_stream() ? 0x06070013 : 0;
  }

  std::uint32_t fault_of_value() const {
    return object_->kind == Object::Kind::boolean && data_[0] > 1 ? 0x06090030 : 0;
  }

  Frame begin_download(const Frame& request) {
    sized_ = (request[0] & 0x01) != 0;
    if ((request[0] & 0x02) != 0) {
      return expedited(request);
    }
    size_ = object_->capacity;
    if (sized_) {
      size_ = request[4] | (std::uint32_t{request[5]} << 8) | (std::uint32_t{request[6]} << 16) |
              (std::uint32_t{request[7]} << 24);
      if (const std::uint32_t fault = fault_of_length(size_); fault != 0) {
        return refuse(request, fault);
      }
    }
    if (object_->is_stream()) {
      object_->set({});
    }
    state_ = State::download;
    return head(0x60);
  }

  Frame expedited(const Frame& request) {
    const std::uint32_t length = sized_ ? 4U - ((request[0] >> 2) & 3U) : object_->capacity;
    if (length > 4) {
      return refuse(request, 0x06070010);
    }
    if (const std::uint32_t fault = fault_of_length(length); fault != 0) {
      return refuse(request, fault);
    }
    data_.assign(request.begin() + 4, request.begin() + 4 + length);
    if (const std::uint32_t fault = fault_of_value(); fault != 0) {
      return refuse(request, fault);
    }
    object_->set(data_);
    return head(0x60);
  }

  Frame take(const Frame& request) {
    const std::uint8_t toggle = request[0] & 0x10;
    const std::size_t length = 7U - ((request[0] >> 1) & 7U);
    if (toggle != toggle_) {
      return refuse(request, 0x05030000);
    }
    if (data_.size() + length > size_) {
      return refuse(request, 0x06070012);
    }
    data_.insert(data_.end(), request.begin() + 1, request.begin() + 1 + static_cast<std::ptrdiff_t>(length));
    if (object_->is_stream()) {
      object_->set(data_);
    }
    toggle_ ^= 0x10;
    const std::uint32_t fault = (request[0] & 0x01) != 0 ? end_download() : 0;
    return fault != 0 ? refuse(request, fault) : Frame{static_cast<std::uint8_t>(0x20 | toggle)};
  }

  std::uint32_t end_download() {
    const std::uint32_t too_short = data_.size() < size_ ? 0x06070013 : 0;
    if (const std::uint32_t fault = sized_ ? too_short : fault_of_length(data_.size()); fault != 0) {
      return fault;
    }
    if (const std::uint32_t fault = fault_of_value(); fault != 0) {
      return fault;
    }
    object_->set(data_);
    state_ = State::idle;
    return 0;
  }

  Frame give(const Frame& request) {
    const std::uint8_t toggle = request[0] & 0x10;
    if (toggle != toggle_) {
      return refuse(request, 0x05030000);
    }
    const std::size_t length = std::min<std::size_t>(7, data_.size() - done_);
    const bool last = done_ + length == data_.size();
    Frame frame = {static_cast<std::uint8_t>(toggle | ((7 - length) << 1) | (last ? 1U : 0U))};
    std::copy_n(data_.begin() + static_cast<std::ptrdiff_t>(done_), length, frame.begin() + 1);
    done_ += length;
    toggle_ ^= 0x10;
    state_ = last ? State::idle : State::upload;
    return frame;
  }

  std::vector<Object> objects_;
  State state_ = State::idle;
  Object* object_ = nullptr;
  std::array<std::uint8_t, 3> key_{};  // of the object, as in the frame
  std::uint8_t toggle_ = 0;
  bool sized_ = false;
  std::uint32_t size_ = 0;  // bytes that a download will have, or may have
  std::size_t done_ = 0;    // bytes of an upload
  Bytes data_;
};

// The server under test.
// -----------------------------------------------------------------------------------------------

class Device {
 public:
  Device() {
    ext_.Size = sizeof ext_;
    ext_.Can = &can;
    ext_.Timer = &timer;
    ext_.CanCtx = this;
    constexpr std::uint16_t entries = std::extent_v<decltype(table_)>;
    CO_NODE_SPEC spec{node_id, 250000, table_, entries, nullptr, nullptr, 0, 1000, nullptr, nullptr};
    CONodeInitEx(&node_, &spec, &ext_);
    fuzz::require(CONodeGetErr(&node_) == CO_ERR_NONE, "the node starts");
    CONodeStart(&node_);
    sent_.clear();
  }
  ~Device() { CONodeStop(&node_); }
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  std::vector<CO_IF_FRM> ask(const CO_IF_FRM& request) {
    received_ = request;
    sent_.clear();
    CONodeProcess(&node_);
    return sent_;
  }

  // The objects as they are before any download.
  static std::vector<Object> objects() {
    using Kind = Object::Kind;
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
    };
  }

  // The bytes that the variables show now, in the order of objects().
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

  // Variables that are wider than their value.
  bool is_extended() const {
    const bool has_sign = s24_ >= -0x800000 && s24_ <= 0x7FFFFF;
    return u24_ <= 0xFFFFFF && u40_ <= 0xFFFFFFFFFF && has_sign;
  }

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
  static std::uint32_t no_time(void*) { return 0; }
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
    of(ctx).sent_.push_back(*frame);
    return sizeof *frame;
  }
  static constexpr CO_IF_CAN_DRV_EX can = {nothing, no_number, read, send, nothing, nothing, nullptr};
  static constexpr CO_IF_TIMER_DRV_EX timer = {no_number, no_time, nullptr};

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
  CO_OBJ_DOM domain_{0, 30, domain_memory_};
  CO_OBJ_STR_RW text_{0, 5, 12, text_memory_};
  CO_OBJ_STR_RW octets_{0, 9, 9, octets_memory_};
  CO_OBJ_STR_RW unicode_{0, 4, 8, reinterpret_cast<std::uint8_t*>(unicode_memory_)};
  CO_OBJ_STR_RW small_{0, 1, 3, small_memory_};
  CO_OBJ_STR name_{0, reinterpret_cast<const std::uint8_t*>("a text that is long")};
  CO_OBJ table_[18] = {
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
  };
  std::optional<CO_IF_FRM> received_;
  std::vector<CO_IF_FRM> sent_;
  CO_NODE_EXT ext_{};
  CO_NODE node_{};
};

// The requests.
// --------------------------------------------------------------------------------------------------------

class Client {
 public:
  explicit Client(fuzz::Input input) : input_(input) {}

  void run() {
    while (!input_.is_empty()) {
      step();
    }
  }

 private:
  Frame random_bytes() {
    Frame frame;
    std::generate(frame.begin(), frame.end(), [this] { return input_.byte(); });
    return frame;
  }

  Frame initiate() {
    constexpr std::uint8_t commands[] = {0x40, 0x21, 0x20, 0x2F, 0x2B, 0x27, 0x23, 0x22};
    Frame frame{};
    frame[0] = commands[input_.below(std::size(commands))];
    const Object& object = model_.objects()[input_.below(model_.objects().size())];
    frame[1] = static_cast<std::uint8_t>(object.index);
    frame[2] = static_cast<std::uint8_t>(object.index >> 8);
    frame[3] = object.sub;
    const bool exact = frame[0] == 0x21 && input_.flag();
    frame[4] = exact ? static_cast<std::uint8_t>(object.capacity) : input_.byte();
    if (frame[0] != 0x21) {
      std::generate(frame.begin() + 5, frame.end(), [this] { return input_.byte(); });
    }
    return frame;
  }

  Frame segment(bool shorter) {
    Frame frame = model_.continued(shorter);
    if (frame[0] < 0x20) {
      std::generate(frame.begin() + 1, frame.end(), [this] { return input_.byte(); });
    }
    return frame;
  }

  Frame any_request(std::uint8_t kind) {
    switch (kind & 7U) {
      case 0: return random_bytes();
      case 1: return segment(true);
      case 2:
      case 3: return initiate();
      default: return segment(false);
    }
  }

  // Length codes of more than 8 mean 8 bytes [ISO 11898-1]; shorter frames are no requests.
  void step() {
    const std::uint8_t kind = input_.byte();
    const auto length = static_cast<std::uint8_t>((kind & 0xF0U) == 0xF0U ? input_.below(16) : 8);
    const Frame bytes = any_request(kind);
    CO_IF_FRM request{0x600U + node_id, {}, length};
    std::copy(bytes.begin(), bytes.end(), request.Data);
    const std::vector<CO_IF_FRM> answers = device_.ask(request);
    const std::optional<Frame> expected = length < 8 ? std::nullopt : model_.answer(bytes);
    fuzz::require(answers.size() == (expected ? 1U : 0U), "one answer, or none");
    if (expected) {
      check(answers[0], *expected);
    }
    check_objects();
  }

  static void check(const CO_IF_FRM& answer, const Frame& expected) {
    fuzz::require(test::fault_of(answer, node_id, CO_PREOP, true).empty(), "the answer has the form of an SDO");
    fuzz::require(answer.Identifier == 0x580U + node_id, "the answer has the identifier of the server");
    fuzz::require(std::equal(expected.begin(), expected.end(), answer.Data), "the answer is that of the standard");
  }

  void check_objects() const {
    const std::vector<Bytes> values = device_.values();
    for (std::size_t n = 0; n < values.size(); ++n) {
      fuzz::require(values[n] == model_.objects()[n].value, "an object has the value that was downloaded");
    }
    fuzz::require(device_.is_extended(), "a variable that is wider than its value has its sign");
  }

  fuzz::Input input_;
  Model model_{Device::objects()};
  Device device_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Client(fuzz::Input(data, size)).run();
  return 0;
}
