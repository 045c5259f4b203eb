// SPDX-License-Identifier: Apache-2.0
/// \file identity.hpp
/// The identity of a device, and the description that it stores.
#pragma once

#include <map>

#include "client/sdo_client.hpp"
#include "describe/configuration.hpp"
#include "describe/library.hpp"
#include "program/verb.hpp"

namespace lexican::program {

/// Reads vendor-ID, product code and revision number (1018h); a device without revision number has 0.
/// \retval nothing  the device does not have one of the others; \a transfer: the one that has failed
std::optional<describe::Identity> read_identity(SdoClient& sdo, std::uint32_t timeout, Transfer& transfer);

/// Describes a device by the user's library, or by the description that it stores, unless \a network describes it.
/// \retval nothing  it does not answer; \a transfer: the one that has failed
std::optional<describe::Identity> identify_device(SdoClient& sdo, std::uint8_t node, const Common& common,
                                                  describe::Network& network, Transfer& transfer);

/// Describes the nodes of a network by the user's library, unless --eds describes them.
class LibraryFiles {
 public:
  /// \a network must outlive it.
  explicit LibraryFiles(describe::Network& network) : network_(network) {}
  /// Prints which file describes the node. \retval true  the node has a new description
  bool describe(std::uint8_t node, const describe::Identity& identity);

 private:
  describe::Network& network_;
  std::map<std::uint8_t, std::string> files_;  ///< by node-ID
};

/// Reads the device type into a description: profiles decide what is a command.
/// \retval false  the device does not answer; \a transfer: the upload
bool read_device_type(SdoClient& sdo, std::uint32_t timeout, codict::Device& device, Transfer& transfer);

/// Returns in words how the identity of a device differs from that of a description; empty: it does not. A vendor-ID or
/// product code of 0 in the description stands for any.
std::string other_identity(const codict::Identity& described, const describe::Identity& device);

/// Returns true if a device may be asked for its description: the user can agree.
bool may_upload(const Common& common);

/// Uploads the EDS that a device stores (1021h) to the user's library, if the user agrees: by --yes, or on a terminal.
/// Prints why it fails.
/// \retval nothing  the device stores none, or in another format than text; or the user does not agree; or it has
/// failed
std::optional<describe::Known> upload_description(SdoClient& sdo, std::uint8_t node, const describe::Identity& identity,
                                                  const Common& common);

}  // namespace lexican::program
