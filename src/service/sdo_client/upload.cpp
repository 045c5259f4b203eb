// SPDX-License-Identifier: Apache-2.0
// Expedited and segmented upload. [301:7.2.4.3.5-6]
#include "service/sdo_client/transfer.hpp"

namespace co::sdo_client {
namespace {

uint32_t append(CO_CSDO& client, const uint8_t* data, uint32_t n) {
  if (n > client.Size - client.Num) {
    return CO_SDO_ERR_MEM;
  }
  __builtin_memcpy(client.Buf + client.Num, data, n);
  client.Num += n;
  return no_abort;
}

// Stores expedited data. If the server indicates no size, the caller's buffer determines the length, up to 4 bytes.
uint32_t take_expedited(Step& step) {
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

uint32_t store_size(Step& step) {
  CO_CSDO& client = step.client;
  set(client, sized);
  client.Total = wire::get_high(step.response);
  return client.Total > client.Size ? CO_SDO_ERR_MEM : no_abort;
}

uint32_t check_total(const CO_CSDO& client, uint32_t total) {
  if (!has(client, sized) || total == client.Total) {
    return no_abort;
  }
  return total > client.Total ? CO_SDO_ERR_LEN_HIGH : CO_SDO_ERR_LEN_SMALL;
}

uint32_t upload_accepted(Step& step) {
  CO_CSDO& client = step.client;
  const uint8_t command = step.response.Data[0];
  if (wire::is_expedited(command)) {
    return take_expedited(step);
  }
  const uint32_t abort = wire::is_size_indicated(command) ? store_size(step) : no_abort;
  step.request.Data[0] = wire::upload_segment_request(client.Toggle);
  set_state(client, State::upload);
  return abort;
}

uint32_t segment_uploaded(Step& step) {
  CO_CSDO& client = step.client;
  const uint8_t command = step.response.Data[0];
  if (wire::toggle(step.response) != client.Toggle) {
    return CO_SDO_ERR_TBIT;
  }
  const uint32_t left = client.Total - client.Num;
  const uint32_t n = has(client, sized) ? wire::segment_length(command, left) : wire::segment_length(command);
  if (has(client, sized) && n > left) {
    return CO_SDO_ERR_LEN_HIGH;
  }
  const uint32_t abort = append(client, step.response.Data + 1, n);
  if (abort != no_abort) {
    return abort;
  }
  client.Toggle ^= wire::toggle_bit;
  step.request.Data[0] = wire::upload_segment_request(client.Toggle);
  step.done = wire::is_last_segment(command);
  step.silent = step.done;
  return step.done ? check_total(client, client.Num) : no_abort;
}

}  // namespace co::sdo_client
