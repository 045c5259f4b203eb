// SPDX-License-Identifier: Apache-2.0
// A transfer of one channel: what the services of the machine share.
#pragma once

#include "core/obj.hpp"
#include "service/sdo_server/sdo_server.hpp"
#include "wire/sdo.hpp"

namespace co::sdo_server {

enum class State : uint8_t { idle, download, upload, count };

// CO_SDO.Flags
enum Flag : uint8_t {
  sized = 0x01,  // the client has announced the size
  whole = 0x02,  // a value: collected in Value, read or written in one piece
  busy = 0x04,   // a type function may be running: the transfer is closed afterwards only
};

// What a service returns unless it is an abort code.
inline constexpr uint32_t no_abort = 0;

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

// The services of the machine. [301:7.2.4.3]
[[nodiscard]] uint32_t initiate_download(Step& step);
[[nodiscard]] uint32_t download_segment(Step& step);
[[nodiscard]] uint32_t initiate_upload(Step& step);
[[nodiscard]] uint32_t upload_segment(Step& step);

// The checks that every transfer begins with: the object, its access right (a flag of its key), and whether its type
// has the function for it. refused: the abort code without the right.
[[nodiscard]] uint32_t open(Step& step, uint32_t right, bool (*can)(const CO_OBJ_TYPE&), uint32_t refused);

// Lets the time-out watch the open transfers.
void watch(CO_NODE& node);

// The checks that every segment begins with.
[[nodiscard]] uint32_t check_segment(const Step& step);

void close(CO_SDO& channel);

void send_abort(CO_SDO& channel, uint32_t key, uint32_t code);

// Decides how the bytes pass: a value of up to 8 bytes and whatever fits into one frame in one piece, anything else in
// the pieces that arrive; a stream only for one channel at a time.
[[nodiscard]] uint32_t choose_access(Step& step, bool fits_one_frame);

// The object through its type; values in the byte order of the bus.
[[nodiscard]] CO_ERR read_whole(CO_SDO& channel, uint32_t n);
[[nodiscard]] CO_ERR write_whole(CO_SDO& channel, uint32_t n);
[[nodiscard]] CO_ERR begin_reading(CO_SDO& channel);
[[nodiscard]] CO_ERR begin_writing(CO_SDO& channel);
[[nodiscard]] CO_ERR read_piece(CO_SDO& channel, uint8_t* to, uint32_t n);
[[nodiscard]] CO_ERR write_piece(CO_SDO& channel, uint8_t* from, uint32_t n);

// The abort code for what a type function has returned. The others set the node's error, too.
[[nodiscard]] uint32_t abort_for(const CO_SDO& channel, CO_ERR err);
[[nodiscard]] uint32_t read_failed(const CO_SDO& channel, CO_ERR err);
[[nodiscard]] uint32_t write_failed(const CO_SDO& channel, CO_ERR err);

}  // namespace co::sdo_server
