// SPDX-License-Identifier: Apache-2.0
#include "co_slcan.h"

#include "../atomic.hpp"

namespace {

constexpr int16_t one_frame = sizeof(CO_IF_FRM);
constexpr uint8_t end_of_line = '\r';
constexpr uint8_t bell = 7;

// Bytes of the transmit buffer that frames must not use. They suffice for the commands of two calls of Enable or Close:
// the node repeats a frame that Send has refused, but not a command.
constexpr uint32_t room_for_commands = 16;

constexpr uint8_t broken = UINT8_MAX;  // value of LineLen: the line cannot become a frame

// Error frame in the coding of SocketCAN: the controller (byte 0…3 of the identifier) has lost a received frame (byte 1
// of the data).
constexpr CO_IF_FRM overflow = {CO_IF_FRM_ERROR | 0x04U, {0, 0x01, 0, 0, 0, 0, 0, 0}, 8};

constexpr uint32_t bit_rates[] = {10000, 20000, 50000, 100000, 125000, 250000, 500000, 800000, 1000000};

using co::atomic::load;
using co::atomic::store;

void count(uint16_t& counter) {
  if (counter != UINT16_MAX) {
    store(counter, static_cast<uint16_t>(counter + 1));
  }
}

// --- Received text

constexpr uint8_t no_digit = 16;

uint8_t digit(uint8_t character) {
  if (character >= '0' && character <= '9') {
    return static_cast<uint8_t>(character - '0');
  }
  const auto letter = static_cast<uint8_t>(character | 0x20);
  return letter >= 'a' && letter <= 'f' ? static_cast<uint8_t>(letter - 'a' + 10) : no_digit;
}

// Parses hexadecimal numbers from a line. After a fault, good() is false and the numbers are undefined.
class Reader {
 public:
  Reader(const uint8_t* text, uint8_t length) : text_(text), length_(length) {}

  uint32_t number(unsigned digits) {
    uint32_t value = 0;
    for (; digits != 0; --digits) {
      const uint8_t next = position_ < length_ ? digit(text_[position_]) : no_digit;
      good_ = good_ && next != no_digit;
      value = value << 4 | (next & 15U);
      ++position_;
    }
    return value;
  }

  bool good() const { return good_; }
  unsigned left() const { return length_ - position_; }

 private:
  const uint8_t* text_;
  unsigned length_;
  unsigned position_ = 0;
  bool good_ = true;
};

constexpr unsigned time_stamp = 4;  // digits

// Decodes the digits after the letter. Returns false if they do not form a frame.
bool decode(Reader& line, bool extended, bool remote, CO_IF_FRM& frame) {
  const uint32_t identifier = line.number(extended ? 8 : 3);
  const uint32_t length = line.number(1);
  if (identifier > (extended ? CO_IF_FRM_ID : 0x7FFU) || length > sizeof frame.Data) {
    return false;
  }
  frame = {};
  frame.Identifier = identifier | (extended ? CO_IF_FRM_EXT : 0U) | (remote ? CO_IF_FRM_RTR : 0U);
  frame.DLC = static_cast<uint8_t>(length);
  for (uint32_t n = 0; n < length && !remote; ++n) {
    frame.Data[n] = static_cast<uint8_t>(line.number(2));
  }
  if (line.good() && line.left() == time_stamp) {
    line.number(time_stamp);
  }
  return line.good() && line.left() == 0;
}

void receive_frame(CO_SLCAN& can, bool extended, bool remote) {
  CO_IF_FRM frame;
  Reader line(can.Line + 1, static_cast<uint8_t>(can.LineLen - 1));
  if (!decode(line, extended, remote, frame)) {
    count(can.Malformed);
  } else if (load(can.Open) != 0) {
    CORingPut(&can.Frames, &frame);
  }
}

// Returns true for an answer of the adapter (it has accepted a frame) and for a command of a peer; both are ignored.
bool is_ignored(const CO_SLCAN& can) {
  switch (can.Line[0]) {
    case 'z':
    case 'Z':
    case 'C':
    case 'O': return can.LineLen == 1;
    case 'S': return can.LineLen == 2;
    default: return false;
  }
}

void process_line(CO_SLCAN& can) {
  if (can.LineLen == 0) {
    return;  // empty line: the adapter's positive answer
  }
  if (can.LineLen > CO_SLCAN_LINE) {
    count(can.Malformed);
    return;
  }
  switch (can.Line[0]) {
    case 't': return receive_frame(can, false, false);
    case 'T': return receive_frame(can, true, false);
    case 'r': return receive_frame(can, false, true);
    case 'R': return receive_frame(can, true, true);
    default:
      if (!is_ignored(can)) {
        count(can.Malformed);
      }
  }
}

void receive(CO_SLCAN& can, uint8_t byte) {
  if (byte == end_of_line) {
    process_line(can);
    can.LineLen = 0;
  } else if (byte == bell) {
    count(can.Refused);
    can.LineLen = 0;
  } else if (byte == '\n' && can.LineLen == 0) {
    // Some adapters end their lines with CR and LF.
  } else if (can.LineLen < CO_SLCAN_LINE) {
    can.Line[can.LineLen++] = byte;
  } else {
    can.LineLen = broken;
  }
}

// --- Text to be sent

constexpr uint8_t mask = CO_SLCAN_TX_BYTES - 1;

uint8_t bytes_to_send(const CO_SLCAN& can) { return static_cast<uint8_t>(load(can.TxHead) - load(can.TxTail)); }

// Appends a line to the transmit buffer and publishes it when it is complete. The caller has checked the free space.
class Writer {
 public:
  explicit Writer(CO_SLCAN& can) : can_(can), head_(can.TxHead) {}

