// SPDX-License-Identifier: Apache-2.0
// State and helper functions of a server transfer, shared by the handlers of the state machine.
#pragma once

#include "co_assert.h"
#include "dictionary/dict.hpp"
#include "dictionary/types/stream.hpp"
#include "service/sdo/flow.hpp"
#include "service/sdo/sdo_server.hpp"

namespace co::sdo::server {

enum class State : uint8_t {
  idle,
  download,
  upload,
  block_download,      // within a block
  block_download_end,  // all segments have arrived
  block_upload_ready,  // initiated
  block_upload,        // segments are being sent, or await their acknowledge
  block_upload_end,    // the end message was sent, its response is awaited
  count
};

inline constexpr bool has_block = USE_SDO_BLOCK != 0;

// Expedited data are stored in Value as a word.
static_assert(offsetof(CO_SDO, Value) % sizeof(uint32_t) == 0);

inline State state_of(const CO_SDO& channel) { return static_cast<State>(channel.Flow.State); }
inline void set_state(CO_SDO& channel, State state) { channel.Flow.State = static_cast<uint8_t>(state); }

// Handlers of the state machine. They process a request, fill the response, and return an abort code.
// [301:7.2.4.3] found: object of the request, if it was found before, otherwise null
using Handler = Abort (*)(CO_SDO& channel, const CO_IF_FRM& request, CO_IF_FRM& answer, CO_OBJ* found);
[[nodiscard]] Abort initiate(CO_SDO& channel, const CO_IF_FRM& request, CO_IF_FRM& answer, CO_OBJ* obj);
[[nodiscard]] Abort download_segment(CO_SDO& channel, const CO_IF_FRM& request, CO_IF_FRM& answer, CO_OBJ*);
[[nodiscard]] Abort upload_segment(CO_SDO& channel, const CO_IF_FRM& request, CO_IF_FRM& answer, CO_OBJ*);
[[nodiscard]] Abort end_block(CO_SDO& channel, const CO_IF_FRM& request, CO_IF_FRM& answer, CO_OBJ*);
[[nodiscard]] Abort end_block_download(CO_SDO& channel, const CO_IF_FRM& request, CO_IF_FRM& answer, CO_OBJ*);
[[nodiscard]] Abort start_block_upload(CO_SDO& channel, const CO_IF_FRM& request, CO_IF_FRM& answer, CO_OBJ*);
[[nodiscard]] Abort acknowledge_block(CO_SDO& channel, const CO_IF_FRM& request, CO_IF_FRM& answer, CO_OBJ*);
[[nodiscard]] Abort end_block_upload(CO_SDO& channel, const CO_IF_FRM& request, CO_IF_FRM& answer, CO_OBJ*);

// Ends the transfer with an abort code, or Abort::none if it is complete. Calls the type's End function; its error for
// a complete download is returned as abort code.
Abort close(CO_SDO& channel, Abort code);

// Starts a new transfer of the object in the request; a previous transfer of the client is closed.
void restart(CO_SDO& channel, const CO_IF_FRM& request);

// Calls the access hook: whether the client may begin this transfer of an object that exists and has the access right.
// Returns an abort code.
[[nodiscard]] Abort ask_application(CO_SDO& channel, const CO_IF_FRM& request);

// Continues the transfer beyond this frame, supervised by the time-out.
void continue_transfer(CO_SDO& channel, CO_OBJ& obj, State state);

// Stops the time-out timer if no transfer is open.
void stop_idle_timer(CO_NODE& node);

// Performs the checks at the begin of every segment. channel.Obj is null if the entry was moved.
[[nodiscard]] inline Abort check_segment(const CO_SDO& channel, const CO_IF_FRM& request) {
  if (channel.Obj == nullptr) {
    return Abort::device_state;
  }
  return wire::toggle(request) != (channel.Flow.Flags & toggled) ? Abort::toggle_bit : Abort::none;
}

// Sends an abort to the client and closes the transfer.
void abort_transfer(CO_SDO& channel, Abort code);

// Reserves a stream for this channel (one channel at a time), and calls the type's Begin function.
[[nodiscard]] Abort begin_stream(CO_SDO& channel, CO_OBJ& obj, uint32_t size);

// Returns whether the object is transferred as a value, as a whole. Other objects are transferred in the pieces that
// arrive.
[[nodiscard]] inline bool is_value(const CO_SDO& channel, const CO_OBJ& obj) {
  return !obj::is_stream(obj) && channel.Flow.Size <= sizeof channel.Value;
}

// Returns an abort code if the download cannot have this total length.
[[nodiscard]] Abort check_total(CO_SDO& channel, uint32_t total);
// Completes a download: writes a value and closes the transfer.
[[nodiscard]] Abort finish_download(CO_SDO& channel);

// Sets Size to the total length before the last piece of n bytes is written, for extensions that need it (co_od.h). An
// announced size is not changed; it is compared afterwards.
inline void set_total([[maybe_unused]] CO_SDO& channel, [[maybe_unused]] uint32_t n) {
  if (USE_OD != 0 && !has(channel.Flow, sized)) {
    channel.Flow.Size = channel.Flow.Num + n;
  }
}

// Read or write in the direction of the transfer, and return an abort code. begin_data: the first bytes, or none to
// open a stream. transfer_piece: a piece, up to position Read; it may be less than n bytes at the end of an object of
// unknown size. In a block upload transfer_piece sets the flag behind while the type has not reached the position.
[[nodiscard]] Abort begin_data(CO_SDO& channel, CO_OBJ& obj, uint8_t* data, uint32_t n);
[[nodiscard]] Abort transfer_piece(CO_SDO& channel, uint32_t position, uint8_t* data, uint32_t n);

// Block transfer --------------------------------------------------------------------------------------------------

// Returns whether there is a buffer, which block transfers require.
[[nodiscard]] inline bool has_buffer(const CO_SDO& channel) { return channel.Node->SdoBuf != nullptr; }

[[nodiscard]] inline uint8_t* buffer_of(const CO_SDO& channel) {
  constexpr size_t size = size_t{CO_SDO_BUF_SEG} * wire::segment_bytes;
  const CO_NODE& node = *channel.Node;
  return CO_SSDO_N == 1 ? node.SdoBuf : node.SdoBuf + size * static_cast<size_t>(&channel - node.Sdo);
}

// Checks whether the object can be uploaded by block transfer. Returns an abort code.
[[nodiscard]] Abort check_block_upload(const CO_SDO& channel, const CO_OBJ& obj, const CO_IF_FRM& request);
// Returns whether the size is above the client's protocol switch threshold.
[[nodiscard]] inline bool is_worth_block(uint32_t size, const CO_IF_FRM& request) {
  const uint8_t switch_threshold = request.Data[5];
  return switch_threshold == 0 || size > switch_threshold;
}
// Sends segments of a block upload while there are any and transmit::offer() accepts them. Returns an abort code.
[[nodiscard]] Abort send_segments(CO_SDO& channel);

// Stores a segment of a block download. Returns true if it ends the block: end_block() then responds.
[[nodiscard]] bool store_in_block(CO_SDO& channel, const CO_IF_FRM& segment);

// Block download: repeats the acknowledge to a client that no longer sends.
void handle_silence(CO_SDO& channel);

}  // namespace co::sdo::server
