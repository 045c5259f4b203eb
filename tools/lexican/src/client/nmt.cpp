// SPDX-License-Identifier: Apache-2.0
#include "client/nmt.hpp"

#include "client/sdo_client.hpp"
#include "host/exit.hpp"
#include "host/loop.hpp"
#include "host/node.hpp"

namespace lexican {

#if USE_NMT_MASTER

namespace {

std::string fault_of(CO_ERR error) {
  switch (error) {
    case CO_ERR_NONE: return {};
    case CO_ERR_IF_CAN_SEND: return "the CAN driver accepts no frames";
    default: return std::string(COErrName(error)) + ": " + COErrText(error);
  }
}

}  // namespace

int carry_out(const NmtRequest& request, Host& host, std::ostream& err) {
  ClientDictionary dictionary(no_sdo);
  Node node({request.own_id, host.master_can(), host.master_timer(), dictionary.table()});
  Loop loop(host, {&node});
  CONodeStart(&node.stack());
  std::string fault =
      fault_of(CONmtCommand(&node.stack().Nmt, static_cast<CO_NMT_COMMAND>(request.command), request.node));
  loop.flush(flush_time);
  if (fault.empty()) {
    fault = host.bus_fault();
  }
  if (!fault.empty()) {
    err << "NMT: " << fault << std::endl;
  }
  return fault.empty() ? exit_ok : exit_failed;
}

#else

int carry_out(const NmtRequest&, Host&, std::ostream& err) {
  err << "this build of the stack has no NMT master" << std::endl;
  return exit_usage;
}

#endif

}  // namespace lexican
