// SPDX-License-Identifier: Apache-2.0
// A transfer of one client: what the services of the machine share.
#pragma once

#include "co_csdo.h"
#include "core/abort_code.hpp"
#include "service/sdo_client/sdo_client.hpp"
#include "wire/sdo.hpp"

namespace co::sdo_client {

// What the client waits for.
enum class State : uint8_t {
  idle,
  own,         // its turn: the object is one of the own dictionary
  own_served,  // a type function may be running: the callback comes afterwards
  own_ended,   // the same, and the access is over: Ticks holds the code
  download_initiated,
  download,
  upload_initiated,
  upload,
  block_download_initiated,
  block_download,  // segments are sent, or all of a block are
  block_download_end,
  block_upload_initiated,
  block_upload,      // within a block
  block_upload_end,  // all segments are there
  count
};

// CO_CSDO.Flags
enum Flag : uint8_t {
  is_upload = 0x01,
  sized = 0x02,      // the server has told the size of an upload
  crc = 0x04,        // both sides support the CRC
  heard = 0x08,      // block upload: a segment of the block has arrived
  active = 0x10,     // block upload: a segment has arrived since the timer was started
  last_sent = 0x20,  // block download: the last segment of all was sent
};

// What a service of the machine works on: the client, the response and the next request in the making.
struct Step {
  CO_CSDO& client;
  const CO_IF_FRM& response;
  CO_IF_FRM& request;
  bool silent;      // no request now
  bool done;        // the request, if any, is the last
  uint32_t result;  // when done
};

inline State state_of(const CO_CSDO& client) { return static_cast<State>(client.Step); }
inline void set_state(CO_CSDO& client, State state) { client.Step = static_cast<uint8_t>(state); }
inline bool has(const CO_CSDO& client, Flag flag) { return (client.Flags & flag) != 0; }
inline void set(CO_CSDO& client, Flag flag) { client.Flags = static_cast<uint8_t>(client.Flags | flag); }
inline void clear(CO_CSDO& client, Flag flag) { client.Flags = static_cast<uint8_t>(client.Flags & ~flag); }

// The services of the machine. They return the abort code with which the client ends the transfer. [301:7.2.4.3]
[[nodiscard]] uint32_t download_accepted(Step& step);
[[nodiscard]] uint32_t segment_downloaded(Step& step);
[[nodiscard]] uint32_t upload_accepted(Step& step);
[[nodiscard]] uint32_t segment_uploaded(Step& step);
[[nodiscard]] uint32_t block_download_accepted(Step& step);
[[nodiscard]] uint32_t block_acknowledged(Step& step);
[[nodiscard]] uint32_t block_download_confirmed(Step& step);
[[nodiscard]] uint32_t block_upload_accepted(Step& step);
[[nodiscard]] uint32_t block_segment_uploaded(Step& step);
[[nodiscard]] uint32_t block_upload_ended(Step& step);

// Takes the configuration anew, unless a transfer is going on.
void refresh(CO_CSDO& client);

// Ends the transfer, and tells the server where it may. Must be last: the callback may start the next transfer.
void abort_transfer(CO_CSDO& client, uint32_t code);

// The first request of a transfer. by_block: if it is long enough.
void put_initiate(CO_CSDO& client, bool by_block, CO_IF_FRM& request);

// The size that the server tells. Returns an abort code.
[[nodiscard]] uint32_t take_size(Step& step);
// Are these all bytes that the server has told of? Returns an abort code.
[[nodiscard]] uint32_t check_total(const CO_CSDO& client, uint32_t total);

// Sends the next segment of a block download. False: there is none, or the controller does not take it.
[[nodiscard]] bool send_segment(CO_CSDO& client);

// Block upload: is this the last segment of all once more?
[[nodiscard]] bool is_last_segment_again(const CO_CSDO& client, const CO_IF_FRM& frame);

// Block upload: tells a server that has fallen silent what has arrived. False: nothing is to be told.
[[nodiscard]] bool put_reminder(CO_CSDO& client, CO_IF_FRM& request);

// Reads or writes the own dictionary. Returns an abort code.
[[nodiscard]] uint32_t access_own(CO_CSDO& client);

}  // namespace co::sdo_client
