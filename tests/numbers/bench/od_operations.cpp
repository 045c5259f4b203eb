// SPDX-License-Identifier: Apache-2.0
// Cost of an entry that can be extended (co_od.h), without an extension and with one, and of an entry that cannot.
#include <algorithm>
#include <cstring>
#include <iterator>

#include "device.hpp"
#include "measure.hpp"
#include "operations.hpp"
#include "random.hpp"

namespace bench {

#if USE_OD

namespace {

constexpr std::uint32_t request_id = 0x600 + node_id;
constexpr std::uint32_t response_id = 0x580 + node_id;
constexpr std::uint16_t objects = 100;  // objects of the index
constexpr std::uint16_t index_of_value = 0x2050;
constexpr std::uint16_t index_of_stream = 0x2051;
constexpr unsigned segment_bytes = 7;
constexpr std::uint32_t stream_bytes = 2 * usual_number * segment_bytes + 1;  // the last segment is not measured

std::uint32_t value = 0;
std::uint8_t bytes_of_stream[stream_bytes];
CO_OBJ_DOM domain;
OD_t od;
OD_entry_t list[OD_LIST_N(200)];

ODR_t read_value(OD_stream_t*, void* buf, OD_size_t count, OD_size_t* passed) {
  std::memcpy(buf, &value, sizeof value);
  *passed = count;
  return ODR_OK;
}
ODR_t write_value(OD_stream_t*, const void* buf, OD_size_t count, OD_size_t* passed) {
  std::memcpy(&value, buf, sizeof value);
  *passed = count;
  return ODR_OK;
}
ODR_t read_stream(OD_stream_t* stream, void* buf, OD_size_t count, OD_size_t* passed) {
  std::copy_n(bytes_of_stream + stream->dataOffset, count, static_cast<std::uint8_t*>(buf));
  stream->dataOffset += count;
  *passed = count;
  return ODR_PARTIAL;
}

OD_extension_t extension_of_value = {nullptr, read_value, write_value, {}};
OD_extension_t extension_of_stream = {nullptr, read_stream, nullptr, {}};

enum class Kind { plain, extensible, extended };

CO_IF_FRM command(std::uint32_t id, std::uint8_t specifier, std::uint16_t index, std::uint32_t last) {
  const auto part = [last](unsigned n) { return static_cast<std::uint8_t>(last >> (8 * n)); };
  return frame(id, {specifier, static_cast<std::uint8_t>(index), static_cast<std::uint8_t>(index >> 8), 0, part(0),
                    part(1), part(2), part(3)});
}

void extend(std::uint16_t index, OD_extension_t* extension) {
  if (OD_extension_init(OD_find(&od, index), extension) != ODR_OK) {
    fail("extension", "it is refused");
  }
}

void set_up_objects(Kind kind) {
  clear_dictionary();
  add_usual_objects();
  domain = {0, stream_bytes, bytes_of_stream};
  for (std::uint16_t n = 0; n < objects; ++n) {
    const auto index = static_cast<std::uint16_t>(0x2000 + n);
    if (index == index_of_stream) {
      add(index, 0, CO_OBJ_____RW, kind == Kind::plain ? CO_TDOMAIN : OD_TDOMAIN, (CO_DATA)(&domain));
    } else {
      add(index, 0, CO_OBJ_____RW, kind == Kind::plain ? CO_TUNSIGNED32 : OD_TUNSIGNED32, (CO_DATA)(&value));
    }
  }
  start(CO_PREOP);
  const std::uint16_t length = node.Dict.Num;
  if (OD_init(&od, list, OD_LIST_N(200), &node, node.Dict.Root, length) != ODR_OK) {
    fail("index", "it is refused");
  }
  static CO_NODE_EXT ext;
  ext = *node.Ext;
  ext.Od = &od;
  node.Ext = &ext;
  const bool extended = kind == Kind::extended;
  extend(index_of_value, extended ? &extension_of_value : nullptr);
  extend(index_of_stream, extended ? &extension_of_stream : nullptr);
}

class Exchange : public Operation {
 public:
  explicit Exchange(Kind kind) : kind_(kind) {}
  void set_up() { set_up_objects(kind_); }
  void run() { CONodeProcess(&node); }
  bool is_done(unsigned) { return has_sent(answer_); }

