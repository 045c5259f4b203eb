// SPDX-License-Identifier: Apache-2.0
// A transfer of one channel: what the services of the machine share.
#pragma once

#include "core/access.hpp"
#include "object/stream.hpp"
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
  too_long = 0x04,   // block download: more data than the object can have
  download = 0x08,   // direction
  toggled = 0x10,    // segmented transfer: toggle bit that is expected next, in place
  crc = 0x20,        // both sides support the CRC
  begun = 0x40,      // see is_told()
  last_sent = 0x80,  // block upload: the last segment of all was sent
};

inline constexpr bool has_block = USE_SDO_BLOCK != 0;

// CO_SDO.Idle while a type function of the transfer may be running: it is closed afterwards only.
inline constexpr uint8_t busy = 0xFF;

inline State state_of(const CO_SDO& channel) { return static_cast<State>(channel.State); }
inline void set_state(CO_SDO& channel, State state) { channel.State = static_cast<uint8_t>(state); }
inline bool has(const CO_SDO& channel, Flag flag) { return (channel.Flags & flag) != 0; }
inline void set(CO_SDO& channel, Flag flag) { channel.Flags = static_cast<uint8_t>(channel.Flags | flag); }
inline void clear(CO_SDO& channel, Flag flag) { channel.Flags = static_cast<uint8_t>(channel.Flags & ~flag); }

static_assert(toggled == wire::toggle_bit);

// Was the type told of the begin, and does it want to know the end?
inline bool is_told(const CO_SDO& channel) { return USE_OBJ_EX != 0 && has(channel, begun); }

// No answer at all, unless it gets its length again.
inline void silence(CO_IF_FRM& answer) { answer.DLC = 0; }

// The services of the machine: a request, and the answer in the making. They return an abort code. [301:7.2.4.3]
using Service = uint32_t (*)(CO_SDO& channel, const CO_IF_FRM& request, CO_IF_FRM& answer);
[[nodiscard]] uint32_t initiate_download(CO_SDO& channel, const CO_IF_FRM& request, CO_IF_FRM& answer);
[[nodiscard]] uint32_t download_segment(CO_SDO& channel, const CO_IF_FRM& request, CO_IF_FRM& answer);
[[nodiscard]] uint32_t initiate_upload(CO_SDO& channel, const CO_IF_FRM& request, CO_IF_FRM& answer);
[[nodiscard]] uint32_t upload_segment(CO_SDO& channel, const CO_IF_FRM& request, CO_IF_FRM& answer);
[[nodiscard]] uint32_t initiate_block_download(CO_SDO& channel, const CO_IF_FRM& request, CO_IF_FRM& answer);
[[nodiscard]] uint32_t end_block(CO_SDO& channel, const CO_IF_FRM& request, CO_IF_FRM& answer);
[[nodiscard]] uint32_t end_block_download(CO_SDO& channel, const CO_IF_FRM& request, CO_IF_FRM& answer);
[[nodiscard]] uint32_t initiate_block_upload(CO_SDO& channel, const CO_IF_FRM& request, CO_IF_FRM& answer);
[[nodiscard]] uint32_t start_block_upload(CO_SDO& channel, const CO_IF_FRM& request, CO_IF_FRM& answer);
[[nodiscard]] uint32_t acknowledge_block(CO_SDO& channel, const CO_IF_FRM& request, CO_IF_FRM& answer);
[[nodiscard]] uint32_t end_block_upload(CO_SDO& channel, const CO_IF_FRM& request, CO_IF_FRM& answer);

// Ends the transfer with an abort code, or no_abort: it is complete. The type is told; what it then answers to a
// complete download is the result.
uint32_t close(CO_SDO& channel, uint32_t code);

// A new transfer, of the object that the request names; its client has given up the one before.
void restart(CO_SDO& channel, const CO_IF_FRM& request);

// Asks the application whether the client may begin this transfer of an object that exists and has the access right.
// Afterwards looks the object up again: the application may have changed the dictionary. Returns an abort code.
[[nodiscard]] uint32_t ask(CO_SDO& channel, const CO_IF_FRM& request);

// Calls restart() and makes the checks that every transfer begins with: object, access right, access hook. The object
// becomes node.Served. Returns an abort code.
[[nodiscard]] inline uint32_t open(CO_SDO& channel, const CO_IF_FRM& request, CO_OBJ_TRANSFER transfer) {
  restart(channel, request);
  channel.Flags = transfer == CO_OBJ_DOWNLOAD ? download : 0;
  const uint32_t abort = stream::open(*channel.Node, channel.Key, transfer);
  if constexpr (USE_ACCESS_HOOK != 0) {
    return abort == no_abort ? ask(channel, request) : abort;
  }
  return abort;
}

