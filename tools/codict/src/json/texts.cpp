// SPDX-License-Identifier: Apache-2.0
#include "json/texts.hpp"

#include <string_view>
#include <type_traits>
#include <vector>

#include "json/members.hpp"

namespace lexican::codict::json {

namespace {

class Walk {
 public:
  static constexpr bool is_reading = false;

  explicit Walk(const std::function<void(const std::string&)>& call) : call_(call) {}

  template <typename T>
  void required(std::string_view /*name*/, const T& /*number*/) {}
  template <typename T>
  void operator()(std::string_view name, const std::vector<T>& all) {
    for (const T& one : all) {
      (*this)(name, one);
    }
  }
  template <typename T>
  void operator()(std::string_view /*name*/, const T& member) {
    if constexpr (std::is_same_v<T, std::string>) {
      call_(member);
    } else if constexpr (std::is_base_of_v<Text, T>) {
      call_(member.text);
    } else if constexpr (std::is_class_v<T>) {
      members(*this, member);
    }
  }
  template <typename T>
  void operator()(std::string_view name, const Rare<T>& member) {
    (*this)(name, *member);
  }
  template <typename T>
  void end_of(const T& /*part*/) {}

 private:
  const std::function<void(const std::string&)>& call_;
};

}  // namespace

void for_each_text(const Device& device, const std::function<void(const std::string&)>& call) {
  Walk walk(call);
  members(walk, device);
}

}  // namespace lexican::codict::json
