// SPDX-License-Identifier: Apache-2.0
// A transfer of one channel: what the services of the machine share.
#pragma once

#include "core/access.hpp"
#include "service/sdo_server/sdo_server.hpp"
#include "wire/sdo.hpp"

namespace co::sdo_server {

enum class State : uint8_t {
  idle,
  download,
  upload,
  block_download,      // within a block
  block_download_end,  // all segments are there
  block_upload_ready,  // initiated
  block_upload,        // segments are sent, or all of a block are
  block_upload_end,    // the last message of the server is sent
  count
};

// CO_SDO.Flags
enum Flag : uint8_t {
  sized = 0x01,      // the size of a download was announced
  whole = 0x02,      // a value: collected in Value, read or written in one piece
  busy = 0x04,       // a type function may be running: the transfer is closed afterwards only
  download = 0x08,   // direction
  begun = 0x10,      // the type was told of the begin and wants to know the end
  crc = 0x20,        // both sides support the CRC
  heard = 0x40,      // block download: a segment of the block has arrived
  last_sent = 0x80,  // block upload: the last segment of all was sent
  too_long = 0x80    // block download: more data than the object can have
};

// What a service of the machine works on: the channel, the request and the answer in the making.
struct Step {
  CO_NODE& node;
  CO_SDO& channel;
  const CO_IF_FRM& request;
  CO_IF_FRM& answer;
  bool silent;  // no answer at all
};

inline State state_of(const CO_SDO& channel) { return static_cast<State>(channel.State); }
inline void set_state(CO_SDO& channel, State state) { channel.State = static_cast<uint8_t>(state); }
inline bool has(const CO_SDO& channel, Flag flag) { return (channel.Flags & flag) != 0; }
inline void set(CO_SDO& channel, Flag flag) { channel.Flags = static_cast<uint8_t>(channel.Flags | flag); }
inline void clear(CO_SDO& channel, Flag flag) { channel.Flags = static_cast<uint8_t>(channel.Flags & ~flag); }

// The services of the machine. They return an abort code. [301:7.2.4.3]
[[nodiscard]] uint32_t initiate_download(Step& step);
[[nodiscard]] uint32_t download_segment(Step& step);
[[nodiscard]] uint32_t initiate_upload(Step& step);
[[nodiscard]] uint32_t upload_segment(Step& step);
[[nodiscard]] uint32_t initiate_block_download(Step& step);
[[nodiscard]] uint32_t download_block_segment(Step& step);
[[nodiscard]] uint32_t end_block_download(Step& step);
[[nodiscard]] uint32_t initiate_block_upload(Step& step);
[[nodiscard]] uint32_t start_block_upload(Step& step);
[[nodiscard]] uint32_t acknowledge_block(Step& step);
[[nodiscard]] uint32_t end_block_upload(Step& step);

// The checks that every transfer begins with: the object and its access right.
[[nodiscard]] uint32_t open(Step& step, CO_OBJ_TRANSFER transfer);

// Lets the time-out watch the open transfers.
void watch(CO_NODE& node);

// Has the entry left the table since the transfer began?
[[nodiscard]] bool is_gone(const CO_SDO& channel);

// The checks that every segment begins with.
[[nodiscard]] uint32_t check_segment(const Step& step);

// Ends the transfer with an abort code, or no_abort: it is complete. The type is told; what it then answers to a
// complete download is the result.
uint32_t close(CO_SDO& channel, uint32_t code);

void send_abort(CO_SDO& channel, uint32_t key, uint32_t code);

// Decides how the bytes pass and tells the type. A value of up to 8 bytes and whatever fits into one frame passes in
// one piece, anything else in the pieces that arrive; a stream belongs to one channel at a time.
[[nodiscard]] uint32_t begin_upload(Step& step, bool fits_one_frame);
[[nodiscard]] uint32_t begin_download(Step& step, uint32_t size, bool fits_one_frame);
// Before the first piece of what is not written as a whole.
[[nodiscard]] uint32_t start_writing(CO_SDO& channel);

// Takes the size that the client announces, or the most that the object can have, and begins.
[[nodiscard]] uint32_t open_download(Step& step, bool announced);
// Can these be all bytes of the download?
[[nodiscard]] uint32_t check_total(Step& step, uint32_t total);
// All bytes are there: hands over a value, and closes.
[[nodiscard]] uint32_t finish_download(Step& step);

// Opens the object and takes its size, CO_OBJ_SIZE_UNKNOWN included.
[[nodiscard]] uint32_t open_upload(Step& step);
// Answers an upload in one frame, or opens it for segments.
[[nodiscard]] uint32_t ordinary_upload(Step& step);
// The answer that tells the size.
void answer_size(const CO_SDO& channel, uint8_t command, CO_IF_FRM& answer);

// The data in pieces; both return an abort code. put: at position Num, which goes on. get: n becomes smaller where the
// end of an object of unknown size is found.
[[nodiscard]] uint32_t put(CO_SDO& channel, uint8_t* from, uint32_t n);
[[nodiscard]] uint32_t get(CO_SDO& channel, uint32_t position, uint8_t* to, uint32_t& n);

// The object as a whole through its type; values in the byte order of the bus.
[[nodiscard]] CO_ERR read_whole(CO_SDO& channel, uint32_t n);
[[nodiscard]] CO_ERR write_whole(CO_SDO& channel, uint32_t n);

// Block transfer --------------------------------------------------------------------------------------------------

[[nodiscard]] inline uint8_t* buffer_of(const CO_SDO& channel) {
  const CO_NODE& node = *channel.Node;
  constexpr size_t size = size_t{CO_SDO_BUF_SEG} * wire::segment_bytes;
  return node.SdoBuf == nullptr ? nullptr : node.SdoBuf + size * static_cast<size_t>(&channel - node.Sdo);
}

// Sends the next segment of a block upload. False: there is none, the controller does not take it, or abort is set.
[[nodiscard]] bool send_segment(CO_SDO& channel, uint32_t& abort);

// Block download: is this the last segment of all once more?
[[nodiscard]] bool is_last_segment_again(const CO_SDO& channel, const CO_IF_FRM& frame);

// Block download: tells a client that has fallen silent what has arrived. False: that was an abort.
[[nodiscard]] bool remind(CO_SDO& channel);

}  // namespace co::sdo_server
