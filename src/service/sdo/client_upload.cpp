// SPDX-License-Identifier: Apache-2.0
// Uploads by a client: expedited, segments and blocks. [301:7.2.4.3.5-6, 7.2.4.3.13]
#include "base/transmit.hpp"
#include "service/sdo/client.hpp"

namespace co::sdo::client {

namespace {

Abort append(CO_CSDO& client, const uint8_t* data, uint32_t n) {
  CO_SDO_FLOW& flow = client.Flow;
  if (n > flow.Size - flow.Num) {
    return has(flow, sized) ? Abort::too_long : Abort::memory;
  }
  __builtin_memcpy(client.Buf + flow.Num, data, n);
  flow.Num += n;
  return Abort::none;
}

// Stores expedited data. If the server indicates no size, the caller's buffer determines the length, up to 4 bytes.
Abort take_expedited(Step& step) {
  CO_SDO_FLOW& flow = step.client.Flow;
  const uint8_t command = step.response.Data[0];
  const uint32_t wanted = flow.Size < wire::expedited_bytes ? flow.Size : wire::expedited_bytes;
  const uint32_t n = wire::is_size_indicated(command) ? wire::expedited_length(command) : wanted;
  const Abort abort = append(step.client, step.response.Data + 4, n);
  if (abort != Abort::none) {
    return abort;
  }
  set(flow, sized);
  flow.Size = n;
  return complete(step);
}

// Stores the size that the server announces. Returns an abort code.
Abort store_size(Step& step) {
  CO_SDO_FLOW& flow = step.client.Flow;
  const uint32_t room = flow.Size;
  set(flow, sized);
  flow.Size = wire::get_high(step.response);
  return flow.Size > room ? Abort::memory : Abort::none;
}

// Checks the total length, which is the announced size, or fits into the caller's buffer. Returns an abort code.
Abort check_total(const CO_SDO_FLOW& flow, uint32_t total) {
  if (has(flow, sized)) {
    return access::compare_length(total, flow.Size);
  }
  return total > flow.Size ? Abort::memory : Abort::none;
}

}  // namespace

Abort upload_accepted(Step& step) {
  CO_CSDO& client = step.client;
  const uint8_t command = step.response.Data[0];
  if (wire::is_expedited(command)) {
    return take_expedited(step);
  }
  const Abort abort = wire::is_size_indicated(command) ? store_size(step) : Abort::none;
  step.request.Data[0] = wire::upload_segment_request(0);
  set_state(client, State::upload);
  return abort;
}

Abort segment_uploaded(Step& step) {
  CO_SDO_FLOW& flow = step.client.Flow;
  const uint8_t command = step.response.Data[0];
  if (wire::toggle(step.response) != (flow.Flags & toggled)) {
    return Abort::toggle_bit;
  }
  const uint32_t n =
      has(flow, sized) ? wire::segment_length(command, flow.Size - flow.Num) : wire::segment_length(command);
  const Abort abort = append(step.client, step.response.Data + 1, n);
  if (abort != Abort::none) {
    return abort;
  }
  flow.Flags ^= toggled;
  step.request.Data[0] = wire::upload_segment_request(flow.Flags & toggled);
  if (!wire::is_last_segment(command)) {
    return Abort::none;
  }
  const Abort wrong = check_total(flow, flow.Num);
  return wrong == Abort::none ? complete(step) : wrong;
}

}  // namespace co::sdo::client

// Block upload: segments are stored directly in the caller's buffer. [301:7.2.4.3.13-15]

#if USE_CSDO && CO_CSDO_BLOCK > 0

namespace co::sdo::client {
namespace {

// Parts of the time-out without segments after which the acknowledge is sent again. The first one, which begins with a
// request, is counted at its begin.
constexpr uint8_t reminder_part = 3;

uint8_t* buffer_of(const CO_CSDO& client) { return client.Buf + client.Flow.Num; }

// Counts the bytes of a block that is acknowledged; those of the last block are counted at the end of the transfer.
void count_block(CO_CSDO& client) {
  add_to_crc(client.Flow, buffer_of(client));
  client.Flow.Num += client.Flow.Fill;
  client.Flow.Fill = 0;
}

}  // namespace

Abort block_upload_accepted(Step& step) {
  CO_SDO_FLOW& flow = step.client.Flow;
  const Abort abort = wire::is_block_sized(step.response.Data[0]) ? store_size(step) : Abort::none;
  begin_blocks(flow, step.response, wire::max_blksize);
  step.request.Data[0] = wire::start_block;
  set_state(step.client, State::block_upload);
  return abort;
}

Abort block_segment_uploaded(Step& step) {
  CO_CSDO& client = step.client;
  if (state_of(client) == State::block_upload && wire::seqno(step.response.Data[0]) == 0) {
    return Abort::sequence_number;
  }
  const Arrival arrival = state_of(client) == State::block_upload
                              ? receive_segment(client.Flow, buffer_of(client), step.response)
                              : Arrival::within;
  if (has(client.Flow, too_long)) {
    return has(client.Flow, sized) ? Abort::too_long : Abort::memory;
  }
  if (arrival == Arrival::within) {
    silence(step.request);
    return Abort::none;
  }
  if (arrival == Arrival::last) {
    set_state(client, State::block_upload_end);
  } else {
    count_block(client);
  }
  acknowledge(client.Flow, wire::max_blksize, step.request);
  return Abort::none;
}

bool is_last_segment_again(const CO_CSDO& client, const CO_IF_FRM& frame) {
  return sdo::is_last_segment_again(client.Flow, buffer_of(client), frame);
}

Abort block_upload_ended(Step& step) {
  CO_SDO_FLOW& flow = step.client.Flow;
  const uint32_t total = flow.Num + last_bytes(flow, step.response);
  const Abort abort = check_total(flow, total);
  if (abort != Abort::none) {
    return abort;
  }
  if (!is_crc_right(flow, buffer_of(step.client), step.response)) {
    return Abort::crc;
  }
  flow.Num = total;
  step.request.Data[0] = wire::confirm_block;
  step.done = true;
  return Abort::none;
}

// A server that stops within a block may have lost the acknowledge, or the client may have lost the last segment of the
// block.
void handle_quarter(CO_CSDO& client) {
  ++client.Flow.Idle;
  if (client.Flow.Idle > quarters) {
    abort_transfer(client, Abort::time_out);
    return;
  }
  if (client.Flow.Idle == reminder_part) {
    CO_IF_FRM request = wire::empty_frame(client.TxId);
    if (client.Flow.Heard != 0) {
      count_block(client);
    }
    if (repeat_acknowledge(client.Flow, wire::max_blksize, request)) {
      transmit::send(*client.Node, request);
    }
  }
  start_timeout(client);
}

}  // namespace co::sdo::client

#endif
