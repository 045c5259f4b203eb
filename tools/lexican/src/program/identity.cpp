// SPDX-License-Identifier: Apache-2.0
#include "program/identity.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <iostream>

namespace lexican::program {
namespace {

constexpr std::uint16_t identity_object = 0x1018;
constexpr std::uint16_t store_eds = 0x1021;
constexpr std::uint16_t storage_format = 0x1022;
constexpr std::uint8_t not_compressed = 0;
constexpr std::uint32_t largest_eds = 4 * 1024 * 1024;

bool is_terminal() { return isatty(STDIN_FILENO) != 0 && isatty(STDERR_FILENO) != 0; }

}  // namespace

bool may_upload(const Common& common) { return !describe::user_library().empty() && (common.is_sure || is_terminal()); }

std::optional<describe::Identity> read_identity(SdoClient& sdo, std::uint32_t timeout, Transfer& transfer) {
  describe::Identity identity;
  std::uint8_t sub = 0;
  for (std::uint32_t* const part : {&identity.vendor, &identity.product, &identity.revision}) {
    transfer = sdo.upload(identity_object, ++sub, {SdoClient::small, timeout, {}});
    if (!transfer.done() || transfer.data.size() != 4) {
      const bool is_optional = part == &identity.revision && !transfer.is_unanswered();
      return is_optional ? std::optional(identity) : std::nullopt;
    }
    *part = static_cast<std::uint32_t>(number_of(transfer.data));
  }
  return identity;
}

bool LibraryFiles::describe(std::uint8_t node, const describe::Identity& identity) {
  if (network_.of(node).device() != nullptr && files_.find(node) == files_.end()) {
    return false;
  }
  std::optional<describe::Known> known = describe::find_description(describe::user_library(), identity);
  if (!known || files_[node] == known->file) {
    return false;
  }
  print_note(fmt::format("node {} is described by {}", node, known->file));
  files_[node] = known->file;
  network_.describe(node, std::move(known->description));
  return true;
}

bool read_device_type(SdoClient& sdo, std::uint32_t timeout, codict::Device& device, Transfer& transfer) {
  transfer = sdo.upload(describe::device_type.first, describe::device_type.second, {SdoClient::small, timeout, {}});
  if (transfer.done() && transfer.data.size() == 4) {
    describe::store_device_type(device, static_cast<std::uint32_t>(number_of(transfer.data)));
  }
  return !transfer.is_unanswered();
}

std::string other_identity(const codict::Identity& described, const describe::Identity& device) {
  const std::uint32_t vendor = described.vendor_number.value;
  const std::uint32_t product = described.product_number.value;
  const bool is_other = (vendor != 0 && vendor != device.vendor) || (product != 0 && product != device.product);
  return is_other ? fmt::format("the file is for {:08X}:{:08X}, the device is {:08X}:{:08X}", vendor, product,
                                device.vendor, device.product)
                  : std::string();
}

std::optional<describe::Identity> identify_device(SdoClient& sdo, std::uint8_t node, const Common& common,
                                                  describe::Network& network, Transfer& transfer) {
  const std::optional<describe::Identity> identity = read_identity(sdo, common.timeout, transfer);
  if (!identity || network.of(node).device() != nullptr) {
    return identity;
  }
  std::optional<describe::Known> known = describe::find_description(describe::user_library(), *identity);
  if (!known) {
    known = upload_description(sdo, node, *identity, common);
  }
  if (known) {
    network.describe(node, std::move(known->description));
  }
  return identity;
}

std::optional<describe::Known> upload_description(SdoClient& sdo, std::uint8_t node, const describe::Identity& identity,
                                                  const Common& common) {
  if (!may_upload(common)) {
    return std::nullopt;
  }
  const std::string library = describe::user_library();
  const Transfer format = sdo.upload(storage_format, 0, {SdoClient::small, common.timeout, {}});
  if (!format.done() || format.data != Bytes{not_compressed}) {
    return std::nullopt;
  }
  if (!common.is_sure &&
      !is_confirmed(fmt::format("node {} stores its description (1021h); upload it to {}?", node, library))) {
    return std::nullopt;
  }
  ProgressLine progress(std::cerr, shows_progress() ? Progress::Form::bar : Progress::Form::none);
  const Transfer eds =
      sdo.upload(store_eds, 0, {largest_eds, common.timeout, [&](const Amount& amount) { progress.update(amount); }});
  progress.end();
  if (Interruption::happened()) {
    return std::nullopt;
  }
  std::string why = eds.done() ? std::string() : eds.outcome();
  std::optional<describe::Known> known;
  if (eds.done()) {
    known = describe::store_description(library, identity, {eds.data.begin(), eds.data.end()}, why);
  }
  if (!known) {
    print_note(fmt::format("the description of node {} (1021h) is not used: {}", node, why));
  }
  return known;
}

}  // namespace lexican::program