 protected:
  void ask(const CO_IF_FRM& question, const CO_IF_FRM& answer) {
    forget_sent();
    receive(question);
    answer_ = answer;
  }
  Random random_;

 private:
  Kind kind_;
  CO_IF_FRM answer_{};
};

class Upload : public Exchange {
 public:
  using Exchange::Exchange;
  void arrange(unsigned) {
    value = random_.next();
    ask(command(request_id, 0x40, index_of_value, 0), command(response_id, 0x43, index_of_value, value));
  }
};

class Download : public Exchange {
 public:
  using Exchange::Exchange;
  void arrange(unsigned) {
    written_ = random_.next();
    ask(command(request_id, 0x23, index_of_value, written_), command(response_id, 0x60, index_of_value, 0));
  }
  bool is_done(unsigned n) { return Exchange::is_done(n) && value == written_; }

 private:
  std::uint32_t written_ = 0;
};

class SegmentedUpload : public Exchange {
 public:
  using Exchange::Exchange;
  void set_up() {
    Exchange::set_up();
    std::generate(std::begin(bytes_of_stream), std::end(bytes_of_stream), [this] { return random_.byte(); });
    forget_sent();
    receive(command(request_id, 0x40, index_of_stream, 0));
    CONodeProcess(&node);
  }
  void arrange(unsigned n) {
    const std::uint8_t toggle = n % 2 == 0 ? 0x00 : 0x10;
    CO_IF_FRM answer = frame(response_id, {toggle, 0, 0, 0, 0, 0, 0, 0});
    std::copy_n(bytes_of_stream + n * segment_bytes, segment_bytes, answer.Data + 1);
    ask(frame(request_id, {static_cast<std::uint8_t>(0x60 | toggle), 0, 0, 0, 0, 0, 0, 0}), answer);
  }
};

class Get : public Operation {
 public:
  explicit Get(bool original) : original_(original) {}
  void set_up() { set_up_objects(Kind::extended); }
  void arrange(unsigned) { value = random_.next(); }
  void run() { OD_get_u32(OD_find(&od, index_of_value), 0, &read_, original_); }
  bool is_done(unsigned) { return read_ == value; }

 private:
  bool original_;
  Random random_;
  std::uint32_t read_ = 0;
};

class Read : public Operation {
 public:
  void set_up() {
    set_up_objects(Kind::extensible);
    OD_getSub(OD_find(&od, index_of_value), 0, &io_, false);
  }
  void arrange(unsigned) { value = random_.next(); }
  void run() {
    OD_size_t passed = 0;
    io_.read(&io_.stream, &read_, sizeof read_, &passed);
  }
  bool is_done(unsigned) { return read_ == value; }

 private:
  OD_IO_t io_{};
  Random random_;
  std::uint32_t read_ = 0;
};

}  // namespace

void measure_index() {
  measure("co_od.h: SDO expedited upload, an entry that cannot be extended", Upload(Kind::plain));
  measure("co_od.h: SDO expedited upload, not extended", Upload(Kind::extensible));
  measure("co_od.h: SDO expedited upload, extended", Upload(Kind::extended));
  measure("co_od.h: SDO expedited download, an entry that cannot be extended", Download(Kind::plain));
  measure("co_od.h: SDO expedited download, not extended", Download(Kind::extensible));
  measure("co_od.h: SDO expedited download, extended", Download(Kind::extended));
  measure_byte("co_od.h: SDO segmented upload, per byte, an entry that cannot be extended",
               SegmentedUpload(Kind::plain), usual_number, segment_bytes);
  measure_byte("co_od.h: SDO segmented upload, per byte, not extended", SegmentedUpload(Kind::extensible), usual_number,
               segment_bytes);
  measure_byte("co_od.h: SDO segmented upload, per byte, extended", SegmentedUpload(Kind::extended), usual_number,
               segment_bytes);
  measure("co_od.h: OD_get_u32 of the original", Get(true));
  measure("co_od.h: OD_get_u32, extended", Get(false));
  measure("co_od.h: read by a kept OD_IO_t", Read());
}

#else

void measure_index() {}

#endif

}  // namespace bench
