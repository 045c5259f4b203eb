// SPDX-License-Identifier: Apache-2.0
// State and helper functions of a client transfer, shared by the handlers of the state machine.
#pragma once

#include "co_csdo.h"
#include "dictionary/abort_code.hpp"
#include "service/sdo/flow.hpp"
#include "service/sdo/sdo_client.hpp"

namespace co::sdo::client {

// State of the protocol: the response that the client awaits.
enum class State : uint8_t {
  idle,
  own,            // access to the own dictionary is queued
  own_running,    // type functions of that access may be running
  own_cancelled,  // one of them has cancelled the transfer
  download_initiated,
  download,
  upload_initiated,
  upload,
  block_download_initiated,
  block_download,  // segments are being sent, or await their acknowledge
  block_download_end,
  block_upload_initiated,
  block_upload,      // within a block
  block_upload_end,  // all segments have arrived
  count
};

inline constexpr bool has_block = CO_CSDO_BLOCK != 0;
inline constexpr bool has_own = USE_CSDO_OWN != 0;

// Context of a handler of the state machine: the client, the response, and the next request, which it may silence().
struct Step {
  CO_CSDO& client;
  const CO_IF_FRM& response;
  CO_IF_FRM& request;
  bool done;  // the transfer ends; the request, if any, is the last one
};

inline State state_of(const CO_CSDO& client) { return static_cast<State>(client.Flow.State); }
inline void set_state(CO_CSDO& client, State state) { client.Flow.State = static_cast<uint8_t>(state); }

// Returns whether a download fits into the first request. One without data does not: it needs a segment.
[[nodiscard]] inline bool is_expedited(const CO_CSDO& client) { return client.Flow.Size - 1 < wire::expedited_bytes; }

// Handlers of the state machine. They return the abort code with which the client ends the transfer; it is sent to the
// server unless the transfer is done.
// [301:7.2.4.3]
[[nodiscard]] Abort download_accepted(Step& step);
[[nodiscard]] Abort segment_downloaded(Step& step);
[[nodiscard]] Abort upload_accepted(Step& step);
[[nodiscard]] Abort segment_uploaded(Step& step);
[[nodiscard]] Abort block_download_accepted(Step& step);
[[nodiscard]] Abort block_acknowledged(Step& step);
Abort complete(Step& step);  // ends the transfer: nothing remains to be sent
[[nodiscard]] Abort block_upload_accepted(Step& step);
[[nodiscard]] Abort block_segment_uploaded(Step& step);
[[nodiscard]] Abort block_upload_ended(Step& step);

// Reads the configuration again, unless a transfer is in progress.
void refresh(CO_CSDO& client);

// Starts the time-out for the next response. Time-out 0: the client waits without limit.
void start_timeout(CO_CSDO& client);

// Ends the transfer and calls its callback. Must be the last action of its caller: the callback may start the next
// transfer. An access to the own dictionary whose type functions may be running is cancelled by
// cancel_running_own_access() instead.
void finish(CO_CSDO& client, Abort code);

// Ends the transfer, and sends an abort to the server if SDO is allowed. Must be the last action: the callback may
// start the next transfer.
void abort_transfer(CO_CSDO& client, Abort code);

// Fills the first request of a transfer. by_block: requests a block transfer if the data are long enough.
void put_initiate(CO_CSDO& client, bool by_block, CO_IF_FRM& request);

// Block transfer (CO_CSDO_BLOCK not 0) --------------------------------------------------------------------------

// In a block upload the timer runs for a quarter of the time-out at a time.
inline constexpr uint32_t quarters = 4;

// Returns whether the client receives the segments of a block upload.
[[nodiscard]] inline bool receives_block(const CO_CSDO& client) {
  return has_block && (state_of(client) == State::block_upload || state_of(client) == State::block_upload_end);
}

// Block download: sends segments as long as there are any and the controller accepts them. Returns whether any segment
// was sent.
bool send_segments(CO_CSDO& client);

// Block upload: returns whether the frame repeats the last segment of the transfer.
[[nodiscard]] bool is_last_segment_again(const CO_CSDO& client, const CO_IF_FRM& frame);

// Block upload: handles a quarter of the time-out.
void handle_quarter(CO_CSDO& client);

// Own dictionary (USE_CSDO_OWN) -----------------------------------------------------------------------------------

// Starts the access by a timer, so that the callback never runs before the request function has returned.
void queue_own_access(CO_CSDO& client);

// Cancels the access to the own dictionary if it is running: its callback is called after it. Returns whether it is.
[[nodiscard]] bool cancel_running_own_access(CO_CSDO& client);

}  // namespace co::sdo::client
