// SPDX-License-Identifier: Apache-2.0
#include "client/sdo_client.hpp"

#include <utility>

#include "trace/decode.hpp"

namespace lexican {
namespace {

constexpr std::uint8_t abort_command = 0x80;

std::string reason(CO_ERR error) {
  switch (error) {
    case CO_ERR_BAD_ARG: return "an SDO transfer carries at least one byte";
    case CO_ERR_SDO_OFF: return "the NMT state of the master allows no SDO";
    case CO_ERR_SDO_BUSY: return "another transfer is active";
    case CO_ERR_IF_CAN_SEND: return "the CAN driver accepts no frames";
    default: return std::string(COErrName(error)) + ": " + COErrText(error);
  }
}

}  // namespace

ClientDictionary::ClientDictionary(std::uint8_t server)
    : objects_{{
          {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},  // no device profile
          {CO_KEY(0x1001, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(0)},
          {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(4)},
          {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},  // no vendor-ID of CiA
          {CO_KEY(0x1018, 2, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
          {CO_KEY(0x1018, 3, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
          {CO_KEY(0x1018, 4, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
          {CO_KEY(0x1280, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(3)},
          {CO_KEY(0x1280, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(CO_COBID_SDO_REQUEST() + server)},
          {CO_KEY(0x1280, 2, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(CO_COBID_SDO_RESPONSE() + server)},
          {CO_KEY(0x1280, 3, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(server)},
      }} {}

std::string Transfer::outcome() const {
  if (is_unanswered()) {
    return "no answer";
  }
  if (code != 0) {
    return "aborted with " + trace::abort_code(code) + ' ' + trace::abort_meaning(code);
  }
  return fault.empty() ? "done" : fault;
}

SdoClient::SdoClient(Node& node, Loop& loop, Options usual) : node_(node), loop_(loop), usual_(std::move(usual)) {}

void SdoClient::note_end(CO_CSDO* client, std::uint16_t, std::uint8_t, std::uint32_t code) {
  auto& self = *static_cast<SdoClient*>(CONodeGetUser(client->Node));
  self.ended_ = true;
  self.code_ = code;
}

void SdoClient::begin(CO_CSDO& client, std::uint16_t index, std::uint8_t sub) {
  node_.set_user(this);  // set for each transfer, because the LSS master of the same node sets it, too
  ended_ = false;
  refusal_.reset();
  // Devices that do not support a request abort it with index 0. [301:7.2.4.3.17]
  node_.set_receiver([this, response = client.RxId, object = index | std::uint32_t{sub} << 16](const CO_IF_FRM& frame) {
    const std::uint32_t aborted = CO_GET_LONG(&frame, 0) >> 8;
    if (frame.Identifier == response && frame.DLC == 8 && frame.Data[0] == abort_command &&
        (aborted == object || aborted == 0)) {
      refusal_ = CO_GET_LONG(&frame, 4);
    }
  });
}

Transfer SdoClient::wait_for_end(CO_CSDO& client, const Options& options) {
  const Micros begin = loop_.now();
  const auto has_ended = [&] {
    if (options.watch) {
      options.watch({COCSdoGetNum(&client), COCSdoGetTotal(&client), loop_.now() - begin});
    }
    return ended_;
  };
  if (!loop_.run_until(has_ended, for_ever)) {
    COCSdoCancel(&client);
  }
  node_.set_receiver({});
  return {{}, code_, {}, code_ != 0 && refusal_ == code_};
}

Transfer SdoClient::upload(std::uint16_t index, std::uint8_t sub, const Options& options) {
  CO_CSDO* const client = COCSdoFind(&node_.stack(), 0);
  Bytes data(options.capacity);
  begin(*client, index, sub);
  const CO_ERR error =
      COCSdoRequestUpload(client, CO_DEV(index, sub), data.data(), options.capacity, note_end, options.timeout);
  if (error != CO_ERR_NONE) {
    return {{}, 0, reason(error)};
  }
  Transfer transfer = wait_for_end(*client, options);
  if (transfer.done()) {
    data.resize(COCSdoGetNum(client));
    transfer.data = std::move(data);
  }
  return transfer;
}

Transfer SdoClient::download(std::uint16_t index, std::uint8_t sub, Bytes data, const Options& options) {
  CO_CSDO* const client = COCSdoFind(&node_.stack(), 0);
  data.reserve(1);  // no bytes have an address, too
  begin(*client, index, sub);
  const CO_ERR error = COCSdoRequestDownload(client, CO_DEV(index, sub), data.data(),
                                             static_cast<std::uint32_t>(data.size()), note_end, options.timeout);
  return error == CO_ERR_NONE ? wait_for_end(*client, options) : Transfer{{}, 0, reason(error)};
}

}  // namespace lexican