// The transfer of the object takes more than this frame: the time-out watches it.
void go_on(CO_SDO& channel, CO_OBJ& obj, State state);

// No time-out is needed when no transfer is open.
void rest(CO_NODE& node);

// The checks that every segment begins with. An entry that has left its place is lost.
[[nodiscard]] inline uint32_t check_segment(const CO_SDO& channel, const CO_IF_FRM& request) {
  if (channel.Obj == nullptr) {
    return CO_SDO_ERR_TOS_STATE;
  }
  return wire::toggle(request) != (channel.Flags & toggled) ? CO_SDO_ERR_TBIT : no_abort;
}

// The same, and tells the client.
void abort_transfer(CO_SDO& channel, uint32_t code);

// A stream belongs to one channel at a time, and its type may have to be told.
[[nodiscard]] uint32_t begin_stream(CO_SDO& channel, CO_OBJ& obj, uint32_t size);

// Does the object pass as a value, in one piece? Anything else passes in the pieces that arrive.
[[nodiscard]] inline bool is_value(const CO_SDO& channel, const CO_OBJ& obj) {
  return !obj::is_stream(obj) && channel.Size <= sizeof channel.Value;
}

// Can these be all bytes of the download?
[[nodiscard]] uint32_t check_total(CO_SDO& channel, uint32_t total);
// All bytes are there: hands over a value, and closes.
[[nodiscard]] uint32_t finish_download(CO_SDO& channel);

// The last piece has n bytes: for types that are told how much a download has been (co_od.h). What was announced stays,
// and is compared afterwards.
inline void tell_total([[maybe_unused]] CO_SDO& channel, [[maybe_unused]] uint32_t n) {
  if (USE_OD != 0 && !has(channel, sized)) {
    channel.Size = channel.Num + n;
  }
}

// In place of an abort code: the type needs another call to find the position.
constexpr uint32_t again = 1;

// Read or write in the direction of the transfer; both return an abort code. begin_data: the first bytes of all, or
// none, which opens a stream. pass: a piece, up to position Read, or again where it goes back: fewer than n bytes where
// the end of an object of unknown size is found.
[[nodiscard]] uint32_t begin_data(CO_SDO& channel, CO_OBJ& obj, uint8_t* data, uint32_t n);
[[nodiscard]] uint32_t pass(CO_SDO& channel, uint32_t position, uint8_t* data, uint32_t n);

// Block transfer --------------------------------------------------------------------------------------------------

// Without a buffer there are no block transfers.
[[nodiscard]] inline bool has_buffer(const CO_SDO& channel) { return channel.Node->SdoBuf != nullptr; }

[[nodiscard]] inline uint8_t* buffer_of(const CO_SDO& channel) {
  constexpr size_t size = size_t{CO_SDO_BUF_SEG} * wire::segment_bytes;
  const CO_NODE& node = *channel.Node;
  return CO_SSDO_N == 1 ? node.SdoBuf : node.SdoBuf + size * static_cast<size_t>(&channel - node.Sdo);
}

// May the object be uploaded by block? Returns an abort code.
[[nodiscard]] uint32_t check_block_upload(const CO_SDO& channel, const CO_OBJ& obj, const CO_IF_FRM& request);
// The client may name a size up to which it had rather have no block transfer.
[[nodiscard]] inline bool is_worth_block(uint32_t size, const CO_IF_FRM& request) {
  const uint8_t switch_threshold = request.Data[5];
  return switch_threshold == 0 || size > switch_threshold;
}
void begin_block_upload(CO_SDO& channel, const CO_IF_FRM& request);
void begin_block_download(CO_SDO& channel, const CO_IF_FRM& request, CO_IF_FRM& answer);

// Sends segments of a block upload, as many as there are and transmit::offer() takes. Returns an abort code.
[[nodiscard]] uint32_t send_segments(CO_SDO& channel);

// Stores a segment of a block download, and restarts the time-out if the segment belongs to the transfer. True: it ends
// the block, and end_block() answers.
[[nodiscard]] bool take_segment(CO_SDO& channel, const CO_IF_FRM& segment);

// Block download: is this the last segment of all once more?
[[nodiscard]] bool is_last_segment_again(const CO_SDO& channel, const CO_IF_FRM& frame);

// Block download: tells a client that has fallen silent what has arrived.
void remind(CO_SDO& channel);

}  // namespace co::sdo_server
