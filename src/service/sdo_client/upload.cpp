// SPDX-License-Identifier: Apache-2.0
// Expedited and segmented upload. [301:7.2.4.3.5-6]
#include "service/sdo_client/transfer.hpp"

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

// Expedited and segmented download. [301:7.2.4.3.3-4]

namespace {

uint32_t next_length(const CO_CSDO& client) {
  const uint32_t left = client.Size - client.Num;
  return left < wire::segment_bytes ? left : wire::segment_bytes;
}

void put_segment(const CO_CSDO& client, CO_IF_FRM& request) {
  const uint32_t n = next_length(client);
  request.Data[0] = wire::segment(client.Toggle, n, client.Num + n == client.Size);
  __builtin_memcpy(request.Data + 1, client.Buf + client.Num, n);
}

}  // namespace

Abort download_accepted(Step& step) {
  CO_CSDO& client = step.client;
  if (is_expedited(client)) {
    client.Num = client.Size;
    step.silent = true;
    step.done = true;
    return Abort::none;
  }
  put_segment(client, step.request);
  set_state(client, State::download);
  return Abort::none;
}

Abort segment_downloaded(Step& step) {
  CO_CSDO& client = step.client;
  if (wire::toggle(step.response) != client.Toggle) {
    return Abort::toggle_bit;
  }
  client.Num += next_length(client);
  client.Toggle ^= wire::toggle_bit;
  if (client.Num == client.Size) {
    step.silent = true;
    step.done = true;
    return Abort::none;
  }
  put_segment(client, step.request);
  return Abort::none;
}

}  // namespace co::sdo_client
