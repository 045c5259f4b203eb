// SPDX-License-Identifier: Apache-2.0
// Uploads by a client: expedited, segments and blocks. [301:7.2.4.3.5-6, 7.2.4.3.13]
#include "base/transmit.hpp"
#include "service/sdo/client.hpp"

namespace co::sdo_client {

namespace {

Abort append(CO_CSDO& client, const uint8_t* data, uint32_t n) {
  if (n > client.Size - client.Num) {
    return Abort::memory;
  }
  __builtin_memcpy(client.Buf + client.Num, data, n);
  client.Num += n;
  return Abort::none;
}

// Stores expedited data. If the server indicates no size, the caller's buffer determines the length, up to 4 bytes.
Abort take_expedited(Step& step) {
  CO_CSDO& client = step.client;
  const uint8_t command = step.response.Data[0];
  const uint32_t wanted = client.Size < wire::expedited_bytes ? client.Size : wire::expedited_bytes;
  const uint32_t n = wire::is_size_indicated(command) ? wire::expedited_length(command) : wanted;
  step.silent = true;
  step.done = true;
  client.Total = n;
  return append(client, step.response.Data + 4, n);
}

}  // namespace

Abort store_size(Step& step) {
  CO_CSDO& client = step.client;
  set(client, sized);
  client.Total = wire::get_high(step.response);
  return client.Total > client.Size ? Abort::memory : Abort::none;
}

Abort check_total(const CO_CSDO& client, uint32_t total) {
  if (!has(client, sized) || total == client.Total) {
    return Abort::none;
  }
  return total > client.Total ? Abort::too_long : Abort::too_short;
}

Abort upload_accepted(Step& step) {
  CO_CSDO& client = step.client;
  const uint8_t command = step.response.Data[0];
  if (wire::is_expedited(command)) {
    return take_expedited(step);
  }
  const Abort abort = wire::is_size_indicated(command) ? store_size(step) : Abort::none;
  step.request.Data[0] = wire::upload_segment_request(client.Toggle);
  set_state(client, State::upload);
  return abort;
}

Abort segment_uploaded(Step& step) {
  CO_CSDO& client = step.client;
  const uint8_t command = step.response.Data[0];
  if (wire::toggle(step.response) != client.Toggle) {
    return Abort::toggle_bit;
  }
  const uint32_t left = client.Total - client.Num;
  const uint32_t n = has(client, sized) ? wire::segment_length(command, left) : wire::segment_length(command);
  if (has(client, sized) && n > left) {
    return Abort::too_long;
  }
  const Abort abort = append(client, step.response.Data + 1, n);
  if (abort != Abort::none) {
    return abort;
  }
  client.Toggle ^= wire::toggle_bit;
  step.request.Data[0] = wire::upload_segment_request(client.Toggle);
  step.done = wire::is_last_segment(command);
  step.silent = step.done;
  return step.done ? check_total(client, client.Num) : Abort::none;
}

}  // namespace co::sdo_client

// Block upload: segments are stored directly in the caller's buffer. [301:7.2.4.3.13-15]

#if USE_CSDO && CO_CSDO_BLOCK > 0