  void character(uint8_t character) { can_.Tx[head_++ & mask] = character; }
  void number(uint32_t value, unsigned digits) {
    while (digits != 0) {
      --digits;
      character(static_cast<uint8_t>("0123456789ABCDEF"[value >> 4 * digits & 15U]));
    }
  }
  void end() {
    character(end_of_line);
    store(can_.TxHead, head_);
  }

 private:
  CO_SLCAN& can_;
  uint8_t head_;
};

struct FrameForm {
  bool extended;
  bool remote;
  uint8_t length;
};

// An identifier above 7FFh is sent with 29 bits: truncated to 11 bits it would be another message.
FrameForm form_of(const CO_IF_FRM& frame) {
  const bool extended = (frame.Identifier & CO_IF_FRM_EXT) != 0 || (frame.Identifier & CO_IF_FRM_ID) > 0x7FF;
  const bool remote = (frame.Identifier & CO_IF_FRM_RTR) != 0;
  return {extended, remote, frame.DLC < sizeof frame.Data ? frame.DLC : static_cast<uint8_t>(sizeof frame.Data)};
}

uint32_t characters(const FrameForm& form) {
  return (form.extended ? 11U : 6U) + (form.remote ? 0U : 2U * form.length);
}

void write_frame(CO_SLCAN& can, const CO_IF_FRM& frame, const FrameForm& form) {
  const char letter = form.remote ? 'r' : 't';
  Writer line(can);
  line.character(static_cast<uint8_t>(form.extended ? letter - 'a' + 'A' : letter));
  line.number(frame.Identifier & CO_IF_FRM_ID, form.extended ? 8 : 3);
  line.number(form.length, 1);
  for (uint8_t n = 0; n < form.length && !form.remote; ++n) {
    line.number(frame.Data[n], 2);
  }
  line.end();
}

void write_command(CO_SLCAN& can, uint8_t letter) {
  Writer line(can);
  line.character(letter);
  line.end();
}

void write_bit_rate(CO_SLCAN& can, uint32_t baud) {
  uint8_t code = '0';
  for (const uint32_t rate : bit_rates) {
    if (rate == baud) {
      Writer line(can);
      line.character('S');
      line.character(code);
      line.end();
      return;
    }
    ++code;
  }
}

void start_transmission(const CO_SLCAN& can) {
  if (can.Start != nullptr) {
    can.Start(can.Ctx);
  }
}

// --- The driver

CO_SLCAN& slcan(void* ctx) { return *static_cast<CO_SLCAN*>(ctx); }

void reset(void* ctx) { CORingClear(&slcan(ctx).Frames); }

void close(void* ctx) {
  CO_SLCAN& can = slcan(ctx);
  store(can.Open, static_cast<uint8_t>(0));
  if (CO_SLCAN_TX_BYTES - bytes_to_send(can) >= 2) {
    write_command(can, 'C');
    start_transmission(can);
  }
}

void init(void* ctx) {
  store(slcan(ctx).Open, static_cast<uint8_t>(0));
  CORingClear(&slcan(ctx).Frames);
}

void enable(void* ctx, uint32_t baud) {
  CO_SLCAN& can = slcan(ctx);
  CORingClear(&can.Frames);
  store(can.Open, static_cast<uint8_t>(1));
  if (CO_SLCAN_TX_BYTES - bytes_to_send(can) < 7) {
    return;  // no free space: the UART does not transmit
  }
  write_command(can, 'C');
  write_bit_rate(can, baud != 0 ? baud : can.Baud);
  write_command(can, 'O');
  start_transmission(can);
}

int16_t read(void* ctx, CO_IF_FRM* frm) {
  CO_SLCAN& can = slcan(ctx);
  const uint16_t lost = CORingLost(&can.Frames);
  if (lost != can.ReportedLost) {
    can.ReportedLost = lost;
    *frm = overflow;
    return one_frame;
  }
  return CORingGet(&can.Frames, frm) ? one_frame : static_cast<int16_t>(0);
}

int16_t send(void* ctx, const CO_IF_FRM* frm) {
  CO_SLCAN& can = slcan(ctx);
  if (load(can.Open) == 0) {
    return -1;
  }
  const FrameForm form = form_of(*frm);
  const bool room = bytes_to_send(can) + characters(form) + room_for_commands <= CO_SLCAN_TX_BYTES;
  can.Busy = room ? 0 : 1;
  if (!room) {
    return 0;
  }
  write_frame(can, *frm, form);
  start_transmission(can);
  return one_frame;
}

}  // namespace

