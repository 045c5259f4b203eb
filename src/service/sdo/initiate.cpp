// SPDX-License-Identifier: Apache-2.0
// Initiate requests of all transfers, and expedited transfers. [301:7.2.4.3.3-14]
#include "service/sdo/server.hpp"

namespace co::sdo::server {
namespace {

// Returns the maximum number of bytes of a download whose size is not announced.
uint32_t capacity(CO_NODE& node, CO_OBJ& obj) { return access::size(obj, node, obj::is_stream(obj) ? UINT32_MAX : 0); }

// Sets Size to the size of the object. Returns an abort code.
Abort measure_upload(CO_SDO& channel, CO_OBJ& obj, const CO_IF_FRM& request, bool& by_block) {
  channel.Flow.Size = access::size(obj, *channel.Node, 0);
  if (obj::is_no_size(obj, channel.Flow.Size)) {
    return access::abort_for(*channel.Node, CO_ERR_TYPE_RD);
  }
  if (!has_block || !by_block) {
    return Abort::none;
  }
  by_block = is_worth_block(channel.Flow.Size, request);
  return check_block_upload(channel, obj, request);
}

// Sets Size to the announced size, or to the maximum of the object. Returns an abort code.
Abort measure_download(CO_SDO& channel, CO_OBJ& obj, const CO_IF_FRM& request, bool is_expedited) {
  CO_NODE& node = *channel.Node;
  if (!has(channel.Flow, sized)) {
    channel.Flow.Size = capacity(node, obj);
    if (!is_expedited) {
      return channel.Flow.Size == 0 && !obj::is_stream(obj) ? access::abort_for(node, CO_ERR_TYPE_WR) : Abort::none;
    }
    if (channel.Flow.Size > wire::expedited_bytes) {
      return Abort::length;
    }
  } else {
    channel.Flow.Size = is_expedited ? wire::expedited_length(request.Data[0]) : wire::get_high(request);
  }
  return access::check_length(node, obj, channel.Flow.Size);
}

// Reads or writes an object of up to 4 bytes, and ends the transfer.
Abort transfer_expedited(CO_SDO& channel, CO_OBJ& obj, const CO_IF_FRM& request, CO_IF_FRM& answer) {
  uint8_t* data = channel.Value;
  if (has(channel.Flow, download)) {
    wire::put_reply(answer, wire::initiate_download_response, request);
    wire::put_aligned(data, wire::get_high(request));
  } else {
    wire::put_reply(answer, wire::expedited_upload_response(channel.Flow.Size), request);
    data = answer.Data + 4;
  }
  const Abort abort = begin_data(channel, obj, data, channel.Flow.Size);
  return abort == Abort::none && access::is_begun(channel) ? close(channel, Abort::none) : abort;
}

#if USE_SDO_BLOCK
void answer_block_initiate(CO_SDO& channel, const CO_IF_FRM& request, CO_IF_FRM& answer) {
  uint8_t blksize = request.Data[4];
  if (has(channel.Flow, download)) {
    blksize = CO_SDO_BUF_SEG;
    answer.Data[4] = blksize;
  }
  channel.Summed = 0;
  begin_blocks(channel.Flow, request, blksize);
}
#else
void answer_block_initiate(CO_SDO&, const CO_IF_FRM&, CO_IF_FRM&) {}
#endif

// Starts a segmented or a block transfer.
Abort begin_longer(CO_SDO& channel, CO_OBJ& obj, bool by_block, const CO_IF_FRM& request, CO_IF_FRM& answer) {
  const bool is_download = has(channel.Flow, download);
  const bool is_whole = is_value(channel, obj);
  if (is_whole) {
    set(channel.Flow, whole);
  }
  Abort abort = Abort::none;
  if (is_download) {
    continue_transfer(channel, obj, by_block ? State::block_download : State::download);
    wire::put_reply(answer, by_block ? wire::accept_block : wire::initiate_download_response, request);
    if (!by_block && !is_whole) {
      abort = begin_data(channel, obj, channel.Value, 0);
    }
  } else {
    continue_transfer(channel, obj, by_block ? State::block_upload_ready : State::upload);
    abort = begin_data(channel, obj, channel.Value, is_whole ? channel.Flow.Size : 0);
    const bool is_known = !obj::is_unknown(channel.Flow.Size);
    wire::put_reply(answer, by_block ? wire::initiate_block(is_known) : wire::initiate_upload_response(is_known),
                    request);
    wire::put_high(answer, is_known ? channel.Flow.Size : 0);
  }
  if (has_block && by_block && abort == Abort::none) {
    answer_block_initiate(channel, request, answer);
  }
  return abort;
}

// Performs the checks at the begin of every transfer: object, access right, access hook. The object becomes that of the
// request. Returns an abort code.
Abort check(CO_SDO& channel, const CO_IF_FRM& request, CO_OBJ* obj) {
  CO_NODE& node = *channel.Node;
  Abort abort = stream::check(node, channel.Key, obj, access::direction_of(channel));
  node.Request->Obj = obj;
  if (USE_ACCESS_HOOK != 0 && abort == Abort::none) {
    abort = ask_application(channel, request);
  }
  return abort;
}

}  // namespace

Abort initiate(CO_SDO& channel, const CO_IF_FRM& request, CO_IF_FRM& answer, CO_OBJ* obj) {
  const uint8_t command = request.Data[0];
  const bool is_upload = wire::initiates_upload(command);
  bool by_block = has_block && wire::initiates_block(command);
  restart(channel, request);
  if (by_block && !has_buffer(channel)) {
    return Abort::command;
  }
  if (obj == nullptr) {
    obj = dict::find(*channel.Node, channel.Key);
  }
  channel.Flow.Flags = 0;
  if (!is_upload) {
    const bool is_sized = by_block ? wire::is_block_sized(command) : wire::is_size_indicated(command);
    channel.Flow.Flags = is_sized ? download | sized : download;
  }
  Abort abort = check(channel, request, obj);
  if (abort != Abort::none) {
    return abort;
  }
  bool is_expedited = !by_block && wire::is_expedited(command);
  abort = is_upload ? measure_upload(channel, *obj, request, by_block)
                    : measure_download(channel, *obj, request, is_expedited);
  if (abort == Abort::none && obj::is_stream(*obj)) {
    abort =
        begin_stream(channel, *obj, is_upload || has(channel.Flow, sized) ? channel.Flow.Size : CO_OBJ_SIZE_UNKNOWN);
  }
  if (abort != Abort::none) {
    return abort;
  }
  if (is_upload) {
    is_expedited = !by_block && channel.Flow.Size - 1 < wire::expedited_bytes;
  }
  return is_expedited ? transfer_expedited(channel, *obj, request, answer)
                      : begin_longer(channel, *obj, by_block, request, answer);
}

}  // namespace co::sdo::server