namespace co::sdo_client {
namespace {

// Quarters of the time-out without segments after which the acknowledge is sent again.
constexpr uint8_t reminder_quarter = 2;

void begin_block(CO_CSDO& client) {
  client.Seq = 0;
  clear(client, heard);
}

void put_acknowledge(const CO_CSDO& client, CO_IF_FRM& request) {
  request.Data[0] = wire::acknowledge_block;
  request.Data[1] = client.AckSeq;
  request.Data[2] = wire::max_blksize;
}

void count_bytes(CO_CSDO& client, uint32_t n) {
  if (has(client, crc)) {
    client.Crc = wire::crc16(client.Crc, client.Buf + client.Num, n);
  }
  client.Num += n;
}

// Stores a segment. The number of data bytes in the last segment is known only from the end message.
Abort store_segment(CO_CSDO& client, const CO_IF_FRM& segment) {
  const uint32_t position = client.Num + client.Seq * wire::segment_bytes;
  const uint32_t room = client.Size - position;
  const bool last = wire::is_last_in_block(segment.Data[0]);
  if (!last && has(client, sized) && client.Total - position < wire::segment_bytes) {
    return Abort::too_long;
  }
  if (!last && room < wire::segment_bytes) {
    return Abort::memory;
  }
  __builtin_memcpy(client.Buf + position, segment.Data + 1, room < wire::segment_bytes ? room : wire::segment_bytes);
  ++client.Seq;
  return Abort::none;
}

// Acknowledges the segments in sequence: the server continues behind the last of them.
void end_block(CO_CSDO& client, CO_IF_FRM& request) {
  client.AckSeq = client.Seq;
  put_acknowledge(client, request);
  count_bytes(client, client.Seq * wire::segment_bytes);
  begin_block(client);
}

// Acknowledges the last block. The bytes of its last segment are counted at the end of the transfer.
void end_last_block(CO_CSDO& client, CO_IF_FRM& request) {
  client.AckSeq = client.Seq;
  put_acknowledge(client, request);
  count_bytes(client, (client.Seq - 1U) * wire::segment_bytes);
  clear(client, heard);
  set_state(client, State::block_upload_end);
}

// Returns whether a frame that ends a block, and is the first one heard since the acknowledge, is taken for the
// repeated end of the previous block. It may also be the end of this block, whose other segments were lost: therefore
// the client does not respond, and sends the acknowledge again after two quarters of the time-out.
bool is_repeated(const CO_CSDO& client, uint8_t number) {
  return number > 1 && client.AckSeq != 0 && !has(client, heard);
}

// Returns whether a frame is a valid end message. The last segment of some objects has the same form.
bool is_right_end(const CO_CSDO& client, const CO_IF_FRM& frame) {
  const uint32_t n = wire::segment_bytes - wire::unused_in_block(frame.Data[0]);
  return wire::response_of(frame.Data[0]) == wire::Response::end_block_upload && n <= client.Size - client.Num &&
         check_total(client, client.Num + n) == Abort::none &&
         (!has(client, crc) || wire::crc16(client.Crc, client.Buf + client.Num, n) == wire::get_u16(frame.Data + 1));
}

// Fills a repeated acknowledge for a server that no longer sends. Returns false if there is nothing to acknowledge.
bool put_repeated_acknowledge(CO_CSDO& client, CO_IF_FRM& request) {
  if (has(client, heard)) {
    end_block(client, request);
    return true;
  }
  put_acknowledge(client, request);
  return client.AckSeq != 0;
}

}  // namespace

Abort block_upload_accepted(Step& step) {
  CO_CSDO& client = step.client;
  const uint8_t command = step.response.Data[0];
  if (wire::has_crc(command)) {
    set(client, crc);
  }
  const Abort abort = wire::is_block_sized(command) ? store_size(step) : Abort::none;
  client.AckSeq = 0;
  begin_block(client);
  step.request.Data[0] = wire::start_block;
  set_state(client, State::block_upload);
  return abort;
}

Abort block_segment_uploaded(Step& step) {
  CO_CSDO& client = step.client;
  const uint8_t number = wire::seqno(step.response.Data[0]);
  const bool last = wire::is_last_in_block(step.response.Data[0]);
  const bool ends = last || number == wire::max_blksize;
  const bool in_order = number == client.Seq + 1;
  const bool repeated = ends && is_repeated(client, number);
  step.silent = true;
  if (state_of(client) != State::block_upload) {
    return Abort::none;
  }
  if (number == 0) {
    return Abort::sequence_number;
  }
  set(client, heard);
  set(client, active);
  if (repeated) {
    return Abort::none;
  }
  const Abort abort = in_order ? store_segment(client, step.response) : Abort::none;
  if (abort != Abort::none || !ends) {
    return abort;
  }
  if (in_order && last) {
    end_last_block(client, step.request);
  } else {
    end_block(client, step.request);
  }
  step.silent = false;
  return Abort::none;
}

bool is_last_segment_again(const CO_CSDO& client, const CO_IF_FRM& frame) {
  const uint32_t room = client.Size - client.Num;
  const uint32_t n = room < wire::segment_bytes ? room : wire::segment_bytes;
  return frame.Data[0] == wire::block_segment(client.AckSeq, true) &&
         wire::is_equal(frame.Data + 1, client.Buf + client.Num, n) && !is_right_end(client, frame);
}

Abort block_upload_ended(Step& step) {
  CO_CSDO& client = step.client;
  const uint32_t n = wire::segment_bytes - wire::unused_in_block(step.response.Data[0]);
  Abort abort = check_total(client, client.Num + n);
  if (abort == Abort::none && n > client.Size - client.Num) {
    abort = Abort::memory;
  }
  if (abort != Abort::none) {
    return abort;
  }
  count_bytes(client, n);
  if (has(client, crc) && client.Crc != wire::get_u16(step.response.Data + 1)) {
    return Abort::crc;
  }
  step.request.Data[0] = wire::confirm_block;
  step.done = true;
  return Abort::none;
}

// A server that stops within a block may have lost the acknowledge, or the client may have lost the last segment of the
// block.
void handle_quarter(CO_CSDO& client) {
  client.Silence = has(client, active) ? 0 : static_cast<uint8_t>(client.Silence + 1);
  if (client.Silence == quarters) {
    abort_transfer(client, Abort::time_out);
    return;
  }
  CO_IF_FRM request = wire::empty_frame(client.TxId);
  if (client.Silence == reminder_quarter && put_repeated_acknowledge(client, request)) {
    transmit::send(*client.Node, request);
  }
  start_timeout(client);
}

}  // namespace co::sdo_client

#endif
