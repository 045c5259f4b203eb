// SPDX-License-Identifier: Apache-2.0
#include "sdo_reactions.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <utility>

#include "words.hpp"

namespace test {
namespace {

using Words = std::vector<std::string>;

// A line of the table, in which the letters T and R are not yet replaced by the multiplexers of an object.
struct Row {
  Words commands;
  std::string answer;
  Words afterwards;
};

// Parses a command byte or a range of them: "21" or "20-2F".
std::pair<unsigned, unsigned> range_of(const std::string& text) {
  const unsigned long first = std::stoul(text, nullptr, 16);
  const unsigned long last = text.size() > 2 ? std::stoul(text.substr(3), nullptr, 16) : first;
  REQUIRE((first <= last && last <= 0xFF));
  return {static_cast<unsigned>(first), static_cast<unsigned>(last)};
}

std::string hex(unsigned byte) {
  static constexpr char digits[] = "0123456789ABCDEF";
  return {digits[byte >> 4], digits[byte & 15U]};
}

class Reader {
 public:
  explicit Reader(std::string_view table) {
    for (const std::string& line : parts_of(table, '\n')) {
      read(line);
    }
    finish_state();
  }
  std::vector<SdoState> states;

 private:
  struct Object {
    std::string transfer;
    std::string request;
    std::vector<Row> initiates;
  };

  void read(const std::string& line) {
    const Words words = words_of(line);
    if (words.empty() || line[0] == '#') {
      return;
    }
    CAPTURE(line);
    if (line[0] == ' ') {
      read_part(line, words);
      return;
    }
    finish_state();
    if (words[0] == "object") {
      object_ = &objects_[words.at(1)];
      *object_ = {words.at(3), words.at(5), {}};
    } else if (words[0] == "state") {
      states.push_back({line.substr(6), "", object_->request});
      in_state_ = true;
    } else {
      REQUIRE(words[0] == "initiates");
    }
  }

  void read_part(const std::string& line, const Words& words) {
    if (words[0] == "enter") {
      const Words sides = parts_of(line.substr(line.find("enter") + 5), '>');
      REQUIRE(sides.size() == 2);
      add_exchange(frames("601#", sides[0]), frames("581#", sides[1]));
    } else if (words[0] == "initiates") {
      rows_.insert(rows_.end(), object_->initiates.begin(), object_->initiates.end());
    } else {
      const Words parts = parts_of(line, ':');
      REQUIRE(parts.size() == 3);
      (in_state_ ? rows_ : object_->initiates).push_back({words_of(parts[0]), parts[1], words_of(parts[2])});
    }
  }

  // Adds requests to the path into the state. The answers are those to the last request.
  void add_exchange(const Words& requests, const Words& answers) {
    for (const std::string& request : requests) {
      states.back().enter.push_back({request, {}});
    }
    states.back().enter.back().answers = answers;
    states.back().transfer = object_->transfer;
  }

  Words frames(const std::string& identifier, const std::string& text) const {
    Words all;
    for (const std::string& part : parts_of(text, '|')) {
      const Words words = words_of(part);
      if (words.at(0) == "-") {
        continue;
      }
      const std::string rest = bytes(Words(words.begin() + 1, words.end()));
      const auto [first, last] = range_of(words[0]);
      for (unsigned n = first; n <= last; ++n) {
        all.push_back(identifier + hex(n) + rest);
      }
    }
    return all;
  }

  std::string bytes(const Words& words) const {
    std::string all;
    for (const std::string& word : words) {
      all += word == "T" ? object_->transfer : word == "R" ? object_->request : word;
    }
    return all;
  }

  std::string multiplexer(const std::string& letter) const {
    REQUIRE((letter == "T" || letter == "R"));
    return letter == "T" ? object_->transfer : object_->request;
  }

  // Converts an abort code from the order of the table (high byte first) to that of the bus.
  static std::string little_endian(const std::string& code) {
    REQUIRE(code.size() == 8);
    return code.substr(6, 2) + code.substr(4, 2) + code.substr(2, 2) + code.substr(0, 2);
  }

  SdoReaction reaction(const Row& row) const {
    const auto says = [&](const char* word) {
      return std::find(row.afterwards.begin(), row.afterwards.end(), word) != row.afterwards.end();
    };
    const bool ends = row.afterwards.at(0) == "ends";
    const std::string about = multiplexer(row.afterwards.at(ends ? 1 : 0));
    const Words answer = words_of(row.answer);
    const bool aborts = answer.at(0) == "abort";
    return {aborts ? Words{abort(about, answer.at(1))} : frames("581#", row.answer), ends ? "" : about,
            says("writes") ? about : "", says("block")};
  }

  static std::string abort(const std::string& about, const std::string& code) {
    return "581#80" + about + little_endian(code);
  }

  void apply(const Row& row) {
    auto& reactions = states.back().reactions;
    for (const std::string& command : row.commands) {
      if (command == "rest") {
        for (auto& one : reactions) {
          if (one.empty()) one.push_back(reaction(row));
        }
        continue;
      }
      const auto [first, last] = range_of(command);
      for (unsigned n = first; n <= last; ++n) {
        reactions.at(n).push_back(reaction(row));
      }
    }
  }

  void finish_state() {
    for (const Row& row : rows_) {
      apply(row);
    }
    rows_.clear();
    in_state_ = false;
  }

  std::map<std::string, Object> objects_;
  Object* object_ = nullptr;
  std::vector<Row> rows_;
  bool in_state_ = false;
};

}  // namespace

namespace {

void take_block_transfer_out(std::vector<SdoState>& states) {
  const auto is_block = [](const SdoState& state) { return state.name.find(": block") != std::string::npos; };
  states.erase(std::remove_if(states.begin(), states.end(), is_block), states.end());
  for (SdoState& state : states) {
    for (const unsigned command : {0xA0U, 0xA4U, 0xC0U, 0xC2U, 0xC4U, 0xC6U}) {
      state.reactions[command] = {{{"581#80" + state.request + "01000405"}, "", "", false}};
    }
  }
}

}  // namespace

std::vector<SdoState> sdo_states(std::string_view table, bool block) {
  std::vector<SdoState> states = Reader(table).states;
  if (!block) {
    take_block_transfer_out(states);
  }
  return states;
}

}  // namespace test
