// SPDX-License-Identifier: Apache-2.0
/// \file dictionary.hpp
/// An object dictionary of the stack that is built at run time from the description of a device, as codict generates
/// it: types, access, limits, default values, strings, domains, storage.
#pragma once

#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "client/values.hpp"
#include "gen/plan.hpp"
#include "host/host.hpp"
#include "host/table.hpp"

namespace lexican::simulate {

/// Called when the network, or a PDO, has written an application object.
using Written = std::function<void(std::uint16_t index, std::uint8_t sub_index)>;

/// Context: one thread. Must outlive the node.
class Dictionary {
 public:
  /// \a file: the bytes of the description, which 1021h has if it is an EDS. Objects without an entry are in
  /// left_out().
  Dictionary(const codict::Device& device, const std::string& file);
  ~Dictionary();
  Dictionary(const Dictionary&) = delete;
  Dictionary& operator=(const Dictionary&) = delete;

  Table table() { return {objects_.data(), static_cast<std::uint16_t>(objects_.size())}; }
  std::size_t entries() const { return objects_.size() - 1; }  // without the end mark
  /// Bytes of non-volatile memory that the node needs.
  std::uint32_t storage_size() const { return storage_size_; }
  /// Why objects are missing, or PDOs are switched off, a line each.
  const std::vector<std::string>& left_out() const { return left_out_; }

  /// Lets the server refuse reading and writing of an object. \a code: SDO abort code; 0: as usual.
  /// \retval false  there is no such object, or the stack itself implements it
  bool refuse(std::uint16_t index, std::uint8_t sub_index, std::uint32_t code);
  /// Sets a number before the node starts.
  void set_number(std::uint16_t index, std::uint8_t sub_index, std::uint64_t value);
  /// Writes an object from inside the device: limits and access rights do not count. \a value: of its length.
  /// \retval false  it is part of the table, or has another length
  bool write(CO_OBJ& object, CO_NODE& node, const Bytes& value);
  /// Reads an object of at most 8 bytes from inside the device.
  std::optional<Bytes> read(CO_OBJ& object, CO_NODE& node);
  void on_written(Written written) { written_ = std::move(written); }

 private:
  struct Guard;
  struct String;
  struct Consumer;
  class Memory;

  void note_excess(const codict::gen::Plan& plan);
  void build(const codict::gen::Plan& plan, const std::string& file);
  void add(const codict::gen::Item& item, Memory& memory, const std::string& file);
  void add_storage(const codict::gen::Plan& plan);
  CO_OBJ plain(const CO_OBJ& object) const;
  const CO_OBJ_TYPE* guarded(const codict::gen::Item& item, const CO_OBJ_TYPE* type);

  std::vector<CO_OBJ> objects_;
  std::vector<std::string> left_out_;
  std::unique_ptr<Memory> memory_;
  std::deque<Guard> guards_;
  std::deque<String> strings_;
  std::deque<Consumer> consumers_;
  std::deque<CO_PARA> groups_;
  std::deque<CO_OBJ_STR> texts_;
  std::deque<CO_OBJ_DOM> domains_;
  std::deque<CO_OBJ_DOM_RO> constants_;
  std::deque<std::string> bytes_;  ///< of constant texts and domains
  std::vector<CO_DEFAULTS> defaults_;
  std::uint32_t storage_size_ = 0;
  Written written_;
};

}  // namespace lexican::simulate
