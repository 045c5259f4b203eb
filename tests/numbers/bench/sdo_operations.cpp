// SPDX-License-Identifier: Apache-2.0
// Cost of the SDO server, from a request to its response. Frames have the bytes that CiA 301 specifies.
#include <algorithm>
#include <iterator>

#include "device.hpp"
#include "measure.hpp"
#include "operations.hpp"
#include "random.hpp"

namespace bench {
namespace {

constexpr std::uint32_t request_id = 0x600 + node_id;
constexpr std::uint32_t response_id = 0x580 + node_id;
constexpr unsigned segment_bytes = 7;
constexpr unsigned block_segments = 127;
constexpr unsigned block_bytes = block_segments * segment_bytes;

constexpr std::uint8_t values = 16;
std::uint32_t value[values];

std::uint8_t data[20 * block_bytes];    // data of the client
std::uint8_t object[20 * block_bytes];  // object 2010h of the server
CO_OBJ_DOM domain;

void set_up_server(std::uint32_t size) {
  Random random;
  std::generate(std::begin(data), std::end(data), [&] { return random.byte(); });
  domain = {0, size, object};
  clear_dictionary();
  add_usual_objects();
  for (std::uint8_t n = 0; n < values; ++n) {
    add(0x2000, static_cast<std::uint8_t>(n + 1), CO_OBJ_____RW, CO_TUNSIGNED32, (CO_DATA)(&value[n]));
  }
  add(0x2010, 0, CO_OBJ_____RW, CO_TDOMAIN, (CO_DATA)(&domain));
  start(CO_PREOP);
}

constexpr std::uint8_t byte_of(std::uint32_t number, unsigned place) {
  return static_cast<std::uint8_t>(number >> (8 * place));
}

CO_IF_FRM command(std::uint32_t id, std::uint8_t specifier, std::uint16_t index, std::uint8_t sub, std::uint32_t last) {
  return frame(id, {specifier, byte_of(index, 0), byte_of(index, 1), sub, byte_of(last, 0), byte_of(last, 1),
                    byte_of(last, 2), byte_of(last, 3)});
}

CO_IF_FRM request(std::uint8_t first, std::uint8_t second = 0, std::uint8_t third = 0) {
  return frame(request_id, {first, second, third, 0, 0, 0, 0, 0});
}

CO_IF_FRM segment(std::uint32_t id, std::uint8_t specifier, const std::uint8_t* bytes) {
  CO_IF_FRM made = frame(id, {specifier, 0, 0, 0, 0, 0, 0, 0});
  std::copy_n(bytes, segment_bytes, made.Data + 1);
  return made;
}

// Processes all frames that a block transfer has pending.
void process_all() {
  do {
    CONodeProcess(&node);
  } while (CONodeNextDeadline(&node) == 0);
}

// Processes a frame that prepares an operation.
void process(const CO_IF_FRM& frame) {
  forget_sent();
  receive(frame);
  process_all();
}

void expect(const CO_IF_FRM& answer) {
  if (!has_sent(answer)) {
    fail("SDO", "a transfer has not begun or not ended");
  }
}

// Returns the CRC-16-CCITT with start value 0. [301:7.2.4.3.16]
std::uint16_t crc_of(const std::uint8_t* bytes, std::size_t number) {
  std::uint32_t crc = 0;
  for (std::size_t n = 0; n < number; ++n) {
    crc ^= std::uint32_t{bytes[n]} << 8;
    for (int bit = 0; bit < 8; ++bit) {
      crc = ((crc << 1) ^ ((crc & 0x8000) != 0 ? 0x1021u : 0u)) & 0xFFFF;
    }
  }
  return static_cast<std::uint16_t>(crc);
}

// A request and its response.
class Exchange : public Operation {
 public:
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
  CO_IF_FRM answer_{};
};

class ExpeditedUpload : public Exchange {
 public:
  void set_up() { set_up_server(0); }
  void arrange(unsigned) {
    const std::uint32_t place = random_.below(values);
    const auto sub = static_cast<std::uint8_t>(place + 1);
    value[place] = random_.next();
    ask(command(request_id, 0x40, 0x2000, sub, 0), command(response_id, 0x43, 0x2000, sub, value[place]));
  }
};

class ExpeditedDownload : public Exchange {
 public:
  void set_up() { set_up_server(0); }
  void arrange(unsigned) {
    place_ = random_.below(values);
    const auto sub = static_cast<std::uint8_t>(place_ + 1);
    written_ = random_.next();
    ask(command(request_id, 0x23, 0x2000, sub, written_), command(response_id, 0x60, 0x2000, sub, 0));
  }
  bool is_done(unsigned n) { return Exchange::is_done(n) && value[place_] == written_; }

