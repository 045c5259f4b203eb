// SPDX-License-Identifier: Apache-2.0
/// \file profile.hpp
/// How devices of a profile behave without a script: drives (CiA 402), and I/O modules (CiA 401).
#pragma once

#include <memory>
#include <vector>

#include "simulate/device.hpp"

namespace lexican::simulate {

/// The behaviour of a device without a script. Context: that of its simulation.
class Behaviour {
 public:
  virtual ~Behaviour() = default;
  /// The network has written an object.
  virtual void written(std::uint16_t index, std::uint8_t sub_index) = 0;
  /// All objects of a frame are written.
  virtual void update() {}
  /// A command sets an object. \retval true  the behaviour has done so
  virtual bool commanded(std::uint16_t index, std::uint8_t sub_index, const Bytes& value) = 0;
  /// An error was raised by a command. \a code: EMCY error code
  virtual void raised(std::uint16_t code) = 0;
  /// The connection to the master is lost: NMT stop, or no heartbeat or guarding any more.
  virtual void disconnected() = 0;
  /// Some time has passed. Called while is_at_rest() is false.
  virtual void step(Micros elapsed) = 0;
  virtual bool is_at_rest() const = 0;
  /// The node has started, or was reset.
  virtual void reset() = 0;
  /// Returns the state of the terminals of an object, if it has some.
  virtual std::optional<std::int64_t> terminal(std::uint16_t, std::uint8_t) const { return std::nullopt; }
};

/// Makes the behaviours of a device that runs: one for each axis of a drive. Empty: its profile has none here.
/// \a device must outlive them.
std::vector<std::unique_ptr<Behaviour>> behaviours_of(Device& device);

/// The behaviours of one device.
class Behaviours {
 public:
  /// \a device: runs; must outlive it.
  void start(Device& device);
  /// Lets the behaviours continue until now.
  /// \retval time until it has to be called again; for_ever: the device is at rest
  Micros process(Micros now);
  /// A command sets an object. \retval true  a behaviour has done so
  bool commanded(std::uint16_t index, std::uint8_t sub_index, const Bytes& value);
  void raised(std::uint16_t code);
  /// Returns a text with the state of the terminals of an object; empty: it has none.
  std::string terminals(std::uint16_t index, std::uint8_t sub_index) const;

 private:
  template <typename Call>
  void for_each(Call call);
  bool are_at_rest() const;
  void update();

  Device* device_ = nullptr;
  std::vector<std::unique_ptr<Behaviour>> behaviours_;
  Micros stepped_ = 0;  ///< time of the last step
  bool has_rested_ = true;
};

/// The integers among the objects of a device. Objects that it has not are never made: they have the value that the
/// caller names.
class Numbers {
 public:
  /// \a offset: of the indices, for a further axis
  explicit Numbers(Device& device, std::uint16_t offset = 0) : device_(device), offset_(offset) {}

  Device& device() const { return device_; }
  /// Returns the index of the profile for an index of the device.
  std::uint16_t of_profile(std::uint16_t index) const { return static_cast<std::uint16_t>(index - offset_); }
  bool has(std::uint16_t index, std::uint8_t sub_index = 0) const;
  std::uint64_t natural(std::uint16_t index, std::uint8_t sub_index, std::uint64_t otherwise) const;
  std::int64_t integer(std::uint16_t index, std::uint8_t sub_index, std::int64_t otherwise) const;
  /// Sets an object, if the device has it. \a is_event: event-driven TPDOs with it are sent if the value changes
  void put(std::uint16_t index, std::uint8_t sub_index, std::int64_t value, bool is_event = true) const;
  /// Sends the event-driven TPDOs with an object.
  void send(std::uint16_t index) const;

 private:
  std::optional<Bytes> bytes(std::uint16_t index, std::uint8_t sub_index) const;

  Device& device_;
  std::uint16_t offset_;
};

/// Returns an integer from its bytes on the bus.
std::uint64_t natural_of(const Bytes& bytes);
std::int64_t integer_of(const Bytes& bytes);

}  // namespace lexican::simulate
