// SPDX-License-Identifier: Apache-2.0
#include "client/request.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>

#include "host/exit.hpp"
#include "host/loop.hpp"
#include "trace/decode.hpp"
#include "trace/text.hpp"

namespace lexican {
namespace {

Transfer transfer(const Request& request, SdoClient& sdo, const SdoClient::Options& options) {
  return request.write ? sdo.download(request.index, request.sub, request.data, options)
                       : sdo.upload(request.index, request.sub, options);
}

std::string fault_text(const Request& request, const Outcome& outcome) {
  std::string words = text("node %u, %04Xh:%02X: ", request.node, request.index, request.sub);
  if (outcome.interrupted) {
    return words + "cancelled";
  }
  words += outcome.transfer.outcome();
  if (outcome.transfer.is_unanswered() && outcome.bus_fault.empty()) {
    words += text("; is node %u on this bus, with power, and at this bit rate?", request.node);
  }
  if (!request.write && outcome.transfer.code == CO_SDO_ERR_MEM) {
    words += text("; the object has more than %u bytes", request.capacity);
  }
  return outcome.bus_fault.empty() ? words : words + '\n' + outcome.bus_fault;
}

/// Returns true for device name, hardware and software version, which are VISIBLE_STRING. [301:7.5.2.8]
bool is_visible_string(const Request& request) {
  return request.index >= 0x1008 && request.index <= 0x100A && request.sub == 0;
}

/// Returns the value in the form of its type; without a type a visible string as text, other objects by guess().
Shown show(const Request& request, const Bytes& bytes) {
  if (request.type) {
    return show(*request.type, bytes);
  }
  const std::string text = is_visible_string(request) ? visible_text(bytes) : std::string();
  return {text.empty() ? guess(bytes) : text, {}};
}

int write_bytes(const Bytes& bytes, std::ostream& out, const std::string& file, std::ostream& err) {
  out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!out.flush()) {
    err << "cannot write '" << file << "': " << std::strerror(errno) << '\n';
    return exit_usage;
  }
  return exit_ok;
}

int write_file(const Bytes& bytes, const std::string& file, std::ostream& out, std::ostream& err) {
  if (file == "-") {
    return write_bytes(bytes, out, file, err);
  }
  std::ofstream stream(file, std::ios::binary);
  return write_bytes(bytes, stream, file, err);
}

}  // namespace

Outcome carry_out(const Request& request, Host& host, Progress::Form form, std::ostream& err) {
  ClientDictionary dictionary(request.node);
  Node node({request.own_id, host.master_can(), host.master_timer(), dictionary.table()});
  Loop loop(host, {&node});
  SdoClient sdo(node, loop);
  ProgressLine progress(err, form);
  CONodeStart(&node.stack());
  Outcome outcome{};
  outcome.transfer = transfer(
      request, sdo, {request.capacity, request.timeout, [&](const Amount& amount) { progress.update(amount); }});
  progress.end();
  // A lost bus interrupts the loop, too; it is reported as bus_fault.
  outcome.interrupted = !outcome.transfer.done() && loop.interrupted() && !host.bus_lost();
  loop.flush(flush_time);
  outcome.bus_fault = host.bus_fault();
  return outcome;
}

int report(const Request& request, const Outcome& outcome, std::ostream& out, std::ostream& err) {
  const Transfer& transfer = outcome.transfer;
  if (!transfer.done()) {
    err << fault_text(request, outcome) << std::endl;
    if (outcome.interrupted) {
      return exit_interrupted;
    }
    return transfer.fault.empty() ? exit_failed : exit_usage;
  }
  if (request.write) {
    return exit_ok;
  }
  if (!request.file.empty()) {
    return write_file(transfer.data, request.file, out, err);
  }
  const Shown shown = show(request, transfer.data);
  if (!shown.fault.empty()) {
    err << text("node %u, %04Xh:%02X: ", request.node, request.index, request.sub) << shown.fault << std::endl;
    return exit_failed;
  }
  out << shown.text << std::endl;
  return exit_ok;
}

}  // namespace lexican
