// SPDX-License-Identifier: Apache-2.0
#include "sdo_reactions.hpp"

#include <doctest/doctest.h>

#include <map>
#include <sstream>

namespace test {
namespace {

using Words = std::vector<std::string>;

Words words_of(const std::string& text) {
  std::istringstream stream(text);
  Words words;
  for (std::string word; stream >> word;) {
    words.push_back(word);
  }
  return words;
}

Words parts_of(const std::string& text, char separator) {
  std::istringstream stream(text);
  Words parts;
  for (std::string part; std::getline(stream, part, separator);) {
    parts.push_back(part);
  }
  return parts;
}

// A row of the table: what it says of each object's multiplexers is filled in later.
struct Row {
  Words commands;
  Words answer;
  Words afterwards;
};

class Reader {
 public:
  explicit Reader(std::string_view table) {
    std::istringstream lines{std::string(table)};
    for (std::string line; std::getline(lines, line);) {
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
      states.back().enter.emplace_back("601#" + bytes(words_of(sides.at(0))), "581#" + bytes(words_of(sides.at(1))));
      states.back().transfer = object_->transfer;
    } else if (words[0] == "initiates") {
      rows_.insert(rows_.end(), object_->initiates.begin(), object_->initiates.end());
    } else {
      const Words parts = parts_of(line, ':');
      REQUIRE(parts.size() == 3);
      (in_state_ ? rows_ : object_->initiates).push_back({words_of(parts[0]), words_of(parts[1]), words_of(parts[2])});
    }
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

  // Codes are written as people read them, and sent low byte first.
  static std::string little_endian(const std::string& code) {
    REQUIRE(code.size() == 8);
    return code.substr(6, 2) + code.substr(4, 2) + code.substr(2, 2) + code.substr(0, 2);
  }

  SdoReaction reaction(const Row& row) const {
    const bool ends = row.afterwards.at(0) == "ends";
    const std::string about = multiplexer(row.afterwards.at(ends ? 1 : 0));
    SdoReaction result;
    result.open = ends ? "" : about;
    result.written = row.afterwards.back() == "writes" ? about : "";
    if (row.answer.at(0) == "abort") {
      result.answer = "581#80" + about + little_endian(row.answer.at(1));
    } else if (row.answer.at(0) != "-") {
      result.answer = "581#" + bytes(row.answer);
    }
    return result;
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
      const std::size_t first = std::stoul(command, nullptr, 16);
      const std::size_t last = command.size() > 2 ? std::stoul(command.substr(3), nullptr, 16) : first;
      for (std::size_t n = first; n <= last; ++n) {
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

std::vector<SdoState> sdo_states(std::string_view table) { return Reader(table).states; }

}  // namespace test
