// SPDX-License-Identifier: Apache-2.0
/// \file inputs_outputs.hpp
/// A simulated I/O module of CiA 401: digital and analogue inputs and outputs.
#pragma once

#include <map>
#include <utility>

#include "simulate/profile.hpp"

namespace lexican::simulate {

class InputsOutputs : public Behaviour {
 public:
  explicit InputsOutputs(const Numbers& numbers) : numbers_(numbers) {}

  void written(std::uint16_t index, std::uint8_t sub_index) override;
  bool commanded(std::uint16_t index, std::uint8_t sub_index, const Bytes& value) override;
  void raised(std::uint16_t) override {}
  void disconnected() override;
  void step(Micros) override {}
  bool is_at_rest() const override { return true; }
  void reset() override;
  std::optional<std::int64_t> terminal(std::uint16_t index, std::uint8_t sub_index) const override;

 private:
  using Key = std::pair<std::uint16_t, std::uint8_t>;

  struct Inputs;
  struct Outputs;
  static const Inputs inputs[];
  static const Outputs outputs[];

  static const Inputs* inputs_at(std::uint16_t index, std::uint16_t Inputs::*member);
  static const Outputs* outputs_at(std::uint16_t index);
  void read_input(const Inputs& group, std::uint8_t sub_index, bool may_send);
  void read_analogue(std::uint16_t index, std::uint8_t sub_index, std::int64_t value);
  void drive_output(const Outputs& group, std::uint8_t sub_index, bool is_filtered);
  template <typename Call>
  void for_each(std::uint16_t index, Call call) const;

  Numbers numbers_;
  std::map<Key, std::uint64_t> terminals_;  ///< digital inputs and outputs
  std::map<Key, std::int64_t> levels_;      ///< analogue outputs with an error value
  std::map<Key, std::int64_t> sent_;        ///< analogue inputs, as last sent
};

}  // namespace lexican::simulate
