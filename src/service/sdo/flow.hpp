// SPDX-License-Identifier: Apache-2.0
// Data of a transfer (CO_SDO_FLOW), and blocks, for SDO servers and clients.
#pragma once

#include "co_core.h"
#include "dictionary/access.hpp"
#include "wire/sdo.hpp"

namespace co::sdo {

// CO_SDO_FLOW.Flags
enum Flag : uint8_t {
  sized = 0x01,     // the size of the transfer was announced
  whole = 0x02,     // server: a value: collected in Value, read or written in one piece
  too_long = 0x04,  // block received: more data than the receiver can hold
  behind = 0x04,    // block sent by a server: the type needs another call to reach the position
  download = access::download,
  toggled = 0x10,  // segments: toggle bit expected next, as in the frame
  crc = 0x20,      // both sides support the CRC
  begun = access::begun,
  last_sent = 0x80,  // block sent: the last segment of the transfer was sent
};

static_assert(toggled == wire::toggle_bit);

inline bool has(const CO_SDO_FLOW& flow, Flag flag) { return (flow.Flags & flag) != 0; }
inline void set(CO_SDO_FLOW& flow, Flag flag) { flow.Flags = static_cast<uint8_t>(flow.Flags | flag); }
inline void clear(CO_SDO_FLOW& flow, Flag flag) { flow.Flags = static_cast<uint8_t>(flow.Flags & ~flag); }

// Suppresses the next frame of a server or a client. Setting the DLC again enables it.
inline void silence(CO_IF_FRM& frame) { frame.DLC = 0; }

// Blocks (USE_SDO_BLOCK, CO_CSDO_BLOCK) -------------------------------------------------------------------------------

// Starts the first block of a transfer. initiate: frame of the other side, with the bit of its support of the CRC
void begin_blocks(CO_SDO_FLOW& flow, const CO_IF_FRM& initiate, uint8_t blksize);

#if USE_SDO_BLOCK
// Returns the number of bytes of data in the buffer. end: the end message, which contains the number of unused bytes
[[nodiscard]] inline uint32_t last_bytes(const CO_SDO_FLOW& flow, const CO_IF_FRM& end) {
  return flow.Fill - wire::unused_in_block(end.Data[0]);
}
#endif

// Blocks sent ---------------------------------------------------------------------------------------------------------

// Processes the acknowledge of a block: Num is the position behind the segments that have arrived. If all have
// (last_sent is set), the end message is due, otherwise the next block has begun. Returns an abort code.
[[nodiscard]] Abort acknowledge_sent(CO_SDO_FLOW& flow, const CO_IF_FRM& frame);
// Fills the end message. Crc is that of all bytes.
void put_end(CO_SDO_FLOW& flow, CO_IF_FRM& frame);

// Blocks received -----------------------------------------------------------------------------------------------------
// buffer: address of the byte Num. It has Fill bytes whose CRC is not known, and room for a block, or up to Size.

enum class Arrival : uint8_t {
  within,  // the block continues: nothing to send
  end,     // end of a block, to be acknowledged
  last,    // end of the last block, to be acknowledged
};

// Stores a segment, and restarts the time-out if the segment belongs to the transfer. Data that exceed Size are not
// stored (flag too_long).
[[nodiscard]] Arrival receive_segment(CO_SDO_FLOW& flow, uint8_t* buffer, const CO_IF_FRM& segment);

// Fills the acknowledge of the segments received in sequence, behind which the sender continues with a new block.
void acknowledge(CO_SDO_FLOW& flow, uint8_t blksize, CO_IF_FRM& frame);
// Fills the acknowledge for a sender that no longer sends: a new one, or the last one again. Returns false if nothing
// was received yet.
[[nodiscard]] bool repeat_acknowledge(CO_SDO_FLOW& flow, uint8_t blksize, CO_IF_FRM& frame);

// Adds the bytes of the buffer to the CRC.
void add_to_crc(CO_SDO_FLOW& flow, const uint8_t* buffer);

// After the last segment: returns whether the frame repeats it.
[[nodiscard]] bool is_last_segment_again(const CO_SDO_FLOW& flow, const uint8_t* buffer, const CO_IF_FRM& frame);

// Returns whether the CRC in an end message is right.
[[nodiscard]] bool is_crc_right(const CO_SDO_FLOW& flow, const uint8_t* buffer, const CO_IF_FRM& end);

}  // namespace co::sdo
