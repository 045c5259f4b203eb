// SPDX-License-Identifier: Apache-2.0
/// \file simulation.hpp
/// Simulated devices on one bus, and the commands that change them while they run.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "simulate/device.hpp"
#include "simulate/disturbance.hpp"
#include "simulate/ground.hpp"
#include "simulate/sources.hpp"

namespace lexican::simulate {

/// Finds an object by index or name. \retval false  \a why says why
using FindObject = std::function<bool(const std::string& word, const describe::Description& description,
                                      std::uint16_t& index, std::uint8_t& sub_index, std::string& why)>;

struct SimulationSetup {
  describe::Description description;
  std::string file;          ///< bytes of the description
  std::uint8_t node_id = 1;  ///< of the first device; the others follow. 255: none, LSS slaves
  unsigned count = 1;
  std::uint32_t serial = 0;  ///< of the first device; 0: that of the description, plus 1 for each further device
  std::string storage;       ///< file; that of a further device has its node-ID appended. Empty: none
  std::uint64_t seed = 1;
};

/// Context: one thread.
class Simulation {
 public:
  /// \a ground must outlive it.
  Simulation(Ground& ground, const SimulationSetup& setup, FindObject find);
  ~Simulation();
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  /// Starts all devices.
  /// \retval text  why one cannot run; empty: all run
  std::string start();
  /// Processes frames, timers, signals and delayed commands.
  /// \retval time until it has to be called again, unless a frame arrives before, µs
  Micros process();
  /// Executes a command, see sim.md.
  /// \retval text  an answer or a fault; empty: done
  std::string execute(const std::string& line, bool& is_fault);
  /// Sets a function that is called with the answers and faults of commands that are executed later.
  void on_note(std::function<void(const std::string&)> function) { note_ = std::move(function); }
  bool has_ended() const { return has_ended_; }
  Device& device(std::size_t n);
  std::size_t devices() const { return members_.size(); }

 private:
  struct Member;
  struct Signal;
  struct Later;

  Member& add_member();
  void make_device(Member& member, DeviceSetup setup);
  std::string double_node_id(Member& member, const std::vector<std::string>& words);
  std::string set(Member& member, const std::vector<std::string>& words, bool is_played);
  std::string set_csv(Signal signal, ValueType type, std::vector<std::string> words);
  std::string play(const std::string& file);
  std::string execute_played(const PlayedLine& line);
  bool choose(const std::string& node);
  void note(const std::string& text);
  static double level_of(const Signal& signal, Micros now);
  static std::string next_of(Signal& signal, Micros now);
  std::string execute_words(Member& member, const std::vector<std::string>& words);
  void update_signals(Micros now);
  void switch_on(Micros now);
  void run_later(Micros now);
  Micros run_played(Micros now);

  Ground& ground_;
  SimulationSetup setup_;
  FindObject find_;
  std::vector<std::unique_ptr<Member>> members_;
  std::vector<Signal> signals_;
  std::vector<Later> later_;
  std::unique_ptr<Playback> playback_;
  std::function<void(const std::string&)> note_;
  std::size_t chosen_ = 0;  ///< member that commands mean
  bool has_ended_ = false;
  Micros updated_ = 0;
};

}  // namespace lexican::simulate
