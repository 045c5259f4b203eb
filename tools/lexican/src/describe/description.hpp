// SPDX-License-Identifier: Apache-2.0
/// \file description.hpp
/// Names, types, units and PDOs of a device by its description (EDS, DCF, XDD, XDC), read with codict's library.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "client/values.hpp"
#include "model/device.hpp"

namespace lexican::describe {

/// Returns the name of an object of CiA 301, such as "device type"; empty for others.
std::string_view standard_name(std::uint16_t index, std::uint8_t sub_index);

/// Returns the word that has to be written to an entry: "save" to 1010h, "load" to 1011h; empty for others.
/// [301:7.5.2.13, 7.5.2.14]
std::string_view signature_of(std::uint16_t index, std::uint8_t sub_index);

/// Returns "1018h:04", or "6060h" for an object without sub-objects.
std::string key_of(std::uint16_t index, std::uint8_t sub_index, bool has_sub_objects);

/// A described device. Objects of CiA 301 that are not described have their standard name and type.
class Description {
 public:
  Description() = default;
  explicit Description(codict::Device device) : device_(std::make_shared<codict::Device>(std::move(device))) {}

  /// Returns the description, null if there is none.
  const codict::Device* device() const { return device_.get(); }

  /// Returns the name of an entry: "velocity actual value", "identity object, serial number"; empty if it is unknown.
  std::string name_of(std::uint16_t index, std::uint8_t sub_index) const;
  /// Returns key and name: "606Ch:00 velocity actual value".
  std::string object(std::uint16_t index, std::uint8_t sub_index) const;
  /// Returns the type of an entry, nothing if it is unknown or not one of values.hpp.
  std::optional<ValueType> type_of(std::uint16_t index, std::uint8_t sub_index) const;
  /// Returns a value in words: a number with unit and name ("1.5 A", "3 (profile velocity)"), a COB-ID and the like in
  /// hexadecimal digits, a text in quotes, or bytes.
  std::string show(std::uint16_t index, std::uint8_t sub_index, const Bytes& bytes) const;
  /// Returns the number of a value as show() scales it, without a type that of an unsigned integer; nothing if it is
  /// none.
  std::optional<double> number(std::uint16_t index, std::uint8_t sub_index, const Bytes& bytes) const;

  /// Returns the unit of number(); empty if there is none.
  std::string unit_of(std::uint16_t index, std::uint8_t sub_index) const;

 private:
  std::shared_ptr<const codict::Device> device_;
};

/// Reads a description.
/// \retval nothing  \a why says why
std::optional<Description> read_description(const std::string& path, std::string& why);

/// The descriptions of a network, by node-ID.
class Network {
 public:
  /// Adds what an option --eds names: "FILE", "NODE=FILE" or a directory. A file without node-ID describes the node
  /// that its commissioning names, else every node that no other file describes; there can be one such file.
  /// \retval false  \a why says why
  bool add(const std::string& argument, std::string& why);
  /// Sets the description of a node.
  void describe(std::uint8_t node, Description description);
  /// Returns the description of a node; without a file that of CiA 301.
  const Description& of(std::uint8_t node) const;

 private:
  bool add_file(std::uint8_t node, const std::string& path, std::string& why);
  bool add_directory(const std::string& path, std::string& why);

  std::map<std::uint8_t, Description> nodes_;  // 0: of all others
};

}  // namespace lexican::describe