 private:
  std::uint32_t place_ = 0;
  std::uint32_t written_ = 0;
};

class RefusedUpload : public Exchange {
 public:
  void set_up() { set_up_server(0); }
  void arrange(unsigned) {
    constexpr std::uint32_t no_such_object = 0x06020000;
    ask(command(request_id, 0x40, 0x2001, 0, 0), command(response_id, 0x80, 0x2001, 0, no_such_object));
  }
};

constexpr std::uint8_t toggle(unsigned n) { return n % 2 == 0 ? 0x00 : 0x10; }

constexpr std::uint32_t segmented_bytes = 2 * usual_number * segment_bytes + 1;  // the last segment is not measured

class SegmentedUpload : public Exchange {
 public:
  void set_up() {
    set_up_server(segmented_bytes);
    std::copy_n(data, segmented_bytes, object);
    process(command(request_id, 0x40, 0x2010, 0, 0));
    expect(command(response_id, 0x41, 0x2010, 0, segmented_bytes));
  }
  void arrange(unsigned n) {
    ask(request(static_cast<std::uint8_t>(0x60 | toggle(n))),
        segment(response_id, toggle(n), data + n * segment_bytes));
  }
};

class SegmentedDownload : public Exchange {
 public:
  void set_up() {
    set_up_server(segmented_bytes);
    process(command(request_id, 0x21, 0x2010, 0, segmented_bytes));
    expect(command(response_id, 0x60, 0x2010, 0, 0));
  }
  void arrange(unsigned n) {
    const auto answer = static_cast<std::uint8_t>(0x20 | toggle(n));
    ask(segment(request_id, toggle(n), data + n * segment_bytes), frame(response_id, {answer, 0, 0, 0, 0, 0, 0, 0}));
  }
  bool is_done(unsigned n) {
    const std::uint8_t* const written = object + n * segment_bytes;
    return Exchange::is_done(n) && std::equal(written, written + segment_bytes, data + n * segment_bytes);
  }
};

constexpr unsigned blocks = 8;
constexpr std::uint32_t block_upload_bytes = (2 * blocks + 1) * block_bytes;

// A sub-block of an upload: from the acknowledge of the previous one, in as many calls of CONodeProcess() as it needs.
class BlockUpload : public Operation {
 public:
  void set_up() {
    set_up_server(block_upload_bytes);
    std::copy_n(data, block_upload_bytes, object);
    process(command(request_id, 0xA4, 0x2010, 0, block_segments));
    expect(command(response_id, 0xC6, 0x2010, 0, block_upload_bytes));
    process(request(0xA3));
  }
  void arrange(unsigned) {
    forget_sent();
    receive(request(0xA2, block_segments, block_segments));
  }
  void run() {
    do {
      CONodeProcess(&node);
    } while (sent() < block_segments);
  }
  bool is_done(unsigned n) {
    const std::uint8_t* const block = data + (n + 1) * block_bytes;
    bool done = sent() == block_segments;
    for (unsigned k = 0; k < block_segments && done; ++k) {
      const bool last = n + 1 == 2 * blocks && k + 1 == block_segments;
      const auto number = static_cast<std::uint8_t>((k + 1) | (last ? 0x80u : 0u));
      done = is_same(sent(k), segment(response_id, number, block + k * segment_bytes));
    }
    return done;
  }
  void end() {
    const std::uint16_t crc = crc_of(data, block_upload_bytes);
    process(request(0xA2, block_segments, block_segments));
    expect(frame(response_id, {0xC1, byte_of(crc, 0), byte_of(crc, 1), 0, 0, 0, 0, 0}));
  }
};

constexpr unsigned downloaded_blocks = 4;
constexpr std::uint32_t block_download_bytes = (2 * downloaded_blocks + 1) * block_bytes;

// A segment of a block download; each 127th is acknowledged.
class BlockDownload : public Operation {
 public:
  void set_up() {
    set_up_server(block_download_bytes);
    process(command(request_id, 0xC6, 0x2010, 0, block_download_bytes));
    expect(command(response_id, 0xA4, 0x2010, 0, block_segments));
  }
  void arrange(unsigned n) {
    forget_sent();
    receive(segment(request_id, number_of(n), data + n * segment_bytes));
  }
  void run() { CONodeProcess(&node); }
  bool is_done(unsigned n) {
    if (number_of(n) != block_segments) {
      return sent() == 0;
    }
    return has_sent(frame(response_id, {0xA2, block_segments, block_segments, 0, 0, 0, 0, 0})) &&
           std::equal(data, data + (n + 1) * segment_bytes, object);
  }
  // Checks the transfer: the server would refuse a wrong CRC.
  void end() {
    const std::uint16_t crc = crc_of(data, block_download_bytes);
    for (unsigned k = 0; k < block_segments; ++k) {
      const auto number = static_cast<std::uint8_t>((k + 1) | (k + 1 == block_segments ? 0x80u : 0u));
      process(segment(request_id, number, data + 2 * downloaded_blocks * block_bytes + k * segment_bytes));
    }
    process(request(0xC1, byte_of(crc, 0), byte_of(crc, 1)));
    expect(frame(response_id, {0xA1, 0, 0, 0, 0, 0, 0, 0}));
  }

 private:
  static std::uint8_t number_of(unsigned n) { return static_cast<std::uint8_t>(n % block_segments + 1); }
};

}  // namespace

void measure_sdo() {
  measure("SDO expedited upload, 4 bytes", ExpeditedUpload());
  measure("SDO expedited download, 4 bytes", ExpeditedDownload());
  measure("SDO abort, no such object", RefusedUpload());
  measure_byte("SDO segmented upload, per byte", SegmentedUpload(), usual_number, segment_bytes);
  measure_byte("SDO segmented download, per byte", SegmentedDownload(), usual_number, segment_bytes);
  measure_byte("SDO block upload with CRC, per byte", BlockUpload(), blocks, block_bytes);
  measure_byte("SDO block download with CRC, per byte", BlockDownload(), downloaded_blocks * block_segments,
               segment_bytes);
}

}  // namespace bench
