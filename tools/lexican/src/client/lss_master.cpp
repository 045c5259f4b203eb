// SPDX-License-Identifier: Apache-2.0
#include "client/lss_master.hpp"

#include <utility>

#include "trace/text.hpp"

#if USE_LSS_MASTER

namespace lexican {
namespace {

constexpr unsigned manufacturers_error = 255;  // the specific error code has the details

}  // namespace

LssMaster::LssMaster(Node& node, Loop& loop, Times times)
    : node_(node), lssm_(node.stack().Lssm), loop_(loop), listen_(times.listen) {
  COLssmSetTimes(&lssm_, times.timeout, times.listen);
}

void LssMaster::note_end(CO_LSSM* lssm, CO_LSSM_RESULT result) {
  auto& self = *static_cast<LssMaster*>(CONodeGetUser(lssm->Node));
  self.ended_ = true;
  self.result_ = result;
}

void LssMaster::begin() {
  node_.set_user(this);  // set for each service, because the SDO client of the same node sets it, too
  ended_ = false;
  fault_.clear();
}

bool LssMaster::wait_for_end(CO_ERR start_result) {
  error_ = start_result;
  if (error_ == CO_ERR_NONE && !loop_.run_until([this] { return ended_; }, for_ever)) {
    COLssmCancel(&lssm_);
  }
  return error_ == CO_ERR_NONE && result_ == CO_LSSM_OK;
}

bool LssMaster::is_alone() {
  loop_.run_for(listen_ * millisecond);
  if (lssm_.Heard <= 1) {
    return true;
  }
  return fail(
      text("%u nodes have answered where one was addressed; give each node its own serial number, or connect "
           "one at a time",
           lssm_.Heard));
}

bool LssMaster::fail(std::string fault) {
  fault_ = std::move(fault);
  return false;
}

std::string LssMaster::fault() const {
  if (!fault_.empty()) {
    return fault_;
  }
  if (error_ != CO_ERR_NONE) {
    return error_ == CO_ERR_IF_CAN_SEND ? "the CAN driver accepts no frames"
                                        : std::string(COErrName(error_)) + ": " + COErrText(error_);
  }
  switch (result_) {
    case CO_LSSM_REFUSED:
      return lssm_.Error == manufacturers_error ? text("refused, manufacturer's error %u", lssm_.Specific)
                                                : text("refused with error %u", lssm_.Error);
    case CO_LSSM_TIMEOUT: return "no answer; is there such a node on this bus, with power, and at this bit rate?";
    case CO_LSSM_NOT_FOUND: return "no node without node-ID";
    case CO_LSSM_NOT_SENT: return "the CAN driver accepts no frames";
    case CO_LSSM_CANCELLED: return "cancelled";
    default: return "the node of the master was stopped";
  }
}

}  // namespace lexican

#endif