extern "C" {

bool COSlcanInit(CO_SLCAN* can, CO_IF_FRM* mem, uint16_t num, void (*start_transmission)(void* ctx), void* ctx) {
  if (can == nullptr) {
    return false;
  }
  *can = {};
  can->Start = start_transmission;
  can->Ctx = ctx;
  return CORingInit(&can->Frames, mem, num) && start_transmission != nullptr;
}

void COSlcanReceive(CO_SLCAN* can, uint8_t byte) { receive(*can, byte); }

void COSlcanBroken(CO_SLCAN* can) { can->LineLen = broken; }

uint32_t COSlcanPending(const CO_SLCAN* can, const uint8_t** bytes) {
  const uint32_t first = can->TxTail & mask;
  const uint32_t num = bytes_to_send(*can);
  *bytes = can->Tx + first;
  return num < CO_SLCAN_TX_BYTES - first ? num : CO_SLCAN_TX_BYTES - first;
}

void COSlcanSent(CO_SLCAN* can, uint32_t num) { store(can->TxTail, static_cast<uint8_t>(can->TxTail + num)); }

bool COSlcanIsDue(const CO_SLCAN* can) {
  const bool has_room = bytes_to_send(*can) + CO_SLCAN_LINE + 1 + room_for_commands <= CO_SLCAN_TX_BYTES;
  return CORingCount(&can->Frames) != 0 || CORingLost(&can->Frames) != can->ReportedLost ||
         (can->Busy != 0 && has_room);
}

uint16_t COSlcanMalformed(const CO_SLCAN* can) { return load(can->Malformed); }

uint16_t COSlcanRefused(const CO_SLCAN* can) { return load(can->Refused); }

}  // extern "C"

const CO_IF_CAN_DRV_EX SlcanDriver = {init, enable, read, send, reset, close, nullptr, CONodeCanReport};
