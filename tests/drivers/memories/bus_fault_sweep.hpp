// SPDX-License-Identifier: Apache-2.0
/// \file bus_fault_sweep.hpp
/// Calls the driver of a modelled EEPROM with a fault of the bus at each access, of each kind and duration. A model has
/// bus_fault, now, byte(), context(), driver(), faults and shows(), and can be copied.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "bus_fault.hpp"

namespace test {

/// Duration of an access beyond that without a fault: each wait for a write cycle has a limit of 5 ms and of the
/// transfers, and there are less than 20 waits in the accesses below.
constexpr std::uint64_t longest_delay = 20 * 10000;

/// Returns the violations of the rules of the memory. A write cycle that the driver cannot see does not count: the bus
/// has hidden it.
template <class Model>
std::vector<std::string> violations(const Model& model) {
  std::vector<std::string> found;
  std::copy_if(model.faults.begin(), model.faults.end(), std::back_inserter(found),
               [](const std::string& text) { return text.rfind("instruction in a write cycle", 0) != 0; });
  return found;
}

template <class Model>
std::vector<std::uint8_t> contents(Model& model, std::uint32_t at, std::uint32_t size) {
  std::vector<std::uint8_t> bytes(size);
  for (std::uint32_t n = 0; n < size; ++n) {
    bytes[n] = model.byte(at + n);
  }
  return bytes;
}

/// Calls access(model) with a fault at each access of the bus, and then check(model, at, kind, duration) with the bus
/// restored. Returns the number of faults.
template <class Model, class Access, class Check>
std::uint64_t for_each_fault(const Model& before, Access access, Check check) {
  Model whole = before;
  access(whole);
  std::uint64_t faults = 0;
  for_bus_faults([&](BusFault kind, std::uint64_t duration) {
    CAPTURE(static_cast<int>(kind));
    CAPTURE(duration);
    bool was_faulty = true;
    for (std::uint64_t at = 1; was_faulty; ++at) {
      CAPTURE(at);
      Model model = before;
      model.bus_fault = {kind, at, duration};
      const std::uint32_t done = access(model);
      was_faulty = model.bus_fault.has_begun();
      faults += was_faulty ? 1 : 0;
      REQUIRE(model.now < whole.now + longest_delay);
      model.bus_fault = {};
      check(model, done, kind, was_faulty ? duration : 0);
      REQUIRE(violations(model) == std::vector<std::string>{});
    }
  });
  return faults;
}

/// Writes and reads \a size bytes at \a at. Requires that the bytes that a write reports are in the memory, that no
/// other bytes have changed, and that the next write and read work. A fault that ends before the driver tests the
/// device can be invisible to a read: it then returns the level of the lines. Returns the number of faults.
template <class Model>
std::uint64_t test_bus_faults(Model before, std::uint32_t at, std::uint32_t size) {
  using Bytes = std::vector<std::uint8_t>;
  constexpr std::uint32_t margin = 20;
  Bytes old(size + 2 * margin);
  Bytes bytes(size);
  for (std::uint32_t n = 0; n < old.size(); ++n) {
    before.byte(at - margin + n) = old[n] = static_cast<std::uint8_t>(0x80 + n);
  }
  for (std::uint32_t n = 0; n < size; ++n) {
    bytes[n] = static_cast<std::uint8_t>(1 + n);
  }
  const auto write = [&](Model& model) { return model.driver().Write(model.context(), at, bytes.data(), size); };
  Bytes read(size);
  const auto read_all = [&](Model& model) {
    std::fill(read.begin(), read.end(), std::uint8_t{0x33});
    return model.driver().Read(model.context(), at, read.data(), size);
  };
  const auto check_written = [&](Model& model, std::uint32_t done, BusFault, std::uint64_t duration) {
    REQUIRE(done <= size);
    REQUIRE((duration != 0 || done == size));
    const Bytes now = contents(model, at - margin, size + 2 * margin);
    for (std::uint32_t n = 0; n < now.size(); ++n) {
      const bool is_inside = n >= margin && n < margin + size;
      CAPTURE(n);
      REQUIRE((now[n] == old[n] || (is_inside && now[n] == bytes[n - margin])));
      REQUIRE((!is_inside || n - margin >= done || now[n] == bytes[n - margin]));
    }
    REQUIRE(write(model) == size);
    REQUIRE(contents(model, at, size) == bytes);
    REQUIRE(read_all(model) == size);
    REQUIRE(read == bytes);
  };
  const auto check_read = [&](Model& model, std::uint32_t done, BusFault kind, std::uint64_t duration) {
    REQUIRE(done <= size);
    REQUIRE((duration != 0 || done == size));
    const bool may_differ = duration != 0 && duration != lasting && !Model::shows(kind);
    for (std::uint32_t n = 0; n < done; ++n) {
      const bool is_level = read[n] == 0xFF || read[n] == 0x00;
      REQUIRE((read[n] == old[margin + n] || (may_differ && is_level)));
    }
    REQUIRE(contents(model, at - margin, size + 2 * margin) == old);
    REQUIRE(read_all(model) == size);
    REQUIRE(read == Bytes(old.begin() + margin, old.end() - margin));
  };
  return for_each_fault(before, write, check_written) + for_each_fault(before, read_all, check_read);
}

/// Erases \a size bytes at \a at, both multiples of the pages. Requires that they read FFh if the erase reports
/// success, and that the next erase works. Returns the number of faults.
template <class Model>
std::uint64_t test_erase_faults(Model before, std::uint32_t at, std::uint32_t size) {
  for (std::uint32_t n = 0; n < size; ++n) {
    before.byte(at + n) = static_cast<std::uint8_t>(n);
  }
  const std::vector<std::uint8_t> erased(size, 0xFF);
  const auto erase = [&](Model& model) { return model.driver().Erase(model.context(), at, size) ? size : 0U; };
  const auto check = [&](Model& model, std::uint32_t done, BusFault, std::uint64_t duration) {
    REQUIRE((duration != 0 || done == size));
    REQUIRE((done == 0 || contents(model, at, size) == erased));
    REQUIRE(erase(model) == size);
    REQUIRE(contents(model, at, size) == erased);
  };
  return for_each_fault(before, erase, check);
}

}  // namespace test
